// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/power_cells.h"

#include <string>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

/// Small, as in weights.cpp.
constexpr std::size_t cell_block = 128;

// Solves (O - a).ab = (|ab|^2 + w_a - w_b) / 2 and the same for ac, in the triangle's plane.
Vector3 radical_centre(const Vector3& a, const Vector3& b, const Vector3& c, double lower_ab,
                       double lower_ac) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double ab_ab = ab.squaredNorm();
  const double ac_ac = ac.squaredNorm();
  const double ab_ac = ab.dot(ac);
  const double determinant = ab_ab * ac_ac - ab_ac * ab_ac;
  // The determinant is 4 area^2. Below 1e-24 of its terms, an angle of 1e-12, it is rounding. Such
  // a needle has no useful centre; its middle keeps the neighbours' cells valid.
  if (!(determinant > 1e-24 * ab_ab * ac_ac)) return (a + b + c) / 3.0;
  const double along_ab = 0.5 * (ab_ab + lower_ab);
  const double along_ac = 0.5 * (ac_ac + lower_ac);
  const double s = (along_ab * ac_ac - along_ac * ab_ac) / determinant;
  const double t = (along_ac * ab_ab - along_ab * ab_ac) / determinant;
  return a + s * ab + t * ac;
}

}  // namespace

void compute_power_cells(const SphereTriangulation& triangulation,
                         const std::vector<Vector3>& sites, const std::vector<double>& weights,
                         const Execution& execution, PowerCells& cells) {
  const std::size_t count = sites.size();
  if (count != triangulation.vertex_count() || (!weights.empty() && weights.size() != count)) {
    refuse("The triangulation has " + std::to_string(triangulation.vertex_count()) +
           " vertices, but there are " + std::to_string(count) + " seeds and " +
           std::to_string(weights.size()) + " weights. Give one each.");
  }
  const std::vector<Triangle>& triangles = triangulation.triangles();
  const std::vector<std::int32_t>& opposite = triangulation.opposite();
  const bool weighted = !weights.empty();

  cells.vertices.resize(triangles.size());
  execution.parallel_for_each(triangles.size(), cell_block, [&](std::size_t t) {
    const auto [a, b, c] = triangles[t];
    const double w = weighted ? weights[a] : 0.0;
    const Vector3 centre =
        radical_centre(sites[a], sites[b], sites[c], weighted ? w - weights[b] : 0.0,
                       weighted ? w - weights[c] : 0.0);
    cells.vertices[t] = centre.normalized();
  });

  cells.centroids.resize(count);
  cells.areas.resize(count);
  execution.parallel_for_each(count, cell_block, [&](std::size_t i) {
    const Vector3& site = sites[i];
    const std::int32_t first = triangulation.first_half_edge()[i];
    double area = 0.0;
    Vector3 sum = Vector3::Zero();
    // Vectors from the site to this and the next cell vertex, counter-clockwise.
    std::int32_t h = first;
    Vector3 a = cells.vertices[h / 3] - site;
    do {
      h = opposite[previous_half_edge(h)];
      const Vector3 b = cells.vertices[h / 3] - site;
      const double fan = 0.5 * a.cross(b).dot(site);
      area += fan;
      sum += fan / 3.0 * (a + b);
      a = b;
    } while (h != first);
    cells.areas[i] = area;
    // A cell turned inside out by a coarse start has no centroid: the seed stays. Otherwise the
    // shift is projected to the tangent plane, because the site returns to the surface along its
    // ray, and height above it would only shorten the step.
    Vector3 shift = area > 0.0 ? Vector3(sum / area) : Vector3(Vector3::Zero());
    shift -= shift.dot(site) * site;
    cells.centroids[i] = site + shift;
  });
}

}  // namespace wscvt
