// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/template_files.h"

#include <algorithm>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

constexpr int percent_step = 2;

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

}  // namespace wscvt
