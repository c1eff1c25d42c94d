// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grown_mesh.h"

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

/// Returns the half extents of the surface along the axes.
Vector3 extents_of(const std::vector<Vector3>& points) {
  Vector3 extents = Vector3::Zero();
  for (const Vector3& point : points) extents = extents.cwiseMax(point.cwiseAbs());
  return extents;
}

}  // namespace

GrownMeshes::GrownMeshes(int nodes, const Execution& execution) {
  if (nodes < 4) refuse("The number of nodes is " + std::to_string(nodes) + ". Give 4 or more.");
  directions_ = fibonacci_lattice(nodes);
  triangles_ = SphereTriangulation(directions_, std::vector<double>(), execution).triangles();
}

IndexedMesh GrownMeshes::mesh(const std::vector<double>& radial, double radius,
                              const OffsetSeries& offset) const {
  const Execution one_thread(1);
  // The square root of the extents is a compromise: even directions crowd nodes about the waist of
  // a long grain, and the ellipsoid's own spread them out along it.
  const Vector3 extents = extents_of(surface_points(radial, offset, directions_)).cwiseSqrt();
  std::vector<Vector3> directions = directions_;
  for (Vector3& direction : directions) direction = direction.cwiseProduct(extents).normalized();
  IndexedMesh mesh;
  mesh.points = surface_points(radial, offset, directions);
  SphereTriangulation triangulation(directions, triangles_, one_thread);
  triangulation.restore_surface_delaunay(directions, mesh.points, one_thread);
  mesh.triangles = triangulation.triangles();
  const double scale = radius * portable::cbrt(4.0 * pi / 3.0 / volume_of(mesh, one_thread));
  for (Vector3& point : mesh.points) point *= scale;
  return mesh;
}

GrownBody grow_body(const GrainGrower& grower, const GrownMeshes& meshes, std::size_t index) {
  GrownBody body;
  body.grain = grower.grow(index, [&](const GrownGrain& grain) {
    body.mesh = meshes.mesh(grain.radial, grain.radius, grain.offset);
    return !has_offset(grain.offset) || self_intersections(body.mesh).empty();
  });
  // The series has its own frame; that of a mesh of few nodes, or of a truncated series, is
  // another.
  const MassProperties mass = mass_properties(describe_shape(body.mesh, Execution(1)));
  const Eigen::Matrix3d to_axes = mass.principal_axes.toRotationMatrix().transpose();
  for (Vector3& point : body.mesh.points) point = to_axes * (point - mass.centroid);
  return body;
}

}  // namespace wscvt
