#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of meshes of one scan, each made by any program, measured without wscvt.

    tests/figures/study/beside_others.py SCAN MESH...

Prints one row per mesh: vertices, mean edge ratio of the triangles, smallest angle in degrees, coefficient of
variation of the edge length, errors of volume and area in %, and the two-sided rms and largest distance in % of the
scan's equivalent radius: of 100,000 random points of each surface and of all vertices. Needs Debian's python3-vtk9.
"""
import math
import pathlib
import sys

import numpy
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

READERS = {".ply": vtk.vtkPLYReader, ".stl": vtk.vtkSTLReader, ".obj": vtk.vtkOBJReader}
SAMPLES = 100_000


class Surface:
    """A closed mesh with one vertex in each place."""

    def __init__(self, path):
        reader = READERS[path.suffix.lower()]()
        reader.SetFileName(str(path))
        weld = vtk.vtkCleanPolyData()
        weld.SetTolerance(0.0)
        weld.ConvertLinesToPointsOff()
        weld.SetInputConnection(reader.GetOutputPort())
        weld.Update()
        self.data = weld.GetOutput()
        self.vertices = vtk_to_numpy(self.data.GetPoints().GetData()).astype(float)
        self.faces = vtk_to_numpy(self.data.GetPolys().GetData()).reshape(-1, 4)[:, 1:]
        self.corners = self.vertices[self.faces]
        a, b, c = self.corners.transpose(1, 0, 2)
        self.areas = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
        self.area = self.areas.sum()
        self.volume = abs((a * numpy.cross(b, c)).sum() / 6.0)

    def points(self):
        """Random points, evenly by area, and all vertices."""
        random = numpy.random.default_rng(1)
        face = random.choice(len(self.faces), SAMPLES, p=self.areas / self.area)
        u, v = numpy.sqrt(random.random(SAMPLES)), random.random(SAMPLES)
        weights = numpy.stack([1.0 - u, u * (1.0 - v), u * v], axis=1)
        return numpy.concatenate([(self.corners[face] * weights[:, :, None]).sum(axis=1), self.vertices])

    def distances_of(self, points):
        field = vtk.vtkImplicitPolyDataDistance()
        field.SetInput(self.data)
        values = vtk.vtkDoubleArray()
        field.FunctionValue(numpy_to_vtk(points), values)
        return numpy.abs(vtk_to_numpy(values))


def quality(mesh):
    """Mean edge ratio, smallest angle and coefficient of variation of the edges, each counted once."""
    lengths = numpy.linalg.norm(mesh.corners[:, [1, 2, 0]] - mesh.corners, axis=2)
    ends = numpy.sort(mesh.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    once = lengths.ravel()[numpy.unique(ends, axis=0, return_index=True)[1]]
    short, middle, long = numpy.sort(lengths, axis=1).T
    cosine = (middle**2 + long**2 - short**2) / (2.0 * middle * long)
    return (long / short).mean(), math.degrees(math.acos(cosine.max())), once.std() / once.mean()


def row(path, scan):
    mesh = Surface(path)
    radius = (0.75 * scan.volume / math.pi)**(1.0 / 3.0)
    sides = [scan.distances_of(mesh.points()), mesh.distances_of(scan.points())]
    rms = max(math.sqrt((side[:SAMPLES]**2).mean()) for side in sides)
    ratio, angle, variation = quality(mesh)
    return (f"| `{path.stem}` | {len(mesh.vertices)} | {ratio:.3f} | {angle:.1f} | {variation:.3f} "
            f"| {100.0 * (mesh.volume / scan.volume - 1.0):+.3f} | {100.0 * (mesh.area / scan.area - 1.0):+.2f} "
            f"| {100.0 * rms / radius:.3f} | {100.0 * max(side.max() for side in sides) / radius:.2f} |")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    scan = Surface(pathlib.Path(sys.argv[1]))
    print("| mesh | nodes | ratio | angle | ECV | volume | area | rms | largest |\n" + "|---" * 9 + "|")
    for name in sys.argv[2:]:
        print(row(pathlib.Path(name), scan), flush=True)


if __name__ == "__main__":
    main()
