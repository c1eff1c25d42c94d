// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Edges of the smallest-volume oriented box about the points, by the optimisation of Chang,
/// Gorissen and Melchior (2011), "Fast oriented bounding box optimization on the rotation group
/// SO(3,R)", ACM Trans. Graph. 30, 122 (CGAL::oriented_bounding_box, fixed seed): near the
/// smallest, not proved so; more than 2,000 points are first thinned to the extreme ones in 2,000
/// directions. The edges bound the points exactly. Throws Error(InvalidInput) for fewer than four
/// points, coordinates that are not finite and extents not between 1e-60 and 1e60,
/// Error(Cancelled). Takes one thread.
FormAxes oriented_box_axes(const std::vector<Vector3>& points,
                           const Execution& execution = Execution(1));

/// Of dimensions > 0. Throws nothing.
FormRatios form_ratios(const FormAxes& axes);

}  // namespace wscvt
