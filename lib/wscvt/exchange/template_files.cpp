// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/exchange/template_files.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

constexpr int percent_step = 2;

constexpr const char* yade_script =
    R"py(# Packs grains of the templates in Yade, by gravity in a box:
#   yade -n -x yade_packing.py 200
# Sizes follow sizes.csv, shapes weight_by_number in templates.csv. Yade's polyhedra are convex, so
# that each grain is the hull of its template.
import csv, math, random, sys
import numpy
from yade import polyhedra_utils

count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
random.seed(1)


def nodes(file):
    data = open(file, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    words = head.decode().split()
    number = int(words[words.index("vertex") + 1])
    kind = "<f8" if "double" in words else "<f4"
    return numpy.frombuffer(body, kind, 3 * number).reshape(number, 3)


templates = list(csv.DictReader(open("templates.csv", newline="")))
shapes = [nodes(row["file"]) for row in templates]
weights = [float(row["weight_by_number"]) for row in templates]
curve = [(float(a), float(b)) for a, b in list(csv.reader(open("sizes.csv", newline="")))[1:]]
# Grains per mass go with 1 / d^3.
classes = [(a, b, (q - p) / (a * b) ** 1.5) for (a, p), (b, q) in zip(curve, curve[1:])]


def diameter():
    a, b, _ = random.choices(classes, [c[2] for c in classes])[0]
    return a * (b / a) ** random.random()


largest = curve[-1][0]
material = PolyhedraMat(density=2650, young=1e7, poisson=0.3, frictionAngle=math.radians(30))
O.materials.append(material)
side = 1.2 * largest * max(2, round(count ** (1 / 3)))
per_row = max(1, int(side / (1.6 * largest)))
O.bodies.append(utils.wall((0, 0, 0), 2, sense=1, material=material))
for axis in (0, 1):
    for place, sense in ((0, 1), (side, -1)):
        O.bodies.append(utils.wall(place, axis, sense=sense, material=material))
for k in range(count):
    shape = random.choices(shapes, weights)[0] * diameter()
    body = polyhedra_utils.polyhedra(material, v=[Vector3(*map(float, p)) for p in shape])
    i, j, layer = k % per_row, k // per_row % per_row, k // per_row ** 2
    body.state.pos = ((i + .5) * side / per_row, (j + .5) * side / per_row, (layer + .8) * 1.6 * largest)
    turn = Quaternion(random.gauss(0, 1), random.gauss(0, 1), random.gauss(0, 1), random.gauss(0, 1))
    turn.normalize()
    body.state.ori = turn
    O.bodies.append(body)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Wall_Polyhedra_PolyhedraGeom(), Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                    [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                    [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.4),
]
O.dt = 0.2 * polyhedra_utils.PWaveTimeStep()
O.run(int(sys.argv[2]) if len(sys.argv) > 2 else 20000, True)
solid = sum(b.state.mass for b in O.bodies if isinstance(b.shape, Polyhedra)) / 2650
top = max(b.state.pos[2] for b in O.bodies if isinstance(b.shape, Polyhedra))
print("Packed %d grains of %d templates, highest centroid %.4g, volume of the hulls %.4g"
      % (count, len(templates), top, solid))
)py";

}  // namespace

std::string size_curve_csv(std::vector<double> diameters) {
  if (diameters.empty()) refuse("There are no grains for a size curve; give some.");
  std::sort(diameters.begin(), diameters.end());
  std::vector<double> finer;
  double mass = 0.0;
  for (const double diameter : diameters) {
    mass += diameter * diameter * diameter;
    finer.push_back(mass);
  }
  // The first grain's own mass counts from its diameter on.
  const double first = finer.front();
  std::string table = csv_record({"equivalent_diameter [length]", "finer_by_mass [%]"});
  double last = 0.0;
  for (int percent = 0; percent <= 100; percent += percent_step) {
    const double wanted = first + 0.01 * percent * (mass - first);
    const auto above = std::lower_bound(finer.begin(), finer.end(), wanted);
    const auto k = std::min(static_cast<std::size_t>(above - finer.begin()), finer.size() - 1);
    double diameter = diameters[k];
    if (k > 0 && finer[k] > finer[k - 1]) {
      const double part = (wanted - finer[k - 1]) / (finer[k] - finer[k - 1]);
      diameter = diameters[k - 1] * std::pow(diameters[k] / diameters[k - 1], part);
    }
    // Of grains of one size the curve has two points all the same.
    if (percent > 0 && !(diameter > last)) diameter = last * (1.0 + 1e-9);
    last = diameter;
    table += csv_record({format_exact(diameter), format_exact(percent)});
  }
  return table;
}

std::string yade_template_script() { return yade_script; }

}  // namespace wscvt
