// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/picture.h"

namespace wscvt {

/// A view of meshes, without perspective.
struct MeshView {
  Vector3 right = Vector3::UnitX();  ///< unit, along the rows of the picture
  Vector3 up = Vector3::UnitZ();     ///< unit, from the bottom of the picture to its top
  Vector3 centre = Vector3::Zero();  ///< seen in the middle
  double half_size = 1.0;            ///< from the middle to the edges, length, > 0
  int pixels = 840;                  ///< width and height, > 0
};

/// Returns a view from the side and slightly above that shows the meshes completely; z is up.
MeshView view_of(const std::vector<const IndexedMesh*>& meshes, int pixels);

/// Visible face, point and edge distance per pixel.
struct SeenMesh {
  std::vector<std::int32_t> faces;  ///< -1 where there is none
  std::vector<Vector3> points;      ///< on the face
  std::vector<double> edges;        ///< distance to the nearest edge of the face, in pixels
};

/// Finds the visible faces of a closed, outward mesh. Faces that point away are hidden. If two
/// faces have the same depth, the first is visible, so a mesh always gives the same picture.
SeenMesh look_at(const IndexedMesh& mesh, const MeshView& view);

/// Draws the visible surface, lit from above the viewer. `colour_of` returns one colour per point
/// of an array. It is called for squares of 2 x 2 pixels, because halving the picture merges them.
/// Without `colour_of` each face has the colour of its part, and is grey without parts. Edges are
/// drawn on request.
Picture draw(const IndexedMesh& mesh, const SeenMesh& seen, const MeshView& view, bool with_edges,
             const std::function<std::vector<Colour>(const std::vector<Vector3>&)>& colour_of,
             const std::vector<std::uint8_t>& parts = {});

/// Returns a small grey picture of a mesh. `pixels`: width and height, > 0.
Picture thumbnail_of(const IndexedMesh& mesh, int pixels);

}  // namespace wscvt
