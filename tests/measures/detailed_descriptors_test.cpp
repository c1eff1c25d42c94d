// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/repair/overhangs.h"

namespace wscvt {
namespace {

DetailedDescriptors in_detail(const IndexedMesh& mesh) {
  return describe_shape_in_detail(mesh, DetailedOptions(), Execution(1));
}

TEST(DetailedDescriptors, Sphere) {
  const double radius = 3.0;
  // Edges of 0.08 radii: chords 8e-4 radii deep.
  const DetailedDescriptors d = in_detail(test::scaled(test::sphere(4), Vector3::Constant(radius)));
  EXPECT_NEAR(d.equivalent_diameter, 2.0 * radius, 2.5e-2);
  for (const FormAxes& axes : {d.inertia_axes, d.box_axes}) {
    EXPECT_NEAR(axes.shortest, 2.0 * radius, 3e-2);
    EXPECT_NEAR(axes.longest, 2.0 * radius, 3e-2);
  }
  EXPECT_NEAR(d.convexity, 1.0, 1e-12);
  EXPECT_NEAR(d.inscribed_sphere.radius, radius, 1.5e-2);
  EXPECT_NEAR(d.orientation.compactness, 1.0, 1e-9);
  EXPECT_EQ(d.overhang_fraction, 0.0);
  ASSERT_TRUE(d.has_radius);
  EXPECT_EQ(d.roundness.roundness, 1.0);
  EXPECT_NEAR(d.roundness.ball_radius, DetailedOptions().roundness_ball * radius, 1e-2);
  ASSERT_TRUE(d.has_roughness);
  EXPECT_NEAR(d.roughness.cutoff, DetailedOptions().roughness_cutoff * radius, 1e-2);
  EXPECT_LT(d.roughness.sq, 5e-4 * radius);
  EXPECT_NEAR(d.feret.largest, 2.0 * radius, 1e-9);
  EXPECT_NEAR(d.feret.smallest, 2.0 * radius, 1e-2);
  EXPECT_NEAR(d.mean_curvature_integral, 4.0 * test::pi * radius, 0.1);
  EXPECT_LT(d.printed_sdq, 0.15);
}

TEST(DetailedDescriptors, Ellipsoid) {
  const DetailedDescriptors d =
      in_detail(test::transformed(test::scaled(test::sphere(4), {1.0, 1.5, 2.0}),
                                  test::random_rotation(test::announced(4)), {100, 200, 300}));
  EXPECT_NEAR(d.equivalent_diameter, 2.0 * std::cbrt(3.0), 2.5e-2);
  for (const FormAxes& axes : {d.inertia_axes, d.box_axes}) {
    EXPECT_NEAR(axes.shortest, 2.0, 2e-2);
    EXPECT_NEAR(axes.intermediate, 3.0, 3e-2);
    EXPECT_NEAR(axes.longest, 4.0, 4e-2);
  }
  EXPECT_NEAR(d.inertia_ratios.zingg_elongation, 0.75, 1e-9);
  EXPECT_NEAR(d.inertia_ratios.zingg_flatness, 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(d.inertia_ratios.krumbein_sphericity, std::cbrt(0.375), 1e-9);
  EXPECT_NEAR(d.convexity, 1.0, 1e-12);
  EXPECT_NEAR(d.inscribed_sphere.radius, 1.0, 1e-2);
  EXPECT_LT(d.roundness.roundness, 0.95);
  EXPECT_GT(d.roundness.roundness, 0.5);
  EXPECT_NEAR(d.feret.largest, 4.0, 1e-2);
  EXPECT_NEAR(d.feret.smallest, 2.0, 1e-2);
}

TEST(DetailedDescriptors, Cube) {
  const DetailedDescriptors d =
      in_detail(test::transformed(test::box(1, 1, 1), test::random_rotation(test::announced(9))));
  EXPECT_NEAR(d.equivalent_diameter, std::cbrt(6.0 / test::pi), 1e-12);
  EXPECT_NEAR(d.box_axes.shortest, 1.0, 1e-9);
  EXPECT_NEAR(d.box_axes.longest, 1.0, 1e-9);
  EXPECT_NEAR(d.box_ratios.krumbein_sphericity, 1.0, 1e-9);
  EXPECT_NEAR(d.inscribed_sphere.radius, 0.5, 1e-3);
  EXPECT_NEAR(d.orientation.compactness, 1.0, 1e-12);
  // Of twelve faces nobody can say how sharp its edges are, or how rough.
  EXPECT_TRUE(std::isnan(d.roundness.roundness));
  EXPECT_FALSE(d.has_roughness);
  const DetailedDescriptors fine = in_detail(test::subdivided(test::box(1, 1, 1), 5));
  EXPECT_LT(fine.roundness.roundness, 0.1);
  EXPECT_GT(fine.roughness.sq, 1e-3);
}

TEST(DetailedDescriptors, TurnAndScaleAsTheyShould) {
  const IndexedMesh mesh = test::lumpy(4);
  const DetailedDescriptors a = in_detail(mesh);
  const double scale = 1e-6;
  const DetailedDescriptors b = in_detail(
      test::transformed(mesh, scale * test::random_rotation(test::announced(2)), {1e-5, 0, 0}));
  EXPECT_NEAR(b.equivalent_diameter / scale, a.equivalent_diameter, 1e-9);
  EXPECT_NEAR(b.convexity, a.convexity, 1e-9);
  EXPECT_NEAR(b.inscribed_sphere.radius / scale, a.inscribed_sphere.radius, 2e-3);
  EXPECT_NEAR(b.box_axes.longest / scale / a.box_axes.longest, 1.0, 1e-3);
  EXPECT_NEAR(b.box_axes.shortest / scale / a.box_axes.shortest, 1.0, 1e-3);
  EXPECT_NEAR(b.feret.largest / scale / a.feret.largest, 1.0, 1e-9);
  EXPECT_NEAR(b.feret.smallest / scale / a.feret.smallest, 1.0, 1e-3);
  EXPECT_NEAR(b.mean_curvature_integral / scale / a.mean_curvature_integral, 1.0, 1e-6);
  // The radius of the inscribed sphere is known to 0.1 %.
  EXPECT_NEAR(b.roundness.roundness, a.roundness.roundness, 5e-3);
  EXPECT_NEAR(b.roughness.sq / scale / a.roughness.sq, 1.0, 1e-5);
}

TEST(DetailedDescriptors, BodyWhoseCentroidLiesOutsideHasNoRadius) {
  // A frame: a square of four bars about an empty middle, as one closed mesh of quads.
  IndexedMesh mesh;
  for (const double z : {-0.2, 0.2}) {
    for (const double half : {1.0, 0.7}) {
      mesh.points.insert(mesh.points.end(),
                         {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
    }
  }
  const auto quad = [&mesh](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  // Points: outer 0-3 and inner 4-7 below, outer 8-11 and inner 12-15 above.
  for (std::int32_t k = 0; k < 4; ++k) {
    const std::int32_t n = (k + 1) % 4;
    quad(k, n, 8 + n, 8 + k);            // outer wall
    quad(4 + n, 4 + k, 12 + k, 12 + n);  // inner wall
    quad(8 + k, 8 + n, 12 + n, 12 + k);  // top
    quad(n, k, 4 + k, 4 + n);            // bottom
  }
  const DetailedDescriptors d = in_detail(mesh);
  EXPECT_NEAR(d.basic.volume, 0.4 * (4.0 - 1.96), 1e-12);
  EXPECT_NEAR(d.convexity, (4.0 - 1.96) / 4.0, 1e-12);
  EXPECT_FALSE(d.has_radius);
  EXPECT_EQ(d.overhang_fraction, overhang_solid_angle(mesh, d.basic.centroid, Execution(1)));
  bool empty = false;
  for (const DescriptorValue& row : list_descriptors(d)) {
    if (row.key == "sdq_printed") empty = std::isnan(row.value);
  }
  EXPECT_TRUE(empty);
}

TEST(DetailedDescriptors, ARadiusIsMeasuredWhereLittleFolds) {
  // A ball of radius 0.7 with a rim of radius 1 that overhangs it by so many degrees on either
  // side: two sheets beyond the first on cos(60) - cos(60 + n) of the directions.
  for (const int overhang : {1, 10}) {
    SCOPED_TRACE(overhang);
    const DetailedDescriptors d = in_detail(test::overhanging_rim(overhang));
    const double degree = test::pi / 180.0;
    const double share = 2.0 * (0.5 - std::cos((60 + overhang) * degree));
    // 128 segments cut the rims by 1 - cos(pi / 128), 0.03 %.
    EXPECT_NEAR(d.overhang_fraction, share, 1e-3);
    EXPECT_EQ(d.has_radius, share < largest_measured_overhang);
    // What asks for no radius is there in any case.
    for (const DescriptorValue& row : list_descriptors(d)) {
      // Its edges are too long for roughness.
      const bool missing = row.key == "sa" || row.key == "sq" || row.key == "sq_form_leak" ||
                           row.key == "ssk" || row.key == "sku" ||
                           (row.key == "sdq_printed" && !d.has_radius);
      if (row.key != "roundness_wadell") {
        EXPECT_EQ(std::isnan(row.value), missing) << row.key;
      }
    }
  }
}

TEST(DetailedDescriptors, FollowTheirOptions) {
  const IndexedMesh mesh = test::lumpy(4);
  const DetailedDescriptors d = describe_shape_in_detail(mesh, {0.4, 0.5}, Execution(1));
  EXPECT_DOUBLE_EQ(d.roundness.ball_radius, 0.4 * d.inscribed_sphere.radius);
  EXPECT_DOUBLE_EQ(d.roughness.cutoff, 0.25 * d.equivalent_diameter);
}

TEST(DetailedDescriptors, RefuseOptionsOutOfRange) {
  const IndexedMesh mesh = test::box(1, 1, 1);
  for (const DetailedOptions& options :
       {DetailedOptions{0.0, 0.33}, DetailedOptions{1.01, 0.33}, DetailedOptions{0.2, 0.0},
        DetailedOptions{0.2, 2.1}, DetailedOptions{std::nan(""), 0.33},
        DetailedOptions{0.2, std::nan("")}}) {
    EXPECT_ERROR(describe_shape_in_detail(mesh, options, Execution(1)), InvalidInput);
  }
  EXPECT_NO_THROW(describe_shape_in_detail(mesh, DetailedOptions{1.0, 2.0}, Execution(1)));
}

}  // namespace
}  // namespace wscvt
