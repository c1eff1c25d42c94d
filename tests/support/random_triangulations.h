// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"

/// Triangulations of the sphere that no scanner makes: closed, oriented, of genus 0, and otherwise
/// as bad as can be.
namespace wscvt::test {

/// Two poles and a ring of `ring` vertices: two hubs that all faces share.
inline IndexedMesh double_fan(int ring) {
  IndexedMesh mesh;
  mesh.points = {Vector3::UnitZ(), -Vector3::UnitZ()};
  for (int i = 0; i < ring; ++i) {
    const double angle = 2.0 * pi * i / ring;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    const std::int32_t a = 2 + i;
    const std::int32_t b = 2 + (i + 1) % ring;
    mesh.triangles.push_back({a, b, 0});
    mesh.triangles.push_back({b, a, 1});
  }
  return mesh;
}

/// A tetrahedron whose faces are split in three at random, over and over: valences of hundreds, and
/// every third vertex has three neighbours.
inline IndexedMesh apollonian(int vertices, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  IndexedMesh mesh = tetrahedron(2.0);
  while (static_cast<int>(mesh.points.size()) < vertices) {
    const std::size_t f = engine() % mesh.triangles.size();
    const Triangle t = mesh.triangles[f];
    const auto v = static_cast<std::int32_t>(mesh.points.size());
    const Vector3 shift(normal(engine), normal(engine), normal(engine));
    mesh.points.emplace_back((mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0 +
                             0.1 * shift);
    mesh.triangles[f] = {t[0], t[1], v};
    mesh.triangles.push_back({t[1], t[2], v});
    mesh.triangles.push_back({t[2], t[0], v});
  }
  return mesh;
}

/// Edges flipped at random, as long as no edge comes twice.
inline void flip_at_random(IndexedMesh& mesh, int times, std::mt19937_64& engine) {
  std::vector<Triangle>& triangles = mesh.triangles;
  for (int i = 0; i < times; ++i) {
    const std::size_t f = engine() % triangles.size();
    const std::size_t k = engine() % 3;
    const std::int32_t a = triangles[f][k];
    const std::int32_t b = triangles[f][(k + 1) % 3];
    const std::int32_t c = triangles[f][(k + 2) % 3];
    std::size_t other = triangles.size();
    std::int32_t d = -1;
    for (std::size_t g = 0; g < triangles.size(); ++g) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (triangles[g][j] == b && triangles[g][(j + 1) % 3] == a) {
          other = g;
          d = triangles[g][(j + 2) % 3];
        }
      }
    }
    bool joined = c == d;
    for (const Triangle& t : triangles) {
      for (std::size_t j = 0; j < 3; ++j) {
        joined = joined || (t[j] == c && t[(j + 1) % 3] == d) || (t[j] == d && t[(j + 1) % 3] == c);
      }
    }
    if (joined) continue;
    triangles[f] = {c, a, d};
    triangles[other] = {d, b, c};
  }
}

/// One of the kinds above, or a regular sphere with positions that say nothing, drawn by the seed;
/// of about `vertices` vertices.
inline IndexedMesh random_triangulation(int vertices, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const std::uint64_t kind = engine() % 9;
  IndexedMesh mesh;
  if (kind == 0) return apollonian(vertices, engine);
  if (kind == 1) return double_fan(vertices - 2);
  if (kind == 2) {  // hubs beside hubs
    mesh = double_fan(vertices / 2);
    for (int i = 0; i < vertices / 2; ++i) {
      const std::size_t f = engine() % mesh.triangles.size();
      const Triangle t = mesh.triangles[f];
      const auto v = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.emplace_back(0.4 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]));
      mesh.triangles[f] = {t[0], t[1], v};
      mesh.triangles.push_back({t[1], t[2], v});
      mesh.triangles.push_back({t[2], t[0], v});
    }
    flip_at_random(mesh, 20, engine);
    return mesh;
  }
  int level = 1;
  while (10 * (1 << (2 * level)) + 2 < vertices) ++level;
  mesh = sphere(level);
  for (Vector3& p : mesh.points) {
    const Vector3 shift(normal(engine), normal(engine), normal(engine));
    if (kind == 3) p = shift;                             // no order at all
    if (kind == 4) p = Vector3(1, 2, 3) + 1e-13 * p;      // rounding only
    if (kind == 5) p *= engine() % 20 == 0 ? 50.0 : 1.0;  // spikes
    if (kind == 6) p.z() *= 1e-6;                         // a leaf
    if (kind == 7) p = Vector3(p.x(), 0.0, 0.0);          // a line
    if (kind == 8) p = 1e100 * p + 1e99 * shift;          // far out
  }
  if (engine() % 2 == 0) flip_at_random(mesh, 30, engine);
  return mesh;
}

}  // namespace wscvt::test
