// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "figures/study/paper_study.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt::study {

namespace {

/// Triangles as gnuplot's pm3d takes them: each a quadrangle of two rows with its last corner
/// twice, "x y z value" a line.
void write_triangles(const std::string& path, const IndexedMesh& mesh,
                     const std::vector<double>& values) {
  std::string text;
  const auto corner = [&](std::int32_t v) {
    for (const double x : mesh.points[v]) text += format_number(x) + " ";
    text += format_number(values[v]) + "\n";
  };
  for (const Triangle& t : mesh.triangles) {
    corner(t[0]);
    corner(t[1]);
    text += "\n";
    corner(t[2]);
    corner(t[2]);
    text += "\n\n";
  }
  write_file(path, text);
}

std::string file_name(const std::string& figure, const std::string& name, std::size_t nodes) {
  return figure + "_" + name + "_" + std::to_string(nodes) + ".dat";
}

std::vector<std::string> quality_row(const std::string& name, std::size_t nodes,
                                     const MeshQuality& quality) {
  return {name,
          std::to_string(nodes),
          format_number(quality.edge_variation, 3),
          format_number(quality.edge_ratio.mean, 4),
          format_number(quality.edge_ratio.standard_deviation, 3),
          format_number(quality.smallest_angle, 3)};
}

const std::vector<std::string> quality_columns = {
    "mesh", "nodes", "edge_variation", "mean_edge_ratio", "edge_ratio_deviation", "smallest_angle"};

}  // namespace

Table write_samplings(const std::string& folder, const Scan& scan, const Execution& execution) {
  constexpr int node_count = 500;
  Table table = {quality_columns};
  for (const Method& method :
       {fibonacci, Method{"equal-angle", Sampling::EqualAngle, Weighting::Constant},
        Method{"icosahedron", Sampling::Icosahedron, Weighting::Constant}, wscvt_d}) {
    const RemeshResult result = remesh(scan.mesh, paper_options(method, node_count), execution);
    IndexedMesh sphere = result.mesh;
    sphere.points = result.directions;
    write_triangles(folder + "/figure1_" + method.name + ".dat", sphere,
                    std::vector<double>(sphere.points.size(), 1.0));
    table.push_back(quality_row(method.name, sphere.points.size(), measure_quality(sphere)));
  }
  return table;
}

Table write_pictures(const std::string& folder, const Scan& scan, const Execution& execution) {
  Table table = {quality_columns};
  for (const Method& method : {wscvt_d, wscvt_c}) {
    const bool by_radius = method.weighting == Weighting::RadialDistance;
    const std::string figure = by_radius ? "figure6" : "figure9";
    for (const int node_count : {500, 1000, 2000}) {
      RemeshOptions options = paper_options(method, node_count);
      options.measures.node_curvatures = true;
      const RemeshResult result = remesh(scan.mesh, options, execution);
      const double unit = result.input.equivalent_radius;
      const auto write = [&](const std::string& path, IndexedMesh mesh,
                             const std::vector<double>& values, double factor) {
        std::vector<double> scaled = values;
        for (double& value : scaled) value *= factor;
        for (Vector3& point : mesh.points) point = (point - result.centre) / unit;
        write_triangles(path, mesh, scaled);
      };
      write(folder + "/" + file_name(figure, scan.name, result.directions.size()), result.mesh,
            by_radius ? result.radial_distances : result.curvatures, by_radius ? 1.0 / unit : unit);
      table.push_back(
          quality_row(scan.name + " " + method.name, result.directions.size(), result.quality));
      if (node_count != 500) continue;
      std::vector<Vector3> directions;
      std::vector<double> radii;
      for (const Vector3& point : scan.mesh.points) {
        radii.push_back((point - result.centre).norm());
        directions.push_back((point - result.centre) / radii.back());
      }
      write(folder + "/" + figure + "_" + scan.name + "_scan.dat", scan.mesh,
            by_radius ? radii
                      : largest_curvatures(HarmonicSurface(result.coefficients.radius), directions,
                                           execution),
            by_radius ? 1.0 / unit : unit);
    }
  }
  return table;
}

Table write_distributions(const std::string& folder, const std::vector<Scan>& scans,
                          const Execution& execution) {
  constexpr std::size_t bins = 60;
  Table shares = {{"grain", "measure", "bin_centre", "bin_width", "scan_share", "remesh_share"}};
  Table table = {quality_columns};
  for (const Scan& scan : scans) {
    const std::size_t nodes = scan.mesh.points.size();
    const RemeshResult result =
        remesh(scan.mesh, paper_options(wscvt_d, static_cast<int>(nodes)), execution);
    const QualityHistograms before = quality_histograms(scan.mesh, bins);
    const QualityHistograms after = quality_histograms(result.mesh, bins);
    const auto append = [&](const std::string& measure, const Histogram& a, const Histogram& b) {
      double total_a = 0.0;
      double total_b = 0.0;
      for (std::size_t i = 0; i < bins; ++i) {
        total_a += static_cast<double>(a.counts[i]);
        total_b += static_cast<double>(b.counts[i]);
      }
      const double width = (a.upper - a.lower) / static_cast<double>(bins);
      for (std::size_t i = 0; i < bins; ++i) {
        shares.push_back(
            {scan.name, measure, format_number(a.lower + (static_cast<double>(i) + 0.5) * width),
             format_number(width), format_number(static_cast<double>(a.counts[i]) / total_a),
             format_number(static_cast<double>(b.counts[i]) / total_b)});
      }
    };
    append("edge_length", before.relative_edge_length, after.relative_edge_length);
    append("edge_ratio", before.edge_ratio, after.edge_ratio);
    table.push_back(quality_row(scan.name + " scan", nodes, result.scan_quality));
    table.push_back(quality_row(scan.name + " WSCVT-D", nodes, result.quality));
  }
  write_csv(folder + "/figure7.csv", shares);
  return table;
}

}  // namespace wscvt::study
