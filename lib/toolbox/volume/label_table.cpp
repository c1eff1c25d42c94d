// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>

#include "toolbox/volume/label_grains.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

std::string state_text(LabelState state, const LabelOutcome& outcome) {
  if (!outcome.error.empty()) return "failed";
  if (state == LabelState::AtTheBorder) return "at the border";
  if (state == LabelState::TooSmall) return "too small";
  if (outcome.grain == nullptr) return "taken";
  if (outcome.grain->mesh.points.empty()) return "too small";
  if (outcome.grain->pieces > 1) return "in " + std::to_string(outcome.grain->pieces) + " pieces";
  return "written";
}

/// Returns the box of a label's voxels in the volume's coordinates.
Eigen::AlignedBox3d box_of(const LabelExtent& label, const VolumeGeometry& geometry) {
  Eigen::AlignedBox3d box;
  for (unsigned k = 0; k < 8; ++k) {
    Vector3 lattice;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const VoxelCounts& side = (k >> axis & 1U) != 0 ? label.end : label.begin;
      lattice[axis] = side[axis];
    }
    box.extend(geometry.point(lattice));
  }
  return box;
}

}  // namespace

std::string grain_name(const std::string& volume, Label label) {
  return volume + "/" + std::to_string(label);
}

std::string label_header() {
  return csv_record({"grain",  "label",    "name",        "state",    "error", "voxels", "volume",
                     "unit",   "x_min",    "y_min",       "z_min",    "x_max", "y_max",  "z_max",
                     "pieces", "left_out", "mesh_volume", "vertices", "faces", "file"});
}

std::string label_row(const std::string& volume, const LabelGrains& grains,
                      const LabelExtent& label, const LabelOutcome& outcome) {
  const VolumeGeometry& geometry = grains.geometry();
  const double voxel = geometry.voxel_volume();
  std::vector<std::string> fields = {grain_name(volume, label.label),
                                     std::to_string(label.label),
                                     grains.name_of(label.label),
                                     state_text(grains.state(label), outcome),
                                     outcome.error,
                                     std::to_string(label.voxels),
                                     format_exact(voxel * static_cast<double>(label.voxels)),
                                     geometry.unit};
  const Eigen::AlignedBox3d box = box_of(label, geometry);
  append_exact(fields, box.min());
  append_exact(fields, box.max());
  fields.push_back(std::to_string(label.pieces));
  fields.push_back(format_exact(label.left_out()));
  if (outcome.grain == nullptr || outcome.grain->mesh.points.empty()) {
    fields.insert(fields.end(), 3, "");
  } else {
    const LabelGrain& grain = *outcome.grain;
    fields.push_back(format_exact(voxel * static_cast<double>(grain.enclosed)));
    fields.push_back(std::to_string(grain.mesh.points.size()));
    fields.push_back(std::to_string(grain.mesh.triangles.size()));
  }
  fields.push_back(outcome.file);
  return csv_record(fields);
}

}  // namespace wscvt
