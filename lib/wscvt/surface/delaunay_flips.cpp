// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/delaunay_flips.h"

#include <algorithm>

namespace wscvt {

namespace {

/// Edges below this cosine of their normals are sharp: 73 degrees.
constexpr double sharp_bend = 0.3;
/// A flip of a sharp edge must flatten it by this much; other flips may sharpen by as much.
constexpr double bend_margin = 0.1;

/// Two triangles abc and bad about the edge ab, with unit normals, before and after a flip.
struct FlipShape {
  double agreement_before;
  double agreement_after;
  double bend_before;
  double bend_after;
};

bool keeps_shape(const FlipShape& s) {
  if (s.agreement_before <= least_agreement) return s.agreement_after >= s.agreement_before;
  if (s.agreement_after < least_agreement) return false;
  if (s.bend_before < sharp_bend && s.bend_after < s.bend_before + bend_margin) return false;
  return s.bend_after >= sharp_bend || s.bend_after >= s.bend_before - bend_margin;
}

bool try_flip(EditMesh& mesh, const std::vector<Vector3>& outward, std::int32_t h) {
  const std::int32_t g = mesh.opposite[h];
  const std::int32_t a = mesh.origin(h);
  const std::int32_t b = mesh.origin(g);
  const std::int32_t c = mesh.apex(h);
  const std::int32_t d = mesh.apex(g);
  const Vector3& pc = mesh.points[c];
  const Vector3& pd = mesh.points[d];
  const Vector3 ca = mesh.points[a] - pc;
  const Vector3 cb = mesh.points[b] - pc;
  const Vector3 da = mesh.points[a] - pd;
  const Vector3 db = mesh.points[b] - pd;
  Vector3 m1 = ca.cross(cb);
  Vector3 m2 = db.cross(da);
  const double s1 = m1.norm();
  const double s2 = m2.norm();
  // The sine of the sum of the angles at c and d, times the edges' lengths.
  const double sine = ca.dot(cb) * s2 + da.dot(db) * s1;
  if (sine > -1e-6 * (s1 * s2 + 1e-300)) return false;  // Delaunay already
  if (mesh.degrees[a] <= 3 || mesh.degrees[b] <= 3 || c == d) return false;
  Vector3 n1 = ca.cross(pd - pc);
  Vector3 n2 = (pd - pc).cross(cb);
  const double a1 = n1.norm();
  const double a2 = n2.norm();
  if (a1 < 1e-300 || a2 < 1e-300) return false;
  m1 /= s1 + 1e-300;
  m2 /= s2 + 1e-300;
  n1 /= a1;
  n2 /= a2;
  const Vector3 ab = outward[a] + outward[b];
  const Vector3 cd = outward[c] + outward[d];
  const FlipShape shape = {std::min(cosine_to(m1, ab + outward[c]), cosine_to(m2, ab + outward[d])),
                           std::min(cosine_to(n1, cd + outward[a]), cosine_to(n2, cd + outward[b])),
                           m1.dot(m2), n1.dot(n2)};
  if (!keeps_shape(shape)) return false;
  if (mesh.joined(c, d)) return false;
  mesh.flip(h);
  return true;
}

}  // namespace

int flip_to_delaunay(EditMesh& mesh, const std::vector<Vector3>& outward) {
  int flipped = 0;
  const auto faces = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t t = 0; t < faces; ++t) {
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (static_cast<std::int32_t>(face_of(mesh.opposite[h])) < t) continue;
      if (!try_flip(mesh, outward, h)) continue;
      ++flipped;
      break;  // the next pass does the triangle's other edges
    }
  }
  return flipped;
}

}  // namespace wscvt
