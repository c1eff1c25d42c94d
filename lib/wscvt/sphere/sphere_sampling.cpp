// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sphere/sphere_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

void require_at_least(int value, int least, const char* what) {
  if (value < least) {
    refuse(std::string("The ") + what + " is " + std::to_string(value) + ". It must be at least " +
           std::to_string(least) + ".");
  }
}

Vector3 direction(double z, double azimuth) {
  const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
  return {s * portable::cos(azimuth), s * portable::sin(azimuth), z};
}

// Returns an azimuth of the lattice in turns, in [0, 1): the fractional part of (i + 1/2) * golden
// ratio.
double lattice_turn(int i) {
  const double golden_ratio = 0.5 * (1.0 + std::sqrt(5.0));
  const double turns = (i + 0.5) * golden_ratio;
  return turns - std::floor(turns);
}

double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

// Returns the inverse of the piecewise linear cumulative distribution `cumulative` (first 0, last
// 1) at `value`, in units of intervals.
template <class Cumulative>
double invert(const Cumulative& cumulative, std::size_t intervals, double value) {
  std::size_t low = 0;
  std::size_t high = intervals;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (cumulative(middle) <= value ? low : high) = middle;
  }
  const double begin = cumulative(low);
  const double width = cumulative(low + 1) - begin;
  const double inside = width > 0.0 ? (value - begin) / width : 0.5;
  return static_cast<double>(low) + std::clamp(inside, 0.0, 1.0);
}

struct LegendreValue {
  double value;
  double slope;
};

// Returns the Legendre polynomial of this degree, at least 1, and its derivative, by the recursion
// over the degrees in the form that keeps the most digits near x = 1.
LegendreValue legendre(int degree, double x) {
  double before = 1.0;
  double value = x;
  for (int k = 1; k < degree; ++k) {
    const double next = x * value + k * (x * value - before) / (k + 1.0);
    before = value;
    value = next;
  }
  return {value, degree * (before - x * value) / ((1.0 - x) * (1.0 + x))};
}

}  // namespace

GaussLegendre gauss_legendre(int count) {
  require_at_least(count, 1, "number of quadrature nodes");
  GaussLegendre rule;
  rule.nodes.resize(count);
  rule.weights.resize(count);
  for (int i = 0; 2 * i < count; ++i) {
    // Tricomi's estimate is near enough for Newton's steps to double their digits.
    double x = portable::cos(pi * (4 * i + 3) / (4.0 * count + 2.0));
    if (2 * i + 1 == count) x = 0.0;
    LegendreValue p = legendre(count, x);
    for (int step = 0; step < 4; ++step) {
      x -= p.value / p.slope;
      p = legendre(count, x);
    }
    const double weight = 2.0 / ((1.0 - x) * (1.0 + x) * p.slope * p.slope);
    rule.nodes[i] = x;
    rule.nodes[count - 1 - i] = -x;
    rule.weights[i] = weight;
    rule.weights[count - 1 - i] = weight;
  }
  return rule;
}

SphereQuadrature gauss_legendre_sphere(int polar_nodes) {
  const GaussLegendre rule = gauss_legendre(polar_nodes);
  const int azimuths = 2 * polar_nodes;
  SphereQuadrature quadrature;
  quadrature.directions.reserve(static_cast<std::size_t>(polar_nodes) * azimuths);
  quadrature.weights.reserve(quadrature.directions.capacity());
  for (int i = 0; i < polar_nodes; ++i) {
    for (int j = 0; j < azimuths; ++j) {
      quadrature.directions.push_back(direction(rule.nodes[i], 2.0 * pi * (j + 0.5) / azimuths));
      quadrature.weights.push_back(rule.weights[i] * 2.0 * pi / azimuths);
    }
  }
  return quadrature;
}

std::vector<Vector3> fibonacci_lattice(int count) {
  require_at_least(count, 1, "number of lattice points");
  std::vector<Vector3> points(count);
  for (int i = 0; i < count; ++i) {
    points[i] = direction(1.0 - (2.0 * i + 1.0) / count, 2.0 * pi * lattice_turn(i));
  }
  return points;
}

std::vector<Vector3> random_directions(int count, std::uint64_t seed) {
  require_at_least(count, 1, "number of random directions");
  std::mt19937_64 generator(seed);
  std::vector<Vector3> points(count);
  for (Vector3& point : points) {
    const double z = 2.0 * uniform(generator) - 1.0;
    point = direction(z, 2.0 * pi * uniform(generator));
  }
  return points;
}

std::vector<Vector3> warped_lattice(int count, const DensityFunction& density, int rows) {
  require_at_least(count, 1, "number of lattice points");
  require_at_least(rows, 2, "number of latitude bands");
  const std::size_t columns = 2 * static_cast<std::size_t>(rows);
  std::vector<double> bounds(rows + 1);  // z at the bounds of the bands, descending
  for (int j = 0; j <= rows; ++j) bounds[j] = portable::cos(pi * j / rows);
  std::vector<Vector3> centres;
  centres.reserve(rows * columns);
  for (int j = 0; j < rows; ++j) {
    for (std::size_t k = 0; k < columns; ++k) {
      centres.push_back(
          direction(0.5 * (bounds[j] + bounds[j + 1]), 2.0 * pi * (k + 0.5) / columns));
    }
  }
  const std::vector<double> values = density(centres);
  // Cumulative fractions: per band over azimuth, columns + 1 values, and of the mass over the
  // bands.
  std::vector<double> conditional(rows * (columns + 1));
  std::vector<double> marginal(rows + 1, 0.0);
  for (int j = 0; j < rows; ++j) {
    double* row = conditional.data() + j * (columns + 1);
    row[0] = 0.0;
    for (std::size_t k = 0; k < columns; ++k) {
      const double value = values[j * columns + k];
      if (!(value > 0.0) || !std::isfinite(value)) {
        refuse(
            "The seed density is not a positive number everywhere. Check the surface the weights "
            "are computed from.");
      }
      row[k + 1] = row[k] + value;
    }
    marginal[j + 1] = marginal[j] + row[columns] * (bounds[j] - bounds[j + 1]);
    const double total = row[columns];
    for (std::size_t k = 0; k <= columns; ++k) row[k] /= total;
  }
  const double mass = marginal.back();
  for (double& value : marginal) value /= mass;

  std::vector<Vector3> points(count);
  for (int i = 0; i < count; ++i) {
    const double band = invert([&](std::size_t j) { return marginal[j]; }, rows, (i + 0.5) / count);
    const int j = std::min(static_cast<int>(band), rows - 1);
    const double z = bounds[j] + (band - j) * (bounds[j + 1] - bounds[j]);
    // Between band centres the conditional distributions are blended.
    const double between = std::clamp(band - 0.5, 0.0, rows - 1.0);
    const int upper = std::min(static_cast<int>(between), rows - 2);
    const double share = between - upper;
    const double* a = conditional.data() + upper * (columns + 1);
    const double* b = a + columns + 1;
    const double column = invert([&](std::size_t k) { return (1.0 - share) * a[k] + share * b[k]; },
                                 columns, lattice_turn(i));
    points[i] = direction(z, 2.0 * pi * column / static_cast<double>(columns));
  }
  return points;
}

std::vector<Vector3> equal_angle_grid(int rings) {
  require_at_least(rings, 1, "number of parallels");
  const int azimuths = 2 * (rings + 1);
  std::vector<Vector3> points;
  points.reserve(2 + static_cast<std::size_t>(rings) * azimuths);
  points.emplace_back(0.0, 0.0, 1.0);
  for (int i = 1; i <= rings; ++i) {
    const double z = portable::cos(pi * i / (rings + 1));
    for (int k = 0; k < azimuths; ++k) points.push_back(direction(z, 2.0 * pi * k / azimuths));
  }
  points.emplace_back(0.0, 0.0, -1.0);
  return points;
}

std::vector<Vector3> nearest_equal_angle_grid(int count) {
  const auto size = [](int rings) { return 2.0 + 2.0 * rings * (rings + 1.0); };
  int rings = 1;
  while (size(rings + 1) - count < count - size(rings)) ++rings;
  return equal_angle_grid(rings);
}

std::vector<Vector3> subdivided_icosahedron(int frequency) {
  require_at_least(frequency, 1, "number of parts of an icosahedron's edge");
  const double golden_ratio = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden_ratio, golden_ratio}) {
      corners.emplace_back(0.0, a, b);
      corners.emplace_back(a, b, 0.0);
      corners.emplace_back(b, 0.0, a);
    }
  }
  // The corners of an edge are 2 apart, all other pairs at least 3.2.
  const auto joined = [&](std::size_t i, std::size_t j) {
    return (corners[i] - corners[j]).squaredNorm() < 4.5;
  };
  std::vector<Vector3> points = corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      if (!joined(i, j)) continue;
      for (int s = 1; s < frequency; ++s) {
        points.push_back(((frequency - s) * corners[i] + s * corners[j]) / frequency);
      }
      for (std::size_t k = j + 1; k < corners.size(); ++k) {
        if (!joined(i, k) || !joined(j, k)) continue;
        for (int s = 1; s < frequency - 1; ++s) {
          for (int t = 1; s + t < frequency; ++t) {
            points.push_back(((frequency - s - t) * corners[i] + s * corners[j] + t * corners[k]) /
                             frequency);
          }
        }
      }
    }
  }
  for (Vector3& point : points) point.normalize();
  return points;
}

std::vector<Vector3> nearest_subdivided_icosahedron(int count) {
  const auto size = [](int frequency) { return 10.0 * frequency * frequency + 2.0; };
  int frequency = 1;
  while (size(frequency + 1) - count < count - size(frequency)) ++frequency;
  return subdivided_icosahedron(frequency);
}

}  // namespace wscvt
