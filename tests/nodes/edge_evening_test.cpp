// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/edge_evening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/mesh_quality.h"

namespace wscvt {
namespace {

/// 642 nodes on the unit sphere, each off its place by up to `amount` in every direction before it
/// is put back on to the sphere; the edges are 0.15 long.
IndexedMesh uneven_sphere(double amount) {
  IndexedMesh mesh = test::sphere(3);
  std::mt19937_64 engine(test::announced(7));
  std::uniform_real_distribution<double> shift(-amount, amount);
  for (Vector3& p : mesh.points) {
    p += Vector3(shift(engine), shift(engine), shift(engine));
    p.normalize();
  }
  return mesh;
}

IndexedMesh evened(IndexedMesh mesh, const std::vector<double>& spacings = {},
                   const EdgeEveningOptions& options = {}, int threads = 1) {
  mesh.points = even_edges(mesh, spacings, options, Execution(threads)).positions;
  return mesh;
}

double deviation(const IndexedMesh& mesh) {
  const Statistics edges = measure_quality(mesh).edge_length;
  return edges.standard_deviation / edges.mean;
}

TEST(EdgeEvening, BringsEdgesNearerToOneLengthWhereTheyAre) {
  const IndexedMesh before = uneven_sphere(0.03);
  const EvenedEdges result = even_edges(before, {}, EdgeEveningOptions(), Execution(2));
  const IndexedMesh after{result.positions, before.triangles};
  // The subdivided icosahedron that was disturbed has 0.07 itself.
  EXPECT_GT(deviation(before), 0.12);
  EXPECT_LT(deviation(after), 0.075);
  EXPECT_LT(measure_quality(after).edge_ratio.mean, measure_quality(before).edge_ratio.mean);
  EXPECT_NEAR(result.report.deviation_before, deviation(before), 1e-12);
  EXPECT_NEAR(result.report.deviation_after, deviation(after), 1e-12);
  EXPECT_EQ(result.report.held_back, 0);
  // A step of a tenth of an edge along the tangential plane leaves the sphere by 1e-4.
  for (const Vector3& p : after.points) EXPECT_NEAR(p.norm(), 1.0, 3e-3);
}

TEST(EdgeEvening, MakesEdgesAsLongAsWantedWhereLengthsDiffer) {
  const IndexedMesh before = uneven_sphere(0.0);
  std::vector<double> spacings;
  for (const Vector3& p : before.points) spacings.push_back(7.0 * (1.0 + 0.5 * p.z()));
  EdgeEveningOptions options;
  options.rounds = 300;  // what is wanted at the poles has to come over many edges
  const EvenedEdges result = even_edges(before, spacings, options, Execution(2));
  EXPECT_LT(result.report.deviation_after, 0.5 * result.report.deviation_before);
  const auto mean_area = [&](double sign) {
    double sum = 0.0;
    int count = 0;
    for (const Triangle& t : before.triangles) {
      if (!(sign * before.points[t[0]].z() > 0.8)) continue;
      sum += doubled_area_normal(result.positions[t[0]], result.positions[t[1]],
                                 result.positions[t[2]])
                 .norm();
      ++count;
    }
    return sum / count;
  };
  // Lengths of 1.45 : 0.55 are wanted about the poles; areas go by their squares, 7 : 1.
  EXPECT_GT(mean_area(1.0), 2.0 * mean_area(-1.0));
}

TEST(EdgeEvening, LeavesEdgesOfOneLengthAlone) {
  for (const IndexedMesh& mesh : {test::icosahedron(), test::tetrahedron(1.0)}) {
    const EvenedEdges result = even_edges(mesh, {}, EdgeEveningOptions(), Execution(1));
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      // Rounding of thirty rounds.
      EXPECT_LT((result.positions[i] - mesh.points[i]).norm(), 1e-13);
    }
    EXPECT_LT(result.report.deviation_after, 1e-13);
  }
}

TEST(EdgeEvening, MakesNoAngleSmallerThanItsLimit) {
  // Lengths of 0.3 to 1.7 side by side make no triangles without small angles.
  const IndexedMesh before = test::sphere(3);
  std::mt19937_64 engine(test::announced(11));
  std::uniform_real_distribution<double> spacing(0.3, 1.7);
  std::vector<double> spacings;
  for (std::size_t i = 0; i < before.points.size(); ++i) spacings.push_back(spacing(engine));
  EdgeEveningOptions options;
  EXPECT_GE(measure_quality(before).smallest_angle, options.limits.smallest_angle);
  EXPECT_GE(measure_quality(evened(before, spacings, options)).smallest_angle,
            options.limits.smallest_angle - 1e-9);
  options.limits.smallest_angle = 0.0;
  EXPECT_LT(measure_quality(evened(before, spacings, options)).smallest_angle, 30.0);
}

TEST(EdgeEvening, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = uneven_sphere(0.05);
  EXPECT_EQ(evened(mesh, {}, {}, 1).points, evened(mesh, {}, {}, 3).points);
}

TEST(EdgeEvening, RefusesOptionsOutOfRange) {
  const auto refusal = [](const EdgeEveningOptions& options) {
    return test::refusal(ErrorCode::InvalidInput, [&] { check_edge_evening_options(options); });
  };
  EXPECT_EQ(refusal({}), "");
  EdgeEveningOptions negative;
  negative.rounds = -1;
  EXPECT_NE(refusal(negative).find("0 or more"), std::string::npos);
  EdgeEveningOptions wide;
  wide.limits.smallest_angle = 60.0;
  EXPECT_NE(refusal(wide).find("below 60"), std::string::npos);
  EdgeEveningOptions turned;
  turned.limits.largest_turn = 0.0;
  EXPECT_NE(refusal(turned).find("above 0 and 180"), std::string::npos);
}

TEST(EdgeEvening, RefusesAnotherNumberOfSpacings) {
  const std::string said = test::refusal(ErrorCode::InvalidInput, [] {
    even_edges(test::icosahedron(), {1.0, 1.0}, EdgeEveningOptions(), Execution(1));
  });
  EXPECT_NE(said.find("12 nodes, but 2 spacings"), std::string::npos) << said;
}

}  // namespace
}  // namespace wscvt
