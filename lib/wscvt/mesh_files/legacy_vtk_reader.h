// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"

namespace wscvt {

/// Reads a mesh from a legacy VTK file (not XML), text or binary, of any version: polygonal data,
/// or an unstructured grid of triangles, quads, polygons and strips. Skips vertices, lines and the
/// data of points and faces. A file without faces gives only points. Throws as read_mesh, also for
/// grids of volumes.
IndexedMesh read_legacy_vtk(ByteReader& reader);

}  // namespace wscvt
