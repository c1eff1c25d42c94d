// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/scan_advice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

Sentence wrap_advice(double opening_percent) {
  return "Or remesh its shrink-wrap by " + mention(shrink_wrap_option, opening_percent) +
         ", and check the result against the scan.";
}

std::string where_meshlab_closes() {
  return "in MeshLab Filters > Remeshing, Simplification and Reconstruction > Uniform Mesh "
         "Resampling with Absolute Distance checked and an Offset above half the width of what is "
         "to be closed";
}

std::string surface_of_points_advice() {
  // Four photogrammetric clouds with stray points inside had no surface here. This way their rms
  // distance was 0.6 to 0.9 % at 1000 nodes. Their volume equals that of the authors' meshes, if
  // there is one, to 1e-5.
  return "Make a surface of them first, in MeshLab by Filters > Normals, Curvatures and "
         "Orientation > Compute normals for point sets and then Filters > Remeshing, "
         "Simplification and Reconstruction > Surface Reconstruction: Screened Poisson.";
}

Sentence open_seam_sentence(double distance) {
  return "The mesh is open along seams: corners of its faces lie " + format_number(distance, 2) +
         " from others. Merge them, in MeshLab by Filters > Cleaning and Repairing > Merge Close "
         "Vertices with a Merging distance of " +
         format_number(2.0 * distance, 2) + ". " + wrap_advice();
}

std::string merged_warning(std::size_t corners, double distance) {
  return format_count(corners, "corner") + " of faces along open edges lay up to " +
         format_number(distance, 2) + " from others and were merged with them.";
}

namespace {

std::string numbered_vertex_sentence(std::size_t vertex, const Vector3& place, double distance) {
  return stray_vertex_sentence("Vertex " + std::to_string(vertex) + ", counted from 0,", place,
                               distance);
}

}  // namespace

std::string stray_vertex_sentence(const std::string& vertex, const Vector3& place,
                                  double distance) {
  // The square of a distance above 1e154 is no number.
  return vertex + " lies at (" + format_number(place.x()) + ", " + format_number(place.y()) + ", " +
         format_number(place.z()) + ")" +
         (std::isfinite(distance)
              ? ", " + format_number(distance, 2) + " from its nearest neighbour."
              : ".");
}

std::string stray_vertex_sentence(const MeshCheckReport& report) {
  return numbered_vertex_sentence(report.stray_vertex, report.stray_place, report.stray_distance);
}

void refuse_stray_vertex(const StrayVertex& stray, double farthest) {
  if (!(stray.distance > farthest * stray.usual)) return;
  refuse(numbered_vertex_sentence(stray.vertex, stray.place, stray.distance) +
         " The rest of the mesh is about " + format_number(2.0 * stray.usual, 2) +
         " across. Correct this vertex, or remove it and its faces.");
}

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
    const auto [a, b, c] = corners_of(mesh, t);
    const Eigen::Index axis = axis_across(a, b, c);
    if (axis == -1) return false;
    if (axis >= 0) places[static_cast<std::size_t>(axis)].push_back(a[axis]);
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
