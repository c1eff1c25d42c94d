# SPDX-License-Identifier: GPL-3.0-or-later
"""A grain of wscvt in Yade: one shape, with the nodes and the distances of two files, for any number
of bodies. In your own script: from yade_grain import Grain. Lengths are in the unit of the files.

    wscvt scan.ply remesh.ply -n 200 --frame principal --size 0.1 --node-table nodes.csv --sdf grid.npy
"""
import json

import numpy
from yade import Aabb, Body, LevelSet, Quaternion, RegularGrid, Vector3, Vector3i


class Grain:
    def __init__(self, nodes_csv, grid_npy):
        """Both files in the principal frame (--frame principal)."""
        with open(grid_npy + ".json") as file:
            description = json.load(file)
        if description["frame"]["name"] != "principal":
            raise ValueError("Yade's bodies lie in their principal axes; write --frame principal.")
        distances = numpy.load(grid_npy)
        axes = "xyz"
        self.shape = LevelSet(
            lsGrid=RegularGrid(
                min=Vector3(*[description["origin"][a] for a in axes]),
                nGP=Vector3i(*[description["counts"][a] for a in axes]),
                spacing=description["spacing"]),
            distField=distances.tolist(), nSurfNodes=8, nodesPath=2)
        # Read before the nodes are set: Yade makes its own with it.
        self.voxel_volume = self.shape.volume()
        table = numpy.genfromtxt(nodes_csv, delimiter=",", names=True)
        self.nodes = [Vector3(float(r["x"]), float(r["y"]), float(r["z"])) for r in table]
        self.shape.updateAttrs({"surfNodes": self.nodes})
        self.spacing = description["spacing"]
        mass = description["mass"]
        self.volume = mass["volume"]
        self.inertia = Vector3(*[mass["principal_moments"][k] for k in ("least", "middle", "greatest")])

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


def kinetic_energy(bodies):
    """Of moving and turning, J."""
    total = 0.0
    for body in bodies:
        state = body.state
        turn = state.ori.conjugate() * state.angVel
        total += 0.5 * state.mass * state.vel.squaredNorm()
        total += 0.5 * sum(state.inertia[k] * turn[k] ** 2 for k in range(3))
    return total
