# SPDX-License-Identifier: GPL-3.0-or-later
# python3 gmsh_test.py MESH DESCRIPTION: checks that the volume of Gmsh's tetrahedra is the grain's. The
# fitted remesh encloses it exactly, and STL keeps 24 bits of it.
import json
import sys

import numpy

lines = open(sys.argv[1]).read().split("\n")
at = lines.index("$Nodes")
count = int(lines[at + 1])
points = {int(w[0]): [float(x) for x in w[1:]] for w in map(str.split, lines[at + 2:at + 2 + count])}
at = lines.index("$Elements")
count = int(lines[at + 1])
elements = [[int(x) for x in line.split()] for line in lines[at + 2:at + 2 + count]]
corners = numpy.array([[points[v] for v in e[-4:]] for e in elements if e[1] == 4])
a, b, c, d = (corners[:, k] for k in range(4))
volumes = numpy.einsum("ij,ij->i", b - a, numpy.cross(c - a, d - a)) / 6
volume = json.load(open(sys.argv[2]))["mass"]["volume"]
assert volumes.min() > 0
assert abs(volumes.sum() / volume - 1) < 1e-5, volumes.sum() / volume
print("Gmsh: %d tetrahedra, volume %.7f of the grain's" % (len(corners), volumes.sum() / volume))
