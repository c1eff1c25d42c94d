// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/space_nodes.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/nodes/self_intersections.h"

namespace wscvt {
namespace {

struct Placed {
  SpaceNodes nodes;
  double volume = 0.0;
};

Placed placed(const IndexedMesh& scan, int count) {
  const Execution execution(2);
  Grain grain;
  grain.mesh = scan;
  grain.map = map_to_sphere(grain.mesh, SphereMapOptions(), execution);
  grain.mapped.emplace(grain.mesh, grain.map.directions, execution);
  Placed result;
  result.volume =
      mesh_sums(grain.mesh.points, grain.mesh.triangles, Vector3::Zero(), execution).volume();
  result.nodes = place_in_space(grain, nullptr, count, SpaceTessellationOptions(),
                                PlacementOptions(), result.volume, execution);
  return result;
}

Placed placed(const std::string& body, int count, int vertices = 6000) {
  return placed(test::bent_grain_mesh(test::bent_grain(body), vertices), count);
}

TEST(SpaceNodes, ThinBodiesComeOutWithoutTrianglesThatMeet) {
  for (const std::string body : {"flake", "crescent"}) {
    SCOPED_TRACE(body);
    const Placed thin = placed(body, 1000);
    const IndexedMesh& mesh = thin.nodes.placed.mesh;
    EXPECT_EQ(mesh.points.size(), 1000U);
    EXPECT_EQ(mesh.triangles.size(), 1996U);
    EXPECT_TRUE(self_intersections(mesh).empty());
    EXPECT_EQ(thin.nodes.report.self_intersections, 0U);
    // Rounding of a sum over 1996 triangles.
    const double volume =
        mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1)).volume();
    EXPECT_NEAR(volume / thin.volume, 1.0, 1e-12);
    // Seeds spread by area start so well that nothing is left to repair, and their edges deviate by
    // .092 and .073 of the mean; from those that the collapse leaves, by .110 and .089.
    EXPECT_EQ(thin.nodes.report.repairs, 0);
    const Statistics edges = measure_quality(mesh).edge_length;
    EXPECT_LT(edges.standard_deviation / edges.mean, body == "flake" ? 0.1 : 0.08);
  }
}

TEST(SpaceNodes, AreNotEvenedSoFarThatTrianglesMeet) {
  // Thirty rounds would take seven pairs of this crescent's triangles through each other.
  const SpaceNodes nodes = placed("crescent", 350, 15000).nodes;
  EXPECT_GT(nodes.report.evening.held_back, 0);
  EXPECT_TRUE(self_intersections(nodes.placed.mesh).empty());
}

TEST(SpaceNodes, PassANeckOnARounderMapWhereTheyJamOnTheGrains) {
  // One of the rod's ends hangs on a neck five nodes round.
  const Placed rod = placed("rod", 1000, 15000);
  const IndexedMesh& mesh = rod.nodes.placed.mesh;
  EXPECT_EQ(mesh.points.size(), 1000U);
  EXPECT_GT(rod.nodes.report.angle_weight, 0.0);
  EXPECT_EQ(rod.nodes.report.mending.left, 0);
  EXPECT_TRUE(self_intersections(mesh).empty());
  // Nodes that go nowhere jam need no other map.
  EXPECT_EQ(placed("hook", 300).nodes.report.angle_weight, 0.0);
}

TEST(SpaceNodes, AreThoseAtHandWhereNoRounderMapCanBeMade) {
  // Needles 16,000 times as long as wide: the map of areas still holds them.
  const IndexedMesh needles = test::scaled(test::bicone(1000), Vector3(1.0, 1.0, 100.0));
  for (const double weight : {10.0, 30.0}) {
    SphereMapOptions options;
    options.angle_weight = weight;
    EXPECT_NE(test::refusal(ErrorCode::NumericalFailure,
                            [&] { map_to_sphere(needles, options, Execution(1)); }),
              "");
  }
  const SpaceNodes nodes = placed(needles, 200).nodes;
  EXPECT_EQ(nodes.placed.mesh.points.size(), 200U);
  EXPECT_EQ(nodes.report.angle_weight, 0.0);
  // They have what another map is tried for.
  EXPECT_GT(nodes.report.mending.left, 0);
}

TEST(SpaceNodes, TheOffsetForTheVolumeMakesNoTrianglesMeetAtAThinRim) {
  // On the surface no triangles of either meet.
  for (const auto& [body, count] : {std::pair("bowl", 700), std::pair("flake", 650)}) {
    SCOPED_TRACE(body);
    const Placed thin = placed(body, count);
    const IndexedMesh& mesh = thin.nodes.placed.mesh;
    EXPECT_TRUE(self_intersections(mesh).empty());
    // Rounding of a sum over 1396 triangles.
    const double volume =
        mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1)).volume();
    EXPECT_NEAR(volume / thin.volume, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace wscvt
