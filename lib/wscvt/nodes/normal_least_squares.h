// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/surface/mapped_surface.h"

namespace wscvt {

struct NormalFitOptions {
  std::size_t samples = 60000;  ///< points of the scan that are fitted, at least; > 0
  /// Nodes are held back where the step would give a triangle a smaller angle than this, or than
  /// it had before if that is smaller; degrees, in [0, 60).
  double smallest_angle = 35.0;
  /// The same for edges whose faces would turn against each other by more than this; degrees, in
  /// (0, 180].
  double largest_turn = 120.0;
};

inline constexpr NumberOption<std::size_t> fit_samples_option = {
    "fit-samples", "number of samples of the fit", 1, std::numeric_limits<std::size_t>::max()};
inline constexpr NumberOption<double> fit_angle_option = {
    "fit-smallest-angle", "smallest angle of the fit, in degrees,", 0.0, 60.0, Ends::NotMaximum};
inline constexpr NumberOption<double> fit_turn_option = {
    "fit-largest-turn", "largest turn of the fit, in degrees,", 0.0, 180.0, Ends::NotMinimum};

/// A sample of the scan and where it lies on the sphere of the map.
struct MappedSample {
  Vector3 point = Vector3::Zero();
  Vector3 direction = Vector3::Zero();
  std::int32_t triangle = -1;  ///< of the mapped mesh
};

/// A sample and a triangle of the nodes from which the search for the nearest one begins.
struct FitSample {
  Vector3 point = Vector3::Zero();
  std::int32_t triangle = -1;
};

struct NormalFit {
  std::vector<Vector3> positions;
  NormalFitReport report;
};

/// `count` points spread evenly by area over the surface's mesh (see area_uniform_samples), with
/// their directions. Where the surface is an early level of the scan's collapse, `to_scan` is the
/// distance to the scan, and the points are the nearest ones there; null where it is the scan.
std::vector<MappedSample> mapped_samples(const MappedSurface& surface, const MeshDistance* to_scan,
                                         std::size_t count, const Execution& execution);

/// The samples with the triangles of the nodes that hold their directions: a sheet of the scan is
/// never taken for the one behind it.
std::vector<FitSample> deal_out(const std::vector<MappedSample>& samples,
                                const std::vector<Vector3>& positions,
                                const std::vector<Vector3>& seeds,
                                const std::vector<Triangle>& triangles, const Execution& execution);

/// Samples that were dealt out to the triangles `before` go on to triangles of the mesh that these
/// became, about the same nodes: each to one at the nearest of its triangle's nodes that is not
/// among `relocated` (ascending). A sample whose three nodes all went elsewhere is left out.
std::vector<FitSample> deal_on(const std::vector<FitSample>& samples,
                               const std::vector<Triangle>& before, const IndexedMesh& after,
                               const std::vector<std::int32_t>& relocated);

/// Moves nodes once along their normals, to where their triangles fit the samples best, and then
/// all by one offset along the same normals, so that the closed mesh encloses `volume` (> 0,
/// length^3) to rounding (see offset_to_volume).
///
/// The step minimises the squared distances of the samples to the planes of the triangles nearest
/// to them (Hoppe et al. 1993, "Mesh optimization", with one unknown a node), with a weak tie to
/// zero that holds nodes which no sample reaches. The search for a sample's nearest triangle begins
/// at the one given and goes on from neighbour to neighbour. Further steps gained nothing on the
/// scans tried, and cost angles.
///
/// Where a guard of the options is violated, the nodes concerned take a half, a quarter, ... of
/// their step, and at last none; where triangles meet even then, they do without the offset too.
///
/// `nodes` is a closed, oriented 2-manifold. Throws Error(InvalidInput) for options out of range,
/// Error(NumericalFailure) when the nodes enclose no volume or the system cannot be solved.
NormalFit fit_along_normals(const IndexedMesh& nodes, const std::vector<FitSample>& samples,
                            double volume, const NormalFitOptions& options,
                            const Execution& execution);

/// Moves nodes by one offset along `normals`, so that the closed mesh encloses `volume`, and
/// returns the offset. The volume as a function of it is a polynomial of third degree, whose root
/// next to zero is found by Newton's method. Where it has none within half the mean edge, which a
/// handful of nodes on a thin body may bring about, the mesh is scaled about the mean of its nodes
/// instead, and 0 returned.
double offset_to_volume(const std::vector<Vector3>& normals, const std::vector<Triangle>& triangles,
                        double volume, std::vector<Vector3>& positions, const Execution& execution);

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_normal_fit_options(const NormalFitOptions& options);

}  // namespace wscvt
