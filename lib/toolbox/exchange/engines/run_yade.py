# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of this folder in Yade:

    yade -n -x run.py [COUNT]

Clumps of spheres, convex polyhedra, or level sets. See packing.py for scene.json.
"""
import math
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import packing
from yade import *
from yade import geom, log, polyhedra_utils, utils

DAMPING = 0.4  # Yade's numerical damping of forces

scene = packing.Scene()
given, width = scene.material, scene.width
young, friction = given["young_modulus"], math.atan(given["friction"])
are_clumps = scene.grains[0].shape.spheres is not None
are_level_sets = os.path.exists(packing.FOLDER / "yade_level_sets.py")
if are_level_sets and scene.shape != "box":
    packing.leave("Yade's level sets touch plane walls only: give the container the shape \"box\" in scene.json.")
if are_clumps or are_level_sets:
    material = FrictMat(young=young, poisson=given["poisson_ratio"], frictionAngle=friction, density=given["density"])
else:
    # Where two grains come near each other, Yade warns in each step of a case that it takes rightly.
    log.setLevel("Polyhedra_support.cpp", log.ERROR)
    # Yade multiplies it by the volume that two polyhedra share, so it is a pressure per length.
    stiffness = young / scene.mean_diameter
    material = PolyhedraMat(young=stiffness, poisson=given["poisson_ratio"], frictionAngle=friction,
                            density=given["density"])
O.materials.append(material)
wall_material = material
if are_level_sets:
    import yade_level_sets
    wall_material = FrictMat(young=young, frictionAngle=friction, label="wall")
    O.materials.append(wall_material)
O.bodies.append(utils.wall(0, axis=2, sense=1, material=wall_material))
if scene.shape == "box":
    for axis in (0, 1):
        for sense in (1, -1):
            O.bodies.append(utils.wall(-sense * width / 2, axis=axis, sense=sense, material=wall_material))
else:
    O.bodies.append(geom.facetCylinder((0, 0, scene.top / 2), width / 2, scene.top, segmentsNumber=48, wallMask=4,
                                       material=material))


def clump(grain):
    """Adds a clump with the mass and moments of the grain. Yade keeps the centre of mass of the spheres."""
    turn = Quaternion(*map(float, grain.turn))
    spheres = [utils.sphere(Vector3(*map(float, row[:3])), float(row[3]), material=material)
               for row in grain.spheres()]
    number, members = O.bodies.appendClumped(spheres, discretization=0)
    state = O.bodies[number].state
    state.mass = grain.mass
    to_grain = (turn.conjugate() * state.ori).toRotationMatrix()
    moments = [float(v) for v in grain.moments]
    turned = to_grain.transpose() * Matrix3(moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2]) * to_grain
    state.inertia = Vector3(turned[0, 0], turned[1, 1], turned[2, 2])
    return O.bodies[number], [O.bodies[m] for m in members]


def polyhedron(grain):
    """Adds a polyhedron; Yade moves the vertices to its own centre and axes."""
    if len(grain.shape.parts) > 1:
        packing.leave("Yade takes one convex part of a grain. Make the folder with -k 1.")
    vertices = [Vector3(*map(float, v)) for v in grain.scale * grain.shape.parts[0][0]]
    body = polyhedra_utils.polyhedra(material, v=vertices)
    body.state.pos = Vector3(*map(float, grain.place))
    body.state.ori = Quaternion(*map(float, grain.turn))
    O.bodies.append(body)
    return body, [body]


made = {}


def level_set(grain):
    """Adds a body; those of the same shape and size share a grid."""
    name = grain.shape.name
    key = name, grain.scale
    if key not in made:
        made[key] = yade_level_sets.Grain(str(packing.FOLDER / "node-table" / (name + ".csv")),
                                          str(packing.FOLDER / "sdf" / (name + ".npy")), grain.scale)
    w, x, y, z = map(float, grain.turn)
    body = made[key].body(Vector3(*map(float, grain.place)), Quaternion(w, x, y, z), material=material)
    O.bodies.append(body)
    return body, [body]


grains = [(clump if are_clumps else level_set if are_level_sets else polyhedron)(grain) for grain in scene.grains]
smallest = min(grain.diameter for grain in scene.grains)
if are_clumps:
    bounds, contacts = Bo1_Sphere_Aabb(), [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()]
    physics, law = Ip2_FrictMat_FrictMat_FrictPhys(), Law2_ScGeom_FrictPhys_CundallStrack()
    O.dt = 0.4 * utils.PWaveTimeStep()
elif are_level_sets:
    stiffness = young * scene.mean_diameter / 2  # as of two spheres
    law_between_grains = yade_level_sets.GrainContacts(next(iter(made.values())), stiffness, stiffness / 2,
                                                       given["friction"])

    def at_walls(value):
        return MatchMaker(matches=((wall_material.id, material.id, value),), algo="val", val=0)

    bounds, contacts = Bo1_LevelSet_Aabb(), [Ig2_Wall_LevelSet_ScGeom(), Ig2_LevelSet_LevelSet_ScGeom()]
    physics = Ip2_FrictMat_FrictMat_FrictPhys(kn=at_walls(stiffness), ks=at_walls(stiffness / 2),
                                              frictAngle=MatchMaker(algo="val", val=friction))
    law = Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)
    O.dt = 0.1 * math.sqrt(min(grain.mass for grain in scene.grains) / stiffness)
else:
    bounds = Bo1_Polyhedra_Aabb()
    contacts = [Ig2_Wall_Polyhedra_PolyhedraGeom(), Ig2_Polyhedra_Polyhedra_PolyhedraGeom(),
                Ig2_Facet_Polyhedra_PolyhedraGeom()]
    physics, law = Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys(), Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()
    O.dt = 0.12 * math.sqrt(smallest * given["density"] / stiffness)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([bounds, Bo1_Wall_Aabb(), Bo1_Facet_Aabb()], verletDist=0.05 * smallest),
    InteractionLoop(contacts, [physics], [law]),
    NewtonIntegrator(damping=DAMPING, gravity=(0, 0, -scene.gravity), exactAsphericalRot=are_clumps or are_level_sets)]
if are_level_sets:
    O.engines = O.engines[:3] + [PyRunner(command="law_between_grains.apply()", iterPeriod=1)] + O.engines[3:]

began, kinetic = time.process_time(), []
while True:
    O.run(500, True)
    energy = sum(0.5 * body.state.mass * body.state.vel.squaredNorm() for body, _ in grains)
    kinetic.append((O.time, energy))
    if O.time > scene.longest_time() or (O.time > scene.fall_time() and energy < scene.energy_at_rest()):
        break

number = {body.id: k for k, (body, _) in enumerate(grains)}
pairs = [(number[i.id1], number[i.id2]) for i in O.interactions
         if i.isReal and i.id1 in number and i.id2 in number and (not are_level_sets or i.geom.penetrationDepth > 0)]
bodies = []
for (body, members), grain in zip(grains, scene.grains):
    if are_clumps:
        bodies.append(packing.np.array([[*member.state.pos, member.shape.radius] for member in members]))
        continue
    if are_level_sets:
        vertices, faces = grain.shape.parts[0]
        vertices = grain.scale * vertices
    else:
        vertices = packing.np.array([tuple(v) for v in body.shape.v])
        faces = packing.np.array(body.shape.GetSurfaceTriangulation()).reshape(-1, 3)
    q = body.state.ori
    turned = vertices @ packing.rotation((q[3], q[0], q[1], q[2])).T + packing.np.array(tuple(body.state.pos))
    bodies.append([(turned, faces)])
packing.finish("Yade", scene, bodies, [tuple(body.state.pos) for body, _ in grains], kinetic,
               time.process_time() - began, None if are_clumps else pairs)
