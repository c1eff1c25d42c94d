// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/first_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
}

}  // namespace
}  // namespace wscvt
