// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Limits of a scan's size, the largest extent along an axis. Between them, all computed numbers
/// are in the range of a double. The inertia tensor grows with the fifth power of the size.
inline constexpr double smallest_scan_size = 1e-60;
inline constexpr double largest_scan_size = 1e60;

/// Throws Error(InvalidInput) if the points' size is outside these limits. Does not check for
/// points that are not finite or all equal: check_mesh and mesh_of_points refuse them.
void check_scan_size(const std::vector<Vector3>& points);

/// Checks the extents along the axes likewise.
void check_scan_size(const Vector3& extents);

/// Returns a warning if the rounding steps of the coordinates are coarse for the faces, else an
/// empty text. Finds two kinds of rounding: to single precision, if the scan is far from the
/// origin, and to a number of decimals, if faces have lost their corners. Empty also if an index is
/// out of range; check_mesh refuses such a mesh.
std::string precision_warning(const IndexedMesh& mesh);

/// Returns only the warning on coordinates in single precision far from the origin, or an empty
/// text. It begins with the mesh's `name`, such as "The scan".
std::string single_precision_warning(const IndexedMesh& mesh, const std::string& name);

/// Drops the faces with a corner that is not finite. Returns their number. Later code need not
/// check indices and corners: CGAL's trees of boxes do not terminate if a coordinate is NaN. Throws
/// Error(InvalidInput) if the mesh has no vertices or no faces, more than can be numbered, an index
/// out of range, or no usable face.
std::size_t keep_usable_faces(IndexedMesh& mesh);

/// Returns the points in ascending order, each once. Throws Error(InvalidInput) for fewer than 4
/// different points, coordinates that are not finite, or an extent not between 1e-60 and 1e60;
/// Error(Cancelled).
std::vector<Vector3> different_points(std::vector<Vector3> points, const Execution& execution);

}  // namespace wscvt
