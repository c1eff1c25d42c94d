// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Descriptors that are measured in a moment.
struct QuickShape {
  ShapeDescriptors shape;
  FormRatios form;         ///< of the inertia ellipsoid
  double convexity = 0.0;  ///< volume over that of the convex hull; no unit
};

/// Throws as describe_shape.
QuickShape quick_shape(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
