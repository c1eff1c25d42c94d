# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshing of scanned grains to an exact number of nodes.

>>> import wscvt
>>> vertices, faces = wscvt.read_mesh("scan.ply")
>>> result = wscvt.remesh(vertices, faces, nodes=1000)
>>> result.vertices.shape, result.faces.shape
((1000, 3), (1996, 3))

Lengths are in the unit of the mesh. The stub beside this file says what each function takes,
returns and raises.
"""
from ._wscvt import (Error, Remesh, __version__, create, describe, options, read_mesh, remesh,
                     write_mesh)

__all__ = ["Error", "Remesh", "create", "describe", "options", "read_mesh", "remesh", "write_mesh"]
