// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

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

struct RelaxationOptions {
  RelaxationMetric metric = RelaxationMetric::Surface;
  int maximum_iterations = 1000;
  double displacement_tolerance = 1e-3;  ///< rms displacement / h
  double area_tolerance = 0.07;          ///< spread of cell area / target
  bool acceleration = true;              ///< momentum with restarts on top of the over-relaxed step
  /// Step factor towards the centroid: in (0, 2) without acceleration, where 1.8 does well, and in
  /// (0, 4/3) with it. Those are the limits of stability of the sphere metric, whose step goes down
  /// the gradient of an energy. The surface metric's step does not: its cells are flat while its
  /// seeds stay on their rays, so that on a rough grain no factor above 1 is sure to come to rest,
  /// nor is momentum; see relax() for what is done then.
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
    "the relaxation ends below this, in cell sizes, and the next"};
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
    "1 is from seed to centroid; below 4/3 with acceleration"};
/// The same with acceleration.
inline constexpr NumberOption<double> accelerated_over_relaxation_option = {
    over_relaxation_option.key, "step of the relaxation with acceleration", 0.0, 4.0 / 3.0,
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
  /// on a strongly bent surface cannot do better.
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

/// A coarser tessellation that was relaxed first (see multilevel_relaxation.h).
struct RelaxationLevel {
  int seeds = 0;
  int iterations = 0;
  /// By the level's tolerances (see MultilevelOptions).
  RelaxationOutcome outcome = RelaxationOutcome::IterationLimit;
};

struct RelaxationReport {
  RelaxationOutcome outcome = RelaxationOutcome::IterationLimit;
  int iterations = 0;                           ///< with all the seeds
  std::vector<RelaxationLevel> coarser_levels;  ///< from the coarsest; empty without any
  int rebuilds = 0;           ///< triangulations built anew because flips did not suffice
  double weight_scale = 1.0;  ///< below 1: weights were damped so that no seed lost its cell
  std::vector<RelaxationStep> history;
};

struct RelaxationResult {
  std::vector<Vector3> seeds;         ///< unit vectors, in the order given
  SphereTriangulation triangulation;  ///< of those seeds, as the metric defines it
  std::vector<double> cell_areas;     ///< solid angles (Sphere) or surface areas (Surface)
  RelaxationReport report;
};

/// Moves the seeds towards the centroids of their cells until both the rms displacement and the
/// spread of (cell area / target) are below their tolerances, or the seeds have come to rest, or
/// they cannot go further without tearing the triangulation, or the iterations are used up; which
/// of these is said in the report.
///
/// Each step goes `over_relaxation` times the way from seed to centroid. With `acceleration` the
/// steps carry Nesterov's momentum, dropped whenever it points uphill (O'Donoghue and Candes 2015,
/// "Adaptive restart for accelerated gradient schemes"). The target cell area is 3.118 w + C on the
/// sphere and inversely proportional to the wanted density on the surface.
///
/// On rough grains such steps of the surface metric can go round in circles. Once the displacement
/// has been above both twice its smallest and 1e-3 h for 30 steps since that, the rest are plain
/// steps: factor 1 at most and no momentum. They are slower, but went to about 1e-3 h or less on
/// every scan tried.
///
/// Throws Error(InvalidInput) for options out of range or fewer than 4 seeds,
/// Error(NumericalFailure) when the seeds cannot be triangulated, Error(Cancelled).
RelaxationResult relax(std::vector<Vector3> seeds, const SeedModel& model,
                       const RelaxationOptions& options, const Execution& execution);

/// The same from a triangulation of the seeds, which saves building one.
RelaxationResult relax(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                       const SeedModel& model, const RelaxationOptions& options,
                       const Execution& execution);

/// Throws Error(InvalidInput) for options out of range.
void check_relaxation_options(const RelaxationOptions& options);

/// Why a relaxation ends at `step`; empty when it goes on. Below `rest` times the displacement
/// tolerance the seeds have settled, whatever their cells' areas.
std::optional<RelaxationOutcome> outcome_at(const RelaxationStep& step,
                                            const RelaxationOptions& options, int iterations,
                                            double rest);

}  // namespace wscvt
