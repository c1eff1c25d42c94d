// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/offset_surface.h"

#include <gtest/gtest.h>

#include "grains/bent_grain.h"
#include "support/random_harmonics.h"
#include "support/random_sample.h"
#include "support/test_shapes.h"
#include "toolbox/map/mapped_surface.h"

namespace wscvt {
namespace {

struct Bent {
  std::vector<double> radial;
  OffsetSeries offset;
};

Bent bent_series() {
  Bent bent{test::random_harmonics(5, 1), {}};
  bent.radial[0] = 4.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bent.offset[axis] = test::random_harmonics(5, 2 + axis);
    bent.offset[axis][3] += 0.4 * static_cast<double>(axis + 1);
  }
  return bent;
}

TEST(OffsetSurface, IsSplitAndPutTogetherAgain) {
  const std::vector<Vector3> directions = random_directions(200, 3);
  std::vector<Vector3> points = random_directions(200, 4);
  for (std::size_t k = 0; k < points.size(); ++k) points[k] *= 0.02 * static_cast<double>(k);
  const RadiiAndOffsets parts = split_points(points, directions);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector3 offset(parts.offsets[0][k], parts.offsets[1][k], parts.offsets[2][k]);
    EXPECT_GT(parts.radii[k], 0.0);
    EXPECT_LT((parts.radii[k] * directions[k] + offset - points[k]).norm(), 1e-14);
    const double along = points[k].dot(directions[k]);
    EXPECT_TRUE(along <= 0.2 || parts.radii[k] == along);
  }
}

// Its slope is at most 1, so that radii are no farther apart than the points.
TEST(OffsetSurface, HasRadiiThatAreSmoothAlongARay) {
  const std::vector<Vector3> x(400, Vector3::UnitX());
  std::vector<Vector3> points;
  for (int k = 0; k < 400; ++k) points.emplace_back(0.005 * (k - 200), 0.3, 0.0);
  const std::vector<double> radii = split_points(points, x).radii;
  for (std::size_t k = 1; k < radii.size(); ++k) {
    EXPECT_GT(radii[k], radii[k - 1]);
    EXPECT_LT(radii[k] - radii[k - 1], 0.005 * (1.0 + 1e-9));
  }
}

TEST(OffsetSurface, IsMirrored) {
  const Bent bent = bent_series();
  const Vector3 signs(-1, 1, -1);
  const std::vector<Vector3> directions = random_directions(50, 5);
  std::vector<Vector3> images = directions;
  for (Vector3& image : images) image = image.cwiseProduct(signs);
  const std::vector<Vector3> points = surface_points(bent.radial, bent.offset, directions);
  const std::vector<Vector3> mirror =
      surface_points(mirrored(bent.radial, signs), mirrored_offset(bent.offset, signs), images);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_LT((points[k].cwiseProduct(signs) - mirror[k]).norm(), 1e-12);
  }
  EXPECT_FALSE(has_offset(mirrored_offset({}, signs)));
}

TEST(OffsetSurface, IsAHarmonicMap) {
  const Bent bent = bent_series();
  const HarmonicMap map = harmonic_map_of(bent.radial, bent.offset, 2.5);
  EXPECT_EQ(map.degree(), 6);
  const std::vector<Vector3> directions = random_directions(50, 6);
  const std::vector<Vector3> points = surface_points(bent.radial, bent.offset, directions);
  const std::vector<Vector3> same = map.positions(directions, Execution(1));
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_LT((2.5 * points[k] - same[k]).norm(), 1e-11);
  }
}

TEST(OffsetSurface, HasTheRootMeanSquareOfItsOffset) {
  OffsetSeries offset;
  for (std::vector<double>& series : offset) series.assign(4, 0.0);
  offset[0][0] = 0.3 * std::sqrt(4.0 * pi);
  offset[2][0] = -0.4 * std::sqrt(4.0 * pi);
  EXPECT_NEAR(rms_offset(offset), 0.5, 1e-14);
  EXPECT_EQ(rms_offset({}), 0.0);
}

// A star-shaped body has its own directions, but for what the series of degree 24 does not show.
TEST(OffsetSurface, SpreadsAStarShapedBodyByItsDirections) {
  const IndexedMesh mesh =
      test::transformed(test::sphere(3), Vector3(1.4, 1.0, 0.7).asDiagonal().toDenseMatrix());
  const MappedSurface surface = spread_over_directions(mesh, Execution(1));
  for (std::size_t k = 0; k < mesh.points.size(); ++k) {
    EXPECT_LT((surface.directions()[k] - mesh.points[k].normalized()).norm(), 0.02) << k;
  }
}

// Where the stem of a hook is, no ray sees the hook alone. MappedSurface refuses a spread that is
// not one to one. A bowl lies beside its own centroid.
TEST(OffsetSurface, SpreadsOverhangs) {
  for (const char* name : {"hook", "bowl"}) {
    const IndexedMesh mesh = test::bent_grain_mesh(test::bent_grain(name), 1500);
    const MappedSurface surface = spread_over_directions(mesh, Execution(1));
    double along = 0.0;
    for (std::size_t k = 0; k < mesh.points.size(); ++k) {
      along += surface.directions()[k].dot(mesh.points[k].normalized()) /
               static_cast<double>(mesh.points.size());
    }
    EXPECT_GT(along, 0.4) << name;
  }
}

}  // namespace
}  // namespace wscvt
