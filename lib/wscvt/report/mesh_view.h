// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/picture.h"

namespace wscvt {

/// Where meshes are looked at from, without perspective.
struct MeshView {
  Vector3 right = Vector3::UnitX();  ///< unit, along the rows of the picture
  Vector3 up = Vector3::UnitZ();     ///< unit, from the bottom of the picture to its top
  Vector3 centre = Vector3::Zero();  ///< seen in the middle
  double half_size = 1.0;            ///< from the middle to the edges, length, > 0
  int pixels = 840;                  ///< width and height, > 0
};

/// A view from the side and somewhat above that holds the meshes whole; z is up.
MeshView view_of(const std::vector<const IndexedMesh*>& meshes, int pixels);

/// What a view sees, pixel by pixel.
struct SeenMesh {
  std::vector<std::int32_t> faces;  ///< -1 where there is none
  std::vector<Vector3> points;      ///< on the face
  std::vector<double> edges;        ///< distance to the nearest edge of the face, in pixels
};

/// Looks at a closed, outward mesh: faces that look away are hidden. Of two at the same depth the
/// first is seen, so that the same mesh gives the same picture.
SeenMesh look_at(const IndexedMesh& mesh, const MeshView& view);

/// Draws what is seen, lit from above the viewer. `colour_of` gives the colours of points on the
/// surface, one for each of an array, for squares of 2 x 2 pixels, which become one when the
/// picture is halved; without it all is grey. Edges are drawn if asked for.
Picture draw(const IndexedMesh& mesh, const SeenMesh& seen, const MeshView& view, bool with_edges,
             const std::function<std::vector<Colour>(const std::vector<Vector3>&)>& colour_of);

}  // namespace wscvt
