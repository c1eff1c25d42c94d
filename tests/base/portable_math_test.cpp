// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/portable_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "support/seeds.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();

double distance_to_next(double x) { return std::nextafter(std::abs(x), boundless) - std::abs(x); }

/// The largest error over random arguments, in units of the last digit, against the C library's
/// long double, which has 11 more binary digits on x86-64 and is itself good to one of its own.
double largest_error(double low, double high, const std::function<double(double)>& function,
                     const std::function<long double(long double)>& reference) {
  std::mt19937_64 random(test::announced(2026));
  double largest = 0.0;
  for (int k = 0; k < 50000; ++k) {
    const double x = low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    const long double wanted = reference(x);
    const auto error = static_cast<double>(std::abs(function(x) - wanted));
    largest = std::max(largest, error / distance_to_next(static_cast<double>(wanted)));
  }
  return largest;
}

TEST(PortableMath, ComesWithinTheErrorsOfItsHeader) {
  using L = long double;
  namespace p = portable;
  for (const double size : {1.0, 10.0, 1e6}) {
    EXPECT_LT(largest_error(-size, size, p::sin, [](L x) { return std::sin(x); }), 1.0) << size;
    EXPECT_LT(largest_error(-size, size, p::cos, [](L x) { return std::cos(x); }), 1.0) << size;
  }
  for (const double size : {1.0, 30.0, 700.0}) {
    EXPECT_LT(largest_error(-size, size, p::exp, [](L x) { return std::exp(x); }), 1.0) << size;
  }
  for (const double size : {1e-300, 2.0, 1e9}) {
    EXPECT_LT(largest_error(0.2 * size, size, p::log, [](L x) { return std::log(x); }), 1.0);
    EXPECT_LT(largest_error(0.2 * size, size, p::log10, [](L x) { return std::log10(x); }), 2.0);
    EXPECT_LT(largest_error(-size, size, p::cbrt, [](L x) { return std::cbrt(x); }), 1.0);
  }
  EXPECT_LT(largest_error(-1.0, 1.0, p::acos, [](L x) { return std::acos(x); }), 2.0);
  EXPECT_LT(largest_error(0.3, 30.0, p::tanh, [](L x) { return std::tanh(x); }), 3.0);
  for (const double other : {-2.0, -0.01, 0.01, 1.0}) {
    EXPECT_LT(largest_error(
                  -3.0, 3.0, [&](double y) { return p::atan2(y, other); },
                  [&](L y) { return std::atan2(y, static_cast<L>(other)); }),
              2.0)
        << other;
  }
  for (const double exponent : {-20.5, -1.5, 0.3, 1.5, 2.0, 5.0, 60.0, 150.5}) {
    EXPECT_LT(largest_error(
                  1e-3, 20.0, [&](double x) { return p::pow(x, exponent); },
                  [&](L x) { return std::pow(x, static_cast<L>(exponent)); }),
              5.0)
        << exponent;
  }
}

TEST(PortableMath, IsExactWhereTheResultIsAWholeNumber) {
  for (int n = -22; n <= 22; ++n) {
    const double power = std::strtod(("1e" + std::to_string(n)).c_str(), nullptr);
    EXPECT_EQ(portable::pow(10.0, n), power);
    EXPECT_EQ(portable::log10(power), n);
  }
  for (int n = -100; n <= 100; ++n) {
    EXPECT_EQ(portable::cbrt(static_cast<double>(n) * n * n), n);
    EXPECT_EQ(portable::pow(n, 3.0), static_cast<double>(n) * n * n);
  }
  EXPECT_EQ(portable::cos(0.0), 1.0);
  EXPECT_EQ(portable::cos(pi), -1.0);
  EXPECT_EQ(portable::exp(0.0), 1.0);
  EXPECT_EQ(portable::log(1.0), 0.0);
  EXPECT_EQ(portable::hypot(3.0, -4.0), 5.0);
  EXPECT_NEAR(portable::atanh(0.5), std::atanh(0.5), 1e-16);
}

TEST(PortableMath, TakesTheEdgesOfItsRangesAsTheStandardDoes) {
  namespace p = portable;
  for (const double y : {-boundless, -1.0, -0.0, 0.0, 2.0, boundless}) {
    for (const double x : {-boundless, -3.0, -0.0, 0.0, 1e-300, boundless}) {
      EXPECT_NEAR(p::atan2(y, x), std::atan2(y, x), 1e-15) << y << " " << x;
      EXPECT_EQ(std::signbit(p::atan2(y, x)), std::signbit(std::atan2(y, x))) << y << " " << x;
    }
  }
  EXPECT_NEAR(p::atan2(1e308, 1.5e308), std::atan2(1.0, 1.5), 1e-15);
  EXPECT_EQ(p::exp(1000.0), boundless);
  EXPECT_EQ(p::exp(-1000.0), 0.0);
  EXPECT_NEAR(p::exp(-740.0) / std::exp(-740.0), 1.0, 0.01);  // few digits are left there
  EXPECT_EQ(p::log(0.0), -boundless);
  EXPECT_EQ(p::pow(0.0, 1.5), 0.0);
  EXPECT_EQ(p::pow(0.0, -1.5), boundless);
  EXPECT_EQ(p::pow(boundless, 0.5), boundless);
  EXPECT_EQ(p::pow(5.0, 1e9), boundless);
  EXPECT_EQ(p::pow(5.0, -1e9), 0.0);
  EXPECT_EQ(p::pow(-2.0, 35.0), -std::ldexp(1.0, 35));
  EXPECT_EQ(p::tanh(-400.0), -1.0);
  const double none = std::nan("");
  for (const double wrong : {p::acos(1.1), p::log(-1.0), p::pow(-2.0, 0.5), p::sin(boundless),
                             p::exp(none), p::atan2(none, 1.0), p::cbrt(none), p::log10(none)}) {
    EXPECT_TRUE(std::isnan(wrong));
  }
}

}  // namespace

namespace {

TEST(NextPrime, IsTheSmallestAbove) {
  EXPECT_EQ(next_prime(1), 2);
  EXPECT_EQ(next_prime(2), 3);
  EXPECT_EQ(next_prime(7), 11);
  EXPECT_EQ(next_prime(119), 127);  // over 121 = 11^2
  // The largest of 31 bits, whose divisors' squares overflow.
  EXPECT_EQ(next_prime(2147483646), 2147483647);
}

TEST(PlasticSequence, EveryStretchIsSpreadEvenly) {
  for (const std::size_t first : {0U, 1U, 977U, 1000000U}) {
    SCOPED_TRACE(first);
    std::array<int, 64> points{};  // of the squares of an 8 x 8 board
    for (std::size_t i = first; i < first + 1280; ++i) {
      const Eigen::Vector2d p = plastic_point(i);
      ASSERT_GE(p.minCoeff(), 0.0);
      ASSERT_LT(p.maxCoeff(), 1.0);
      ++points[8 * static_cast<std::size_t>(8.0 * p.x()) + static_cast<std::size_t>(8.0 * p.y())];
    }
    // 20 each; of random points some square would have 8 or fewer, and some 32 or more.
    const auto [least, most] = std::minmax_element(points.begin(), points.end());
    EXPECT_GE(*least, 16);
    EXPECT_LE(*most, 24);
  }
}

}  // namespace
}  // namespace wscvt
