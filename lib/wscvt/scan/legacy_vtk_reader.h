// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/byte_reader.h"

namespace wscvt {

/// Reads a mesh from a VTK file from before XML, text or binary, of any version: polygonal data, or
/// an unstructured grid of triangles, quads, polygons and strips. Vertices and lines are passed
/// over; what the points and faces carry is not read. A file without faces gives points alone.
/// Throws as read_mesh; so do grids of volumes.
IndexedMesh read_legacy_vtk(ByteReader& reader);

}  // namespace wscvt
