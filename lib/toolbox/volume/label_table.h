// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/volume/label_grains.h"

namespace wscvt {

// The table of the labels of a volume: CSV (RFC 4180) with a row per label. Columns:
//   grain           the volume and the label, as in the table of a sample
//   label
//   name            the file's name of the label
//   state           "taken" (it is remeshed), "written", "in N pieces" (the largest is written),
//                   "at the border", "too small" or "failed"
//   error           the message of a failure
//   voxels
//   volume          of the voxels
//   unit            of length, as the file names it
//   x_min to z_max  the box of the voxels
//   pieces          their number
//   left_out        the fraction of voxels outside the largest piece
// and, for a mesh that is written:
//   mesh_volume     of the largest piece, its pores filled
//   vertices, faces, file

/// Result for a label.
struct LabelOutcome {
  const LabelGrain* grain = nullptr;  ///< null if none was made
  std::string file;                   ///< of the mesh; empty if none is written
  std::string error;                  ///< of a failure
};

/// Returns the name of a label's grain.
std::string grain_name(const std::string& volume, Label label);

/// Returns the first record.
std::string label_header();

/// Returns the record of a label.
std::string label_row(const std::string& volume, const LabelGrains& grains,
                      const LabelExtent& label, const LabelOutcome& outcome);

}  // namespace wscvt
