// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Edges of the smallest-volume oriented box about the points: over the directions of one edge
/// (smallest_over_directions), of the smallest rectangle about the points seen along it
/// (smallest_rectangle) times the extent along it. The volume comes to 0.1 % of the smallest and is
/// the same in every pose; a search in the pose as given, by the optimisation of Chang, Gorissen
/// and Melchior (2011, ACM Trans. Graph. 30, 122; CGAL::oriented_bounding_box), left axes that
/// moved by 1.2 % when a body was turned. The search begins with the
/// extreme points of 200 and 2,000 directions and ends with all; the edges bound all points. Give
/// the points of the convex hull. Throws Error(InvalidInput) for fewer than four points,
/// coordinates that are not finite and extents not between 1e-60 and 1e60, Error(Cancelled). Takes
/// one thread.
FormAxes oriented_box_axes(const std::vector<Vector3>& points,
                           const Execution& execution = Execution(1));

/// Of dimensions > 0. Throws nothing.
FormRatios form_ratios(const FormAxes& axes);

}  // namespace wscvt
