// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sample/harmonic_grid.h"
#include "wscvt/sample/offset_surface.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

/// A real grain of a sample, without its pose and its size.
struct SampleGrain {
  double radius = 0.0;  ///< of the sphere of equal volume, length
  /// The radius in the principal frame about the centroid, x along the longest axis, at the size of
  /// radius 1: an SH series of the degree of the sample.
  std::vector<double> radial;
  /// Standard deviations of the volume along the principal axes at that size, descending.
  Vector3 deviations = Vector3::Zero();
  /// The white grain is the grain stretched along its principal axes to the inertia of a sphere of
  /// radius 1, so that it has no form. The series is that of the logarithm of its radius.
  std::vector<double> white;
  /// Of a grain with more overhangs than usual_fold_limit_percent: the surface is r(u) u + o(u) in
  /// either frame, u spread over the scan. Empty for other grains.
  OffsetSeries radial_offset;
  OffsetSeries white_offset;
  double sphericity = 0.0;  ///< Wadell's, of the series on SampleGrids::sphere; no unit
  double convexity = 0.0;   ///< likewise; volume over that of the convex hull
};

/// The grids on which the grains of a sample of one degree are read and grown. The white grains
/// have 1.6 times the degree, rounded: stretching moves waves to higher degrees.
class SampleGrids {
 public:
  /// Throws Error(InvalidInput) for a degree not in [4, 56].
  explicit SampleGrids(int degree);

  int degree() const { return radial_.degree(); }
  const HarmonicGrid& radial() const { return radial_; }  ///< of grown grains
  const HarmonicGrid& white() const { return white_; }    ///< of grown white grains
  const HarmonicGrid& fine_radial() const {
    return fine_radial_;
  }                                                               ///< of scans, four rows a degree
  const HarmonicGrid& fine_white() const { return fine_white_; }  ///< likewise
  const IndexedMesh& sphere() const { return sphere_; }           ///< that grains are measured on

 private:
  HarmonicGrid radial_;
  HarmonicGrid white_;
  HarmonicGrid fine_radial_;
  HarmonicGrid fine_white_;
  IndexedMesh sphere_;
};

/// A grain given by the SH series of its radius. About its centroid it may have overhangs, as a
/// mesh. Throws Error(InvalidInput) if the series is not positive everywhere, and as of a mesh.
SampleGrain sample_grain(const HarmonicSurface& surface, const SampleGrids& grids,
                         const Execution& execution);

/// A grain given by a closed, outward mesh, as checked by check_mesh. The outermost layer of small
/// overhangs is read. If they exceed usual_fold_limit_percent, the mesh is spread over the sphere
/// and has offsets; small handles are cut as HandleOptions has them. Throws Error: InvalidInput if
/// the mesh encloses no volume, or if it has overhangs and a larger handle or walls too thin for
/// the degree, and as spread_over_directions; Cancelled.
SampleGrain sample_grain(const IndexedMesh& mesh, const SampleGrids& grids,
                         const Execution& execution);

/// The logarithm of the radius of a surface about the origin, for many directions; false if there
/// is none.
using LogRadii =
    std::function<bool(const std::vector<Vector3>& directions, std::vector<double>& values)>;

/// The surface in other coordinates y, x = centre + axes y: its radii t in directions d, so that
/// centre + t axes d lies on the surface. Nothing if rays from the centre meet the surface more
/// than once, or are so near to it that the iteration does not settle.
std::optional<std::vector<double>> radii_in_frame(const LogRadii& surface, const Vector3& centre,
                                                  const Eigen::Matrix3d& axes,
                                                  const std::vector<Vector3>& directions);

}  // namespace wscvt
