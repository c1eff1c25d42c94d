// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "wscvt/base/mesh.h"
#include "wscvt/base/numbers.h"

/// Meshes with known measures, and ways to move them, for the tests.
namespace wscvt::test {

using wscvt::pi;

/// Unit icosahedron.
inline IndexedMesh icosahedron() {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  IndexedMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vector3& p : mesh.points) p.normalize();
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

/// Every triangle cut into four at the middles of its edges, `times` times.
inline IndexedMesh subdivided(IndexedMesh mesh, int times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto next = static_cast<std::int32_t>(mesh.points.size());
      const auto [place, added] = middles.try_emplace(std::minmax(a, b), next);
      if (added) mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const std::int32_t ab = middle(t[0], t[1]);
      const std::int32_t bc = middle(t[1], t[2]);
      const std::int32_t ca = middle(t[2], t[0]);
      finer.push_back({t[0], ab, ca});
      finer.push_back({t[1], bc, ab});
      finer.push_back({t[2], ca, bc});
      finer.push_back({ab, bc, ca});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// The smallest distance between two of some points.
inline double smallest_distance(const std::vector<Vector3>& points) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      smallest = std::min(smallest, (points[i] - points[j]).norm());
    }
  }
  return smallest;
}

/// Unit sphere of 20 * 4^times faces with vertices on the sphere.
inline IndexedMesh sphere(int times) {
  IndexedMesh mesh = icosahedron();
  for (; times > 0; --times) {
    mesh = subdivided(std::move(mesh), 1);
    for (Vector3& p : mesh.points) p.normalize();
  }
  return mesh;
}

/// Box of the given edge lengths about the origin, twelve faces.
inline IndexedMesh box(double x, double y, double z) {
  IndexedMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.emplace_back((i & 1 ? 0.5 : -0.5) * x, (i & 2 ? 0.5 : -0.5) * y,
                             (i & 4 ? 0.5 : -0.5) * z);
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Regular tetrahedron of edge `edge` about the origin.
inline IndexedMesh tetrahedron(double edge) {
  IndexedMesh mesh;
  const double s = edge / std::sqrt(8.0);
  mesh.points = {{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return mesh;
}

/// x -> linear x + shift.
inline IndexedMesh transformed(IndexedMesh mesh, const Eigen::Matrix3d& linear,
                               const Vector3& shift = Vector3::Zero()) {
  for (Vector3& p : mesh.points) p = linear * p + shift;
  return mesh;
}

inline IndexedMesh scaled(IndexedMesh mesh, const Vector3& factors) {
  return transformed(std::move(mesh), factors.asDiagonal().toDenseMatrix());
}

/// x -> scale x + shift.
inline IndexedMesh moved(IndexedMesh mesh, double scale, const Vector3& shift) {
  return transformed(std::move(mesh), scale * Eigen::Matrix3d::Identity(), shift);
}

/// Uniformly random rotation.
inline Eigen::Matrix3d random_rotation(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q(normal(engine), normal(engine), normal(engine), normal(engine));
  return q.normalized().toRotationMatrix();
}

/// A lumpy star-shaped body: the sphere with its radius multiplied by a smooth function.
inline IndexedMesh lumpy(int times) {
  IndexedMesh mesh = sphere(times);
  for (Vector3& p : mesh.points) {
    p *= 1.0 + 0.2 * std::sin(3.0 * p.x() + 1.0) * std::cos(2.0 * p.y()) + 0.15 * p.z() * p.x();
  }
  return mesh;
}

/// The same surface with vertices and faces in another order and faces started at another corner.
inline IndexedMesh shuffled(const IndexedMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<std::int32_t> place(mesh.points.size());
  for (std::size_t i = 0; i < place.size(); ++i) place[i] = static_cast<std::int32_t>(i);
  std::shuffle(place.begin(), place.end(), engine);
  IndexedMesh result;
  result.points.resize(mesh.points.size());
  for (std::size_t i = 0; i < place.size(); ++i) result.points[place[i]] = mesh.points[i];
  for (const Triangle& t : mesh.triangles) {
    Triangle moved = {place[t[0]], place[t[1]], place[t[2]]};
    std::rotate(moved.begin(), moved.begin() + static_cast<std::ptrdiff_t>(engine() % 3),
                moved.end());
    result.triangles.push_back(moved);
  }
  std::shuffle(result.triangles.begin(), result.triangles.end(), engine);
  return result;
}

/// Torus about the z axis, 2 segments^2 faces.
inline IndexedMesh torus(double major_radius, double minor_radius, int segments) {
  IndexedMesh mesh;
  const double step = 2.0 * pi / segments;
  for (int i = 0; i < segments; ++i) {
    for (int j = 0; j < segments; ++j) {
      const double ring = major_radius + minor_radius * std::cos(step * j);
      mesh.points.emplace_back(ring * std::cos(step * i), ring * std::sin(step * i),
                               minor_radius * std::sin(step * j));
      const int a = i * segments + j;
      const int b = (i + 1) % segments * segments + j;
      const int c = (i + 1) % segments * segments + (j + 1) % segments;
      const int d = i * segments + (j + 1) % segments;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// Two cones on one rim, apex to apex along z: `segments` needles to each apex.
inline IndexedMesh bicone(int segments) {
  IndexedMesh mesh;
  mesh.points = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < segments; ++i) {
    const double angle = 2.0 * pi * i / segments;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    const int a = 2 + i;
    const int b = 2 + (i + 1) % segments;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

/// Points and faces of both, side by side.
inline IndexedMesh joined(const IndexedMesh& a, const IndexedMesh& b) {
  IndexedMesh result = a;
  result.points.insert(result.points.end(), b.points.begin(), b.points.end());
  const auto first = static_cast<std::int32_t>(a.points.size());
  for (const Triangle& t : b.triangles) {
    result.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return result;
}

/// Every face with corners of its own, as in an STL file.
inline IndexedMesh unwelded(const IndexedMesh& mesh) {
  IndexedMesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(result.points.size());
    for (const std::int32_t v : t) result.points.emplace_back(mesh.points[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

/// Number of edges not shared by exactly two faces that run along it in opposite ways: 0 for a
/// closed, consistently oriented surface.
inline std::size_t bad_edges(const IndexedMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<int, int>> uses;  // forward, backward
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = t[k];
      const std::int32_t b = t[(k + 1) % 3];
      auto& use = uses[std::minmax(a, b)];
      ++(a < b ? use.first : use.second);
    }
  }
  return static_cast<std::size_t>(std::count_if(uses.begin(), uses.end(), [](const auto& entry) {
    return entry.second != std::make_pair(1, 1);
  }));
}

/// A body of revolution about z and symmetric in z: a ball of radius 0.7 with a rim of radius 1
/// about its equator that overhangs it. Between 60 and 60 + `overhang` degrees from either pole a
/// ray from the centre leaves the ball, enters the rim and leaves it.
inline IndexedMesh overhanging_rim(int overhang) {
  constexpr int segments = 128;
  struct Ring {
    double radius;
    double polar_degrees;
  };
  std::vector<Ring> rings;
  for (int degrees = 5; degrees <= 60; degrees += 5) rings.push_back({0.7, double(degrees)});
  rings.push_back({0.7, 60.0 + overhang});
  for (int degrees = 60; degrees <= 120; degrees += 5) rings.push_back({1.0, double(degrees)});
  rings.push_back({0.7, 120.0 - overhang});
  for (int degrees = 120; degrees <= 175; degrees += 5) rings.push_back({0.7, double(degrees)});
  IndexedMesh mesh;
  mesh.points = {{0, 0, 0.7}, {0, 0, -0.7}};
  const auto at = [&](std::size_t ring, int segment) {
    return static_cast<std::int32_t>(2 + ring * segments +
                                     static_cast<std::size_t>((segment + segments) % segments));
  };
  for (const Ring& ring : rings) {
    const double theta = ring.polar_degrees * pi / 180.0;
    for (int k = 0; k < segments; ++k) {
      const double phi = 2.0 * pi * k / segments;
      mesh.points.emplace_back(ring.radius * std::sin(theta) * std::cos(phi),
                               ring.radius * std::sin(theta) * std::sin(phi),
                               ring.radius * std::cos(theta));
    }
  }
  for (int k = 0; k < segments; ++k) {
    mesh.triangles.push_back({0, at(0, k), at(0, k + 1)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      mesh.triangles.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      mesh.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
    mesh.triangles.push_back({1, at(rings.size() - 1, k + 1), at(rings.size() - 1, k)});
  }
  return mesh;
}

}  // namespace wscvt::test
