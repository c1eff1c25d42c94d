// SPDX-License-Identifier: GPL-3.0-or-later
// remesh and create, and their result: arrays, report, and functions that write files. It can be
// pickled.

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/exchange/node_table.h"
#include "toolbox/exchange/simulation_files.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/grain_surface.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// The stub describes the members for Python.
struct Remesh {
  RemeshResult result;
  ReportOrigin origin;
  /// Report of a pickled object, whose result has only arrays and warnings; else empty.
  std::string pickled_report = {};
  std::string pickled_log = {};
};

using RemeshClass = py::class_<Remesh>;

bool is_pickled(const Remesh& one) { return !one.pickled_report.empty(); }

std::string report_of(const Remesh& one) {
  return is_pickled(one) ? one.pickled_report : report_json(one.result, one.origin);
}

std::string log_of(const Remesh& one) {
  if (is_pickled(one)) return one.pickled_log;
  std::string text;
  for (const std::string& line : report_lines(one.result)) text += line + "\n";
  return text;
}

/// Throws Error if the result was pickled, because `wanted` then has no data.
void require_whole(const Remesh& one, const std::string& wanted) {
  if (!is_pickled(one)) return;
  refuse("A pickled result has only arrays and report. Write " + wanted + " before it is pickled.");
}

SimulationOptions simulation_options(const std::string& frame, double scale, double size) {
  SimulationOptions options;
  options.frame = frame_of(frame, scale, size);
  check_simulation_options(options);
  return options;
}

void write_report_file(const Remesh& one, const std::filesystem::path& path, int threads,
                       const py::object& progress) {
  require_whole(one, "the report's file");
  check_remesh_report(path.string());
  if (shows_scan(path.string()) && one.result.repaired_scan.points.empty() &&
      !one.result.options.measures.repaired_scan) {
    refuse(
        "The HTML report shows the scan, but this result does not have it. Remesh with "
        "keep_scan=True.");
  }
  work_on(threads, progress, [&](const Execution& execution) {
    write_report(path.string(), one.result, one.origin, execution);
    return true;
  });
}

/// Returns the mesh in a frame; a pickled result has its own only.
IndexedMesh mesh_in_frame(const Remesh& one, const std::string& frame, double scale, double size,
                          const std::string& wanted) {
  const SimulationOptions options = simulation_options(frame, scale, size);
  if (options.frame.frame != Frame::Input || scale != 1.0 || size != 0.0)
    require_whole(one, wanted);
  if (is_pickled(one)) return one.result.mesh;
  return in_frame(one.result.mesh, simulation_frame(one.result.scan, options.frame));
}

py::tuple mesh_arrays(const Remesh& one, const std::string& frame, double scale, double size) {
  const IndexedMesh mesh = mesh_in_frame(one, frame, scale, size, "the mesh in another frame");
  return py::make_tuple(array_of(mesh.points), array_of(mesh.triangles));
}

py::array node_array(const Remesh& one, const std::string& frame, double scale, double size) {
  const NodeTable table = node_table(mesh_in_frame(one, frame, scale, size, "the node table"));
  // A structured array has names for its columns, and pandas reads it.
  py::list fields;
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "area"}) {
    fields.append(py::make_tuple(name, "f8"));
  }
  std::vector<std::array<double, 7>> rows;
  for (std::size_t i = 0; i < table.areas.size(); ++i) {
    const Vector3& p = table.mesh.points[i];
    const Vector3& n = table.normals[i];
    rows.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), table.areas[i]});
  }
  const py::object columns = py::module_::import("numpy").attr("dtype")(fields);
  return array_of(rows).attr("view")(columns).attr("reshape")(-1);
}

void write_node_file(const Remesh& one, const std::filesystem::path& path, const std::string& frame,
                     double scale, double size) {
  require_whole(one, "the node table");
  write_nodes(path.string(), one.result, simulation_options(frame, scale, size));
}

void write_grid_file(const Remesh& one, const std::filesystem::path& path, double spacing,
                     const std::string& surface, const std::string& frame, double scale,
                     double size, int threads, const py::object& progress) {
  require_whole(one, "signed distances");
  SimulationOptions options = simulation_options(frame, scale, size);
  options.surface = value_of_name<GridSurface>(surface);
  options.grid.spacing = spacing;
  check_simulation_options(options);
  if (options.surface == GridSurface::Scan && one.result.repaired_scan.points.empty()) {
    refuse(
        "This result does not have its scan. Remesh with keep_scan=True, or give "
        "surface=\"remesh\".");
  }
  work_on(threads, progress, [&](const Execution& execution) {
    write_distance_grid(path.string(), one.result, options, one.origin, execution);
    return true;
  });
}

std::vector<std::string> warnings_of(const Remesh& one) {
  std::vector<std::string> sentences;
  for (const Sentence& warning : one.result.warnings) {
    sentences.push_back(in_words_of_python(warning));
  }
  return sentences;
}

py::tuple state_of(const Remesh& one) {
  const RemeshResult& result = one.result;
  return py::make_tuple(array_of(result.mesh.points), array_of(result.mesh.triangles),
                        array_of(std::vector<Vector3>{result.centre}), result.radial_distances,
                        result.cell_areas, result.vertex_distances, warnings_of(one),
                        report_of(one), log_of(one));
}

Remesh from_state(const py::tuple& state) {
  Remesh one;
  one.result.mesh = mesh_of(state[0].cast<Points>(), state[1]);
  one.result.centre = points_of(state[2].cast<Points>()).at(0);
  one.result.radial_distances = state[3].cast<std::vector<double>>();
  one.result.cell_areas = state[4].cast<std::vector<double>>();
  one.result.vertex_distances = state[5].cast<std::vector<double>>();
  for (auto& warning : state[6].cast<std::vector<std::string>>()) {
    one.result.warnings.emplace_back(std::move(warning));
  }
  one.pickled_report = state[7].cast<std::string>();
  one.pickled_log = state[8].cast<std::string>();
  return one;
}

std::string repr_of(const Remesh& one) {
  const py::dict report = parsed(report_of(one));
  const py::object percent = report["rms_distance"]["percent_of_equivalent_radius"];
  std::string text = "<wscvt.Remesh of " + std::to_string(one.result.mesh.points.size()) +
                     " nodes and " + std::to_string(one.result.mesh.triangles.size()) + " faces, ";
  const auto source = report["source"];
  if (py::isinstance<py::str>(source)) {
    text += "of " + py::repr(source).cast<std::string>() + ", ";
  }
  if (!percent.is_none()) {
    text += "rms distance " + py::str("{:.2g} %").format(percent).cast<std::string>() + " of R, ";
  }
  return text + format_count(one.result.warnings.size(), "warning") + ">";
}

void add_arrays(RemeshClass& type) {
  type.def_property_readonly("vertices",
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
      .def_property_readonly("warnings", [](const Remesh& one) { return warnings_of(one); })
      .def_property_readonly("report", [](const Remesh& one) { return parsed(report_of(one)); });
}

void add_files(RemeshClass& type) {
  type.def("write_report", &write_report_file, py::arg("path"), py::kw_only(),
           py::arg("threads") = 0, py::arg("progress") = py::none(),
           "Writes the report: HTML with pictures (.html), everything (.json), or a row appended "
           "to a table (.csv). HTML needs keep_scan (default).")
      .def("in_frame", &mesh_arrays, py::arg("frame") = "input", py::kw_only(),
           py::arg("scale") = 1.0, py::arg("size") = 0.0,
           "Returns (vertices, faces) as \"wscvt remesh\" writes them with these options. frame: "
           "input, centred or principal; scale: scale factor; size: equivalent diameter, instead "
           "of scale.")
      .def("node_table", &node_array, py::kw_only(), py::arg("frame") = "input",
           py::arg("scale") = 1.0, py::arg("size") = 0.0,
           "Returns a structured array (N,) with the fields x, y, z (length), nx, ny, nz (unit, "
           "outward) and area (length^2, a third of the triangles around the node). frame: input, "
           "centred or principal; scale: scale factor; size: equivalent diameter, instead of "
           "scale.")
      .def(
          "write_node_table", &write_node_file, py::arg("path"), py::kw_only(),
          py::arg("frame") = "input", py::arg("scale") = 1.0, py::arg("size") = 0.0,
          "Writes the node table as .csv, .vtp (ParaView) or .shp (Rockable; frame=\"principal\").")
      .def("write_signed_distances", &write_grid_file, py::arg("path"), py::arg("spacing") = 0.0,
           py::kw_only(), py::arg("surface") = "scan", py::arg("frame") = "input",
           py::arg("scale") = 1.0, py::arg("size") = 0.0, py::arg("threads") = 0,
           py::arg("progress") = py::none(),
           "Writes signed distances on a grid, negative inside: .npy with a description file, .vti "
           "(ParaView) or .json (NetDEM). spacing: length, 0 for 1/50 of the equivalent diameter; "
           "surface: scan (needs keep_scan) or remesh.");
}

}  // namespace

void bind_remesh_object(py::module_& module) {
  RemeshClass type(
      module, "Remesh",
      "A remesh of N nodes.\n\n"
      "vertices (N, 3) float64, length; faces (m, 3) int32, counter-clockwise from outside, m = 2 "
      "N "
      "- 4 without handles; centre (3,), length; radial_distances (N,) from it, length; cell_areas "
      "(N,), length^2; vertex_distances (N,) from the scan, length, positive outside, empty unless "
      "distances=True; "
      "warnings, a list of sentences; report, a dictionary like the JSON report. str() returns the "
      "log. Pickles keep arrays, report and log.");
  type.attr("__module__") = "wscvt";
  add_arrays(type);
  add_files(type);
  type.def("__repr__", &repr_of).def("__str__", &log_of).def(py::pickle(&state_of, &from_state));
}

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
