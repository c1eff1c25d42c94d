// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/remesh/remesh_method.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/remesh/repaired_scan.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// The method of F. Wu, L. Huang, Z. Lai (2022), see remesh.h, step by step:
///
/// 1. Rays from the centroid read the radius of the scan in each direction.
/// 2. A series of real spherical harmonics is fitted to the radii (eqs. 1 to 5).
/// 3. Seeds on the unit sphere get weights, each of a solid angle (eqs. 6 to 14).
/// 4. The seeds move to the centroids of their weighted Voronoi cells on the sphere.
/// 5. The nodes are put on the series, or, along the same rays, on the scan.
///
/// Two things differ from the paper. The triangulation is the regular one, exact, because the
/// unweighted Delaunay triangulation inverts cells under curvature weights. The series is fitted to
/// the surface, not only to its vertices.
class PublishedRemesher : public RemeshMethod {
 public:
  /// Does steps 1 and 2 for a scan, which must outlive this. Throws Error: NotStarShaped if the
  /// overhang fraction is above the limit or the centroid is not inside, InvalidInput,
  /// NumericalFailure, Cancelled.
  PublishedRemesher(const NormalizedScan& scan, const AsPublishedOptions& options, int degree,
                    bool with_curvatures, const Execution& execution);

  /// For a surface given by a formula or by coefficients, of equivalent radius 1. It replaces the
  /// series and the scan, and must outlive this.
  PublishedRemesher(const RadialSurface& surface, const AsPublishedOptions& options,
                    bool with_curvatures);

  /// Steps 3 to 5.
  Nodes place(int node_count, const Execution& execution) const override;

  /// Returns the coefficients of the series, which a formula has not.
  const std::vector<double>& coefficients() const { return series_->coefficients(); }
  const HarmonicFitReport& fit() const { return report_.fit; }

 private:
  AsPublishedOptions options_;
  bool with_curvatures_;
  std::optional<HarmonicSurface> series_;   ///< of a scan
  const RadialSurface* surface_ = nullptr;  ///< the series, or the formula
  std::optional<MeshSurface> rays_;         ///< for nodes on the scan
  AsPublishedReport report_;
};

}  // namespace wscvt
