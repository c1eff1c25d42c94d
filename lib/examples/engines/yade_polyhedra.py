# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of convex polyhedra in Yade: the hull of each scan of a folder, with few faces.

    WSCVT=wscvt yade -n -x yade_polyhedra.py SCANS [COUNT]

COUNT grains, 12 by default, of 20 mm equivalent diameter fall into a box. Writes yade_polyhedra.png.
Yade's polyhedra are convex, and each contact intersects two of them: 60 faces are a good number.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from packing import arguments, drops, of_each, picture, read_obj, turned, wscvt
from yade import (Bo1_Polyhedra_Aabb, Bo1_Wall_Aabb, ForceResetter, Ig2_Polyhedra_Polyhedra_PolyhedraGeom,
                  Ig2_Wall_Polyhedra_PolyhedraGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys, Law2_PolyhedraGeom_PolyhedraPhys_Volumetric,
                  NewtonIntegrator, O, PolyhedraMat, Quaternion, Vector3, log, polyhedra_utils, utils)

folder, count = arguments(__doc__, 12)
diameter, width = 0.02, 0.08


def hull(k, scan):
    name = "hull_%d.obj" % k
    wscvt("convex", scan, "-k", 1, "--faces", 60, "-o", name, "--frame", "principal", "--size", diameter)
    return read_obj(name)


hulls = of_each(folder, hull)
# Where two grains come near each other, Yade warns in each step of a case that it takes rightly.
log.setLevel("Polyhedra_support.cpp", log.ERROR)
material = PolyhedraMat(density=2650, young=1e7, poisson=0.2, frictionAngle=0.6)
O.materials.append(material)
for axis, place, sense in ((2, 0, 1), (0, -width / 2, 1), (0, width / 2, -1), (1, -width / 2, 1),
                           (1, width / 2, -1)):
    O.bodies.append(utils.wall(place, axis=axis, sense=sense, material=material))
grains = []
for k, (place, turn) in enumerate(drops(count, diameter, width)):
    body = polyhedra_utils.polyhedra(material, v=[Vector3(*p) for p in hulls[k % len(hulls)][0]])
    # Yade has moved the vertices to its own centre and axes; the drawing takes them from the body.
    body.state.pos = Vector3(*place)
    body.state.ori = Quaternion(*turn)
    O.bodies.append(body)
    grains.append(body)

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Polyhedra_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop([Ig2_Wall_Polyhedra_PolyhedraGeom(), Ig2_Polyhedra_Polyhedra_PolyhedraGeom()],
                    [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                    [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
    NewtonIntegrator(damping=0.4, gravity=(0, 0, -9.81))]
O.dt = 5e-5
O.run(3000, True)
while O.iter < 30000:
    O.run(500, True)
    speed = max(body.state.vel.norm() for body in grains)
    if speed < 0.01:
        break

drawn = []
for body in grains:
    q, p = body.state.ori, body.state.pos
    faces = list(zip(*[iter(body.shape.GetSurfaceTriangulation())] * 3))
    drawn.append((turned([tuple(v) for v in body.shape.v], p, (q[3], q[0], q[1], q[2])), faces))
picture("yade_polyhedra.png", drawn, width)
print("Yade polyhedra: %d grains, %d steps, %.4f m/s at most, highest centre at %.1f diameters" %
      (count, O.iter, speed, max(body.state.pos[2] for body in grains) / diameter))
sys.stdout.flush()
os._exit(0)
