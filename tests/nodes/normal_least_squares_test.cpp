// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/normal_least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/nodes/self_intersections.h"
#include "wscvt/surface/sphere_map.h"
#include "wscvt/tessellation/space_relaxation.h"

namespace wscvt {
namespace {

double volume_of(const IndexedMesh& mesh) {
  double volume = 0.0;
  for (const Triangle& t : mesh.triangles) {
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6.0;
  }
  return volume;
}

struct Fitted {
  IndexedMesh scan;
  IndexedMesh before;
  IndexedMesh after;
  NormalFitReport report;
};

Fitted fitted(const IndexedMesh& scan, int nodes, int threads = 1,
              const NormalFitOptions& options = {}) {
  const Execution execution(threads);
  const SphereMap map = map_to_sphere(scan, SphereMapOptions(), execution);
  const MappedSurface surface(scan, map.directions, execution);
  const SpaceTessellation sites =
      relax_in_space(surviving_seeds(surface, map.collapse_order, nodes), nodes, surface, {},
                     RelaxationOptions(), MultilevelOptions(), execution);
  const std::vector<Triangle>& triangles = sites.triangulation.triangles();
  const std::vector<FitSample> samples =
      deal_out(mapped_samples(surface, nullptr, options.samples, execution), sites.positions,
               sites.seeds, triangles, execution);
  const NormalFit fit =
      fit_along_normals({sites.positions, triangles}, samples, volume_of(scan), options, execution);
  return {scan, {sites.positions, triangles}, {fit.positions, triangles}, fit.report};
}

TEST(NormalLeastSquares, MakesTheVolumeExactAndTheDistanceSmaller) {
  const Fitted hook = fitted(test::bent_grain_mesh(test::bent_grain("hook"), 4000), 300);
  // Rounding of a sum over 596 triangles.
  EXPECT_NEAR(volume_of(hook.after) / volume_of(hook.scan), 1.0, 1e-12);
  const DistanceOptions sampling{20000};
  const double before =
      measure_distances(hook.before, hook.scan, sampling, Execution(1)).root_mean_square;
  const double after =
      measure_distances(hook.after, hook.scan, sampling, Execution(1)).root_mean_square;
  // On smooth bodies a third less.
  EXPECT_LT(after, 0.8 * before);
  const MeshQuality quality = measure_quality(hook.after);
  EXPECT_GE(quality.smallest_angle, std::min(NormalFitOptions().smallest_angle - 1.0,
                                             measure_quality(hook.before).smallest_angle - 1.0));
  EXPECT_LE(self_intersections(hook.after).size(), self_intersections(hook.before).size());
}

TEST(NormalLeastSquares, SamplesGoOnToTrianglesAtTheSameNodes) {
  // A double pyramid, and the same with node 2 relocated and the triangles in another order.
  const std::vector<Triangle> before = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3},
                                        {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  IndexedMesh after;
  after.points = {{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  after.triangles = {before[5], before[4], before[3], before[2], before[1], before[0]};
  const std::vector<FitSample> samples = {
      {{0.9, 0.0, 0.1}, 0}, {{-1.0, -1.0, 0.1}, 1}, {{0.1, 0.0, -0.9}, 5}};
  const std::vector<FitSample> on = deal_on(samples, before, after, {2});
  ASSERT_EQ(on.size(), 3U);
  // The nearest of the nodes that stayed: 0; 3, although 2 was nearer; 4.
  const std::int32_t expected[] = {0, 3, 4};
  for (std::size_t i = 0; i < on.size(); ++i) {
    EXPECT_EQ(on[i].point, samples[i].point);
    const Triangle& t = after.triangles[on[i].triangle];
    EXPECT_EQ(std::count(t.begin(), t.end(), expected[i]), 1) << i;
  }
  EXPECT_EQ(deal_on(samples, before, after, {1, 2, 3}).size(), 2U);
}

TEST(NormalLeastSquares, NodesOfASphereMoveOutwardsAlike) {
  // Even triangles with corners on the unit sphere lie l^2 / 8 below it in the mean, with
  // l^2 = 8 pi / (sqrt(3) N): 1.814 / N. The scan's 2,562 vertices lose as much themselves.
  const Fitted ball = fitted(test::sphere(4), 200);
  EXPECT_NEAR(volume_of(ball.after) / volume_of(ball.scan), 1.0, 1e-12);
  const double expected = 1.0 + test::pi / std::sqrt(3.0) * (1.0 / 200.0 - 1.0 / 2562.0);
  double mean = 0.0;
  for (const Vector3& p : ball.after.points) {
    // Nodes with five and seven neighbours stand half as far again from the sphere, or half as far.
    EXPECT_NEAR(p.norm() - 1.0, expected - 1.0, 0.5 * (expected - 1.0));
    mean += p.norm() / static_cast<double>(ball.after.points.size());
  }
  EXPECT_NEAR(mean, expected, 5e-4);
  EXPECT_EQ(ball.report.held_back, 0);
}

TEST(NormalLeastSquares, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh scan = test::scaled(test::lumpy(4), Vector3(1.5, 1.0, 0.7));
  EXPECT_EQ(fitted(scan, 150, 1).after.points, fitted(scan, 150, 3).after.points);
}

TEST(NormalLeastSquares, GuardsHoldNodesBack) {
  NormalFitOptions strict;
  strict.smallest_angle = 59.0;
  const IndexedMesh scan = test::scaled(test::lumpy(4), Vector3(1.5, 1.0, 0.7));
  EXPECT_GT(fitted(scan, 60, 1, strict).report.held_back,
            fitted(scan, 60, 1, NormalFitOptions()).report.held_back);
}

TEST(NormalLeastSquares, RefusesOptionsOutOfRange) {
  const auto refusal = [](const NormalFitOptions& options) {
    return test::refusal(ErrorCode::InvalidInput, [&] { check_normal_fit_options(options); });
  };
  EXPECT_EQ(refusal({}), "");
  NormalFitOptions none;
  none.samples = 0;
  EXPECT_NE(refusal(none).find("1 or more"), std::string::npos);
  NormalFitOptions wide;
  wide.smallest_angle = 60.0;
  EXPECT_NE(refusal(wide).find("below 60"), std::string::npos);
  NormalFitOptions turned;
  turned.largest_turn = 0.0;
  EXPECT_NE(refusal(turned).find("above 0 and 180"), std::string::npos);
}

}  // namespace
}  // namespace wscvt
