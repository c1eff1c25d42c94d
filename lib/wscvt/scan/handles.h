// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/scan/mesh_check.h"

namespace wscvt {

/// Which handles are cut.
struct HandleOptions {
  /// Longest loop along which a handle is cut, in equivalent radii; >= 0. Scanner noise makes
  /// handles of a few voxels, up to half a radius on a rough scan; a ring, whose hole is real, has
  /// no loop below 0.7 radii unless its tube is 150 times thinner than the ring is wide.
  double length_limit = 0.7;
  /// Scans with more handles are refused before one is cut: they are porous, and no sheet of nodes
  /// that a simulation can afford follows their pores. Rough scans had up to 5, a coral 149.
  int count_limit = 50;
};

inline constexpr NumberOption<int> handle_count_option{
    "handles",  "largest number of handles",
    0,          1000000,
    Ends::Both, "that are cut; a scan with more is porous and refused"};

inline constexpr NumberOption<double> handle_length_option{
    "handle-length",
    "longest loop along which a handle is cut",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::Both,
    "in equivalent radii; a scan with a longer one, such as a ring, has no spherical map"};

/// A handle that was cut.
struct CutHandle {
  double length = 0.0;              ///< of the loop it was cut along, length
  Vector3 place = Vector3::Zero();  ///< mean of the loop's vertices, in the input's coordinates
  int edges = 0;                    ///< of the loop
};

/// Which handles were cut.
struct HandleReport {
  std::vector<CutHandle> cut;  ///< in the order in which they were cut, shortest loops first
  /// Volume afterwards / before, less 1, no unit: what filling tunnels adds, cutting bridges takes
  /// away.
  double volume_change = 0.0;
};

/// A mesh without handles and what was done to it.
struct HandleFreeMesh {
  IndexedMesh mesh;  ///< the input's vertices first, those of the rings moved; then new ones
  HandleReport report;
};

/// Brings a closed, oriented, connected 2-manifold (check_mesh's result) of any genus to genus 0.
/// Each handle is cut along a short loop that does not separate the surface, and both sides are
/// capped: where the loop runs round a bridge the bridge is cut through, where it runs round a
/// tunnel the tunnel is closed. The caps lie on each other at first; each is faired towards the
/// surface on its own side, so that they part. Loops come from tree-cotree decompositions (Eppstein
/// 2003, "Dynamic generators of topologically embedded graphs"; Erickson and Whittlesey 2005,
/// "Greedy optimal homotopy and homology generators") about the places where a first one finds
/// handles, the shortest first. A mesh of genus 0 comes back as it is.
///
/// Throws Error(InvalidInput) when an option is out of range, the mesh is not closed, it has more
/// handles than the limit, or the shortest loop left is above its limit: then the hole is real, as
/// of a ring, and no map to the sphere exists; the sentence says how many are left, how long and
/// where.
HandleFreeMesh remove_handles(IndexedMesh mesh, const HandleOptions& options,
                              const Execution& execution);

/// The same for a checked scan, whose report then has the measures of what is left, but for the
/// genus, which stays that of the scan. Throws the same.
HandleReport cut_handles(CheckedMesh& scan, const HandleOptions& options,
                         const Execution& execution);

}  // namespace wscvt
