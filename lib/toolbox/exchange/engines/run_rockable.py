# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of this folder in Rockable, convex parts rounded by a sphere:

    python3 run.py [COUNT]

Writes shapes.shp and input.txt, and starts `rockable`. See packing.py for scene.json. Writes exadem.msp too, for
exaDEM, which reads the same two files; it was compared with exaDEM's public examples and not run.
"""
import math
import pathlib
import subprocess
import time

import packing
from packing import np

DAMPING = 0.2  # Rockable's numerical damping of forces

scene = packing.Scene()
given, size = scene.material, scene.mean_diameter
walls, side = [], math.hypot(scene.width, scene.top)
turns = 4 if scene.shape == "box" else 32
for k in range(turns):  # the wall's z axis, upwards at first, looks outwards, and its x axis down
    angle, half = math.pi * k / turns, math.sqrt(0.5)
    walls.append((half * math.cos(angle), -half * math.sin(angle), half * math.cos(angle), half * math.sin(angle)))
names, texts = {}, []
for grain in scene.grains:
    if grain.shape.name not in names:
        names[grain.shape.name] = "grain_%d" % len(names)
        text = (packing.FOLDER / grain.shape.file).read_text().split("\n")
        texts.append("\n".join("name " + names[grain.shape.name] if line[:5] == "name " else line for line in text))
thickness = 0.05 * size
texts.append("<\nname wall\nradius {0!r}\npreCompDone y\nnv 4\n{1!r} {1!r} 0\n-{1!r} {1!r} 0\n-{1!r} -{1!r} 0\n"
             "{1!r} -{1!r} 0\nne 4\n0 1\n1 2\n2 3\n3 0\nnf 1\n4 0 1 2 3\nobb.extent {2!r} {2!r} {0!r}\n"
             "obb.e1 1 0 0\nobb.e2 0 1 0\nobb.e3 0 0 1\nobb.center 0 0 0\nvolume 1\nI/m 1 1 1\n>\n".format(
                 thickness, side, side + thickness))
pathlib.Path("shapes.shp").write_text("\n".join(texts))

# Bodies pass through each other if they overlap by more than the spheres that round them. The fastest
# fall overlaps by half of the least.
least = min(grain.shape.rounding * grain.scale for grain in scene.grains)
speed = math.sqrt(2 * scene.gravity * scene.top)
masses = [grain.mass for grain in scene.grains]
stiffness = max(given["young_modulus"] * size, max(masses) * (2 * speed / least) ** 2)
step = 0.05 * math.sqrt(min(masses) / stiffness)
near = 0.05 * size
often = max(1, round(2 * math.sqrt(size / scene.gravity) / step))


def rows():
    still, at_rest = "0 0 0 0 0 0 ", " 0 0 0 0 0 0"  # velocity and acceleration; those of turning
    yield "wall 0 0 1 0 0 %r %s1 0 0 0%s" % (-thickness, still, at_rest)
    for k, turn in enumerate(walls):
        angle, away = 2 * math.pi * k / turns, scene.width / 2 + thickness
        yield "wall 0 0 1 %r %r 0 %s%r %r %r %r%s" % (
            (away * math.cos(angle), away * math.sin(angle), still) + turn + (at_rest,))
    for grain in scene.grains:
        yield "%s 1 0 %r %r %r %r %s%r %r %r %r%s" % (
            (names[grain.shape.name], grain.scale) + tuple(map(float, grain.place)) + (still,) +
            tuple(map(float, grain.turn)) + (at_rest,))


def law(name, value):
    return "%s 0 1 %r\n%s 1 1 %r\n" % (name, value, name, value)


particles = list(rows())
pathlib.Path("input.txt").write_text(
    "Rockable 21-08-2022\nt 0\ntmax {tmax!r}\ndt {step!r}\ninterVerlet {verlet!r}\ninterConf {often!r}\n"
    "DVerlet {far!r}\ndVerlet {near!r}\ndensity 0 1\ndensity 1 {density!r}\ngravity 0 0 {gravity!r}\n"
    "numericalDampingCoeff {damping!r}\nforceLaw Default\n{laws}precision 12\niconf 0\nnDriven {driven}\n"
    "shapeFile shapes.shp\nParticles {count}\n{particles}\n".format(
        tmax=scene.longest_time(), step=step, verlet=0.5 * near / speed, often=often * step, far=2 * near, near=near,
        density=given["density"], gravity=-scene.gravity, damping=DAMPING,
        laws=law("knContact", stiffness) + law("en2Contact", given["restitution"] ** 2) +
        law("ktContact", 0.8 * stiffness) + law("muContact", given["friction"]) + law("krContact", 0.0) +
        law("murContact", 0.0),
        driven=1 + len(walls), count=len(particles), particles="\n".join(particles)))

cell = 2.2 * max(grain.radius for grain in scene.grains)
sides = [math.ceil(length / cell) + 2 for length in (scene.width, scene.width, scene.top)]
contact = "{ rcut: 0 m, dncut: 0 m, kn: %.9g, kt: %.9g, kr: 0, fc: 0, mu: %.9g, damp_rate: 0.9 }" % (
    stiffness, 0.8 * stiffness, given["friction"])
pathlib.Path("exadem.msp").write_text(
    "grid_flavor: grid_flavor_dem\n\nincludes:\n  - config_polyhedra.msp\n\ninput_data:\n  - read_conf_rockable:\n"
    "     filename: input.txt\n\ncompute_force:\n  - gravity_force:\n     gravity: [0, 0, {gravity!r}]\n"
    "  - contact_polyhedron:\n     config: {contact}\n     config_driver: {contact}\n\n"
    "iteration_dump_writer:\n  - write_conf_rockable\n\ndomain:\n  cell_size: {cell!r} m\n"
    "  periodic: [false, false, false]\n  grid_dims: {sides}\n"
    "  bounds: [[{low!r} m, {low!r} m, {below!r} m], [{x!r} m, {y!r} m, {z!r} m]]\n  expandable: true\n\nglobal:\n"
    "  simulation_dump_frequency: {often}\n  simulation_end_iteration: {steps}\n  simulation_log_frequency: {often}\n"
    "  simulation_paraview_frequency: {often}\n  rcut_inc: {near!r} m\n".format(
        gravity=-scene.gravity, contact=contact, cell=cell, sides=sides, low=-scene.width / 2 - cell, below=-cell,
        x=-scene.width / 2 - cell + sides[0] * cell, y=-scene.width / 2 - cell + sides[1] * cell,
        z=-cell + sides[2] * cell, often=often, steps=round(scene.longest_time() / step), near=near))


def energies():
    """Times and kinetic energies of the configurations that are on the disk."""
    path = pathlib.Path("kineticEnergy.txt")
    words = [line.split() for line in path.read_text().splitlines()] if path.exists() else []
    return [(float(w[0]), float(w[1]) + float(w[2])) for w in words if len(w) == 3][:-1]


pathlib.Path("kineticEnergy.txt").unlink(missing_ok=True)
with open("packing.out", "w") as output:
    engine = subprocess.Popen([packing.program("rockable"), "input.txt"], stdout=output, stderr=output)
    while engine.poll() is None:
        time.sleep(0.5)
        kinetic = energies()
        if kinetic and kinetic[-1][0] > scene.fall_time() and kinetic[-1][1] < scene.energy_at_rest():
            engine.terminate()
            engine.wait()
kinetic = energies()
if not kinetic:
    packing.leave("Rockable stopped: see packing.out.", 1)
lines = pathlib.Path("conf%d" % len(kinetic)).read_text().splitlines()
first = next(k for k, line in enumerate(lines) if line.startswith("Particles ")) + 1
moved = [line.split() for line in lines[first:] if line and line[0] != "#"][1 + len(walls):][:len(scene.grains)]
for grain, words in zip(scene.grains, moved):
    numbers = np.array([float(w) for w in words[4:]])
    grain.place, grain.turn = numbers[:3], numbers[9:13]
first = next((k for k, line in enumerate(lines) if line.startswith("Interactions ")), len(lines)) + 1
pairs = [(int(a) - 1 - len(walls), int(b) - 1 - len(walls)) for a, b, *_ in map(str.split, lines[first:]) if a.isdigit()]
packing.finish("Rockable", scene, [grain.parts() for grain in scene.grains], [grain.place for grain in scene.grains],
               kinetic, packing.processor_time(), [pair for pair in pairs if min(pair) >= 0])
