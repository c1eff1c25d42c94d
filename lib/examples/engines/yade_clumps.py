# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in Yade: each scan of a folder as 20 overlapping spheres, with the grain's mass and
moments of inertia.

    WSCVT=wscvt yade -n -x yade_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes yade_clumps.png.
"""
import importlib
import os
import sys

sys.path[:0] = [os.path.dirname(os.path.abspath(sys.argv[0])), os.getcwd()]
from packing import arguments, drops, of_each, picture, sphere_mesh, wscvt
from yade import (Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
                  Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator, O,
                  Quaternion, utils)

folder, count = arguments(__doc__, 20)
diameter, width, density = 0.02, 0.08, 2650


def clump(k, scan):
    wscvt("clump", scan, "-k", 20, "--size", diameter, "-o", "clump_%d.py" % k)
    return importlib.import_module("clump_%d" % k)


clumps = of_each(folder, clump)
material = FrictMat(young=1e7, poisson=0.3, frictionAngle=0.5, density=density)
O.materials.append(material)
for axis, place in ((2, 0), (0, -width / 2), (0, width / 2), (1, -width / 2), (1, width / 2)):
    O.bodies.append(utils.wall(place, axis=axis, material=material))
grains = []
for k, (place, turn) in enumerate(drops(count, diameter, width)):
    number, members = clumps[k % len(clumps)].add(place, Quaternion(*turn), material, density)
    grains.append((O.bodies[number], [O.bodies[m] for m in members]))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.4, gravity=(0, 0, -9.81), exactAsphericalRot=True)]
O.dt = 2e-5
O.run(10000, True)
while O.iter < 60000 and max(grain.state.vel.norm() for grain, _ in grains) > 0.01:
    O.run(1000, True)

spheres = [[(*body.state.pos, body.shape.radius) for body in members] for _, members in grains]
picture("yade_clumps.png", [sphere_mesh(rows) for rows in spheres], width)
print("Yade clumps: %d grains, %d steps, %.4f m/s at most, highest centre at %.1f diameters" %
      (count, O.iter, max(grain.state.vel.norm() for grain, _ in grains),
       max(grain.state.pos[2] for grain, _ in grains) / diameter))
sys.stdout.flush()
os._exit(0)
