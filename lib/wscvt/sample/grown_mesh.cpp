// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sample/grown_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

double volume_of(const IndexedMesh& mesh) {
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.triangles) {
    six_volumes += mesh.points[static_cast<std::size_t>(t[0])].dot(
        mesh.points[static_cast<std::size_t>(t[1])].cross(
            mesh.points[static_cast<std::size_t>(t[2])]));
  }
  return six_volumes / 6.0;
}

/// Half extents of the surface along the axes.
Vector3 extents_of(const std::vector<Vector3>& points) {
  Vector3 extents = Vector3::Zero();
  for (const Vector3& point : points) extents = extents.cwiseMax(point.cwiseAbs());
  return extents;
}

std::vector<Vector3> surface_points(const HarmonicSeries& series,
                                    const std::vector<Vector3>& directions) {
  std::vector<double> radii(directions.size());
  series.sum(directions.data(), directions.size(), radii.data());
  std::vector<Vector3> points = directions;
  for (std::size_t k = 0; k < points.size(); ++k) points[k] *= radii[k];
  return points;
}

}  // namespace

GrownMeshes::GrownMeshes(int nodes, const Execution& execution) {
  if (nodes < 4) refuse("The number of nodes is " + std::to_string(nodes) + "; give 4 or more.");
  directions_ = fibonacci_lattice(nodes);
  triangles_ = SphereTriangulation(directions_, std::vector<double>(), execution).triangles();
}

IndexedMesh GrownMeshes::mesh(const std::vector<double>& radial, double radius) const {
  const Execution one_thread(1);
  const HarmonicSeries series(radial);
  // The square root of the extents: between even directions, which crowd nodes about the waist of a
  // long grain, and the ellipsoid's own, which draw them out along it.
  const Vector3 extents = extents_of(surface_points(series, directions_)).cwiseSqrt();
  std::vector<Vector3> directions = directions_;
  for (Vector3& direction : directions) direction = direction.cwiseProduct(extents).normalized();
  IndexedMesh mesh;
  mesh.points = surface_points(series, directions);
  SphereTriangulation triangulation(directions, triangles_, one_thread);
  triangulation.restore_surface_delaunay(directions, mesh.points, one_thread);
  mesh.triangles = triangulation.triangles();
  const double scale = radius * std::cbrt(4.0 * pi / 3.0 / volume_of(mesh));
  for (Vector3& point : mesh.points) point *= scale;
  return mesh;
}

GrownShape grown_shape(const IndexedMesh& mesh, const Execution& execution) {
  const ShapeDescriptors shape = describe_shape(mesh, execution);
  const Vector3& axes = shape.inertia_semi_axes;
  GrownShape grown;
  grown.sphericity = shape.sphericity;
  grown.elongation = axes[1] / axes[2];
  grown.flatness = axes[0] / axes[1];
  grown.convexity = shape.volume / volume_of(convex_hull(mesh.points));
  return grown;
}

}  // namespace wscvt
