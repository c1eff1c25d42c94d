// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/nodes/fit_state.h"

namespace wscvt {

/// Moves nodes from where they are needed least to where they gain most, by the round's errors: a
/// node is merged into a neighbour, and put on an edge elsewhere. This pairs the collapses and
/// splits of the mesh optimization of Hoppe et al. 1993, so that the number of nodes stays. Moves
/// at most 6 % of the nodes per round, and no two of them whose triangles touch. Returns the number
/// of moves. Needs up-to-date lists of samples and updates them. The result does not depend on the
/// number of threads.
int relocate_nodes(FitState& state, const Execution& execution);

/// Flips edges if this lowers the sum of error, springs, degrees and small angles (as in the mesh
/// optimization of Hoppe et al. 1993, but once over all edges in order). An edge may become as
/// sharp as the scan if its triangles face as their samples do. Returns the number of flips.
int flip_for_fit(FitState& state);

/// Computes a step of all nodes at once from a linear least-squares problem. The planes of the
/// triangles move to their samples, as in the mesh optimization of Hoppe et al. 1993 (SIGGRAPH,
/// 19), but along the mean of the scan's and the triangle's normals. Edges keep their rest lengths,
/// and nodes the middles of their rings. Solved by 8 steps of conjugate gradients over blocks of 3
/// by 3; full accuracy is not needed, because the next round solves again. A sparse factorization
/// would take ten times as long.
///
/// Also sets `state.ring_edges`. The result does not depend on the number of threads.
std::vector<Vector3> fit_step(FitState& state, const Execution& execution);

/// Moves each node by its step, limited to 0.35 of an edge. A step is shortened at the nodes of
/// triangles that it would turn over, make sharp, turn against the scan, fold, or push through
/// others. Rebuilds `state.hash`; afterwards place the samples again. The result does not depend on
/// the number of threads.
void move_nodes(FitState& state, std::vector<Vector3> step, const Execution& execution);

/// Moves nodes of sharp triangles, and in the late rounds nodes near distant samples, one by one to
/// positions of lower cost, in up to `passes` passes. Returns the number of moves. Needs up-to-date
/// lists of samples and updates them.
int polish_nodes(FitState& state, int passes);

/// Repairs triangles with an angle below `least_angle` degrees. One node of each moves by the
/// smallest step that enlarges the angles, or towards the middle of its ring, to the position that
/// adds least distance. Returns the number of moves.
int mend_angles(FitState& state, double least_angle);

/// Counts of fit_to_samples.
struct SurfaceFitReport {
  int rounds = 0;
  int flips = 0;
  int relocations = 0;
  int polished = 0;  ///< moves of single nodes
};

/// Fits a mesh to the samples of a scan. Nodes move, edges are flipped and nodes relocated while
/// the distance falls and the evenness of the triangles stays near the wanted one. One weight,
/// between even and close, is controlled by the mean edge ratio reached. Throws Error(Cancelled).
/// The result does not depend on the number of threads.
SurfaceFitReport fit_to_samples(FitState& state, const Execution& execution);

}  // namespace wscvt
