// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/resolution/resolution.h"
#include "work.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/report/report.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::object describe(const Points& vertices, const py::object& faces, const py::object& reference,
                    double roundness_ball, double roughness_cutoff,
                    std::optional<double> voxel_size, int threads, const py::object& progress) {
  DetailedOptions options;
  options.roundness_ball = roundness_ball;
  options.roughness_cutoff = roughness_cutoff;
  NamedMesh grain = {"grain", mesh_of(vertices, faces)};
  std::optional<NamedMesh> original;
  if (!reference.is_none()) {
    original = NamedMesh{"reference", mesh_of_reference(reference)};
  }
  const GrainMeasures measures = work_on(threads, progress, [&](const Execution& execution) {
    const double share = voxel_size ? 0.5 : 1.0;
    GrainMeasures found =
        measure_grain(std::move(grain), std::move(original), options, execution.part(0.0, share));
    if (voxel_size) add_resolution(found, *voxel_size, options, execution.part(share, 1.0));
    return found;
  });
  return parsed(descriptor_json(measures));
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("describe", &describe, py::arg("vertices"), py::arg("faces"),
             py::arg("reference") = py::none(), py::kw_only(),
             py::arg("roundness_ball") = DetailedOptions().roundness_ball,
             py::arg("roughness_cutoff") = DetailedOptions().roughness_cutoff,
             py::arg("voxel_size") = py::none(), py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
