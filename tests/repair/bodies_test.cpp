// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

IndexedMesh ball(double radius, const Vector3& centre) {
  return test::moved(test::sphere(2), radius, centre);
}

IndexedMesh inside_out(IndexedMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

double signed_volume(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, mesh.points[0], Execution(1)).volume();
}

TEST(Bodies, AreTheShellsWithTheirPoresInTheOrderOfTheFile) {
  const double unit = signed_volume(ball(1.0, Vector3::Zero()));
  // A crumb; a large body with two pores, in one of which a grain with a pore lies; one beside it.
  // Which way the faces look says nothing.
  std::vector<IndexedMesh> shells = {ball(0.1, {9, -9, 0}),
                                     inside_out(ball(10.0, {1, 2, 3})),
                                     inside_out(ball(4.0, {5, 2, 3})),
                                     ball(2.0, {-5, 2, 3}),
                                     ball(3.0, {5, 2, 3}),
                                     ball(1.0, {5.5, 2, 3}),
                                     ball(5.0, {30, 2, 3})};
  IndexedMesh mesh;
  for (const IndexedMesh& shell : shells) mesh = test::joined(mesh, shell);
  for (const bool as_stl : {false, true}) {
    const std::vector<MeshBody> bodies =
        split_bodies(as_stl ? test::unwelded(mesh) : mesh, Execution(2));
    ASSERT_EQ(bodies.size(), 4U);
    const std::vector<double> radii = {0.1, 10.0, 3.0, 5.0};
    const std::vector<std::size_t> pores = {0, 2, 1, 0};
    const std::vector<double> pore_volumes = {0.0, 64.0 + 8.0, 1.0, 0.0};
    for (std::size_t k = 0; k < 4; ++k) {
      const double volume = unit * std::pow(radii[k], 3);
      EXPECT_NEAR(bodies[k].volume / volume, 1.0, 1e-12) << k;
      EXPECT_EQ(bodies[k].pores, pores[k]) << k;
      EXPECT_NEAR(bodies[k].pore_volume, unit * pore_volumes[k], 1e-12 * volume) << k;
      EXPECT_EQ(bodies[k].boundary_edges, 0U);
      // Pores are turned inward, so that their volume counts against the body's.
      EXPECT_NEAR(signed_volume(bodies[k].mesh), volume - unit * pore_volumes[k], 1e-11 * volume);
      EXPECT_EQ(bodies[k].mesh.points.size(), (1 + pores[k]) * shells[0].points.size());
    }
  }
}

// Whatever their order and their faces', the same bodies come out.
TEST(Bodies, AreFoundInAFileWhoseFacesAreInAnyOrder) {
  IndexedMesh mesh = test::joined(ball(3.0, {0, 0, 0}), ball(1.0, {0.5, -0.25, 0.125}));
  mesh = test::joined(mesh, ball(2.0, {4.9, 0, 0}));
  mesh = test::shuffled(mesh, test::announced(3));
  const std::vector<MeshBody> bodies = split_bodies(mesh, Execution(1));
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].pores + bodies[1].pores, 1U);
  EXPECT_EQ(bodies[bodies[0].volume > bodies[1].volume ? 0 : 1].pores, 1U);
}

TEST(Bodies, ThatCutThroughEachOtherOrAreOpenLieSideBySide) {
  // The smaller one's box is within the larger's.
  const IndexedMesh cutting = test::joined(ball(10.0, {0, 0, 0}), ball(2.0, {6.0, 6.0, 0}));
  EXPECT_EQ(split_bodies(cutting, Execution(1)).size(), 2U);
  IndexedMesh open = ball(1.0, {0, 0, 0});
  open.triangles.pop_back();
  const std::vector<MeshBody> bodies =
      split_bodies(test::joined(ball(10.0, {0, 0, 0}), open), Execution(1));
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].pores, 0U);
  EXPECT_EQ(bodies[1].boundary_edges, 3U);
  EXPECT_EQ(bodies[1].volume, 0.0);
}

TEST(Bodies, ThatTouchInAVertexAreTwo) {
  const IndexedMesh box = test::box(1.0, 2.0, 3.0);
  Vector3 corner = box.points[0];
  for (const Vector3& p : box.points) {
    if (p.sum() > corner.sum()) corner = p;
  }
  const IndexedMesh other = test::transformed(test::box(2.0, 1.0, 1.0), Eigen::Matrix3d::Identity(),
                                              corner - test::box(2.0, 1.0, 1.0).points[0]);
  EXPECT_EQ(split_bodies(test::joined(box, other), Execution(1)).size(), 2U);
}

TEST(Bodies, AreNotMadeOfNothing) {
  EXPECT_ERROR(split_bodies({}, Execution(1)), InvalidInput);
  IndexedMesh flat = test::box(1.0, 2.0, 3.0);
  for (Vector3& p : flat.points) p = Vector3(1, 2, 3);
  EXPECT_ERROR(split_bodies(flat, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
