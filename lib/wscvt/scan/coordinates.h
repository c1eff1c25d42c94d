// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Sizes of a scan, the largest extent along an axis, between which nothing that is computed from
/// it leaves the range of a double: the inertia tensor goes with the fifth power of the size.
inline constexpr double smallest_scan_size = 1e-60;
inline constexpr double largest_scan_size = 1e60;

/// Throws Error(InvalidInput) for points whose size lies outside of these limits. Says nothing
/// about points that are not finite or all in one place, which check_mesh and mesh_of_points
/// refuse.
void check_scan_size(const std::vector<Vector3>& points);

/// The same of the extents along the axes.
void check_scan_size(const Vector3& extents);

/// A sentence when the steps in which the coordinates come are coarse for the faces; empty when
/// they are not. Steps are told from rounding to single precision, which a scan far from the origin
/// suffers from, and to a number of decimals, which counts where faces have lost their corners.
/// Empty too when an index does not fit, which check_mesh refuses.
std::string precision_warning(const IndexedMesh& mesh);

/// Of these the sentence on coordinates in single precision far from the origin, or nothing.
std::string single_precision_warning(const IndexedMesh& mesh);

}  // namespace wscvt
