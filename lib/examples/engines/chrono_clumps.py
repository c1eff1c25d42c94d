# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in Project Chrono's DEM-Engine: each scan of a folder as 20 overlapping spheres, with
the grain's mass and moments of inertia.

    WSCVT=wscvt python3 chrono_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes chrono_clumps.png. Needs
an NVIDIA card and the Python module DEME. Not run for this project, because Debian has no DEM-Engine: its
calls were compared with the engine's public Python examples. chrono_smc_clumps.py needs no such card.
"""
import csv

from packing import arguments, drops, of_each, picture, sphere_mesh, turned, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, density, seconds = 0.02, 0.08, 2650, 2.0

import DEME

engine = DEME.DEMSolver()
engine.SetVerbosity("INFO")
stone = engine.LoadMaterial({"E": 1e7, "nu": 0.3, "CoR": 0.2, "mu": 0.5, "Crr": 0.0})


def template(k, scan):
    name = "clump_%d.chrono.csv" % k
    wscvt("clump", scan, "-k", 20, "--size", diameter, "-o", name)
    lines = open(name).read().splitlines()
    # Volume and moments at unit density are comments below the spheres.
    volume, *moments = (float(v) for line in lines if line.startswith(("# volume", "# Ixx"))
                        for v in line.partition("=")[2].split(","))
    return (engine.LoadClumpType(density * volume, [density * m for m in moments], name, stone),
            [[float(v) for v in row] for row in csv.reader(lines[1:]) if not row[0].startswith("#")])


templates, shapes = zip(*of_each(folder, template))

# A world about the origin, tall enough for all grains, with planes as the box.
places, turns = zip(*drops(count, diameter, width))
height = 2.2 * max(place[2] for place in places)
engine.InstructBoxDomainDimension(2 * width, 2 * width, height)
engine.InstructBoxDomainBoundingBC("none", stone)
for place, normal in (((0, 0, 0), (0, 0, 1)), ((-width / 2, 0, 0), (1, 0, 0)), ((width / 2, 0, 0), (-1, 0, 0)),
                      ((0, -width / 2, 0), (0, 1, 0)), ((0, width / 2, 0), (0, -1, 0))):
    engine.AddBCPlane(list(place), list(normal), stone)
trackers = []
for k, (place, (w, x, y, z)) in enumerate(zip(places, turns)):
    grain = engine.AddClumps(templates[k % len(templates)], [place])
    grain.SetOriQ([x, y, z, w])
    trackers.append(engine.Track(grain))

engine.SetGravitationalAcceleration([0, 0, -9.81])
engine.SetInitTimeStep(1e-5)
engine.SetMaxVelocity(10)
engine.Initialize()
engine.DoDynamicsThenSync(seconds)

grains, highest = [], 0.0
for k, tracker in enumerate(trackers):
    spheres = shapes[k % len(shapes)]
    x, y, z, w = tracker.OriQ()
    centres = turned([s[:3] for s in spheres], tracker.Pos(), (w, x, y, z))
    grains.append(sphere_mesh([(*centre, s[3]) for centre, s in zip(centres, spheres)]))
    highest = max(highest, tracker.Pos()[2])
picture("chrono_clumps.png", grains, width)
print("DEM-Engine clumps: %d grains, highest centre at %.1f diameters" % (count, highest / diameter))
