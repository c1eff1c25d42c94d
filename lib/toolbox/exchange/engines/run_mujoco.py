# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of convex parts of this folder in MuJoCo:

    python3 run.py [COUNT]

Writes packing.xml, which MuJoCo's viewer opens too. Takes MuJoCo's Python module, or else compiles
mujoco_settle.cpp against its C library. MuJoCo's limits are made for bodies of decimetres, so the model has
grains of 0.2 m in the mean, and times follow. See packing.py for scene.json.
"""
import math
import resource
import xml.etree.ElementTree as xml

import packing
from packing import np

SIZE, GRAVITY = 0.2, 9.81  # of the model

scene = packing.Scene()
length = SIZE / scene.mean_diameter
pace = math.sqrt(scene.mean_diameter / scene.gravity) / math.sqrt(SIZE / GRAVITY)  # time / the model's
model = xml.fromstring("""
<mujoco model="packing">
  <compiler inertiafromgeom="false"/>
  <option timestep="0.0015" gravity="0 0 -9.81" jacobian="sparse" cone="elliptic"><flag energy="enable"/></option>
  <size njmax="%d" nconmax="%d" nstack="20000000"/>
  <default><geom friction="%r" solref="0.006 1"/></default>
  <asset/>
  <worldbody><geom type="plane" size="0 0 1"/></worldbody>
</mujoco>""" % (
    30 * len(scene.grains) + 2000, 10 * len(scene.grains) + 700, scene.material["friction"]))
assets, world = model.find("asset"), model.find("worldbody")


def text(values):
    return " ".join("%.9g" % v for v in values)


sides = 4 if scene.shape == "box" else 32
for k in range(sides):
    angle = 2 * math.pi * k / sides
    normal = np.array([round(math.cos(angle), 12), round(math.sin(angle), 12), 0])
    xml.SubElement(world, "geom", type="plane", size="0 0 1", zaxis=text(-normal),
                   pos=text(length * scene.width / 2 * normal))
for k, grain in enumerate(scene.grains):
    body = xml.SubElement(world, "body", name="grain_%d" % k, pos=text(length * grain.place), quat=text(grain.turn))
    xml.SubElement(body, "freejoint")
    density = 2650 / scene.material["density"]
    xml.SubElement(body, "inertial", pos="0 0 0", mass="%.9g" % (density * grain.mass * length ** 3),
                   diaginertia=text(density * length ** 5 * grain.moments))
    for j, (vertices, _) in enumerate(grain.shape.parts):
        name = "%d_%d" % (k, j)
        xml.SubElement(assets, "mesh", name=name, vertex=text((length * grain.scale * vertices).ravel()))
        xml.SubElement(body, "geom", type="mesh", mesh=name)
xml.ElementTree(model).write("packing.xml")

unit = (scene.material["density"] / 2650) / length ** 5 / pace ** 2  # of energy
seconds, rest = scene.longest_time() / pace, scene.energy_at_rest() / unit
try:
    import mujoco
    m = mujoco.MjModel.from_xml_path("packing.xml")
    data = mujoco.MjData(m)
    kinetic = []
    while data.time < seconds:
        for _ in range(100):
            mujoco.mj_step(m, data)
        kinetic.append((data.time, data.energy[1]))
        if data.time > scene.fall_time() / pace and kinetic[-1][1] < rest:
            break
    rows = data.qpos.reshape(-1, 7)
    owner = [m.geom_bodyid[g] - 1 for g in range(m.ngeom)]
    contacts = [(owner[c.geom1], owner[c.geom2]) for c in data.contact]
    usage = resource.getrusage(resource.RUSAGE_SELF)
    used = usage.ru_utime + usage.ru_stime
except ImportError:
    packing.run("g++", "-O2", packing.FOLDER / "mujoco_settle.cpp", "-o", "./mujoco_settle", "-lmujoco")
    found, used = packing.outcome("./mujoco_settle", "packing.xml", str(seconds), str(scene.fall_time() / pace),
                                  str(rest))
    rows, kinetic, contacts = np.array(found["grain"]), found["energy"], found["contact"]
for grain, row in zip(scene.grains, rows):
    grain.place, grain.turn = row[:3] / length, row[3:]
packing.finish("MuJoCo", scene, [grain.parts() for grain in scene.grains], [grain.place for grain in scene.grains],
               [(t * pace, e * unit) for t, e in kinetic], used,
               [pair for pair in contacts if min(pair) >= 0])
