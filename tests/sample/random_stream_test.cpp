// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/random_stream.h"

#include <gtest/gtest.h>

#include <set>

namespace wscvt {
namespace {

TEST(RandomStream, GivesTheNumbersOfItsSeedAndKeys) {
  std::set<std::uint64_t> firsts;
  for (const std::uint64_t seed : {0U, 1U, 2U}) {
    for (const std::uint64_t key : {0U, 1U, 2U}) {
      for (const std::uint64_t second : {0U, 1U}) {
        RandomStream a(seed, key, second), b(seed, key, second);
        const std::uint64_t first = a.bits();
        EXPECT_EQ(first, b.bits());
        EXPECT_NE(first, a.bits());
        firsts.insert(first);
      }
    }
  }
  EXPECT_EQ(firsts.size(), 18U);
}

// Deviations of the means of 40,000 numbers are 1/200 of those of the numbers; the tolerances are
// four of them.
TEST(RandomStream, HasTheMomentsOfItsDistributions) {
  constexpr int count = 40000;
  double uniform = 0.0, uniform2 = 0.0, normal = 0.0, normal2 = 0.0, normal4 = 0.0;
  Vector3 direction = Vector3::Zero(), direction2 = Vector3::Zero();
  std::array<int, 3> below{};
  for (int k = 0; k < count; ++k) {
    RandomStream random(7, static_cast<std::uint64_t>(k));
    const double u = random.uniform();
    EXPECT_GE(u, 0.0);
    EXPECT_LT(u, 1.0);
    uniform += u / count;
    uniform2 += u * u / count;
    const double n = random.normal();
    normal += n / count;
    normal2 += n * n / count;
    normal4 += n * n * n * n / count;
    const Vector3 d = random.direction();
    EXPECT_NEAR(d.norm(), 1.0, 1e-12);
    direction += d / count;
    direction2 += d.cwiseAbs2() / count;
    ++below.at(random.below(3));
  }
  EXPECT_NEAR(uniform, 0.5, 4.0 * 0.289 / 200);
  EXPECT_NEAR(uniform2, 1.0 / 3.0, 4.0 * 0.298 / 200);
  EXPECT_NEAR(normal, 0.0, 4.0 / 200);
  EXPECT_NEAR(normal2, 1.0, 4.0 * 1.414 / 200);
  EXPECT_NEAR(normal4, 3.0, 4.0 * 9.8 / 200);
  EXPECT_LT(direction.cwiseAbs().maxCoeff(), 4.0 * 0.577 / 200);
  EXPECT_LT((direction2.array() - 1.0 / 3.0).abs().maxCoeff(), 4.0 * 0.298 / 200);
  for (const int hits : below) EXPECT_NEAR(hits, count / 3.0, 4.0 * 94.3);
}

TEST(RandomStream, DrawsEachPlaceOnce) {
  for (const std::size_t count : {1U, 2U, 3U, 8U, 17U, 64U, 65U, 1000U}) {
    std::set<std::size_t> places, others;
    std::size_t same = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t place = drawn_place(k, count, 5, 9);
      EXPECT_LT(place, count);
      places.insert(place);
      if (drawn_place(k, count, 6, 9) == place) ++same;
      others.insert(drawn_place(k, count, 5, 10));
    }
    EXPECT_EQ(places.size(), count);
    EXPECT_EQ(others.size(), count);
    // Of a random order one place stays, six or more once in 1,600 times.
    EXPECT_TRUE(count <= 8 || same <= 5) << count;
  }
}

}  // namespace
}  // namespace wscvt
