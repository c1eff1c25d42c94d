// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/exchange/distance_grid.h"
#include "toolbox/resolution/resolution.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/distances.h"
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

namespace {

py::array_t<double> signed_distances(const Points& points, const Points& vertices,
                                     const py::object& faces, int threads,
                                     const py::object& progress) {
  const std::vector<Vector3> places = points_of(points);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].allFinite()) continue;
    refuse("Point " + std::to_string(i) + " is not finite. Leave it out.");
  }
  const IndexedMesh mesh = mesh_of(vertices, faces);
  std::vector<double> values = work_on(threads, progress, [&](const Execution& execution) {
    return MeshDistance(mesh, execution).signed_distances(places, execution);
  });
  return array_of(values);
}

py::tuple distance_grid_of(const Points& vertices, const py::object& faces, double spacing,
                           int threads, const py::object& progress) {
  GridOptions options;
  options.spacing = spacing;
  const IndexedMesh mesh = mesh_of(vertices, faces);
  const DistanceGrid grid = work_on(threads, progress, [&](const Execution& execution) {
    require_in_range(options.spacing, grid_spacing_option);
    check_grid(mesh, options);
    return distance_grid(mesh, options, execution);
  });
  const py::array_t<double> values = array_of(grid.values);
  return py::make_tuple(
      values.attr("reshape")(grid.counts[0], grid.counts[1], grid.counts[2]),
      array_of(std::vector<double>{grid.origin.x(), grid.origin.y(), grid.origin.z()}),
      grid.spacing);
}

}  // namespace

void bind_distances(py::module_& module) {
  module.def("signed_distances", &signed_distances, py::arg("points"), py::arg("vertices"),
             py::arg("faces"), py::kw_only(), py::arg("threads") = 0,
             py::arg("progress") = py::none());
  module.def("distance_grid", &distance_grid_of, py::arg("vertices"), py::arg("faces"),
             py::arg("spacing") = 0.0, py::kw_only(), py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
