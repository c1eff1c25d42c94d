// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The nodes of a grain as contact laws need them.
struct NodeTable {
  IndexedMesh mesh;  ///< the nodes are its points
  /// Unit, outward: the area-weighted mean of the normals of the node's triangles.
  std::vector<Vector3> normals;
  /// A third of the area of the node's triangles; all sum to the mesh's area; length^2.
  std::vector<double> areas;
};

/// Makes the table of a closed, outward mesh in which every point has a triangle.
NodeTable node_table(IndexedMesh mesh);

/// Returns CSV (RFC 4180): a header, then x, y, z, nx, ny, nz and area, a row per node. Numbers
/// read back to the same bits.
std::string nodes_csv(const NodeTable& nodes);

/// Returns VTK's XML PolyData (.vtp), for ParaView: the mesh with the point arrays "normal" and
/// "area". It is text; numbers read back to the same bits. Not written by VTK, whose Debian package
/// brings 172 others and 519 MB for these forty lines.
std::string nodes_vtp(const NodeTable& nodes);

}  // namespace wscvt
