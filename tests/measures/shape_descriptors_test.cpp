// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

ShapeDescriptors describe(const IndexedMesh& mesh) { return describe_shape(mesh, Execution(1)); }

TEST(ShapeDescriptors, BoxIsExact) {
  const ShapeDescriptors d = describe(test::box(1, 2, 3));
  EXPECT_NEAR(d.volume, 6.0, 1e-14);
  EXPECT_NEAR(d.area, 22.0, 1e-13);
  EXPECT_NEAR(d.sphericity, std::cbrt(36.0 * test::pi * 36.0) / 22.0, 1e-14);
  // Mean x^2 of a box is edge^2 / 12 = semi-axis^2 / 5.
  EXPECT_NEAR(d.inertia_semi_axes[0], std::sqrt(5.0 / 12.0), 1e-14);
  EXPECT_NEAR(d.inertia_semi_axes[1], 2 * std::sqrt(5.0 / 12.0), 1e-14);
  EXPECT_NEAR(d.inertia_semi_axes[2], 3 * std::sqrt(5.0 / 12.0), 1e-14);
  EXPECT_NEAR(d.aspect_ratio, 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(d.centroid.norm(), 0.0, 1e-14);
}

TEST(ShapeDescriptors, RegularTetrahedronIsExact) {
  const ShapeDescriptors d = describe(test::tetrahedron(2.0));
  EXPECT_NEAR(d.volume, 8.0 / (6.0 * std::sqrt(2.0)), 1e-14);
  EXPECT_NEAR(d.area, 4.0 * std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(d.aspect_ratio, 1.0, 1e-14);
  // The radius stands upright on every face at its centroid, so the one-point rule sees no slope.
  EXPECT_NEAR(d.sdq, 0.0, 1e-7);
}

TEST(ShapeDescriptors, SphereConverges) {
  // Chords: errors fall with the square of the edge length; 327680 faces, edge 0.01.
  const ShapeDescriptors d = describe(test::sphere(7));
  EXPECT_NEAR(d.volume / (4.0 / 3.0 * test::pi), 1.0, 1e-4);
  EXPECT_NEAR(d.area / (4.0 * test::pi), 1.0, 1e-4);
  EXPECT_NEAR(d.sphericity, 1.0, 1e-4);
  EXPECT_LE(d.sphericity, 1.0);
  EXPECT_NEAR(d.aspect_ratio, 1.0, 1e-12);
  EXPECT_NEAR(d.sdq, 0.0, 1e-2);
}

TEST(ShapeDescriptors, EllipsoidAxesAndSdq) {
  const Vector3 axes(0.5, 0.7, 1.0);
  const ShapeDescriptors d = describe(test::scaled(test::sphere(7), axes));
  EXPECT_NEAR(d.volume / (4.0 / 3.0 * test::pi * axes.prod()), 1.0, 1e-4);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(d.inertia_semi_axes[k], axes[k], 1e-4);
  EXPECT_NEAR(d.aspect_ratio, 0.5, 1e-9);  // an affine image keeps the chords' error out of ratios

  // Integral of |grad_Omega r|^2 with r = q^(-1/2), q = u^T D u: grad r = -r^3 (D u - q u).
  double gradient_square = 0.0;
  double area = 0.0;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    const double z = -1.0 + (2.0 * i + 1.0) / n;
    for (int j = 0; j < 2 * n; ++j) {
      const double azimuth = test::pi * (j + 0.5) / n;
      const double s = std::sqrt(1.0 - z * z);
      const Vector3 u(s * std::cos(azimuth), s * std::sin(azimuth), z);
      const Vector3 v = u.cwiseQuotient(axes.cwiseAbs2());
      const double q = u.dot(v);
      const double r = 1.0 / std::sqrt(q);
      const double slope = (r * r * r * (v - q * u)).squaredNorm();
      gradient_square += slope;
      area += r * std::sqrt(r * r + slope);
    }
  }
  // The midpoint rule above and the faces below both err by about 1e-5.
  EXPECT_NEAR(d.sdq / std::sqrt(gradient_square / area), 1.0, 3e-4);
}

TEST(ShapeDescriptors, DoNotDependOnPoseOrOrderAndScaleAsTheyShould) {
  const IndexedMesh mesh = test::lumpy(4);
  const ShapeDescriptors reference = describe(mesh);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double scale = 1e-6;
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const ShapeDescriptors d =
        describe(test::shuffled(test::transformed(mesh, scale * rotation), seed));
    EXPECT_NEAR(d.volume / std::pow(scale, 3) / reference.volume, 1.0, 1e-12);
    EXPECT_NEAR(d.area / std::pow(scale, 2) / reference.area, 1.0, 1e-12);
    EXPECT_NEAR(d.aspect_ratio, reference.aspect_ratio, 1e-12);
    EXPECT_NEAR(d.sphericity, reference.sphericity, 1e-12);
    EXPECT_NEAR(d.sdq, reference.sdq, 1e-11);
    EXPECT_LT((d.centroid / scale - rotation * reference.centroid).norm(), 1e-12);
    EXPECT_LT((d.inertia_semi_axes / scale - reference.inertia_semi_axes).norm(), 1e-12);
  }
}

TEST(ShapeDescriptors, InertiaTensorOfABoxIsExact) {
  // Unit density: I_xx = V (y^2 + z^2) / 12 with the full edges, and in turn.
  const Eigen::Matrix3d upright = Vector3(6.5, 5.0, 2.5).asDiagonal();
  // Rounding of entries near 5, after a handful of operations on each of twelve faces.
  EXPECT_LT((describe(test::box(1, 2, 3)).inertia_tensor - upright).norm(), 1e-13);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const Eigen::Matrix3d tensor =
        describe(test::transformed(test::box(1, 2, 3), rotation, {7, 8, 9})).inertia_tensor;
    // A shift of ten edges costs one more digit.
    EXPECT_LT((tensor - rotation * upright * rotation.transpose()).norm(), 1e-12);
  }
}

TEST(ShapeDescriptors, InertiaTensorTurnsAndScalesWithTheBody) {
  const IndexedMesh mesh = test::lumpy(4);
  const Eigen::Matrix3d reference = describe(mesh).inertia_tensor;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const double scale = seed == 1 ? 1e-6 : 300.0;
    const Eigen::Matrix3d rotation = test::random_rotation(seed);
    const Eigen::Matrix3d tensor =
        describe(test::transformed(mesh, scale * rotation)).inertia_tensor;
    const Eigen::Matrix3d turned = rotation * reference * rotation.transpose();
    // Thousands of faces, each rounded, and the fifth power of the scale.
    EXPECT_LT((tensor / std::pow(scale, 5) - turned).norm() / reference.norm(), 1e-12);
  }
}

TEST(ShapeDescriptors, DoNotDependOnWhereTheVerticesLieOnTheFaces) {
  // Most vertices of this box are on one face, far from the centroid.
  IndexedMesh box = test::transformed(test::box(1, 2, 3), Eigen::Matrix3d::Identity(), {7, 8, 9});
  for (int i = 0; i < 30; ++i) {
    const auto v = static_cast<std::int32_t>(box.points.size());
    const auto [a, b, c] = box.triangles[i];
    box.points.push_back((box.points[a] + box.points[b] + box.points[c]) / 3.0);
    box.triangles[i] = {a, b, v};
    // Its other two thirds are next in turn; what was there comes last.
    box.triangles.push_back(box.triangles[i + 1]);
    box.triangles.push_back({c, a, v});
    box.triangles[i + 1] = {b, c, v};
  }
  const ShapeDescriptors d = describe(box);
  EXPECT_NEAR(d.volume, 6.0, 1e-13);
  EXPECT_NEAR(d.area, 22.0, 1e-13);
  EXPECT_LT((d.centroid - Vector3(7, 8, 9)).norm(), 1e-13);
  const double unit = std::sqrt(5.0 / 12.0);
  EXPECT_LT((d.inertia_semi_axes - unit * Vector3(1, 2, 3)).norm(), 1e-13);
  const Eigen::Matrix3d upright = Vector3(6.5, 5.0, 2.5).asDiagonal();
  EXPECT_LT((d.inertia_tensor - upright).norm(), 1e-12);
}

TEST(ShapeDescriptors, InertiaErrorOfAScaledOrTurnedBody) {
  const ShapeDescriptors box = describe(test::box(1, 2, 3));
  EXPECT_EQ(inertia_error_percent(box, box), 0.0);
  // All moments grow by s^5: the largest is off by s^5 - 1 of itself.
  const ShapeDescriptors larger = describe(test::scaled(test::box(1, 2, 3), {1.1, 1.1, 1.1}));
  EXPECT_NEAR(inertia_error_percent(larger, box), 100.0 * (std::pow(1.1, 5) - 1.0), 1e-10);
  EXPECT_NEAR(inertia_error_percent(box, larger), 100.0 * (1.0 - std::pow(1.1, -5)), 1e-10);
  // Turned about z by t: the entries of the xy block change by (I_xx - I_yy) sin^2 t on the
  // diagonal and by (I_xx - I_yy) sin t cos t off it, with moments 6.5, 5 and 2.5.
  for (const double angle : {0.2, 1.0}) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
    const ShapeDescriptors turned = describe(test::transformed(test::box(1, 2, 3), rotation));
    const double largest = 1.5 * std::sin(angle) * std::max(std::sin(angle), std::cos(angle));
    EXPECT_NEAR(inertia_error_percent(turned, box), 100.0 * largest / 6.5, 1e-10);
    // Both turned together: the difference is taken in the reference's own axes.
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Eigen::Matrix3d both = test::random_rotation(seed);
      EXPECT_NEAR(
          inertia_error_percent(describe(test::transformed(test::box(1, 2, 3), both * rotation)),
                                describe(test::transformed(test::box(1, 2, 3), both))),
          100.0 * largest / 6.5, 1e-10);
    }
  }
}

TEST(ShapeDescriptors, FarFromTheOriginTheyAreAsGood) {
  const IndexedMesh mesh = test::lumpy(4);
  const ShapeDescriptors reference = describe(mesh);
  const Vector3 shift(1e6, -2e6, 3e6);
  const ShapeDescriptors d = describe(test::transformed(mesh, Eigen::Matrix3d::Identity(), shift));
  // The shifted coordinates themselves are rounded to 5e-10 of the radius.
  EXPECT_NEAR(d.volume / reference.volume, 1.0, 1e-9);
  EXPECT_NEAR(d.area / reference.area, 1.0, 1e-9);
  EXPECT_NEAR(d.aspect_ratio, reference.aspect_ratio, 1e-9);
  EXPECT_NEAR(d.sdq, reference.sdq, 1e-8);
  EXPECT_LT((d.centroid - shift - reference.centroid).norm(), 2e-9);
}

TEST(ShapeDescriptors, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(5);
  const ShapeDescriptors one = describe_shape(mesh, Execution(1));
  const ShapeDescriptors three = describe_shape(mesh, Execution(3));
  EXPECT_EQ(std::memcmp(&one, &three, sizeof one), 0);
}

TEST(ShapeDescriptors, InsideOutIsRefused) {
  IndexedMesh mesh = test::box(1, 1, 1);
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_ERROR(describe(mesh), InvalidInput);
  EXPECT_ERROR(describe(IndexedMesh()), InvalidInput);
}

TEST(ShapeDescriptors, ScaledAreThoseOfTheScaledBody) {
  const IndexedMesh mesh = test::lumpy(3);
  const double unit = 2.5;
  const Vector3 centre(3.0, -1.0, 0.5);
  ShapeDescriptors scaled = describe_shape(mesh, Execution(1));
  scale(scaled, unit, centre);
  const ShapeDescriptors expected = describe_shape(test::moved(mesh, unit, centre), Execution(1));
  // Both are exact but for rounding.
  const double rounding = 1e-11;
  EXPECT_NEAR(scaled.volume / expected.volume, 1.0, rounding);
  EXPECT_NEAR(scaled.area / expected.area, 1.0, rounding);
  EXPECT_LT((scaled.centroid - expected.centroid).norm(), rounding);
  EXPECT_LT((scaled.inertia_semi_axes - expected.inertia_semi_axes).norm(), rounding);
  EXPECT_LT((scaled.inertia_tensor - expected.inertia_tensor).norm(),
            rounding * expected.inertia_tensor.norm());
  EXPECT_NEAR(scaled.sphericity, expected.sphericity, rounding);
}

TEST(ShapeDescriptors, RelativeError) {
  EXPECT_NEAR(relative_error_percent(1.1, 1.0), 10.0, 1e-12);
  EXPECT_NEAR(relative_error_percent(0.5, 1.0), -50.0, 1e-12);
  EXPECT_EQ(relative_error_percent(0.0, 0.0), 0.0);
  // Rounding is no error.
  EXPECT_EQ(relative_error_percent(1.0 - 1.2e-15, 1.0), 0.0);
  EXPECT_NEAR(relative_error_percent(1.0 + 1e-10, 1.0), 1e-8, 1e-12);
}

TEST(ShapeDescriptors, SdqNamesWhatComesFromItsClip) {
  const IndexedMesh mesh = test::transformed(test::overhanging_rim(10),
                                             test::random_rotation(test::announced(5)), {3, 2, 1});
  const ShapeDescriptors d = describe_shape(mesh, Execution(1));
  double whole = 0.0;
  double clipped = 0.0;
  double half = 0.0;
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3 a = mesh.points[t[0]] - d.centroid;
    const Vector3 b = mesh.points[t[1]] - d.centroid;
    const Vector3 c = mesh.points[t[2]] - d.centroid;
    const Vector3 normal = (b - a).cross(c - a);
    const double q = normal.dot(a + b + c) / (normal.norm() * (a + b + c).norm());
    const auto square = [&](double clip) {
      const double cosine = std::max(q, clip);
      return 0.5 * normal.norm() * (1.0 - cosine * cosine) / cosine;
    };
    area += 0.5 * normal.norm();
    whole += square(0.05);
    half += square(0.025);
    if (q < 0.05) clipped += square(0.05);
  }
  EXPECT_NEAR(d.sdq, std::sqrt(whole / area), 1e-9);
  EXPECT_NEAR(d.sdq_clipped_fraction, clipped / whole, 1e-9);
  EXPECT_NEAR(d.sdq_half_clip, std::sqrt(half / area), 1e-9);
  const std::string told = sdq_clip_sentence("the grain", d);
  EXPECT_EQ(told.rfind("Sdq (invariant form) of the grain is not reliable", 0), 0U) << told;
  EXPECT_TRUE(test::holds(told, "0.05"));
  // A ball has no walls.
  const ShapeDescriptors sphere = describe_shape(test::sphere(3), Execution(1));
  EXPECT_EQ(sphere.sdq_clipped_fraction, 0.0);
  EXPECT_EQ(sphere.sdq_half_clip, sphere.sdq);
  // The sides of a bar pass the centroid at .01, their faces' centroids are 1/3 away from there.
  const ShapeDescriptors bar = describe_shape(test::box(0.02, 0.02, 2.0), Execution(1));
  EXPECT_GT(bar.sdq_clipped_fraction, 0.99);
  // The smallest cosine of a needle 30 : 1 is 60 / 901, above the clip.
  const IndexedMesh needle = test::transformed(test::sphere(5), Vector3(1, 1, 30).asDiagonal());
  EXPECT_EQ(describe_shape(needle, Execution(1)).sdq_clipped_fraction, 0.0);
  EXPECT_EQ(sdq_clip_sentence("the grain", sphere), "");

  // It is told from a change of 2 % on.
  ShapeDescriptors changed = sphere;
  changed.sdq = 0.5;
  for (const double change : {0.0, 0.019, 0.021, 0.5}) {
    changed.sdq_half_clip = 0.5 * (1.0 + change);
    EXPECT_EQ(sdq_clip_sentence("the grain", changed).empty(), change < 0.02) << change;
  }
  changed.sdq_clipped_fraction = 0.4;
  const std::string larger = sdq_clip_sentence("the grain", changed);
  EXPECT_TRUE(test::holds(larger, "Sdq is 50 % larger"));
  EXPECT_TRUE(test::holds(larger, "40 % of its square"));
}

}  // namespace
}  // namespace wscvt
