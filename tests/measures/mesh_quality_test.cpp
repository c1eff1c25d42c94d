// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/mesh_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

TEST(MeshQuality, RegularTetrahedron) {
  const MeshQuality q = measure_quality(test::tetrahedron(2.0));
  EXPECT_NEAR(q.edge_length.mean, 2.0, 1e-14);
  EXPECT_NEAR(q.edge_length.standard_deviation, 0.0, 1e-14);
  EXPECT_NEAR(q.edge_variation, 0.0, 1e-14);
  EXPECT_NEAR(q.edge_ratio.mean, 1.0, 1e-14);
  EXPECT_NEAR(q.smallest_angle, 60.0, 1e-12);
  EXPECT_NEAR(q.mean_smallest_angle, 60.0, 1e-12);
  EXPECT_EQ(q.valence_six_fraction, 0.0);
}

TEST(MeshQuality, Cube) {
  // 12 edges of 1 and 6 diagonals of sqrt 2; angles 45 degrees.
  const MeshQuality q = measure_quality(test::box(1, 1, 1));
  const double root = std::sqrt(2.0);
  const double mean = (12.0 + 6.0 * root) / 18.0;
  EXPECT_NEAR(q.edge_length.mean, mean, 1e-14);
  const double variance =
      (12.0 * (1 - mean) * (1 - mean) + 6.0 * (root - mean) * (root - mean)) / 18.0;
  EXPECT_NEAR(q.edge_length.standard_deviation, std::sqrt(variance), 1e-14);
  EXPECT_NEAR(q.edge_variation, std::sqrt(variance) / mean, 1e-14);
  EXPECT_NEAR(q.edge_length.minimum, 1.0, 1e-14);
  EXPECT_NEAR(q.edge_length.maximum, root, 1e-14);
  EXPECT_NEAR(q.edge_ratio.mean, root, 1e-14);
  EXPECT_NEAR(q.edge_ratio.standard_deviation, 0.0, 1e-14);
  EXPECT_NEAR(q.smallest_angle, 45.0, 1e-12);
}

TEST(MeshQuality, MeanAngleIsOverTheTriangles) {
  // Four triangles of 1 x 1 and eight of 1 x 2.
  const MeshQuality q = measure_quality(test::box(1, 1, 2));
  const double narrow = std::atan(0.5) * 180.0 / test::pi;
  EXPECT_NEAR(q.smallest_angle, narrow, 1e-12);
  EXPECT_NEAR(q.mean_smallest_angle, (4.0 * 45.0 + 8.0 * narrow) / 12.0, 1e-12);
}

TEST(MeshQuality, NeedleAngleIsExactNearZero) {
  // A flat box: the faces of 1 x 1e-6 have a smallest angle of atan(1e-6).
  const MeshQuality q = measure_quality(test::box(1, 1, 1e-6));
  const double expected = std::atan(1e-6) * 180.0 / test::pi;
  EXPECT_NEAR(q.smallest_angle / expected, 1.0, 1e-9);
}

TEST(MeshQuality, SubdividedIcosahedronHasTwelveVerticesOfFive) {
  const IndexedMesh mesh = test::sphere(3);
  const auto vertices = static_cast<double>(mesh.points.size());
  EXPECT_NEAR(measure_quality(mesh).valence_six_fraction, (vertices - 12.0) / vertices, 1e-15);
}

TEST(MeshQuality, RegularVerticesHaveSixEdgesNotMoreNorFewer) {
  // Two of the vertices are in as many faces as there are segments, all others in four.
  for (const int segments : {5, 6, 7, 12}) {
    EXPECT_EQ(measure_quality(test::bicone(segments)).valence_six_fraction,
              segments == 6 ? 2.0 / 8.0 : 0.0)
        << segments;
  }
}

TEST(MeshQuality, DoesNotDependOnPoseScaleOrOrder) {
  const IndexedMesh mesh = test::lumpy(3);
  const MeshQuality reference = measure_quality(mesh);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const IndexedMesh moved =
        test::shuffled(test::transformed(mesh, 7.0 * test::random_rotation(seed)), seed);
    const MeshQuality q = measure_quality(moved);
    // Rounding of the rotated coordinates and another order of adding.
    EXPECT_NEAR(q.edge_length.mean, 7.0 * reference.edge_length.mean, 1e-12);
    EXPECT_NEAR(q.edge_variation, reference.edge_variation, 1e-12);
    EXPECT_NEAR(q.edge_ratio.mean, reference.edge_ratio.mean, 1e-12);
    EXPECT_NEAR(q.edge_ratio.maximum, reference.edge_ratio.maximum, 1e-12);
    EXPECT_NEAR(q.smallest_angle, reference.smallest_angle, 1e-10);
    EXPECT_NEAR(q.mean_smallest_angle, reference.mean_smallest_angle, 1e-10);
    EXPECT_EQ(q.valence_six_fraction, reference.valence_six_fraction);
  }
}

TEST(MeshQuality, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(6);  // 81920 faces: several blocks
  const MeshQuality one = measure_quality(mesh, Execution(1));
  const MeshQuality three = measure_quality(mesh, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(MeshQuality, HistogramsCountEveryEdgeAndFaceOnce) {
  const IndexedMesh mesh = test::lumpy(3);
  const QualityHistograms h = quality_histograms(mesh, 30);
  const auto total = [](const Histogram& histogram) {
    return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0});
  };
  EXPECT_EQ(total(h.relative_edge_length), 3 * mesh.triangles.size() / 2);
  EXPECT_EQ(total(h.edge_ratio), mesh.triangles.size());
  EXPECT_EQ(total(h.angle), 3 * mesh.triangles.size());
  EXPECT_EQ(h.relative_edge_length.lower, 0.0);
  EXPECT_EQ(h.relative_edge_length.upper, 3.0);
  EXPECT_EQ(h.edge_ratio.lower, 1.0);
  EXPECT_EQ(h.edge_ratio.upper, 3.0);
}

TEST(MeshQuality, HistogramPutsValuesInTheirBins) {
  // Cube: relative lengths 1 / 1.138 = 0.879 and 1.243, ratio 1.414 everywhere.
  const QualityHistograms cube = quality_histograms(test::box(1, 1, 1), 30);
  EXPECT_EQ(cube.relative_edge_length.counts[8], 12U);
  EXPECT_EQ(cube.relative_edge_length.counts[12], 6U);
  EXPECT_EQ(cube.edge_ratio.counts[6], 12U);
  // Angles of 45 and 90 degrees lie on the edges of bins of 15.
  const QualityHistograms angles = quality_histograms(test::box(1, 1, 1), 12);
  EXPECT_EQ(angles.angle.counts[2] + angles.angle.counts[3], 24U);
  EXPECT_EQ(angles.angle.counts[5] + angles.angle.counts[6], 12U);
  // Ratios beyond the range go to the last bin.
  const QualityHistograms plate = quality_histograms(test::box(1, 1, 0.01), 10);
  EXPECT_EQ(plate.edge_ratio.counts.back(), 8U);
}

TEST(MeshQuality, RefusesWhatCannotBeMeasured) {
  EXPECT_ERROR(measure_quality(IndexedMesh()), InvalidInput);
  EXPECT_ERROR(quality_histograms(IndexedMesh(), 10), InvalidInput);
  EXPECT_ERROR(quality_histograms(test::box(1, 1, 1), 0), InvalidInput);
}

TEST(MeshQuality, StatisticsAreThoseOfAllEdgesOneByOneAlsoOverSeveralBlocks) {
  // 20,480 faces, in the order of the icosahedron's: the blocks' means differ.
  const IndexedMesh mesh = test::scaled(test::lumpy(5), {1.0, 2.0, 0.4});
  std::vector<double> lengths;
  std::vector<double> ratios;
  for (const Triangle& t : mesh.triangles) {
    std::vector<double> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      sides.push_back((mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm());
      if (t[k] < t[(k + 1) % 3]) lengths.push_back(sides.back());
    }
    const auto [shortest, longest] = std::minmax_element(sides.begin(), sides.end());
    ratios.push_back(*longest / *shortest);
  }
  const auto expect_statistics = [](const Statistics& measured, const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    // Rounding of 30,720 terms.
    EXPECT_NEAR(measured.mean / mean, 1.0, 1e-12);
    EXPECT_NEAR(measured.standard_deviation / std::sqrt(squares / count), 1.0, 1e-12);
    EXPECT_EQ(measured.minimum, *std::min_element(values.begin(), values.end()));
    EXPECT_EQ(measured.maximum, *std::max_element(values.begin(), values.end()));
  };
  const MeshQuality quality = measure_quality(mesh);
  expect_statistics(quality.edge_length, lengths);
  expect_statistics(quality.edge_ratio, ratios);
}

TEST(MeshQuality, InAnotherUnitIsThatOfTheScaledMesh) {
  const IndexedMesh mesh = test::lumpy(2);
  const double unit = 0.25;  // exact
  MeshQuality scaled = measure_quality(mesh);
  scale(scaled, unit);
  const MeshQuality expected = measure_quality(test::scaled(mesh, Vector3::Constant(unit)));
  EXPECT_EQ(std::memcmp(&scaled, &expected, sizeof scaled), 0);
}

}  // namespace
}  // namespace wscvt
