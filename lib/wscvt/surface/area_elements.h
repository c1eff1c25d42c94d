// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/sphere_surface.h"

namespace wscvt {

/// A surface in some directions, one value each.
struct AreaElements {
  std::vector<double> radii;     ///< length
  std::vector<double> elements;  ///< dA/dOmega, see area_element; length^2
};

/// Radii and area elements in `directions`, unit vectors. As surface.jets(), without keeping a jet
/// of thirteen numbers a direction. Errors as surface.evaluate(), and Error(Cancelled).
AreaElements area_elements(const RadialSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution);

}  // namespace wscvt
