// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/html_document.h"

namespace wscvt {

/// A mesh that a page shows, closed and outward (see check_mesh).
struct ShownMesh {
  const IndexedMesh& mesh;
  std::string name;
};

/// What a page shows of a mesh and of what it is compared with.
struct PageFigures {
  /// Both meshes seen from one place, and the second with its signed distance to the first in
  /// colour; the second alone without a reference.
  std::vector<Figure> pictures;
  /// Histograms of edge length, edge ratio and angle of both meshes, and of the signed distance.
  std::vector<Figure> distributions;
};

/// The scale of the distances and their histogram are those of `samples`, points of the surface of
/// `shown`; if there are none, of 20,000 points all over it. Throws Error(InvalidInput) for a mesh
/// without faces, Error(Cancelled).
PageFigures page_figures(const std::optional<ShownMesh>& reference, const ShownMesh& shown,
                         const Execution& execution, const std::vector<Vector3>& samples = {});

}  // namespace wscvt
