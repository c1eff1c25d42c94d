// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/template_files.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

constexpr int percent_step = 2;

constexpr const char* liggghts_head =
    R"(# Packs grains of the templates in LIGGGHTS, by gravity in a box: liggghts -in liggghts.in
# Each template is a clump of spheres (its .spheres file, for diameter 1) at diameters of the size
# curve; weights are by mass. Set the number of grains, the material and the time step below.
variable grains equal 60
variable side equal SIDE
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
hard_particles yes
variable height equal 2*${side}
region box block 0 ${side} 0 ${side} 0 ${height} units box
create_box 1 box
variable skin equal 0.01*${side}
neighbor ${skin} bin
neigh_modify delay 0
# As stiff as 1000 times the weight of the column, in whatever unit lengths are.
variable stiffness equal 1000*2650*9.81*${height}
fix m1 all property/global youngsModulus peratomtype ${stiffness}
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.2
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran model hertz tangential history
pair_coeff * *
variable step equal 0.002*${side}*sqrt(2650/${stiffness})
timestep ${step}
fix gravity all gravity 9.81 vector 0.0 0.0 -1.0
fix bottom all wall/gran model hertz tangential history primitive type 1 zplane 0.0
fix left all wall/gran model hertz tangential history primitive type 1 xplane 0.0
fix right all wall/gran model hertz tangential history primitive type 1 xplane ${side}
fix front all wall/gran model hertz tangential history primitive type 1 yplane 0.0
fix back all wall/gran model hertz tangential history primitive type 1 yplane ${side}
)";
constexpr const char* liggghts_tail =
    R"(fix source all insert/pack seed 32452843 distributiontemplate mixture insert_every once &
    overlapcheck yes all_in yes vel constant 0 0 0 region box particles_in_region ${grains}
fix clumps all multisphere allow_group_and_set yes
variable lowest equal bound(all,zmin)
thermo_style custom step atoms ke v_lowest
thermo 5000
run 100000
)";

/// Diameters of grains in ascending order, with the mass up to each. The first grain's mass counts
/// from its diameter on.
class CumulativeMass {
 public:
  explicit CumulativeMass(std::vector<double> diameters) : diameters_(std::move(diameters)) {
    if (diameters_.empty()) refuse("There are no grains for a size curve. Give at least one.");
    std::sort(diameters_.begin(), diameters_.end());
    double mass = 0.0;
    for (const double diameter : diameters_) {
      mass += diameter * diameter * diameter;
      finer_.push_back(mass);
    }
  }

  double diameter(double fraction) const {
    const double wanted = finer_.front() + fraction * (finer_.back() - finer_.front());
    const auto above = std::lower_bound(finer_.begin(), finer_.end(), wanted);
    const auto k = std::min(static_cast<std::size_t>(above - finer_.begin()), finer_.size() - 1);
    if (k == 0) return diameters_[k];
    const double part = (wanted - finer_[k - 1]) / (finer_[k] - finer_[k - 1]);
    return diameters_[k - 1] * portable::pow(diameters_[k] / diameters_[k - 1], part);
  }

 private:
  std::vector<double> diameters_;
  std::vector<double> finer_;
};

}  // namespace

double diameter_by_mass(std::vector<double> diameters, double fraction) {
  const CumulativeMass curve(std::move(diameters));
  return curve.diameter(fraction);
}

std::string size_curve_csv(std::vector<double> diameters) {
  const CumulativeMass curve(std::move(diameters));
  std::string table = csv_record({"equivalent_diameter [length]", "finer_by_mass [%]"});
  double last = 0.0;
  for (int percent = 0; percent <= 100; percent += percent_step) {
    double diameter = curve.diameter(0.01 * percent);
    // For grains of one size the curve still needs two points.
    if (percent > 0 && !(diameter > last)) diameter = last * (1.0 + 1e-9);
    last = diameter;
    table += csv_record({format_exact(diameter), format_exact(percent)});
  }
  return table;
}

std::string mercury_psd_csv(std::vector<double> diameters) {
  const CumulativeMass curve(std::move(diameters));
  std::string table;
  for (int percent = 0; percent <= 100; percent += percent_step) {
    table += format_exact(0.5 * curve.diameter(0.01 * percent)) + "," +
             format_exact(0.01 * percent) + "\n";
  }
  return table;
}

std::string sphere_rows(const std::vector<Sphere>& spheres) {
  std::string rows;
  for (const Sphere& sphere : spheres) {
    for (const double coordinate : sphere.centre) rows += format_exact(coordinate) + " ";
    rows += format_exact(sphere.radius) + "\n";
  }
  return rows;
}

std::string liggghts_template_input(const std::vector<ClumpTemplate>& templates,
                                    const std::vector<double>& diameters) {
  if (templates.empty() || diameters.empty()) {
    refuse("There are no templates or no diameters for LIGGGHTS. Give at least one of each.");
  }
  const double side = 8.0 * *std::max_element(diameters.begin(), diameters.end());
  const std::string text = format_typed(side);
  std::string input = liggghts_head;
  input.replace(input.find("SIDE"), 4, text);
  std::string distribution;
  std::size_t count = 0;
  int seed = 15485867;
  for (const ClumpTemplate& one : templates) {
    if (!(one.weight_by_mass > 0.0)) continue;
    for (const double diameter : diameters) {
      const std::string name = "t" + std::to_string(++count);
      seed = next_prime(seed);  // LIGGGHTS needs another prime above 10,000 for each template
      input += "fix " + name + " all particletemplate/multisphere " + std::to_string(seed) +
               " atom_type 1 density " + "constant 2650 nspheres " + std::to_string(one.spheres) +
               " ntry 200000 spheres file " + one.file + " scale " + format_typed(diameter) +
               " type " + std::to_string(count) + "\n";
      distribution += " " + name + " " +
                      format_typed(one.weight_by_mass / static_cast<double>(diameters.size()));
    }
  }
  input += "fix mixture all particledistribution/discrete 15485867 " + std::to_string(count) +
           distribution + "\n";
  return input + liggghts_tail;
}

}  // namespace wscvt
