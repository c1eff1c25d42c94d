# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of this folder in LIGGGHTS:

    python3 run.py [COUNT]

Writes packing.in and starts `liggghts`. LIGGGHTS chooses places by itself, and takes a template for each
shape and size: sizes of a curve are put into five classes. See packing.py for scene.json.
"""
import collections
import math
import pathlib

import packing
from packing import np

CLASSES = 5  # of sizes

scene = packing.Scene()
given, width = scene.material, scene.width
young, poisson = given["young_modulus"], given["poisson_ratio"]
order = sorted(range(len(scene.grains)), key=lambda k: scene.grains[k].diameter)
if len({grain.diameter for grain in scene.grains}) > len({grain.shape.name for grain in scene.grains}):
    for ranks in np.array_split(order, CLASSES):
        size = np.mean([scene.grains[k].diameter ** 3 for k in ranks]) ** (1 / 3)
        for k in ranks:
            shape = scene.grains[k].shape
            scene.grains[k] = packing.Grain(shape, size / shape.diameter, given["density"])
templates = collections.Counter((grain.shape.name, grain.scale) for grain in scene.grains)
by_key = {(grain.shape.name, grain.scale): grain for grain in scene.grains}


def primes(start):
    """Primes from a number on: LIGGGHTS refuses seeds that are not prime or equal."""
    while True:
        if all(start % k for k in range(2, math.isqrt(start) + 1)):
            yield start
        start += 1


seed, lines, mixture = primes(10007), [], ""
smallest = min(grain.scale * grain.shape.spheres[:, 3].min() for grain in scene.grains)
limit = float(smallest ** 3)  # LIGGGHTS's own, 1e-12, refuses fine sand in metres
for k, (key, number) in enumerate(templates.items()):
    grain = by_key[key]
    grain.place, grain.turn = np.zeros(3), (1, 0, 0, 0)
    np.savetxt("template_%d.spheres" % k, grain.spheres(), fmt="%.17g")
    lines.append("fix t%d all particletemplate/multisphere %d atom_type 1 volume_limit %r density constant %r nspheres %d "
                 "ntry 100000 spheres file template_%d.spheres scale 1.0 type %d mass %r inertia_tensor %r 0 0 %r 0 %r "
                 "use_density" % (k, next(seed), limit, given["density"], len(grain.shape.spheres), k, k + 1,
                                  grain.mass, *map(float, grain.moments)))
    mixture += " t%d %r" % (k, number / len(scene.grains))
shear = young / (2 * (1 + poisson))
step = 0.15 * math.pi * smallest * math.sqrt(given["density"] / shear) / (0.1631 * poisson + 0.8766)
steps = round(scene.longest_time() / step)
model = "model hertz tangential history"
if scene.shape == "box":
    region = "block {0!r} {1!r} {0!r} {1!r} 0 {2!r}".format(-width / 2, width / 2, scene.top)
    walls = ["fix w%d all wall/gran %s primitive type 1 %splane %r" % (k, model, axis, sense * width / 2)
             for k, (axis, sense) in enumerate((("x", -1), ("x", 1), ("y", -1), ("y", 1)))]
else:
    region = "cylinder z 0 0 %r 0 %r" % (width / 2, scene.top)
    walls = ["fix w0 all wall/gran %s primitive type 1 zcylinder %r 0 0" % (model, width / 2)]
edge = width / 2 + scene.mean_diameter
pathlib.Path("packing.in").write_text("""atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
soft_particles yes
hard_particles yes
units si
region box block {edge_low!r} {edge!r} {edge_low!r} {edge!r} {below!r} {top!r} units box
region column {region} units box volume_limit {limit!r}
create_box 1 box
neighbor {skin!r} bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype {young!r}
fix m2 all property/global poissonsRatio peratomtype {poisson!r}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {restitution!r}
fix m4 all property/global coefficientFriction peratomtypepair 1 {friction!r}
pair_style gran {model}
pair_coeff * *
timestep {step!r}
fix gravity all gravity {gravity!r} vector 0 0 -1
fix floor all wall/gran {model} primitive type 1 zplane 0
{walls}
{templates}
fix mixture all particledistribution/discrete/numberbased {mixture_seed} {number}{mixture}
fix source all insert/pack seed {source_seed} distributiontemplate mixture insert_every once &
  overlapcheck yes all_in yes vel constant 0 0 0 region column particles_in_region {count}
fix clumps all multisphere
thermo {often}
dump last all custom {often} packing.spheres id_multisphere x y z radius vx vy vz
run {steps}
""".format(edge_low=-edge, edge=edge, below=-scene.mean_diameter, top=scene.top + scene.mean_diameter, region=region,
           limit=limit, skin=0.5 * smallest, young=young, poisson=poisson, restitution=given["restitution"],
           friction=given["friction"], model=model, step=step, gravity=scene.gravity, walls="\n".join(walls),
           templates="\n".join(lines), mixture_seed=next(seed), number=len(templates), mixture=mixture,
           source_seed=next(seed), count=len(scene.grains), often=max(1, steps // 40), steps=steps))
packing.run("liggghts", "-in", "packing.in", "-log", "packing.log")

kinetic, moved = [], {}
for text in open("packing.spheres").read().split("ITEM: TIMESTEP\n")[1:]:
    moved = collections.defaultdict(list)
    for line in text.partition("ITEM: ATOMS")[2].splitlines()[1:]:
        number, *values = map(float, line.split())
        moved[number].append(values)
    if not moved:
        continue
    rows = [np.array(body) for body in moved.values()]
    mass = sum(grain.mass for grain in scene.grains) / len(scene.grains)
    # Of the spheres' centres, which move about the grain's too.
    energy = sum(0.5 * mass * (body[:, 4:] ** 2).sum(1).mean() for body in rows)
    kinetic.append((int(text.split()[0]) * step, energy))
rows = [np.array(body)[:, :4] for _, body in sorted(moved.items())]
# LIGGGHTS numbers grains by itself: each is the template whose radii it has.
radii = {key: np.sort(grain.scale * grain.shape.spheres[:, 3]) for key, grain in by_key.items()}


def distance(key, body):
    alike = len(radii[key]) == len(body)
    return np.abs(np.sort(body[:, 3]) - radii[key]).max() if alike else math.inf


scene.grains = [by_key[min(radii, key=lambda key: distance(key, body))] for body in rows]
places = [np.average(body[:, :3], weights=body[:, 3] ** 3, axis=0) for body in rows]
packing.finish("LIGGGHTS", scene, rows, places, kinetic, packing.processor_time())
