# SPDX-License-Identifier: GPL-3.0-or-later
# yade -n -x yade_test.py NODES_CSV GRID_NPY: the files loaded into Yade, a grain thrown at a wall
# without damping or friction, and two at each other. Against the wall the force acts along the
# wall's normal, in which the overlap changes, and no energy is made. Between grains Yade's force
# follows from no potential, because it acts along the normal that the node's own grain has there
# (told and checked below), and not along that of the surface which the node is in: the energy after
# is printed, and not asked for.
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from yade import (Body, ForceResetter, FrictMat, InsertionSortCollider, InteractionLoop, NewtonIntegrator, O,
                  Quaternion, Vector3, Bo1_LevelSet_Aabb, Bo1_Wall_Aabb, Ig2_LevelSet_LevelSet_ScGeom,
                  Ig2_Wall_LevelSet_ScGeom, Ip2_FrictMat_FrictMat_FrictPhys,
                  Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker, utils)
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


def scene():
    """An empty one, and the material of what is put into it."""
    O.reset()
    material = FrictMat(young=1e8, poisson=0.3, frictionAngle=0.0, density=2650.0)
    O.materials.append(material)
    return material


def kinetic_energy():
    total = 0.0
    for body in O.bodies:
        if not body.dynamic:
            continue
        turn = body.state.ori.conjugate() * body.state.angVel
        total += 0.5 * body.state.mass * body.state.vel.squaredNorm()
        total += 0.5 * sum(body.state.inertia[k] * turn[k] ** 2 for k in range(3))
    return total


def collision(look=lambda contact: None):
    """Kinetic energy after the bodies have met and left each other / that before; look(contact) sees
    their first contact."""
    law = Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False, traceEnergy=True)
    stiffness = lambda value: MatchMaker(algo="val", val=value)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_LevelSet_Aabb(), Bo1_Wall_Aabb()], verletDist=0.0),
        InteractionLoop([Ig2_LevelSet_LevelSet_ScGeom(), Ig2_Wall_LevelSet_ScGeom()],
                        [Ip2_FrictMat_FrictMat_FrictPhys(kn=stiffness(2e6), ks=stiffness(1e6),
                                                         frictAngle=stiffness(0.0))], [law]),
        NewtonIntegrator(damping=0.0, gravity=(0, 0, 0), exactAsphericalRot=True)]
    O.dt = 2e-6
    start = kinetic_energy()
    touched = False
    looked = False
    for _ in range(400):
        O.run(100, True)
        for contact in O.interactions:
            if contact.isReal and not looked:
                look(contact)
                looked = True
        touched = touched or law.elasticEnergy() > 0
        if touched and law.elasticEnergy() == 0:
            break
    check(touched, "They touched.")
    check(law.elasticEnergy() == 0, "They left each other.")
    return kinetic_energy() / start


material = scene()
O.bodies.append(utils.wall((0, 0, 0), axis=2, material=material))
O.bodies.append(grain.body(Vector3(0, 0, 1.6 * radius), Quaternion(1, 0.2, 0.1, 0.3).normalized(),
                           Vector3(0.3, 0, -1.0), material))
against_wall = collision()
# 5e-7 were seen, by steps of 2 us.
check(abs(against_wall - 1) < 1e-5, "A collision with a wall makes no energy: %g" % against_wall)

material = scene()
for side in (-1, 1):
    O.bodies.append(grain.body(Vector3(1.4 * radius * side, 0.1 * radius * side, 0),
                               Quaternion(1, 0.2 * side, 0.1, 0.3).normalized(),
                               Vector3(-1.0 * side, 0, 0), material))
check(O.bodies[0].shape is not None and len(O.bodies) == 2, "Both bodies share the shape.")


def is_along_the_normal_of_a_node(contact):
    first, second = O.bodies[contact.id1].state, O.bodies[contact.id2].state
    own = [first.ori * grain.shape.normal(node) for node in grain.nodes]
    check(min((normal - contact.geom.normal).norm() for normal in own) < 1e-4 or
          min((second.ori * grain.shape.normal(node) + contact.geom.normal).norm()
              for node in grain.nodes) < 1e-4, "The normal is that of a node.")


between_grains = collision(is_along_the_normal_of_a_node)
print("Yade: %d nodes, volume by voxels %.4f of the grain's, kinetic energy after an undamped "
      "collision with a wall %.6f and of two grains %.6f of that before" %
      (len(grain.nodes), grain.voxel_volume / grain.volume, against_wall, between_grains))
sys.stdout.flush()
os._exit(0)
