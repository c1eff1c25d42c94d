# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in LAMMPS: each scan of a folder as 20 overlapping spheres, with the grain's mass and
moments of inertia.

    WSCVT=wscvt python3 lammps_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes lammps_clumps.in, which
LAMMPS (`lmp`, with its packages GRANULAR and RIGID) runs, and lammps_clumps.png.
"""
import collections
import pathlib
import subprocess

from packing import arguments, of_each, picture, sphere_mesh, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, density = 0.02, 0.08, 2650


def molecule(k, scan):
    name = "clump_%d.molecule" % k
    wscvt("clump", scan, "-k", 20, "--size", diameter, "--density", density, "-o", name)
    return name


molecules = of_each(folder, molecule)
# The spheres of a grain overlap, so gravity acts on the grain and not on each of them (disable), and they
# do not touch each other (exclude). Only grains that fix deposit adds keep mass and moments of their file.
low = diameter * (2 + 0.1 * count)
pathlib.Path("lammps_clumps.in").write_text("""units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
comm_modify vel yes
region box block {left} {right} {left} {right} {below} {top} units box
create_box 1 box
fix numbers all property/atom mol ghost yes
neighbor 0.001 bin
neigh_modify delay 0 exclude molecule/intra all
pair_style granular
pair_coeff * * {contact}
fix gravity all gravity 9.81 vector 0 0 -1 disable
fix floor all wall/gran granular {contact} zplane 0 NULL
fix sides all wall/gran granular {contact} xplane {left} {right}
fix ends all wall/gran granular {contact} yplane {left} {right}
molecule grains {molecules}
fix clumps all rigid/small molecule mol grains gravity gravity reinit no
region source block {inner_left} {inner_right} {inner_left} {inner_right} {low} {high} units box
fix source all deposit {count} 0 2000 4767548 region source mol grains molfrac {fractions} &
  rigid clumps near {near} attempt 1000 vz -0.5 -0.5
fix air all viscous 0.002
timestep 2e-5
compute grains all rigid/local clumps mass x y z vx vy vz inertiax inertiay inertiaz
dump grains all local {steps} lammps_grains.dump index c_grains[*]
dump spheres all custom {steps} lammps_clumps.dump mol x y z radius
run {steps}
""".format(left=-width / 2, right=width / 2, below=-diameter, top=low + 4 * diameter, low=low,
           high=low + 3 * diameter, inner_left=diameter - width / 2, inner_right=width / 2 - diameter,
           near=1.6 * diameter, molecules=" ".join(molecules), count=count, steps=2000 * count + 60000,
           fractions=" ".join(["%.9g" % (1 / len(molecules))] * len(molecules)),
           contact="hertz/material 1e7 0.2 0.3 tangential mindlin NULL 0.5 0.5 damping tsuji"))
with open("lammps_clumps.out", "w") as output:
    subprocess.run(["lmp", "-in", "lammps_clumps.in"], check=True, stdout=output)


def rows(path, heading):
    """The numbers of the last step of a dump."""
    text = open(path).read().rpartition("ITEM: " + heading)[2]
    return [[float(v) for v in line.split()] for line in text.splitlines()[1:]]


clumps = collections.defaultdict(list)
for number, *sphere in rows("lammps_clumps.dump", "ATOMS"):
    clumps[number].append(sphere)
grains = rows("lammps_grains.dump", "ENTRIES")
picture("lammps_clumps.png", [sphere_mesh(spheres) for spheres in clumps.values()], width)
print("LAMMPS clumps: %d grains, %.4f m/s at most, highest centre at %.1f diameters" %
      (len(grains), max(sum(v * v for v in row[5:8]) ** 0.5 for row in grains),
       max(row[4] for row in grains) / diameter))
