// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/rockable_shape.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_distance.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

constexpr double radii_percent[] = {5.0, 4.0, 3.0, 2.0, 1.0, 0.5, 0.2, 0.1};
constexpr double allowed_rms_percent = 0.1;
constexpr std::size_t sample_count = 5000;

void check_frame(const MassProperties& mass, double radius) {
  const Eigen::Matrix3d& tensor = mass.inertia_tensor;
  const double off_diagonal = (tensor - Eigen::Matrix3d(tensor.diagonal().asDiagonal())).norm();
  if (mass.centroid.norm() <= 1e-6 * radius && off_diagonal <= 1e-6 * tensor.norm()) return;
  refuse(
      "A Rockable shape has moments about the principal axes and no axes, but the grain is "
      "in another frame. Use the principal frame.");
}

/// Returns how the vertices move if the faces move inwards by 1: the least squares over the faces
/// of a vertex, weighted by area.
std::vector<Vector3> moves_of_faces(const IndexedMesh& mesh) {
  // Where faces are nearly in one plane, the squares say nothing about moves along it. This share
  // of them keeps such moves short, and costs a box' corners less than 1 % of their way.
  constexpr double kept_near_normal = 0.001;
  std::vector<Vector3> moves = vertex_normals(mesh.points, mesh.triangles);
  std::vector<Eigen::Matrix3d> squares(moves.size(), Eigen::Matrix3d::Zero());
  std::vector<Vector3> rests(moves.size(), Vector3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 doubled = doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
    const double weight = doubled.norm();
    if (weight == 0.0) continue;
    const Vector3 normal = doubled / weight;
    for (const std::int32_t v : {a, b, c}) {
      squares[v] +=
          weight * (normal * normal.transpose() + kept_near_normal * Eigen::Matrix3d::Identity());
      rests[v] += weight * (1.0 - normal.dot(moves[v])) * normal;
    }
  }
  for (std::size_t v = 0; v < moves.size(); ++v) {
    if (squares[v].trace() > 0.0) moves[v] += squares[v].ldlt().solve(rests[v]);
  }
  return moves;
}

/// The points of a mesh where its distance from the rounded body is taken. The first ones are
/// spread evenly over it, the others are its vertices.
struct Probes {
  std::vector<Vector3> points;
  std::vector<Vector3> normals;  ///< of the faces; only of the points spread evenly

  explicit Probes(const IndexedMesh& mesh) {
    for (const MeshPlace& place : area_uniform_places(mesh, sample_count)) {
      points.push_back(point_at(mesh, place));
      normals.push_back(doubled_area_normal(mesh, place.triangle).normalized());
    }
    points.insert(points.end(), mesh.points.begin(), mesh.points.end());
  }
};

/// `drawn_in`: the mesh of the rounded body's corners.
Rounding rounding_by(double percent, const IndexedMesh& drawn_in, const Probes& probes,
                     double of_grain, double area, double volume) {
  Rounding rounding;
  rounding.radius_percent = percent;
  rounding.radius = 0.01 * percent * of_grain;
  const Execution execution(1);
  const std::vector<MeshPlace> places =
      MeshDistance(drawn_in, execution).nearest_places(probes.points, execution);
  double squares = 0.0;
  double outwards = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3 way = probes.points[i] - point_at(drawn_in, places[i]);
    const double distance = way.norm();
    const double gap = rounding.radius - distance;
    largest = std::max(largest, std::abs(gap));
    if (i >= probes.normals.size()) continue;
    squares += gap * gap;
    if (distance > 0.0) outwards += gap * probes.normals[i].dot(way) / distance;
  }
  const double in_percent = 100.0 / of_grain;
  rounding.rms_percent = in_percent * std::sqrt(squares / sample_count);
  rounding.largest_percent = in_percent * largest;
  rounding.volume_percent = 100.0 * outwards / sample_count * area / volume;
  return rounding;
}

std::string text_of(const std::string& name, const IndexedMesh& corners, double radius,
                    const MassProperties& mass) {
  Eigen::AlignedBox3d box;
  std::string points;
  for (const Vector3& corner : corners.points) {
    box.extend(corner);
    points += vector_text(corner) + "\n";
  }
  std::size_t edge_count = 0;
  std::string edges;
  std::string faces;
  for (const Triangle& t : corners.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t from = t[k];
      const std::int32_t to = t[(k + 1) % 3];
      if (from > to) continue;  // once: the neighbouring triangle has it the other way round
      edges += std::to_string(from) + " " + std::to_string(to) + "\n";
      ++edge_count;
    }
    faces += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) +
             "\n";
  }
  const Vector3 extent = 0.5 * box.sizes() + Vector3::Constant(radius);
  const Vector3 moments = mass.inertia_tensor.diagonal() / mass.volume;
  return "<\nname " + name + "\nradius " + format_exact(radius) + "\npreCompDone y\nnv " +
         std::to_string(corners.points.size()) + "\n" + points + "ne " +
         std::to_string(edge_count) + "\n" + edges + "nf " +
         std::to_string(corners.triangles.size()) + "\n" + faces + "obb.extent " +
         vector_text(extent) + "\nobb.e1 1 0 0\nobb.e2 0 1 0\nobb.e3 0 0 1\nobb.center " +
         vector_text(0.5 * (box.min() + box.max())) +
         "\nposition 0 0 0\norientation 1 0 0 0\nvolume " + format_exact(mass.volume) + "\nI/m " +
         vector_text(moments) + "\n>\n";
}

/// Returns a file's name as one word.
std::string word_of(const std::string& path) {
  std::string word = std::filesystem::path(path).stem().string();
  std::replace_if(
      word.begin(), word.end(), [](unsigned char c) { return c <= ' '; }, '_');
  return word.empty() ? "grain" : word;
}

}  // namespace

RockableShape rockable_shape(const std::string& path, const IndexedMesh& mesh,
                             const MassProperties& mass) {
  const double of_grain = equivalent_radius(mass.volume);
  check_frame(mass, of_grain);
  const std::vector<Vector3> moves = moves_of_faces(mesh);
  const Probes probes(mesh);
  const MeshSums sums = mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1));
  Rounding rounding;
  IndexedMesh corners = mesh;
  for (const double percent : radii_percent) {
    for (std::size_t v = 0; v < moves.size(); ++v) {
      corners.points[v] = mesh.points[v] - 0.01 * percent * of_grain * moves[v];
    }
    rounding = rounding_by(percent, corners, probes, of_grain, sums.area(), sums.volume());
    if (rounding.rms_percent <= allowed_rms_percent) break;
  }
  return {text_of(word_of(path), corners, rounding.radius, mass), rounding};
}

Rounding write_rockable_shape(const std::string& path, const IndexedMesh& mesh,
                              const MassProperties& mass) {
  const RockableShape shape = rockable_shape(path, mesh, mass);
  write_file(path, shape.text);
  return shape.rounding;
}

std::vector<std::string> rounding_lines(const std::vector<Rounding>& bodies) {
  Rounding least;
  Rounding most;
  bool is_first = true;
  for (const Rounding& one : bodies) {
    if (one.radius == 0.0) continue;
    if (is_first) least = most = one;
    is_first = false;
    least.radius_percent = std::min(least.radius_percent, one.radius_percent);
    most.radius_percent = std::max(most.radius_percent, one.radius_percent);
    most.rms_percent = std::max(most.rms_percent, one.rms_percent);
    most.largest_percent = std::max(most.largest_percent, one.largest_percent);
    least.volume_percent = std::min(least.volume_percent, one.volume_percent);
    most.volume_percent = std::max(most.volume_percent, one.volume_percent);
  }
  if (is_first) return {};
  const auto range = [](const std::string& from, const std::string& to) {
    return from == to ? from : from + " to " + to;
  };
  return {"Rounded for Rockable by " +
          range(format_number(least.radius_percent), format_number(most.radius_percent)) +
          " % of the equivalent radius: rms distance " + format_number(most.rms_percent, 2) +
          " % of it, largest " + format_number(most.largest_percent, 2) + " %, volume " +
          range(format_number(least.volume_percent, 2), format_number(most.volume_percent, 2)) +
          " %"};
}

}  // namespace wscvt
