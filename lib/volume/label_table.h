// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "volume/label_grains.h"

namespace wscvt {

// The table of the labels of a volume: CSV after RFC 4180 with a row a label. Columns: "grain", the
// volume and the label, as in the table of a sample; "label"; "name", what the file calls it;
// "state", "taken" (it is remeshed), "written", "in N pieces" (the largest is written), "at the
// border", "too small" or "failed"; "error", the sentence of a failure; "voxels"; "volume", theirs;
// "unit", of length, as the file names it; "x_min" to "z_max", the box of its voxels; "pieces" that
// it is in; "left_out", the share of its voxels that are not in the largest piece; and, of what is
// written, "mesh_volume", that of the mesh: of the largest piece, its pores filled; "vertices",
// "faces" and "file".

/// What became of a label.
struct LabelOutcome {
  const LabelGrain* grain = nullptr;  ///< null: none was made
  std::string file;                   ///< that the mesh is written to; empty: none
  std::string error;                  ///< of a failure
};

/// What the grain of a label is called.
std::string grain_name(const std::string& volume, Label label);

/// The first record.
std::string label_header();

/// The record of a label.
std::string label_row(const std::string& volume, const LabelGrains& grains,
                      const LabelExtent& label, const LabelOutcome& outcome);

}  // namespace wscvt
