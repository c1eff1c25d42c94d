// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toolbox/fragment/common_walls.h"
#include "toolbox/fragment/fragment_options.h"
#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// A fragment of a grain, in the grain's units and coordinates.
struct Fragment {
  IndexedMesh mesh;           ///< closed, outward
  MassProperties mass;        ///< at unit density
  double surface_area = 0.0;  ///< of the grain's surface on it, length^2
  double wall_area = 0.0;     ///< of its walls to other fragments, length^2
  /// Volume of the convex hull over the fragment's, less 1, in %: what an engine adds that takes
  /// fragments as convex.
  double hull_excess_percent = 0.0;
};

struct Fragments {
  std::vector<Fragment> list;
  std::vector<CommonWall> contacts;  ///< where a bonded model puts bonds; bodies count from 0
  WallComplex walls;                 ///< of which the meshes are
  ShapeDescriptors grain;
  double grain_edge = 0.0;         ///< mean edge of the grain's mesh, length
  std::size_t moved_pieces = 0;    ///< of cells in several pieces, see fragment_grain
  double moved_percent = 0.0;      ///< of the grain's volume
  std::vector<Sentence> warnings;  ///< sentences for the user
};

/// Divides a grain into exactly `count` closed fragments, the cells of sites within it (see
/// fragment_sites). Two neighbours have the same triangles on their wall, with the same points and
/// opposite turn, so volumes add up to the grain's, but for rounding, and the walls and the grain's
/// own surface are the fragments' surfaces. The grain's points keep their bits.
///
/// A cell of a grain with dents may fall into several pieces. The largest is the fragment, and each
/// other joins the neighbour with which it shares the largest wall. With `volumes`, Newton's steps
/// on the cut cells bring their volumes, before pieces join, within .1 %.
///
/// The scan is repaired as in check_mesh. The result does not depend on the number of threads.
/// Throws Error: InvalidInput for options out of range and as check_mesh; NumericalFailure if a
/// fragment would be empty, because the volumes are too different or the grain is too thin;
/// Cancelled.
Fragments fragment_grain(IndexedMesh scan, const FragmentOptions& options,
                         const Execution& execution = Execution());

/// Makes the meshes, their measures and the contacts from `walls`, of `list.size()` fragments.
void measure_fragments(Fragments& fragments, const Execution& execution);

}  // namespace wscvt
