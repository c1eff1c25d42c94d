// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/scan/components.h"
#include "wscvt/scan/degenerate_faces.h"
#include "wscvt/scan/edge_rings.h"
#include "wscvt/scan/half_edges.h"
#include "wscvt/scan/touching_vertices.h"
#include "wscvt/scan/weld.h"

namespace wscvt {

using namespace half_edges;

namespace {

/// Below this volume / area^1.5 (0.094 for a sphere, a third of the thickness for a plate) the
/// surface is a sheet within rounding.
constexpr double flat_limit = 1e-9;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::InvalidInput, sentence);
}

/// "1 face", "2 faces".
std::string count_of(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// First index in [0, count) for which `wrong` holds, or count.
template <class Predicate>
std::size_t first_wrong(std::size_t count, const Execution& execution, const Predicate& wrong) {
  std::vector<std::size_t> first((count + block_size - 1) / block_size, count);
  execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (wrong(i)) {
        first[begin / block_size] = i;
        break;
      }
    }
  });
  return first.empty() ? count : *std::min_element(first.begin(), first.end());
}

void refuse_unusable(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::size_t faces = mesh.triangles.size();
  if (vertices == 0) refuse("The mesh is empty: it has no vertices; load the scan of a grain.");
  if (faces == 0) {
    refuse("The mesh has " + std::to_string(vertices) + (vertices == 1 ? " vertex" : " vertices") +
           " but no faces, so it encloses no volume; reconstruct a closed surface from the points "
           "first, e.g. by Screened Poisson reconstruction.");
  }
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 3;
  if (faces > limit || vertices > limit) {
    refuse("The mesh has " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
           " faces, more than the " + std::to_string(limit) +
           " that can be numbered; reduce the scan first.");
  }
  const std::size_t bad_point =
      first_wrong(vertices, execution, [&](std::size_t i) { return !mesh.points[i].allFinite(); });
  if (bad_point < vertices) {
    const Vector3& p = mesh.points[bad_point];
    const auto coordinate = [](double value) {
      return std::isnan(value) ? "nan" : format_number(value);
    };
    refuse("Vertex " + std::to_string(bad_point) + " is at (" + coordinate(p.x()) + ", " +
           coordinate(p.y()) + ", " + coordinate(p.z()) +
           "), which is not a finite position; remove such vertices and close the holes first.");
  }
  const std::size_t bad_face = first_wrong(faces, execution, [&](std::size_t f) {
    const Triangle& t = mesh.triangles[f];
    return std::any_of(t.begin(), t.end(), [&](std::int32_t v) {
      return v < 0 || static_cast<std::size_t>(v) >= vertices;
    });
  });
  if (bad_face < faces) {
    const Triangle& t = mesh.triangles[bad_face];
    refuse("Face " + std::to_string(bad_face) + " names the vertices " + std::to_string(t[0]) +
           ", " + std::to_string(t[1]) + " and " + std::to_string(t[2]) + ", but the mesh has " +
           std::to_string(vertices) + "; the file or the program that made it is at fault.");
  }
}

void refuse_unclosed(const Component& main, std::size_t components) {
  const std::string subject = components > 1 ? "The largest part of the mesh" : "The mesh";
  if (main.non_manifold_edges > 0) {
    refuse(subject + " has " + count_of(main.non_manifold_edges, "non-manifold edge") +
           ", shared by more than two faces, so inside and outside cannot be told apart; repair it "
           "first, e.g. Filters > Cleaning and Repairing > Repair non Manifold Edges by removing "
           "faces, then Filters > Remeshing, Simplification and Reconstruction > Close Holes.");
  }
  if (main.boundary_edges > 0) {
    refuse(subject + " has " + count_of(main.boundary_edges, "boundary edge") +
           ", so it encloses no volume; close it first, e.g. Filters > Remeshing, Simplification "
           "and Reconstruction > Close Holes.");
  }
  if (!main.orientable) {
    refuse(subject +
           " is not orientable: its faces cannot all be turned to face outward; reconstruct the "
           "surface first, e.g. by Screened Poisson reconstruction.");
  }
}

/// The component that stays: the one of largest absolute volume.
std::size_t choose_main(const Components& components, const MeshCheckOptions& options,
                        MeshCheckReport& report) {
  const std::vector<Component>& list = components.list;
  std::size_t main = 0;
  double total = 0.0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (std::abs(list[c].volume) > std::abs(list[main].volume)) main = c;
    total += std::abs(list[c].volume);
  }
  report.components = list.size();
  refuse_unclosed(list[main], list.size());
  if (total > 0.0) report.dropped_volume_share = 1.0 - std::abs(list[main].volume) / total;
  if (list.size() == 1) report.dropped_volume_share = 0.0;
  if (report.dropped_volume_share > options.dropped_volume_limit) {
    refuse("The mesh falls into " + std::to_string(list.size()) +
           " separate parts and the largest holds only " +
           format_percent(1.0 - report.dropped_volume_share) +
           " of their volume, so there is no main body; keep one part, e.g. Filters > Cleaning and "
           "Repairing > Remove Isolated pieces (wrt Face Num.), or split the mesh into its "
           "connected components, and remesh each on its own.");
  }
  return main;
}

void measure(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report) {
  using Sums = Eigen::Matrix<double, 6, 1>;  // 6 V, 2 A, 24 V (centroid - origin), slivers
  const Vector3 origin = mesh.points[index(mesh.triangles[0][0])];
  const Sums sums = execution.parallel_sum(mesh.triangles.size(), block_size, Sums(Sums::Zero()),
                                           [&](std::size_t begin, std::size_t end) {
                                             Sums part = Sums::Zero();
                                             for (std::size_t f = begin; f < end; ++f) {
                                               const Triangle& t = mesh.triangles[f];
                                               const Vector3 p = mesh.points[index(t[0])] - origin;
                                               const Vector3 q = mesh.points[index(t[1])] - origin;
                                               const Vector3 r = mesh.points[index(t[2])] - origin;
                                               const double volume = p.dot(q.cross(r));
                                               const double area = (q - p).cross(r - p).norm();
                                               part[0] += volume;
                                               part[1] += area;
                                               part.segment<3>(2) += volume * (p + q + r);
                                               if (area == 0.0) part[5] += 1.0;
                                             }
                                             return part;
                                           });
  report.volume = sums[0] / 6.0;
  report.area = sums[1] / 2.0;
  if (!(report.volume > flat_limit * std::pow(report.area, 1.5))) {
    refuse("The mesh encloses no volume: it is flat, with an area of " +
           format_number(report.area) + " and a volume of " + format_number(report.volume) +
           "; load the closed surface of a grain.");
  }
  report.centroid = origin + sums.segment<3>(2) / (4.0 * sums[0]);
  report.sliver_faces = static_cast<std::size_t>(sums[5]);
  report.vertices = mesh.points.size();
  report.faces = mesh.triangles.size();
  const auto euler =
      static_cast<std::int64_t>(report.vertices) - static_cast<std::int64_t>(report.faces / 2);
  report.genus = static_cast<int>((2 - euler) / 2);
  report.equivalent_radius = std::cbrt(3.0 * report.volume / (4.0 * 3.14159265358979323846));
}

}  // namespace

CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution) {
  if (!(options.dropped_volume_limit > 0.0 && options.dropped_volume_limit < 1.0)) {
    refuse("The largest share of volume to drop is " + format_number(options.dropped_volume_limit) +
           "; give a number between 0 and 1.");
  }
  const std::string stage = "Checking the mesh";
  CheckedMesh result;
  MeshCheckReport& report = result.report;
  report.input_vertices = mesh.points.size();
  report.input_faces = mesh.triangles.size();
  execution.report(0.0, stage);
  refuse_unusable(mesh, execution);
  {
    const Weld weld = find_equal_points(mesh.points, execution);
    const DegenerateFaces degenerate = drop_degenerate_faces(mesh, weld.first);
    report.welded_vertices = weld.welded;
    report.degenerate_faces = degenerate.faces;
    report.unreferenced_vertices = mesh.points.size() - weld.welded - degenerate.used_vertices;
  }
  if (mesh.triangles.empty()) {
    refuse("All " + std::to_string(report.input_faces) +
           " faces of the mesh have two corners in one place, so it encloses no volume; load the "
           "closed surface of a grain.");
  }
  execution.report(0.25, stage);
  std::vector<std::int32_t> rings = edge_rings(mesh, execution);
  report.duplicate_faces = drop_duplicate_faces(mesh, rings);
  if (mesh.triangles.empty()) {
    refuse(
        "The faces of the mesh lie on each other in pairs, so it encloses no volume; load the "
        "closed surface of a grain.");
  }
  if (report.duplicate_faces > 0) rings = edge_rings(mesh, execution);
  execution.report(0.5, stage);
  const Components components = find_components(mesh, rings);
  const std::size_t main = choose_main(components, options, report);
  execution.report(0.75, stage);
  report.split_vertices = split_touching_vertices(mesh, rings, components.of_face,
                                                  static_cast<std::int32_t>(main), execution);
  const KeptComponent kept = keep_component(mesh, components, main);
  report.dropped_faces = kept.dropped_faces;
  report.reoriented_faces = kept.reoriented_faces;
  measure(mesh, execution, report);
  result.mesh = std::move(mesh);
  execution.report(1.0, stage);
  return result;
}

}  // namespace wscvt
