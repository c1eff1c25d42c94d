// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "toolbox/conforming/conforming_grains.h"
#include "toolbox/volume/label_grains.h"
#include "toolbox/volume/label_volume.h"

namespace wscvt {

/// Returns the labels that are grains, ascending. Throws Error(InvalidInput) if there are none.
std::vector<Label> taken_labels(const LabelGrains& grains);

/// Remeshes labels of a volume at once, in its coordinates. `labels`: those that become grains,
/// ascending; all others become background. Reads the volume from its current row on. Throws Error
/// as conform_grains and as the volume does.
ConformingGrains conform_labels(LabelVolume& volume, const std::vector<Label>& labels,
                                const ConformingOptions& options, const Execution& execution);

// Files of conforming grains. `labels`: of each grain. Numbers read back to the same bits.

/// Returns VTK's XML: an unstructured grid of all triangles, each once, with the label on both
/// sides as cell data, "inner" and "outer"; -1 is the background. The normals point to "outer".
std::string walls_vtu(const ConformingGrains& grains, const std::vector<Label>& labels);

/// Returns Gmsh 4.1: a physical surface per wall, "wall_A_B", or "surface_A" against the
/// background, and a physical volume per grain, "grain_A", bounded by them.
std::string walls_msh(const ConformingGrains& grains, const std::vector<Label>& labels);

/// Returns CSV, a row per wall between two grains: first, second (labels), area, centre (x, y, z),
/// normal (nx, ny, nz) from first to second, triangles.
std::string walls_csv(const ConformingGrains& grains, const std::vector<Label>& labels);

/// Returns CSV, a row per grain: grain (its label), nodes, triangles, voxels, gained (of them, from
/// thin gaps and thin parts of others, less its own), voxel_volume, volume, contacts, pieces,
/// left_out (voxels of smaller pieces, and those that fell off), file.
std::string conforming_csv(const ConformingGrains& grains, const std::vector<Label>& labels,
                           const std::vector<std::string>& files);

/// Returns lines for a log, of grains of voxels or of fragments.
std::vector<std::string> conforming_lines(const ConformingGrains& grains);

/// Returns the fraction of the voxels of all labels that is in no mesh.
double left_out(const ConformingGrains& grains);

/// Returns sentences for the user about triangles that intersect, with the grains that have them,
/// about slivers, and about grains of which more than a twentieth fell off.
std::vector<Sentence> conforming_warnings(const ConformingGrains& grains,
                                          const std::vector<Label>& labels);

/// The same of remeshed fragments, which have the numbers from 1 on.
std::vector<Sentence> conforming_warnings(const ConformingGrains& fragments);

}  // namespace wscvt
