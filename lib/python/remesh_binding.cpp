// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "option_arguments.h"
#include "remesh_object.h"
#include "work.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/grain_surface.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

Remesh remesh(const Points& vertices, const py::object& faces, int threads,
              const py::object& progress, const std::string& source, bool keep_scan,
              const py::kwargs& given) {
  RemeshOptions options = options_of(given, "remesh");
  options.measures.repaired_scan = keep_scan;
  IndexedMesh scan = mesh_of(vertices, faces);
  return {work_on(threads, progress,
                  [&](const Execution& execution) {
                    return ::wscvt::remesh(std::move(scan), options, execution);
                  }),
          {source, ""}};
}

Remesh create(const std::string& kind, const std::array<double, 3>& semi_axes,
              const std::array<double, 2>& exponents,
              const std::filesystem::path& coefficients_file, int degree, int threads,
              const py::object& progress, const py::kwargs& given) {
  GrainSurface surface;
  surface.kind = value_of_name<SurfaceKind>(kind);
  surface.semi_axes = Vector3(semi_axes[0], semi_axes[1], semi_axes[2]);
  surface.polar_exponent = exponents[0];
  surface.azimuthal_exponent = exponents[1];
  surface.coefficients_file = coefficients_file.string();
  surface.coefficient_degree = degree;
  const RemeshOptions options = options_of(given, "create");
  return {work_on(threads, progress,
                  [&](const Execution& execution) {
                    return ::wscvt::remesh(surface, options, execution);
                  }),
          {surface_name(surface), ""}};
}

}  // namespace

// wscvt/__init__.py documents the arguments and results of these functions.
void bind_remesh(py::module_& module) {
  module.def("remesh", &remesh, py::arg("vertices"), py::arg("faces"), py::kw_only(),
             py::arg("threads") = 0, py::arg("progress") = py::none(), py::arg("source") = "",
             py::arg("keep_scan") = true);
  module.def("create", &create, py::arg("surface"), py::kw_only(),
             py::arg("semi_axes") = std::array<double, 3>{1.0, 1.0, 1.0},
             py::arg("exponents") = std::array<double, 2>{1.0, 1.0},
             py::arg("coefficients_file") = "", py::arg("degree").noconvert() = -1,
             py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
