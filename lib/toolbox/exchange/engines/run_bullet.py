# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of convex parts of this folder in Bullet:

    python3 run.py [COUNT]

Compiles bullet_settle.cpp against Bullet's C++ library. Bullet's contact margins are made for bodies of
decimetres, so the model has grains of 0.2 m in the mean, and times follow. See packing.py for scene.json.
"""
import math

import packing
from packing import np

SIZE, GRAVITY = 0.2, 9.81  # of the model

scene = packing.Scene()
length = SIZE / scene.mean_diameter
pace = math.sqrt(scene.mean_diameter / scene.gravity) / math.sqrt(SIZE / GRAVITY)  # time / the model's
density = 2650 / scene.material["density"]
sides = 4 if scene.shape == "box" else 32
unit = 1 / density / length ** 5 / pace ** 2  # of energy
rest = scene.energy_at_rest() / unit
with open("packing.scene", "w") as file:
    print(sides, length * scene.width / 2, scene.longest_time() / pace, scene.fall_time() / pace, rest,
          math.sqrt(scene.material["friction"]), file=file)  # Bullet multiplies those of two bodies
    for grain in scene.grains:
        print(density * grain.mass * length ** 3, *(density * length ** 5 * grain.moments), *(length * grain.place),
              *grain.turn, len(grain.shape.parts), file=file)
        for vertices, _ in grain.shape.parts:
            print(len(vertices), *(length * grain.scale * vertices).ravel(), file=file)
packing.run("g++", "-O2", "-isystem", "/usr/include/bullet", packing.FOLDER / "bullet_settle.cpp", "-o",
            "./bullet_settle", "-lBulletDynamics", "-lBulletCollision", "-lLinearMath")
rows, seconds = packing.outcome("./bullet_settle")
for grain, row in zip(scene.grains, np.array(rows["grain"])):
    grain.place, grain.turn = row[:3] / length, row[3:]
packing.finish("Bullet", scene, [grain.parts() for grain in scene.grains], [grain.place for grain in scene.grains],
               [(time * pace, energy * unit) for time, energy in rows["energy"]], seconds, rows["contact"])
