// SPDX-License-Identifier: GPL-3.0-or-later
// What the first remesh gives, with nothing chosen but the number of nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "grains/ct_grain.h"
#include "support/test_shapes.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

RemeshResult remeshed(const IndexedMesh& scan, int nodes, bool as_published = false) {
  RemeshOptions options;
  options.node_count = nodes;
  if (as_published) options.method = AsPublishedOptions();
  options.measures.distances = true;
  return remesh(scan, options);
}

double rms_percent(const RemeshResult& result) {
  return 100.0 * result.distances->root_mean_square / result.input.equivalent_radius;
}

TEST(RemeshDefaults, KeepShapeAndVolumeOfRoughAndAngularGrains) {
  for (const test::Grain& grain :
       {test::reference_grains().back(), test::angular_grain(5), test::angular_grain(6)}) {
    SCOPED_TRACE(grain.name);
    const IndexedMesh scan = test::ct_mesh_of_about(grain, 12000);
    const RemeshResult result = remeshed(scan, 1000);
    EXPECT_EQ(result.mesh.points.size(), 1000U);
    EXPECT_NEAR(result.remesh.volume / result.scan.volume, 1.0, 1e-12);
    // What is promised of real scans, which are rougher than these.
    EXPECT_NEAR(result.remesh.area / result.scan.area, 1.0, 0.01);
    EXPECT_LT(result.quality.edge_ratio.mean, 1.155);
    EXPECT_GT(result.quality.smallest_angle, 35.0);
    EXPECT_LT(rms_percent(result), 0.8);
    // The published method with as many nodes is farther from the scan.
    EXPECT_LT(rms_percent(result), 0.7 * rms_percent(remeshed(scan, 1000, true)));
  }
}

TEST(RemeshDefaults, AsPublishedIsTheSeriesWithNodesOnIt) {
  RemeshOptions options;
  options.method = AsPublishedOptions();
  options.node_count = 200;
  const RemeshResult result = remesh(test::lumpy(4), options);
  EXPECT_EQ(as_published_report(result)->fit.degree, 20);
  const HarmonicSurface series(result.coefficients.radius);
  for (std::size_t i = 0; i < result.directions.size(); ++i) {
    EXPECT_NEAR(series.radius(result.directions[i]), result.radial_distances[i], 1e-12);
  }
  options.degree = 9;
  EXPECT_EQ(as_published_report(remesh(test::lumpy(4), options))->fit.degree, 9);
}

TEST(RemeshDefaults, AHandfulOfNodesGoesRoundALongGrain) {
  // With cells on the sphere they ran together on one side of it, at angles of 1 to 16 degrees.
  const IndexedMesh scan = test::scaled(test::sphere(3), Vector3(1.0, 2.0, 3.0));
  RemeshOptions options;
  for (options.node_count = 10; options.node_count < 20; ++options.node_count) {
    SCOPED_TRACE(options.node_count);
    const RemeshResult result = remesh(scan, options);
    // Half of what a regular triangle has.
    EXPECT_GT(result.quality.smallest_angle, 30.0);
    // About the middle of the grain, whose shortest half axis is 1.
    EXPECT_LT(result.remesh.centroid.norm(), 0.5);
  }
}

TEST(RemeshDefaults, FourNodesOnABallAreARegularTetrahedron) {
  const RemeshResult result = remeshed(test::sphere(4), 4);
  EXPECT_NEAR(result.quality.edge_length.minimum / result.quality.edge_length.maximum, 1.0, 0.02);
}

}  // namespace
}  // namespace wscvt
