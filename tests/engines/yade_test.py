# SPDX-License-Identifier: GPL-3.0-or-later
# yade -n -x yade_test.py NODES_CSV GRID_NPY: the files loaded into Yade, and two grains thrown at
# each other without damping or friction. Yade's force then follows from no potential, because it
# acts along the normal that the node's own grain has there (told and checked below), and not along
# that of the surface which the node is in: the energy after is printed, and not asked for.
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade import (Body, ForceResetter, FrictMat, InsertionSortCollider, InteractionLoop, NewtonIntegrator, O,
                  Quaternion, Vector3, Bo1_LevelSet_Aabb, Ig2_LevelSet_LevelSet_ScGeom,
                  Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker)
from yade_grain import Grain


def check(holds, sentence):
    if not holds:
        print("FAILED: " + sentence)
        sys.stdout.flush()
        os._exit(1)


grain = Grain(sys.argv[-2], sys.argv[-1])
check(len(grain.shape.surfNodes) == len(grain.nodes), "Yade holds every node.")
check(abs(grain.voxel_volume / grain.volume - 1) < 0.02, "Yade's voxels have the grain's volume.")
# Its voxels hang at their corners, so its centre is off by half of one along each axis.
check(grain.shape.center().norm() < grain.spacing, "The centroid is the origin.")
check((grain.shape.inertia() - grain.inertia).norm() < 0.02 * grain.inertia.norm(),
      "Yade's voxels have the grain's moments, in their order.")
distances = [abs(grain.shape.distance(node)) for node in grain.nodes]
radius = (3 * grain.volume / 12.566370614359172) ** (1 / 3)
check(max(distances) < 0.2 * radius, "The nodes lie near the surface of the grid.")

material = FrictMat(young=1e8, poisson=0.3, frictionAngle=0.0, density=2650.0)
O.materials.append(material)
for side in (-1, 1):
    O.bodies.append(grain.body(Vector3(1.4 * radius * side, 0.1 * radius * side, 0),
                               Quaternion(1, 0.2 * side, 0.1, 0.3).normalized(),
                               Vector3(-1.0 * side, 0, 0), material))
check(O.bodies[0].shape is not None and len(O.bodies) == 2, "Both bodies share the shape.")
law = Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False, traceEnergy=True)
stiffness = lambda value: MatchMaker(algo="val", val=value)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_LevelSet_Aabb()], verletDist=0.0),
    InteractionLoop([Ig2_LevelSet_LevelSet_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys(kn=stiffness(2e6), ks=stiffness(1e6),
                                                     frictAngle=stiffness(0.0))], [law]),
    NewtonIntegrator(damping=0.0, gravity=(0, 0, 0), exactAsphericalRot=True)]
O.dt = 2e-6


def kinetic_energy():
    total = 0.0
    for body in O.bodies:
        turn = body.state.ori.conjugate() * body.state.angVel
        total += 0.5 * body.state.mass * body.state.vel.squaredNorm()
        total += 0.5 * sum(body.state.inertia[k] * turn[k] ** 2 for k in range(3))
    return total


start = kinetic_energy()
touched = False
for _ in range(400):
    O.run(100, True)
    for contact in O.interactions:
        if contact.isReal and not touched:
            first, second = O.bodies[contact.id1].state, O.bodies[contact.id2].state
            own = [first.ori * grain.shape.normal(node) for node in grain.nodes]
            check(min((normal - contact.geom.normal).norm() for normal in own) < 1e-4 or
                  min((second.ori * grain.shape.normal(node) + contact.geom.normal).norm()
                      for node in grain.nodes) < 1e-4, "The normal is that of a node.")
    touched = touched or law.elasticEnergy() > 0
    if touched and law.elasticEnergy() == 0:
        break
end = kinetic_energy()
check(touched, "The grains touched.")
check(law.elasticEnergy() == 0, "The grains left each other.")
print("Yade: %d nodes, volume by voxels %.4f of the grain's, kinetic energy after an undamped "
      "collision %.6f of that before" % (len(grain.nodes), grain.voxel_volume / grain.volume,
                                         end / start))
sys.stdout.flush()
os._exit(0)
