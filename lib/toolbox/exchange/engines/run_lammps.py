# SPDX-License-Identifier: GPL-3.0-or-later
"""Clumps of this folder in LAMMPS with its packages GRANULAR and RIGID:

    python3 run.py [COUNT]

Writes packing.in and starts `lmp`. See packing.py for scene.json.
"""
import math
import pathlib

import packing
from packing import np

AIR = 0.3  # drag on spheres, so that the packing comes to rest: 1 / the time of a fall by a grain

scene = packing.Scene()
given = scene.material
young, poisson = given["young_modulus"], given["poisson_ratio"]
bodies = [grain.spheres() for grain in scene.grains]
rows = np.concatenate(bodies)
owners = np.repeat(np.arange(len(bodies)) + 1, [len(body) for body in bodies])
low, high = rows[:, :3].min(0), rows[:, :3].max(0)
edge = scene.width / 2 + scene.mean_diameter
with open("packing.data", "w") as data:
    print("grains\n\n%d atoms\n1 atom types" % len(rows), file=data)
    print("%r %r xlo xhi\n%r %r ylo yhi\n%r %r zlo zhi" %
          (-edge, edge, -edge, edge, -scene.mean_diameter, scene.top + scene.mean_diameter), file=data)
    print("\nAtoms\n", file=data)
    for k, (x, y, z, r) in enumerate(rows):
        grain = scene.grains[owners[k] - 1]
        # Contacts take the mass of the whole grain. LAMMPS only adds these up.
        cubes = (8 * bodies[owners[k] - 1][:, 3] ** 3).sum() * math.pi / 6
        print(k + 1, 1, 2 * r, grain.mass / cubes, x, y, z, file=data)
    print("\nMolecules\n", file=data)
    for k, owner in enumerate(owners):
        print(k + 1, owner, file=data)
with open("packing.bodies", "w") as data:
    print(len(scene.grains), file=data)
    for k, grain in enumerate(scene.grains):
        turn = packing.rotation(grain.turn)
        i = turn @ np.diag(grain.moments) @ turn.T
        print(k + 1, grain.mass, *grain.place, i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2],
              "0 0 0 0 0 0 0 0 0", file=data)

smallest = rows[:, 3].min()
shear = young / (2 * (1 + poisson))
step = 0.15 * math.pi * smallest * math.sqrt(given["density"] / shear) / (0.1631 * poisson + 0.8766)
pace = math.sqrt(scene.mean_diameter / scene.gravity)
chunk = max(200, round(2 * pace / step))
contact = "hertz/material %r %r %r tangential mindlin NULL 0.5 %r damping tsuji" % (
    young, given["restitution"], poisson, given["friction"])
if scene.shape == "box":
    walls = ["fix sides all wall/gran granular %s xplane %r %r" % (contact, -scene.width / 2, scene.width / 2),
             "fix ends all wall/gran granular %s yplane %r %r" % (contact, -scene.width / 2, scene.width / 2)]
else:
    walls = ["fix sides all wall/gran granular %s zcylinder %r" % (contact, scene.width / 2)]
# The spheres of a grain overlap, so gravity acts on the grain and not on each of them (disable), and they
# do not touch each other (exclude). The file packing.bodies has the grains' masses and moments.
pathlib.Path("packing.in").write_text("""units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
comm_modify vel yes
fix numbers all property/atom mol ghost yes
read_data packing.data fix numbers NULL Molecules
neighbor {skin!r} bin
neigh_modify delay 0 exclude molecule/intra all
pair_style granular
pair_coeff * * {contact}
fix gravity all gravity {gravity!r} vector 0 0 -1 disable
fix floor all wall/gran granular {contact} zplane 0 NULL
{walls}
fix clumps all rigid/small molecule infile packing.bodies gravity gravity reinit no
fix air all viscous {air!r}
timestep {step!r}
compute kinetic all ke/rigid clumps
compute grains all rigid/local clumps mol x y z mass inertiax inertiay inertiaz
variable kinetic equal c_kinetic
dump grains all local {chunk} packing.grains index c_grains[*]
dump spheres all custom {chunk} packing.spheres id x y z radius
dump_modify spheres sort id
thermo_style custom step time c_kinetic
thermo {chunk}
run {fall}
variable part loop {most}
label settle
run {chunk} pre no
if "${{kinetic}} < {rest!r}" then "jump SELF done"
next part
jump SELF settle
label done
""".format(skin=0.25 * smallest, contact=contact, gravity=scene.gravity, walls="\n".join(walls), step=step,
           air=AIR / pace * sum(g.mass for g in scene.grains) / len(rows), chunk=chunk,
           fall=chunk * math.ceil(scene.fall_time() / step / chunk),
           most=max(1, math.ceil((scene.longest_time() - scene.fall_time()) / step / chunk)),
           rest=scene.energy_at_rest()))
packing.run("lmp", "-in", "packing.in", "-log", "packing.log")


def last(path):
    """The numbers of the last step of a dump."""
    text = open(path).read().rpartition("ITEM: ")[2]
    return np.array([[float(v) for v in line.split()] for line in text.splitlines()[1:]])


spheres = last("packing.spheres")[:, 1:]
moved = [spheres[owners == k + 1] for k in range(len(bodies))]
places = last("packing.grains")
places = places[np.argsort(places[:, 1]), 2:5]
kinetic = {}
for line in open("packing.out"):
    words = line.split()
    if len(words) == 3 and words[0].isdigit():
        kinetic[float(words[1])] = float(words[2])
packing.finish("LAMMPS", scene, moved, places, sorted(kinetic.items()), packing.processor_time())
