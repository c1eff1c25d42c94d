// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/first_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(FirstContact, OfBallsIsTwiceTheRadius) {
  const std::vector<double> distances =
      ContactHeights({{Vector3::Zero(), 0.8}}, 1.1, Execution(2)).distances(Execution(2));
  EXPECT_EQ(distances.size(), std::size_t{ContactHeights::poses} * (ContactHeights::poses - 1));
  for (const double distance : distances) EXPECT_NEAR(distance, 1.6, 1e-4);
}

/// A ball off the centre touches a turned one where the closed form says: the pairs are random, so
/// that what holds of all of them is the range.
TEST(FirstContact, OfABallOffTheCentreFollowsItsPose) {
  const double off = 0.6;
  const double radius = 0.5;
  const std::vector<double> distances =
      ContactHeights({{Vector3(off, 0, 0), radius}}, 1.2, Execution(1)).distances(Execution(1));
  double mean = 0.0;
  std::size_t missed = 0;
  for (const double distance : distances) {
    if (distance < -1e6) {
      ++missed;  // they pass each other
      continue;
    }
    EXPECT_LE(distance, 2.0 * (off + radius) + 1e-6);
    EXPECT_GE(distance, -2.0 * off);
    mean += distance;
  }
  EXPECT_GT(missed, 0U);
  EXPECT_LT(missed, distances.size() / 2);
}

TEST(FirstContact, OfAMeshIsThatOfItsSpheres) {
  const std::vector<double> of_mesh =
      ContactHeights(test::moved(test::sphere(5), 0.9, Vector3::Zero()), 1.1, Execution(1))
          .distances(Execution(1));
  const std::vector<double> of_sphere =
      ContactHeights({{Vector3::Zero(), 0.9}}, 1.1, Execution(1)).distances(Execution(1));
  const ContactError error = contact_error(of_mesh, of_sphere);
  // In % of 1; the faces lie within the sphere by 0.03 % here.
  EXPECT_LT(error.mean, 0.0);
  EXPECT_GT(error.mean, -0.1);
  EXPECT_LT(error.scatter, 0.05);
}

TEST(FirstContact, ErrorIsMeanAndScatter) {
  const ContactError error = contact_error({1.1, 2.3, 2.9}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(error.mean, 10.0, 1e-9);
  EXPECT_NEAR(error.scatter, 100.0 * std::sqrt(0.08 / 3.0), 1e-9);
  // Pairs of which one passes by do not count.
  const ContactError others =
      contact_error({1.1, -1e30, 2.3, 2.9, -1e30}, {1.0, 2.0, 2.0, 3.0, -1e30});
  EXPECT_NEAR(others.mean, error.mean, 1e-9);
  const ContactError scans = contact_error({1.1, 5.0, 2.3, 2.9}, {1.0, -1e30, 2.0, 3.0});
  EXPECT_NEAR(scans.mean, error.mean, 1e-9);
  EXPECT_NEAR(scans.scatter, error.scatter, 1e-9);
}

}  // namespace

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

/// Its contacts, and the errors of a body that is smaller by 2 %.
const ScanContacts& contacts_of_the_grain() {
  static const ScanContacts contacts(grain(1.0), describe_shape(grain(1.0), Execution(1)),
                                     Execution(1));
  return contacts;
}
const ScanContacts::Errors& errors_of_a_smaller_body() {
  static const ScanContacts::Errors errors =
      contacts_of_the_grain().errors_of(grain(0.98), Execution(1));
  return errors;
}

TEST(ScanContacts, OfTheScanItselfHaveNoError) {
  const ScanContacts::Errors same = contacts_of_the_grain().errors_of(grain(1.0), Execution(3));
  EXPECT_EQ(same.distance.mean, 0.0);
  EXPECT_EQ(same.distance.scatter, 0.0);
  for (const TouchErrors& errors : {same.two_sided, same.one_sided}) {
    EXPECT_EQ(errors.gap.percent_90, 0.0);
    EXPECT_EQ(errors.place.percent_90, 0.0);
    EXPECT_LT(errors.normal.percent_90, 1e-5);  // acos of a rounded 1
  }
}

TEST(ScanContacts, PlacesAndNormalsFollowASmallerBody) {
  const ScanContacts::Errors& smaller = errors_of_a_smaller_body();
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

/// The centre of a turned ball off the origin tells its pose.
TEST(FirstTouch, IsOfEachPoseWithEachOther) {
  const double radius = 0.8;
  const Execution one(1);
  const ContactHeights centred({{Vector3::Zero(), radius}}, 1.5, one);
  const ContactHeights off({{Vector3(0.6, 0.0, 0.0), radius}}, 1.5, one);
  const std::vector<FirstTouch> below = off.touches(centred, one);
  const std::vector<FirstTouch> above = centred.touches(off, one);
  ASSERT_EQ(below.size(), above.size());
  std::size_t equal = 0;
  for (std::size_t pair = 0; pair < below.size(); ++pair) {
    ASSERT_TRUE(below[pair].touches && above[pair].touches);
    const Vector3 lower = 2.0 * below[pair].place - Vector3(0.0, 0.0, below[pair].distance);
    const Vector3 upper = 2.0 * above[pair].place - Vector3(0.0, 0.0, above[pair].distance);
    EXPECT_NEAR(lower.norm(), 0.6, 0.04);  // a pixel is 0.012
    EXPECT_NEAR(upper.norm(), 0.6, 0.04);
    if ((lower - upper).norm() < 0.05) ++equal;
  }
  // A few of the random directions are as near to each other; a pose with itself has 32 pairs.
  EXPECT_LT(equal, 10U);
}

TEST(FirstTouch, ErrorsAreQuantilesOverThePairsThatTouch) {
  std::vector<FirstTouch> scan(13);
  std::vector<FirstTouch> other(13);
  for (std::size_t k = 0; k < 13; ++k) {
    const double step = static_cast<double>((7 * k) % 11);  // 0 to 10, in another order
    scan[k] = {2.0, Vector3(1.0, 2.0, 3.0), Vector3::UnitZ(), true};
    const double angle = 2.0 * step * pi / 180.0;
    other[k] = {2.0 + (k % 2 == 0 ? 0.01 : -0.01) * step, Vector3(1.0, 2.0 - 0.03 * step, 3.0),
                Vector3(std::sin(angle), 0.0, std::cos(angle)), true};
  }
  // Pairs of which one passes by do not count.
  scan[11].touches = false;
  other[12].touches = false;
  other[11].distance = scan[12].distance = 50.0;
  const TouchErrors errors = touch_errors(other, scan);
  EXPECT_NEAR(errors.gap.median, 5.0, 1e-9);
  // 0.9 times 11, less half of a value (Hazen).
  EXPECT_NEAR(errors.gap.percent_90, 9.4, 1e-9);
  EXPECT_NEAR(errors.place.median, 15.0, 1e-9);
  EXPECT_NEAR(errors.place.percent_90, 28.2, 1e-9);
  EXPECT_NEAR(errors.normal.median, 10.0, 1e-6);
  EXPECT_NEAR(errors.normal.percent_90, 18.8, 1e-6);
}

/// Bodies that are smaller by 2 % touch at 2 % less of the distance, which lies between twice the
/// least half-axis, 1.2 less its curving, and twice the greatest.
TEST(ScanContacts, OfASmallerBodyAreTooNear) {
  const ContactError error = errors_of_a_smaller_body().distance;
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
  const ContactError error = contacts_of_the_grain().errors_of(grain(0.9), Execution(1)).distance;
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
