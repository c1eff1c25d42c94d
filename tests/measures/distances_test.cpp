// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

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
    std::size_t face = 0;
    query.squared_distance(p, face, 0.0);
    const Vector3 nearest = query.nearest_point_of(face, p);
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
                                            usual_distance_samples, Execution(1));
  EXPECT_NEAR(d.to_reference.maximum, 0.1, 1e-14);
  EXPECT_NEAR(d.to_reference.root_mean_square, 0.1, 1e-14);
  EXPECT_NEAR(d.to_reference.mean, 0.1, 1e-14);
  EXPECT_NEAR(d.from_reference.maximum, 0.1 * std::sqrt(3.0), 1e-14);
  const double square = 0.01 + 2.0 * (2.0 / 1.2) * 0.001 / 3.0;
  // Documented sampling error 0.5 % at the default 50,000 samples.
  EXPECT_NEAR(d.from_reference.root_mean_square / std::sqrt(square), 1.0, 5e-3);
  EXPECT_EQ(d.largest, d.from_reference.maximum);
  EXPECT_EQ(d.root_mean_square, d.from_reference.root_mean_square);
}

TEST(Distances, SwappingTheMeshesSwapsTheSides) {
  const IndexedMesh a = test::lumpy(2);
  const IndexedMesh b = test::lumpy(4);
  constexpr std::size_t samples = 2000;
  const MeshDistances ab = measure_distances(a, b, samples, Execution(1));
  const MeshDistances ba = measure_distances(b, a, samples, Execution(1));
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
  const MeshDistances d = measure_distances(coarse, test::sphere(5), 10000, Execution(1));
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

TEST(Distances, PlacesAreEvenInsideEveryFace) {
  const IndexedMesh mesh = test::tetrahedron(1.0);
  constexpr std::size_t count = 4000;
  const std::vector<MeshPlace> places = area_uniform_places(mesh, count);
  ASSERT_EQ(places.size(), count);
  std::vector<Eigen::Matrix3d> products(4, Eigen::Matrix3d::Zero());
  std::vector<Vector3> means(4, Vector3::Zero());
  for (const MeshPlace& place : places) {
    const Vector3 w(place.weights[0], place.weights[1], place.weights[2]);
    ASSERT_GE(w.minCoeff(), 0.0);
    ASSERT_NEAR(w.sum(), 1.0, 1e-15);
    means[place.triangle] += w / (count / 4);
    products[place.triangle] += w * w.transpose() / (count / 4);
  }
  // Over a triangle the means are 1/3 of a weight, 1/6 of its square and 1/12 of two weights'
  // product. A low-discrepancy sequence of 1000 points errs by about log(1000) / 1000.
  const Eigen::Matrix3d expected = (Eigen::Matrix3d::Ones() + Eigen::Matrix3d::Identity()) / 12.0;
  for (std::size_t face = 0; face < 4; ++face) {
    EXPECT_LT((means[face] - Vector3::Constant(1.0 / 3.0)).cwiseAbs().maxCoeff(), 5e-3);
    EXPECT_LT((products[face] - expected).cwiseAbs().maxCoeff(), 5e-3);
  }
}

TEST(Distances, PlacesFollowTheDensity) {
  // Two faces of one area; the mean densities of their corners are 1 and 3.
  const IndexedMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
                         {{0, 1, 2}, {3, 4, 5}}};
  const std::vector<MeshPlace> places = area_uniform_places(mesh, 400, {0.5, 1.0, 1.5, 1, 2, 6});
  const auto sparse = std::count_if(places.begin(), places.end(),
                                    [](const MeshPlace& place) { return place.triangle == 0; });
  EXPECT_EQ(sparse, 100);
  EXPECT_ERROR(area_uniform_places(mesh, 400, {1.0}), InvalidInput);
}

TEST(Distances, InAnotherUnitAreThoseOfTheScaledMeshes) {
  const IndexedMesh mesh = test::lumpy(2);
  const IndexedMesh reference = test::lumpy(3);
  const double unit = 0.25;  // exact
  const auto measured = [&](double size) {
    return measure_distances(test::scaled(mesh, Vector3::Constant(size)),
                             test::scaled(reference, Vector3::Constant(size)), 500, Execution(1));
  };
  MeshDistances scaled = measured(1.0);
  scale(scaled, unit);
  const MeshDistances expected = measured(unit);
  EXPECT_EQ(std::memcmp(&scaled, &expected, sizeof scaled), 0);
}

TEST(Distances, AreTakenAtTheVerticesToo) {
  // A spike of no more area than a handful of samples: its tip alone is 3 away.
  IndexedMesh spike = test::box(1, 1, 1);
  for (Vector3& p : spike.points) {
    if (p.minCoeff() > 0.0) p *= 7.0;
  }
  const MeshDistances d = measure_distances(spike, test::box(1, 1, 1), 1, Execution(1));
  EXPECT_NEAR(d.to_reference.maximum, 3.0 * std::sqrt(3.0), 1e-14);
  // A vertex without a face is no part of the surface.
  IndexedMesh stray = spike;
  stray.points.emplace_back(90.0, 0.0, 0.0);
  for (const MeshDistances& one : {measure_distances(stray, test::box(1, 1, 1), 1, Execution(1)),
                                   sampled_distances(stray, test::box(1, 1, 1), 1, Execution(1))}) {
    EXPECT_NEAR(one.largest, 3.0 * std::sqrt(3.0), 1e-14);
  }
}

/// The largest distance from points of each face, `steps` on an edge.
double largest_by_points(const IndexedMesh& from, const IndexedMesh& to, int steps) {
  const MeshDistance query(to);
  double largest = 0.0;
  for (const Triangle& t : from.triangles) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vector3 p =
            (i * from.points[t[0]] + j * from.points[t[1]] + (steps - i - j) * from.points[t[2]]) /
            steps;
        largest = std::max(largest, query.distance(p));
      }
    }
  }
  return largest;
}

// In the middle of a face and on an edge, where neither a vertex nor one of few samples is.
TEST(Distances, TheLargestIsFoundInsideFaces) {
  const IndexedMesh scan = test::lumpy(4);
  for (const double angle : {0.0, 0.4, 1.1}) {
    const IndexedMesh coarse = test::transformed(
        test::lumpy(1), Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix());
    const double to = largest_by_points(coarse, scan, 48);
    const double from = largest_by_points(scan, coarse, 4);
    const MeshDistances d = measure_distances(coarse, scan, 1, Execution(2));
    // The points are a hundredth of the size apart, and the distance is flat where it is largest.
    EXPECT_GE(d.to_reference.maximum, 0.99 * to);
    EXPECT_LE(d.to_reference.maximum, 1.01 * to);
    EXPECT_GE(d.from_reference.maximum, 0.99 * from);
    EXPECT_LE(d.from_reference.maximum, 1.01 * from);
    const MeshDistances few = sampled_distances(coarse, scan, 500, Execution(2));
    EXPECT_NEAR(few.largest, d.largest, 0.01 * d.largest);
  }
}

// The search ends although all points are equally far, and although none is.
TEST(Distances, OfShellsAndOfTheMeshItself) {
  const IndexedMesh inner = test::sphere(3);
  const IndexedMesh outer = test::scaled(inner, Vector3::Constant(1.5));
  const MeshDistances d = measure_distances(inner, outer, 10, Execution(1));
  EXPECT_NEAR(d.from_reference.maximum, 0.5, 1e-12);
  EXPECT_NEAR(d.to_reference.maximum, 0.5, 5e-3);
  EXPECT_NEAR(measure_distances(inner, inner, 10, Execution(1)).largest, 0.0, 1e-15);
}

TEST(Distances, SameBitsOnAnyNumberOfThreads) {
  constexpr std::size_t samples = 5000;
  const MeshDistances one =
      measure_distances(test::lumpy(2), test::lumpy(4), samples, Execution(1));
  const MeshDistances three =
      measure_distances(test::lumpy(2), test::lumpy(4), samples, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(Distances, SameBitsWithATreeAtHand) {
  const IndexedMesh reference = test::lumpy(4);
  constexpr std::size_t samples = 5000;
  const MeshDistances plain = measure_distances(test::lumpy(2), reference, samples, Execution(1));
  const MeshDistances with_tree =
      measure_distances(test::lumpy(2), reference, MeshDistance(reference), samples, Execution(1));
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
  EXPECT_ERROR(measure_distances(box, IndexedMesh(), usual_distance_samples, Execution(1)),
               InvalidInput);
  EXPECT_ERROR(measure_distances(IndexedMesh(), box, usual_distance_samples, Execution(1)),
               InvalidInput);
  for (const std::size_t samples : {0, 100'000'001}) {
    EXPECT_ERROR(measure_distances(box, box, samples, Execution(1)), InvalidInput);
    EXPECT_ERROR(sampled_distances(box, box, samples, Execution(1)), InvalidInput);
    EXPECT_ERROR(rms_distance(box, box, samples, Execution(1)), InvalidInput);
  }
}

TEST(Distances, CanBeCancelled) {
  const Execution execution(1, [](double fraction, const std::string&) { return fraction < 0.4; });
  try {
    measure_distances(test::lumpy(2), test::lumpy(2), 100, execution);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

/// Root mean square of the distances from one surface to another, by a tree of all faces.
double rms_by_tree(const IndexedMesh& from, const IndexedMesh& to, std::size_t samples) {
  double squares = 0.0;
  for (const double d :
       MeshDistance(to).distances(area_uniform_samples(from, samples), Execution(1))) {
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(samples));
}

/// To a mesh of many faces there is no tree, unless the other surface is far off.
TEST(SampledDistances, OfManyFacesAreThoseOfATree) {
  constexpr std::size_t samples = 200;
  const IndexedMesh scan = test::lumpy(6);
  ASSERT_GT(scan.triangles.size(), 100 * samples);
  IndexedMesh flat = test::sphere(2);
  for (Vector3& p : flat.points) p.z() *= 0.3;
  for (const IndexedMesh& mesh :
       {test::lumpy(2), test::sphere(2), flat,
        test::transformed(test::lumpy(2), Eigen::Matrix3d::Identity(), Vector3(40, 0, 0))}) {
    const MeshDistances measured = sampled_distances(mesh, scan, samples, Execution(2));
    // The sums' last digits follow the order of adding.
    const double to = rms_by_tree(mesh, scan, samples);
    EXPECT_NEAR(measured.to_reference.root_mean_square, to, 1e-14 * to);
    const double from = rms_by_tree(scan, mesh, samples);
    EXPECT_NEAR(measured.from_reference.root_mean_square, from, 1e-14 * from);
    const auto farthest = [](const IndexedMesh& one, const IndexedMesh& other) {
      std::vector<Vector3> points = area_uniform_samples(one, samples);
      points.insert(points.end(), one.points.begin(), one.points.end());
      const std::vector<double> distances = MeshDistance(other).distances(points, Execution(1));
      return *std::max_element(distances.begin(), distances.end());
    };
    EXPECT_GE(measured.to_reference.maximum, farthest(mesh, scan) - 1e-14);
    // The search of all faces is at most 1 % below the largest.
    const MeshDistances all = measure_distances(mesh, scan, 1, Execution(2));
    EXPECT_LE(measured.to_reference.maximum, 1.01 * all.to_reference.maximum);
    EXPECT_NEAR(measured.from_reference.maximum, farthest(scan, mesh), 1e-14);
  }
}

// No sample lies at a tip, and a remesh cuts it off.
TEST(SampledDistances, FindTheTipOfAScan) {
  IndexedMesh tip = test::sphere(4);
  const Vector3 pole = tip.points[7];
  tip.points[7] = 1.25 * pole;
  const MeshDistances there = sampled_distances(test::sphere(4), tip, 50, Execution(2));
  EXPECT_NEAR(there.largest, 0.25, 1e-12);
  EXPECT_NEAR(sampled_distances(tip, test::sphere(4), 50, Execution(1)).largest, 0.25, 1e-12);
}

// The last face lies deeper than all others, and deepest in its middle, where no sample is.
TEST(SampledDistances, LookIntoTheFacesThatAreFarthestByTheirCorners) {
  IndexedMesh mesh = test::shuffled(test::sphere(2), test::announced(5));
  for (const std::int32_t corner : mesh.triangles.back()) mesh.points[corner] *= 0.9;
  const IndexedMesh scan = test::sphere(5);
  const double deepest = largest_by_points(mesh, scan, 24);
  EXPECT_GT(deepest, 0.105);
  EXPECT_NEAR(sampled_distances(mesh, scan, 1, Execution(1)).to_reference.maximum, deepest,
              0.01 * deepest);
}

/// The neighbours of a face without area cover it, also where it sticks out.
TEST(SampledDistances, PassOverFacesWithoutArea) {
  IndexedMesh scan = test::sphere(5);
  IndexedMesh mesh = test::moved(test::sphere(2), 1.02, Vector3::Zero());
  mesh.points[3] *= 1.1;
  const double farthest = sampled_distances(mesh, scan, 300, Execution(1)).to_reference.maximum;
  EXPECT_NEAR(farthest, 0.122, 1e-3);
  const auto tip = static_cast<std::int32_t>(scan.points.size());
  scan.points.push_back(mesh.points[3]);
  for (std::int32_t corner = 0; corner < 40; ++corner) scan.triangles.push_back({corner, tip, tip});
  EXPECT_EQ(sampled_distances(mesh, scan, 300, Execution(1)).to_reference.maximum, farthest);
}

/// A few large faces beside many small ones, which a choice by number would leave out.
TEST(SampledDistances, FindLargeFacesAmongManySmallOnes) {
  IndexedMesh mixed = test::box(10, 10, 10);
  IndexedMesh fine = test::sphere(5);
  for (Vector3& p : fine.points) p = 0.01 * p + Vector3(5, 5, 5);
  const auto shift = static_cast<std::int32_t>(mixed.points.size());
  mixed.points.insert(mixed.points.end(), fine.points.begin(), fine.points.end());
  for (const Triangle& t : fine.triangles) {
    mixed.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  const IndexedMesh near = test::box(10.1, 10.1, 10.1);
  const double expected = rms_by_tree(near, mixed, 300);
  EXPECT_NEAR(sampled_distances(near, mixed, 300, Execution(1)).to_reference.root_mean_square,
              expected, 1e-14 * expected);
}

}  // namespace
}  // namespace wscvt
