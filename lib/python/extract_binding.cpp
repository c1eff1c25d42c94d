// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/volume/label_grains.h"
#include "work.h"
#include "wscvt/base/error.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

using Labels = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// The voxels of a label, in the order of their z, y and x.
struct LabelVoxels {
  std::vector<VoxelStretch> stretches;
  std::int64_t count = 0;
  bool touches_border = false;
};

/// Result for a label of an array.
struct ExtractedGrain {
  IndexedMesh mesh;  ///< without points if the largest piece is too small
  std::size_t pieces = 0;
  Sentence failure;  ///< why there is no mesh
};

std::map<std::int64_t, LabelVoxels> voxels_of(const Labels& labels, std::int64_t background,
                                              const Execution& execution) {
  const auto voxels = labels.unchecked<3>();
  const auto nz = static_cast<std::int32_t>(voxels.shape(0));
  const auto ny = static_cast<std::int32_t>(voxels.shape(1));
  const auto nx = static_cast<std::int32_t>(voxels.shape(2));
  std::map<std::int64_t, LabelVoxels> found;
  for (std::int32_t z = 0; z < nz; ++z) {
    execution.report(0.3 * z / nz, "Reading the volume");
    for (std::int32_t y = 0; y < ny; ++y) {
      for (std::int32_t begin = 0; begin < nx;) {
        const std::int64_t label = voxels(z, y, begin);
        std::int32_t end = begin + 1;
        while (end < nx && voxels(z, y, end) == label) ++end;
        if (label != background) {
          LabelVoxels& one = found[label];
          one.stretches.push_back({z, y, begin, end});
          one.count += end - begin;
          one.touches_border = one.touches_border || z == 0 || z + 1 == nz || y == 0 ||
                               y + 1 == ny || begin == 0 || end == nx;
        }
        begin = end;
      }
    }
  }
  return found;
}

std::map<std::int64_t, ExtractedGrain> grains_of(const Labels& labels,
                                                 const std::array<double, 3>& voxel_size,
                                                 const VolumeOptions& options,
                                                 std::int64_t background,
                                                 const Execution& execution) {
  std::map<std::int64_t, LabelVoxels> found = voxels_of(labels, background, execution);
  VolumeGeometry geometry;
  geometry.axes = Vector3(voxel_size[0], voxel_size[1], voxel_size[2]).asDiagonal();
  std::vector<std::pair<std::int64_t, LabelVoxels*>> taken;
  for (auto& [label, voxels] : found) {
    const bool is_cut = voxels.touches_border && !options.at_border;
    if (voxels.count >= options.smallest && !is_cut) taken.emplace_back(label, &voxels);
  }
  std::vector<ExtractedGrain> made(taken.size());
  execution.parallel_for(taken.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const VoxelSurface surface = voxel_surface(taken[k].second->stretches);
      made[k].pieces = surface.pieces;
      if (surface.enclosed < options.smallest) continue;
      try {
        made[k].mesh = smoothed_surface(surface, options.smoothing, geometry);
      } catch (const Error& error) {
        made[k].failure = error.sentence();
      }
    }
  });
  std::map<std::int64_t, ExtractedGrain> grains;
  for (std::size_t k = 0; k < taken.size(); ++k) {
    grains.emplace(taken[k].first, std::move(made[k]));
  }
  return grains;
}

Labels checked_labels(const py::object& object) {
  const auto array = py::array::ensure(object);
  const char kind = array ? array.dtype().kind() : ' ';
  if (kind != 'i' && kind != 'u' && kind != 'b') {
    throw py::type_error(
        "The labels are not whole numbers. Give an array (nz, ny, nx) of whole numbers.");
  }
  if (array.ndim() != 3) {
    refuse("The labels do not have the shape (nz, ny, nx). Give an array of three dimensions.");
  }
  return Labels(array);
}

py::dict extract(const py::object& labels, const std::array<double, 3>& voxel_size,
                 std::int64_t background, std::int64_t smallest, bool at_border, int smoothing,
                 int threads, const py::object& progress) {
  VolumeOptions options;
  options.smallest = smallest;
  options.at_border = at_border;
  options.smoothing = smoothing;
  require_in_range(options.smallest, smallest_option);
  require_in_range(options.smoothing, smoothing_option);
  for (const double length : voxel_size) require_in_range(length, voxel_size_option);
  const Labels voxels = checked_labels(labels);
  const std::map<std::int64_t, ExtractedGrain> grains =
      work_on(threads, progress, [&](const Execution& execution) {
        return grains_of(voxels, voxel_size, options, background, execution);
      });
  py::dict dict;
  for (const auto& [label, grain] : grains) {
    if (!grain.failure.empty()) warn("The label " + std::to_string(label) + ": " + grain.failure);
    if (grain.mesh.points.empty()) continue;
    if (grain.pieces > 1) {
      warn("The label " + std::to_string(label) + " is in " + std::to_string(grain.pieces) +
           " pieces. The largest was used.");
    }
    dict[py::int_(label)] =
        py::make_tuple(array_of(grain.mesh.points), array_of(grain.mesh.triangles));
  }
  return dict;
}

}  // namespace

void bind_extract(py::module_& module) {
  const VolumeOptions defaults;
  module.def("extract", &extract, py::arg("labels"), py::arg("voxel_size"), py::kw_only(),
             py::arg("background") = static_cast<std::int64_t>(defaults.background),
             py::arg("smallest") = defaults.smallest, py::arg("at_border") = defaults.at_border,
             py::arg("smoothing") = defaults.smoothing, py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
