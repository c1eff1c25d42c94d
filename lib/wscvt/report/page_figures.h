// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/report/html_document.h"

namespace wscvt {

/// A mesh shown in an HTML report, closed and outward (see check_mesh).
struct ShownMesh {
  const IndexedMesh& mesh;
  std::string name;
  /// Of each face the number of its part or sphere, modulo 256, for its colour. Empty: all is grey,
  /// with edges if the faces are few.
  std::vector<std::uint8_t> parts = {};
};

/// Figures of a mesh and of its reference.
struct PageFigures {
  /// Both meshes from one viewpoint, and the second with its signed distance to the first in
  /// colour. Without a reference, only the second mesh.
  std::vector<Figure> pictures;
  /// Histograms of edge length, edge ratio and angle of both meshes, and of the signed distance.
  std::vector<Figure> distributions;
  /// HTML for the end of the page, which makes the pictures turn.
  std::string views;
};

/// Draws the figures. Scale and histogram of the distances use `samples`, points on the surface of
/// `shown`; if empty, 20,000 points spread over it. Throws Error(InvalidInput) for a mesh without
/// faces, Error(Cancelled).
PageFigures page_figures(const std::optional<ShownMesh>& reference, const ShownMesh& shown,
                         const Execution& execution, const std::vector<Vector3>& samples = {});

}  // namespace wscvt
