// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_units.h"

#include <gtest/gtest.h>

#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(RemeshUnits, EveryNumberGoesWithItsPowerOfTheLength) {
  // A result whose lengths are all 3 and the like, in a unit of 2 about a place.
  Grain grain;
  grain.unit = 2.0;
  grain.centre = Vector3(10, 20, 30);
  const IndexedMesh box = test::box(1, 2, 3);
  RemeshResult result;
  result.mesh = box;
  result.directions = {Vector3::UnitX()};
  result.radial_distances = {3.0};
  result.curvatures = {3.0};
  result.cell_areas = {3.0};
  result.vertex_distances = {3.0};
  result.coefficients = {3.0, 5.0};
  result.map_coefficients = {std::vector<double>{3.0}, std::vector<double>{4.0, 5.0},
                             std::vector<double>{6.0}};
  result.misfit = 3.0;
  result.fit.residual = 3.0;
  result.fit.chord_error = 4.0;
  result.fit.smallest_radius = 5.0;
  result.original = describe_shape(box, Execution(1));
  result.remesh =
      describe_shape(test::transformed(box, 2.0 * Eigen::Matrix3d::Identity()), Execution(1));
  result.original_quality.edge_length.mean = 3.0;
  result.quality.edge_length.mean = 4.0;
  result.quality.smallest_angle = 40.0;
  result.refinement.start_distance = 3.0;
  result.refinement.history = {{4.0, 1, 2, 3}};
  result.space.fit.offset = 3.0;
  result.space.volume_loss = 0.5;
  result.distances = MeshDistances{{3.0, 4.0, 5.0}, {6.0, 7.0, 8.0}, 9.0, 10.0};
  result.relaxation.history = {{0.5, 0.25, 1}};
  to_input_units(grain, result);

  EXPECT_EQ(result.mesh.points,
            test::transformed(box, 2.0 * Eigen::Matrix3d::Identity(), grain.centre).points);
  EXPECT_EQ(result.directions, std::vector<Vector3>{Vector3::UnitX()});
  EXPECT_EQ(result.radial_distances, std::vector<double>{6.0});
  EXPECT_EQ(result.curvatures, std::vector<double>{1.5});
  EXPECT_EQ(result.cell_areas, std::vector<double>{12.0});
  EXPECT_EQ(result.vertex_distances, std::vector<double>{6.0});
  EXPECT_EQ(result.coefficients, (std::vector<double>{6.0, 10.0}));
  EXPECT_EQ(result.map_coefficients[0], std::vector<double>{6.0});
  EXPECT_EQ(result.map_coefficients[1], (std::vector<double>{8.0, 10.0}));
  EXPECT_EQ(result.map_coefficients[2], std::vector<double>{12.0});
  EXPECT_EQ(result.misfit, 6.0);
  EXPECT_EQ(result.fit.residual, 6.0);
  EXPECT_EQ(result.fit.chord_error, 8.0);
  EXPECT_EQ(result.fit.smallest_radius, 10.0);
  EXPECT_NEAR(result.original.volume, 8 * 6.0, 1e-12);
  EXPECT_NEAR(result.remesh.volume, 8 * 48.0, 1e-11);
  EXPECT_NEAR(result.original.area, 4 * 22.0, 1e-12);
  EXPECT_LT((result.remesh.centroid - grain.centre).norm(), 1e-12);
  EXPECT_EQ(result.original_quality.edge_length.mean, 6.0);
  EXPECT_EQ(result.quality.edge_length.mean, 8.0);
  EXPECT_EQ(result.quality.smallest_angle, 40.0);
  EXPECT_EQ(result.refinement.start_distance, 6.0);
  EXPECT_EQ(result.refinement.history[0].distance, 8.0);
  EXPECT_EQ(result.refinement.history[0].moves, 1);
  EXPECT_EQ(result.space.fit.offset, 6.0);
  EXPECT_EQ(result.space.volume_loss, 0.5);
  EXPECT_EQ(result.distances->to_reference.maximum, 6.0);
  EXPECT_EQ(result.distances->to_reference.mean, 10.0);
  EXPECT_EQ(result.distances->from_reference.root_mean_square, 14.0);
  EXPECT_EQ(result.distances->largest, 18.0);
  EXPECT_EQ(result.distances->root_mean_square, 20.0);
  EXPECT_EQ(result.relaxation.history[0].displacement, 0.5);  // in cell sizes
  // Where there are none to be scaled there are none afterwards.
  RemeshResult without;
  to_input_units(grain, without);
  EXPECT_FALSE(without.distances);
  EXPECT_TRUE(without.mesh.points.empty());
}

}  // namespace
}  // namespace wscvt
