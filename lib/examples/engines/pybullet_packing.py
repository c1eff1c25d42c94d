# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of convex parts in PyBullet: each scan of a folder as at most four.

    WSCVT=wscvt python3 pybullet_packing.py SCANS [COUNT]

COUNT grains, 20 by default, of 0.2 m equivalent diameter fall into a box: Bullet's contact margins are
made for such sizes. Writes pybullet.png. Not run for this project, because Debian has no PyBullet.
"""
import sys

import pybullet
from packing import drops, picture, read_obj, scans, turned, wscvt

folder, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
diameter, width = 0.2, 0.8

files, shapes = [], []
for scan in scans(folder):
    name = scan.stem + "_parts"
    wscvt("convex", scan, "-k", 4, "-n", 300, "--faces", 60, "-o", name + ".urdf", "-o", name + ".obj",
          "--density", 2650, "--frame", "principal", "--size", diameter)
    files.append(name + ".urdf")
    shapes.append(read_obj(name + ".obj"))

pybullet.connect(pybullet.DIRECT)
pybullet.setGravity(0, 0, -9.81)
pybullet.setTimeStep(1 / 1000)
for normal, place in (((0, 0, 1), (0, 0, 0)), ((1, 0, 0), (-width / 2, 0, 0)), ((-1, 0, 0), (width / 2, 0, 0)),
                      ((0, 1, 0), (0, -width / 2, 0)), ((0, -1, 0), (0, width / 2, 0))):
    plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, planeNormal=normal)
    pybullet.createMultiBody(0, plane, basePosition=place)
bodies = []
for k, (place, (w, x, y, z)) in enumerate(drops(count, diameter, width)):
    # Without the flag Bullet takes a box for the inertia.
    body = pybullet.loadURDF(files[k % len(files)], basePosition=place, baseOrientation=(x, y, z, w),
                             flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
    pybullet.changeDynamics(body, -1, lateralFriction=0.6)
    bodies.append(body)
for _ in range(6000):
    pybullet.stepSimulation()

drawn = []
for k, body in enumerate(bodies):
    # The place of the centre of mass, which is the origin in principal axes.
    place, (x, y, z, w) = pybullet.getBasePositionAndOrientation(body)
    vertices, faces = shapes[k % len(shapes)]
    drawn.append((turned(vertices, place, (w, x, y, z)), faces))
picture("pybullet.png", drawn, width)
