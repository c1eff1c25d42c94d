// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/clump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <vector>

#include "support/distance_bodies.h"
#include "support/expect_error.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/clump/sphere.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"

namespace wscvt {
namespace {

using test::holds;

ClumpResult clump_of(const IndexedMesh& scan, int spheres, int threads = 2) {
  ClumpOptions options;
  options.sphere_count = spheres;
  return make_clump(scan, options, Execution(threads));
}

/// The spheres, the largest first.
std::vector<Sphere> by_size(std::vector<Sphere> spheres) {
  std::sort(spheres.begin(), spheres.end(),
            [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
  return spheres;
}

/// The union of spheres as a scanner sees it.
IndexedMesh scan_of_spheres(const std::vector<Sphere>& spheres) {
  const auto distance = [spheres](const Vector3& p) {
    double least = 1e9;
    for (const Sphere& sphere : spheres) least = std::min(least, sphere.distance(p));
    return least;
  };
  return test::scan_of(distance, 2.3, 0.12);
}

/// A body without symmetry.
const IndexedMesh& bent_body() {
  static const IndexedMesh body = scan_of_spheres({{{0.1, 0.2, 0.0}, 1.0},
                                                   {{1.1, 0.3, 0.2}, 0.7},
                                                   {{0.2, -0.9, 0.4}, 0.6},
                                                   {{0.0, 0.5, -0.9}, 0.5},
                                                   {{1.6, 0.8, 0.1}, 0.35}});
  return body;
}

/// Of a lumpy ball, made once: many tests look at it.
const ClumpResult& clump_of_the_lumpy(int spheres) {
  static std::map<int, ClumpResult> made;
  const auto at = made.find(spheres);
  if (at != made.end()) return at->second;
  return made.emplace(spheres, clump_of(test::lumpy(3), spheres, 1)).first->second;
}

double percent(const ClumpResult& clump, double length) {
  return 100.0 * length / clump.equivalent_radius;
}

TEST(Clump, OfASphereIsTheSphere) {
  const IndexedMesh scan = test::moved(test::sphere(4), 2.5, {7.0, -3.0, 11.0});
  const ClumpResult clump = clump_of(scan, 1);
  ASSERT_EQ(clump.spheres.size(), 1U);
  // Of a mesh with vertices on the sphere the faces lie within it, by 0.1 % of the radius here.
  EXPECT_LT((clump.spheres[0].centre - Vector3(7.0, -3.0, 11.0)).norm(), 1e-3);
  EXPECT_NEAR(clump.spheres[0].radius, 2.5, 3e-3);
  EXPECT_LT(percent(clump, clump.largest_distance), 0.3);
  EXPECT_GT(clump.intersection_over_union, 0.99);
  EXPECT_NEAR(clump.contact.mean, 0.0, 0.3);
  EXPECT_LT(clump.contact.scatter, 0.2);
  EXPECT_TRUE(clump.warnings.empty());
}

TEST(Clump, FindsTheSpheresThatABodyIsMadeOf) {
  const std::vector<Sphere> made = {{{0.2, 0.1, 0.0}, 1.0}, {{1.2, 0.4, -0.3}, 0.7}};
  const std::vector<Sphere> found = by_size(clump_of(scan_of_spheres(made), 2).spheres);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    // The faces lie within the spheres by up to 0.12^2 / 8.
    EXPECT_LT((found[k].centre - made[k].centre).norm(), 4e-3) << k;
    EXPECT_NEAR(found[k].radius, made[k].radius, 4e-3) << k;
  }
}

TEST(Clump, OfAPlateARodAndARingComesNear) {
  const auto error_of = [](const IndexedMesh& scan, int spheres) {
    const ClumpResult clump = clump_of(scan, spheres);
    EXPECT_EQ(clump.spheres.size(), static_cast<std::size_t>(spheres));
    EXPECT_NEAR(clump.united.error.volume_percent, 0.0, 8.0);
    return percent(clump, clump.rms_distance);
  };
  EXPECT_LT(error_of(test::scan_of(test::rounded_box({2.0, 1.5, 0.3}, 0.1), 2.2, 0.08), 40), 6.0);
  EXPECT_LT(error_of(test::scan_of(test::capsule(3.0, 0.4), 3.6, 0.1), 12), 3.0);
  EXPECT_LT(error_of(test::torus(2.0, 0.5, 60), 16), 4.0);
}

// Spheres that fill the hollow, which nothing on the surface forbids, give 49 % more volume and an
// intersection over union of .52; measured here: -1.9 % and .74.
TEST(Clump, OfACupLeavesTheHollowEmpty) {
  const auto cup = [](const Vector3& p) {
    return std::max(p.norm() - 1.0, 0.7 - (p - Vector3(0.0, 0.1, 0.45)).norm());
  };
  const ClumpResult clump = clump_of(test::scan_of(cup, 1.2, 0.08), 25);
  EXPECT_NEAR(clump.united.error.volume_percent, 0.0, 8.0);
  EXPECT_GT(clump.intersection_over_union, 0.7);
}

// Spheres without a limit were 17 times the equivalent radius here, with a side of the plate for a
// part of their surface.
TEST(Clump, OfAVeryThinPlateStaysAboutIt) {
  const IndexedMesh plate =
      test::transformed(test::sphere(4), Vector3(1.0, 0.8, 0.03).asDiagonal());
  const ClumpResult clump = clump_of(plate, 6);
  for (const Sphere& sphere : clump.spheres) {
    EXPECT_LT(sphere.centre.norm(), 1.0);
    EXPECT_LT(sphere.radius, 0.1);
  }
  ASSERT_FALSE(clump.warnings.empty());
  EXPECT_TRUE(holds(clump.warnings[0].text(), "Give more spheres"));
}

TEST(Clump, BodiesThatAreLeftOutAreTold) {
  IndexedMesh scan = test::sphere(3);
  const IndexedMesh other = test::moved(test::sphere(2), 0.4, {3.0, 0.5, 0.0});
  const auto first = static_cast<std::int32_t>(scan.points.size());
  scan.points.insert(scan.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) {
    scan.triangles.push_back({a + first, b + first, c + first});
  }
  const ClumpResult clump = clump_of(scan, 1);
  ASSERT_EQ(clump.warnings.size(), 1U);
  EXPECT_TRUE(holds(clump.warnings[0].text(), "2 separate bodies"));
}

TEST(Clump, BetterWithMoreSpheres) {
  double before = 1e9;
  for (const int count : {1, 3, 8, 20}) {
    const ClumpResult& clump = clump_of_the_lumpy(count);
    EXPECT_LT(clump.rms_distance, 0.8 * before) << count;
    before = clump.rms_distance;
    EXPECT_EQ(clump.stages.back().spheres, static_cast<std::size_t>(count));
    EXPECT_DOUBLE_EQ(clump.stages.back().rms_distance, clump.rms_distance);
  }
}

// Without the last change of the radii one of these is off by 2.2 %.
TEST(Clump, HasTheVolumeOfTheGrain) {
  // The union's mesh has another grid than in the fit.
  for (const int count : {3, 8, 20}) {
    EXPECT_NEAR(clump_of_the_lumpy(count).united.error.volume_percent, 0.0, 0.15) << count;
  }
  for (const int count : {3, 5, 10}) {
    EXPECT_NEAR(clump_of(bent_body(), count).united.error.volume_percent, 0.0, 0.15) << count;
  }
}

// The fit may move all spheres out of a thin rough plate. The largest one that fits remains.
TEST(Clump, InsideAThinRoughPlateThereIsASphere) {
  IndexedMesh plate = test::sphere(1);
  for (Vector3& p : plate.points) {
    p *= 1.0 + 0.85 * std::sin(31.0 * p.x() + 91.0 * p.y() + 53.0 * p.z());
    p = Vector3(p.x(), 9.0 * p.y(), 0.1 * p.z());
  }
  ClumpOptions options;
  options.inside = true;
  options.sphere_count = 3;
  const ClumpResult clump = make_clump(plate, options, Execution(1));
  ASSERT_EQ(clump.spheres.size(), 1U);
  const InscribedSphere largest = largest_inscribed_sphere(plate, Execution(1));
  EXPECT_LE(clump.spheres.front().radius, largest.upper_bound);
  // The search in the clump's own frame ends at another place.
  EXPECT_GT(clump.spheres.front().radius, 0.99 * largest.radius);
}

TEST(Clump, InsideNoSphereReachesOut) {
  const IndexedMesh scan = bent_body();
  ClumpOptions options;
  options.sphere_count = 9;
  options.inside = true;
  const ClumpResult clump = make_clump(scan, options, Execution(2));
  ASSERT_EQ(clump.spheres.size(), 9U);
  const MeshDistance surface(scan);
  for (const Sphere& sphere : clump.spheres) {
    EXPECT_TRUE(surface.contains(sphere.centre));
    EXPECT_GE(surface.distance(sphere.centre), sphere.radius);
    // And it touches.
    EXPECT_NEAR(surface.distance(sphere.centre), sphere.radius, 1e-6);
  }
  EXPECT_LT(clump.united.error.volume_percent, 0.0);
}

TEST(Clump, SmallestRadiusIsKept) {
  for (const bool inside : {false, true}) {
    ClumpOptions options;
    options.sphere_count = 12;
    options.smallest_radius_percent = 40.0;
    options.inside = inside;
    const ClumpResult clump = make_clump(bent_body(), options, Execution(2));
    for (const Sphere& sphere : clump.spheres) {
      EXPECT_GE(sphere.radius, 0.4 * clump.equivalent_radius * (1.0 - 1e-6)) << inside;
    }
  }
  ClumpOptions options;
  options.smallest_radius_percent = 95.0;
  options.inside = true;
  const std::string sentence = test::refusal(
      ErrorCode::InvalidInput, [&] { make_clump(bent_body(), options, Execution(2)); });
  EXPECT_TRUE(holds(sentence, "--smallest-radius"));
}

TEST(Clump, AllowedErrorIsMetByFewSpheres) {
  const IndexedMesh scan = test::lumpy(3);
  ClumpOptions options;
  options.max_error_percent = 4.0;
  options.most_spheres = 60;
  const ClumpResult clump = make_clump(scan, options, Execution(2));
  EXPECT_LE(percent(clump, clump.rms_distance), 4.0);
  EXPECT_LT(clump.spheres.size(), 60U);
  // A fifth fewer do not meet it.
  const auto fewer = static_cast<int>(clump.spheres.size() * 4 / 5);
  const ClumpResult& smaller = clump_of_the_lumpy(fewer);
  EXPECT_GT(percent(smaller, smaller.rms_distance), 4.0);
  options.most_spheres = 3;
  const ClumpResult short_of = make_clump(scan, options, Execution(2));
  EXPECT_EQ(short_of.spheres.size(), 3U);
  ASSERT_EQ(short_of.warnings.size(), 1U);
  EXPECT_TRUE(holds(short_of.warnings[0].text(), "more spheres"));
}

// Each kind of error is met, and clumps with a fifth fewer spheres have more of it.
TEST(Clump, AllowedErrorsOfVolumeInertiaAndFirstContactAreMet) {
  const IndexedMesh scan = test::lumpy(3);
  const auto error_of = [](ClumpError of, const ClumpResult& clump) {
    if (of == ClumpError::Volume) return 100.0 * (1.0 - clump.intersection_over_union);
    if (of == ClumpError::Inertia) return clump.united.error.inertia_percent;
    return std::hypot(clump.contact.mean, clump.contact.scatter);
  };
  for (const ClumpError of : {ClumpError::Volume, ClumpError::Inertia, ClumpError::Contact}) {
    ClumpOptions options;
    options.error_measure = of;
    options.max_error_percent = of == ClumpError::Inertia ? 0.8 : 8.0;
    options.most_spheres = 60;
    const ClumpResult clump = make_clump(scan, options, Execution(2));
    // The union's mesh in another frame has another grid.
    EXPECT_LE(error_of(of, clump), options.max_error_percent + 0.05) << key_of(of);
    ASSERT_GT(clump.spheres.size(), 1U) << key_of(of);
    EXPECT_LT(clump.spheres.size(), 60U) << key_of(of);
    EXPECT_TRUE(clump.warnings.empty()) << key_of(of);
    // The inertia's error may be small with few spheres by chance.
    if (of == ClumpError::Inertia) continue;
    const ClumpResult& fewer =
        clump_of_the_lumpy(std::max(1, static_cast<int>(clump.spheres.size()) * 4 / 5));
    EXPECT_GT(error_of(of, fewer), options.max_error_percent) << key_of(of);
  }
  ClumpOptions options;
  options.error_measure = ClumpError::Contact;
  options.max_error_percent = 0.5;
  options.most_spheres = 3;
  const ClumpResult clump = make_clump(scan, options, Execution(2));
  ASSERT_EQ(clump.warnings.size(), 1U);
  EXPECT_TRUE(holds(clump.warnings[0].text(), "first contact"));
}

TEST(Clump, MovesTurnsAndGrowsWithTheScan) {
  const IndexedMesh scan = bent_body();
  const ClumpResult clump = clump_of(scan, 6);
  const Eigen::Matrix3d turn = test::random_rotation(5);
  const Vector3 shift(30.0, -20.0, 4.0);
  const IndexedMesh other = test::moved(test::transformed(scan, turn, Vector3::Zero()), 3.0, shift);
  const ClumpResult moved = clump_of(other, 6);
  ASSERT_EQ(moved.spheres.size(), clump.spheres.size());
  for (std::size_t k = 0; k < clump.spheres.size(); ++k) {
    // Rounding, which the steps of the fit multiply.
    EXPECT_LT((moved.spheres[k].centre - (3.0 * (turn * clump.spheres[k].centre) + shift)).norm(),
              1e-5);
    EXPECT_NEAR(moved.spheres[k].radius, 3.0 * clump.spheres[k].radius, 1e-5);
  }
  EXPECT_NEAR(moved.rms_distance, 3.0 * clump.rms_distance, 1e-6);
  EXPECT_NEAR(moved.contact.mean, clump.contact.mean, 1e-3);
  // The union has a mesh of its own in each pose.
  const auto turned = [&](const SphereMass& before, const SphereMass& after) {
    const Eigen::Matrix3d axes = turn * before.mass.principal_axes.toRotationMatrix();
    return (axes - after.mass.principal_axes.toRotationMatrix()).norm();
  };
  EXPECT_LT(turned(clump.summed, moved.summed), 1e-4);
  EXPECT_LT(turned(clump.united, moved.united), 0.02);
}

TEST(Clump, IsTheSameOnAnyNumberOfThreads) {
  const ClumpResult& one = clump_of_the_lumpy(8);
  const ClumpResult three = clump_of(test::lumpy(3), 8, 3);
  ASSERT_EQ(one.spheres.size(), three.spheres.size());
  for (std::size_t k = 0; k < one.spheres.size(); ++k) {
    EXPECT_EQ(std::memcmp(&one.spheres[k], &three.spheres[k], sizeof(Sphere)), 0) << k;
  }
  EXPECT_EQ(one.contact.mean, three.contact.mean);
  EXPECT_EQ(one.intersection_over_union, three.intersection_over_union);
}

TEST(Clump, TellsTheMassOfUnionAndSum) {
  // The sum counts twice what two spheres share.
  const ClumpResult clump =
      clump_of(scan_of_spheres({{{0.0, 0.0, 0.0}, 1.0}, {{0.8, 0.5, 0.1}, 0.8}}), 2);
  EXPECT_NEAR(clump.united.error.volume_percent, 0.0, 0.3);
  EXPECT_NEAR(clump.united.error.inertia_percent, 0.0, 0.5);
  double sum = 0.0;
  for (const Sphere& sphere : clump.spheres) sum += 4.0 / 3.0 * pi * std::pow(sphere.radius, 3);
  EXPECT_NEAR(clump.summed.mass.volume, sum, 1e-12);
  EXPECT_NEAR(clump.summed.error.volume_percent, 100.0 * (sum / clump.scan.volume - 1.0), 1e-9);
  // Steiner: the trace of a ball's tensor about its own centre is 1.2 V r^2, and moving it adds 2 V
  // d^2.
  double trace = 0.0;
  for (const Sphere& sphere : clump.spheres) {
    const double square = sphere.radius * sphere.radius;
    trace += 4.0 / 3.0 * pi * square * sphere.radius *
             (1.2 * square + 2.0 * (sphere.centre - clump.summed.mass.centroid).squaredNorm());
  }
  EXPECT_NEAR(clump.summed.mass.inertia_tensor.trace(), trace, 1e-12 * trace);
  EXPECT_GT(clump.summed.error.volume_percent, 10.0);
  EXPECT_GT(clump.summed.error.inertia_percent, 1.0);
}

TEST(Clump, SpheresApartAreTold) {
  ClumpOptions options;
  options.sphere_count = 2;
  options.inside = true;
  const ClumpResult clump =
      make_clump(test::scan_of(test::capsule(3.0, 0.4), 3.6, 0.1), options, Execution(2));
  ASSERT_FALSE(clump.warnings.empty());
  EXPECT_TRUE(holds(clump.warnings.back().text(), "2 groups"));
}

TEST(Clump, RefusesOptionsOutOfRange) {
  const auto with = [](auto change) {
    ClumpOptions options;
    change(options);
    return options;
  };
  EXPECT_ERROR(check_clump_options(with([](ClumpOptions& o) { o.sphere_count = 0; })),
               InvalidInput);
  EXPECT_ERROR(check_clump_options(with([](ClumpOptions& o) { o.max_error_percent = 100.0; })),
               InvalidInput);
  EXPECT_ERROR(check_clump_options(with([](ClumpOptions& o) { o.most_spheres = 1001; })),
               InvalidInput);
  EXPECT_ERROR(check_clump_options(with([](ClumpOptions& o) { o.smallest_radius_percent = -1.0; })),
               InvalidInput);
}

}  // namespace

namespace {

TEST(SphereMesh, OfTwoSpheresHasTheirVolume) {
  const double r = 1.3;
  const double s = 0.9;
  const double d = 1.5;
  const Vector3 first(4.0, -2.0, 7.0);
  const Vector3 second = first + d * Vector3(2.0, -1.0, 0.5).normalized();
  const IndexedMesh mesh = sphere_union_mesh({{first, r}, {second, s}}, Execution(1));
  EXPECT_EQ(test::bad_edges(mesh), 0U);
  // The lens that both share.
  const double lens =
      pi * std::pow(r + s - d, 2) * (d * d + 2 * d * (r + s) - 3 * std::pow(r - s, 2)) / (12 * d);
  const double volume = 4.0 / 3.0 * pi * (r * r * r + s * s * s) - lens;
  EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume / volume, 1.0, 3e-3);
  const Vector3 centroid = describe_shape(mesh, Execution(1)).centroid;
  EXPECT_NEAR((centroid - first).cross(second - first).norm(), 0.0, 1e-2);
  for (const Vector3& p : mesh.points) {
    const double distance = std::min((p - first).norm() - r, (p - second).norm() - s);
    EXPECT_NEAR(distance, 0.0, 1e-4);
  }
}

TEST(SphereMesh, OfASmallSphereBesideALargeOneHasBoth) {
  const IndexedMesh mesh =
      sphere_union_mesh({{{0, 0, 0}, 1.0}, {{1.02, 0.1, 0.05}, 0.06}}, Execution(1));
  EXPECT_EQ(test::bad_edges(mesh), 0U);
  double reach = 0.0;
  for (const Vector3& p : mesh.points) reach = std::max(reach, p.x());
  EXPECT_NEAR(reach, 1.08, 5e-3);
}

TEST(SphereMesh, RefusesNoSphereAndNoRadius) {
  EXPECT_ERROR(sphere_union_mesh({}, Execution(1)), InvalidInput);
  EXPECT_ERROR(sphere_union_mesh({{{0, 0, 0}, 0.0}}, Execution(1)), InvalidInput);
  EXPECT_ERROR(
      sphere_union_mesh({{{0, 0, 0}, std::numeric_limits<double>::infinity()}}, Execution(1)),
      InvalidInput);
}

}  // namespace
}  // namespace wscvt
