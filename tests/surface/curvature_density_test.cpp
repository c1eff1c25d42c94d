// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/curvature_density.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

/// A spheroid of half-axes 1, 1, 2: its curvatures are 1/4 and 1 about the middle, 2 at the tips.
IndexedMesh spheroid() { return test::scaled(test::sphere(5), Vector3(1.0, 1.0, 2.0)); }

/// Discs of these many nodes are a tenth of the body across: curvature hardly changes over one.
constexpr int many_nodes = 20000;

double mean_over(const IndexedMesh& mesh, const std::vector<double>& values) {
  const std::vector<double> areas = vertex_areas(mesh);
  double sum = 0.0;
  double area = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    sum += areas[i] * values[i];
    area += areas[i];
  }
  return sum / area;
}

/// The value at the vertex farthest along a direction.
double at(const IndexedMesh& mesh, const std::vector<double>& values, const Vector3& direction) {
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (mesh.points[i].dot(direction) > mesh.points[farthest].dot(direction)) farthest = i;
  }
  return values[farthest];
}

TEST(CurvatureDensity, GivesCellsByTheLawOfThePaper) {
  const IndexedMesh body = spheroid();
  const std::vector<double> areas = vertex_areas(body);
  for (const double alpha : {1.0, 0.5, -1.0}) {
    SCOPED_TRACE(alpha);
    const std::vector<double> density = curvature_density(body, alpha, many_nodes, Execution(1));
    EXPECT_NEAR(mean_over(body, density), 1.0, 1e-12);
    // The largest curvature of the spheroid, by its formula: x = sin t, z = 2 cos t has
    // 2 / g^3 along it and 2 / g across, g^2 = cos^2 t + 4 sin^2 t.
    std::vector<double> f;
    for (const Vector3& p : body.points) {
      const double g = std::sqrt(0.25 * p.z() * p.z() + 4.0 * (1.0 - 0.25 * p.z() * p.z()));
      f.push_back(-std::log(std::max(2.0 / (g * g * g), 2.0 / g)));
    }
    const double mean = mean_over(body, f);
    std::vector<double> squares;
    for (const double value : f) squares.push_back((value - mean) * (value - mean));
    const double deviation = std::sqrt(mean_over(body, squares));
    // Eqs. 11 to 14: w = 4 alpha (f - mean) / (3 deviation), clipped at .9 of 4; cell = 1 + 3.118 w
    // / (4 pi), in means.
    const auto cell = [&](double value) {
      const double x = std::clamp(alpha * (value - mean) / (3.0 * deviation), -0.9, 0.9);
      return 1.0 + 3.118 * 4.0 * x / 12.566370614359172;
    };
    const double tip = -std::log(2.0);
    const double middle = -std::log(1.0);
    const double wanted = cell(middle) / cell(tip);
    EXPECT_NEAR(
        at(body, density, Vector3(0.01, 0.02, 1)) / at(body, density, Vector3(1, 0.3, 0.01)),
        wanted, 0.05 * wanted);
  }
  const std::vector<double> none = curvature_density(body, 0.0, many_nodes, Execution(1));
  for (const double value : none) EXPECT_NEAR(value, 1.0, 1e-12);
}

TEST(CurvatureDensity, OfABallIsEven) {
  const std::vector<double> density = curvature_density(test::sphere(4), 1.0, 300, Execution(1));
  // Quadrics over two rings of an icosahedron's parts tell curvature to some per cent.
  for (const double value : density) EXPECT_NEAR(value, 1.0, 0.1);
}

TEST(CurvatureDensity, IsMeantOverLargerDiscsForFewerNodes) {
  // Roughness as wide as an edge, which small discs keep and large ones level.
  IndexedMesh body = spheroid();
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    body.points[i] *= 1.0 + 0.002 * std::sin(12.9898 * static_cast<double>(i));
  }
  // The law sets the deviation over the surface, so steps between neighbours are told as parts of
  // it.
  const auto relative_step = [&](int count) {
    const std::vector<double> density = curvature_density(body, 1.0, count, Execution(1));
    double steps = 0.0;
    for (const Triangle& t : body.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        steps += std::abs(density[t[k]] - density[t[(k + 1) % 3]]);
      }
    }
    std::vector<double> deviations;
    for (const double value : density) deviations.push_back(std::abs(value - 1.0));
    return steps / mean_over(body, deviations);
  };
  EXPECT_LT(relative_step(50), 0.6 * relative_step(many_nodes));
}

TEST(CurvatureDensity, IsSteepenedAboutItsMean) {
  const IndexedMesh body = test::lumpy(3);
  std::vector<double> density;
  for (const Vector3& p : body.points) density.push_back(std::exp(p.z()));
  const std::vector<double> steep = steepened(density, body, 1.3);
  EXPECT_NEAR(mean_over(body, steep), 1.0, 1e-12);
  for (std::size_t i = 1; i < steep.size(); ++i) {
    EXPECT_NEAR(std::log(steep[i] / steep[0]), 1.3 * std::log(density[i] / density[0]), 1e-10);
  }
  EXPECT_TRUE(steepened({}, body, 2.0).empty());
}

}  // namespace
}  // namespace wscvt
