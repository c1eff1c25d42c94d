# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of level sets in Yade, with contacts that conserve energy: each scan of a folder as a grid of
distances and 100 nodes.

    WSCVT=wscvt yade -n -x yade_level_set.py SCANS [COUNT]

COUNT grains, 8 by default, of 20 mm equivalent diameter fall into a box. Writes yade_level_set.png. The grain
and its contact law are those of ../../../tests/engines.
"""
import os
import pathlib
import sys

here = pathlib.Path(os.path.abspath(sys.argv[0])).parent
sys.path[:0] = [str(here), str(here / "../../../tests/engines")]
from packing import arguments, drops, of_each, picture, read_obj, turned, wscvt
from yade import (Bo1_LevelSet_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_LevelSet_LevelSet_ScGeom,
                  Ig2_Wall_LevelSet_ScGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker,
                  NewtonIntegrator, O, PyRunner, Quaternion, Vector3, utils)
from yade_contacts import GrainContacts
from yade_grain import Grain

folder, count = arguments(__doc__, 8)
diameter, width, stiffness, friction = 0.02, 0.08, 1e4, 0.5


def level_set(k, scan):
    name = "grain_%d" % k
    wscvt("remesh", scan, name + ".obj", "-n", 100, "--frame", "principal", "--size", diameter,
          "--node-table", name + ".csv", "--sdf", name + ".npy", "--sdf-spacing", diameter / 20)
    return Grain(name + ".csv", name + ".npy"), read_obj(name + ".obj")


grains, meshes = zip(*of_each(folder, level_set))
wall, stone = (FrictMat(young=1e8, poisson=0.3, frictionAngle=0.46, density=2650, label=name)
               for name in ("wall", "stone"))
for material in (wall, stone):
    O.materials.append(material)
for axis, place in ((2, 0), (0, -width / 2), (0, width / 2), (1, -width / 2), (1, width / 2)):
    O.bodies.append(utils.wall(place, axis=axis, material=wall))
bodies = []
for k, (place, turn) in enumerate(drops(count, diameter, width)):
    w, x, y, z = turn
    bodies.append(grains[k % len(grains)].body(Vector3(*place), Quaternion(w, x, y, z), material=stone))
    O.bodies.append(bodies[-1])

contacts = GrainContacts(grains[0], stiffness, 0.5 * stiffness, friction)


def between(value):
    """Yade's own law acts at the walls only."""
    return MatchMaker(matches=((wall.id, stone.id, value),), algo="val", val=0)


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_LevelSet_Aabb(), Bo1_Wall_Aabb()], verletDist=0),
    InteractionLoop([Ig2_LevelSet_LevelSet_ScGeom(), Ig2_Wall_LevelSet_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys(kn=between(stiffness), ks=between(0.5 * stiffness),
                                                     frictAngle=MatchMaker(algo="val", val=0.46))],
                    [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
    PyRunner(command="contacts.apply()", iterPeriod=1),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81), exactAsphericalRot=True)]
O.dt = 5e-5
O.run(4000, True)
while O.iter < 16000 and max(body.state.vel.norm() for body in bodies) > 0.01:
    O.run(500, True)

drawn = []
for k, body in enumerate(bodies):
    q, (vertices, faces) = body.state.ori, meshes[k % len(meshes)]
    drawn.append((turned(vertices, body.state.pos, (q[3], q[0], q[1], q[2])), faces))
picture("yade_level_set.png", drawn, width)
print("Yade level sets: %d grains, %d steps, %.4f m/s at most, highest centre at %.1f diameters" %
      (count, O.iter, max(body.state.vel.norm() for body in bodies),
       max(body.state.pos[2] for body in bodies) / diameter))
sys.stdout.flush()
os._exit(0)
