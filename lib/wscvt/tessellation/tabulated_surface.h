// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/pi.h"
#include "wscvt/surface/sphere_surface.h"
#include "wscvt/tessellation/cap_sums.h"

namespace wscvt {

/// Surface quantities for the weightings, at the nodes of an equal-angle grid. Each is computed on
/// first use, because derivatives cost three times as much as distances. Not thread-safe.
class TabulatedSurface {
 public:
  /// For `node_count` seeds. The surface must outlive the table.
  TabulatedSurface(const SphereSurface& surface, int node_count, const Execution& execution);

  const SphereSurface& surface() const { return surface_; }
  int node_count() const { return node_count_; }
  int rows() const;  ///< of the grid
  /// Returns distances from the origin to the surface at the grid's nodes; the radii of a radial
  /// surface.
  const std::vector<double>& distances() const;
  const GridField& area_elements() const;  ///< dA/dOmega at the grid's nodes
  /// Returns S, the surface's area: from the area elements if they were computed, else by
  /// quadrature; both within 1e-3.
  double area() const;
  /// Returns the radius of the sphere of the same area.
  double radius() const { return std::sqrt(area() / (4.0 * pi)); }

 private:
  const SphereSurface& surface_;
  int node_count_;
  Execution execution_;
  mutable std::vector<double> distances_;
  mutable std::optional<GridField> area_elements_;
};

}  // namespace wscvt
