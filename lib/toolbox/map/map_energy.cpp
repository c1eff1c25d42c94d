// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/map_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wscvt {

ReferenceTriangle reference_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  double la = (b - c).norm();
  double lb = (c - a).norm();
  double lc = (a - b).norm();
  const double slack = 1e-3 * std::max({la, lb, lc}) + 1e-12;
  const double lack =
      std::max({0.0, slack - (la + lb - lc), slack - (lb + lc - la), slack - (lc + la - lb)});
  la += lack;
  lb += lack;
  lc += lack;
  const double half = 0.5 * (la + lb + lc);
  ReferenceTriangle result;
  result.area = std::sqrt(std::max(1e-300, half * (half - la) * (half - lb) * (half - lc)));
  const double factor = 0.25 / result.area;
  result.cotangents = {(lb * lb + lc * lc - la * la) * factor,
                       (lc * lc + la * la - lb * lb) * factor,
                       (la * la + lb * lb - lc * lc) * factor};
  return result;
}

void VertexFan::add(const Vector3& q, const Vector3& r, double cotangent, double cotangent_q,
                    double cotangent_r, double area_square) {
  const Vector3 edge = r - q;
  FanTriangle t;
  t.q = q;
  t.r = r;
  // q x r without cancellation.
  t.normal = q.cross(edge);
  t.cotangent_q = cotangent_q;
  t.cotangent_r = cotangent_r;
  t.opposite_edge = cotangent * edge.squaredNorm();
  t.area_square = area_square;
  // The error of the determinant (p - q) . (q x r) is a few 1e-16 |p - q| |q x r|.
  t.certain = 0.25e-28 * t.normal.squaredNorm();
  triangles_.push_back(t);
}

double VertexFan::energy(const Vector3& p) const {
  double sum = 0.0;
  for (const FanTriangle& t : triangles_) {
    const Vector3 from_q = p - t.q;
    const double square_q = from_q.squaredNorm();
    const double area = 0.5 * from_q.dot(t.normal);
    const double area_square = area * area;
    if (!(area > 0.0 && area_square > t.certain * square_q && area_square > 1e-290)) {
      return std::numeric_limits<double>::infinity();
    }
    const double dirichlet = 0.5 * (t.opposite_edge + t.cotangent_q * (p - t.r).squaredNorm() +
                                    t.cotangent_r * square_q);
    const double s = t.area_square / area_square;
    sum += dirichlet * (1.0 + s);
  }
  return sum;
}

double VertexFan::improve(Vector3& p) const {
  const Vector3 e1 = p.unitOrthogonal();
  const Vector3 e2 = p.cross(e1);
  double before = 0.0;
  double edges = 0.0;                      // sum of squares
  double g1 = 0.0, g2 = 0.0;               // gradient
  double h11 = 0.0, h12 = 0.0, h22 = 0.0;  // Hessian without its isotropic part
  double isotropic = 0.0;
  double radial = 0.0;  // gradient along p, for the sphere's Hessian
  for (const FanTriangle& t : triangles_) {
    const Vector3 from_q = p - t.q;
    const Vector3 from_r = p - t.r;
    const double area = 0.5 * from_q.dot(t.normal);
    if (!(area > 1e-145)) return 0.0;
    const double square_q = from_q.squaredNorm();
    edges += square_q;
    const Vector3 gradient_d = t.cotangent_q * from_r + t.cotangent_r * from_q;
    const double dirichlet =
        0.5 * (t.opposite_edge + t.cotangent_q * from_r.squaredNorm() + t.cotangent_r * square_q);
    const double inverse = 1.0 / area;
    const double s = t.area_square * inverse * inverse;
    // The energy is D f(A) with f = 1 + s, f' = -2 s / A and f'' = 6 s / A^2.
    const double f = 1.0 + s;
    before += dirichlet * f;
    const double a1 = 0.5 * t.normal.dot(e1);
    const double a2 = 0.5 * t.normal.dot(e2);
    const double d1 = gradient_d.dot(e1);
    const double d2 = gradient_d.dot(e2);
    const double along_area = 2.0 * s * dirichlet * inverse;
    g1 += f * d1 - along_area * a1;
    g2 += f * d2 - along_area * a2;
    radial += f * gradient_d.dot(p) - along_area * area;
    isotropic += f * (t.cotangent_q + t.cotangent_r);
    const double square = 3.0 * along_area * inverse;
    const double mixed = 2.0 * s * inverse;
    h11 += square * a1 * a1 - 2.0 * mixed * d1 * a1;
    h12 += square * a1 * a2 - mixed * (d1 * a2 + d2 * a1);
    h22 += square * a2 * a2 - 2.0 * mixed * d2 * a2;
  }
  h11 += isotropic - radial;
  h22 += isotropic - radial;
  // Eigenvalues are clamped from below, because otherwise the step may go uphill.
  const double middle = 0.5 * (h11 + h22);
  const double spread = std::sqrt(0.25 * (h11 - h22) * (h11 - h22) + h12 * h12);
  const double largest = std::abs(middle + spread);
  if (middle - spread < 1e-3 * largest) {
    const double shift = 1e-3 * largest - (middle - spread) + 1e-30;
    h11 += shift;
    h22 += shift;
  }
  const double determinant = h11 * h22 - h12 * h12;
  if (!(determinant > 0.0)) return 0.0;
  double x = -(h22 * g1 - h12 * g2) / determinant;
  double y = -(h11 * g2 - h12 * g1) / determinant;
  const double length = std::sqrt(x * x + y * y);
  if (length > 0.5) {
    x *= 0.5 / length;
    y *= 0.5 / length;
  }
  const double slope = g1 * x + g2 * y;
  if (!(slope < 0.0)) return 0.0;
  double step = 1.0;
  for (int trial = 0; trial < 12; ++trial, step *= 0.4) {
    const Vector3 candidate = (p + step * (x * e1 + y * e2)).normalized();
    if (energy(candidate) < before + 1e-4 * step * slope) {
      const double way = (candidate - p).squaredNorm();
      p = candidate;
      return way * static_cast<double>(triangles_.size()) / edges;
    }
  }
  return 0.0;
}

}  // namespace wscvt
