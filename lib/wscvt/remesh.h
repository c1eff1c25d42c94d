// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/mesh.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/measures/shape_descriptors.h"
#include "wscvt/nodes/node_count_search.h"
#include "wscvt/nodes/node_refinement.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/tessellation/multilevel_relaxation.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// How the directions of the nodes are chosen.
enum class Sampling {
  Weighted,     ///< relaxed to a weighted centroidal tessellation: WSCVT
  Fibonacci,    ///< Fibonacci lattice, as it is
  EqualAngle,   ///< equal-angle grid with the number of points nearest to N
  Icosahedron,  ///< subdivided icosahedron with the number of points nearest to N
};

/// Where the seeds start.
enum class SeedStart {
  Multilevel,     ///< warped lattice of a few hundred, subdivided and relaxed level by level
  WarpedLattice,  ///< all N in a Fibonacci lattice warped to the wanted density
  Random,         ///< uniform directions from `random_seed`
};

/// Which curvature the curvature weighting reads.
enum class CurvatureSource {
  Series,      ///< analytic, from the fitted series
  QuadricFit,  ///< the paper's local quadric fit on the scan (2-ring)
};

/// Where the nodes are put along their directions.
enum class NodePlacement {
  FittedSurface,  ///< on the fitted harmonic series
  OriginalMesh,   ///< on the scan itself, by rays
  LeastSquares,   ///< off it, so that the triangles fit the scan best and the volume is the scan's
};

/// What an error target limits; each in % of the scan's own.
enum class ErrorMeasure {
  Volume,      ///< of the volume
  Area,        ///< of the area
  Sphericity,  ///< of Wadell's sphericity
  Inertia,     ///< inertia_error_percent
  Distance,    ///< two-sided rms distance, in % of the equivalent radius
};

/// Node count by error: the smallest N that meets it is looked for (see smallest_node_count).
struct ErrorTarget {
  ErrorMeasure measure = ErrorMeasure::Distance;
  double percent = 0.0;            ///< 0: none, N is the options' node_count; else > 0
  int largest_node_count = 20000;  ///< the search goes no further, in [4, maximum_node_count]
};

/// Everything a caller may choose; the defaults work.
struct RemeshOptions {
  int node_count = 1000;  ///< N, in [4, maximum_node_count]; with an error target the first N tried
  ErrorTarget error_target;
  Sampling sampling = Sampling::Weighted;  ///< the others ignore weighting and relaxation
  Weighting weighting = Weighting::RadialDistance;
  double curvature_alpha = 1.0;          ///< eq. 11's alpha, in [-3, 3]
  double adaptive_exponent = 2.0 / 3.0;  ///< of the curvature in ErrorAdaptive, in [0, 1.5]
  CurvatureSource curvature_source = CurvatureSource::Series;
  int degree = 20;  ///< of the harmonic series, in [1, 60]
  NodePlacement placement = NodePlacement::FittedSurface;
  RefinementOptions refinement;  ///< of the nodes towards the scan; needs LeastSquares
  bool distances = false;        ///< fill RemeshResult::distances and vertex_distances
  DistanceOptions distance_sampling;
  bool node_curvatures = false;  ///< fill RemeshResult::curvatures
  double fold_limit = 0.05;      ///< refuse above this folded_share, in [0, 1)
  SeedStart seed_start = SeedStart::Multilevel;
  std::uint64_t random_seed = 1;
  RelaxationOptions relaxation;
  MultilevelOptions levels;
  MeshCheckOptions check;
};

/// Largest node count accepted.
inline constexpr int maximum_node_count = 1000000;

/// Share of the sphere covered more than once above which the result carries a warning.
inline constexpr double fold_warning_limit = 0.01;

/// Residual of the fit / equivalent radius above which the result carries a warning.
inline constexpr double residual_warning_limit = 0.05;

struct RemeshResult {
  Mesh mesh;                        ///< exactly N vertices and 2 N - 4 faces, input coordinates
  std::vector<Vector3> directions;  ///< unit, from `centre` to each vertex
  std::vector<double> radial_distances;  ///< |vertex - centre|, length
  std::vector<double> curvatures;  ///< largest absolute principal curvature, 1/length; if asked for
  /// Surface area of each node's power cell, or, after refinement, a third of its triangles';
  /// length^2
  std::vector<double> cell_areas;
  std::vector<double> vertex_distances;  ///< from each node to the scan, length; if asked for
  /// Of a scan its volume centroid; of a RadialSurface the origin. Input coordinates.
  Vector3 centre = Vector3::Zero();
  MeshCheckReport input;
  double folded_share = 0.0;         ///< see folded_solid_angle
  HarmonicFitReport fit;             ///< lengths in input units
  std::vector<double> coefficients;  ///< of the fitted series about `centre`, input units
  RelaxationReport relaxation;
  RefinementReport refinement;             ///< lengths in input units
  std::optional<MeshDistances> distances;  ///< between remesh and scan, length; if asked for
  std::optional<NodeCountSearch> search;   ///< what each N tried cost, in %; with an error target
  MeshQuality original_quality;
  MeshQuality quality;
  ShapeDescriptors original;
  ShapeDescriptors remesh;
  RemeshOptions options;              ///< as used
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// A result's error by a measure, in %, >= 0. Throws Error(InvalidInput) for Distance when the
/// result holds no distances.
double error_percent(const RemeshResult& result, ErrorMeasure measure);

/// Remeshes a dense scan to exactly N nodes. The scan is taken by value, since it is mended and
/// centred; a caller that needs it no more moves it in. Throws Error: InvalidInput
/// for options out of range and meshes that cannot be mended (see check_mesh), NotStarShaped when
/// the folded share exceeds the limit, NumericalFailure, Cancelled.
///
/// A scan of points without faces is triangulated first (see mesh_of_points, which also says what
/// it throws).
RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// The same for an OpenMesh mesh, which is copied (see to_indexed).
RemeshResult remesh(const Mesh& scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

/// Discretises a surface given by a formula or by coefficients, about its own origin, in the same
/// way. The surface takes the place of the fitted series, and of the scan where that is asked for;
/// volume, area and sphericity of `original` are integrals over it, everything else is measured on
/// a mesh of 40,962 of its points. `degree`, `curvature_source`, `check` and `fold_limit` have no
/// meaning here. Throws Error: InvalidInput for options out of range and surfaces that cannot be
/// integrated (see integrate), NumericalFailure, Cancelled.
RemeshResult remesh(const RadialSurface& surface, const RemeshOptions& options,
                    const Execution& execution = Execution());

}  // namespace wscvt
