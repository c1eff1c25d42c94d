// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Descriptors that are quick to measure.
struct QuickShape {
  ShapeDescriptors shape;
  FormRatios form;         ///< of the inertia ellipsoid
  double convexity = 0.0;  ///< volume / volume of the convex hull; no unit
};

/// Measures a mesh. Throws as describe_shape.
QuickShape quick_shape(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
