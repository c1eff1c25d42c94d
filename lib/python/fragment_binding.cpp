// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/conforming/conforming_files.h"
#include "toolbox/fragment/fragments.h"
#include "work.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

py::dict report_of(const Fragments& result) {
  const std::vector<CommonWall>& walls = result.contacts;
  py::list pairs;
  for (const CommonWall& wall : walls) pairs.append(py::make_tuple(wall.first, wall.second));
  py::dict contacts;
  contacts["fragments"] = pairs;
  contacts["area"] = column(walls, &CommonWall::area);
  contacts["centre"] = column(walls, &CommonWall::centre);
  contacts["normal"] = column(walls, &CommonWall::normal);
  py::dict report;
  report["volume"] = column(result.list, [](const Fragment& f) { return f.mass.volume; });
  report["centroid"] = column(result.list, [](const Fragment& f) { return f.mass.centroid; });
  report["surface_area"] = column(result.list, &Fragment::surface_area);
  report["hull_excess_percent"] = column(result.list, &Fragment::hull_excess_percent);
  report["contacts"] = contacts;
  report["moved_pieces"] = result.moved_pieces;
  report["moved_percent"] = result.moved_percent;
  return report;
}

py::tuple fragment(const Points& vertices, const py::object& faces, int count, std::uint64_t seed,
                   const std::vector<double>& volumes, const py::object& near, double edge_length,
                   int nodes, int threads, const py::object& progress) {
  FragmentOptions options;
  options.count = count;
  options.seed = seed;
  options.volumes = volumes;
  if (!near.is_none()) options.near = points_of(py::cast<Points>(near));
  ConformingOptions walls;
  walls.edge_length = edge_length;
  walls.nodes = nodes;
  check_conforming_options(walls);
  const bool is_remeshed = edge_length > 0.0 || nodes > 0;
  IndexedMesh scan = mesh_of(vertices, faces);
  std::vector<Sentence> about_walls;
  const Fragments result = work_on(threads, progress, [&](const Execution& execution) {
    Fragments made =
        fragment_grain(std::move(scan), options, execution.part(0.0, is_remeshed ? 0.3 : 1.0));
    if (is_remeshed) {
      about_walls = conforming_warnings(remesh_fragments(made, walls, execution.part(0.3, 1.0)));
    }
    return made;
  });
  for (const Sentence& warning : about_walls) warn(warning);
  for (const Sentence& warning : result.warnings) warn(warning);
  py::list meshes;
  for (const Fragment& one : result.list) {
    meshes.append(py::make_tuple(array_of(one.mesh.points), array_of(one.mesh.triangles)));
  }
  return py::make_tuple(meshes, report_of(result));
}

}  // namespace

// wscvt/__init__.py documents the arguments and the result.
void bind_fragment(py::module_& module) {
  const FragmentOptions usual;
  module.def("fragment", &fragment, py::arg("vertices"), py::arg("faces"), py::kw_only(),
             py::arg("count").noconvert() = usual.count, py::arg("seed") = usual.seed,
             py::arg("volumes") = std::vector<double>(), py::arg("near") = py::none(),
             py::arg("edge_length") = 0.0, py::arg("nodes") = 0, py::arg("threads") = 0,
             py::arg("progress") = py::none());
}

}  // namespace wscvt::python
