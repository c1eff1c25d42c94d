// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/template_files.h"

namespace wscvt {

namespace {

// clang-format off
constexpr const char* yade_packing_text = R"py(# Packs grains of this folder in Yade, by gravity in a box, and prints how high they lie:
#   yade -n -x yade_packing.py 200
# Virtual grains (grown.csv) are taken in their order. Of templates (templates.csv) shapes follow
# weight_by_number and sizes follow sizes.csv. Each grain is a clump of overlapping spheres inside its
# mesh, whose forces Yade computes fast. The meshes have to be PLY files.
import csv, math, os, random, sys
import numpy

count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
steps = int(sys.argv[2]) if len(sys.argv) > 2 else 200000
random.seed(1)


def nodes(file):
    head, body = open(file, "rb").read().split(b"end_header\n", 1)
    words = head.decode().split()
    number = int(words[words.index("vertex") + 1])
    return numpy.frombuffer(body, "<f8" if "double" in words else "<f4", 3 * number).reshape(-1, 3)


def spheres(points, most=12):
    """Centres and radii: each next sphere touches the most nodes that no other is near to."""
    centres = numpy.concatenate([t * points for t in (0, .2, .4, .55, .7, .8, .9)])
    distances = numpy.linalg.norm(centres[:, None] - points, axis=2)
    radii = distances.min(1)
    near = distances < radii[:, None] + 0.1 * numpy.linalg.norm(points, axis=1).mean()
    near[radii < 0.25 * radii.max()] = False
    left, chosen = numpy.ones(len(points), bool), []
    while left.any() and len(chosen) < most:
        best = (near & left).sum(1).argmax()
        if not (near[best] & left).any():
            break
        chosen.append(best)
        left &= ~near[best]
    return [(centres[k], radii[k]) for k in chosen]


def rows(file):
    return list(csv.DictReader(open(file, newline="")))


if os.path.exists("grown.csv"):
    table = rows("grown.csv")[:count]
    grains = [(spheres(nodes(row["file"])), 1.0) for row in table]
    largest = max(float(row["equivalent_diameter [length]"]) for row in table)
else:
    table = rows("templates.csv")
    shapes = [spheres(nodes(row["file"])) for row in table]
    weights = [float(row["weight_by_number"]) for row in table]
    curve = [tuple(map(float, row.values())) for row in rows("sizes.csv")]
    # Grains per mass go with 1 / d^3.
    parts = [(a, b, (q - p) / (a * b) ** 1.5) for (a, p), (b, q) in zip(curve, curve[1:])]
    grains = []
    for k in range(count):
        a, b, _ = random.choices(parts, [part[2] for part in parts])[0]
        grains.append((random.choices(shapes, weights)[0], a * (b / a) ** random.random()))
    largest = curve[-1][0]

spacing = 1.7 * largest
across = max(2, round(1.2 * len(grains) ** (1 / 3)))
side = across * spacing
# So stiff that the lowest grains give way by half a per cent at most, in whatever unit lengths are.
height = math.ceil(len(grains) / across ** 2) * spacing
young = 1000 * 2650 * 9.81 * height
material = O.materials.append(FrictMat(density=2650, young=young, poisson=0.3, frictionAngle=math.radians(30)))
bottom = O.bodies.append(utils.wall(0, 2, sense=1, material=material))
for axis in (0, 1):
    O.bodies.append([utils.wall(0, axis, material=material), utils.wall(side, axis, material=material)])
clumps = []
for k, (shape, size) in enumerate(grains):
    turn = Quaternion(*(random.gauss(0, 1) for _ in range(4)))
    turn.normalize()
    layer, place = divmod(k, across * across)
    centre = Vector3(place % across + .5, place // across + .5, layer + .5) * spacing
    parts = [utils.sphere(centre + turn * Vector3(*map(float, size * c)), float(size * r), material=material)
             for c, r in shape]
    clumps.append(O.bodies.appendClumped(parts, discretization=15)[0])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(gravity=(0, 0, -9.81), damping=0.3),
]
O.dt = 0.3 * utils.PWaveTimeStep()
fall = math.sqrt(2 * height / 9.81)
while O.iter < steps and (O.time < 1.5 * fall or unbalancedForce() > 0.02):
    O.run(500, True)
heights = [O.bodies[k].state.pos[2] for k in clumps]
print("Packed %d grains: centroids from %.4g to %.4g above the bottom, after %d steps, unbalanced force %.2g"
      % (len(clumps), min(heights), max(heights), O.iter, unbalancedForce()))
)py";
// clang-format on

}  // namespace

std::string yade_packing_script() { return yade_packing_text; }

}  // namespace wscvt
