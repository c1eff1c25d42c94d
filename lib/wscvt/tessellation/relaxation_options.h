// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "wscvt/base/option.h"

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
