# SPDX-License-Identifier: GPL-3.0-or-later
# python3 vtk_test.py NODES_CSV NODES_VTP GRID_NPY GRID_VTI: reads the files with VTK's readers, which
# ParaView uses too, and compares them with each other and with VTK's own distances.
import json
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPolyDataReader


def read(reader, path):
    if reader.CanReadFile(path) != 1:
        sys.exit("FAILED: VTK cannot read " + path)
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode() != 0:
        sys.exit("FAILED: VTK finds an error in " + path)
    return reader.GetOutput()


nodes_csv, nodes_vtp, grid_npy, grid_vti = sys.argv[1:]
table = numpy.genfromtxt(nodes_csv, delimiter=",", names=True)
mesh = read(vtkXMLPolyDataReader(), nodes_vtp)
points = vtk_to_numpy(mesh.GetPoints().GetData())
normals = vtk_to_numpy(mesh.GetPointData().GetNormals())
areas = vtk_to_numpy(mesh.GetPointData().GetArray("area"))
assert mesh.GetNumberOfPolys() == 2 * len(table) - 4
assert numpy.array_equal(points, numpy.stack([table["x"], table["y"], table["z"]], 1))
assert numpy.array_equal(normals, numpy.stack([table["nx"], table["ny"], table["nz"]], 1))
assert numpy.array_equal(areas, table["area"])

description = json.load(open(grid_npy + ".json"))
distances = numpy.load(grid_npy)
image = read(vtkXMLImageDataReader(), grid_vti)
assert distances.shape == image.GetDimensions()
assert image.GetOrigin() == tuple(description["origin"][a] for a in "xyz")
assert set(image.GetSpacing()) == {description["spacing"]}
values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(distances.shape, order="F")
assert numpy.array_equal(values, distances)

# The grid is of the remesh, whose distances VTK finds another way.
other = vtkImplicitPolyDataDistance()
other.SetInput(mesh)
random = numpy.random.RandomState(1)
worst = 0.0
for _ in range(2000):
    place = [random.randint(n) for n in distances.shape]
    point = numpy.array(image.GetOrigin()) + description["spacing"] * numpy.array(place)
    worst = max(worst, abs(other.EvaluateFunction(point) - distances[tuple(place)]))
size = (6 * description["mass"]["volume"] / numpy.pi) ** (1 / 3)
assert worst < 1e-5 * size, worst
print("VTK: %d nodes, grid of %d x %d x %d, largest difference to VTK's distances %.1e of the "
      "diameter" % ((len(table),) + distances.shape + (worst / size,)))
