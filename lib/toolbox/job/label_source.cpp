// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/label_source.h"

#include "wscvt/base/text_format.h"

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
  GrainScan scan;
  const LabelExtent& extent = grains_->labels()[grains_->taken()[grain]];
  scan.record =
      [row = label_row(path_, *grains_, extent, {&label, "", ""})](const std::string& file) {
        return row.substr(0, row.size() - 2) + csv_record({file});  // the last column
      };
  scan.refused = refusal_of(label);
  scan.warnings = warnings_of(label);
  scan.mesh = std::move(label.mesh);
  scan.voxel_size = edge_of_cubes(grains_->geometry());
  return scan;
}

std::string LabelSource::census(const MadeOf& made_of) const {
  std::string table = label_header();
  for (const LabelExtent& label : grains_->labels()) {
    MadeGrain made;
    if (grains_->state(label) == LabelState::Taken) made = made_of(grain_name(path_, label.label));
    table += made.record.empty()
                 ? label_row(path_, *grains_, label, {nullptr, made.file, made.error})
                 : made.record;
  }
  return table;
}

}  // namespace wscvt
