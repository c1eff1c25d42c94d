// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "option_arguments.h"
#include "work.h"
#include "wscvt/remesh.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/grain_surface.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// What remesh and create return; see the stub for what it holds.
struct Remesh {
  RemeshResult result;
  ReportOrigin origin;
};

Remesh remesh(const Points& vertices, const py::object& faces, int threads,
              const py::object& progress, const std::string& source, const py::kwargs& given) {
  const RemeshOptions options = options_of(given, {});
  IndexedMesh scan = mesh_of(vertices, faces);
  return {work_on(threads, progress,
                  [&](const Execution& execution) {
                    return ::wscvt::remesh(std::move(scan), options, execution);
                  }),
          {source, ""}};
}

Remesh create(const std::string& kind, const std::array<double, 3>& semi_axes,
              double polar_exponent, double azimuthal_exponent,
              const std::string& coefficients_file, int coefficient_degree, int threads,
              const py::object& progress, const py::kwargs& given) {
  GrainSurface surface;
  surface.kind = from_key<SurfaceKind>(kind);
  surface.semi_axes = Vector3(semi_axes[0], semi_axes[1], semi_axes[2]);
  surface.polar_exponent = polar_exponent;
  surface.azimuthal_exponent = azimuthal_exponent;
  surface.coefficients_file = coefficients_file;
  surface.coefficient_degree = coefficient_degree;
  RemeshOptions defaults;
  OnScanOptions on_surface;
  on_surface.placement = ScanPlacement::OnSurface;
  defaults.method = on_surface;
  const RemeshOptions options = options_of(given, defaults);
  return {work_on(threads, progress,
                  [&](const Execution& execution) {
                    return ::wscvt::remesh(surface, options, execution);
                  }),
          {surface_name(surface), ""}};
}

void define_remesh_class(py::module_& module) {
  py::class_<Remesh> remesh_class(
      module, "Remesh",
      "A remesh of N nodes: vertices (N, 3) float64 and faces (m, 3) int32, m = 2 N - 4 without "
      "handles, "
      "counter-clockwise "
      "from outside; centre (3,); radial_distances (N,) from it, length; cell_areas (N,), "
      "length^2; "
      "vertex_distances (N,) to the scan, length, empty unless distances=True; warnings, a list of "
      "sentences; report, a dictionary as the JSON report. str() gives the log.");
  remesh_class.attr("__module__") = "wscvt";
  remesh_class
      .def_property_readonly("vertices",
                             [](const Remesh& one) { return array_of(one.result.mesh.points); })
      .def_property_readonly("faces",
                             [](const Remesh& one) { return array_of(one.result.mesh.triangles); })
      .def_property_readonly("centre",
                             [](const Remesh& one) {
                               const Vector3& c = one.result.centre;
                               return array_of(std::vector<double>{c.x(), c.y(), c.z()});
                             })
      .def_property_readonly(
          "radial_distances",
          [](const Remesh& one) { return array_of(one.result.radial_distances); })
      .def_property_readonly("cell_areas",
                             [](const Remesh& one) { return array_of(one.result.cell_areas); })
      .def_property_readonly(
          "vertex_distances",
          [](const Remesh& one) { return array_of(one.result.vertex_distances); })
      .def_property_readonly("warnings", [](const Remesh& one) { return one.result.warnings; })
      .def_property_readonly(
          "report", [](const Remesh& one) { return parsed(report_json(one.result, one.origin)); })
      .def("__repr__",
           [](const Remesh& one) {
             return "<wscvt.Remesh of " + std::to_string(one.result.mesh.points.size()) +
                    " nodes and " + std::to_string(one.result.mesh.triangles.size()) + " faces, " +
                    std::to_string(one.result.warnings.size()) + " warnings>";
           })
      .def("__str__", [](const Remesh& one) {
        std::string text;
        for (const std::string& line : report_lines(one.result)) text += line + "\n";
        return text;
      });
}

}  // namespace

void bind_remesh(py::module_& module) {
  define_remesh_class(module);
  module.def(
      "remesh", &remesh, py::arg("vertices"), py::arg("faces"), py::kw_only(),
      py::arg("threads") = 0, py::arg("progress") = py::none(), py::arg("source") = "",
      "Remeshes a dense scan to exactly N nodes. vertices: (n, 3) float64, any unit of length; "
      "faces: (m, 3) whole numbers counted from 0, or None for points with points=True. A path, or "
      "a "
      "mesh of trimesh or PyVista, takes the place of both: remesh('scan.ply', 500). "
      "Options by name: see options(). threads: 0 takes all; they change no result. "
      "progress(fraction, stage) is called in between; False, or an exception, cancels. "
      "source: what the report names as the scan. Raises Error, and TypeError for options "
      "that there are not.");
  module.def(
      "create", &create, py::arg("surface"), py::kw_only(),
      py::arg("semi_axes") = std::array<double, 3>{1.0, 1.0, 1.0}, py::arg("polar_exponent") = 1.0,
      py::arg("azimuthal_exponent") = 1.0, py::arg("coefficients_file") = "",
      py::arg("coefficient_degree") = -1, py::arg("threads") = 0, py::arg("progress") = py::none(),
      "A mesh of N nodes of a surface that is known exactly: ellipsoid, superellipsoid, or "
      "harmonics from coefficients_file (.dat, .sh or .json). semi_axes: three lengths. Nodes lie "
      "on the surface unless placement says otherwise. The rest as remesh.");
}

}  // namespace wscvt::python
