// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/node_placement.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/error.h"

namespace wscvt {

namespace {

constexpr std::size_t block_size = 64;
constexpr double largest_radius_change = 4.0;

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

/// One triangle's part of the normal equations.
struct LocalSystem {
  Matrix3 matrix = Matrix3::Zero();
  Vector3 right_side = Vector3::Zero();
};

LocalSystem local_system(const Vector3& a, const Vector3& b, const Vector3& c,
                         const std::vector<Vector3>& barycentric, const RadialSurface& surface,
                         std::vector<Vector3>& directions, std::vector<RadialJet>& jets) {
  const double solid_angle = a.dot(b.cross(c)) / (2.0 * static_cast<double>(barycentric.size()));
  directions.resize(barycentric.size());
  jets.resize(barycentric.size());
  for (std::size_t q = 0; q < barycentric.size(); ++q) {
    const Vector3& w = barycentric[q];
    directions[q] = (w[0] * a + w[1] * b + w[2] * c).normalized();
  }
  surface.evaluate(directions.data(), directions.size(), Derivatives::First, jets.data());
  LocalSystem system;
  for (std::size_t q = 0; q < barycentric.size(); ++q) {
    const Vector3& w = barycentric[q];
    const double height = (w[0] * a + w[1] * b + w[2] * c).norm();
    const Vector3 row = w / height;
    const double r = jets[q].radius;
    // g cos^2(tilt) = r^4 / g, since cos(tilt) = r^2 / g.
    const double weight =
        solid_angle / (height * height * height) * std::pow(r, 8) / area_element(jets[q]);
    system.matrix += weight * row * row.transpose();
    system.right_side += weight / r * row;
  }
  return system;
}

/// Solves the normal equations, of which `matrix` holds the lower half. They are a weighted mass
/// matrix, whose condition does not grow with its size once the diagonal is scaled out: conjugate
/// gradients take some 25 steps, where a factorisation would fill in.
Eigen::VectorXd solve(const Eigen::SparseMatrix<double>& matrix,
                      const Eigen::VectorXd& right_side) {
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower> solver;
  solver.setTolerance(1e-14);
  solver.compute(matrix);
  const Eigen::VectorXd solution = solver.solve(right_side);
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
  const std::size_t faces = std::max<std::size_t>(triangles.size(), 1);
  const double wanted = std::sqrt(static_cast<double>(samples) / static_cast<double>(faces));
  const std::vector<Vector3> barycentric =
      barycentric_centroids(std::clamp(static_cast<int>(std::ceil(wanted)), 3, 32));

  std::vector<LocalSystem> systems(triangles.size());
  execution.parallel_for(triangles.size(), block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector3> sample_directions;
    std::vector<RadialJet> jets;
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& corner = triangles[t];
      systems[t] = local_system(directions[corner[0]], directions[corner[1]], directions[corner[2]],
                                barycentric, surface, sample_directions, jets);
    }
  });

  const auto count = static_cast<Eigen::Index>(directions.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(6 * triangles.size());
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(count);
  std::vector<char> used(directions.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corner = triangles[t];
    for (int i = 0; i < 3; ++i) {
      used[corner[i]] = 1;
      right_side[corner[i]] += systems[t].right_side[i];
      for (int j = 0; j < 3; ++j) {
        if (corner[i] >= corner[j]) {
          entries.emplace_back(corner[i], corner[j], systems[t].matrix(i, j));
        }
      }
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    throw Error(ErrorCode::InvalidInput,
                "Node " + std::to_string(unused - used.begin()) +
                    " belongs to no triangle, so no radius can be fitted for it.");
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd inverse_radii = solve(matrix, right_side);
  std::vector<double> radii = surface.radii(directions, execution);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double inverse = 1.0 / radii[i];
    radii[i] = 1.0 / std::clamp(inverse_radii[static_cast<Eigen::Index>(i)],
                                inverse / largest_radius_change, inverse * largest_radius_change);
  }
  return radii;
}

void scale_to_volume(const std::vector<Triangle>& triangles, double volume,
                     std::vector<Vector3>& points, const Execution& execution) {
  constexpr std::size_t block = 8192;
  const double enclosed =
      execution.parallel_sum(triangles.size(), block, 0.0, [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t t = begin; t < end; ++t) {
          const Triangle& corner = triangles[t];
          sum += points[corner[0]].dot(points[corner[1]].cross(points[corner[2]]));
        }
        return sum / 6.0;
      });
  if (!(enclosed > 0.0) || !(volume > 0.0)) {
    throw Error(ErrorCode::NumericalFailure,
                "The volume cannot be made equal: a volume is not positive. Put the nodes on the "
                "surface instead.");
  }
  const double factor = std::cbrt(volume / enclosed);
  for (Vector3& p : points) p *= factor;
}

}  // namespace wscvt
