// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/resolution/resolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "toolbox/resolution/descriptor_biases.h"
#include "toolbox/resolution/mesh_voxels.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t pose_count = 3;

/// Poses of the grain that is voxelised again. Any that no face of a grain follows will do.
const std::array<VoxelPose, pose_count>& poses() {
  static const std::array<VoxelPose, pose_count> all = {{
      {Eigen::Quaterniond(0.86, 0.11, 0.37, -0.33).normalized(), Vector3(1.13, 1.71, 1.42)},
      {Eigen::Quaterniond(0.29, 0.77, -0.41, 0.38).normalized(), Vector3(1.62, 1.19, 1.87)},
      {Eigen::Quaterniond(-0.35, 0.43, 0.69, 0.47).normalized(), Vector3(1.36, 1.94, 1.08)},
  }};
  return all;
}

using Rows = std::vector<DescriptorValue>;

/// Returns nothing if the grain is too thin for its voxels.
std::optional<Rows> rows_again(const IndexedMesh& mesh, const ResolutionOptions& options,
                               const VoxelPose& pose, const Execution& execution) {
  const std::vector<VoxelStretch> voxels = mesh_voxels(mesh, options.voxel_size, pose);
  try {
    IndexedMesh again = surface_of_voxels(voxels, options.smoothing, options.voxel_size);
    const CheckedMesh checked = check_mesh(std::move(again), MeshCheckOptions(), execution);
    return list_descriptors(describe_shape_in_detail(checked.mesh, options.details, execution));
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return std::nullopt;
  }
}

void correct(ResolvedValue& row, double across) {
  const DescriptorBias* bias = bias_of(row.key);
  if (bias == nullptr || across < bias->least_across) return;
  if (!std::isfinite(row.value + row.again)) return;
  constexpr double most_measured = 40.0;
  const double u = 10.0 / std::min(across, most_measured);
  const double change = row.value - row.again;
  const double corrected = (1.0 + bias->floor + bias->floor_u * u) * row.value +
                           (bias->gain + bias->gain_u * u) * change;
  const double below = bias->share * std::abs(change) + bias->scatters * row.scatter +
                       bias->rest * std::abs(row.value) / across;
  const auto possible = [&](double value) { return std::clamp(value, 0.0, bias->most); };
  row.corrected = possible(corrected);
  row.low = possible(corrected - below);
  row.high = possible(corrected + bias->above * below);
}

ResolvedValue resolved(const std::string& key, double value, double across,
                       const std::array<double, pose_count>& again) {
  ResolvedValue row;
  row.key = key;
  row.value = value;
  for (const double one : again) row.again += one / static_cast<double>(pose_count);
  for (const double one : again) row.scatter += (one - row.again) * (one - row.again);
  row.scatter = std::sqrt(row.scatter / static_cast<double>(pose_count - 1));
  row.corrected = row.low = row.high = not_a_number;
  correct(row, across);
  return row;
}

}  // namespace

Resolution measure_resolution(const IndexedMesh& mesh, const DetailedDescriptors& descriptors,
                              const ResolutionOptions& options, const Execution& execution) {
  if (!(options.voxel_size > 0.0) || !std::isfinite(options.voxel_size)) {
    throw Error(ErrorCode::InvalidInput, "The size of a voxel must be a number above 0.");
  }
  std::array<std::optional<Rows>, pose_count> again;
  for (std::size_t k = 0; k < pose_count; ++k) {
    execution.report(static_cast<double>(k) / pose_count, "Measuring the resolution");
    again[k] = rows_again(mesh, options, poses()[k], execution.part(0.0, 0.0));
  }
  Resolution result;
  result.voxel_size = options.voxel_size;
  result.voxels_across = descriptors.equivalent_diameter / options.voxel_size;
  const Rows rows = list_descriptors(descriptors);
  for (std::size_t at = 0; at < rows.size(); ++at) {
    std::array<double, pose_count> values{};
    for (std::size_t k = 0; k < pose_count; ++k) {
      values[k] = again[k] ? (*again[k])[at].value : not_a_number;
    }
    result.rows.push_back(resolved(rows[at].key, rows[at].value, result.voxels_across, values));
  }
  return result;
}

}  // namespace wscvt
