// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "wscvt/base/option.h"

namespace wscvt {

// How the directions of the nodes are chosen, weighed and relaxed, and how that went.

/// How the directions of the nodes are chosen.
enum class Sampling {
  Weighted,     ///< relaxed to a weighted centroidal tessellation: WSCVT
  Fibonacci,    ///< Fibonacci lattice, as it is
  EqualAngle,   ///< equal-angle grid with the number of points nearest to N
  Icosahedron,  ///< subdivided icosahedron with the number of points nearest to N
};

template <>
struct EnumerationTable<Sampling> {
  static constexpr std::string_view key = "sampling";
  static constexpr std::string_view subject = "sampling";
  static constexpr Enumerator<Sampling> rows[] = {
      {Sampling::Weighted, "weighted", "weighted Voronoi", "the method, with the weighting"},
      {Sampling::Fibonacci, "fibonacci", "Fibonacci lattice", "as it is, for comparison"},
      {Sampling::EqualAngle, "equal-angle", "equal-angle grid",
       "with the number of points nearest to the one asked for"},
      {Sampling::Icosahedron, "icosahedron", "icosahedron",
       "subdivided, with the number of points nearest to the one asked for"},
  };
};

/// Where the seeds of a weighted sampling start.
enum class SeedStart {
  Multilevel,     ///< warped lattice of a few hundred, subdivided and relaxed level by level
  WarpedLattice,  ///< all N in a Fibonacci lattice warped to the wanted density
  Random,         ///< uniform directions from `random_seed`
};

template <>
struct EnumerationTable<SeedStart> {
  static constexpr std::string_view key = "seed-start";
  static constexpr std::string_view subject = "start of the seeds";
  static constexpr Enumerator<SeedStart> rows[] = {
      {SeedStart::Multilevel, "multilevel", "multilevel",
       "a few hundred nodes are relaxed, subdivided and relaxed again"},
      {SeedStart::WarpedLattice, "warped-lattice", "warped lattice",
       "all nodes in a Fibonacci lattice adapted to the weighting"},
      {SeedStart::Random, "random", "random", "directions drawn with the random seed"},
  };
};

/// How the nodes' directions are chosen.
struct SeedingOptions {
  Sampling sampling = Sampling::Weighted;  ///< the others ignore weighting and relaxation
  SeedStart start = SeedStart::Multilevel;
  std::uint64_t random_seed = 1;  ///< of SeedStart::Random
};

/// A closed mesh has four nodes at least; a million take minutes.
inline constexpr NumberOption<int> node_count_option = {
    "nodes",    "number of nodes",
    4,          1000000,
    Ends::Both, "of the remesh, exactly; with an error target the first number tried"};
inline constexpr NumberOption<std::uint64_t> random_seed_option = {
    "seed",     "random seed",        0, std::numeric_limits<std::uint64_t>::max(),
    Ends::Both, "of the random start"};

/// What a seed weighs, and so how large its cell becomes: w in steradian, for N seeds on a surface
/// of area S, at radius r and area per solid angle g = dA/dOmega. The paper is that of remesh.h.
enum class Weighting {
  Constant,        ///< equal solid angles
  RadialDistance,  ///< WSCVT-D, eq. 10 as printed: w = S / (N pi r^2)
  Curvature,       ///< WSCVT-C, eqs. 11 to 14: more nodes where curvature is high
  Area,            ///< equal surface areas, ours: w = S / (3.118 N g), as cells are 3.118 w + C
  /// Nodes where flat triangles err most, ours: node density g k^(2/3), k the curvature. Curvatures
  /// below 0.3 of their median count as that, so that flat faces keep nodes enough to be seen as
  /// flat.
  ErrorAdaptive,
};

template <>
struct EnumerationTable<Weighting> {
  static constexpr std::string_view key = "weighting";
  static constexpr std::string_view subject = "weighting";
  static constexpr Enumerator<Weighting> rows[] = {
      {Weighting::Constant, "constant", "constant", "equal solid angles"},
      {Weighting::RadialDistance, "radial-distance", "WSCVT-D (radial distance)",
       "smaller solid angles far from the centroid, so even triangles"},
      {Weighting::Curvature, "curvature", "WSCVT-C (curvature)",
       "more nodes where the surface bends"},
      {Weighting::Area, "area", "area", "equal surface areas"},
      {Weighting::ErrorAdaptive, "error-adaptive", "error-adaptive",
       "nodes where flat triangles err most"},
  };
};

/// Which curvature the curvature weighting reads.
enum class CurvatureSource {
  Series,      ///< analytic, from the series fitted to the radii, or to x, y and z
  QuadricFit,  ///< the paper's local quadric fit on the scan (2-ring)
};

template <>
struct EnumerationTable<CurvatureSource> {
  static constexpr std::string_view key = "curvature-source";
  static constexpr std::string_view subject = "source of the curvature";
  static constexpr Enumerator<CurvatureSource> rows[] = {
      {CurvatureSource::Series, "series", "series", "exact derivatives of the fitted surface"},
      {CurvatureSource::QuadricFit, "quadrics", "quadrics on the scan",
       "a quadric fitted around each vertex of the scan over two rings, as in the paper"},
  };
};

/// How cells are weighed.
struct WeightingOptions {
  Weighting kind = Weighting::RadialDistance;
  double curvature_alpha = 1.0;          ///< alpha of eq. 11, -3 to 3
  double adaptive_exponent = 2.0 / 3.0;  ///< of the curvature in ErrorAdaptive, 0 to 1.5
  /// A formula has its own only. On a spherical map the series is that of the harmonic map.
  CurvatureSource curvature_source = CurvatureSource::Series;
};

inline constexpr NumberOption<double> curvature_alpha_option = {
    "alpha",    "strength alpha of the curvature weighting",
    -3.0,       3.0,
    Ends::Both, "0 ignores curvature, larger gathers more nodes where the surface bends"};
inline constexpr NumberOption<double> adaptive_exponent_option = {
    "adaptive-exponent",
    "exponent of the curvature in the error-adaptive weighting",
    0.0,
    1.5,
    Ends::Both,
    "0 gives equal areas"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_weighting_options(const WeightingOptions& options);

/// In which geometry cells are made centroidal.
enum class RelaxationMetric {
  Sphere,   ///< power cells on the unit sphere, weighted: the paper's method
  Surface,  ///< Voronoi cells on the surface itself: the most even triangles
};

template <>
struct EnumerationTable<RelaxationMetric> {
  static constexpr std::string_view key = "metric";
  static constexpr std::string_view subject = "metric of the relaxation";
  static constexpr Enumerator<RelaxationMetric> rows[] = {
      {RelaxationMetric::Sphere, "sphere", "sphere",
       "cells are centroidal on the unit sphere, the published method"},
      {RelaxationMetric::Surface, "surface", "surface",
       "on the grain's surface itself, which gives the most even triangles"},
  };
};

/// How cells are made centroidal, and when that is done. Ranges stand at the options below.
struct RelaxationOptions {
  RelaxationMetric metric = RelaxationMetric::Surface;
  int maximum_iterations = 1000;
  double displacement_tolerance = 1e-3;  ///< rms displacement / h, see RelaxationStep; no unit
  double area_tolerance = 0.07;          ///< spread of cell area / target; no unit
  bool acceleration = true;              ///< momentum with restarts on top of the over-relaxed step
  /// Step factor towards the centroid: in (0, 2) without acceleration, where 1.8 does well, and in
  /// (0, 1.33) with it. Those are the limits of stability of the sphere metric, 2 and 4/3, whose
  /// step goes down the gradient of an energy. The surface metric's step does not: its cells are
  /// flat while its seeds stay on their rays, so that on a rough grain no factor above 1 is sure to
  /// come to rest, nor is momentum; see relax() for what is done then.
  double over_relaxation = 1.2;
};

inline constexpr NumberOption<int> maximum_iterations_option = {
    "iterations", "largest number of iterations", 0, 100000, Ends::Both, "of the relaxation"};
inline constexpr NumberOption<double> displacement_tolerance_option = {
    "tolerance",
    "tolerance of the rms displacement",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::NotMinimum,
    "in cell sizes; the relaxation ends below this and the area tolerance"};
inline constexpr NumberOption<double> area_tolerance_option = {
    "area-tolerance", "tolerance of the spread of cell area / target", 0.0,
    std::numeric_limits<double>::infinity(), Ends::NotMinimum};
inline constexpr FlagOption acceleration_option = {"acceleration", "acceleration of the relaxation",
                                                   "by momentum"};
inline constexpr NumberOption<double> over_relaxation_option = {
    "over-relaxation",
    "step of the relaxation",
    0.0,
    2.0,
    Ends::Neither,
    "1 is from seed to centroid; below 1.33 with acceleration"};
/// The same with acceleration: 4/3, in digits that a sentence can hold.
inline constexpr NumberOption<double> accelerated_over_relaxation_option = {
    over_relaxation_option.key, "step of the relaxation with acceleration", 0.0, 1.33,
    Ends::Neither};

/// One line of the iteration's history.
struct RelaxationStep {
  double displacement = 0.0;  ///< rms distance seed to cell centroid / h, h = sqrt(total area / N)
  double area_spread = 0.0;   ///< standard deviation of (cell area / its target)
  int flips = 0;              ///< edges flipped to restore the triangulation
};

/// Why a relaxation ended.
enum class RelaxationOutcome {
  Converged,  ///< displacement and area spread both below their tolerances
  /// The seeds have come to rest (a hundredth of the displacement tolerance, or 0.3 of it with the
  /// surface metric's plain steps) although the cells' areas spread more than asked for: few nodes
  /// on a strongly bent surface cannot do better. Or they come no nearer to rest (StallWatch).
  Settled,
  Stuck,           ///< even a short step further could not be triangulated
  IterationLimit,  ///< none of these within the iterations allowed
};

template <>
struct EnumerationTable<RelaxationOutcome> {
  static constexpr std::string_view key = "outcome";
  static constexpr std::string_view subject = "outcome of the relaxation";
  static constexpr Enumerator<RelaxationOutcome> rows[] = {
      {RelaxationOutcome::Converged, "converged", "converged after"},
      {RelaxationOutcome::Settled, "settled", "settled after"},
      {RelaxationOutcome::Stuck, "stuck", "stuck after"},
      {RelaxationOutcome::IterationLimit, "iteration-limit",
       "not converged: stopped at the limit of"},
  };
};

/// A coarser tessellation that was relaxed first (see relax_multilevel).
struct RelaxationLevel {
  int seeds = 0;
  int iterations = 0;
  /// By the level's tolerances (see MultilevelOptions).
  RelaxationOutcome outcome = RelaxationOutcome::IterationLimit;
};

/// How a relaxation went.
struct RelaxationReport {
  RelaxationOutcome outcome = RelaxationOutcome::IterationLimit;
  int iterations = 0;                           ///< with all the seeds
  std::vector<RelaxationLevel> coarser_levels;  ///< from the coarsest; empty without any
  int rebuilds = 0;           ///< triangulations built anew because flips did not suffice
  double weight_scale = 1.0;  ///< below 1: weights were damped so that no seed lost its cell
  std::vector<RelaxationStep> history;  ///< with all the seeds, from the start on
};

/// How the seeds grow in number, level by level. Ranges stand at the options below.
struct MultilevelOptions {
  /// Smallest number of seeds of a level in the sphere metric; in the surface metric twice as many,
  /// and eight times where seeds are relaxed in space. A tessellation of fewer than four times as
  /// many has one level. On the sphere, eight grains with 500 to 850 nodes, 2 to 10 % more seeds
  /// have six neighbours than without a level below, and under most weightings all steps together
  /// cost a half to three quarters; a level of 60 does as much for fewer nodes, but some grains are
  /// met up to 8 % less closely.
  int coarsest_seeds = 125;
  /// Displacement tolerances of the coarsest and of the levels between, if smaller than that of the
  /// relaxation's own: an iteration there costs little and its evenness is inherited. The
  /// spread of the cells' areas is asked for on the last level only, since fewer seeds may be
  /// unable to reach it.
  double coarsest_tolerance = 1e-4;
  double middle_tolerance = 3e-4;
};

inline constexpr NumberOption<int> coarsest_seeds_option = {
    "coarsest-seeds", "smallest number of seeds of a level", 4, 1000000};
inline constexpr NumberOption<double> coarsest_tolerance_option = {
    "coarsest-tolerance",
    "tolerance of the rms displacement on the coarsest level",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::NotMinimum,
    "in cell sizes"};
inline constexpr NumberOption<double> middle_tolerance_option = {
    "middle-tolerance",
    "tolerance of the rms displacement on the levels between",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::NotMinimum,
    "in cell sizes"};

/// Throws Error(InvalidInput) for options out of range.
void check_relaxation_options(const RelaxationOptions& options);

/// Throws Error(InvalidInput) for options out of range.
void check_multilevel_options(const MultilevelOptions& options);

}  // namespace wscvt
