// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/equivalent_radius.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/closing_advice.h"
#include "wscvt/repair/components.h"
#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/degenerate_faces.h"
#include "wscvt/repair/edge_rings.h"
#include "wscvt/repair/enclosure.h"
#include "wscvt/repair/holes.h"
#include "wscvt/repair/manifold_edges.h"
#include "wscvt/repair/touching_vertices.h"
#include "wscvt/repair/usable_scan.h"
#include "wscvt/repair/voxel_steps.h"
#include "wscvt/repair/weld.h"

namespace wscvt {

namespace {

/// Below this volume / area^1.5 (0.094 for a sphere, a third of the thickness for a plate) the
/// surface is flat within rounding.
constexpr double flat_limit = 1e-9;

/// Returns "1 face", "2 faces".
std::string count_of(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// A component that is not kept.
struct OtherComponent {
  std::size_t faces = 0;
  double volume = 0.0;
  Vector3 point = Vector3::Zero();  // on it, if possible not on the kept component
};

/// Returns the component of largest absolute volume. Absolute, because no component was turned
/// outward yet. Not the most faces, because a finely scanned crumb may have more than the grain.
std::size_t largest_of(const Components& components) {
  std::size_t main = 0;
  for (std::size_t c = 1; c < components.list.size(); ++c) {
    if (std::abs(components.list[c].volume) > std::abs(components.list[main].volume)) main = c;
  }
  return main;
}

/// Appends all components except `main`, before they are dropped.
void append_others(const IndexedMesh& mesh, const Components& components, std::size_t main,
                   std::vector<OtherComponent>& others) {
  if (components.list.size() == 1) return;
  std::vector<char> on_main(mesh.points.size(), 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (index(components.of_face[f]) != main) continue;
    for (const std::int32_t v : mesh.triangles[f]) on_main[index(v)] = 1;
  }
  // Parts may touch in a vertex, or in an edge before the sheets are separated. Such points are
  // neither inside nor outside. If all vertices are shared, the centre of a face is used.
  std::vector<OtherComponent> list(components.list.size());
  std::vector<char> found(list.size(), 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::size_t c = index(components.of_face[f]);
    if (c == main || found[c] != 0) continue;
    const Triangle& t = mesh.triangles[f];
    list[c].point =
        (mesh.points[index(t[0])] + mesh.points[index(t[1])] + mesh.points[index(t[2])]) / 3.0;
    for (const std::int32_t v : t) {
      if (found[c] != 0 || on_main[index(v)] != 0) continue;
      list[c].point = mesh.points[index(v)];
      found[c] = 1;
    }
  }
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (c == main) continue;
    list[c].faces = components.list[c].faces;
    list[c].volume = std::abs(components.list[c].volume);
    others.push_back(list[c]);
  }
}

/// Reports the other components, and refuses the mesh if the outer components are too large.
void judge_others(const IndexedMesh& kept, const std::vector<OtherComponent>& others,
                  const MeshCheckOptions& options, const Execution& execution,
                  MeshCheckReport& report) {
  report.components = others.size() + 1;
  if (others.empty()) return;
  std::vector<Vector3> points;
  points.reserve(others.size());
  for (const OtherComponent& other : others) points.push_back(other.point);
  const std::vector<char> inside = are_inside(kept, points, execution);
  double outer_volume = 0.0;
  double inner_volume = 0.0;
  for (std::size_t i = 0; i < others.size(); ++i) {
    report.dropped_faces += others[i].faces;
    if (inside[i] != 0) ++report.inner_components;
    (inside[i] != 0 ? inner_volume : outer_volume) += others[i].volume;
  }
  report.inner_volume_share = inner_volume / report.volume;
  report.dropped_volume_share = outer_volume / (outer_volume + report.volume);
  if (report.dropped_volume_share > options.dropped_volume_limit) {
    refuse(
        "The mesh has " + std::to_string(report.components - report.inner_components) +
        " separate bodies and the largest has only " +
        format_percent(1.0 - report.dropped_volume_share) +
        " of their volume, so there is no main body. Split the mesh (wscvt split MESH FOLDER; in "
        "MeshLab Filters > Mesh Layer > Split in Connected Components) and remesh each body "
        "separately, or all of them by wscvt batch MESH -o OUT --parts.");
  }
}

/// Refuses the mesh if more area was repaired than allowed. `widest_share`: width of the widest
/// hole / diagonal of the bounding box.
void judge_mending(const MeshCheckOptions& options, std::size_t boundary_edges, double widest_share,
                   const MeshCheckReport& report) {
  const double mended = report.flap_area_share + report.filled_area_share;
  const double limit = 0.01 * options.mended_area_limit_percent;
  if (!(mended > limit)) return;
  std::string found;
  if (report.non_manifold_edges > 0) {
    found = count_of(report.non_manifold_edges, "non-manifold edge") +
            ", shared by more than two faces";
  }
  if (report.filled_holes > 0) {
    found += (found.empty() ? "" : ", and ") + count_of(boundary_edges, "boundary edge") +
             " around " + count_of(report.filled_holes, "hole");
  }
  const std::string sentence =
      "The mesh has " + found + ". Their repair would change " + format_percent(mended) +
      " of its area (limit " + format_percent(limit) + "). Raise --" +
      std::string(mended_area_limit_option.key) + " above " + format_percent(mended) +
      " and check the result against the scan, close the openings first (" +
      where_meshlab_closes() + "), or scan the grain again.";
  // A ball as wide as the hole still enters it a little.
  const double percent = std::max(finest_tried_percent, std::ceil(120.0 * widest_share));
  throw WrappableScan(ErrorCode::InvalidInput, sentence, percent);
}

}  // namespace

void measure_closed(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report) {
  // Sums about a point of the mesh, because a scan in map coordinates would lose digits about the
  // origin.
  const Vector3 origin = mesh.points[index(mesh.triangles[0][0])];
  const MeshSums sums = mesh_sums(mesh.points, mesh.triangles, origin, execution);
  report.volume = sums.volume();
  report.area = sums.area();
  if (!(report.volume > flat_limit * std::pow(report.area, 1.5))) {
    // Far from the origin, single precision leaves only a few different positions.
    const std::string precision = single_precision_warning(mesh);
    if (!precision.empty()) refuse("The mesh encloses no volume. " + precision);
    refuse("The mesh encloses no volume: it is flat, with an area of " +
           format_number(report.area) + " and a volume of " + format_number(report.volume) +
           ". Load the closed surface of a grain.");
  }
  report.centroid = origin + sums.centroid();
  report.sliver_faces = sums.flat_triangles;
  report.vertices = mesh.points.size();
  report.faces = mesh.triangles.size();
  // V - E + F = 2 - 2 genus, with E = 3 F / 2 of a closed triangle mesh.
  const auto euler =
      static_cast<std::int64_t>(report.vertices) - static_cast<std::int64_t>(report.faces / 2);
  report.genus = static_cast<int>((2 - euler) / 2);
  report.equivalent_radius = equivalent_radius(report.volume);
}

namespace {

/// Welds equal points, and drops the faces that then have two corners in one. Returns the diagonal
/// of the mesh's box.
double weld(double tolerance, const Execution& execution, IndexedMesh& mesh,
            MeshCheckReport& report) {
  const Box box = box_of_faces(mesh, execution);
  check_scan_size(box.high - box.low);
  const double diagonal = (box.high - box.low).norm();
  report.weld_tolerance = tolerance * diagonal;
  const Weld welded = find_equal_points(mesh.points, box, report.weld_tolerance, execution);
  const DegenerateFaces degenerate = drop_degenerate_faces(mesh, welded.first);
  report.welded_vertices = welded.welded;
  report.degenerate_faces = degenerate.faces;
  report.unreferenced_vertices = mesh.points.size() - welded.welded - degenerate.used_vertices;
  if (mesh.triangles.empty()) {
    refuse("All " + std::to_string(report.input_faces) +
           " faces of the mesh have two corners in one place, so it encloses no volume. Load the "
           "closed surface of a grain.");
  }
  return diagonal;
}

/// Drops copies of faces, and faces that lie on each other in pairs. Returns what was dropped.
DuplicateFaces drop_copies(const Execution& execution, IndexedMesh& mesh,
                           std::vector<std::int32_t>& rings, MeshCheckReport& report) {
  rings = edge_rings(mesh, execution);
  const DuplicateFaces duplicates = drop_duplicate_faces(mesh, rings);
  report.duplicate_faces = duplicates.copies;
  report.folded_faces = duplicates.folded;
  if (mesh.triangles.empty()) {
    refuse(
        "The faces of the mesh lie on each other in pairs, so it encloses no volume. Load the "
        "closed surface of a grain.");
  }
  if (duplicates.copies + duplicates.folded > 0) rings = edge_rings(mesh, execution);
  return duplicates;
}

}  // namespace

// Each repair needs the repairs before it. Points are welded before faces are compared, because a
// copy of a face may have its own corners. Copies are dropped before edges are counted, because
// they would give their edges four faces. Sheets are separated before faces are turned, because a
// non-manifold edge has no outside. Holes are filled after faces are turned, because the rim's
// direction gives the filling's outside. Touching vertices are split last, because
// separate_sheets and fill_holes may leave some.
CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution) {
  require_in_range(options.weld_tolerance, weld_tolerance_option);
  require_in_range(options.mended_area_limit_percent, mended_area_limit_option);
  require_in_range(options.dropped_volume_limit, dropped_volume_limit_option);
  const std::string stage = "Checking the mesh";
  CheckedMesh result;
  MeshCheckReport& report = result.report;
  report.input_vertices = mesh.points.size();
  report.input_faces = mesh.triangles.size();
  execution.report(0.0, stage);
  report.lost_faces = keep_usable_faces(mesh, execution);
  const double diagonal = weld(options.weld_tolerance, execution, mesh, report);
  execution.report(0.25, stage);
  std::vector<std::int32_t> rings;
  const DuplicateFaces duplicates = drop_copies(execution, mesh, rings, report);
  execution.report(0.5, stage);

  std::vector<OtherComponent> others;
  Components components = find_components(mesh, rings, execution);
  std::size_t main = largest_of(components);
  append_others(mesh, components, main, others);
  // The repairs below are for the kept part. On a clean scan they only read counts.
  const auto look_again = [&] {
    rings = edge_rings(mesh, execution);
    components = find_components(mesh, rings, execution);
    main = largest_of(components);
    append_others(mesh, components, main, others);
  };
  double flap_area = 0.0;
  if (components.list[main].non_manifold_edges > 0) {
    keep_faces(mesh, components, main);
    rings = edge_rings(mesh, execution);
    const ManifoldRepair repair = separate_sheets(mesh, rings);
    report.non_manifold_edges = repair.edges;
    report.flap_faces = repair.dropped_faces;
    report.split_vertices = repair.added_vertices;
    flap_area = repair.dropped_area;
    look_again();
  }
  if (!components.list[main].orientable) {
    throw WrappableScan(
        ErrorCode::InvalidInput,
        std::string(components.list.size() > 1 ? "The largest part of the mesh" : "The mesh") +
            " is not orientable: its faces cannot all be turned to face outward, so they enclose "
            "nothing. Give it two sides first (" +
            where_meshlab_closes() + "), or scan the grain again.",
        finest_tried_percent);
  }
  FilledHoles filled;
  const std::size_t boundary_edges = components.list[main].boundary_edges;
  if (boundary_edges > 0) {
    report.reoriented_faces = keep_component(mesh, components, main);
    const std::size_t faces = mesh.triangles.size();
    filled = fill_holes(mesh, edge_rings(mesh, execution));
    report.filled_holes = filled.holes;
    report.filling_faces = filled.faces;
    look_again();
    // The side of an open surface's volume was a guess.
    if (components.list[main].volume < 0.0)
      report.reoriented_faces = faces - report.reoriented_faces;
  }
  execution.report(0.75, stage);
  report.split_vertices += split_touching_vertices(mesh, rings, components.of_face,
                                                   static_cast<std::int32_t>(main), execution);
  const std::size_t turned = keep_component(mesh, components, main);
  if (boundary_edges == 0) report.reoriented_faces = turned;
  measure_closed(mesh, execution, report);
  report.duplicate_area_share = duplicates.copied_area / report.area;
  report.folded_area_share = duplicates.folded_area / report.area;
  report.flap_area_share = flap_area / report.area;
  report.filled_area_share = filled.area / report.area;
  judge_mending(options, boundary_edges, filled.widest / diagonal, report);
  judge_others(mesh, others, options, execution, report);
  report.has_voxel_steps = has_voxel_steps(mesh);
  result.mesh = std::move(mesh);
  execution.report(1.0, stage);
  return result;
}

}  // namespace wscvt
