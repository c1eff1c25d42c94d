// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"

namespace wscvt {

namespace {

constexpr int channel_role = -2;
constexpr std::int64_t most_channels = 8;

/// Returns the conventional roles of dimensions.
std::vector<int> usual_roles(const std::vector<std::int64_t>& counts) {
  std::vector<int> roles(counts.size(), -1);
  int next = 0;  // x, the last dimension
  std::size_t end = counts.size();
  std::vector<std::size_t> long_ones;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] > 1) long_ones.push_back(k);
  }
  if (long_ones.size() > 3) {
    const std::size_t last = long_ones.back();
    const std::int64_t shortest = std::min(
        {counts[long_ones.end()[-2]], counts[long_ones.end()[-3]], counts[long_ones.end()[-4]]});
    if (counts[last] <= most_channels && 2 * counts[last] < shortest) {
      roles[last] = channel_role;
      end = last;
    }
  }
  for (std::size_t k = end; k-- > 0 && next < 3;) {
    if (counts[k] > 1) roles[k] = next++;
  }
  // An image gets a dimension of one slice, so that its refusal names the real cause.
  for (std::size_t k = counts.size(); k-- > 0 && next < 3;) {
    if (roles[k] == -1) roles[k] = next++;
  }
  return roles;
}

}  // namespace

std::string text_of_counts(const std::vector<std::int64_t>& counts) {
  std::string text;
  for (const std::int64_t count : counts) {
    text += (text.empty() ? "" : " x ") + std::to_string(count);
  }
  return text;
}

void refuse_channels_inside(const std::vector<std::int64_t>& counts, const std::string& path) {
  std::vector<std::int64_t> all;
  for (const std::int64_t count : counts) {
    if (count > 1) all.push_back(count);
  }
  if (all.size() != 4 || all[1] > most_channels) return;
  if (2 * all[1] >= std::min({all[0], all[2], all[3]})) return;
  refuse_volume(path, "holds an array of " + text_of_counts(counts) + ", whose " +
                          std::to_string(all[1]) +
                          " places between the others are channels rather than slices. Save one "
                          "of them alone, in Python numpy.save(\"one.npy\", array[:, 0]).");
}

ShapedVolume volume_of_shape(const ArrayShape& shape, const VolumeChoice& choice,
                             const std::string& path) {
  if (shape.counts.size() < 3) {
    const std::string held =
        shape.counts.empty() ? "one number" : "an array of " + text_of_counts(shape.counts);
    refuse_volume(path, "holds " + held + ", but a volume needs three dimensions.");
  }
  if (shape.roles.empty()) refuse_channels_inside(shape.counts, path);
  const std::vector<int> roles = shape.roles.empty() ? usual_roles(shape.counts) : shape.roles;
  ShapedVolume volume;
  std::array<std::int64_t, 3> counts{};
  std::size_t of_space = 0;
  for (std::size_t k = shape.counts.size(); k-- > 0;) {
    const bool is_space = roles[k] >= 0;
    volume.axes.push_back({is_space                   ? AxisKind::Space
                           : roles[k] == channel_role ? AxisKind::Channel
                                                      : AxisKind::Frame,
                           shape.counts[k]});
    if (!is_space) continue;
    if (of_space < 3) {
      counts[of_space] = shape.counts[k];
      volume.geometry.order[of_space] = roles[k];
    }
    ++of_space;
  }
  std::array<Eigen::Index, 3> sorted = volume.geometry.order;
  std::sort(sorted.begin(), sorted.end());
  if (of_space != 3 || sorted != std::array<Eigen::Index, 3>{0, 1, 2}) {
    refuse_volume(path, "holds an array of " + text_of_counts(shape.counts) +
                            " whose dimensions are not x, y and z. Save one volume.");
  }
  std::size_t frames = 0;
  for (const VolumeAxis& axis : volume.axes) {
    frames += axis.kind == AxisKind::Frame && axis.count > 1 ? 1 : 0;
  }
  if (frames > 1) {
    refuse_volume(path, "holds an array of " + text_of_counts(shape.counts) +
                            " with more than one dimension besides space. Save only one volume.");
  }
  volume.picks = picks_of(volume.axes, choice, path);
  volume.geometry.counts = voxel_counts(counts, path);
  volume.geometry.has_size = !shape.voxel_size.isZero(0.0);
  if (volume.geometry.has_size) require_spacing(shape.voxel_size, choice, path);
  if (volume.geometry.has_size) volume.geometry.unit = shape.unit;
  const Vector3 size = volume.geometry.has_size ? shape.voxel_size : Vector3(Vector3::Ones());
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index axis = volume.geometry.order[static_cast<std::size_t>(k)];
    axes(axis, k) = size[axis];
  }
  volume.geometry.size_source = shape.size_source;
  const Vector3 origin = 0.5 * size + shape.corner.value_or(Vector3::Zero());
  set_lattice(volume.geometry, axes, origin, choice, path);
  return volume;
}

}  // namespace wscvt
