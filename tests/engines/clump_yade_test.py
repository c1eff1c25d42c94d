# SPDX-License-Identifier: GPL-3.0-or-later
# yade -n -x clump_yade_test.py, in the folder of clump.py and clump.json. Checks that the clump has all
# spheres, the grain's mass and its moments, and comes to rest on a wall.
import json
import os
import sys

sys.path.insert(0, os.getcwd())
from yade import (Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
                  Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator, O,
                  utils)
import clump


def check(holds, sentence):
    if not holds:
        print("FAILED: " + sentence)
        sys.stdout.flush()
        os._exit(1)


report = json.load(open("clump.json"))
scale = (clump.volume / report["grain"]["volume"]) ** (1 / 3)
O.materials.append(FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=2650.0))
O.bodies.append(utils.wall((0, 0, 0), axis=2))
number, members = clump.add(position=(0, 0, 0.1), density=2650.0)
check(len(members) == report["sphere_count"], "Yade holds every sphere.")
state = O.bodies[number].state
check(abs(state.mass / (2650 * clump.volume) - 1) < 1e-9, "The mass is the grain's.")
check(abs(sum(state.inertia) / (2650 * sum(clump.moments)) - 1) < 1e-9, "The moments are the grain's.")
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
             InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                             [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
             NewtonIntegrator(damping=0.4, gravity=(0, 0, -9.81), exactAsphericalRot=True)]
O.dt = 2e-5
O.run(60000, True)
lowest = min(O.bodies[m].state.pos[2] - O.bodies[m].shape.radius for m in members)
check(-1e-3 < lowest < 1e-3, "The clump lies on the wall: %g" % lowest)
check(state.vel.norm() < 0.05, "It rests: %g" % state.vel.norm())
print("Yade: clump of %d spheres, at rest %.1e m above the wall" % (len(members), lowest))
sys.stdout.flush()
os._exit(0)
