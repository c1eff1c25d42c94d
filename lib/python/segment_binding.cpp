// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/segmentation_page.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Returns the labels as an array (nz, ny, nx), with those of dropped parts as 0.
py::array_t<std::uint32_t> labels_of(LabelVolume& labels, std::size_t grains) {
  const auto& counts = labels.geometry().counts;
  py::array_t<std::uint32_t> array({counts[2], counts[1], counts[0]});
  std::uint32_t* out = array.mutable_data();
  labels.rewind();
  for (std::int64_t row = 0; row < std::int64_t{counts[1]} * counts[2]; ++row) {
    for (const Label label : labels.next_row()) *out++ = label > grains ? 0 : label;
  }
  return array;
}

py::dict segment_array(const py::object& scan, const std::array<double, 3>& voxel_size,
                       const std::optional<double>& threshold, const std::optional<int>& phases,
                       bool dark, double separate, std::int64_t smallest, int threads,
                       const py::object& progress) {
  SegmentationOptions options;
  options.threshold = threshold;
  options.phases = phases;
  options.dark = dark;
  options.separate = separate;
  options.smallest = smallest;
  const VolumeOfArray array = volume_of(scan, "scan", voxel_size);
  const std::unique_ptr<LabelVolume> volume = array.open();
  const Segmentation result = work_on(threads, progress, [&](const Execution& execution) {
    return of_array([&] { return segment(*volume, options, execution); });
  });
  for (const Sentence& warning : volume->warnings()) warn(warning);
  for (const Sentence& doubt : doubts_of(result)) warn(doubt);
  py::dict dict;
  dict["labels"] = labels_of(*result.labels, result.grains.size());
  dict["grains"] = result.grains.size();
  dict["threshold"] = result.is_mask ? py::object(py::none()) : py::float_(result.threshold);
  dict["peaks"] = result.peaks;
  return dict;
}

}  // namespace

void bind_segment(py::module_& module) {
  const SegmentationOptions defaults;
  module.def("segment", &segment_array, py::arg("scan"), py::arg("voxel_size"), py::kw_only(),
             py::arg("threshold") = py::none(), py::arg("phases") = py::none(),
             py::arg("dark") = defaults.dark, py::arg("separate") = defaults.separate,
             py::arg("smallest") = defaults.smallest, py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
