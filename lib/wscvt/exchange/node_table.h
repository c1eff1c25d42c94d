// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The nodes of a grain as contact laws take them.
struct NodeTable {
  IndexedMesh mesh;  ///< the nodes are its points
  /// Unit, outward: the mean of the normals of the triangles about the node, by area.
  std::vector<Vector3> normals;
  /// A third of the triangles' about the node, so that all add up to the mesh's; length^2.
  std::vector<double> areas;
};

/// Of a closed, outward mesh without points that no triangle uses.
NodeTable node_table(IndexedMesh mesh);

/// As CSV after RFC 4180: x, y, z, nx, ny, nz and area of a node in a row, under a header. Numbers
/// read back to the same bits.
std::string nodes_csv(const NodeTable& nodes);

/// As VTK's XML PolyData (.vtp), for ParaView: the mesh with the arrays "normal" and "area" at its
/// points. Text, whose numbers read back to the same bits. Written here and not by VTK, whose
/// Debian package brings 172 others and 519 MB for these forty lines.
std::string nodes_vtp(const NodeTable& nodes);

}  // namespace wscvt
