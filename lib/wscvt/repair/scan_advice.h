// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/repair/stray_vertex.h"

namespace wscvt {

// Advice in errors and warnings about scans with openings. Tests follow it.

/// The opening of a shrink-wrap that is tried first, in % of the diagonal of the scan's bounding
/// box: smaller openings take seconds. With an opening above the coarsest a wrap does not follow
/// its scan.
inline constexpr double usual_opening_percent = 5.0;
inline constexpr double coarsest_opening_percent = 20.0;

/// Returns a sentence on the shrink-wrap of a scan that is refused.
Sentence wrap_advice(double opening_percent = usual_opening_percent);

/// Returns the menu path and settings of the MeshLab filter that closes openings.
std::string where_meshlab_closes();

/// Returns a sentence for points that do not have exactly one radius in each direction.
std::string surface_of_points_advice();

/// Returns sentences on a mesh whose open edges lie up to `distance` (length) from each other.
Sentence open_seam_sentence(double distance);

/// Returns a sentence on corners of open edges that were merged (see find_seams in weld.h);
/// `distance` in the mesh's length.
std::string merged_warning(std::size_t corners, double distance);

/// Returns a sentence on the stray vertex of a scan (see stray_vertex.h), or on one that is called
/// `vertex`; `distance` from its nearest neighbour, length.
std::string stray_vertex_sentence(const MeshCheckReport& report);
std::string stray_vertex_sentence(const std::string& vertex, const Vector3& place, double distance);

/// Throws Error(InvalidInput) if the vertex lies farther from all its neighbours than `farthest`
/// times the usual distance of the mesh: it is a fault of the scan.
void refuse_stray_vertex(const StrayVertex& stray, double farthest);

/// Whether a closed mesh consists of voxel faces: every face is perpendicular to an axis, and there
/// are at least 4 planes along each axis and 18 in total, so that a box and simple parts do not
/// count. A ball with a radius of 3 voxels has 21 planes. The step may differ between the axes.
bool has_voxel_steps(const IndexedMesh& mesh);

/// Returns advice on such a mesh, called `name`.
std::string voxel_steps_advice(const std::string& name);

}  // namespace wscvt
