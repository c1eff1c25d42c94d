# SPDX-License-Identifier: GPL-3.0-or-later
"""A packing of clumps in LIGGGHTS: each scan of a folder as 20 overlapping spheres, with the grain's mass
and moments of inertia.

    WSCVT=wscvt python3 liggghts_clumps.py SCANS [COUNT]

COUNT grains, 20 by default, of 20 mm equivalent diameter fall into a box. Writes liggghts_clumps.in, which
LIGGGHTS runs, and liggghts_clumps.png.
"""
import collections
import pathlib
import subprocess

from packing import arguments, of_each, picture, sphere_mesh, wscvt

folder, count = arguments(__doc__, 20)
diameter, width, steps = 0.02, 0.08, 60000


def template(k, scan):
    wscvt("clump", scan, "-k", 20, "--size", diameter, "-o", "grain_%d.multisphere" % k)
    return "include grain_%d.multisphere.in\n" % k


templates = of_each(folder, template)
mixture = "".join(" clump_grain_%d %.9g" % (k, 1 / len(templates)) for k in range(len(templates)))

pathlib.Path("liggghts_clumps.in").write_text("""atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block {low} {high} {low} {high} 0 {top} units box
create_box 1 box
neighbor 0.001 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 1e7
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.2
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran model hertz tangential history
pair_coeff * *
timestep 2e-5
fix gravity all gravity 9.81 vector 0 0 -1
fix bottom all wall/gran model hertz tangential history primitive type 1 zplane 0
fix left all wall/gran model hertz tangential history primitive type 1 xplane {low}
fix right all wall/gran model hertz tangential history primitive type 1 xplane {high}
fix front all wall/gran model hertz tangential history primitive type 1 yplane {low}
fix back all wall/gran model hertz tangential history primitive type 1 yplane {high}
variable density equal 2650
variable clump_type equal 1
{templates}
fix mixture all particledistribution/discrete 32452867 {number}{mixture}
fix source all insert/pack seed 32452843 distributiontemplate mixture insert_every once &
  overlapcheck yes all_in yes vel constant 0 0 0 region box particles_in_region {count}
fix clumps all multisphere
thermo 5000
dump last all custom {steps} liggghts_clumps.dump id_multisphere x y z radius vx vy vz
run {steps}
""".format(low=-width / 2, high=width / 2, top=diameter * (3 + 0.15 * count), templates="".join(templates),
           mixture=mixture, number=len(templates), count=count, steps=steps))
subprocess.run(["liggghts", "-in", "liggghts_clumps.in"], check=True, stdout=open("liggghts_clumps.out", "w"))

clumps, speed = collections.defaultdict(list), 0.0
for line in open("liggghts_clumps.dump").read().rpartition("ITEM: ATOMS")[2].splitlines()[1:]:
    number, *sphere, vx, vy, vz = map(float, line.split())
    clumps[number].append(sphere)
    speed = max(speed, (vx ** 2 + vy ** 2 + vz ** 2) ** 0.5)
picture("liggghts_clumps.png", [sphere_mesh(spheres) for spheres in clumps.values()], width)
highest = max(sum(s[2] for s in spheres) / len(spheres) for spheres in clumps.values())
print("LIGGGHTS clumps: %d grains, %.4f m/s at most, highest centre at %.1f diameters" %
      (len(clumps), speed, highest / diameter))
