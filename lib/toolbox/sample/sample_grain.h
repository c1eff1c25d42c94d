// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "toolbox/sample/harmonic_grid.h"
#include "toolbox/sample/offset_surface.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {

/// Degree of the series with which grains of a sample are read and grown.
inline constexpr NumberOption<int> sample_degree_option = {
    "degree", "degree of the SH series", 4, 56, Ends::Both, "detail of the virtual grains"};

/// Descriptors that are quick to measure.
struct QuickShape {
  ShapeDescriptors shape;
  FormRatios form;         ///< of the inertia ellipsoid
  double convexity = 0.0;  ///< volume / volume of the convex hull; no unit
};

/// Measures a mesh. Throws as describe_shape.
QuickShape quick_shape(const IndexedMesh& mesh, const Execution& execution);

/// A real grain of a sample, without its pose and its size.
struct SampleGrain {
  double radius = 0.0;  ///< of the sphere of equal volume, length
  /// SH series of the radius in the principal frame about the centroid, x along the longest axis,
  /// scaled to radius 1; of the sample's degree.
  std::vector<double> radial;
  /// Standard deviations of the volume along the principal axes at this size, descending.
  Vector3 deviations = Vector3::Zero();
  /// The white grain is the grain stretched along its principal axes to the inertia of a sphere of
  /// radius 1, so that it has no form. The series is of the logarithm of its radius.
  std::vector<double> white;
  /// If a grain has more overhangs than usual_overhang_limit_percent, the surface is r(u) u + o(u)
  /// in either frame, with u spread over the scan. Empty for other grains.
  OffsetSeries radial_offset;
  OffsetSeries white_offset;
  double sphericity = 0.0;  ///< Wadell's, of the series on SampleGrids::sphere; no unit
  double convexity = 0.0;   ///< likewise; volume / volume of the convex hull
};

/// The grids on which the grains of a sample of one degree are read and grown. White grains have
/// 1.6 times the degree, rounded, because stretching moves waves to higher degrees.
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
  const IndexedMesh& sphere() const { return sphere_; }           ///< on which grains are measured

 private:
  HarmonicGrid radial_;
  HarmonicGrid white_;
  HarmonicGrid fine_radial_;
  HarmonicGrid fine_white_;
  IndexedMesh sphere_;
};

/// Reads a grain given by the SH series of its radius. If it has overhangs about its centroid, it
/// is read as a mesh. Throws Error(InvalidInput) if the series is not positive everywhere, and as
/// for a mesh.
SampleGrain sample_grain(const HarmonicSurface& surface, const SampleGrids& grids,
                         const Execution& execution);

/// Reads a grain given by a closed, outward mesh, as checked by check_mesh. Of small overhangs,
/// only the outermost surface is read. If they exceed usual_overhang_limit_percent, the mesh is
/// spread over the sphere and has offsets; small handles are cut by the defaults of HandleOptions.
/// Throws Error: InvalidInput if the mesh encloses no volume, or if it has overhangs and a larger
/// handle or walls too thin for the degree, and as spread_over_directions; Cancelled.
SampleGrain sample_grain(const IndexedMesh& mesh, const SampleGrids& grids,
                         const Execution& execution);

/// Computes the logarithm of the radius of a surface about the origin, for many directions; returns
/// false if it has none.
using LogRadii =
    std::function<bool(const std::vector<Vector3>& directions, std::vector<double>& values)>;

/// Returns the surface's radii t in other coordinates y, x = centre + axes y: centre + t axes d
/// lies on the surface, for directions d. Empty if rays from the centre meet the surface more than
/// once, or are so close to this that the iteration does not converge.
std::optional<std::vector<double>> radii_in_frame(const LogRadii& surface, const Vector3& centre,
                                                  const Eigen::Matrix3d& axes,
                                                  const std::vector<Vector3>& directions);

}  // namespace wscvt
