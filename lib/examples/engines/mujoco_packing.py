# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of convex parts in MuJoCo: each scan of a folder as at most four.

    WSCVT=wscvt python3 mujoco_packing.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes mujoco_packing.png. Takes
MuJoCo's Python module, or else compiles mujoco_settle.cpp against MuJoCo's C library.
"""
import pathlib
import subprocess
import xml.etree.ElementTree as xml

from packing import arguments, drops, of_each, picture, read_obj, turned, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, seconds = 0.02, 0.08, 2.0

scene = xml.fromstring("""
<mujoco model="packing">
  <compiler inertiafromgeom="false"/>
  <option timestep="0.0005" gravity="0 0 -9.81"/>
  <size njmax="4000" nconmax="1000"/>
  <default><geom friction="0.6" solref="0.002 1"/></default>
  <asset/>
  <worldbody><geom type="plane" size="1 1 0.1"/></worldbody>
</mujoco>""")
assets, world = scene.find("asset"), scene.find("worldbody")
for axis in ("1 0", "-1 0", "0 1", "0 -1"):
    x, y = map(int, axis.split())
    xml.SubElement(world, "geom", type="plane", size="1 1 0.1", zaxis="%d %d 0" % (x, y),
                   pos="%g %g 0" % (-x * width / 2, -y * width / 2))


def grain_of(k, scan):
    files = ["parts_%d%s" % (k, ending) for ending in (".xml", ".obj")]
    wscvt("convex", scan, "-k", 4, "-n", 300, "--faces", 60, "-o", files[0], "-o", files[1], "--density", 2650,
          "--frame", "principal", "--size", diameter)
    grain = xml.parse(files[0]).getroot()
    for mesh in grain.find("asset"):
        mesh.set("name", "%d_%s" % (k, mesh.get("name")))
        assets.append(mesh)
    for geom in grain.iter("geom"):
        geom.set("mesh", "%d_%s" % (k, geom.get("mesh")))
    return grain.find("worldbody/body"), read_obj(files[1])


grains, shapes = zip(*of_each(folder, grain_of))
for k, (place, turn) in enumerate(drops(count, diameter, width)):
    body = xml.fromstring(xml.tostring(grains[k % len(grains)]))
    body.set("name", "grain_%d" % k)
    body.set("pos", " ".join("%.9g" % v for v in place))
    body.set("quat", " ".join("%.9g" % v for v in turn))
    world.append(body)
xml.ElementTree(scene).write("mujoco_scene.xml")

try:
    import mujoco
    model = mujoco.MjModel.from_xml_path("mujoco_scene.xml")
    data = mujoco.MjData(model)
    while data.time < seconds:
        mujoco.mj_step(model, data)
    rows = data.qpos.reshape(-1, 7).tolist()
    speed = abs(data.qvel.reshape(-1, 6)[:, :3]).max()
except ImportError:
    source = pathlib.Path(__file__).with_name("mujoco_settle.cpp")
    subprocess.run(["g++", "-O1", source, "-o", "./mujoco_settle", "-lmujoco"], check=True)
    text = subprocess.run(["./mujoco_settle", "mujoco_scene.xml", str(seconds)], check=True,
                          capture_output=True, text=True).stdout
    *rows, (speed,) = [[float(v) for v in line.split()] for line in text.splitlines()]
picture("mujoco_packing.png", [(turned(shapes[k % len(shapes)][0], row[:3], row[3:]), shapes[k % len(shapes)][1])
                       for k, row in enumerate(rows)], width)
print("MuJoCo: %d grains of convex parts, %.4f m/s at most, highest centre at %.1f diameters" %
      (count, speed, max(row[2] for row in rows) / diameter))
