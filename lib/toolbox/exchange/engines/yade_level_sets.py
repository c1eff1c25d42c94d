# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains of wscvt as level sets in Yade, and a contact law between them that conserves energy. Lengths are in
the unit of the files. In your own script:

    wscvt remesh scan.ply remesh.ply -n 200 --frame principal --size 0.1 --node-table nodes.csv --sdf grid.npy

    from yade_level_sets import Grain, GrainContacts
    grain = Grain("nodes.csv", "grid.npy")                 # one shape, for any number of bodies
    contacts = GrainContacts(grain, kn, ks, friction)      # of several grains any one
    O.engines = [..., InteractionLoop([Ig2_LevelSet_LevelSet_ScGeom(), ...],
                                      [Ip2_FrictMat_FrictMat_FrictPhys(kn=..., ...)],   # 0 between grains
                                      [Law2_ScGeom_FrictPhys_CundallStrack(sphericalBodies=False)]),
                 PyRunner(command="contacts.apply()", iterPeriod=1), NewtonIntegrator(...)]

Yade finds the node of one grain that is deepest in the other, but its force acts along the normal of the node's
own grain. The overlap does not change along this normal, so that collisions of angular grains end with half the
energy or with four times as much. Here the force follows from an energy, kn u^2 / 2 for the depth u, so it acts
along the gradient of the distance to the surface that the node is in. Along the surface it is Cundall and
Strack's, as Yade's own (Law2_ScGeom_FrictPhys_CundallStrack).
"""
import json
import time

import numpy
from yade import Aabb, Body, LevelSet, O, Quaternion, RegularGrid, Vector3, Vector3i


class Grain:
    def __init__(self, nodes_csv, grid_npy, scale=1.0):
        """Both files in the principal frame (--frame principal). The grain is `scale` times as large."""
        with open(grid_npy + ".json") as file:
            description = json.load(file)
        if description["frame"]["name"] != "principal":
            raise ValueError("Yade's bodies lie in their principal axes; write --frame principal.")
        distances = scale * numpy.load(grid_npy)
        axes = "xyz"
        self.shape = LevelSet(
            lsGrid=RegularGrid(
                min=scale * Vector3(*[description["origin"][a] for a in axes]),
                nGP=Vector3i(*[description["counts"][a] for a in axes]),
                spacing=scale * description["spacing"]),
            distField=distances.tolist(), nSurfNodes=8, nodesPath=2)
        # Read before the nodes are set: Yade makes its own with it.
        self.voxel_volume = self.shape.volume()
        table = numpy.genfromtxt(nodes_csv, delimiter=",", names=True)
        self.nodes = [scale * Vector3(float(r["x"]), float(r["y"]), float(r["z"])) for r in table]
        self.shape.updateAttrs({"surfNodes": self.nodes})
        self.spacing = scale * description["spacing"]
        mass = description["mass"]
        self.volume = scale ** 3 * mass["volume"]
        self.inertia = scale ** 5 * Vector3(*[mass["principal_moments"][k] for k in ("least", "middle", "greatest")])

    def body(self, position, orientation=Quaternion(1, 0, 0, 0), velocity=Vector3(0, 0, 0),
             material=None):
        """A body of this shape. All share it: it is as large as its grid."""
        body = Body()
        body.shape = self.shape
        body.material = material
        body.bound = Aabb()
        body.aspherical = True
        body.dynamic = True
        body.state.pos = position
        body.state.ori = orientation
        body.state.vel = velocity
        body.state.mass = self.volume * material.density
        body.state.inertia = self.inertia * material.density
        return body


class GrainContacts:
    def __init__(self, grain, normal_stiffness, shear_stiffness, friction):
        """Stiffnesses in N/m, friction as the tangent of its angle. Bodies may have other shapes than the
        grain's, with grids as fine."""
        self.normal_stiffness = float(normal_stiffness)  # a number of NumPy would make arrays of vectors
        self.shear_stiffness = float(shear_stiffness)
        self.friction = float(friction)
        # Elastic, of the contacts of the last step.
        self.energy = 0.0
        # Processor time spent here, so that a study can tell it from Yade's own.
        self.seconds = 0.0
        # Of each contact its force on the first body along the surface.
        self.tangential = {}
        # Small against a cell of the grid, in which distances are linear along each axis, so that
        # differences are exact; large against rounding.
        half = 1e-4 * grain.spacing
        self.steps = [(axis * half, 1 / (2 * half)) for axis in
                      (Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1))]

    def gradient(self, shape, point):
        """Of a shape's distances as they are interpolated. LevelSet.normal has length 1, where this is
        shorter in creases; with it a collision keeps its energy to 7 %, with this to 0.1 %."""
        distance = shape.distance
        return Vector3(*[(distance(point + step) - distance(point - step)) * scale
                         for step, scale in self.steps])

    def node(self, contact, first, second):
        """The deepest node, and the gradient of the distance that rises from the second body to the
        first. Yade's contact point lies half the depth from the node, along the node's own normal."""
        one, other = O.bodies[contact.id1].shape, O.bodies[contact.id2].shape
        depth = contact.geom.penetrationDepth
        half = contact.geom.normal * (0.5 * depth)
        node = contact.geom.contactPoint + half
        place = second.ori.conjugate() * (node - second.pos)
        if abs(other.distance(place) + depth) < 1e-6 * depth:
            return node, second.ori * self.gradient(other, place)
        node = contact.geom.contactPoint - half
        return node, -(first.ori * self.gradient(one, first.ori.conjugate() * (node - first.pos)))

    def apply(self):
        """Adds the forces of this step to the bodies'."""
        start = time.thread_time()
        before, self.tangential = self.tangential, {}
        self.energy = 0.0
        for contact in O.interactions:
            one, other = O.bodies[contact.id1], O.bodies[contact.id2]
            if contact.geom.penetrationDepth > 0 and isinstance(one.shape, LevelSet) and \
                    isinstance(other.shape, LevelSet):
                self.apply_contact(contact, one.state, other.state,
                                   before.get((contact.id1, contact.id2)))
        self.seconds += time.thread_time() - start

    def apply_contact(self, contact, first, second, before):
        if contact.phys.kn != 0:
            raise ValueError("Yade's own law acts between grains too; give kn=0 and ks=0 for two grains in "
                             "Ip2_FrictMat_FrictMat_FrictPhys, by MatchMaker's matches where there are walls.")
        node, gradient = self.node(contact, first, second)
        depth = contact.geom.penetrationDepth
        normal_force = self.normal_stiffness * depth * gradient
        across = gradient.normalized()
        arm, other_arm = node - first.pos, node - second.pos

        # What acted along the surface turns with the grains and stays along it, never longer than it
        # was: a longer one would be energy from nothing where the deepest node changes.
        tangential = Vector3(0, 0, 0)
        if before is not None:
            size = before.norm()
            tangential = before + (0.5 * O.dt) * (first.angVel + second.angVel).cross(before)
            tangential -= across * across.dot(tangential)
            if tangential.norm() > size:
                tangential *= size / tangential.norm()
        slip = first.vel + first.angVel.cross(arm) - second.vel - second.angVel.cross(other_arm)
        slip -= across * across.dot(slip)
        tangential -= (self.shear_stiffness * O.dt) * slip
        most = self.friction * normal_force.norm()
        if tangential.norm() > most:
            tangential *= most / tangential.norm()
        self.tangential[(contact.id1, contact.id2)] = tangential

        force = normal_force + tangential
        O.forces.addF(contact.id1, force)
        O.forces.addT(contact.id1, arm.cross(force))
        O.forces.addF(contact.id2, -force)
        O.forces.addT(contact.id2, -other_arm.cross(force))
        self.energy += 0.5 * self.normal_stiffness * depth ** 2
        self.energy += 0.5 * tangential.squaredNorm() / self.shear_stiffness


def kinetic_energy(bodies):
    """Of moving and turning, J."""
    total = 0.0
    for body in bodies:
        state = body.state
        turn = state.ori.conjugate() * state.angVel
        total += 0.5 * state.mass * state.vel.squaredNorm()
        total += 0.5 * sum(state.inertia[k] * turn[k] ** 2 for k in range(3))
    return total
