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
#include "wscvt/remesh.h"

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

TEST(SpaceNodes, HaveEvenEdgesOnBodiesWithUndercuts) {
  for (const test::BentGrain& body : test::bent_grains()) {
    SCOPED_TRACE(body.name);
    const SpaceNodes nodes = placed(test::bent_grain_mesh(body, 15000), 1000).nodes;
    const MeshQuality quality = measure_quality(nodes.placed.mesh);
    // What the prototype of the method reached, whose nodes were not fitted to the scan; thin rims
    // are allowed more. A fit alone leaves crescent, mushroom and rod at .077 to .082, the flake at
    // .094.
    const bool thin = body.name == "flake" || body.name == "bowl";
    // By its rounding a rod's deviation lies between .073 and .081.
    EXPECT_LE(quality.edge_length.standard_deviation / quality.edge_length.mean,
              thin                 ? 0.09
              : body.name == "rod" ? 0.085
                                   : 0.075);
    EXPECT_LE(quality.edge_ratio.mean, thin ? 1.18 : 1.15);
    EXPECT_LT(nodes.report.evening.deviation_after, nodes.report.evening.deviation_before);
  }
}

TEST(SpaceNodes, DoNotCrowdBehindANeck) {
  // 150 of them did, and edges deviated by 0.20 of their mean length.
  Execution execution(2);
  RemeshOptions options;
  options.node_count = 1015;
  const RemeshResult rod =
      remesh(test::bent_grain_mesh(test::bent_grain("rod"), 15000), options, execution);
  EXPECT_GT(rod.space.relocated_seeds, 50);
  EXPECT_LT(rod.quality.edge_length.standard_deviation / rod.quality.edge_length.mean, 0.1);
  EXPECT_GE(rod.quality.smallest_angle, 34.9);
  EXPECT_EQ(rod.mesh.points.size(), 1015U);
  EXPECT_EQ(rod.space.self_intersections, 0U);
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
