// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/volume_formats.h"

#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

void refuse_array_choice(const VolumeChoice& choice, const std::string& path) {
  if (choice.array.empty()) return;
  refuse_volume(path, "has a format with only one array. Leave " + mention("array") + " out.");
}

void require_spacing(const Vector3& spacing, const VolumeChoice& choice, const std::string& path) {
  if (choice.voxel_size || (spacing.allFinite() && spacing.minCoeff() > 0.0)) return;
  refuse_volume(path, "has the spacing " + format_number(spacing[0]) + ", " +
                          format_number(spacing[1]) + ", " + format_number(spacing[2]) +
                          ", but the lengths of a voxel are above 0. Correct it, or give " +
                          mention("voxel-size") + ".");
}

void set_lattice(VolumeGeometry& geometry, const Eigen::Matrix3d& axes, const Vector3& origin,
                 const VolumeChoice& choice, const std::string& path) {
  geometry.axes = axes;
  geometry.corner = origin - axes * Vector3::Constant(0.5);
  if (choice.voxel_size) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index axis = geometry.order[static_cast<std::size_t>(k)];
      geometry.axes.col(k) = (*choice.voxel_size)[axis] * Vector3::Unit(axis);
    }
    geometry.corner = Vector3::Zero();
    geometry.has_size = true;
    if (!choice.unit.empty()) geometry.unit = choice.unit;
  }
  const double volume = geometry.voxel_volume();
  if (std::isnormal(volume) && geometry.corner.allFinite()) return;
  refuse_volume(path, "gives its voxels no volume. Correct the spacing in it, or give " +
                          mention("voxel-size") + ".");
}

}  // namespace wscvt
