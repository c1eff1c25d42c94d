# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in Project Chrono's core, which needs no graphics card: each scan of a folder as 20
overlapping spheres, with the grain's mass and moments of inertia.

    WSCVT=wscvt CHRONO=chrono_smc_clumps python3 chrono_smc_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes chrono_scene.txt and
chrono_smc_clumps.png. CHRONO is chrono_smc_clumps.cpp compiled with Chrono's core: in a copy of its
template_project, put it in the place of my_example.cpp. No test runs this, because Debian has no Chrono;
README.md tells with which version it was run by hand.
"""
import os
import subprocess

from packing import arguments, drops, of_each, picture, sphere_mesh, turned, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, density, seconds = 0.02, 0.08, 2650, 3.0


def clump(k, scan):
    name = "clump_%d.chrono.csv" % k
    wscvt("clump", scan, "-k", 20, "--size", diameter, "-o", name)
    rows = [line.split(",") for line in open(name) if line[0] in "-0123456789"]
    return name, [[float(v) for v in row] for row in rows]


names, shapes = zip(*of_each(folder, clump))
with open("chrono_scene.txt", "w") as scene:
    print(width, seconds, density, file=scene)
    for k, (place, turn) in enumerate(drops(count, diameter, width)):
        print(names[k % len(names)], *place, *turn, file=scene)
text = subprocess.run([os.environ.get("CHRONO", "./chrono_smc_clumps")], check=True, capture_output=True,
                      text=True).stdout
*rows, (speed,) = [[float(v) for v in line.split()] for line in text.splitlines()]
grains = []
for k, row in enumerate(rows):
    spheres = shapes[k % len(shapes)]
    centres = turned([sphere[:3] for sphere in spheres], row[:3], row[3:])
    grains.append(sphere_mesh([(*centre, sphere[3]) for centre, sphere in zip(centres, spheres)]))
picture("chrono_smc_clumps.png", grains, width)
print("Chrono clumps: %d grains, %.4f m/s at most, highest centre at %.1f diameters" %
      (len(rows), speed, max(row[2] for row in rows) / diameter))
