# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in MercuryDPM: each scan of a folder as 20 overlapping spheres, with the grain's mass
and moments of inertia.

    WSCVT=wscvt MERCURY=mercury_clumps python3 mercury_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes mercury_scene.txt and
mercury_clumps.png. MERCURY is mercury_clumps.cpp compiled with MercuryDPM: put a copy of it into a new folder
of Drivers/Clump beside a copy of Drivers/Clump/Single/CMakeLists.txt, name the folder in
Drivers/Clump/CMakeLists.txt, and build the target mercury_clumps. No test runs this, because
Debian has no MercuryDPM; README.md tells with which version it was run by hand.
"""
import collections
import os
import subprocess

from packing import arguments, drops, of_each, picture, sphere_mesh, turned, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, density, seconds = 0.02, 0.08, 2650, 1.5


def clump(k, scan):
    name = "clump_%d.mclump" % k
    wscvt("clump", scan, "-k", 20, "--size", diameter, "-o", name)
    return name


clumps = of_each(folder, clump)

grains = list(drops(count, diameter, width))
with open("mercury_scene.txt", "w") as scene:
    scene.write("%g %g %g %g\n" % (width, max(place[2] for place, _ in grains) + diameter, seconds, density))
    for k, (place, turn) in enumerate(grains):
        # The images of the axes are the columns of the matrix of the turn.
        matrix = turned([[1, 0, 0], [0, 1, 0], [0, 0, 1]], (0, 0, 0), turn).T
        numbers = ["%.9g" % v for v in (*place, *matrix.ravel())]
        scene.write(" ".join([clumps[k % len(clumps)], *numbers]) + "\n")
text = subprocess.run([os.environ.get("MERCURY", "./mercury_clumps"), "mercury_scene.txt"], check=True,
                      capture_output=True, text=True).stdout

packed, speed = collections.defaultdict(list), 0.0
for word, *numbers in map(str.split, filter(None, text.splitlines())):
    if word == "grain":
        packed[numbers[0]].append([float(v) for v in numbers[1:]])
    elif word == "speed":
        speed = max(speed, float(numbers[0]))
picture("mercury_clumps.png", [sphere_mesh(spheres) for spheres in packed.values()], width)
highest = max(sum(s[2] for s in spheres) / len(spheres) for spheres in packed.values())
print("MercuryDPM clumps: %d grains, %.4f m/s at most, highest centre at %.1f diameters" %
      (len(packed), speed, highest / diameter))
