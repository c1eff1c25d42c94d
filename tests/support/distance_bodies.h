// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "grains/marching_cubes.h"
#include "support/test_shapes.h"

/// Bodies given by a distance function, and meshes of them as a scanner makes them: marching cubes
/// on a grid, with the vertices on the body.
namespace wscvt::test {

/// Below 0 inside; near the surface about the distance from it. Length.
using DistanceFunction = std::function<double(const Vector3&)>;

/// A box of the given half edges, whose edges and corners are rounded with radius `rounding`.
inline DistanceFunction rounded_box(const Vector3& half, double rounding) {
  return [half, rounding](const Vector3& p) {
    const Vector3 q = p.cwiseAbs() - (half - Vector3::Constant(rounding));
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - rounding;
  };
}

/// A cylinder along x with half balls on its ends: points within `radius` of a segment of length
/// 2 `half_length`.
inline DistanceFunction capsule(double half_length, double radius) {
  return [half_length, radius](const Vector3& p) {
    const Vector3 q = p - Vector3(std::clamp(p.x(), -half_length, half_length), 0.0, 0.0);
    return q.norm() - radius;
  };
}

/// A cylinder along z of half height `half_height` and radius `radius`, whose rims are rounded.
inline DistanceFunction rounded_cylinder(double half_height, double radius, double rounding) {
  return [=](const Vector3& p) {
    const double across = std::hypot(p.x(), p.y()) - (radius - rounding);
    const double along = std::abs(p.z()) - (half_height - rounding);
    return std::min(std::max(across, along), 0.0) +
           std::hypot(std::max(across, 0.0), std::max(along, 0.0)) - rounding;
  };
}

/// An ellipsoid; not a distance, but 0 on it and steep there as one.
inline DistanceFunction ellipsoid(const Vector3& half_axes) {
  return [half_axes](const Vector3& p) {
    const double level = p.cwiseQuotient(half_axes).norm();
    const double slope = p.cwiseQuotient(half_axes.cwiseAbs2()).norm();
    return slope > 1e-9 ? level * (level - 1.0) / slope : -half_axes.minCoeff();
  };
}

/// A bar bent to a C, of thickness 1: no ray from its centroid sees it whole.
inline DistanceFunction c_shape(double rounding) {
  const DistanceFunction back = rounded_box({0.5, 1.5, 0.5}, rounding);
  const DistanceFunction arm = rounded_box({1.25, 0.5, 0.5}, rounding);
  return [=](const Vector3& p) {
    return std::min({back(p - Vector3(-1.0, 0.0, 0.0)), arm(p - Vector3(0.25, 1.0, 0.0)),
                     arm(p - Vector3(0.25, -1.0, 0.0))});
  };
}

/// The body with its surface moved outward by `height` (less than 0: inward) at each point.
inline DistanceFunction with_heights(DistanceFunction body,
                                     std::function<double(const Vector3&)> height) {
  return [body = std::move(body), height = std::move(height)](const Vector3& p) {
    return body(p) - height(p);
  };
}

/// The body turned: a point x of it comes to turn * x.
inline DistanceFunction turned(DistanceFunction body, const Eigen::Matrix3d& turn) {
  return [body = std::move(body), turn](const Vector3& p) { return body(turn.transpose() * p); };
}

/// A closed mesh of the body, which must lie within `reach` of the origin: marching cubes on a grid
/// of the given spacing, each vertex then moved along the gradient on to the body. Edges are about
/// as long as the spacing.
inline IndexedMesh scan_of(const DistanceFunction& body, double reach, double spacing) {
  VoxelGrid grid;
  const int nodes = 2 * static_cast<int>(std::ceil(reach / spacing)) + 4;
  grid.size = {nodes, nodes, nodes};
  grid.spacing = spacing;
  // Not about the origin, so that no symmetric body lies on the grid's planes.
  grid.origin = Vector3::Constant(-0.5 * nodes * spacing) + spacing * Vector3(0.63, 0.79, 0.57);
  grid.values.resize(static_cast<std::size_t>(nodes) * nodes * nodes);
  for (int z = 0; z < nodes; ++z) {
    for (int y = 0; y < nodes; ++y) {
      for (int x = 0; x < nodes; ++x) {
        grid.values[grid.index(x, y, z)] = -body(grid.origin + spacing * Vector3(x, y, z));
      }
    }
  }
  IndexedMesh mesh = marching_cubes(grid, 0.0);
  const double step = 1e-5 * spacing;
  for (Vector3& p : mesh.points) {
    for (int pass = 0; pass < 3; ++pass) {
      Vector3 gradient;
      for (int k = 0; k < 3; ++k) {
        gradient[k] =
            (body(p + step * Vector3::Unit(k)) - body(p - step * Vector3::Unit(k))) / (2.0 * step);
      }
      p -= body(p) / std::max(gradient.squaredNorm(), 1e-9) * gradient;
    }
  }
  return mesh;
}

}  // namespace wscvt::test
