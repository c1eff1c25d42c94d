// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/node_placement.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

// Along a ray in direction u, the plane of a triangle with corners r_i u_i lies at 1/r = sum of
// (w_i / height) (1/r_i), with the barycentric weights w_i of where the ray meets the flat triangle
// of the u_i, and `height` the distance of that point from the origin. So 1/r is linear in the
// unknowns 1/r_i, and the best radii come from one sparse linear solve; in r itself the problem
// would have to be linearised again and again.

constexpr const char* placement_stage = "Placing the nodes";
/// Each triangle reads tens of radii off the surface, so that a few dozen fill a task.
constexpr std::size_t placement_block = 64;
/// A fit that goes further has no surface to follow: its triangles span a right angle and more, as
/// those of a dozen nodes that hardly surround the origin.
constexpr double largest_radius_change = 1.5;

/// Centroids of the k^2 small triangles that a triangle falls into when its edges are cut in k.
std::vector<Vector3> barycentric_centroids(int k) {
  std::vector<Vector3> points;
  const auto add = [&](double i, double j) {
    points.emplace_back(1.0 - (i + j) / k, i / k, j / k);
  };
  for (int i = 0; i < k; ++i) {
    for (int j = 0; i + j < k; ++j) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j + 1 < k) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  }
  return points;
}

/// The surface in one direction.
struct Sample {
  double inverse_radius = 0.0;
  double height = 0.0;  ///< of the flat triangle of the unit directions
  double weight = 0.0;  ///< turns squares of a difference in 1/r into squares of distances
};

/// Samples of every triangle, in the order of `barycentric`.
std::vector<Sample> read_surface(const std::vector<Vector3>& directions,
                                 const std::vector<Triangle>& triangles,
                                 const std::vector<Vector3>& barycentric,
                                 const RadialSurface& surface, const Execution& execution) {
  const std::size_t count = barycentric.size();
  execution.report(0.0, placement_stage);  // a million nodes' samples take half a gigabyte
  std::vector<Sample> samples(triangles.size() * count);
  execution.report(0.0, placement_stage);
  execution.parallel_for(
      triangles.size(), placement_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Vector3> sample_directions(count);
        std::vector<LocalShape> shapes(count);
        for (std::size_t t = begin; t < end; ++t) {
          const Vector3& a = directions[triangles[t][0]];
          const Vector3& b = directions[triangles[t][1]];
          const Vector3& c = directions[triangles[t][2]];
          const double solid_angle = six_volumes(a, b, c) / (2.0 * static_cast<double>(count));
          Sample* const own = &samples[t * count];
          for (std::size_t q = 0; q < count; ++q) {
            const Vector3& w = barycentric[q];
            const Vector3 foot = w[0] * a + w[1] * b + w[2] * c;
            own[q].height = foot.norm();
            sample_directions[q] = foot / own[q].height;
          }
          surface.evaluate_shapes(sample_directions.data(), count, Derivatives::First,
                                  shapes.data());
          for (std::size_t q = 0; q < count; ++q) {
            const double r = shapes[q].distance;
            own[q].inverse_radius = 1.0 / r;
            // A difference d in 1/r is r^2 d along the ray, and r^2 d cos(tilt) off the surface;
            // its square counts with the surface that the sample stands for, g per solid angle. And
            // g cos^2(tilt) = r^4 / g, since cos(tilt) = r^2 / g.
            own[q].weight =
                solid_angle / std::pow(own[q].height, 3) * std::pow(r, 8) / shapes[q].area_element;
          }
        }
      });
  return samples;
}

/// One triangle's part of the normal equations.
struct LocalSystem {
  Matrix3 matrix = Matrix3::Zero();
  Vector3 right_side = Vector3::Zero();
};

/// With `fit`, the inverse radii at the corners that an earlier solve gave, the squares are those
/// of the difference in r: (r_fit / r)^2 times as large.
LocalSystem local_system(const Sample* samples, const std::vector<Vector3>& barycentric,
                         const Vector3* fit) {
  LocalSystem system;
  for (std::size_t q = 0; q < barycentric.size(); ++q) {
    const Sample& sample = samples[q];
    const Vector3 row = barycentric[q] / sample.height;
    double weight = sample.weight;
    if (fit != nullptr) weight *= std::pow(sample.inverse_radius / row.dot(*fit), 2);
    system.matrix += weight * row * row.transpose();
    system.right_side += weight * sample.inverse_radius * row;
  }
  return system;
}

struct NormalEquations {
  Eigen::SparseMatrix<double> matrix;  ///< its lower half
  Eigen::VectorXd right_side;
};

/// The entries of a column from the diagonal down, by row; `corners` are those of each node, 3 t +
/// k for corner k of triangle t.
void fill_column(std::size_t node, const Groups& corners, const std::vector<Triangle>& triangles,
                 const std::vector<LocalSystem>& systems,
                 std::vector<std::pair<std::int32_t, double>>& column) {
  column.clear();
  for (const std::int32_t* c = corners.begin(node); c != corners.end(node); ++c) {
    const Triangle& rows = triangles[*c / 3];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t row = rows[k];
      if (row < static_cast<std::int32_t>(node)) continue;
      const double value = systems[*c / 3].matrix(k, *c % 3);
      const auto known = std::find_if(column.begin(), column.end(),
                                      [row](const auto& entry) { return entry.first == row; });
      if (known == column.end()) {
        column.emplace_back(row, value);
      } else {
        known->second += value;
      }
    }
  }
  std::sort(column.begin(), column.end());
}

/// Of the inverse radii; `fit` as in local_system, or nullptr.
NormalEquations normal_equations(const std::vector<Triangle>& triangles, Eigen::Index nodes,
                                 const std::vector<Sample>& samples,
                                 const std::vector<Vector3>& barycentric,
                                 const Eigen::VectorXd* fit, const Execution& execution) {
  execution.report(0.0, placement_stage);  // a million nodes' take a quarter of a gigabyte
  std::vector<LocalSystem> systems(triangles.size());
  execution.parallel_for(
      triangles.size(), placement_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
          const Triangle& corner = triangles[t];
          Vector3 at_corners = Vector3::Zero();
          if (fit != nullptr)
            at_corners = {(*fit)[corner[0]], (*fit)[corner[1]], (*fit)[corner[2]]};
          systems[t] = local_system(&samples[t * barycentric.size()], barycentric,
                                    fit != nullptr ? &at_corners : nullptr);
        }
      });
  // Column by column, and in each the triangles in their order: the sums' bits do not depend on
  // threads. Eigen's setFromTriplets adds them up in the same order, but takes twelve million
  // triplets at a million nodes, and half a second that nothing can stop.
  const Groups corners = counting_sort(3 * triangles.size(), static_cast<std::size_t>(nodes),
                                       [&](std::size_t c, const auto& visit) {
                                         visit(static_cast<std::size_t>(triangles[c / 3][c % 3]));
                                       });
  NormalEquations equations;
  equations.right_side = Eigen::VectorXd::Zero(nodes);
  equations.matrix.resize(nodes, nodes);
  int* const starts = equations.matrix.outerIndexPtr();
  const auto for_each_column = [&](const auto& take) {
    execution.parallel_for(static_cast<std::size_t>(nodes), placement_block,
                           [&](std::size_t begin, std::size_t end) {
                             std::vector<std::pair<std::int32_t, double>> column;
                             for (std::size_t v = begin; v < end; ++v) {
                               fill_column(v, corners, triangles, systems, column);
                               take(v, column);
                             }
                           });
  };
  // Twice, since a column begins where those before it end.
  for_each_column([&](std::size_t v, const auto& column) {
    starts[v + 1] = static_cast<int>(column.size());
    for (const std::int32_t* c = corners.begin(v); c != corners.end(v); ++c) {
      equations.right_side[static_cast<Eigen::Index>(v)] += systems[*c / 3].right_side[*c % 3];
    }
  });
  std::partial_sum(starts, starts + nodes + 1, starts);
  equations.matrix.resizeNonZeros(starts[nodes]);
  for_each_column([&](std::size_t v, const auto& column) {
    int k = starts[v];
    for (const auto& [row, value] : column) {
      equations.matrix.innerIndexPtr()[k] = row;
      equations.matrix.valuePtr()[k++] = value;
    }
  });
  return equations;
}

/// Reports each time it is asked: once a step. At a million nodes all of them take a second.
class ReportingPreconditioner : public Eigen::DiagonalPreconditioner<double> {
 public:
  void report_to(const Execution& execution) { execution_ = &execution; }

  template <class Residual>
  auto solve(const Eigen::MatrixBase<Residual>& residual) const {
    execution_->report(0.0, placement_stage);
    return Eigen::DiagonalPreconditioner<double>::solve(residual);
  }

 private:
  const Execution* execution_ = nullptr;
};

/// A weighted mass matrix, whose condition does not grow with its size once the diagonal is scaled
/// out: conjugate gradients take some 25 steps, where a factorisation would fill in.
Eigen::VectorXd solve(const NormalEquations& equations, const Eigen::VectorXd& guess,
                      const Execution& execution) {
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower, ReportingPreconditioner>
      solver;
  solver.preconditioner().report_to(execution);
  solver.setTolerance(1e-14);  // to rounding: what is left would show in the bytes of the mesh
  solver.setMaxIterations(1000);
  solver.compute(equations.matrix);
  Eigen::VectorXd solution = solver.solveWithGuess(equations.right_side, guess);
  if (solver.info() != Eigen::Success || !solution.allFinite()) {
    throw Error(ErrorCode::NumericalFailure,
                "The radii of the nodes cannot be fitted: the least-squares system does not "
                "converge. Put the nodes on the surface instead.");
  }
  return solution;
}

}  // namespace

std::vector<double> least_squares_radii(const std::vector<Vector3>& directions,
                                        const std::vector<Triangle>& triangles,
                                        const RadialSurface& surface, std::size_t samples,
                                        const Execution& execution) {
  std::vector<char> used(directions.size(), 0);
  for (const Triangle& corner : triangles) {
    for (const std::int32_t v : corner) used[v] = 1;
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    throw Error(ErrorCode::InvalidInput,
                "Node " + std::to_string(unused - used.begin()) +
                    " belongs to no triangle, so no radius can be fitted for it.");
  }
  const std::size_t faces = std::max<std::size_t>(triangles.size(), 1);
  // Nine samples at least for the three unknowns of a triangle; beyond a thousand they would only
  // repeat what the surface's own resolution holds.
  const double wanted = std::sqrt(static_cast<double>(samples) / static_cast<double>(faces));
  const std::vector<Vector3> barycentric =
      barycentric_centroids(std::clamp(static_cast<int>(std::ceil(wanted)), 3, 32));
  const std::vector<Sample> readings =
      read_surface(directions, triangles, barycentric, surface, execution);

  std::vector<double> radii = surface.radii(directions, execution);
  const auto count = static_cast<Eigen::Index>(directions.size());
  const Eigen::VectorXd own = Eigen::Map<const Eigen::VectorXd>(radii.data(), count).cwiseInverse();
  const auto fitted = [&](const Eigen::VectorXd& guess, const Eigen::VectorXd* fit) {
    const Eigen::VectorXd inverse_radii =
        solve(normal_equations(triangles, count, readings, barycentric, fit, execution), guess,
              execution);
    return Eigen::VectorXd(
        inverse_radii.cwiseMax(own / largest_radius_change).cwiseMin(own * largest_radius_change));
  };
  const Eigen::VectorXd first = fitted(own, nullptr);
  // The first solve weighs differences in 1/r as if the fit were at the surface, which counts those
  // of nodes far outside too little; the second weighs by where the first put them. A third changes
  // no error by more than a fiftieth of it.
  const Eigen::VectorXd second = fitted(first, &first);
  Eigen::Map<Eigen::VectorXd>(radii.data(), count) = second.cwiseInverse();
  return radii;
}

void scale_to_volume(const std::vector<Triangle>& triangles, double volume,
                     std::vector<Vector3>& points, const Execution& execution) {
  const double enclosed = mesh_sums(points, triangles, Vector3::Zero(), execution).volume();
  if (!(enclosed > 0.0) || !(volume > 0.0)) {
    throw Error(ErrorCode::NumericalFailure,
                "The volume cannot be made equal: a volume is not positive. Put the nodes on the "
                "surface instead.");
  }
  const double factor = std::cbrt(volume / enclosed);
  for (Vector3& p : points) p *= factor;
}

}  // namespace wscvt
