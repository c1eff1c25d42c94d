// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/surface_low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/expect_error.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

std::vector<Vector3> filtered(SurfaceLowPass& filter, const std::vector<Vector3>& points,
                              const std::vector<Vector3>& values, double cutoff) {
  filter.set_surface(points, cutoff, Execution(1));
  return filter.filter(values, Execution(1));
}

/// p(h) for the eigenvalue `square` of the Laplacian.
double passed(double square, double cutoff) {
  const double wave = cutoff / (2.0 * test::pi);
  const double h = 1.0 / (1.0 + wave * wave * square);
  return h * h * h * (10.0 - 15.0 * h + 6.0 * h * h);
}

TEST(SurfaceLowPass, PassesHarmonicsOfASphereAsItsFormulaSays) {
  // Y of degree l is an eigenfunction, l (l + 1). Degree 1: x; degree 2: x y; degree 3: x y z.
  const double radius = 3.0;
  const IndexedMesh mesh = test::moved(test::sphere(4), radius, Vector3::Zero());
  std::vector<Vector3> values;
  for (const Vector3& p : mesh.points) values.emplace_back(p.x(), p.x() * p.y(), p.prod());
  SurfaceLowPass filter(mesh.triangles, mesh.points.size());
  for (const double cutoff : {1.0, 6.0, 12.0}) {
    SCOPED_TRACE(cutoff);
    const std::vector<Vector3> low = filtered(filter, mesh.points, values, cutoff);
    Vector3 products = Vector3::Zero();
    Vector3 squares = Vector3::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
      products += low[i].cwiseProduct(values[i]);
      squares += values[i].cwiseAbs2();
    }
    for (int k = 0; k < 3; ++k) {
      const double degree = k + 1.0;
      // The mesh's own eigenvalues differ by its chords, (edge / radius)^2.
      EXPECT_NEAR(products[k] / squares[k],
                  passed(degree * (degree + 1.0) / (radius * radius), cutoff), 5e-3);
    }
  }
}

TEST(SurfaceLowPass, KeepsConstantsAndTheMean) {
  const IndexedMesh mesh = test::lumpy(3);
  std::vector<Vector3> values;
  for (const Vector3& p : mesh.points) values.emplace_back(7.0, p.z() > 0.0 ? 1.0 : 0.0, p.x());
  SurfaceLowPass filter(mesh.triangles, mesh.points.size());
  const std::vector<Vector3> low = filtered(filter, mesh.points, values, 1.0);
  double least = 1.0;
  double most = 0.0;
  for (const Vector3& v : low) {
    EXPECT_NEAR(v.x(), 7.0, 1e-9);
    least = std::min(least, v.y());
    most = std::max(most, v.y());
  }
  // A step overshoots, by 1 % on either side with this polynomial, but not more.
  EXPECT_GT(least, -0.1);
  EXPECT_LT(most, 1.1);
}

TEST(SurfaceLowPass, FiltersInTheMetricOfThePointsThatItIsGiven) {
  // Half as large a surface has waves half as long.
  const IndexedMesh mesh = test::sphere(3);
  std::vector<Vector3> values;
  for (const Vector3& p : mesh.points) values.emplace_back(p.x() * p.y(), 0.0, 0.0);
  const IndexedMesh half = test::moved(mesh, 0.5, Vector3::Zero());
  SurfaceLowPass filter(mesh.triangles, mesh.points.size());
  const std::vector<Vector3> a = filtered(filter, mesh.points, values, 2.0);
  const std::vector<Vector3> b = filtered(filter, half.points, values, 1.0);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].x(), b[i].x(), 1e-12);
}

TEST(SurfaceLowPass, StandsFacesWithoutArea) {
  // The last vertex lies on an edge's middle: two faces of one line.
  IndexedMesh mesh = test::box(1.0, 1.0, 1.0);
  const Triangle t = mesh.triangles.back();
  const Vector3 a = mesh.points[t[0]];
  const Vector3 b = mesh.points[t[1]];
  const auto middle = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(0.5 * (a + b));
  mesh.triangles.back() = {t[0], middle, t[2]};
  mesh.triangles.push_back({middle, t[1], t[2]});
  mesh.triangles.push_back({middle, t[0], t[1]});
  SurfaceLowPass filter(mesh.triangles, mesh.points.size());
  for (const Vector3& v : filtered(filter, mesh.points, mesh.points, 1.0)) {
    EXPECT_TRUE(v.allFinite());
    EXPECT_LT(v.norm(), 1.0);
  }
}

TEST(SurfaceLowPass, RefusesWhatDoesNotFit) {
  const IndexedMesh mesh = test::sphere(1);
  SurfaceLowPass filter(mesh.triangles, mesh.points.size());
  EXPECT_ERROR(filter.set_surface(mesh.points, 0.0, Execution(1)), InvalidInput);
  EXPECT_ERROR(filter.set_surface(mesh.points, std::nan(""), Execution(1)), InvalidInput);
  EXPECT_ERROR(filter.set_surface({}, 1.0, Execution(1)), InvalidInput);
  filter.set_surface(mesh.points, 1.0, Execution(1));
  EXPECT_ERROR(filter.filter({}, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
