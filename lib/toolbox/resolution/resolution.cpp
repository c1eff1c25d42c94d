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
#include "wscvt/base/triangle_geometry.h"
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

/// Returns 10 over the voxels across, see DescriptorBias.
double u_of(double across) {
  constexpr double most_measured = 40.0;
  return 10.0 / std::min(across, most_measured);
}

/// Returns the area of a grain's voxels with few passes of smoothing. Nothing if the mesh does not
/// show its voxels.
std::optional<double> rough_area(const IndexedMesh& mesh, const ResolutionOptions& options) {
  constexpr int few_passes = 5;  // chosen of 0 to 80 by bodies that did not judge, see the study
  try {
    const auto voxels = voxels_of_surface(mesh, options.smoothing, options.voxel_size);
    if (!voxels) return {};
    const IndexedMesh rough = surface_of_voxels(*voxels, few_passes, options.voxel_size);
    return mesh_sums(rough.points, rough.triangles, rough.points.front(), Execution(1)).area();
  } catch (const Error&) {
    return {};
  }
}

void correct(ResolvedValue& row, double across) {
  const DescriptorBias* bias = bias_of(row.key);
  if (bias == nullptr || across < bias->least_across) return;
  if (!std::isfinite(row.value + row.again)) return;
  const double u = u_of(across);
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

ResolvedValue unresolved(const DescriptorValue& value) {
  ResolvedValue row;
  row.key = value.key;
  row.value = value.value;
  row.again = row.scatter = row.corrected = row.low = row.high = not_a_number;
  return row;
}

void take_poses(const std::array<std::optional<Rows>, pose_count>& again, std::size_t at,
                ResolvedValue& row) {
  row.again = row.scatter = 0.0;
  std::array<double, pose_count> values{};
  for (std::size_t k = 0; k < pose_count; ++k) {
    values[k] = again[k] ? (*again[k])[at].value : not_a_number;
    row.again += values[k] / static_cast<double>(pose_count);
  }
  for (const double one : values) row.scatter += (one - row.again) * (one - row.again);
  row.scatter = std::sqrt(row.scatter / static_cast<double>(pose_count - 1));
}

}  // namespace

Resolution measure_resolution(const IndexedMesh& mesh, const DetailedDescriptors& descriptors,
                              const ResolutionOptions& options, const Execution& execution) {
  if (!(options.voxel_size > 0.0) || !std::isfinite(options.voxel_size)) {
    refuse("The size of a voxel must be a number above 0.");
  }
  Resolution result;
  result.voxel_size = options.voxel_size;
  result.voxels_across = descriptors.equivalent_diameter / options.voxel_size;
  for (const DescriptorValue& row : list_descriptors(descriptors)) {
    result.rows.push_back(unresolved(row));
  }
  const std::optional<double> rough = rough_area(mesh, options);
  result.has_voxels = rough.has_value();
  if (!rough) return result;
  std::array<std::optional<Rows>, pose_count> again;
  for (std::size_t k = 0; k < pose_count; ++k) {
    execution.report(static_cast<double>(k) / pose_count, "Measuring the resolution");
    again[k] = rows_again(mesh, options, poses()[k], execution.part(0.0, 0.0));
  }
  for (std::size_t at = 0; at < result.rows.size(); ++at) {
    ResolvedValue& row = result.rows[at];
    const double rougher = *rough / descriptors.basic.area;  // of the same volume
    if (row.key == "area" || row.key == "sphericity_wadell") {
      row.again = row.key == "area" ? *rough : row.value / rougher;
      row.scatter = std::abs(row.value - row.again) * u_of(result.voxels_across);
    } else {
      take_poses(again, at, row);
    }
    correct(row, result.voxels_across);
  }
  return result;
}

void add_resolution(GrainMeasures& measures, double voxel_size, const DetailedOptions& details,
                    const Execution& execution) {
  ResolutionOptions options;
  options.voxel_size = voxel_size;
  options.details = details;
  measures.resolution = measure_resolution(measures.grain.checked.mesh, measures.grain.descriptors,
                                           options, execution);
}

}  // namespace wscvt
