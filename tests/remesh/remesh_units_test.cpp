// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/test_shapes.h"
#include "wscvt/remesh/repaired_scan.h"

namespace wscvt {
namespace {

TEST(RemeshUnits, EveryNumberGoesWithItsPowerOfTheLength) {
  // A result whose lengths are all 3 and the like, in a unit of 2 about a place.
  const Vector3 centre(10, 20, 30);
  const IndexedMesh box = test::box(1, 2, 3);
  RemeshResult result;
  result.mesh = box;
  result.directions = {Vector3::UnitX()};
  result.radial_distances = {3.0};
  result.curvatures = {3.0};
  result.cell_areas = {3.0};
  result.vertex_distances = {3.0};
  result.coefficients.radius = {3.0, 5.0};
  result.coefficients.map = {std::vector<double>{3.0}, std::vector<double>{4.0, 5.0},
                             std::vector<double>{6.0}};
  result.rms_distance = 3.0;
  AsPublishedReport published;
  published.fit.residual = 3.0;
  published.fit.smallest_radius = 5.0;
  published.relaxation.history = {{0.5, 0.25, 1}};
  result.method = published;
  result.scan = describe_shape(box, Execution(1));
  result.remesh =
      describe_shape(test::transformed(box, 2.0 * Eigen::Matrix3d::Identity()), Execution(1));
  result.scan_quality.edge_length.mean = 3.0;
  result.quality.edge_length.mean = 4.0;
  result.quality.smallest_angle = 40.0;
  result.distances = MeshDistances{{3.0, 4.0, 5.0}, {6.0, 7.0, 8.0}, 9.0, 10.0};
  to_input_units(2.0, centre, result);

  EXPECT_EQ(result.mesh.points,
            test::transformed(box, 2.0 * Eigen::Matrix3d::Identity(), centre).points);
  EXPECT_EQ(result.directions, std::vector<Vector3>{Vector3::UnitX()});
  EXPECT_EQ(result.radial_distances, std::vector<double>{6.0});
  EXPECT_EQ(result.curvatures, std::vector<double>{1.5});
  EXPECT_EQ(result.cell_areas, std::vector<double>{12.0});
  EXPECT_EQ(result.vertex_distances, std::vector<double>{6.0});
  EXPECT_EQ(result.coefficients.radius, (std::vector<double>{6.0, 10.0}));
  EXPECT_EQ(result.coefficients.map[0], std::vector<double>{6.0});
  EXPECT_EQ(result.coefficients.map[1], (std::vector<double>{8.0, 10.0}));
  EXPECT_EQ(result.coefficients.map[2], std::vector<double>{12.0});
  EXPECT_EQ(result.rms_distance, 6.0);
  EXPECT_EQ(as_published_report(result)->fit.residual, 6.0);
  EXPECT_EQ(as_published_report(result)->fit.smallest_radius, 10.0);
  EXPECT_NEAR(result.scan.volume, 8 * 6.0, 1e-12);
  EXPECT_NEAR(result.remesh.volume, 8 * 48.0, 1e-11);
  EXPECT_NEAR(result.scan.area, 4 * 22.0, 1e-12);
  EXPECT_LT((result.remesh.centroid - centre).norm(), 1e-12);
  EXPECT_EQ(result.scan_quality.edge_length.mean, 6.0);
  EXPECT_EQ(result.quality.edge_length.mean, 8.0);
  EXPECT_EQ(result.quality.smallest_angle, 40.0);
  EXPECT_EQ(result.distances->to_reference.maximum, 6.0);
  EXPECT_EQ(result.distances->to_reference.mean, 10.0);
  EXPECT_EQ(result.distances->from_reference.root_mean_square, 14.0);
  EXPECT_EQ(result.distances->largest, 18.0);
  EXPECT_EQ(result.distances->root_mean_square, 20.0);
  // In cell sizes.
  EXPECT_EQ(as_published_report(result)->relaxation.history[0].displacement, 0.5);
  // Where there are none to be scaled there are none afterwards.
  RemeshResult without;
  OnScanReport on_scan;
  on_scan.nodes.volume_offset = 4.0;
  without.method = on_scan;
  to_input_units(2.0, centre, without);
  EXPECT_EQ(on_scan_report(without)->nodes.volume_offset, 8.0);
  EXPECT_FALSE(without.distances);
  EXPECT_TRUE(without.mesh.points.empty());
}

}  // namespace
}  // namespace wscvt
