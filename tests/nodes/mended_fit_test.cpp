// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/mended_fit.h"

#include <gtest/gtest.h>

#include "grains/bent_grain.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/remesh.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/sphere/orientation.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

/// Random nodes on the unit sphere, whose triangles have angles of a degree or two.
SpaceTessellation random_nodes() {
  const std::vector<Vector3> seeds = random_directions(300, test::announced(5));
  return {seeds, seeds, SphereTriangulation(seeds), {}, {}};
}

IndexedMesh mesh_of(const SpaceTessellation& tessellation) {
  return {tessellation.positions, tessellation.triangulation.triangles()};
}

std::optional<MendedNodes> mend(const IndexedMesh& scan, const SpaceTessellation& tessellation,
                                int threads = 1) {
  return mend_radial_nodes(scan, mesh_of(tessellation), tessellation,
                           check_mesh(scan, {}, Execution(1)).report.volume, Execution(threads));
}

TEST(MendedFit, RaisesSmallAnglesOfRadialNodesAndFitsThem) {
  const IndexedMesh scan = test::sphere(5);
  const SpaceTessellation start = random_nodes();
  const std::optional<MendedNodes> mended = mend(scan, start);
  ASSERT_TRUE(mended);
  EXPECT_TRUE(has_mended(mended->mending));
  EXPECT_LT(measure_quality(mesh_of(start)).smallest_angle, 5.0);
  // Where so many are wrong at once a few may be left below the limit of 35 degrees.
  EXPECT_GT(measure_quality(mended->mesh).smallest_angle, 20.0);
  EXPECT_EQ(mended->mesh.points.size(), start.seeds.size());
  EXPECT_EQ(test::bad_edges(mended->mesh), 0U);
  const double volume = check_mesh(scan, {}, Execution(1)).report.volume;
  EXPECT_NEAR(check_mesh(mended->mesh, {}, Execution(1)).report.volume, volume, 1e-12 * volume);
  EXPECT_GT(mended->fit.samples, 0U);
  // Fitted nodes lie outside of a ball, which chords between nodes on it cut.
  double mean = 0.0;
  for (const Vector3& p : mended->mesh.points) mean += p.norm() / 300.0;
  EXPECT_GT(mean, 1.0);
  for (const Triangle& t : mended->mesh.triangles) {
    EXPECT_TRUE(counter_clockwise(mended->mesh.points[t[0]], mended->mesh.points[t[1]],
                                  mended->mesh.points[t[2]]));
  }
  EXPECT_EQ(mend(scan, start, 3)->mesh.points, mended->mesh.points);
}

TEST(MendedFit, LeavesWhatHasNoSmallAngleAndScansThatFold) {
  const std::vector<Vector3> even = subdivided_icosahedron(5);
  EXPECT_FALSE(mend(test::sphere(5), {even, even, SphereTriangulation(even), {}, {}}));
  for (const test::BentGrain& grain : test::bent_grains()) {
    EXPECT_FALSE(mend(test::bent_grain_mesh(grain, 3000), random_nodes())) << grain.name;
  }
}

TEST(MendedFit, IsWhatARemeshOfALongGrainEndsWith) {
  // Two flips and 26 moves of 200 nodes, of which the smallest angle had 34 degrees.
  RemeshOptions options;
  options.node_count = 200;
  options.surface.parametrization = Parametrization::Radial;
  const IndexedMesh scan = test::scaled(test::lumpy(5), Vector3(3, 1, 1));
  const RemeshResult result = remesh(scan, options, Execution(2));
  EXPECT_TRUE(has_mended(result.space.mending));
  EXPECT_GE(result.quality.smallest_angle, 35.0);
  EXPECT_EQ(result.mesh.points.size(), 200U);
  EXPECT_EQ(test::bad_edges(result.mesh), 0U);
  EXPECT_NEAR(result.remesh.volume, result.original.volume, 1e-12 * result.original.volume);
  // Nodes on the published surface are those of its tessellation.
  options.method = Method::AsPublished;
  EXPECT_FALSE(has_mended(remesh(scan, options, Execution(2)).space.mending));
}

}  // namespace
}  // namespace wscvt
