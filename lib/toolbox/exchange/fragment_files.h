// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/exchange/rockable_shape.h"
#include "toolbox/fragment/fragments.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Throws Error(InvalidInput), with the formats, for an ending without its point that
/// write_fragment does not know.
void check_fragment_format(const std::string& format);

/// Writes a fragment in the format of the ending:
/// - that of a mesh: its surface (see write_mesh);
/// - .urdf and .xml (MuJoCo's MJCF): a body of one part, the fragment's convex hull, with the mass
///   and inertia of `mass` times `density` (see write_parts);
/// - .shp: a shape of Rockable, in the principal frame of `mass` about its centroid (see
///   rockable_shape).
/// Returns the rounding of a .shp. Throws Error as check_fragment_format and write_file do.
Rounding write_fragment(const std::string& path, const IndexedMesh& mesh,
                        const MassProperties& mass, double density);

/// Returns CSV, a row per fragment: fragment (from 1), file, volume, centroid (x, y, z), principal
/// frame (qw, qx, qy, qz, see MassProperties), surface_area, wall_area, hull_excess_percent,
/// contacts. `files`: the name of each fragment's file. Numbers read back to the same bits.
std::string fragments_csv(const Fragments& fragments, const std::vector<std::string>& files);

/// Returns the volumes in such a table; none if it cannot be read. Their sum is the volume of the
/// grain, however many they are, and a remesh keeps them.
std::vector<double> volumes_of_fragments(const std::string& path);

/// Returns CSV, a row per contact: first and second (from 1), area, centre (x, y, z), normal
/// (nx, ny, nz) from first to second. Numbers read back to the same bits.
std::string fragment_contacts_csv(const Fragments& fragments);

/// Returns lines for a log: volumes, walls, hulls, pieces that were moved.
std::vector<std::string> fragment_lines(const Fragments& fragments);

}  // namespace wscvt
