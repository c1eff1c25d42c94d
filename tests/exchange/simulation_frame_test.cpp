// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

/// Without symmetry, so that it has one principal frame.
IndexedMesh body() {
  IndexedMesh mesh = test::scaled(test::lumpy(4), {1.0, 1.4, 0.7});
  for (Vector3& p : mesh.points) p.y() *= 1.0 + 0.15 * p.y();
  return mesh;
}

ShapeDescriptors describe(const IndexedMesh& mesh) { return describe_shape(mesh, Execution(1)); }

double largest_gap(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double gap = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) gap = std::max(gap, (a[i] - b[i]).norm());
  return gap;
}

TEST(SimulationFrame, InputIsWhatItWas) {
  const IndexedMesh mesh = body();
  const IndexedMesh same = in_frame(mesh, simulation_frame(describe(mesh), FrameOptions()));
  EXPECT_EQ(same.points, mesh.points);
  EXPECT_EQ(same.triangles, mesh.triangles);
}

TEST(SimulationFrame, CentredHasTheCentroidAtTheOriginAndKeepsTheAxes) {
  const IndexedMesh mesh = test::transformed(body(), Eigen::Matrix3d::Identity(), {5, 6, -7});
  FrameOptions options;
  options.frame = Frame::Centred;
  const IndexedMesh centred = in_frame(mesh, simulation_frame(describe(mesh), options));
  EXPECT_LT(describe(centred).centroid.norm(), 1e-12);
  EXPECT_LT((centred.points[9] - centred.points[4] - (mesh.points[9] - mesh.points[4])).norm(),
            1e-12);
}

TEST(SimulationFrame, PrincipalIsTheSameInEveryPoseAndDiagonal) {
  FrameOptions options;
  options.frame = Frame::Principal;
  const IndexedMesh upright = body();
  const IndexedMesh first = in_frame(upright, simulation_frame(describe(upright), options));
  const MassProperties mass = mass_properties(describe(first));
  EXPECT_LT((mass.inertia_tensor - Eigen::Matrix3d(mass.principal_moments.asDiagonal())).norm(),
            1e-12);
  EXPECT_LT(mass.principal_axes.angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const IndexedMesh turned =
        test::transformed(upright, test::random_rotation(seed), {-3, 0.1, 20});
    const IndexedMesh second = in_frame(turned, simulation_frame(describe(turned), options));
    EXPECT_LT(largest_gap(first.points, second.points), 1e-9);
  }
}

TEST(SimulationFrame, ScaleAndSize) {
  const IndexedMesh mesh = body();
  const ShapeDescriptors grain = describe(mesh);
  FrameOptions options;
  options.scale = 3.0;
  EXPECT_EQ(simulation_frame(grain, options).scale, 3.0);
  EXPECT_NEAR(describe(in_frame(mesh, simulation_frame(grain, options))).volume,
              27.0 * grain.volume, 1e-12 * grain.volume);
  options.scale = 1.0;
  options.size = 0.1;
  const ShapeDescriptors sized = describe(in_frame(mesh, simulation_frame(grain, options)));
  EXPECT_NEAR(sized.volume, test::pi / 6.0 * 1e-3, 1e-15);
}

TEST(SimulationFrame, MassGoesWithTheMesh) {
  const IndexedMesh mesh = test::transformed(body(), test::random_rotation(4), {1, 2, 3});
  for (const Frame frame : {Frame::Input, Frame::Centred, Frame::Principal}) {
    FrameOptions options;
    options.frame = frame;
    options.scale = 0.3;
    const SimulationFrame to = simulation_frame(describe(mesh), options);
    const MassProperties told = in_frame(mass_properties(describe(mesh)), to);
    const MassProperties measured = mass_properties(describe(in_frame(mesh, to)));
    EXPECT_NEAR(told.volume / measured.volume, 1.0, 1e-12);
    EXPECT_LT((told.centroid - measured.centroid).norm(), 1e-12);
    EXPECT_LT((told.inertia_tensor - measured.inertia_tensor).norm(),
              1e-10 * told.inertia_tensor.norm());
    EXPECT_LT((told.principal_moments - measured.principal_moments).norm(),
              1e-10 * told.inertia_tensor.norm());
    EXPECT_LT(told.principal_axes.angularDistance(measured.principal_axes), 1e-7);
  }
}

TEST(SimulationFrame, RefusesWhatMakesNoSense) {
  const ShapeDescriptors grain = describe(body());
  FrameOptions options;
  options.scale = 0.0;
  EXPECT_ERROR(simulation_frame(grain, options), InvalidInput);
  options.scale = 2.0;
  options.size = 1.0;
  EXPECT_ERROR(simulation_frame(grain, options), InvalidInput);
  options.scale = 1.0;
  options.size = -1.0;
  EXPECT_ERROR(simulation_frame(grain, options), InvalidInput);
}

}  // namespace
}  // namespace wscvt
