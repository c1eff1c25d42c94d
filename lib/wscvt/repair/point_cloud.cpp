// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/closing_advice.h"
#include "wscvt/repair/usable_scan.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

constexpr const char* cloud_stage = "Making a surface of the points";

}  // namespace

IndexedMesh mesh_of_points(std::vector<Vector3> points, const Execution& execution) {
  execution.report(0.0, cloud_stage);
  IndexedMesh mesh;
  mesh.points = different_points(std::move(points), execution);
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : mesh.points) centre += p / static_cast<double>(mesh.points.size());
  // The mean of the points is biased to dense regions. The second round uses the volume's centroid.
  std::vector<Vector3> directions(mesh.points.size());
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      directions[i] = (mesh.points[i] - centre).normalized();
    }
    const Execution part = execution.part(0.5 * round, 0.5 * (round + 1));
    const auto triangulation =
        SphereTriangulation::try_build(directions, std::vector<double>(), part);
    if (!triangulation) {
      // A wrap enters gaps between points that are as wide as its opening. Points of a box of
      // 4 x 7 x 9 at a distance of 1 need 13 %.
      constexpr double first_percent = 15.0;
      throw Error(ErrorCode::NumericalFailure,
                  "No surface with one radius in each direction goes through the points: they do "
                  "not surround their centre, or two lie on one ray from it. " +
                      surface_of_points_advice() + " " + wrap_advice(first_percent));
    }
    mesh.triangles = triangulation->triangles();
    centre += mesh_sums(mesh.points, mesh.triangles, centre, part).centroid();
  }
  return mesh;
}

IndexedMesh with_surface(IndexedMesh scan, bool points_only, const Execution& execution) {
  if (points_only) return mesh_of_points(std::move(scan.points), execution);
  if (!scan.triangles.empty() || scan.points.empty()) return scan;
  throw Error(ErrorCode::InvalidInput,
              "The scan has " + std::to_string(scan.points.size()) +
                  " points and no faces. If it was exported without its faces, export it again. If "
                  "there are only points, build a surface from them: " +
                  mention("points", "true") + ".");
}

void count_given(std::size_t points, std::size_t faces, std::size_t different,
                 MeshCheckReport& report) {
  report.input_vertices = points;
  report.input_faces = faces;
  report.welded_vertices = points - different;
}

}  // namespace wscvt
