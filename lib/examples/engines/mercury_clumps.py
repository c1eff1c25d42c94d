# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in MercuryDPM: each scan of a folder as 20 overlapping spheres, with the grain's mass
and moments of inertia.

    WSCVT=wscvt MERCURY=mercury_clumps python3 mercury_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes mercury_scene.txt and
mercury_clumps.png. MERCURY is mercury_clumps.cpp compiled with MercuryDPM: put a copy of it into a new folder
of Drivers/Clump beside a copy of Drivers/Clump/Single/CMakeLists.txt, name the folder in
Drivers/Clump/CMakeLists.txt, and build the target mercury_clumps. Not run for this project, because
Debian has no MercuryDPM: its calls were compared with the engine's public clump drivers.
"""
import collections
import os
import subprocess
import sys

from packing import drops, picture, scans, sphere_mesh, turned, wscvt

folder, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
diameter, width, density, seconds = 0.02, 0.08, 2650, 1.5

clumps = []
for k, scan in enumerate(scans(folder)):
    clumps.append("clump_%d.mclump" % k)
    wscvt("clump", scan, "-k", 20, "--size", diameter, "-o", clumps[-1])

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

packed = collections.defaultdict(list)
for line in text.splitlines():
    if line.startswith("grain "):
        number, *sphere = line.split()[1:]
        packed[number].append([float(v) for v in sphere])
picture("mercury_clumps.png", [sphere_mesh(spheres) for spheres in packed.values()], width)
highest = max(sum(s[2] for s in spheres) / len(spheres) for spheres in packed.values())
print("MercuryDPM clumps: %d grains, highest centre at %.1f diameters" % (len(packed), highest / diameter))
