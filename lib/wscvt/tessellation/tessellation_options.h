// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "wscvt/base/option.h"

namespace wscvt {

// Options and reports of the directions of the nodes: their choice, weights and relaxation.

/// Method that chooses the directions of the nodes.
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
      {Sampling::Weighted, "weighted", "weighted Voronoi", "WSCVT, with the chosen weighting"},
      {Sampling::Fibonacci, "fibonacci", "Fibonacci lattice", "not relaxed, for comparison"},
      {Sampling::EqualAngle, "equal-angle", "equal-angle grid",
       "not relaxed, with the nearest possible number of nodes"},
      {Sampling::Icosahedron, "icosahedron", "icosahedron",
       "subdivided, not relaxed, with the nearest possible number of nodes"},
  };
};

/// A closed mesh has at least four nodes. A million nodes take minutes.
inline constexpr NumberOption<int> node_count_option = {
    "nodes",
    "number of nodes",
    4,
    1000000,
    Ends::Both,
    "the remesh gets exactly this number; with an allowed error, at most this number, or 20000 if "
    "none is given"};

/// Weight of a seed, which sets the size of its cell: w in steradian, for N seeds on a surface of
/// area S, at radius r and area per solid angle g = dA/dOmega. Equations are of the paper named in
/// remesh.h.
enum class Weighting {
  Constant,        ///< equal solid angles
  RadialDistance,  ///< WSCVT-D, eq. 10 as printed: w = S / (N pi r^2)
  Curvature,       ///< WSCVT-C, eqs. 11 to 14: more nodes where curvature is high
  Area,            ///< equal areas, not in the paper: w = S / (3.118 N g); cells are 3.118 w + C
};

template <>
struct EnumerationTable<Weighting> {
  static constexpr std::string_view key = "weighting";
  static constexpr std::string_view subject = "weighting";
  static constexpr Enumerator<Weighting> rows[] = {
      {Weighting::Constant, "constant", "constant", "equal solid angles"},
      {Weighting::RadialDistance, "wscvt-d", "WSCVT-D (radial distance)",
       "smaller solid angles far from the centroid, for even triangles"},
      {Weighting::Curvature, "wscvt-c", "WSCVT-C (curvature)",
       "more nodes where the surface bends"},
      {Weighting::Area, "area", "area", "equal surface areas"},
  };
};

/// Options of the weights.
struct WeightingOptions {
  Weighting kind = Weighting::RadialDistance;
  double curvature_alpha = 1.0;  ///< alpha of eq. 11, -3 to 3
};

inline constexpr NumberOption<double> curvature_alpha_option = {
    "alpha",    "strength alpha of WSCVT-C",
    -3.0,       3.0,
    Ends::Both, "0 ignores curvature. Larger values put more nodes where the surface bends"};

/// Limits at which the relaxation ends.
struct RelaxationOptions {
  int maximum_iterations = 1000;
  double displacement_tolerance = 1e-3;  ///< rms displacement / h, see RelaxationStep; no unit
  double area_tolerance = 0.07;          ///< spread of cell area / target; no unit
};

/// One line of the iteration's history.
struct RelaxationStep {
  double displacement = 0.0;  ///< rms distance seed to cell centroid / h, h = sqrt(total area / N)
  double area_spread = 0.0;   ///< standard deviation of (cell area / its target)
  int flips = 0;              ///< edges flipped to restore the triangulation
};

/// Reason why a relaxation ended.
enum class RelaxationOutcome {
  Converged,  ///< displacement and area spread both below their tolerances
  /// The seeds no longer move (a hundredth of the displacement tolerance), but the cells' areas
  /// vary more than wanted. Few nodes on a strongly curved surface cannot do better. Or the
  /// movement no longer decreases (StallWatch).
  Settled,
  Stuck,           ///< even a short further step could not be triangulated
  IterationLimit,  ///< iteration limit reached before any other outcome
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

/// A coarser tessellation, relaxed first (see relax_multilevel).
struct RelaxationLevel {
  int seeds = 0;
  int iterations = 0;
  /// Outcome with the level's own tolerances (see multilevel_relaxation.h).
  RelaxationOutcome outcome = RelaxationOutcome::IterationLimit;
};

/// Report of a relaxation.
struct RelaxationReport {
  RelaxationOutcome outcome = RelaxationOutcome::IterationLimit;
  int iterations = 0;                           ///< with all the seeds
  std::vector<RelaxationLevel> coarser_levels;  ///< coarsest first; may be empty
  int rebuilds = 0;                     ///< triangulations rebuilt because flips were not enough
  double weight_scale = 1.0;            ///< below 1: weights were damped to keep every seed's cell
  std::vector<RelaxationStep> history;  ///< with all the seeds, from the start on
};

}  // namespace wscvt
