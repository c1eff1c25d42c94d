// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/test_shapes.h"
#include "toolbox/clump/first_contact.h"

namespace wscvt {
namespace {

/// An egg with three axes off the origin, `scale` times its size about its centroid.
IndexedMesh grain(double scale) {
  IndexedMesh mesh = test::scaled(test::sphere(4), Vector3(2.0, 1.5, 1.2));
  for (Vector3& p : mesh.points) {
    p.y() *= 1.0 + 0.1 * p.x();
    p.z() *= 1.0 - 0.05 * p.x() + 0.1 * p.y();
  }
  const Vector3 centroid = describe_shape(mesh, Execution(1)).centroid;
  return test::moved(test::moved(std::move(mesh), 1.0, -centroid), scale, Vector3(7.0, -2.0, 3.0));
}

TEST(ScanContacts, OfTheScanItselfHaveNoError) {
  const IndexedMesh scan = grain(1.0);
  const ScanContacts contacts(scan, describe_shape(scan, Execution(1)), Execution(1));
  const ContactError error = contacts.errors_of(scan, Execution(1)).distance;
  EXPECT_EQ(error.mean, 0.0);
  EXPECT_EQ(error.scatter, 0.0);
}

TEST(ScanContacts, PlacesAndNormalsOfTheScanItselfHaveNoError) {
  const IndexedMesh scan = grain(1.0);
  const ScanContacts contacts(scan, describe_shape(scan, Execution(1)), Execution(1));
  const ScanContacts::Errors same = contacts.errors_of(scan, Execution(3));
  for (const TouchErrors& errors : {same.two_sided, same.one_sided}) {
    EXPECT_EQ(errors.gap.percent_90, 0.0);
    EXPECT_EQ(errors.place.percent_90, 0.0);
    EXPECT_LT(errors.normal.percent_90, 1e-5);  // acos of a rounded 1
  }
  const ScanContacts::Errors smaller = contacts.errors_of(grain(0.98), Execution(1));
  // Half of the distance that two of them lose; both move the place by 2 % of a half-axis, 1.2 to 2
  // over the radius, and by pixels; normals of similar bodies are equal but for the pixels.
  EXPECT_NEAR(smaller.one_sided.gap.median / smaller.two_sided.gap.median, 0.5, 0.05);
  EXPECT_NEAR(smaller.two_sided.gap.median, -smaller.distance.mean, 0.3);
  EXPECT_GT(smaller.two_sided.place.median, 1.0);
  EXPECT_LT(smaller.two_sided.place.median, 6.0);
  EXPECT_LT(smaller.two_sided.normal.median, 3.0);
}

/// Two balls touch on the line through their centres, with the normal along it. The lower one may
/// lie off its origin, and then the normal leans.
TEST(FirstTouch, OfBallsLeansAsTheirCentresDo) {
  const double radius = 0.5;
  const Execution one(1);
  const ContactHeights centred({{Vector3::Zero(), radius}}, 1.2, one);
  const ContactHeights off({{Vector3(0.3, 0.0, 0.0), radius}}, 1.2, one);
  std::size_t leaning = 0;
  for (const FirstTouch& touch : off.touches(centred, one)) {
    ASSERT_TRUE(touch.touches);
    // The upper centre is above the lower origin; the place is in the middle of the two centres.
    const Vector3 upper(0.0, 0.0, touch.distance);
    const Vector3 lower = 2.0 * touch.place - upper;
    EXPECT_NEAR(lower.norm(), 0.3, 0.03);  // a pixel is 0.01
    EXPECT_LT(std::acos(std::min(1.0, touch.normal.dot((upper - lower).normalized()))), 0.03);
    if (touch.normal.z() < 0.99) ++leaning;
  }
  EXPECT_GT(leaning, 300U);
}

/// Bodies that are smaller by 2 % touch at 2 % less of the distance, which lies between twice the
/// least half-axis, 1.2 less its curving, and twice the greatest.
TEST(ScanContacts, OfASmallerBodyAreTooNear) {
  const IndexedMesh scan = grain(1.0);
  const ScanContacts contacts(scan, describe_shape(scan, Execution(1)), Execution(1));
  const ContactError error = contacts.errors_of(grain(0.98), Execution(1)).distance;
  const double radius = std::cbrt(2.0 * 1.5 * 1.2);
  EXPECT_LT(error.mean, -4.0 * 1.1 / radius);
  EXPECT_GT(error.mean, -4.0 * 2.1 / radius);
  EXPECT_GT(error.scatter, 0.0);
}

TEST(ScanContacts, FollowMotionAndScale) {
  const Eigen::Matrix3d turn = 3.0 * test::random_rotation(5);
  const auto placed = [&](double scale) {
    return test::transformed(grain(scale), turn, Vector3(-1.0, 4.0, 0.5));
  };
  const IndexedMesh scan = grain(1.0);
  const ContactError error = ScanContacts(scan, describe_shape(scan, Execution(1)), Execution(1))
                                 .errors_of(grain(0.9), Execution(1))
                                 .distance;
  const IndexedMesh turned = placed(1.0);
  const ContactError same = ScanContacts(turned, describe_shape(turned, Execution(2)), Execution(2))
                                .errors_of(placed(0.9), Execution(2))
                                .distance;
  // Pixels at the rim of a height map change sides by rounding.
  EXPECT_NEAR(same.mean, error.mean, 0.01);
  EXPECT_NEAR(same.scatter, error.scatter, 0.01);
}

}  // namespace
}  // namespace wscvt
