// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/seeds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(Enclosure, TellsInsideFromOutside) {
  std::mt19937_64 engine(test::announced(3));
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::vector<Vector3> points;
  std::vector<char> expected;
  while (points.size() < 2000) {
    Vector3 p(place(engine), place(engine), place(engine));
    // Every third above a vertex or an edge of the box, seen along the axis.
    if (points.size() % 3 == 0) p.x() = 0.5;
    if (points.size() % 6 == 0) p.y() = -0.5;
    if (std::abs(p.cwiseAbs().maxCoeff() - 0.5) < 1e-9) p *= 0.9;
    points.push_back(p);
    expected.push_back(p.cwiseAbs().maxCoeff() < 0.5 ? 1 : 0);
  }
  const IndexedMesh box = test::box(1, 1, 1);
  EXPECT_EQ(are_inside(box, points, Execution(1)), expected);
  EXPECT_EQ(are_inside(box, points, Execution(2)), expected);
  IndexedMesh inside_out = box;
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(are_inside(inside_out, points, Execution(1)), expected);
}

TEST(Enclosure, KnowsPointsInLineWithVertices) {
  // Beside each vertex of a ball, whose facets are at most 0.03 deep, points with its x.
  const IndexedMesh ball = test::shuffled(test::sphere(2), 5);
  std::vector<Vector3> points;
  std::vector<char> expected;
  for (const Vector3& v : ball.points) {
    for (const double y : {-0.9, -0.4, 0.0, 0.3, 0.8}) {
      for (const double z : {-0.7, -0.2, 0.1, 0.6}) {
        const Vector3 p(v.x(), y, z);
        if (std::abs(p.norm() - 0.985) < 0.02) continue;
        points.push_back(p);
        expected.push_back(p.norm() < 1.0 ? 1 : 0);
      }
    }
  }
  EXPECT_EQ(are_inside(ball, points, Execution(1)), expected);
}

TEST(Enclosure, KnowsTheHoleOfATorus) {
  const IndexedMesh torus = test::torus(3.0, 1.0, 60);
  const std::vector<Vector3> points = {{0, 0, 0}, {3, 0, 0}, {-3, 0, 0.5}, {0, 3, 0}, {0, 0, 5}};
  EXPECT_EQ(are_inside(torus, points, Execution(1)), (std::vector<char>{0, 1, 1, 1, 0}));
}

}  // namespace
}  // namespace wscvt
