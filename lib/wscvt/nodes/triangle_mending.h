// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/nodes/nodes_options.h"
#include "wscvt/surface/mapped_surface.h"

namespace wscvt {

struct TriangleMendingOptions {
  /// Triangles with a smaller angle are mended; degrees, in [0, 60).
  double smallest_angle = 35.0;
  /// No edge is made to turn further than this, or than it did before; degrees, in (0, 180]. On a
  /// rough scan with five handles 70 left an angle of 20 degrees, 90 none below 35, and 110 and 130
  /// cut corners: 28 and 31 degrees, at a larger distance from the scan.
  double largest_turn = 90.0;
  int rounds = 40;  ///< at most; >= 0
  /// For nodes that were fitted to the scan, as a refinement's, and lie off it: those at small
  /// angles alone are moved, by the shortest step that helps and keeping their distance from the
  /// surface. Where that leads no further the others about them are moved too, on to the surface,
  /// but for those on ridges. On 15 refined meshes with angles to mend the rms distance from the
  /// scan rises by a sixth at most; without this it rose by a half and more on six, to the fivefold
  /// on two.
  bool sparing = false;
};

inline constexpr NumberOption<double> mending_angle_option = {
    "mending-smallest-angle", "smallest angle of mending, in degrees,", 0.0, 60.0,
    Ends::NotMaximum};
inline constexpr NumberOption<double> mending_turn_option = {
    "mending-largest-turn", "largest turn of mending, in degrees,", 0.0, 180.0, Ends::NotMinimum};
inline constexpr NumberOption<int> mending_rounds_option = {
    "mending-rounds", "number of rounds of mending", 0, std::numeric_limits<int>::max()};

struct MendedTriangles {
  IndexedMesh mesh;                     ///< as many points and triangles as before
  std::vector<MeshPlace> places;        ///< of its points, on the surface
  std::vector<std::int32_t> relocated;  ///< nodes that were relocated, ascending, each once
  TriangleMendingReport report;
};

/// Mends the triangles of nodes on a mapped surface that the relaxation left with small angles.
///
/// The relaxation moves nodes only as far as the sphere's triangles stay counter-clockwise. Where a
/// limb of the scan is squeezed to a thread there, nodes jam: they are free in space, but not on
/// the sphere. Around each such triangle edges are flipped, nodes moved towards the centroid of
/// their ring along the scan, and nodes that crowd taken out and put into the longest edges
/// elsewhere (Botsch and Kobbelt 2004, "A remeshing approach to multiresolution modeling", with
/// the number of nodes kept), each only where it raises the smallest angle of the triangles it
/// touches, or keeps it above the limit, and turns no edge further than the options allow. The
/// sphere is not asked: the result has places on the scan, but no longer directions. Every other
/// triangle stays as it is.
///
/// No more triangles meet afterwards than before, and out of pairs that do meet a node is taken,
/// wherever fewer meet without it, and put in elsewhere. Where more pairs meet than there are nodes
/// nothing more is mended.
///
/// `nodes` is a closed mesh, its points at `places`; `known_meeting` is the number of its pairs of
/// triangles that meet, where it is known: self_intersections takes longer than the rest where
/// there is nothing to mend. In fixed order on one thread: the same input gives the same bytes.
/// Throws Error: InvalidInput for options out of range or other numbers of places, Cancelled.
MendedTriangles mend_triangles(const IndexedMesh& nodes, const std::vector<MeshPlace>& places,
                               const MappedSurface& surface, const TriangleMendingOptions& options,
                               const Execution& execution,
                               std::optional<std::size_t> known_meeting = std::nullopt);

}  // namespace wscvt
