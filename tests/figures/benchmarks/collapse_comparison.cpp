// SPDX-License-Identifier: GPL-3.0-or-later
// Prints one table: this remesher and the two edge collapses of CGAL (Lindstrom and Turk 1998,
// Garland and Heckbert 1997) on the same scans at the same number of nodes, all measured alike.
//
//   collapse_comparison [--exact] [mesh file ...]
//
// Without files: scans of the four reference grains, and the sample; with --exact: the four grains
// themselves, meshed from their formulas, so that no scanner's noise counts.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "grains/ct_grain.h"
#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/repair/mesh_check.h"

namespace {

using namespace wscvt;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh to_surface_mesh(const IndexedMesh& mesh) {
  SurfaceMesh result;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  for (const Vector3& p : mesh.points) {
    vertices.push_back(result.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  }
  for (const Triangle& t : mesh.triangles) {
    result.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  }
  return result;
}

IndexedMesh from_surface_mesh(SurfaceMesh& mesh) {
  mesh.collect_garbage();
  IndexedMesh result;
  for (const auto vertex : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(vertex);
    result.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto face : mesh.faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) {
      t[k++] = static_cast<std::int32_t>(vertex);
    }
    result.triangles.push_back(t);
  }
  return result;
}

namespace simplification = CGAL::Surface_mesh_simplification;

/// A closed mesh of genus 0 with N vertices has 3 N - 6 edges.
simplification::Count_stop_predicate<SurfaceMesh> stop_at(int nodes) {
  return {static_cast<std::size_t>(3 * nodes - 6 + 1)};
}

IndexedMesh lindstrom_turk(const IndexedMesh& scan, int nodes) {
  SurfaceMesh mesh = to_surface_mesh(scan);
  simplification::edge_collapse(
      mesh, stop_at(nodes),
      CGAL::parameters::get_cost(simplification::LindstromTurk_cost<SurfaceMesh>())
          .get_placement(simplification::LindstromTurk_placement<SurfaceMesh>()));
  return from_surface_mesh(mesh);
}

IndexedMesh garland_heckbert(const IndexedMesh& scan, int nodes) {
  SurfaceMesh mesh = to_surface_mesh(scan);
  const simplification::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(mesh);
  simplification::edge_collapse(
      mesh, stop_at(nodes),
      CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  return from_surface_mesh(mesh);
}

struct Method {
  std::string name;
  std::function<IndexedMesh(const IndexedMesh& scan, int nodes)> run;
};

Method on_scan(const std::string& name, CellWeighting weighting, double edge_ratio) {
  OnScanOptions method;
  method.weighting = weighting;
  method.edge_ratio = edge_ratio;
  return {name, [method](const IndexedMesh& scan, int nodes) {
            RemeshOptions options;
            options.node_count = nodes;
            options.method = method;
            return remesh(scan, options).mesh;
          }};
}

IndexedMesh published(const IndexedMesh& scan, int nodes) {
  RemeshOptions options;
  options.node_count = nodes;
  options.method = AsPublishedOptions();
  return remesh(scan, options).mesh;
}

std::vector<Method> methods() {
  return {
      {"WSCVT-D, as published", published},
      on_scan("WSCVT-D", CellWeighting::Area, default_edge_ratio),
      on_scan("WSCVT-D, edge ratio 1.4", CellWeighting::Area, 1.4),
      on_scan("WSCVT-D, edge ratio 1.6", CellWeighting::Area, 1.6),
      {"Lindstrom-Turk collapse", lindstrom_turk},
      {"Garland-Heckbert collapse", garland_heckbert},
  };
}

double box_diagonal(const IndexedMesh& mesh) {
  Vector3 low = mesh.points.front();
  Vector3 high = low;
  for (const Vector3& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

struct Row {
  double rms = 0.0;      ///< % of the equivalent radius
  double largest = 0.0;  ///< % of the equivalent radius
  double smallest_angle = 0.0;
};

Row measure(const Method& method, const std::string& scan_name, const IndexedMesh& scan,
            int nodes) {
  const Execution execution;
  const auto start = std::chrono::steady_clock::now();
  const IndexedMesh mesh = method.run(scan, nodes);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const MeshDistances distances = measure_distances(mesh, scan, usual_distance_samples, execution);
  const ShapeDescriptors shape = describe_shape(mesh, execution);
  const ShapeDescriptors original = describe_shape(scan, execution);
  const MeshQuality quality = measure_quality(mesh);
  const double radius = std::cbrt(original.volume / (4.0 / 3.0 * pi));
  const double diagonal = box_diagonal(scan);
  const Row row = {100.0 * distances.root_mean_square / radius, 100.0 * distances.largest / radius,
                   quality.smallest_angle};
  const bool crosses = CGAL::Polygon_mesh_processing::does_self_intersect(to_surface_mesh(mesh));
  std::printf("%-10s %5zu %-30s %9.1e %8.3f %8.4f %8.4f %8.4f %8.3f %8.3f %6.2f %6.1f %5s %6.2f\n",
              scan_name.c_str(), mesh.points.size(), method.name.c_str(),
              relative_error_percent(shape.volume, original.volume),
              relative_error_percent(shape.area, original.area),
              inertia_error_percent(shape, original), row.rms,
              100.0 * distances.root_mean_square / diagonal, row.largest,
              100.0 * distances.largest / diagonal, quality.edge_ratio.mean, quality.smallest_angle,
              crosses ? "yes" : "no", seconds.count());
  std::fflush(stdout);
  return row;
}

/// Mended once for all, so that no method has to work on what another drops.
IndexedMesh mended(IndexedMesh mesh) {
  return check_mesh(std::move(mesh), MeshCheckOptions(), Execution()).mesh;
}

int run(int argc, char** argv) {
  CLI::App app{"Compare with the edge collapses of CGAL at the same number of nodes."};
  std::vector<std::string> files;
  bool exact = false;
  app.add_option("files", files, "Scans; none: the project's own");
  app.add_flag("--exact", exact, "Without files: the reference grains as they are, not scanned");
  CLI11_PARSE(app, argc, argv);

  std::vector<std::pair<std::string, IndexedMesh>> scans;
  if (files.empty()) {
    constexpr int vertices = 7000;
    constexpr int subdivisions = 6;  // 40,962 vertices
    for (const test::Grain& grain : test::reference_grains()) {
      scans.emplace_back(grain.name.substr(0, 10),
                         mended(exact ? test::exact_mesh(grain, test::sphere(subdivisions))
                                      : test::ct_mesh_of_about(grain, vertices)));
    }
    if (!exact) {
      scans.emplace_back("sand_7228", mended(read_mesh(WSCVT_MESHES_DIR "/sand_7228.ply")));
    }
  }
  for (const std::string& file : files) {
    scans.emplace_back(file.substr(std::max<std::size_t>(file.size(), 14) - 14, 10),
                       mended(read_mesh(file)));
  }

  std::printf(
      "Errors in %% of the scan's; distances two-sided, in %% of the equivalent radius (R) "
      "and of the bounding-box diagonal (d).\n");
  std::printf("%-10s %5s %-30s %9s %8s %8s %8s %8s %8s %8s %6s %6s %5s %6s\n", "scan", "N",
              "method", "volume", "area", "inertia", "rms/R", "rms/d", "max/R", "max/d", "ratio",
              "angle", "cross", "s");
  const std::vector<Method> all = methods();
  std::string summary;
  for (const auto& [name, scan] : scans) {
    for (const int nodes : {100, 500, 1000, 2000}) {
      std::vector<Row> rows;
      for (const Method& method : all) rows.push_back(measure(method, name, scan, nodes));
      const Row& close = rows[all.size() - 3];
      char text[160];
      std::snprintf(text, sizeof text, "%-10s %5d   rms %.2f   largest %.2f   angle %.1f\n",
                    name.c_str(), nodes, close.rms / rows[all.size() - 2].rms,
                    close.largest / rows[all.size() - 1].largest, close.smallest_angle);
      summary += text;
    }
  }
  std::printf(
      "\nAt an edge ratio of 1.6: its rms distance / Lindstrom-Turk's, its largest distance / "
      "Garland-Heckbert's, its smallest angle.\n%s",
      summary.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
