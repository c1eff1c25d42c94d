// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/mesh_view.h"

namespace wscvt {

/// A mesh that a page shows in the place of a picture.
struct TurningMesh {
  const IndexedMesh& mesh;
  bool with_edges = false;
  /// Returns signed distances at points, which colour the mesh from -limit to limit. May be empty.
  std::function<std::vector<double>(const std::vector<Vector3>&)> distances;
  double limit = 0.0;
  std::vector<std::uint8_t> parts = {};  ///< of the faces, for their colours. May be empty
};

/// Returns the HTML of the k-th picture of a page, which turns if turning_views has its mesh.
std::string turning_picture(const std::string& image, std::size_t k);

/// Returns HTML for the end of a page: the meshes in the order of their pictures, and a script that
/// draws them by WebGL, first as in `view`. They turn together, with the mouse, a finger or the
/// arrow keys. Where WebGL or scripts are missing and on paper, the pictures are seen. A mesh of
/// more than 60,000 points is drawn coarser, without edges and parts.
std::string turning_views(const std::vector<TurningMesh>& meshes, const MeshView& view);

}  // namespace wscvt
