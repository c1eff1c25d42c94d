# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshing of scanned grains to an exact number of nodes.

>>> import wscvt
>>> result = wscvt.remesh("scan.ply", 1000)
>>> result.vertices.shape, result.faces.shape
((1000, 3), (1996, 3))

A mesh is two arrays (vertices, faces), the path of a file, or a mesh of trimesh or PyVista. Lengths
are in the unit of the mesh. The stub beside this file says what each function takes, returns and
raises.
"""
import numbers
import os

from . import _wscvt
from ._wscvt import Error, Remesh, __version__, create, options

__all__ = ["Error", "Remesh", "create", "describe", "options", "read_mesh", "remesh", "write_mesh"]


def _arrays(mesh, faces):
    """The vertices and faces of what a caller calls a mesh."""
    if faces is not None:
        return mesh, faces
    if isinstance(mesh, (str, os.PathLike)):
        return read_mesh(mesh)
    if hasattr(mesh, "regular_faces"):  # PyVista
        return mesh.points, mesh.regular_faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh
        return mesh.vertices, mesh.faces
    return mesh, None


def remesh(vertices, faces=None, nodes=None, **options):
    # remesh("scan.ply", 500) and remesh(mesh, 500)
    if isinstance(faces, numbers.Integral) and nodes is None:
        faces, nodes = None, faces
    if nodes is not None:
        options["nodes"] = nodes
    if isinstance(vertices, (str, os.PathLike)):
        options.setdefault("source", os.path.basename(vertices))
    return _wscvt.remesh(*_arrays(vertices, faces), **options)


def describe(vertices, faces=None, reference=None, **options):
    return _wscvt.describe(*_arrays(vertices, faces), reference, **options)


def read_mesh(path):
    return _wscvt.read_mesh(os.fspath(path))


def write_mesh(path, vertices, faces=None):
    _wscvt.write_mesh(os.fspath(path), *_arrays(vertices, faces))


for _function in (remesh, describe, read_mesh, write_mesh):
    _function.__doc__ = getattr(_wscvt, _function.__name__).__doc__
del _function
