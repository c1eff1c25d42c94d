// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Carries the numbers of a scan's vertices and faces onto another mesh in the same place.
///
/// A vertex of `mesh` takes the numbers of the scan's point nearest to it. Colours (red, green,
/// blue, alpha) and numbers with fractions are interpolated within the scan's triangle; other whole
/// numbers, such as labels, are those of its corner with the largest weight. A face takes the
/// numbers of the scan's face nearest to its middle. If the scan has no faces, a vertex takes the
/// numbers of the nearest point.
///
/// A texture becomes red, green and blue of the vertices: the picture's colour at the nearest
/// point, interpolated between its four pixels there, or white if no picture lies there. Colours
/// that the scan's vertices have go before a texture. A texture without any picture gives none.
///
/// The result has the names and types of `attributes`, and one value for each vertex or face; no
/// texture. It is the same on any number of threads. Attributes are none if the scan has no points,
/// or faces without area only. Throws Error(InvalidInput) for another number of values than of the
/// scan's vertices or faces and for a picture with another number of colours than its size says,
/// and Error(Cancelled).
MeshAttributes carried_attributes(const IndexedMesh& scan, const MeshAttributes& attributes,
                                  const IndexedMesh& mesh,
                                  const Execution& execution = Execution(1));

}  // namespace wscvt
