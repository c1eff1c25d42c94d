// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "toolbox/conforming/grain_voxels.h"
#include "toolbox/fragment/common_walls.h"
#include "toolbox/fragment/fragments.h"
#include "toolbox/volume/label_volume.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// Options of conform_grains and remesh_fragments.
struct ConformingOptions {
  double edge_length = 0.0;  ///< mean of all edges; length; 0: see conform_grains
  int nodes = 0;       ///< about so many of each grain, instead of edge_length; 0: as that says
  int smoothing = 20;  ///< of voxels: passes, see smoothed_surface
};

inline constexpr NumberOption<double> edge_length_option = {
    "edge-length", "mean edge length", 0.0, std::numeric_limits<double>::infinity()};

inline constexpr NumberOption<int> wall_nodes_option = {"nodes", "number of nodes of each grain", 0,
                                                        1000000};

/// Largest number of triangles of remeshed fragments, which take some gigabytes on the way.
inline constexpr double most_wall_triangles = 4e6;

/// Throws Error(InvalidInput) for options out of range and for both an edge length and nodes.
void check_conforming_options(const ConformingOptions& options);

/// A grain among others.
struct ConformingGrain {
  std::int64_t voxels = 0;       ///< of its largest piece, pores filled, thin parts removed
  std::int64_t gained = 0;       ///< of them from thin gaps and thin parts of others, less its own
  std::size_t pieces = 0;        ///< of the label
  std::int64_t left_out = 0;     ///< voxels of the other pieces, and those that fell off
  std::int64_t fallen_off = 0;   ///< behind parts a voxel thick, which went to other grains
  std::int64_t pore_voxels = 0;  ///< that were filled
  double voxel_volume = 0.0;     ///< of `voxels`; length^3
  double volume = 0.0;           ///< of the mesh
  std::size_t nodes = 0;
  std::size_t triangles = 0;
  std::size_t contacts = 0;  ///< grains with a common wall
  bool intersects = false;   ///< a triangle of its walls intersects another one
};

/// All grains as one complex of triangles.
struct ConformingGrains : WallComplex {
  std::vector<ConformingGrain> grains;
  std::vector<CommonWall> walls;   ///< between grains; by first, then second
  std::int64_t gained_voxels = 0;  ///< from thin gaps, of all grains
  std::size_t intersections = 0;   ///< pairs of triangles that are left
  double mean_edge = 0.0;          ///< length
  double edge_variation = 0.0;     ///< standard deviation over mean
  double shortest_edge = 0.0;      ///< length
  double smallest_angle = 0.0;     ///< of the triangles; degrees
  std::int32_t flattest = -1;      ///< a grain with this angle
  std::size_t walls_across = 0;    ///< between labels that do not touch
  std::size_t lost_walls = 0;      ///< between labels that touch: narrow ones vanished
  double volume_error = 0.0;       ///< largest, relative
  // Of fragments, from their remesh to the grain's surface and back, over the equivalent radius.
  double rms_distance = 0.0;
  double largest_distance = 0.0;
  bool is_inaccurate = false;  ///< these exceed the limits of a remesh; never of voxel steps
};

/// Remeshes all grains of a volume at once. `voxels`: grains are numbered from 0; the outermost
/// voxels are background. `grains`: their number. A grain's largest piece is used and its pores are
/// filled, also pores of less than 64 voxels that several grains enclose. Gaps and parts a voxel
/// wide between grains are noise of a segmentation that no mesh of longer edges can follow: they go
/// to the grain beside them, see remove_thin_parts. Each grain becomes closed, manifold and
/// outward, and has the volume of its voxels. If triangles are too large to be parted without a
/// change of volumes, the volumes give way; `volume_error` is then not near 0.
///
/// The edges are even along walls and lines. Their mean is the wanted length (by default three
/// edges of a cube of a voxel's volume, or a voxel's longest edge if that is longer) if the grains
/// are large against it; a grain whose volume is that of a cube of less than two edges along a side
/// has shorter ones. With `nodes` each grain has its own edge length, at a wall the geometric mean
/// of both; a wall's nodes count for both grains, so the numbers are only near the wanted one, and
/// no edges are below a voxel's. Walls and lines narrower than a quarter of an edge vanish; the
/// grains touch in a line or point there. Triangles that intersect are parted as finish_walls says;
/// `intersections` counts those that are left, usually at contacts of few faces of voxels. The
/// result does not depend on the number of threads. Throws Error: InvalidInput without grains, for
/// a grain without voxels, and for an edge length below a voxel's; NumericalFailure as
/// make_well_composed does; Cancelled. `labels` of the grains, for messages; empty: numbers from 0.
ConformingGrains conform_grains(GrainVoxels voxels, std::size_t grains,
                                const VolumeGeometry& geometry, const ConformingOptions& options,
                                const Execution& execution, const std::vector<Label>& labels = {});

/// Replaces the meshes of fragments by remeshes, in the same way: two that touch have the nodes and
/// triangles of their wall in common, walls stay where the cells met, and each fragment keeps its
/// volume. Without an edge length or nodes the edges are as long as the grain's. Measures the
/// fragments anew, and how far the grain's surface went. Returns the complex of `fragments.walls`,
/// with 0 for what is of voxels. Throws Error: InvalidInput as check_conforming_options and for
/// more than most_wall_triangles; Cancelled.
ConformingGrains remesh_fragments(Fragments& fragments, const ConformingOptions& options,
                                  const Execution& execution);

}  // namespace wscvt
