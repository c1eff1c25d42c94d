# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of level sets in Yade, with contacts that conserve energy: each scan of a folder as a grid of
distances and 100 nodes.

    WSCVT=wscvt yade -n -x yade_level_set.py SCANS [COUNT]

COUNT grains, 8 by default, of 20 mm equivalent diameter fall into a box. Writes yade_level_set.png. The grain
and its contact law are those of ../../../tests/engines. SCANS is a folder of meshes (.ply .stl .obj .off .vtp).
"""
import math
import os
import pathlib
import random
import subprocess
import sys

here = pathlib.Path(os.path.abspath(sys.argv[0])).parent
sys.path[:0] = [str(here / "../../../tests/engines")]
import numpy as np
from yade import (Bo1_LevelSet_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_LevelSet_LevelSet_ScGeom,
                  Ig2_Wall_LevelSet_ScGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker,
                  NewtonIntegrator, O, PyRunner, Quaternion, Vector3, utils)
from yade_contacts import GrainContacts
from yade_grain import Grain

WSCVT = os.environ.get("WSCVT", "wscvt")
diameter, width, stiffness, friction = 0.02, 0.08, 1e4, 0.5


def leave(sentence):
    """Ends the script with exit code 2; Yade keeps sys.exit from its caller."""
    print(sentence, file=sys.stderr, flush=True)
    os._exit(2)


def read_obj(path):
    """Vertices and triangles of an OBJ file, whose faces name vertices alone."""
    rows = [line.split() for line in open(path)]
    return (np.array([[float(w) for w in row[1:4]] for row in rows if row[:1] == ["v"]]),
            np.array([[int(w) - 1 for w in row[1:4]] for row in rows if row[:1] == ["f"]]))


def level_sets(folder):
    """The grain and the mesh of each scan. A scan that wscvt refuses is left out, with a line."""
    made = []
    for scan in sorted(p for p in folder.iterdir() if p.suffix.lower() in (".ply", ".stl", ".obj", ".off", ".vtp")):
        name = "grain_%d" % len(made)
        try:
            subprocess.run([WSCVT, "remesh", str(scan), name + ".obj", "-n", "100", "--frame", "principal", "--size",
                            str(diameter), "--node-table", name + ".csv", "--sdf", name + ".npy", "--sdf-spacing",
                            str(diameter / 20), "-q"], check=True)
        except OSError:
            leave("\"%s\" does not run. Set the variable WSCVT to the path of wscvt." % WSCVT)
        except subprocess.CalledProcessError:
            print("Left out: %s" % scan, file=sys.stderr)
            continue
        made.append((Grain(name + ".csv", name + ".npy"), read_obj(name + ".obj")))
    return made or leave("%s holds no scan that wscvt takes." % folder)


def drops(count):
    """Places above the ground in the box, layer on layer, and random turns. Grains so far apart do not touch."""
    step, chance = 1.5 * diameter, random.Random(1)
    side = int(width / step)
    for k in range(count):
        i, j, layer = k % side, k // side % side, k // side ** 2
        turn = Quaternion(*[chance.gauss(0, 1) for _ in range(4)])
        turn.normalize()
        yield Vector3((i - (side - 1) / 2) * step, (j - (side - 1) / 2) * step, (layer + 0.8) * step), turn


def picture(path, grains):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    axes = pyplot.figure(figsize=(8, 8)).add_subplot(projection="3d")
    for k, (vertices, faces) in enumerate(grains):
        axes.add_collection3d(Poly3DCollection(vertices[faces], facecolor=pyplot.cm.tab20(k % 20),
                                               edgecolor=(0, 0, 0, 0.3), linewidth=0.2))
    axes.set(xlim=(-width / 2, width / 2), ylim=(-width / 2, width / 2), zlim=(0, width))
    axes.set_box_aspect((1, 1, 1))
    pyplot.savefig(path, dpi=100)


words = sys.argv[1:]
folder, count = pathlib.Path(words[0]) if words else None, words[1] if len(words) > 1 else "8"
if folder is None or len(words) > 2 or not folder.is_dir() or not count.isdigit() or int(count) == 0:
    leave(__doc__.strip())
if folder.resolve() == pathlib.Path.cwd():
    leave("Run this in another folder than that of the scans, because it writes meshes.")
count, made = int(count), level_sets(folder)
wall, stone = (FrictMat(young=1e8, poisson=0.3, frictionAngle=0.46, density=2650, label=name)
               for name in ("wall", "stone"))
for material in (wall, stone):
    O.materials.append(material)
for axis, place in ((2, 0), (0, -width / 2), (0, width / 2), (1, -width / 2), (1, width / 2)):
    O.bodies.append(utils.wall(place, axis=axis, material=wall))
bodies = []
for k, (place, turn) in enumerate(drops(count)):
    bodies.append(made[k % len(made)][0].body(place, turn, material=stone))
    O.bodies.append(bodies[-1])

contacts = GrainContacts(made[0][0], stiffness, 0.5 * stiffness, friction)


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
    vertices, faces = made[k % len(made)][1]
    turn = np.array(body.state.ori.toRotationMatrix()).reshape(3, 3)
    drawn.append((vertices @ turn.T + np.array(tuple(body.state.pos)), faces))
picture("yade_level_set.png", drawn)
print("Yade level sets: %d grains, %d steps, %.4f m/s at most, highest centre at %.1f diameters" %
      (count, O.iter, max(body.state.vel.norm() for body in bodies),
       max(body.state.pos[2] for body in bodies) / diameter))
sys.stdout.flush()
os._exit(0)
