// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/mesh_surface.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t ray_block = 8192;

/// Maximum number of bin entries per triangle, because of memory. Even meshes have about three.
constexpr std::size_t entries_per_triangle = 20;

}  // namespace

MeshSurface::MeshSurface(const IndexedMesh& mesh, const Vector3& centre, double unit,
                         double overhang_fraction, const Execution& execution)
    : star_shaped_(overhang_fraction == 0.0),
      cube_(CubeMap::resolution_for(mesh.triangles.size())) {
  if (mesh.triangles.empty()) refuse("The mesh is empty. Check it before casting rays at it.");
  if (!(unit > 0.0 && std::isfinite(unit))) {
    refuse("The unit of length is " + std::to_string(unit) +
           ". Give a positive one, e.g. the equivalent radius.");
  }
  mesh_.triangles = mesh.triangles;
  mesh_.points.resize(mesh.points.size());
  execution.parallel_for_each(mesh.points.size(), ray_block, [&](std::size_t i) {
    mesh_.points[i] = (mesh.points[i] - centre) / unit;
  });
  if (overhang_fraction >= 1.0) {
    refuse(
        "The centre lies outside the mesh or on it, so rays from it do not go round the surface "
        "once. Use a centre inside, e.g. the centroid of a compact grain.");
  }

  std::vector<CubeMap::Image> images(mesh_.points.size());
  execution.parallel_for_each(images.size(), ray_block,
                              [&](std::size_t i) { images[i] = CubeMap::image(mesh_.points[i]); });
  const auto entries = [&] {
    return execution.parallel_sum_of(
        mesh_.triangles.size(), ray_block, std::size_t{0}, [&](std::size_t f, std::size_t& part) {
          const Triangle& t = mesh_.triangles[f];
          part += cube_.count_cells(images[t[0]], images[t[1]], images[t[2]]);
        });
  };
  // A needle, as in a fan about a pole, gets an entry in every cell of the rectangle about it, so
  // each may have as many entries as there are triangles.
  int resolution = CubeMap::resolution_for(mesh_.triangles.size());
  while (resolution > 1 && entries() > entries_per_triangle * mesh_.triangles.size()) {
    resolution /= 2;
    cube_ = CubeMap(resolution);
  }

  bins_ =
      counting_sort(mesh_.triangles.size(), cube_.cells(), [&](std::size_t f, const auto& visit) {
        const Triangle& t = mesh_.triangles[f];
        cube_.visit_cells(images[t[0]], images[t[1]], images[t[2]], visit);
      });
}

MeshSurface::Hit MeshSurface::outermost_hit(const Vector3& direction) const {
  // Points are sheared so that the ray becomes the z axis. A point has one sheared position for all
  // its triangles. The sign of a difference of two rounded products is never wrong, only zero, so
  // the sheared triangles cover the ray without a gap.
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const int axis_x = (axis + 1) % 3;
  const int axis_y = (axis + 2) % 3;
  const double shear_x = direction[axis_x] / direction[axis];
  const double shear_y = direction[axis_y] / direction[axis];
  Hit hit;
  const std::size_t cell = cube_.cell(direction);
  for (auto triangle = bins_.begin(cell); triangle != bins_.end(cell); ++triangle) {
    const Triangle& t = mesh_.triangles[*triangle];
    const Vector3& a = mesh_.points[t[0]];
    const Vector3& b = mesh_.points[t[1]];
    const Vector3& c = mesh_.points[t[2]];
    const double ax = a[axis_x] - shear_x * a[axis];
    const double ay = a[axis_y] - shear_y * a[axis];
    const double bx = b[axis_x] - shear_x * b[axis];
    const double by = b[axis_y] - shear_y * b[axis];
    const double cx = c[axis_x] - shear_x * c[axis];
    const double cy = c[axis_y] - shear_y * c[axis];
    const double u = cx * by - cy * bx;
    const double v = ax * cy - ay * cx;
    const double w = bx * ay - by * ax;
    // Tests the extremes, because a processor cannot predict which of three single tests fails
    // first. Wrong predictions took a third of the time of a ray.
    const double low = std::min(std::min(u, v), w);
    const double high = std::max(std::max(u, v), w);
    const double sum = u + v + w;
    if ((low < 0.0 && high > 0.0) || sum == 0.0) continue;
    const double radius = (u * a[axis] + v * b[axis] + w * c[axis]) / (sum * direction[axis]);
    if (!(radius > hit.radius)) continue;
    hit = {*triangle, radius};
    // On a star-shaped mesh there is no other triangle, except on an edge.
    if (star_shaped_ && (low > 0.0 || high < 0.0)) break;
  }
  if (hit.triangle < 0) {
    throw Error(ErrorCode::NumericalFailure,
                "A ray from the centre meets no triangle: the mesh is not closed or an edge of it "
                "passes through the centre. Check the mesh first.");
  }
  return hit;
}

void MeshSurface::evaluate_radii(const Vector3* directions, std::size_t count,
                                 double* radii) const {
  for (std::size_t i = 0; i < count; ++i) radii[i] = outermost_hit(directions[i]).radius;
}

void MeshSurface::evaluate(const Vector3* directions, std::size_t count, Derivatives derivatives,
                           RadialJet* jets) const {
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3& u = directions[i];
    const Hit hit = outermost_hit(u);
    RadialJet jet;
    jet.radius = hit.radius;
    if (derivatives != Derivatives::None) {
      const auto [a, b, c] = corners_of(mesh_, hit.triangle);
      const Vector3 normal = doubled_area_normal(a, b, c);
      const Vector3 slope = normal / normal.dot(u);
      // Derivatives of d / (n . x): -r s and 2 r s s^T with s = n / (n . u).
      const Vector3 gradient = -hit.radius * slope;
      jet = derivatives == Derivatives::First
                ? jet_from_extension(hit.radius, gradient, u)
                : jet_from_extension(hit.radius, gradient,
                                     2.0 * hit.radius * slope * slope.transpose(), u);
    }
    jets[i] = jet;
  }
}

}  // namespace wscvt
