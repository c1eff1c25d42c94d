# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of this folder in Project Chrono's DEM-Engine:

    python3 run.py [COUNT]

Needs an NVIDIA card and the Python module DEME. Not run for wscvt: its calls were compared with the engine's
C++ interface and public Python scripts. See packing.py for scene.json.
"""
import math
import time

import packing
from packing import np

try:
    import DEME
except ImportError:
    packing.leave("The Python module DEME is not installed.")

scene = packing.Scene()
given, half = scene.material, scene.width / 2
engine = DEME.DEMSolver()
engine.SetVerbosity("ERROR")
stone = engine.LoadMaterial({"E": given["young_modulus"], "nu": given["poisson_ratio"], "CoR": given["restitution"],
                             "mu": given["friction"], "Crr": 0.0})
height, count = 2.2 * scene.top, 4 if scene.shape == "box" else 32
engine.InstructBoxDomainDimension(4 * half, 4 * half, height)
engine.InstructBoxDomainBoundingBC("none", stone)
engine.AddBCPlane([0, 0, 0], [0, 0, 1], stone)
for k in range(count):
    x, y = math.cos(2 * math.pi * k / count), math.sin(2 * math.pi * k / count)
    engine.AddBCPlane([half * x, half * y, 0], [-x, -y, 0], stone)
templates, trackers = {}, []
for grain in scene.grains:
    key = grain.shape.name, grain.scale
    if key not in templates:
        name = "template_%d.csv" % len(templates)
        np.savetxt(name, grain.scale * grain.shape.spheres, "%.9g", ",", header="x,y,z,r", comments="")
        templates[key] = engine.LoadClumpType(grain.mass, list(map(float, grain.moments)), name, stone)
    w, x, y, z = map(float, grain.turn)
    body = engine.AddClumps(templates[key], [list(map(float, grain.place))])
    body.SetOriQ([x, y, z, w])
    trackers.append(engine.Track(body))
smallest = min(grain.diameter for grain in scene.grains)
engine.SetGravitationalAcceleration([0, 0, -scene.gravity])
engine.SetInitTimeStep(0.05 * smallest * math.sqrt(given["density"] / given["young_modulus"]))
engine.SetMaxVelocity(2 * math.sqrt(2 * scene.gravity * scene.top))
engine.Initialize()

began, now, kinetic = time.process_time(), 0.0, []
while now < scene.longest_time():
    engine.DoDynamicsThenSync(2 * math.sqrt(smallest / scene.gravity))
    now += 2 * math.sqrt(smallest / scene.gravity)
    kinetic.append((now, sum(0.5 * grain.mass * np.square(tracker.Vel()).sum() +
                             0.5 * (grain.moments * np.square(tracker.AngVelLocal())).sum()
                             for grain, tracker in zip(scene.grains, trackers))))
    if now > scene.fall_time() and kinetic[-1][1] < scene.energy_at_rest():
        break
for grain, tracker in zip(scene.grains, trackers):
    x, y, z, w = tracker.OriQ()
    grain.place, grain.turn = np.array(tracker.Pos()), np.array([w, x, y, z])
packing.finish("DEM-Engine", scene, [grain.spheres() for grain in scene.grains],
               [grain.place for grain in scene.grains], kinetic, time.process_time() - began)
