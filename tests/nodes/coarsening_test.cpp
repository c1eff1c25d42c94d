// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/coarsening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {
namespace {

EditMesh editable(const IndexedMesh& mesh) {
  return EditMesh(mesh.points, mesh.triangles, Execution(1));
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Coarsening, KeepsAreasVectorsAndClusters) {
  const IndexedMesh body = test::lumpy(4);
  Coarsening coarsening(editable(body), {});
  const double area = sum_of(coarsening.areas());
  const std::size_t start = coarsening.size();
  EXPECT_GT(coarsening.sweep(1), 0);
  // "About halves".
  EXPECT_LT(coarsening.size(), 7 * start / 10);
  EXPECT_GT(coarsening.size(), start / 4);
  ASSERT_TRUE(coarsening.reduce(150, Execution(1)));
  EXPECT_EQ(coarsening.size(), 150u);
  EXPECT_EQ(coarsening.mesh().triangles.size(), 296u);
  EXPECT_NEAR(sum_of(coarsening.areas()), area, 1e-10 * area);
  Vector3 vectors = Vector3::Zero();
  for (const Vector3& v : coarsening.vectors()) vectors += v;
  EXPECT_LT(vectors.norm(), 1e-10);
  // Without a density a vertex is the centroid of what it stands for, by area.
  std::vector<Vector3> moments(150, Vector3::Zero());
  const Coarsening whole(editable(body), {});
  for (std::size_t v = 0; v < body.points.size(); ++v) {
    const std::int32_t cluster = coarsening.cluster_of(static_cast<std::int32_t>(v));
    ASSERT_GE(cluster, 0);
    ASSERT_LT(cluster, 150);
    moments[cluster] += whole.areas()[v] * body.points[v];
  }
  for (std::size_t i = 0; i < 150; ++i) {
    EXPECT_LT((moments[i] / coarsening.areas()[i] - coarsening.mesh().points[i]).norm(), 1e-12);
  }
}

TEST(Coarsening, GivesCellsOfAboutOneArea) {
  Coarsening coarsening(editable(test::lumpy(4)), {});
  while (coarsening.size() > 300 && coarsening.sweep(300) > 0) {
  }
  ASSERT_TRUE(coarsening.reduce(150, Execution(1)));
  const double mean = sum_of(coarsening.areas()) / 150.0;
  double variance = 0.0;
  for (const double area : coarsening.areas()) variance += (area - mean) * (area - mean) / 150.0;
  EXPECT_LT(std::sqrt(variance), 0.3 * mean);
  for (std::size_t v = 0; v < 150; ++v) EXPECT_LE(coarsening.mesh().degrees[v], 12);
}

TEST(Coarsening, FollowsADensity) {
  const IndexedMesh ball = test::sphere(4);
  std::vector<double> density;
  for (const Vector3& p : ball.points) density.push_back(p.z() > 0.0 ? 1.5 : 0.5);
  Coarsening coarsening(editable(ball), density);
  ASSERT_TRUE(coarsening.reduce(200, Execution(1)));
  const auto upper = std::count_if(coarsening.mesh().points.begin(), coarsening.mesh().points.end(),
                                   [](const Vector3& p) { return p.z() > 0.0; });
  // Three quarters of the nodes, less what the border blurs.
  EXPECT_NEAR(static_cast<double>(upper), 150.0, 12.0);
}

TEST(Coarsening, PinchesNoTubeOfThreeSides) {
  // A ring whose tube is a prism: three of its edges go round it and bound no face.
  IndexedMesh ring;
  constexpr int around = 30;
  for (int i = 0; i < around; ++i) {
    const double at = 2.0 * 3.141592653589793 * i / around;
    for (int k = 0; k < 3; ++k) {
      const double turn = 2.0 * 3.141592653589793 * k / 3.0 + 0.02 * i;
      const double out = 1.0 + 0.2 * std::cos(turn);
      ring.points.emplace_back(out * std::cos(at), out * std::sin(at), 0.2 * std::sin(turn));
      const auto v = [&](int j, int l) {
        return static_cast<std::int32_t>(3 * ((i + j) % around) + (k + l) % 3);
      };
      ring.triangles.push_back({v(0, 0), v(1, 0), v(0, 1)});
      ring.triangles.push_back({v(1, 0), v(1, 1), v(0, 1)});
    }
  }
  ASSERT_EQ(test::bad_edges(ring), 0u);
  Coarsening coarsening(editable(ring), {});
  coarsening.ignore_shapes();
  ASSERT_TRUE(coarsening.reduce(15, Execution(1)));
  EXPECT_EQ(coarsening.mesh().triangles.size(), 30u);  // one handle
  EXPECT_EQ(test::bad_edges({coarsening.mesh().points, coarsening.mesh().triangles}), 0u);
}

TEST(Coarsening, TurnsNoFaceAgainstTheScan) {
  // A flake that is as rough as its scan is fine.
  constexpr int seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.01, 0.01);
  IndexedMesh rough = test::scaled(test::sphere(5), Vector3(2.0, 1.5, 0.04));
  for (Vector3& p : rough.points) p += Vector3(uniform(random), uniform(random), uniform(random));
  Coarsening coarsening(editable(rough), {});
  while (coarsening.size() > 600 && coarsening.sweep(600) > 0) {
  }
  ASSERT_TRUE(coarsening.reduce(300, Execution(1)));
  const EditMesh& mesh = coarsening.mesh();
  int against = 0;
  int sharp = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3 outward =
        coarsening.vectors()[a] + coarsening.vectors()[b] + coarsening.vectors()[c];
    if (mesh.normal(t).dot(outward) < 0.2 * mesh.normal(t).norm() * outward.norm()) ++against;
    if (mesh.sharpness(t) > 0.9994) ++sharp;  // 2 degrees
  }
  EXPECT_EQ(against, 0);
  EXPECT_EQ(sharp, 0);
}

TEST(Coarsening, GoesDownToATetrahedronAndNoFurther) {
  Coarsening coarsening(editable(test::sphere(2)), {});
  if (!coarsening.reduce(4, Execution(1))) {
    coarsening.ignore_shapes();
    ASSERT_TRUE(coarsening.reduce(4, Execution(1)));
  }
  EXPECT_EQ(coarsening.mesh().triangles.size(), 4u);
  EXPECT_FALSE(coarsening.reduce(3, Execution(1)));
  EXPECT_EQ(coarsening.size(), 4u);
}

TEST(Coarsening, TurnsNoFaceAgainstTheSurface) {
  Coarsening coarsening(editable(test::subdivided(test::box(3.0, 2.9, 0.1), 4)), {});
  while (coarsening.size() > 400 && coarsening.sweep(400) > 0) {
  }
  ASSERT_TRUE(coarsening.reduce(300, Execution(1)));
  int against = 0;
  for (std::size_t t = 0; t < coarsening.mesh().triangles.size(); ++t) {
    const auto& [a, b, c] = coarsening.mesh().triangles[t];
    const Vector3 outward =
        coarsening.vectors()[a] + coarsening.vectors()[b] + coarsening.vectors()[c];
    if (cosine_to(coarsening.mesh().normal(t).normalized(), outward) < 0.0) ++against;
  }
  EXPECT_LE(against, 2);  // of 596; a merge may leave a thousandth of a cell so
}

TEST(Coarsening, IsStopped) {
  test::expect_to_be_stopped(
      [&](const Execution& execution) {
        Coarsening(editable(test::sphere(3)), {}).reduce(50, execution);
      },
      "Coarsening the scan", 2);
}

TEST(DelaunayFlips, MakeOppositeAnglesSumToAtMostPi) {
  // A ball whose vertices are moved along it: long triangles.
  IndexedMesh ball = test::sphere(3);
  for (Vector3& p : ball.points) {
    p = Vector3(p.x() + 0.5 * p.z(), p.y(), p.z()).normalized();
  }
  EditMesh mesh = editable(ball);
  const auto obtuse = [&] {
    int count = 0;
    for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
      const auto half_edge = static_cast<std::int32_t>(h);
      double sum = 0.0;
      for (const std::int32_t side : {half_edge, mesh.opposite[h]}) {
        const Vector3 apex = mesh.points[mesh.apex(side)];
        const Vector3 a = mesh.points[mesh.origin(side)] - apex;
        const Vector3 b = mesh.points[mesh.target(side)] - apex;
        sum += std::atan2(a.cross(b).norm(), a.dot(b));
      }
      if (sum > 3.1416) ++count;
    }
    return count;
  };
  EXPECT_GT(obtuse(), 30);
  int passes = 0;
  while (flip_to_delaunay(mesh, mesh.points) > 0 && passes < 20) ++passes;
  EXPECT_LT(passes, 20);
  EXPECT_EQ(obtuse(), 0);
  EXPECT_EQ(test::bad_edges({mesh.points, mesh.triangles}), 0u);
}

TEST(DelaunayFlips, LeaveTheEdgesOfABox) {
  const IndexedMesh box = test::subdivided(test::box(1.0, 1.3, 0.9), 2);
  EditMesh mesh = editable(box);
  std::vector<Vector3> outward(mesh.points.size());
  for (std::size_t v = 0; v < outward.size(); ++v) outward[v] = mesh.points[v].normalized();
  const double volume = 1.0 * 1.3 * 0.9;
  for (int pass = 0; pass < 5; ++pass) flip_to_delaunay(mesh, outward);
  EXPECT_NEAR(mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1)).volume(),
              volume, 1e-12);
}

}  // namespace
}  // namespace wscvt
