// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Transfers the numbers at a scan's vertices and faces to another mesh in the same position.
///
/// A vertex of `mesh` gets the numbers of the nearest point of the scan's surface. Colours (red,
/// green, blue, alpha) and numbers with fractions are interpolated within the scan's triangle.
/// Other whole numbers, such as labels, are copied from the triangle's corner with the largest
/// weight. A face gets the numbers of the scan's face nearest to its centroid. If the scan has no
/// faces, a vertex gets the numbers of the nearest scan point.
///
/// A texture becomes red, green and blue at the vertices: the picture's colour at the nearest
/// point, interpolated between four pixels, or white if there is no picture. If the scan's vertices
/// have colours, these are used instead of a texture. A texture without any picture gives no
/// colour.
///
/// The result has the names and types of `attributes`, one value for each vertex or face, and no
/// texture. It does not depend on the number of threads. It has no attributes if the scan has no
/// points, or only faces without area. Throws Error(InvalidInput) if the number of values differs
/// from the scan's vertices or faces, or if a picture's size does not match its colours. Throws
/// Error(Cancelled).
MeshAttributes carried_attributes(const IndexedMesh& scan, const MeshAttributes& attributes,
                                  const IndexedMesh& mesh,
                                  const Execution& execution = Execution(1));

}  // namespace wscvt
