// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "property/choices.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt::test {

struct RandomBody {
  IndexedMesh mesh;
  std::string description;
};

inline IndexedMesh random_start(Choices& choices) {
  const int count = choices.whole(4, 300);
  std::vector<Vector3> directions;
  switch (choices.whole(0, 3)) {
    case 0:
      directions = fibonacci_lattice(count);
      break;
    case 1:
      directions = random_directions(count, choices.word());
      break;
    case 2:
      directions = nearest_equal_angle_grid(std::max(count, 6));
      break;
    default:
      directions = nearest_subdivided_icosahedron(std::max(count, 12));
  }
  try {
    std::vector<Triangle> triangles = SphereTriangulation(directions).triangles();
    return {std::move(directions), std::move(triangles)};
  } catch (const Error&) {  // few random directions do not surround the centre
    directions = fibonacci_lattice(std::max(count, 8));
    std::vector<Triangle> triangles = SphereTriangulation(directions).triangles();
    return {std::move(directions), std::move(triangles)};
  }
}

/// One fault of a scan.
inline std::string damage(Choices& choices, IndexedMesh& mesh) {
  const auto vertex = [&] { return static_cast<std::int32_t>(choices.below(mesh.points.size())); };
  const auto face = [&] { return choices.below(mesh.triangles.size()); };
  if (mesh.triangles.empty()) return "no faces";
  switch (choices.whole(0, 13)) {
    case 0:
      mesh.points[vertex()] = Vector3(mesh.points[vertex()]);
      return "two vertices in one place";
    case 1:
      for (int i = choices.whole(1, 10); i > 0; --i) {
        mesh.triangles.push_back(Triangle(mesh.triangles[face()]));
      }
      return "doubled faces";
    case 2:
      for (int i = choices.whole(1, 40); i > 0; --i) {
        Triangle& t = mesh.triangles[face()];
        std::swap(t[0], t[1]);
      }
      return "faces turned over";
    case 3:
      for (int i = choices.whole(1, 6); i > 0 && mesh.triangles.size() > 1; --i) {
        mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(face()));
      }
      return "faces missing";
    case 4:
      mesh.triangles.resize(1 + face());
      return "cut off";
    case 5:
      mesh.triangles.push_back({vertex(), vertex(), vertex()});
      return "a face across";
    case 6: {  // two faces folded flat on an edge
      const Triangle t = mesh.triangles[face()];
      const auto tip = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.emplace_back(1.5 * mesh.points[t[0]]);
      mesh.triangles.push_back({t[0], t[1], tip});
      if (choices.one_in(2)) mesh.triangles.push_back({t[1], t[0], tip});
      return "a flap";
    }
    case 7: {  // a closed tetrahedron on an edge
      const Triangle t = mesh.triangles[face()];
      const auto c = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.emplace_back(1.3 * mesh.points[t[0]]);
      mesh.points.emplace_back(1.3 * mesh.points[t[1]]);
      for (const Triangle& side : {Triangle{t[0], t[1], c}, Triangle{t[1], t[0], c + 1},
                                   Triangle{t[0], c, c + 1}, Triangle{t[1], c + 1, c}}) {
        mesh.triangles.push_back(side);
      }
      return "a tetrahedron on an edge";
    }
    case 8: {
      IndexedMesh inner = scaled(mesh, Vector3::Constant(choices.real(0.05, 0.95)));
      if (choices.one_in(2)) {
        for (Triangle& t : inner.triangles) std::swap(t[0], t[1]);
      }
      mesh = joined(mesh, inner);
      return "nested";
    }
    case 9:
      mesh = joined(mesh, transformed(mesh, choices.real(0.05, 1.2) * Eigen::Matrix3d::Identity(),
                                      Vector3(choices.real(0.0, 4.0), 0, 0)));
      return "a second body";
    case 10:
      mesh = unwelded(mesh);
      if (choices.one_in(2)) {
        for (Vector3& p : mesh.points) p.x() += 1e-14 * choices.real(-1.0, 1.0);
      }
      return "every face with corners of its own";
    case 11: {
      const double values[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), 1e308, 5e-324, 1e160};
      mesh.points[vertex()][choices.whole(0, 2)] = values[choices.whole(0, 4)];
      return "a coordinate that is no number, or a huge one";
    }
    case 12: {  // a vertex on an edge, joined up on one side only
      const Triangle t = mesh.triangles[face()];
      const auto middle = static_cast<std::int32_t>(mesh.points.size());
      mesh.points.emplace_back(0.5 * (mesh.points[t[0]] + mesh.points[t[1]]));
      mesh.triangles.push_back({t[0], middle, t[1]});
      return "a sliver";
    }
    default: {  // two vertices become one: sheets touch in it, or in an edge
      const std::int32_t from = vertex();
      const std::int32_t to = vertex();
      for (Triangle& t : mesh.triangles) {
        for (std::int32_t& v : t) v = v == from ? to : v;
      }
      return "pinched";
    }
  }
}

/// A body of up to some hundred vertices: smooth or rough, round, long or flat, folded or not, with
/// faults or without, anywhere and of any size.
inline RandomBody random_body(Choices& choices) {
  RandomBody body;
  IndexedMesh& mesh = body.mesh;
  mesh = random_start(choices);
  const Vector3 axes(1.0, std::exp(choices.real(-2.5, 2.5)), std::exp(choices.real(-2.5, 2.5)));
  const double roughness = choices.one_in(2) ? 0.0 : choices.real(0.0, 0.9);
  const int bumps = choices.one_in(2) ? choices.whole(1, 12) : 0;
  body.description = std::to_string(mesh.points.size()) +
                     " vertices, axes 1:" + format_number(axes.y(), 3) + ":" +
                     format_number(axes.z(), 3) + ", rough " + format_number(roughness, 3) +
                     ", bumps " + std::to_string(bumps);
  for (Vector3& p : mesh.points) {
    p *= (1.0 + 0.2 * std::sin(bumps * p.x()) * std::cos(bumps * p.y())) *
         (1.0 + roughness * choices.real(-1.0, 1.0));
    p = p.cwiseProduct(axes);
  }
  if (choices.one_in(3)) {  // folds
    for (int i = choices.whole(1, 6); i > 0; --i) {
      mesh.points[choices.below(mesh.points.size())] +=
          choices.real(0.0, 1.0) *
          Vector3(choices.real(-1.0, 1.0), choices.real(-1.0, 1.0), choices.real(-1.0, 1.0));
    }
    body.description += ", folded";
  }
  if (choices.one_in(2)) {
    for (int i = choices.whole(1, 3); i > 0; --i) body.description += ", " + damage(choices, mesh);
  }
  double scale = 1.0;
  Vector3 offset = Vector3::Zero();
  if (choices.one_in(4)) scale = std::pow(10.0, choices.real(-6.0, 6.0));
  if (choices.one_in(20)) scale = std::pow(10.0, choices.real(-80.0, 80.0));
  if (choices.one_in(4)) {
    offset = std::pow(10.0, choices.real(0.0, 9.0)) * scale *
             Vector3(choices.real(-1.0, 1.0), choices.real(-1.0, 1.0), choices.real(-1.0, 1.0));
  }
  for (Vector3& p : mesh.points) p = scale * p + offset;
  body.description +=
      ", scale " + format_number(scale, 3) + ", offset " + format_number(offset.norm(), 3);
  return body;
}

/// A handful of vertices and faces between any of them.
inline IndexedMesh random_soup(Choices& choices) {
  IndexedMesh mesh;
  const int vertices = choices.whole(1, 12);
  const int size = choices.whole(1, 4);
  for (int i = 0; i < vertices; ++i) {
    mesh.points.emplace_back(choices.whole(-size, size), choices.whole(-size, size),
                             choices.whole(-size, size));
  }
  const auto vertex = [&] { return choices.whole(0, vertices - 1); };
  for (int i = choices.whole(0, 40); i > 0; --i) {
    mesh.triangles.push_back({vertex(), vertex(), vertex()});
  }
  return mesh;
}

/// What a check may be given at its worst: a soup, or a body with several faults.
inline RandomBody random_scan(Choices& choices) {
  if (choices.one_in(2)) return {random_soup(choices), "soup"};
  RandomBody body = random_body(choices);
  for (int i = choices.whole(0, 6); i > 0; --i) {
    body.description += ", " + damage(choices, body.mesh);
  }
  return body;
}

}  // namespace wscvt::test
