// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wscvt/execution.h"
#include "wscvt/harmonic_surface.h"
#include "wscvt/mesh.h"
#include "wscvt/mesh_check.h"
#include "wscvt/mesh_quality.h"
#include "wscvt/multilevel_relaxation.h"
#include "wscvt/relaxation.h"
#include "wscvt/shape_descriptors.h"
#include "wscvt/weights.h"

namespace wscvt {

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
};

/// Everything a caller may choose; the defaults work.
struct RemeshOptions {
  int node_count = 1000;  ///< N, in [4, maximum_node_count]
  Weighting weighting = Weighting::RadialDistance;
  double curvature_alpha = 1.0;  ///< eq. 11's alpha, in [-3, 3]
  CurvatureSource curvature_source = CurvatureSource::Series;
  int degree = 20;  ///< of the harmonic series, in [1, 60]
  NodePlacement placement = NodePlacement::FittedSurface;
  bool node_curvatures = false;  ///< fill RemeshResult::curvatures
  double fold_limit = 0.05;      ///< refuse above this share of 4 pi, in [0, 1)
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

struct RemeshResult {
  Mesh mesh;                        ///< exactly N vertices and 2 N - 4 faces, input coordinates
  std::vector<Vector3> directions;  ///< unit, from `centre` to each vertex
  std::vector<double> radial_distances;  ///< |vertex - centre|, length
  std::vector<double> curvatures;  ///< largest absolute principal curvature, 1/length; if asked for
  std::vector<double> cell_areas;  ///< surface area of each node's power cell, length^2
  Vector3 centre = Vector3::Zero();  ///< the volume centroid of the input
  MeshCheckReport input;
  double folded_share = 0.0;         ///< of 4 pi
  HarmonicFitReport fit;             ///< lengths in input units
  std::vector<double> coefficients;  ///< of the fitted series about `centre`, input units
  RelaxationReport relaxation;
  MeshQuality original_quality;
  MeshQuality quality;
  ShapeDescriptors original;
  ShapeDescriptors remesh;
  RemeshOptions options;              ///< as used
  std::vector<std::string> warnings;  ///< sentences for the user
};

/// Remeshes a dense scan to exactly N nodes. The scan is taken by value, since it is mended and
/// centred; a caller that needs it no more moves it in. Throws Error: InvalidInput
/// for options out of range and meshes that cannot be mended (see check_mesh), NotStarShaped when
/// the folded share exceeds the limit, NumericalFailure, Cancelled.
RemeshResult remesh(IndexedMesh scan, const RemeshOptions& options,
                    const Execution& execution = Execution());
RemeshResult remesh(const Mesh& scan, const RemeshOptions& options,
                    const Execution& execution = Execution());

}  // namespace wscvt
