// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/node_placement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/cancelled_runs.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/quadric_surface.h"

namespace wscvt {
namespace {

constexpr std::size_t sample_count = 20000;

struct Nodes {
  std::vector<Vector3> directions;
  std::vector<Triangle> triangles;
};

Nodes lattice(int count) {
  const std::vector<Vector3> directions = fibonacci_lattice(count);
  return {directions, SphereTriangulation(directions).triangles()};
}

IndexedMesh mesh_of(const Nodes& nodes, const std::vector<double>& radii) {
  IndexedMesh mesh{nodes.directions, nodes.triangles};
  for (std::size_t i = 0; i < radii.size(); ++i) mesh.points[i] *= radii[i];
  return mesh;
}

TEST(LeastSquaresRadii, FindsAPolyhedronOnItsOwnVertices) {
  // 1 / r is linear on a flat triangle, so the fit has no error to leave.
  const IndexedMesh body = test::lumpy(2);
  const MeshSurface surface(body, Vector3::Zero(), 1.0, Execution(1));
  Nodes nodes{body.points, body.triangles};
  for (Vector3& p : nodes.directions) p.normalize();
  const std::vector<double> radii =
      least_squares_radii(nodes.directions, nodes.triangles, surface, sample_count, Execution(1));
  for (std::size_t i = 0; i < radii.size(); ++i) {
    EXPECT_NEAR(radii[i], body.points[i].norm(), 1e-12);
  }
}

TEST(LeastSquaresRadii, OfASphereLieAboveItAndHalveItsDistance) {
  const Ellipsoid sphere(Vector3(1, 1, 1));
  const Nodes nodes = lattice(200);
  const std::vector<double> radii =
      least_squares_radii(nodes.directions, nodes.triangles, sphere, sample_count, Execution(1));
  for (const double r : radii) {
    EXPECT_GT(r, 1.0);
    // The sagitta of the largest triangle, edge 0.3: 1 - sqrt(1 - 0.3^2 / 3) = 0.015.
    EXPECT_LT(r, 1.03);
  }
  const IndexedMesh dense = test::sphere(5);
  const auto distance = [&](const IndexedMesh& mesh) {
    return measure_distances(mesh, dense, {20000}, Execution(1)).root_mean_square;
  };
  EXPECT_LT(distance(mesh_of(nodes, radii)),
            0.5 * distance(mesh_of(nodes, std::vector<double>(radii.size(), 1.0))));
}

/// Distance from the origin of the flat triangles between unit nodes, in each of the directions.
std::vector<double> flat_radii(const Nodes& nodes, const std::vector<Vector3>& directions) {
  const IndexedMesh mesh{nodes.directions, nodes.triangles};
  return MeshSurface(mesh, Vector3::Zero(), 1.0, Execution(1)).radii(directions, Execution(1));
}

double mean_over_sphere(const SphereQuadrature& quadrature, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += quadrature.weights[i] * values[i];
  return sum / (4.0 * test::pi);
}

TEST(LeastSquaresRadii, OfAnOctahedronInASphereHaveAClosedForm) {
  // All radii are one number R, and the mesh stands at R d(u), d that of the unit octahedron. The
  // mean of (1 / (R d) - 1)^2 (R_1 d)^2 is least, for any R_1, where 1 / R is the mean of d. The
  // first solve alone, without (R_1 d)^2, would give the mean of 1 / d^2 over that of 1 / d.
  const std::vector<Vector3> corners = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                        {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  const Nodes nodes{corners, SphereTriangulation(corners).triangles()};
  const SphereQuadrature quadrature = gauss_legendre_sphere(200);
  const std::vector<double> flat = flat_radii(nodes, quadrature.directions);
  const double expected = 1.0 / mean_over_sphere(quadrature, flat);
  for (const double r : least_squares_radii(corners, nodes.triangles, Ellipsoid(Vector3(1, 1, 1)),
                                            sample_count, Execution(1))) {
    // The kinks at the edges cost the quadrature of 400 azimuths a few times 1e-5.
    EXPECT_NEAR(r, expected, 2e-4);
  }
}

TEST(LeastSquaresRadii, StayNearTheSurfaceWhereNodesHardlySurroundTheOrigin) {
  // As above for a tetrahedron, which passes the origin at a third of its radius.
  const std::vector<Vector3> corners = {
      Vector3(1, 1, 1).normalized(), Vector3(1, -1, -1).normalized(),
      Vector3(-1, 1, -1).normalized(), Vector3(-1, -1, 1).normalized()};
  const Nodes nodes{corners, SphereTriangulation(corners).triangles()};
  const SphereQuadrature quadrature = gauss_legendre_sphere(200);
  ASSERT_GT(1.0 / mean_over_sphere(quadrature, flat_radii(nodes, quadrature.directions)), 1.6);
  for (const double r : least_squares_radii(corners, nodes.triangles, Ellipsoid(Vector3(2, 2, 2)),
                                            sample_count, Execution(1))) {
    EXPECT_NEAR(r, 2.0 * 1.5, 1e-12);
  }
}

TEST(LeastSquaresRadii, ScaleAndTurnWithTheSurface) {
  const IndexedMesh body = test::lumpy(3);
  const Nodes nodes = lattice(150);
  const std::vector<double> radii = least_squares_radii(
      nodes.directions, nodes.triangles, MeshSurface(body, Vector3::Zero(), 1.0, Execution(1)),
      sample_count, Execution(1));
  const Eigen::Matrix3d rotation = test::random_rotation(test::announced(7));
  Nodes turned = nodes;
  for (Vector3& u : turned.directions) u = rotation * u;
  const std::vector<double> moved = least_squares_radii(
      turned.directions, turned.triangles,
      MeshSurface(test::transformed(body, 1000.0 * rotation), Vector3::Zero(), 1.0, Execution(1)),
      sample_count, Execution(1));
  // Samples that fall on an edge of the body may take the gradient of either face.
  for (std::size_t i = 0; i < radii.size(); ++i) EXPECT_NEAR(moved[i] / 1000.0, radii[i], 1e-4);
}

TEST(LeastSquaresRadii, SameBytesOnAnyNumberOfThreads) {
  const MeshSurface surface(test::lumpy(3), Vector3::Zero(), 1.0, Execution(1));
  const Nodes nodes = lattice(300);
  EXPECT_EQ(
      least_squares_radii(nodes.directions, nodes.triangles, surface, sample_count, Execution(1)),
      least_squares_radii(nodes.directions, nodes.triangles, surface, sample_count, Execution(3)));
}

TEST(LeastSquaresRadii, StopWhenAskedTo) {
  const Ellipsoid ellipsoid(Vector3(1.0, 1.2, 1.4));
  const Nodes nodes = lattice(2000);
  // Twice, once a step of the solver's and about the making of its matrix.
  test::expect_to_be_stopped(
      [&](const Execution& execution) {
        least_squares_radii(nodes.directions, nodes.triangles, ellipsoid, sample_count, execution);
      },
      "Placing the nodes", 2 * (10 + 2));
}

TEST(LeastSquaresRadii, RefusesNodesOfNoTriangle) {
  Nodes nodes = lattice(50);
  nodes.directions.emplace_back(1, 0, 0);
  const Ellipsoid sphere(Vector3(1, 1, 1));
  test::expect_error(ErrorCode::InvalidInput, [&] {
    least_squares_radii(nodes.directions, nodes.triangles, sphere, sample_count, Execution(1));
  });
}

TEST(ScaleToVolume, MakesTheVolumeExact) {
  IndexedMesh mesh = test::lumpy(3);
  const std::vector<Vector3> before = mesh.points;
  for (const double volume : {1e-30, 0.7, 4e20}) {
    scale_to_volume(mesh.triangles, volume, mesh.points, Execution(2));
    // Rounding of a sum of 1280 terms.
    EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume / volume, 1.0, 1e-12);
    EXPECT_NEAR(mesh.points[5].normalized().dot(before[5].normalized()), 1.0, 1e-15);
  }
}

TEST(ScaleToVolume, RefusesVolumesThatAreNotPositive) {
  IndexedMesh mesh = test::sphere(1);
  const std::vector<Vector3> before = mesh.points;
  test::expect_error(ErrorCode::NumericalFailure,
                     [&] { scale_to_volume(mesh.triangles, 0.0, mesh.points, Execution(1)); });
  mesh.triangles.clear();
  test::expect_error(ErrorCode::NumericalFailure,
                     [&] { scale_to_volume(mesh.triangles, 1.0, mesh.points, Execution(1)); });
  EXPECT_EQ(mesh.points, before);
}

}  // namespace
}  // namespace wscvt
