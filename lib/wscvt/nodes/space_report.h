// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace wscvt {

/// How nodes were fitted along their normals.
struct NormalFitReport {
  std::size_t samples = 0;  ///< of the scan, that the triangles were fitted to; 0: no such fit
  int held_back = 0;        ///< nodes that went less than the whole step, for a guard
  double offset = 0.0;      ///< along all normals, that made the volume exact; length
};

/// How edges were evened (edge_evening.h).
struct EdgeEveningReport {
  /// Standard deviation of the edges' length / wanted length; 0 before: edges were not evened.
  double deviation_before = 0.0;
  double deviation_after = 0.0;
  int held_back = 0;  ///< nodes that went less than the whole way, for triangles that would meet
};

/// What mending of triangles did (triangle_mending.h).
struct TriangleMendingReport {
  int flips = 0;        ///< of edges
  int moves = 0;        ///< of nodes along the surface
  int relocations = 0;  ///< of nodes, from where they crowd to where they are sparse
  int left = 0;         ///< triangles that still have a smaller angle than asked for
};

/// What became of nodes on a mapped surface; of those on the radial map, mending and fit alone.
struct SpaceNodesReport {
  std::size_t self_intersections = 0;  ///< pairs of triangles of the mesh that meet, exactly
  int repairs = 0;                     ///< relaxations with more nodes where triangles had met
  /// Above 0: the nodes stand on a map of their own, in which angles count so much beside areas
  /// (SphereMapOptions), because they had jammed on the grain's.
  double angle_weight = 0.0;
  int relocated_seeds = 0;   ///< from limbs in which they crowded to others, before a relaxation
  double volume_loss = 0.0;  ///< of the nodes on the surface, as a share of the grain's volume
  /// Above 0: the nodes asked for are too few for the shape (they lose more than a quarter of its
  /// volume, or their triangles meet), and so many would do; too_many_nodes where none of the
  /// numbers tried does.
  int enough_nodes = 0;
  TriangleMendingReport mending;  ///< of triangles that the sphere had jammed
  NormalFitReport fit;            ///< of a least-squares placement
  EdgeEveningReport evening;      ///< of fitted nodes
};

/// No number of nodes tried would do: twice that asked for and so on, up to sixteen times or
/// 20,000.
inline constexpr int too_many_nodes = -1;

}  // namespace wscvt
