// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/portable_math.h"

#include <cmath>
#include <limits>

namespace wscvt::portable {

namespace {

// Series of Taylor after a reduction to a small argument. Where one double is not enough, a sum of
// two without common digits (T. J. Dekker, "A floating-point technique for extending the available
// precision", Numerische Mathematik 18, 1971). Constants of two or three parts add up to more
// digits than a double has; the first parts have 33 bits, so that their products with small whole
// numbers are exact.
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

constexpr double ln_2[] = {0x1.62e42feep-1, 0x1.a39ef35793c76p-33};
constexpr double one_over_ln_2 = 1.4426950408889634;
constexpr double one_over_ln_10[] = {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
constexpr double half_pi[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
constexpr double two_over_pi = 0.6366197723675814;
/// A double and what is missing from pi / 2 and from pi.
constexpr double near_half_pi[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr double near_pi[] = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
/// Angles of slopes 0, 1/8, ..., 1.
constexpr double angles[][2] = {{0.0, 0.0},
                                {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

/// 1 / n!, rounded once: all n! up to 20! are doubles.
struct InverseFactorials {
  double at[21];
  constexpr InverseFactorials() : at{} {
    double factorial = 1.0;
    for (int n = 0; n <= 20; ++n) {
      if (n > 0) factorial *= n;
      at[n] = 1.0 / factorial;
    }
  }
};
constexpr InverseFactorials inverse_factorial;

/// The sum of a double and what it lacks.
struct Two {
  double high;
  double low;
};

/// The parts of a double with 26 bits each.
Two split(double x) {
  const double scaled = 134217729.0 * x;  // 2^27 + 1
  const double high = scaled - (scaled - x);
  return {high, x - high};
}

Two product(double x, double y) {
  const double rounded = x * y;
  const Two a = split(x);
  const Two b = split(y);
  return {rounded, ((a.high * b.high - rounded) + a.high * b.low + a.low * b.high) + a.low * b.low};
}

/// Sum of two with |x| >= |y|.
Two sum(double x, double y) {
  const double rounded = x + y;
  return {rounded, y - (rounded - x)};
}

/// Logarithm of a finite x > 0: log x = e log 2 + log m with m near 1, and with s = (m - 1) / (m +
/// 1) log m = 2 (s + s^3 / 3 + s^5 / 5 + ...).
Two logarithm(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  const double numerator = m - 1.0;
  const Two denominator = {m + 1.0, m - ((m + 1.0) - 1.0)};
  const double s = numerator / denominator.high;
  const Two back = product(s, denominator.high);
  const double s_low =
      ((numerator - back.high) - back.low - s * denominator.low) / denominator.high;
  const double z = s * s;
  double series = 1.0 / 25.0;
  for (int k = 23; k >= 3; k -= 2) series = 1.0 / k + z * series;
  const double e = exponent;
  const Two main = exponent == 0 ? Two{2.0 * s, 0.0} : sum(e * ln_2[0], 2.0 * s);
  return sum(main.high, main.low + (e * ln_2[1] + (2.0 * s_low + 2.0 * s * (z * series))));
}

/// exp(high + low): exp(k log 2 + r) = 2^k exp(r).
double exponential(Two x) {
  if (std::isnan(x.high)) return x.high;
  if (x.high > 710.0) return infinity;
  if (x.high < -746.0) return 0.0;
  const double k = std::floor(x.high * one_over_ln_2 + 0.5);
  const double first = x.high - k * ln_2[0];
  const double second = k * ln_2[1] - x.low;
  const double r = first - second;
  const double r_low = (first - r) - second;
  double series = inverse_factorial.at[14];
  for (int n = 13; n >= 2; --n) series = inverse_factorial.at[n] + r * series;
  return std::ldexp(1.0 + (r + (r_low * (1.0 + r) + r * r * series)), static_cast<int>(k));
}

/// An angle less a multiple of pi / 2, between -pi / 4 and pi / 4, and the multiple modulo 4.
struct Reduced {
  Two angle;
  int quarter;
};

Reduced reduced(double angle) {
  if (std::abs(angle) > 1e6) angle = std::fmod(angle, 2.0 * near_pi[0]);
  const double k = std::floor(angle * two_over_pi + 0.5);
  const double first = angle - k * half_pi[0];
  const double second = k * half_pi[1];
  const double near = first - second;
  const double rest = (first - near) - second - k * half_pi[2];
  const double high = near + rest;
  return {{high, (near - high) + rest}, static_cast<int>(k - 4.0 * std::floor(0.25 * k))};
}

double near_sine(Two r) {
  const double z = r.high * r.high;
  double series = inverse_factorial.at[19];
  for (int n = 17; n >= 3; n -= 2) series = inverse_factorial.at[n] - z * series;
  return r.high + (r.low * (1.0 - 0.5 * z) - r.high * z * series);
}

double near_cosine(Two r) {
  const double z = r.high * r.high;
  double series = inverse_factorial.at[18];
  for (int n = 16; n >= 4; n -= 2) series = inverse_factorial.at[n] - z * series;
  const double half = 0.5 * z;
  const double rounded = 1.0 - half;
  return rounded + (((1.0 - rounded) - half) + (z * z * series - r.high * r.low));
}

/// Angle of the slope y / x, 0 <= y <= x, x > 0: from the nearest of `angles`, by the difference's
/// series z - z^3 / 3 + z^5 / 5 - ...
double angle_of(double y, double x) {
  if (x > 1e300) return angle_of(y * 0x1p-100, x * 0x1p-100);
  const double slope = y / x;
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): of 0 to 8, and lround is the platform's
  const auto j = static_cast<int>(8.0 * slope + 0.5);
  const double c = 0.125 * j;
  const double z = j == 0 ? slope : (y - c * x) / (x + c * y);
  const double square = z * z;
  double series = 1.0 / 17.0;
  for (int n = 15; n >= 3; n -= 2) series = 1.0 / n - square * series;
  return angles[j][0] + (angles[j][1] - z * square * series + z);
}

/// x^n for n >= 0.
double whole_power(double x, int n) {
  double result = 1.0;
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) result *= x;
    if (n > 1) x *= x;
  }
  return result;
}

}  // namespace

double sin(double angle) {
  if (!std::isfinite(angle)) return not_a_number;
  if (angle == 0.0) return angle;
  const Reduced r = reduced(angle);
  const double size = r.quarter % 2 == 0 ? near_sine(r.angle) : near_cosine(r.angle);
  return r.quarter < 2 ? size : -size;
}

double cos(double angle) {
  if (!std::isfinite(angle)) return not_a_number;
  const Reduced r = reduced(angle);
  const double size = r.quarter % 2 == 0 ? near_cosine(r.angle) : near_sine(r.angle);
  return r.quarter == 0 || r.quarter == 3 ? size : -size;
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  double width = std::abs(x);
  double height = std::abs(y);
  if (height == infinity) {
    width = width == infinity ? 1.0 : 0.0;
    height = 1.0;
  } else if (width == infinity) {
    width = 1.0;
    height = 0.0;
  }
  double angle = 0.0;
  if (height > width) {
    angle = near_half_pi[0] - (angle_of(width, height) - near_half_pi[1]);
  } else if (width > 0.0) {
    angle = angle_of(height, width);
  }
  if (std::signbit(x)) angle = near_pi[0] - (angle - near_pi[1]);
  return std::copysign(angle, y);
}

double acos(double x) {
  if (!(std::abs(x) <= 1.0)) return not_a_number;
  return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

double exp(double x) { return exponential({x, 0.0}); }

double tanh(double x) {
  if (x == 0.0) return x;
  const double part = exp(-2.0 * std::abs(x));
  return std::copysign((1.0 - part) / (1.0 + part), x);
}

double log(double x) {
  if (x == 0.0) return -infinity;
  if (!(x > 0.0)) return not_a_number;
  if (x == infinity) return x;
  return logarithm(x).high;
}

double log10(double x) {
  if (!(x > 0.0) || x == infinity) return log(x);
  const Two natural = logarithm(x);
  const double result = natural.high * one_over_ln_10[0] +
                        (natural.high * one_over_ln_10[1] + natural.low * one_over_ln_10[0]);
  const double whole = std::floor(result + 0.5);
  const bool is_power = std::abs(result - whole) < 1e-12 && pow(10.0, whole) == x;
  return is_power ? whole : result;
}

double atanh(double x) { return 0.5 * log((1.0 + x) / (1.0 - x)); }

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return not_a_number;
  const bool is_whole = std::floor(y) == y;
  if (is_whole && std::abs(y) <= 32.0) {
    const double power = whole_power(x, static_cast<int>(std::abs(y)));
    return y > 0.0 ? power : 1.0 / power;
  }
  if (x < 0.0) {
    if (!is_whole) return not_a_number;
    const double power = pow(-x, y);
    return std::floor(0.5 * y) == 0.5 * y ? power : -power;
  }
  if (x == 0.0 || x == infinity) return (x == 0.0) == (y > 0.0) ? 0.0 : infinity;
  const Two base = logarithm(x);
  const double size = base.high * y;
  if (!(std::abs(size) < 800.0)) return size > 0.0 ? infinity : 0.0;
  const Two whole = product(base.high, y);
  return exponential({whole.high, whole.low + base.low * y});
}

double cbrt(double x) {
  if (x == 0.0 || !std::isfinite(x)) return x;
  int exponent = 0;
  double m = std::frexp(std::abs(x), &exponent);
  const int third = static_cast<int>(std::floor(exponent / 3.0));
  m = std::ldexp(m, exponent - 3 * third);  // 0.5 to 4
  // From 7 % off by Halley's steps, each of which triples the digits, and one of Newton.
  double root = 0.7 + 0.25 * m;
  for (int step = 0; step < 3; ++step) {
    const double cube = root * root * root;
    root *= (cube + 2.0 * m) / (2.0 * cube + m);
  }
  const Two square = product(root, root);
  const Two cube = product(root, square.high);
  root -= ((cube.high - m) + (cube.low + root * square.low)) / (3.0 * square.high);
  return std::copysign(std::ldexp(root, third), x);
}

double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace wscvt::portable
