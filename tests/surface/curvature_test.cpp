// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/curvature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grains/ct_grain.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

std::vector<PrincipalCurvatures> curvatures(const IndexedMesh& mesh, int rings = 2) {
  return quadric_fit_curvatures(mesh, rings, Execution(1));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Principal curvatures of the ellipsoid with half axes `axes` at a point on it, from its Gaussian
/// and mean curvature (e.g. Harris, "Curvature of ellipsoids and other surfaces", 2006).
PrincipalCurvatures ellipsoid_curvatures(const Vector3& axes, const Vector3& point) {
  const Vector3 squares = axes.cwiseAbs2();
  const double support = point.cwiseQuotient(squares).squaredNorm();
  const double product = squares.prod();
  const double gauss = 1.0 / (product * support * support);
  const double mean =
      (squares.sum() - point.squaredNorm()) / (2.0 * product * std::pow(support, 1.5));
  const double deviation = std::sqrt(std::max(0.0, mean * mean - gauss));
  return {mean + deviation, mean - deviation};
}

/// Median relative errors of the larger and the smaller curvature.
std::array<double, 2> ellipsoid_errors(const IndexedMesh& mesh, const Vector3& axes, int rings) {
  const std::vector<PrincipalCurvatures> fitted = curvatures(mesh, rings);
  std::array<std::vector<double>, 2> errors;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const PrincipalCurvatures exact = ellipsoid_curvatures(axes, mesh.points[i]);
    errors[0].push_back(std::abs(fitted[i].maximum / exact.maximum - 1.0));
    errors[1].push_back(std::abs(fitted[i].minimum / exact.minimum - 1.0));
  }
  return {median(errors[0]), median(errors[1])};
}

TEST(Curvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {1e-6, 1.0, 1e3}) {
    for (const PrincipalCurvatures& k :
         curvatures(test::scaled(test::sphere(4), Vector3::Constant(radius)))) {
      // A paraboloid through points up to two edges of 0.07 away, and the square root of the
      // difference of two nearly equal numbers.
      EXPECT_NEAR(k.maximum * radius, 1.0, 0.02);
      EXPECT_NEAR(k.minimum * radius, 1.0, 0.02);
    }
  }
}

TEST(Curvature, OfAnEllipsoidIsTheKnownOne) {
  // 10242 vertices on the surface itself. The prototype's median errors were 0.1 % and 0.4 %.
  const Vector3 axes(1.0, 0.7, 0.5);
  const IndexedMesh mesh = test::scaled(test::sphere(5), axes);
  const std::array<double, 2> one_ring = ellipsoid_errors(mesh, axes, 1);
  EXPECT_LT(one_ring[0], 0.002);
  EXPECT_LT(one_ring[1], 0.004);
  const std::array<double, 2> two_rings = ellipsoid_errors(mesh, axes, 2);
  EXPECT_LT(two_rings[0], 0.006);
  EXPECT_LT(two_rings[1], 0.010);
}

TEST(Curvature, ConvergesWithTheSquareOfTheEdge) {
  const Vector3 axes(1.0, 0.7, 0.5);
  const double coarse = ellipsoid_errors(test::scaled(test::sphere(4), axes), axes, 2)[0];
  const double fine = ellipsoid_errors(test::scaled(test::sphere(5), axes), axes, 2)[0];
  EXPECT_NEAR(coarse / fine, 4.0, 0.8);
}

TEST(Curvature, OfATorusChangesSign) {
  const int segments = 120;
  const IndexedMesh mesh = test::torus(3.0, 1.0, segments);
  const std::vector<PrincipalCurvatures> fitted = curvatures(mesh);
  for (int j = 0; j < segments; ++j) {
    const double cosine = std::cos(2.0 * test::pi * j / segments);
    const PrincipalCurvatures& k = fitted[static_cast<std::size_t>(j)];
    // On the outer side two rings reach 0.42: the next terms are a quarter of its square.
    EXPECT_NEAR(k.maximum, 1.0, 0.045);
    EXPECT_NEAR(k.minimum, cosine / (3.0 + cosine), 0.045);
  }
}

TEST(Curvature, ChangesSignWithTheOrientation) {
  IndexedMesh mesh = test::lumpy(3);
  const std::vector<PrincipalCurvatures> outward = curvatures(mesh);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  const std::vector<PrincipalCurvatures> inward = curvatures(mesh);
  for (std::size_t i = 0; i < outward.size(); ++i) {
    EXPECT_NEAR(inward[i].maximum, -outward[i].minimum, 1e-10);
    EXPECT_NEAR(inward[i].minimum, -outward[i].maximum, 1e-10);
  }
}

TEST(Curvature, TurnsMovesAndScalesWithTheMesh) {
  const IndexedMesh mesh = test::lumpy(3);
  const std::vector<PrincipalCurvatures> plain = curvatures(mesh);
  const IndexedMesh moved = test::transformed(mesh, 4.0 * test::random_rotation(test::announced(3)),
                                              Vector3(10.0, -20.0, 30.0));
  const std::vector<PrincipalCurvatures> turned = curvatures(moved);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    // Curvatures of order one from heights of 1e-3, which there carry 1e-15.
    EXPECT_NEAR(4.0 * turned[i].maximum, plain[i].maximum, 1e-9);
    EXPECT_NEAR(4.0 * turned[i].minimum, plain[i].minimum, 1e-9);
  }
}

TEST(Curvature, NeedsTwoRingsOnAScan) {
  const test::Grain grain = test::ellipsoid_grain();
  const IndexedMesh scan = test::ct_mesh_of_about(grain, 4000);
  // Of the formula, after its scaling to the volume of the unit sphere.
  const Vector3 axes = Vector3(1.0, 0.7, 0.5) / std::cbrt(0.35);
  const double one_ring = ellipsoid_errors(scan, axes, 1)[0];
  const double two_rings = ellipsoid_errors(scan, axes, 2)[0];
  EXPECT_LT(two_rings, 0.6 * one_ring);
  EXPECT_LT(two_rings, 0.4);
}

TEST(Curvature, IsFiniteWhereTheFitIsUnderDetermined) {
  for (const IndexedMesh& mesh :
       {test::tetrahedron(1.0), test::box(1, 1, 1), test::icosahedron()}) {
    for (const PrincipalCurvatures& k : curvatures(mesh, 1)) {
      EXPECT_TRUE(std::isfinite(k.maximum) && std::isfinite(k.minimum));
      EXPECT_GE(k.maximum, k.minimum);
      EXPECT_GT(k.maximum, 0.0);  // all corners are convex
    }
  }
  // All in one point.
  const IndexedMesh point{std::vector<Vector3>(4, Vector3(1, 2, 3)),
                          test::tetrahedron(1).triangles};
  for (const PrincipalCurvatures& k : curvatures(point)) EXPECT_EQ(k.maximum, 0.0);
}

TEST(Curvature, IsTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(4);
  const std::vector<PrincipalCurvatures> one = quadric_fit_curvatures(mesh, 2, Execution(1));
  const std::vector<PrincipalCurvatures> three = quadric_fit_curvatures(mesh, 2, Execution(3));
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].maximum, three[i].maximum);
    EXPECT_EQ(one[i].minimum, three[i].minimum);
  }
}

TEST(Curvature, RefusesNoRings) {
  EXPECT_ERROR(curvatures(test::sphere(1), 0), InvalidInput);
  EXPECT_ERROR(curvatures(test::sphere(1), -1), InvalidInput);
}

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
