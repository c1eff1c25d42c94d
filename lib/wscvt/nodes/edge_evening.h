// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/nodes/step_guard.h"
#include "wscvt/nodes/triangle_mending.h"

namespace wscvt {

struct EdgeEveningOptions {
  /// >= 0. Thirty bring the edges of a rod with a neck, where nodes crowd, to a deviation of 0.075;
  /// most bodies gain no more than a hundredth after ten.
  int rounds = 30;
  /// Those that the triangles were mended to.
  StepLimits limits = {TriangleMendingOptions().smallest_angle,
                       TriangleMendingOptions().largest_turn};
};

inline constexpr NumberOption<int> evening_rounds_option = {
    "evening-rounds", "number of rounds of evening", 0, std::numeric_limits<int>::max()};
inline constexpr NumberOption<double> evening_angle_option = {
    "evening-smallest-angle", "smallest angle of evening, in degrees,", 0.0, 60.0,
    Ends::NotMaximum};
inline constexpr NumberOption<double> evening_turn_option = {
    "evening-largest-turn", "largest turn of evening, in degrees,", 0.0, 180.0, Ends::NotMinimum};

struct EvenedEdges {
  std::vector<Vector3> positions;  ///< one a node, length
  EdgeEveningReport report;
};

/// Moves nodes along their tangential planes, so that edges come nearer to their wanted lengths.
///
/// A centroidal tessellation evens cells, and a fit along the normals (fit_along_normals) makes the
/// edges about rims longer again; this evens the edges themselves. What it lowers is the stress
/// sum (length - wanted length)^2 over the edges: each round takes every node the way that the
/// majorization of the stress says for fixed neighbours (de Leeuw 1977, "Applications of convex
/// analysis to multidimensional scaling"; Gansner, Koren and North 2005, "Graph drawing by stress
/// majorization"), less its part along the node's normal. The triangles stay the same ones.
///
/// `spacings` is the wanted distance of a node from its neighbours, any common scale: an edge
/// should be as long as the mean of its ends'; empty for the same everywhere. The scale is the one
/// that leaves the edges as long as they are in the mean.
///
/// No limit of the options is violated, and no more triangles meet than before. `nodes` is a
/// closed, oriented 2-manifold. The same bytes on any number of threads. Throws Error: InvalidInput
/// for options out of range and for another number of spacings, Cancelled.
EvenedEdges even_edges(const IndexedMesh& nodes, const std::vector<double>& spacings,
                       const EdgeEveningOptions& options, const Execution& execution);

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_edge_evening_options(const EdgeEveningOptions& options);

}  // namespace wscvt
