// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {

/// Position on a triangle of the point nearest to another point.
struct TrianglePlace {
  Vector3 weights = Vector3(1.0, 0.0, 0.0);  ///< of the corners, >= 0, sum 1
  double squared_distance = 0.0;
  /// 0 inside the triangle, 1 to 3 on the edge opposite to corner region - 1, 4 to 6 on corner
  /// region - 4.
  int region = 0;

  Vector3 point(const Vector3& a, const Vector3& b, const Vector3& c) const {
    return weights[0] * a + weights[1] * b + weights[2] * c;
  }
};

/// A triangle with what the search for its nearest point needs, for many points.
struct MeasuredTriangle {
  Vector3 a, b, c;
  Vector3 ab, ac;
  double bb, cc, bc;  ///< products of ab and ac

  MeasuredTriangle(const Vector3& pa, const Vector3& pb, const Vector3& pc)
      : a(pa),
        b(pb),
        c(pc),
        ab(pb - pa),
        ac(pc - pa),
        bb(ab.squaredNorm()),
        cc(ac.squaredNorm()),
        bc(ab.dot(ac)) {}

  /// Returns the point nearest to `p` (Ericson 2005, "Real-time collision detection", section
  /// 5.1.5). Inline, and with the squared distance, because the fit of nodes calls it a hundred
  /// times per sample.
  TrianglePlace nearest(const Vector3& p) const {
    const Vector3 ap = p - a;
    const double d1 = ab.dot(ap);
    const double d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {Vector3(1.0, 0.0, 0.0), ap.squaredNorm(), 4};
    const double d3 = d1 - bb;
    const double d4 = d2 - bc;
    if (d3 >= 0.0 && d4 <= d3) return {Vector3(0.0, 1.0, 0.0), (p - b).squaredNorm(), 5};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
      const double v = d1 / (d1 - d3);
      return {Vector3(1.0 - v, v, 0.0), (ap - v * ab).squaredNorm(), 3};
    }
    const double d5 = d1 - bc;
    const double d6 = d2 - cc;
    if (d6 >= 0.0 && d5 <= d6) return {Vector3(0.0, 0.0, 1.0), (p - c).squaredNorm(), 6};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
      const double w = d2 / (d2 - d6);
      return {Vector3(1.0 - w, 0.0, w), (ap - w * ac).squaredNorm(), 2};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
      const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
      return {Vector3(0.0, 1.0 - w, w), (p - b - w * (c - b)).squaredNorm(), 1};
    }
    const double scale = 1.0 / (va + vb + vc);
    const double v = vb * scale;
    const double w = vc * scale;
    return {Vector3(1.0 - v - w, v, w), (ap - v * ab - w * ac).squaredNorm(), 0};
  }
};

inline MeasuredTriangle measured_triangle(const EditMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}
inline TrianglePlace nearest_in_triangle(const Vector3& p, const EditMesh& mesh, std::size_t t) {
  return measured_triangle(mesh, t).nearest(p);
}

/// Walks over a mesh from the triangle `t`, over edges and around vertices, to nearer triangles
/// until no neighbour is nearer, and stores the last one in `t`. If the point comes from near `t`,
/// this is the nearest point. It is always on the sheet of the surface of `t`.
TrianglePlace walk_to_nearest(const Vector3& p, const EditMesh& mesh, std::int32_t& t);
/// The same, with the nearest point in `t`.
TrianglePlace walk_to_nearest(const Vector3& p, const EditMesh& mesh, std::int32_t& t,
                              TrianglePlace place);

}  // namespace wscvt
