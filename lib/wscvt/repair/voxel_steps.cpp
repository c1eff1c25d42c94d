// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/voxel_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Coordinates nearer than this fraction of the largest are in one plane, because of single
/// precision.
constexpr double plane_tolerance = 1e-6;

/// Returns the axis perpendicular to a face; -1: none, -2: the face has no area.
Eigen::Index axis_across(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = doubled_area_normal(a, b, c);
  Eigen::Index axis = 0;
  const double largest = normal.cwiseAbs().maxCoeff(&axis);
  if (largest == 0.0) return -2;
  constexpr double straight = 1e-4;
  return normal.cwiseAbs().sum() - largest <= straight * largest ? axis : -1;
}

std::size_t count_of_planes(std::vector<double>& places) {
  std::sort(places.begin(), places.end());
  const double step = plane_tolerance * std::max(std::abs(places.front()), std::abs(places.back()));
  std::size_t planes = 1;
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (places[k] - places[k - 1] > step) ++planes;
  }
  return planes;
}

}  // namespace

bool has_voxel_steps(const IndexedMesh& mesh) {
  // Other meshes return at one of their first faces.
  std::array<std::vector<double>, 3> places;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& corner = mesh.points[index(t[0])];
    const Eigen::Index axis =
        axis_across(corner, mesh.points[index(t[1])], mesh.points[index(t[2])]);
    if (axis == -1) return false;
    if (axis >= 0) places[static_cast<std::size_t>(axis)].push_back(corner[axis]);
  }
  constexpr std::size_t fewest_planes = 4;
  constexpr std::size_t fewest_in_all = 18;
  std::size_t all = 0;
  for (std::vector<double>& of_axis : places) {
    const std::size_t planes = of_axis.empty() ? 0 : count_of_planes(of_axis);
    if (planes < fewest_planes) return false;
    all += planes;
  }
  return all >= fewest_in_all;
}

std::string voxel_steps_advice(const std::string& name) {
  return name +
         " is made of the faces of voxels. Their steps make its area up to half as large again as "
         "the grain's. Its volume is correct. A smoother remesh is closer to the grain, so do not "
         "follow the steps with more nodes or a larger edge ratio. Make the mesh from the "
         "volume (wscvt extract), which smooths the steps and keeps the volume. Or smooth it "
         "first, e.g. by Taubin's filter in MeshLab.";
}

}  // namespace wscvt
