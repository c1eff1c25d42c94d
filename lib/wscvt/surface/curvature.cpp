// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/curvature.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t quadric_block = 256;

/// The paper fits over one ring, which scans leave under-determined.
constexpr int usual_rings = 2;

/// Below this fraction of the largest pivot a column of the fit does not count.
constexpr double rank_tolerance = 1e-10;

/// The corners of all faces sorted by vertex. Half-edge k of face f starts at corner 3 f + k, so
/// the corners of a vertex give both its faces and its neighbours.
class VertexCorners {
 public:
  explicit VertexCorners(const IndexedMesh& mesh)
      : mesh_(mesh),
        corners_(counting_sort(3 * mesh.triangles.size(), mesh.points.size(),
                               [&](std::size_t corner, const auto& visit) {
                                 visit(index(mesh.triangles[corner / 3][corner % 3]));
                               })) {}

  /// Calls visit(next, previous), the two other vertices of each face around v.
  template <class Visit>
  void visit_faces(std::int32_t v, const Visit& visit) const {
    for (auto i = corners_.begin(index(v)); i != corners_.end(index(v)); ++i) {
      const std::size_t corner = index(*i);
      const Triangle& t = mesh_.triangles[corner / 3];
      visit(t[(corner + 1) % 3], t[(corner + 2) % 3]);
    }
  }

 private:
  const IndexedMesh& mesh_;
  Groups corners_;
};

/// Returns the normal of a vertex: its faces' normals, weighted by their angles there; zero if they
/// cancel.
Vector3 angle_weighted_normal(const IndexedMesh& mesh, const VertexCorners& corners,
                              std::int32_t v) {
  const Vector3& p = mesh.points[index(v)];
  Vector3 sum = Vector3::Zero();
  corners.visit_faces(v, [&](std::int32_t next, std::int32_t previous) {
    const Vector3 a = mesh.points[index(next)] - p;
    const Vector3 b = mesh.points[index(previous)] - p;
    const Vector3 normal = a.cross(b);
    const double length = normal.norm();
    if (length > 0.0) sum += portable::atan2(length, a.dot(b)) / length * normal;
  });
  return sum.normalized();
}

/// Collects the vertices within `rings` edges of v, v first, each once.
void collect_rings(const VertexCorners& corners, std::int32_t v, int rings,
                   std::vector<std::int32_t>& result) {
  result.assign(1, v);
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = result.size();
    for (std::size_t i = begin; i < end; ++i) {
      corners.visit_faces(result[i], [&](std::int32_t next, std::int32_t) {
        if (std::find(result.begin(), result.end(), next) == result.end()) result.push_back(next);
      });
    }
    begin = end;
  }
}

PrincipalCurvatures fit_quadric(const std::vector<Vector3>& points,
                                const std::vector<std::int32_t>& vertices, const Vector3& normal) {
  const Vector3& origin = points[index(vertices.front())];
  const Vector3 axis_x = normal.unitOrthogonal();
  const Vector3 axis_y = normal.cross(axis_x);
  const auto count = static_cast<Eigen::Index>(vertices.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> local(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector3 d = points[index(vertices[static_cast<std::size_t>(i)])] - origin;
    local.row(i) << d.dot(axis_x), d.dot(axis_y), d.dot(normal);
  }
  // Uses units of the ring, so that the columns have similar size.
  const double unit = std::sqrt(local.leftCols<2>().squaredNorm() / static_cast<double>(count));
  if (!(unit > 0.0)) return {};
  local /= unit;
  Eigen::Matrix<double, Eigen::Dynamic, 6> columns(count, 6);
  columns << local.col(0).cwiseAbs2(), local.col(1).cwiseAbs2(),
      local.col(0).cwiseProduct(local.col(1)), local.leftCols<2>(), Eigen::VectorXd::Ones(count);
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, Eigen::Dynamic, 6>> decomposition;
  decomposition.setThreshold(rank_tolerance);
  decomposition.compute(columns);
  const Eigen::Matrix<double, 6, 1> c = decomposition.solve(local.col(2));

  const double fx = c[3];
  const double fy = c[4];
  const double fxx = 2.0 * c[0] / unit;
  const double fyy = 2.0 * c[1] / unit;
  const double fxy = c[2] / unit;
  const double square = 1.0 + fx * fx + fy * fy;
  const double gauss = (fxx * fyy - fxy * fxy) / (square * square);
  const double mean = ((1.0 + fx * fx) * fyy - 2.0 * fx * fy * fxy + (1.0 + fy * fy) * fxx) /
                      (2.0 * square * std::sqrt(square));
  // The normal points out of the body: a convex surface falls away from it.
  const double deviation = std::sqrt(std::max(0.0, mean * mean - gauss));
  return {deviation - mean, -deviation - mean};
}

}  // namespace

std::vector<PrincipalCurvatures> quadric_fit_curvatures(const IndexedMesh& mesh, int rings,
                                                        const Execution& execution) {
  if (rings < 1) {
    refuse("The number of rings for the curvature fit is " + std::to_string(rings) +
           ". Give 1 or more, e.g. 2.");
  }
  const VertexCorners corners(mesh);
  std::vector<PrincipalCurvatures> result(mesh.points.size());
  execution.parallel_for(result.size(), quadric_block, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> vertices;
    for (std::size_t i = begin; i < end; ++i) {
      const auto v = static_cast<std::int32_t>(i);
      const Vector3 normal = angle_weighted_normal(mesh, corners, v);
      if (normal.isZero()) continue;
      collect_rings(corners, v, rings, vertices);
      result[i] = fit_quadric(mesh.points, vertices, normal);
    }
  });
  return result;
}

std::vector<double> largest_curvatures(const RadialSurface& surface,
                                       const std::vector<Vector3>& directions,
                                       const Execution& execution) {
  const std::vector<RadialJet> jets = surface.jets(directions, Derivatives::Second, execution);
  std::vector<double> result;
  result.reserve(jets.size());
  for (std::size_t i = 0; i < jets.size(); ++i) {
    const PrincipalCurvatures k = principal_curvatures(jets[i], directions[i]);
    result.push_back(std::max(std::abs(k.maximum), std::abs(k.minimum)));
  }
  return result;
}

std::vector<double> largest_curvatures(const IndexedMesh& mesh, const Execution& execution) {
  std::vector<double> result;
  result.reserve(mesh.points.size());
  for (const PrincipalCurvatures& k : quadric_fit_curvatures(mesh, usual_rings, execution)) {
    result.push_back(std::max(std::abs(k.maximum), std::abs(k.minimum)));
  }
  return result;
}

namespace {

/// Radius of the discs over which curvatures are averaged, in sqrt(area per node).
constexpr double disc_radius = 0.6;

/// Averages over the vertices' rings, by area, as often as needed to carry a value over `distance`:
/// each round spreads it like a random walk by one edge.
void spread(const IndexedMesh& mesh, const std::vector<double>& areas, double distance,
            std::vector<double>& values, const Execution& execution) {
  constexpr double most_rounds = 400.0;
  double squared_edges = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    squared_edges += (mesh.points[a] - mesh.points[b]).squaredNorm() +
                     (mesh.points[b] - mesh.points[c]).squaredNorm() +
                     (mesh.points[c] - mesh.points[a]).squaredNorm();
  }
  squared_edges /= 3.0 * static_cast<double>(mesh.triangles.size());
  const double wanted = std::ceil(distance * distance / squared_edges);
  const int rounds = static_cast<int>(std::clamp(wanted, 1.0, most_rounds));
  std::vector<double> moments(values.size());
  std::vector<double> measures(values.size());
  for (int round = 0; round < rounds; ++round) {
    execution.report(0.0, "Computing weights");
    std::fill(moments.begin(), moments.end(), 0.0);
    std::fill(measures.begin(), measures.end(), 0.0);
    for (const Triangle& t : mesh.triangles) {
      double moment = 0.0;
      double measure = 0.0;
      for (const std::int32_t v : t) {
        moment += areas[v] * values[v];
        measure += areas[v];
      }
      for (const std::int32_t v : t) {
        moments[v] += moment;
        measures[v] += measure;
      }
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (measures[i] > 0.0) values[i] = moments[i] / measures[i];
    }
  }
}

double weighted_mean(const std::vector<double>& areas, const std::vector<double>& values) {
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += areas[i] * values[i];
    area += areas[i];
  }
  return sum / area;
}

/// Eqs. 11 to 14; false on a sphere, whose deviation is zero.
bool weigh_curvature(std::vector<double>& field, const std::vector<double>& areas, double alpha) {
  for (double& k : field) k = -portable::log(std::max(k, flat_curvature));
  const double mean = weighted_mean(areas, field);
  std::vector<double> squares;
  squares.reserve(field.size());
  for (const double value : field) squares.push_back((value - mean) * (value - mean));
  const double deviation = std::sqrt(weighted_mean(areas, squares));
  if (!(deviation > 1e-9)) return false;
  for (double& value : field) {
    const double x = alpha * (value - mean) / (3.0 * std::max(deviation, smallest_deviation));
    const double weight = 4.0 * std::clamp(x, -curvature_clip, curvature_clip);
    const double cell = 1.0 + cell_area_per_weight * weight / (4.0 * pi);
    value = 1.0 / std::max(smallest_cell_share, cell);
  }
  return true;
}

}  // namespace

std::vector<double> curvature_density(const IndexedMesh& surface, double alpha, int node_count,
                                      const Execution& execution) {
  const std::vector<PrincipalCurvatures> curvatures =
      quadric_fit_curvatures(surface, usual_rings, execution);
  const std::vector<double> areas = vertex_areas(surface);
  double area = 0.0;
  for (const double part : areas) area += part;
  std::vector<double> field;
  field.reserve(curvatures.size());
  for (const PrincipalCurvatures& k : curvatures) {
    field.push_back(std::max(k.maximum * k.maximum, k.minimum * k.minimum));
  }
  spread(surface, areas, disc_radius * std::sqrt(area / node_count), field, execution);
  const double radius = std::sqrt(area / (4.0 * pi));
  for (double& square : field) square = std::sqrt(square) * radius;
  if (!weigh_curvature(field, areas, alpha)) return {};
  const double mean = weighted_mean(areas, field);
  for (double& density : field) density /= mean;
  return field;
}

std::vector<double> steepened(std::vector<double> density, const IndexedMesh& surface,
                              double power) {
  if (density.empty()) return density;
  for (double& value : density) value = portable::pow(value, power);
  const double mean = weighted_mean(vertex_areas(surface), density);
  for (double& value : density) value /= mean;
  return density;
}

}  // namespace wscvt
