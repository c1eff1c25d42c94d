# SPDX-License-Identifier: GPL-3.0-or-later
# yade -n -x yade_packing.py NODES_CSV GRID_NPY SEED OUTPUT_CSV [SIDE LAYERS SECONDS [DAMPING FRICTION [LAW]]]:
# makes the packing of the paper's figure 11 in Yade: grains of 0.1 m, in LAYERS (6) of SIDE x SIDE (3), thrown
# down at 2 m/s into a box as wide as they are, until SECONDS (1) have passed. Normal and tangential stiffness
# are 2e6 and 1e6 N/m, FRICTION is 0.5, Yade's DAMPING 0.3. LAW between grains is "contacts", the law of
# ../../../lib/toolbox/exchange/engines/yade_level_sets.py, or "own", Yade's. Starts depend only on the seed, so that those of different
# nodes are paired. Without damping and friction the sum of the energies must stay, except with Yade's law.
# Columns: time, kinetic, potential and elastic energy, mean overlap of grains in contact as Yade sees it /
# radius; the last line is the cost. OUTPUT_CSV.poses gets position and quaternion w, x, y, z of each grain
# at the end.
import math
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])),
                                "../../../lib/toolbox/exchange/engines"))
import numpy
from yade import (Bo1_LevelSet_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_LevelSet_LevelSet_ScGeom,
                  Ig2_Wall_LevelSet_ScGeom, InsertionSortCollider, InteractionLoop,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker,
                  NewtonIntegrator, O, PyRunner, Quaternion, Vector3, utils)
from yade_level_sets import Grain, GrainContacts, kinetic_energy

arguments = sys.argv[1:]
nodes_csv, grid_npy, seed, output = arguments[:4]
choices = arguments[4:] + ["3", "6", "1", "0.3", "0.5", "contacts"][len(arguments) - 4:]
side, layers = int(choices[0]), int(choices[1])
seconds, damping, friction = (float(choice) for choice in choices[2:5])
own_law = {"own": True, "contacts": False}[choices[5]]
radius, gravity = 0.05, 9.81
# The force of a contact bends where another node becomes the deepest. Each bend makes or takes some energy, the more the
# longer the step: undamped, a second of steps of 100 us ends 3 % off.
step = 5e-5
box = 2.8 * radius * side
grain = Grain(nodes_csv, grid_npy)
material = FrictMat(young=1e8, poisson=0.3, frictionAngle=math.atan(friction), density=2650.0)
# The walls', alike, and another one for MatchMaker to tell them by.
rigid = FrictMat(young=1e8, poisson=0.3, frictionAngle=math.atan(friction), density=2650.0)
O.materials.append([material, rigid])
contacts = GrainContacts(grain, 2e6, 1e6, friction)
random = numpy.random.RandomState(int(seed))
for layer in range(layers):
    for i in range(side):
        for j in range(side):
            q = random.normal(size=4)
            q /= numpy.linalg.norm(q)
            O.bodies.append(grain.body(
                Vector3((i + 0.5) * box / side, (j + 0.5) * box / side, 0.09 + 0.17 * layer),
                Quaternion(*[float(x) for x in q]), Vector3(0, 0, -2), material))
grains = [body for body in O.bodies]
for axis, place in ((0, 0), (0, box), (1, 0), (1, box), (2, 0)):
    O.bodies.append(utils.wall(place, axis=axis, sense=0, material=rigid))
# Yade's law acts at walls: without stiffness between grains, unless it is to act there too.
stiffness = lambda value: MatchMaker(algo="val", val=value,
                                     matches=() if own_law else ((material.id, material.id, 0),))
law = Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_LevelSet_Aabb(), Bo1_Wall_Aabb()], verletDist=0.005),
    InteractionLoop([Ig2_LevelSet_LevelSet_ScGeom(), Ig2_Wall_LevelSet_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys(kn=stiffness(2e6), ks=stiffness(1e6),
                                                     frictAngle=stiffness(math.atan(friction)))], [law]),
    PyRunner(command="contacts.apply()", iterPeriod=1, dead=own_law),
    NewtonIntegrator(damping=damping, gravity=(0, 0, -gravity), exactAsphericalRot=True)]
O.dt = step


def row():
    potential = sum(body.state.mass * gravity * body.state.pos[2] for body in grains)
    overlaps = [c.geom.penetrationDepth for c in O.interactions
                if c.isReal and c.id1 < len(grains) and c.id2 < len(grains)]
    elastic = contacts.energy + sum(0.5 * (c.phys.normalForce.squaredNorm() / c.phys.kn +
                                           c.phys.shearForce.squaredNorm() / c.phys.ks)
                                    for c in O.interactions if c.phys.kn > 0)
    return [O.time, kinetic_energy(grains), potential, elastic,
            numpy.mean(overlaps) / radius if overlaps else 0.0]


rows = []
cost = 0.0
while O.time < seconds - 0.5 * step:
    start = time.process_time()
    O.run(round(0.01 / step), True)
    cost += time.process_time() - start
    rows.append(row())
# What a step costs by Yade itself, which does all that goes with the nodes; the law's Python does not.
cost -= contacts.seconds
if damping == 0 and friction == 0:
    totals = [sum(values[1:4]) for values in rows]
    print("Yade undamped: %d nodes, by %s energies from %.4g to %.4g J, %.4g at the start" %
          (len(grain.nodes), "Yade's own law" if own_law else "yade_level_sets", min(totals), max(totals),
           totals[0]))
    # 0.6 % were seen after a second with 100 nodes.
    if not own_law and max(abs(total / totals[0] - 1) for total in totals) > 0.02:
        print("FAILED: the law made or lost energy.")
        sys.stdout.flush()
        os._exit(1)
numpy.savetxt(output, rows, delimiter=",", header="time,kinetic,potential,elastic,overlap",
              comments="", fmt="%.8g", footer="# %.4f ms a step, box %.4f m" % (1e3 * cost * step / seconds, box))
numpy.savetxt(output + ".poses", [[*body.state.pos, body.state.ori[3], *[body.state.ori[k] for k in range(3)]]
                                  for body in grains], delimiter=",", header="x,y,z,qw,qx,qy,qz",
              comments="", fmt="%.10g")
print("Yade packing: %d nodes, seed %s: mean height %.4f radii, kinetic %.3g J, elastic %.3g J, overlap "
      "%.3f %% of the radius, %.2f ms a step" %
      (len(grain.nodes), seed, rows[-1][2] / (grain.volume * 2650.0 * gravity * len(grains)) / radius,
       rows[-1][1], rows[-1][3], 100 * rows[-1][4], 1e3 * cost * step / seconds))
sys.stdout.flush()
os._exit(0)
