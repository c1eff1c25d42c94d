// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/label_source.h"

#include "toolbox/volume/label_table.h"
#include "wscvt/base/error.h"

namespace wscvt {

std::string LabelSource::name(std::size_t grain) const {
  return grain_name(path_, grains_->labels()[grains_->taken()[grain]].label);
}

GrainScan LabelSource::read(std::size_t grain, bool /*with_pictures*/, const Execution& execution) {
  LabelGrain label = grains_->read(grain, execution);
  if (label.mesh.points.empty()) {
    throw Error(ErrorCode::InvalidInput,
                "The label is in " + std::to_string(label.pieces) +
                    " pieces, and the largest has too few voxels for a grain. Segment it again.");
  }
  return {std::move(label.mesh), {}, warnings_of(label)};
}

std::string LabelSource::census(const FileOf& file_of) const {
  std::string table = label_header();
  for (const LabelExtent& label : grains_->labels()) {
    LabelOutcome outcome;
    if (grains_->state(label) == LabelState::Taken) {
      outcome.file = file_of(grain_name(path_, label.label));
    }
    table += label_row(path_, *grains_, label, outcome);
  }
  return table;
}

}  // namespace wscvt
