// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

/// Distance to the surface of the box [-h, h]^3.
double distance_to_cube(const Vector3& p, double h) {
  const Vector3 excess = (p.cwiseAbs().array() - h).matrix();
  if (excess.maxCoeff() <= 0.0) return -excess.maxCoeff();
  return excess.cwiseMax(0.0).norm();
}

TEST(MeshDistance, AgreesWithTheClosedFormOfACube) {
  const std::uint64_t seed = 5;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const MeshDistance query(test::box(1, 1, 1));
  for (int i = 0; i < 2000; ++i) {
    const Vector3 p(uniform(engine), uniform(engine), uniform(engine));
    EXPECT_NEAR(query.distance(p), distance_to_cube(p, 0.5), 1e-14);
    EXPECT_EQ(query.contains(p), p.cwiseAbs().maxCoeff() < 0.5);
    const Vector3 nearest = query.nearest_point(p);
    EXPECT_NEAR((nearest - p).norm(), query.distance(p), 1e-14);
    EXPECT_NEAR(nearest.cwiseAbs().maxCoeff(), 0.5, 1e-14);
  }
}

TEST(MeshDistance, ZeroAtTheVertices) {
  const IndexedMesh mesh = test::lumpy(3);
  for (const double d : MeshDistance(mesh).distances(mesh.points, Execution(2))) EXPECT_EQ(d, 0.0);
}

TEST(MeshDistance, FarFromTheOriginItIsAsGood) {
  const Vector3 shift(1e6, 1e6, 1e6);
  const MeshDistance query(
      test::transformed(test::box(1, 1, 1), Eigen::Matrix3d::Identity(), shift));
  EXPECT_NEAR(query.distance(shift + Vector3(0.125, 0.0, 0.0)), 0.375, 1e-15);
}

TEST(MeshDistance, PassesOverFacesWithoutArea) {
  IndexedMesh mesh = test::box(1, 1, 1);
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_NEAR(MeshDistance(mesh).distance({0, 0, 2}), 1.5, 1e-15);
  mesh.triangles.assign(1, {0, 0, 1});
  EXPECT_ERROR(MeshDistance{mesh}, InvalidInput);
}

TEST(Distances, NestedCubes) {
  // Cube of edge 1 in one of edge 1.2. From inside out every point is 0.1 away; from outside in the
  // squared distance over a face is 0.01 + e_x^2 + e_y^2, e the part beyond 0.5 in each direction.
  const MeshDistances d = measure_distances(test::box(1, 1, 1), test::box(1.2, 1.2, 1.2),
                                            DistanceOptions(), Execution(1));
  EXPECT_NEAR(d.to_reference.maximum, 0.1, 1e-14);
  EXPECT_NEAR(d.to_reference.root_mean_square, 0.1, 1e-14);
  EXPECT_NEAR(d.to_reference.mean, 0.1, 1e-14);
  EXPECT_NEAR(d.from_reference.maximum, 0.1 * std::sqrt(3.0), 1e-14);
  const double square = 0.01 + 2.0 * (2.0 / 1.2) * 0.001 / 3.0;
  // Documented sampling error 0.5 % at the default 100,000 samples.
  EXPECT_NEAR(d.from_reference.root_mean_square / std::sqrt(square), 1.0, 5e-3);
  EXPECT_EQ(d.largest, d.from_reference.maximum);
  EXPECT_EQ(d.root_mean_square, d.from_reference.root_mean_square);
}

TEST(Distances, SwappingTheMeshesSwapsTheSides) {
  const IndexedMesh a = test::lumpy(2);
  const IndexedMesh b = test::lumpy(4);
  const DistanceOptions options{2000};
  const MeshDistances ab = measure_distances(a, b, options, Execution(1));
  const MeshDistances ba = measure_distances(b, a, options, Execution(1));
  EXPECT_EQ(ab.to_reference.maximum, ba.from_reference.maximum);
  EXPECT_EQ(ab.to_reference.root_mean_square, ba.from_reference.root_mean_square);
  EXPECT_EQ(ab.largest, ba.largest);
}

TEST(Distances, ChordsOfASphere) {
  // Sphere of radius 1 against an inscribed icosphere: the farthest points of the sphere stand over
  // the middles of the largest faces.
  const IndexedMesh coarse = test::sphere(2);
  double deepest = 1.0;
  for (const Triangle& t : coarse.triangles) {
    const Vector3& a = coarse.points[t[0]];
    const Vector3 n = (coarse.points[t[1]] - a).cross(coarse.points[t[2]] - a).normalized();
    deepest = std::min(deepest, n.dot(a));
  }
  const MeshDistances d =
      measure_distances(coarse, test::sphere(5), DistanceOptions{10000}, Execution(1));
  // The fine sphere itself lies within (0.04)^2 / 8 of the true one.
  EXPECT_NEAR(d.largest, 1.0 - deepest, 3e-4);
}

TEST(Distances, SamplesAreSpreadByAreaAndLieOnTheSurface) {
  const IndexedMesh mesh = test::box(1, 2, 3);
  const std::vector<Vector3> samples = area_uniform_samples(mesh, 10000);
  ASSERT_EQ(samples.size(), 10000U);
  int on_z = 0;
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : samples) {
    const Vector3 share = p.cwiseAbs().cwiseQuotient(Vector3(0.5, 1.0, 1.5));
    EXPECT_NEAR(share.maxCoeff(), 1.0, 1e-14);
    if (share.z() > 1.0 - 1e-12) ++on_z;
    mean += p / 10000.0;
  }
  EXPECT_NEAR(on_z, 10000.0 * 4.0 / 22.0, 2.0);  // whole slices of the accumulated area
  EXPECT_LT(mean.norm(), 5e-3);
}

TEST(Distances, SameBitsOnAnyNumberOfThreads) {
  const DistanceOptions options{5000};
  const MeshDistances one =
      measure_distances(test::lumpy(2), test::lumpy(4), options, Execution(1));
  const MeshDistances three =
      measure_distances(test::lumpy(2), test::lumpy(4), options, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(Distances, SameBitsWithATreeAtHand) {
  const IndexedMesh reference = test::lumpy(4);
  const DistanceOptions options{5000};
  const MeshDistances plain = measure_distances(test::lumpy(2), reference, options, Execution(1));
  const MeshDistances with_tree =
      measure_distances(test::lumpy(2), reference, MeshDistance(reference), options, Execution(1));
  EXPECT_EQ(std::memcmp(&plain, &with_tree, sizeof plain), 0);
}

TEST(Distances, RmsIsThatOfTheDistancesOneByOneInWhateverOrderTheFacesAre) {
  IndexedMesh from = test::lumpy(4);
  const IndexedMesh to =
      test::transformed(test::lumpy(3), 1.03 * Eigen::Matrix3d::Identity(), {0.1, 0.0, 0.05});
  const MeshDistance query(to);
  for (const bool shuffled : {false, true}) {
    // The search for a point's nearest face starts from the one before's.
    if (shuffled) std::shuffle(from.triangles.begin(), from.triangles.end(), std::mt19937_64(3));
    double squares = 0.0;
    for (const Vector3& p : area_uniform_samples(from, 3000)) {
      squares += query.distance(p) * query.distance(p);
    }
    const double rms = std::sqrt(squares / 3000.0);
    EXPECT_NEAR(rms_distance(from, to, 3000, Execution(1)) / rms, 1.0, 1e-13);
    EXPECT_EQ(rms_distance(from, to, 3000, Execution(3)),
              rms_distance(from, to, 3000, Execution(1)));
  }
}

TEST(Distances, RefusesWhatCannotBeMeasured) {
  const IndexedMesh box = test::box(1, 1, 1);
  EXPECT_ERROR(measure_distances(box, IndexedMesh(), DistanceOptions(), Execution(1)),
               InvalidInput);
  EXPECT_ERROR(measure_distances(IndexedMesh(), box, DistanceOptions(), Execution(1)),
               InvalidInput);
  EXPECT_ERROR(measure_distances(box, box, DistanceOptions{0}, Execution(1)), InvalidInput);
}

TEST(Distances, CanBeCancelled) {
  const Execution execution(1, [](double fraction, const std::string&) { return fraction < 0.4; });
  try {
    measure_distances(test::lumpy(2), test::lumpy(2), DistanceOptions{100}, execution);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

}  // namespace
}  // namespace wscvt
