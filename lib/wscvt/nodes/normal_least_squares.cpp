// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/normal_least_squares.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/node_placement.h"
#include "wscvt/nodes/self_intersections.h"
#include "wscvt/nodes/step_guard.h"

namespace wscvt {

namespace {

constexpr std::size_t sample_block = 256;

/// Of the samples a node has on the average, each worth one: holds nodes that no sample reaches,
/// and changes the others' steps by less than a thousandth.
constexpr double tie = 5e-4;

Vector3 face_normal(const std::vector<Vector3>& points, const Triangle& t) {
  return doubled_area_normal(points[t[0]], points[t[1]], points[t[2]]);
}

/// The triangle of the nodes that a sample belongs to, and the row it gives.
struct Row {
  Triangle corners{};
  Vector3 entries = Vector3::Zero();  ///< of the corners' unknowns
  double residual = 0.0;
};

/// Finds the triangle nearest to a sample, from a start downhill over the neighbours.
class NearestTriangle {
 public:
  NearestTriangle(const IndexedMesh& nodes, const HalfEdges& half_edges)
      : nodes_(nodes), half_edges_(half_edges) {}

  std::int32_t find(const Vector3& point, std::int32_t start, Vector3& weights) const {
    std::int32_t best = start;
    double smallest = distance(point, start, weights);
    while (true) {
      std::int32_t next = -1;
      for (const std::int32_t v : nodes_.triangles[best]) {
        visit_outgoing(half_edges_.opposite, half_edges_.first[v], [&](std::int32_t h) {
          Vector3 other;
          const double d = distance(point, h / 3, other);
          if (d < smallest) {
            smallest = d;
            next = h / 3;
            weights = other;
          }
        });
      }
      if (next < 0) return best;
      best = next;
    }
  }

 private:
  double distance(const Vector3& point, std::int32_t triangle, Vector3& weights) const {
    const auto& [i, j, k] = nodes_.triangles[triangle];
    const Vector3 &a = nodes_.points[i], &b = nodes_.points[j], &c = nodes_.points[k];
    weights = nearest_weights(a, b, c, point);
    return (weights[0] * a + weights[1] * b + weights[2] * c - point).squaredNorm();
  }

  const IndexedMesh& nodes_;
  const HalfEdges& half_edges_;
};

std::vector<Row> rows_of(const std::vector<FitSample>& samples, const IndexedMesh& nodes,
                         const std::vector<Vector3>& normals, const HalfEdges& half_edges,
                         const Execution& execution) {
  const NearestTriangle nearest(nodes, half_edges);
  std::vector<Row> rows(samples.size());
  execution.parallel_for(samples.size(), sample_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      Vector3 weights;
      const std::int32_t triangle = nearest.find(samples[s].point, samples[s].triangle, weights);
      Row& row = rows[s];
      row.corners = nodes.triangles[triangle];
      const Vector3 normal = face_normal(nodes.points, row.corners).normalized();
      Vector3 foot = Vector3::Zero();
      for (int k = 0; k < 3; ++k) {
        foot += weights[k] * nodes.points[row.corners[k]];
        row.entries[k] = weights[k] * normal.dot(normals[row.corners[k]]);
      }
      row.residual = normal.dot(samples[s].point - foot);
    }
  });
  return rows;
}

Eigen::VectorXd solve_steps(const std::vector<Row>& rows, std::size_t nodes) {
  const auto size = static_cast<Eigen::Index>(nodes);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(6 * rows.size() + nodes);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (const Row& row : rows) {
    for (int i = 0; i < 3; ++i) {
      right[row.corners[i]] += row.entries[i] * row.residual;
      for (int j = 0; j < 3; ++j) {
        if (row.corners[i] < row.corners[j]) continue;
        entries.emplace_back(row.corners[i], row.corners[j], row.entries[i] * row.entries[j]);
      }
    }
  }
  const double weight = tie * static_cast<double>(rows.size()) / static_cast<double>(nodes);
  for (Eigen::Index i = 0; i < size; ++i) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), weight);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower> solver;
  solver.setTolerance(1e-12);
  solver.setMaxIterations(5000);
  solver.compute(matrix);
  Eigen::VectorXd steps = solver.solve(right);
  if (solver.info() != Eigen::Success || !steps.allFinite()) {
    throw Error(ErrorCode::NumericalFailure,
                "The nodes cannot be fitted along their normals: the least-squares system does "
                "not converge. Put the nodes on the surface instead.");
  }
  return steps;
}

/// V(s) - volume as a polynomial in the offset s.
struct Cubic {
  std::array<double, 4> coefficients{};
  double at(double s) const {
    return ((coefficients[3] * s + coefficients[2]) * s + coefficients[1]) * s + coefficients[0];
  }
  double slope(double s) const {
    return (3.0 * coefficients[3] * s + 2.0 * coefficients[2]) * s + coefficients[1];
  }
};

Cubic volume_polynomial(const std::vector<Vector3>& points, const std::vector<Vector3>& normals,
                        const std::vector<Triangle>& triangles, const Vector3& origin,
                        double volume) {
  Cubic result;
  for (const Triangle& t : triangles) {
    const Vector3 a = points[t[0]] - origin;
    const Vector3 b = points[t[1]] - origin;
    const Vector3 c = points[t[2]] - origin;
    const Vector3 &l = normals[t[0]], &m = normals[t[1]], &n = normals[t[2]];
    result.coefficients[0] += six_volumes(a, b, c) / 6.0;
    result.coefficients[1] +=
        (six_volumes(l, b, c) + six_volumes(m, c, a) + six_volumes(n, a, b)) / 6.0;
    result.coefficients[2] +=
        (six_volumes(a, m, n) + six_volumes(b, n, l) + six_volumes(c, l, m)) / 6.0;
    result.coefficients[3] += six_volumes(l, m, n) / 6.0;
  }
  result.coefficients[0] -= volume;
  return result;
}

/// The root next to zero, or not a number when Newton's method leaves [-limit, limit].
double offset_for(const Cubic& polynomial, double limit) {
  double s = 0.0;
  for (int k = 0; k < 60; ++k) {
    const double slope = polynomial.slope(s);
    const double next = s - polynomial.at(s) / slope;
    if (!(slope > 0.0) || !(std::abs(next) <= limit)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    if (next == s || std::abs(next - s) < 1e-16 * limit) return next;
    s = next;
  }
  return s;
}

void scale_about_mean(const std::vector<Triangle>& triangles, double volume,
                      std::vector<Vector3>& points, const Execution& execution) {
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) mean += p / static_cast<double>(points.size());
  for (Vector3& p : points) p -= mean;
  scale_to_volume(triangles, volume, points, execution);
  for (Vector3& p : points) p += mean;
}

double mean_edge(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles) {
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) sum += (points[t[(k + 1) % 3]] - points[t[k]]).norm();
  }
  return sum / (3.0 * static_cast<double>(triangles.size()));
}

}  // namespace

void check_normal_fit_options(const NormalFitOptions& options) {
  require_in_range(options.samples, fit_samples_option);
  require_in_range(options.smallest_angle, fit_angle_option);
  require_in_range(options.largest_turn, fit_turn_option);
}

std::vector<MappedSample> mapped_samples(const MappedSurface& surface, const MeshDistance* to_scan,
                                         std::size_t count, const Execution& execution) {
  const std::vector<MeshPlace> places = area_uniform_places(surface.mesh(), count);
  std::vector<MappedSample> samples(places.size());
  execution.parallel_for(places.size(), sample_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3 point = surface.position(places[i]);
      samples[i] = {to_scan == nullptr ? point : to_scan->nearest_point(point),
                    surface.direction(places[i]), places[i].triangle};
    }
  });
  return samples;
}

std::vector<FitSample> deal_out(const std::vector<MappedSample>& samples,
                                const std::vector<Vector3>& positions,
                                const std::vector<Vector3>& seeds,
                                const std::vector<Triangle>& triangles,
                                const Execution& execution) {
  const MappedSurface nodes({positions, triangles}, seeds, execution);
  std::vector<FitSample> result(samples.size());
  execution.parallel_for(samples.size(), sample_block, [&](std::size_t begin, std::size_t end) {
    std::int32_t hint = -1;
    for (std::size_t s = begin; s < end; ++s) {
      hint = nodes.locate(samples[s].direction, hint).triangle;
      result[s] = {samples[s].point, hint};
    }
  });
  return result;
}

std::vector<FitSample> deal_on(const std::vector<FitSample>& samples,
                               const std::vector<Triangle>& before, const IndexedMesh& after,
                               const std::vector<std::int32_t>& relocated) {
  const HalfEdges half_edges = link_half_edges(after.triangles, after.points.size());
  std::vector<FitSample> result;
  result.reserve(samples.size());
  for (const FitSample& sample : samples) {
    double smallest = std::numeric_limits<double>::infinity();
    std::int32_t triangle = -1;
    for (const std::int32_t v : before[sample.triangle]) {
      if (std::binary_search(relocated.begin(), relocated.end(), v)) continue;
      const double distance = (after.points[v] - sample.point).squaredNorm();
      if (!(distance < smallest)) continue;
      smallest = distance;
      triangle = half_edges.first[v] / 3;
    }
    if (triangle >= 0) result.push_back({sample.point, triangle});
  }
  return result;
}

double offset_to_volume(const std::vector<Vector3>& normals, const std::vector<Triangle>& triangles,
                        double volume, std::vector<Vector3>& positions,
                        const Execution& execution) {
  const Cubic polynomial =
      volume_polynomial(positions, normals, triangles, positions.front(), volume);
  const double offset = offset_for(polynomial, 0.5 * mean_edge(positions, triangles));
  if (!std::isfinite(offset)) {
    scale_about_mean(triangles, volume, positions, execution);
    return 0.0;
  }
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += offset * normals[i];
  return offset;
}

NormalFit fit_along_normals(const IndexedMesh& nodes, const std::vector<FitSample>& samples,
                            double volume, const NormalFitOptions& options,
                            const Execution& execution) {
  check_normal_fit_options(options);
  const std::vector<Vector3>& positions = nodes.points;
  const std::vector<Triangle>& triangles = nodes.triangles;
  const std::size_t count = positions.size();
  const HalfEdges half_edges = link_half_edges(triangles, count);
  const std::vector<Vector3> normals = vertex_normals(positions, triangles);
  const Eigen::VectorXd steps =
      solve_steps(rows_of(samples, nodes, normals, half_edges, execution), count);

  NormalFit fit;
  fit.report.samples = samples.size();
  std::vector<Vector3> along(count);
  for (std::size_t i = 0; i < count; ++i) {
    along[i] = steps[static_cast<Eigen::Index>(i)] * normals[i];
  }
  GuardedSteps guarded(nodes, half_edges, std::move(along),
                       {options.smallest_angle, options.largest_turn}, execution);
  std::optional<std::size_t> crossings_before;  // counted when some are found, which is rare
  std::vector<Vector3> offset_normals = normals;
  while (true) {
    fit.positions = guarded.positions();
    fit.report.offset =
        offset_to_volume(offset_normals, triangles, volume, fit.positions, execution);
    const auto crossings = self_intersections({fit.positions, triangles}, execution);
    if (crossings.empty()) break;
    if (!crossings_before) crossings_before = self_intersections(nodes, execution).size();
    if (crossings.size() <= *crossings_before) break;
    bool held = false;
    for (const std::int32_t v : vertices_of(crossings, triangles)) {
      if (guarded.hold_back(v)) {
        held = true;
      } else if (!offset_normals[v].isZero()) {
        // At the rim of a body as thin as paper the offset alone makes triangles meet.
        offset_normals[v].setZero();
        held = true;
      }
    }
    if (!held) break;
  }
  fit.report.held_back = guarded.held_back();
  return fit;
}

}  // namespace wscvt
