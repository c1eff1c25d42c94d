// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/mesh_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {
namespace {

MeshSurface surface_of(const IndexedMesh& mesh, const Vector3& centre = Vector3::Zero(),
                       double unit = 1.0) {
  return MeshSurface(mesh, centre, unit, overhang_solid_angle(mesh, centre, Execution(1)),
                     Execution(1));
}

/// Outermost distance by testing every triangle (Moeller and Trumbore), with edges taken
/// generously.
double brute_force_radius(const IndexedMesh& mesh, const Vector3& u) {
  double outermost = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.points[t[0]];
    const Vector3 e = mesh.points[t[1]] - a;
    const Vector3 f = mesh.points[t[2]] - a;
    const double determinant = e.dot(u.cross(f));
    if (std::abs(determinant) < 1e-14) continue;
    const double v = -a.dot(u.cross(f)) / determinant;
    const double w = u.dot((-a).cross(e)) / determinant;
    const double distance = f.dot((-a).cross(e)) / determinant;
    const double slack = -1e-12;
    if (v >= slack && w >= slack && v + w <= 1.0 - slack) outermost = std::max(outermost, distance);
  }
  return outermost;
}

TEST(MeshSurface, GivesTheRadiusOfABox) {
  const Vector3 half(0.5, 1.0, 1.5);
  const MeshSurface surface = surface_of(test::box(1, 2, 3));
  for (const Vector3& u : random_directions(2000, test::announced(1))) {
    const double expected = (half.array() / u.array().abs()).minCoeff();
    EXPECT_NEAR(surface.radius(u), expected, 1e-14 * expected);
  }
}

TEST(MeshSurface, MovesAndScales) {
  const Vector3 centre(1e6, -2e6, 0.0);
  const IndexedMesh mesh =
      test::transformed(test::lumpy(3), 5.0 * Eigen::Matrix3d::Identity(), centre);
  const MeshSurface moved = surface_of(mesh, centre, 5.0);
  const MeshSurface plain = surface_of(test::lumpy(3));
  for (const Vector3& u : random_directions(500, test::announced(2))) {
    EXPECT_NEAR(moved.radius(u), plain.radius(u), 1e-8);  // positions there carry 5e-10
  }
}

TEST(MeshSurface, AgreesWithTestingEveryTriangle) {
  const Eigen::Matrix3d rotation = test::random_rotation(test::announced(4));
  const struct {
    IndexedMesh mesh;
    Vector3 centre;
  } cases[] = {
      {test::tetrahedron(1), {0, 0, 0}},
      {test::tetrahedron(1), {0.1, 0.1, 0.11}},  // close to a face, which fills most of the view
      {test::transformed(test::tetrahedron(1), rotation), {0, 0, 0}},
      {test::lumpy(2), {0.3, -0.2, 0.1}},
      {test::torus(1.0, 0.7, 30), {1.0, 0.0, 0.0}},  // folds
      {test::transformed(test::torus(1.0, 0.7, 30), rotation), rotation * Vector3(1.0, 0.1, 0.0)},
  };
  for (const auto& c : cases) {
    const MeshSurface surface = surface_of(c.mesh, c.centre);
    for (const Vector3& u : random_directions(1000, test::announced(5))) {
      const double expected = brute_force_radius(surface.mesh(), u);
      // Conditioning of a grazing hit: the torus is met at down to a hundredth of a radian.
      ASSERT_NEAR(surface.radius(u), expected, 1e-11) << u.transpose();
    }
  }
}

TEST(MeshSurface, MissesNoEdgeAndNoVertex) {
  for (const IndexedMesh& mesh :
       {test::sphere(4), test::lumpy(4), test::box(1, 1, 1), test::tetrahedron(1),
        test::transformed(test::lumpy(4), test::random_rotation(test::announced(6)))}) {
    const MeshSurface surface = surface_of(mesh);
    for (const Vector3& p : mesh.points) {
      EXPECT_NEAR(surface.outermost_hit(p.normalized()).radius, p.norm(), 1e-13 * p.norm());
    }
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (const double share : {0.5, 0.25, 1e-3, 1e-9, 1e-15}) {
          const Vector3 p = (1.0 - share) * mesh.points[t[k]] + share * mesh.points[t[(k + 1) % 3]];
          ASSERT_NEAR(surface.outermost_hit(p.normalized()).radius, p.norm(), 1e-13 * p.norm());
        }
      }
    }
  }
}

TEST(MeshSurface, TakesTheOutermostSheet) {
  const IndexedMesh plate =
      test::transformed(test::box(1, 1, 0.1), Eigen::Matrix3d::Identity(), Vector3(0, 0, 3.0));
  const MeshSurface surface = surface_of(test::joined(test::sphere(3), plate));
  EXPECT_NEAR(surface.radius(Vector3(0, 0, 1)), 3.05, 1e-14);
  EXPECT_NEAR(surface.radius(Vector3(0, 0, -1)), 1.0, 1e-2);
  const Vector3 beside = Vector3(0.6, 0, 3).normalized();
  EXPECT_NEAR(surface.radius(beside), 1.0, 1e-2);
}

TEST(MeshSurface, DerivativesAreThoseOfTheFacet) {
  // Within one triangle the radius is analytic: differences against the jet.
  const MeshSurface surface =
      surface_of(test::transformed(test::lumpy(2), test::random_rotation(test::announced(8))));
  const double step = 1e-4;
  std::size_t tried = 0;
  for (const Vector3& u : random_directions(300, test::announced(9))) {
    const Vector3 e = u.unitOrthogonal();
    const Vector3 f = u.cross(e);
    const std::int32_t here = surface.outermost_hit(u).triangle;
    const auto at = [&](double s, double t) {
      return (u + s * step * e + t * step * f).normalized();
    };
    bool one_facet = true;
    for (int s = -1; s <= 1; ++s) {
      for (int t = -1; t <= 1; ++t) {
        one_facet = one_facet && surface.outermost_hit(at(s, t)).triangle == here;
      }
    }
    if (!one_facet) continue;
    ++tried;
    RadialJet jet;
    surface.evaluate(&u, 1, Derivatives::Second, &jet);
    const auto r = [&](double s, double t) { return surface.radius(at(s, t)); };
    // Central differences: step^2 times a few derivatives of order ten.
    EXPECT_NEAR(jet.gradient.dot(e), (r(1, 0) - r(-1, 0)) / (2 * step), 1e-5);
    EXPECT_NEAR(jet.gradient.dot(f), (r(0, 1) - r(0, -1)) / (2 * step), 1e-5);
    EXPECT_NEAR(jet.gradient.dot(u), 0.0, 1e-13);
    EXPECT_NEAR(e.dot(jet.hessian * e), (r(1, 0) - 2 * r(0, 0) + r(-1, 0)) / (step * step), 1e-4);
    EXPECT_NEAR(f.dot(jet.hessian * f), (r(0, 1) - 2 * r(0, 0) + r(0, -1)) / (step * step), 1e-4);
    EXPECT_NEAR(e.dot(jet.hessian * f),
                (r(1, 1) - r(1, -1) - r(-1, 1) + r(-1, -1)) / (4 * step * step), 1e-4);
    EXPECT_LT((jet.hessian * u + jet.gradient).norm(), 1e-12);
    // A plane is not curved.
    const PrincipalCurvatures curvatures = principal_curvatures(jet, u);
    EXPECT_NEAR(curvatures.maximum, 0.0, 1e-11);
    EXPECT_NEAR(curvatures.minimum, 0.0, 1e-11);
  }
  EXPECT_GT(tried, 250U);
}

TEST(MeshSurface, FansOfNeedlesGetBinsOfBoundedSize) {
  // At a resolution after their number these 4000 needles fill 50 cells each on average.
  const IndexedMesh fan = test::transformed(test::bicone(2000), test::random_rotation(8));
  const MeshSurface surface = surface_of(fan);
  for (const Vector3& u : random_directions(500, 9)) {
    // A needle is 3e-3 wide: a thousandth of the condition of the cases above is lost.
    ASSERT_NEAR(surface.radius(u), brute_force_radius(fan, u), 1e-11) << u.transpose();
  }
  // Entered cell by cell, this one would take some 10 GB and a minute.
  const IndexedMesh dense = test::transformed(test::bicone(100000), test::random_rotation(8));
  const MeshSurface of_dense = surface_of(dense);
  for (const Vector3& u : random_directions(100, 10)) {
    // |u_z| + hypot(u_x, u_y) is 1 / r on the cone itself; the chords lose 5e-10.
    const Vector3 v = test::random_rotation(8).transpose() * u;
    EXPECT_NEAR(of_dense.radius(u), 1.0 / (std::abs(v.z()) + std::hypot(v.x(), v.y())), 1e-8);
  }
}

TEST(MeshSurface, IntegratesToTheVolumeOfTheMesh) {
  const IndexedMesh mesh = test::lumpy(3);
  const double volume = check_mesh(mesh, MeshCheckOptions(), Execution(1)).report.volume;
  const MeshSurface surface = surface_of(mesh);
  const std::vector<Vector3> u = fibonacci_lattice(100000);
  double sum = 0.0;
  for (const double r : surface.radii(u, Execution(1))) sum += r * r * r;
  // The lattice resolves facets of 0.15 by steps of 0.011; errors of kinks average out.
  EXPECT_NEAR(4.0 * test::pi / 3.0 * sum / static_cast<double>(u.size()), volume, 1e-5 * volume);
}

TEST(MeshSurface, GivesTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(5);
  const std::vector<Vector3> u = random_directions(5000, test::announced(11));
  const MeshSurface one(mesh, Vector3::Zero(), 1.3, 0.0, Execution(1));
  const MeshSurface four(mesh, Vector3::Zero(), 1.3, 0.0, Execution(4));
  EXPECT_EQ(one.radii(u, Execution(1)), four.radii(u, Execution(4)));
  for (const Vector3& v : u) {
    EXPECT_EQ(one.outermost_hit(v).triangle, four.outermost_hit(v).triangle);
  }
}

TEST(MeshSurface, RefusesWhatHasNoInside) {
  EXPECT_ERROR(surface_of({}), InvalidInput);
  EXPECT_ERROR(surface_of(test::sphere(2), Vector3(2, 0, 0)), InvalidInput);
  EXPECT_ERROR(surface_of(test::box(1, 1, 1), Vector3(0.5, 0.1, 0.2)), InvalidInput);
  for (const double unit : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_ERROR(surface_of(test::sphere(2), Vector3::Zero(), unit), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
