# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of convex parts in Bullet: each scan of a folder as at most four.

    WSCVT=wscvt python3 bullet_packing.py SCANS [COUNT]

COUNT grains, 20 by default, of 0.2 m equivalent diameter fall into a box: Bullet's contact margins are
made for such sizes. Writes bullet_packing.png. Takes PyBullet, or else compiles bullet_settle.cpp against Bullet's
C++ library.
"""
import pathlib
import subprocess
import xml.etree.ElementTree as xml

from packing import arguments, drops, of_each, picture, read_obj, turned, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, seconds, friction = 0.2, 0.8, 12.0, 0.6


def grain(k, scan):
    name = "parts_%d" % k
    wscvt("convex", scan, "-k", 4, "-n", 300, "--faces", 60, "-o", name + ".urdf", "-o", name + ".obj",
          "--density", 2650, "--frame", "principal", "--size", diameter)
    return name, read_obj(name + ".obj")


def by_python(pybullet):
    """Place and turn (w, x, y, z) of each grain in the end, and the largest speed."""
    pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -9.81)
    for normal, place in (((0, 0, 1), (0, 0, 0)), ((1, 0, 0), (-width / 2, 0, 0)), ((-1, 0, 0), (width / 2, 0, 0)),
                          ((0, 1, 0), (0, -width / 2, 0)), ((0, -1, 0), (0, width / 2, 0))):
        plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, planeNormal=normal)
        pybullet.changeDynamics(pybullet.createMultiBody(0, plane, basePosition=place), -1,
                                lateralFriction=friction)
    bodies = []
    for k, (place, (w, x, y, z)) in enumerate(drops(count, diameter, width)):
        # Without the flag Bullet takes a box for the inertia.
        bodies.append(pybullet.loadURDF(names[k % len(names)] + ".urdf", basePosition=place,
                                        baseOrientation=(x, y, z, w), flags=pybullet.URDF_USE_INERTIA_FROM_FILE))
        pybullet.changeDynamics(bodies[-1], -1, lateralFriction=friction)
    for _ in range(int(seconds * 240)):
        pybullet.stepSimulation()
    # The place of the centre of mass, which is the origin in principal axes.
    rows = [(*p, w, x, y, z) for p, (x, y, z, w) in map(pybullet.getBasePositionAndOrientation, bodies)]
    return rows, max(sum(v * v for v in pybullet.getBaseVelocity(body)[0]) ** 0.5 for body in bodies)


def by_library():
    """The same by the C++ library: a scene of lines "parts mass Ixx Iyy Izz x y z qw qx qy qz"."""
    with open("bullet_scene.txt", "w") as scene:
        print(width, seconds, friction, file=scene)
        for k, (place, turn) in enumerate(drops(count, diameter, width)):
            name = names[k % len(names)]
            inertial = xml.parse(name + ".urdf").find(".//inertial")
            moments = [inertial.find("inertia").get(key) for key in ("ixx", "iyy", "izz")]
            print(name, inertial.find("mass").get("value"), *moments, *place, *turn, file=scene)
    source = pathlib.Path(__file__).with_name("bullet_settle.cpp")
    subprocess.run(["g++", "-O1", "-isystem", "/usr/include/bullet", source, "-o", "./bullet_settle",
                    "-lBulletDynamics", "-lBulletCollision", "-lLinearMath"], check=True)
    text = subprocess.run("./bullet_settle", check=True, capture_output=True, text=True).stdout
    *rows, (speed,) = [[float(v) for v in line.split()] for line in text.splitlines()]
    return rows, speed


names, shapes = zip(*of_each(folder, grain))
try:
    import pybullet
    settled, fastest = by_python(pybullet)
except ImportError:
    settled, fastest = by_library()
picture("bullet_packing.png", [(turned(shapes[k % len(shapes)][0], row[:3], row[3:]), shapes[k % len(shapes)][1])
                       for k, row in enumerate(settled)], width)
print("Bullet: %d grains of convex parts, %.4f m/s at most, highest centre at %.1f diameters" %
      (count, fastest, max(row[2] for row in settled) / diameter))
