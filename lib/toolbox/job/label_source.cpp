// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/label_source.h"

#include "toolbox/volume/label_table.h"
#include "wscvt/base/error.h"

namespace wscvt {

namespace {

/// Returns 0 for voxels that are no cubes.
double edge_of_cubes(const VolumeGeometry& geometry) {
  const double edge = geometry.axes.col(0).norm();
  const Eigen::Matrix3d products = geometry.axes.transpose() * geometry.axes;
  const bool are_cubes =
      (products - edge * edge * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <=
      1e-3 * edge * edge;
  return are_cubes ? edge : 0.0;
}

}  // namespace

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
  return {std::move(label.mesh), {}, warnings_of(label), edge_of_cubes(grains_->geometry())};
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
