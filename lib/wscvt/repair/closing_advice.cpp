// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/closing_advice.h"

#include "wscvt/base/text_format.h"

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
  return std::to_string(corners) + (corners == 1 ? " corner" : " corners") +
         " of faces along open edges lay up to " + format_number(distance, 2) +
         " from others and were merged with them.";
}

std::string stray_vertex_sentence(const MeshCheckReport& report) {
  const Vector3& p = report.stray_place;
  return "Vertex " + std::to_string(report.stray_vertex) + ", counted from 0, lies at (" +
         format_number(p.x()) + ", " + format_number(p.y()) + ", " + format_number(p.z()) + "), " +
         format_number(report.stray_distance, 2) + " from its nearest neighbour.";
}

}  // namespace wscvt
