// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/radial_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

constexpr std::size_t radius_block = 1024;

}  // namespace

void RadialSurface::evaluate_radii(const Vector3* directions, std::size_t count,
                                   double* radii) const {
  std::vector<RadialJet> jets(count);
  evaluate(directions, count, Derivatives::None, jets.data());
  for (std::size_t i = 0; i < count; ++i) radii[i] = jets[i].radius;
}

std::vector<RadialJet> RadialSurface::jets(const std::vector<Vector3>& directions,
                                           Derivatives derivatives,
                                           const Execution& execution) const {
  std::vector<RadialJet> result(directions.size());
  execution.parallel_for(directions.size(), radius_block, [&](std::size_t begin, std::size_t end) {
    evaluate(directions.data() + begin, end - begin, derivatives, result.data() + begin);
  });
  return result;
}

std::vector<double> RadialSurface::radii(const std::vector<Vector3>& directions,
                                         const Execution& execution) const {
  std::vector<double> result(directions.size());
  execution.parallel_for(directions.size(), radius_block, [&](std::size_t begin, std::size_t end) {
    evaluate_radii(directions.data() + begin, end - begin, result.data() + begin);
  });
  return result;
}

double RadialSurface::radius(const Vector3& direction) const {
  double result = 0.0;
  evaluate_radii(&direction, 1, &result);
  return result;
}

Vector3 surface_normal(const RadialJet& jet, const Vector3& direction) {
  return (jet.radius * direction - jet.gradient).normalized();
}

PrincipalCurvatures principal_curvatures(const RadialJet& jet, const Vector3& direction) {
  // F(x) = |x| - r(x/|x|) at |x| = r: the extension's gradient scales with 1/r, its Hessian with
  // 1/r^2.
  const double r = jet.radius;
  const Vector3 gradient = direction - jet.gradient / r;
  const Matrix3 hessian =
      (Matrix3::Identity() - direction * direction.transpose()) / r - jet.hessian / (r * r);
  const double slope = gradient.norm();
  const Vector3 normal = gradient / slope;
  const Vector3 first = normal.unitOrthogonal();
  const Vector3 second = normal.cross(first);
  const double a = first.dot(hessian * first) / slope;
  const double b = first.dot(hessian * second) / slope;
  const double c = second.dot(hessian * second) / slope;
  const double mean = 0.5 * (a + c);
  const double deviation = portable::hypot(0.5 * (a - c), b);
  return {mean + deviation, mean - deviation};
}

RadialJet jet_from_extension(double radius, const Vector3& gradient, const Matrix3& hessian,
                             const Vector3& direction) {
  RadialJet jet = jet_from_extension(radius, gradient, direction);
  const Matrix3 projection = Matrix3::Identity() - direction * direction.transpose();
  jet.hessian = projection * hessian * projection - gradient.dot(direction) * projection -
                jet.gradient * direction.transpose() - direction * jet.gradient.transpose();
  return jet;
}

AreaElements area_elements(const RadialSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution) {
  AreaElements result;
  result.radii.resize(directions.size());
  result.elements.resize(directions.size());
  execution.parallel_for(directions.size(), radius_block, [&](std::size_t begin, std::size_t end) {
    std::vector<RadialJet> jets(end - begin);
    surface.evaluate(directions.data() + begin, jets.size(), Derivatives::First, jets.data());
    for (std::size_t i = begin; i < end; ++i) {
      result.radii[i] = jets[i - begin].radius;
      result.elements[i] = area_element(jets[i - begin]);
    }
  });
  return result;
}

double surface_area(const RadialSurface& surface, int polar_nodes, const Execution& execution) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(polar_nodes);
  const std::vector<double> elements =
      area_elements(surface, quadrature.directions, execution).elements;
  return execution.parallel_sum_of(
      elements.size(), radius_block, 0.0,
      [&](std::size_t i, double& part) { part += quadrature.weights[i] * elements[i]; });
}

IndexedMesh mesh_of_surface(const RadialSurface& surface, int frequency,
                            const Execution& execution) {
  IndexedMesh mesh = subdivided_sphere(frequency);
  const std::vector<double> radii = surface.radii(mesh.points, execution);
  for (std::size_t i = 0; i < radii.size(); ++i) mesh.points[i] = radii[i] * mesh.points[i];
  return mesh;
}

SurfaceIntegrals integrate(const RadialSurface& surface, int polar_nodes,
                           const Execution& execution) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(polar_nodes);
  const std::vector<Vector3>& u = quadrature.directions;
  using Sums = Eigen::Matrix<double, 6, 1>;
  const Sums sums = execution.parallel_sum(
      u.size(), radius_block, Sums(Sums::Zero()), [&](std::size_t begin, std::size_t end) {
        std::vector<RadialJet> jets(end - begin);
        surface.evaluate(u.data() + begin, end - begin, Derivatives::First, jets.data());
        Sums part = Sums::Zero();
        for (std::size_t i = begin; i < end; ++i) {
          const RadialJet& jet = jets[i - begin];
          const double w = quadrature.weights[i];
          const double r3 = jet.radius * jet.radius * jet.radius;
          part[0] += w * r3 / 3.0;
          part[1] += w * area_element(jet);
          part.segment<3>(2) += w * r3 * jet.radius / 4.0 * u[i];
          part[5] += w * jet.gradient.squaredNorm();
        }
        return part;
      });
  SurfaceIntegrals result;
  result.volume = sums[0];
  result.area = sums[1];
  result.centroid = sums.segment<3>(2) / sums[0];
  result.gradient_square = sums[5];
  return result;
}

SurfaceIntegrals integrate(const RadialSurface& surface, const Execution& execution) {
  constexpr int first_polar_nodes = 200;
  constexpr int last_polar_nodes = 1600;
  constexpr double tolerance = 1e-5;
  constexpr double last_tolerance = 1e-4;
  SurfaceIntegrals coarse = integrate(surface, first_polar_nodes, execution);
  for (int polar_nodes = 2 * first_polar_nodes; polar_nodes <= last_polar_nodes; polar_nodes *= 2) {
    SurfaceIntegrals fine = integrate(surface, polar_nodes, execution);
    if (!(fine.volume > 0.0) || !std::isfinite(fine.volume) || !std::isfinite(fine.area)) {
      refuse("The surface encloses no volume about its origin. Check its axes or coefficients.");
    }
    const double change = std::max(std::abs(fine.volume - coarse.volume) / fine.volume,
                                   std::abs(fine.area - coarse.area) / fine.area);
    if (change <= (polar_nodes < last_polar_nodes ? tolerance : last_tolerance)) return fine;
    coarse = fine;
  }
  refuse(
      "The surface is too long, too flat or too sharp to be measured from its origin. Make its "
      "axes more alike, or round its edges.");
}

}  // namespace wscvt
