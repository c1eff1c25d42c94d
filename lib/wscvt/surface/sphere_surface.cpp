// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/sphere_surface.h"

#include <algorithm>
#include <cmath>

#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

constexpr std::size_t direction_block = 1024;

}  // namespace

std::vector<SurfaceJet> SphereSurface::surface_jets(const std::vector<Vector3>& directions,
                                                    Derivatives derivatives,
                                                    const Execution& execution) const {
  std::vector<SurfaceJet> result(directions.size());
  execution.parallel_for(
      directions.size(), direction_block, [&](std::size_t begin, std::size_t end) {
        evaluate_jets(directions.data() + begin, end - begin, derivatives, result.data() + begin);
      });
  return result;
}

void SphereSurface::evaluate_positions(const Vector3* directions, std::size_t count,
                                       Vector3* positions) const {
  std::vector<SurfaceJet> jets(count);
  evaluate_jets(directions, count, Derivatives::None, jets.data());
  for (std::size_t i = 0; i < count; ++i) positions[i] = jets[i].position;
}

void SphereSurface::evaluate_shapes(const Vector3* directions, std::size_t count,
                                    Derivatives derivatives, LocalShape* shapes) const {
  std::vector<SurfaceJet> jets(count);
  evaluate_jets(directions, count, derivatives, jets.data());
  for (std::size_t i = 0; i < count; ++i) {
    shapes[i] = LocalShape();
    shapes[i].distance = jets[i].position.norm();
    if (derivatives == Derivatives::None) continue;
    shapes[i].area_element = area_element(jets[i], directions[i]);
    if (derivatives == Derivatives::First) continue;
    shapes[i].curvatures = principal_curvatures(jets[i], directions[i]);
  }
}

std::vector<Vector3> SphereSurface::positions(const std::vector<Vector3>& directions,
                                              const Execution& execution) const {
  std::vector<Vector3> result(directions.size());
  execution.parallel_for(
      directions.size(), direction_block, [&](std::size_t begin, std::size_t end) {
        evaluate_positions(directions.data() + begin, end - begin, result.data() + begin);
      });
  return result;
}

std::vector<double> SphereSurface::distances(const std::vector<Vector3>& directions,
                                             const Execution& execution) const {
  std::vector<double> result(directions.size());
  execution.parallel_for(
      directions.size(), direction_block, [&](std::size_t begin, std::size_t end) {
        std::vector<LocalShape> shapes(end - begin);
        evaluate_shapes(directions.data() + begin, shapes.size(), Derivatives::None, shapes.data());
        for (std::size_t i = begin; i < end; ++i) result[i] = shapes[i - begin].distance;
      });
  return result;
}

Vector3 area_normal(const SurfaceJet& jet, const Vector3& direction) {
  // J e1 x J e2 for tangents with e1 x e2 = u is the cofactor matrix of J times u, so no tangents
  // are needed.
  const Vector3 x = jet.jacobian.col(0);
  const Vector3 y = jet.jacobian.col(1);
  const Vector3 z = jet.jacobian.col(2);
  return direction.x() * y.cross(z) + direction.y() * z.cross(x) + direction.z() * x.cross(y);
}

double area_element(const SurfaceJet& jet, const Vector3& direction) {
  return area_normal(jet, direction).norm();
}

Vector3 surface_normal(const SurfaceJet& jet, const Vector3& direction) {
  return area_normal(jet, direction).stableNormalized();
}

PrincipalCurvatures principal_curvatures(const SurfaceJet& jet, const Vector3& direction) {
  const Vector3 e1 = direction.unitOrthogonal();
  const Vector3 e2 = direction.cross(e1);
  const Vector3 x1 = jet.jacobian * e1;
  const Vector3 x2 = jet.jacobian * e2;
  const Vector3 normal = x1.cross(x2).stableNormalized();
  // Along a great circle u'' = -u, and J u = 0, so the second derivatives of x come only from the
  // Hessians.
  Matrix3 bending = Matrix3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    bending -= normal[static_cast<Eigen::Index>(k)] * jet.hessians[k];
  }
  const double l = e1.dot(bending * e1);
  const double m = e1.dot(bending * e2);
  const double n = e2.dot(bending * e2);
  const double e = x1.squaredNorm();
  const double f = x1.dot(x2);
  const double g = x2.squaredNorm();
  const double determinant = e * g - f * f;
  const double mean = 0.5 * (e * n - 2.0 * f * m + g * l) / determinant;
  const double product = (l * n - m * m) / determinant;
  const double spread = std::sqrt(std::max(0.0, mean * mean - product));
  return {mean + spread, mean - spread};
}

BodyIntegrals body_integrals(const SphereSurface& surface, int polar_nodes,
                             const Execution& execution) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(polar_nodes);
  const std::vector<Vector3>& u = quadrature.directions;
  using Sums = Eigen::Matrix<double, 5, 1>;
  const Sums sums = execution.parallel_sum(
      u.size(), direction_block, Sums(Sums::Zero()), [&](std::size_t begin, std::size_t end) {
        std::vector<SurfaceJet> jets(end - begin);
        surface.evaluate_jets(u.data() + begin, jets.size(), Derivatives::First, jets.data());
        Sums part = Sums::Zero();
        for (std::size_t i = begin; i < end; ++i) {
          const Vector3& x = jets[i - begin].position;
          const Vector3 normal = area_normal(jets[i - begin], u[i]);
          const double cone = quadrature.weights[i] * x.dot(normal);  // three times its volume
          part[0] += cone / 3.0;
          part[1] += quadrature.weights[i] * normal.norm();
          part.segment<3>(2) += 0.25 * cone * x;
        }
        return part;
      });
  BodyIntegrals result;
  result.volume = sums[0];
  result.area = sums[1];
  if (result.volume != 0.0) result.centroid = sums.segment<3>(2) / result.volume;
  return result;
}

AreaElements area_elements(const SphereSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution) {
  AreaElements result;
  result.distances.resize(directions.size());
  result.elements.resize(directions.size());
  execution.parallel_for(directions.size(), direction_block,
                         [&](std::size_t begin, std::size_t end) {
                           std::vector<LocalShape> shapes(end - begin);
                           surface.evaluate_shapes(directions.data() + begin, shapes.size(),
                                                   Derivatives::First, shapes.data());
                           for (std::size_t i = begin; i < end; ++i) {
                             result.distances[i] = shapes[i - begin].distance;
                             result.elements[i] = shapes[i - begin].area_element;
                           }
                         });
  return result;
}

double surface_area(const SphereSurface& surface, int polar_nodes, const Execution& execution) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(polar_nodes);
  const std::vector<double> elements =
      area_elements(surface, quadrature.directions, execution).elements;
  return execution.parallel_sum(elements.size(), direction_block, 0.0,
                                [&](std::size_t begin, std::size_t end) {
                                  double part = 0.0;
                                  for (std::size_t i = begin; i < end; ++i)
                                    part += quadrature.weights[i] * elements[i];
                                  return part;
                                });
}

IndexedMesh mesh_of_surface(const SphereSurface& surface, int frequency,
                            const Execution& execution) {
  IndexedMesh mesh = subdivided_sphere(frequency);
  mesh.points = surface.positions(mesh.points, execution);
  return mesh;
}

}  // namespace wscvt
