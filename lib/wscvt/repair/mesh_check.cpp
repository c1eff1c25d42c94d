// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/mesh_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/components.h"
#include "wscvt/repair/coordinates.h"
#include "wscvt/repair/mesh_cells.h"
#include "wscvt/repair/repair_steps.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/repair/scan_options.h"
#include "wscvt/repair/stray_vertex.h"
#include "wscvt/repair/weld.h"

namespace wscvt {

namespace {

/// Below this volume / area^1.5 (0.094 for a sphere, a third of the thickness for a plate) the
/// surface is flat within rounding.
constexpr double flat_limit = 1e-9;

/// A component that is not kept.
struct OtherComponent {
  std::size_t faces = 0;
  double volume = 0.0;
  bool is_open = false;
  std::vector<Vector3> points;  // on it, if possible not on the kept component
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
  // neither inside nor outside. If all vertices are shared, the centre of a face is used. Points
  // spread over the part, because of a part that crosses the kept one only some are inside.
  constexpr std::size_t most_points = 32;
  std::vector<OtherComponent> list(components.list.size());
  std::vector<Vector3> centres(list.size(), Vector3::Zero());
  std::vector<std::size_t> seen(list.size(), 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::size_t c = index(components.of_face[f]);
    if (c == main) continue;
    const std::size_t step = 1 + components.list[c].faces / most_points;
    const Triangle& t = mesh.triangles[f];
    if (seen[c]++ == 0) {
      centres[c] =
          (mesh.points[index(t[0])] + mesh.points[index(t[1])] + mesh.points[index(t[2])]) / 3.0;
    }
    if (list[c].points.size() * step >= seen[c]) continue;
    const auto own =
        std::find_if(t.begin(), t.end(), [&](std::int32_t v) { return on_main[index(v)] == 0; });
    if (own != t.end()) list[c].points.push_back(mesh.points[index(*own)]);
  }
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (c == main) continue;
    if (list[c].points.empty()) list[c].points.push_back(centres[c]);
    list[c].faces = components.list[c].faces;
    list[c].volume = std::abs(components.list[c].volume);
    list[c].is_open = components.list[c].boundary_edges > 0;
    others.push_back(list[c]);
  }
}

/// Reports the other components, and refuses the mesh if the outer components are too large.
/// `seam`: distance of open edges from each other, 0 if they are no seam. `is_open`: `kept` was
/// open before it was filled.
void judge_others(const IndexedMesh& kept, const std::vector<OtherComponent>& others, double seam,
                  bool is_open, const MeshCheckOptions& options, const Execution& execution,
                  MeshCheckReport& report) {
  report.components = others.size() + 1;
  if (others.empty()) return;
  std::vector<Vector3> points;
  for (const OtherComponent& other : others) {
    points.insert(points.end(), other.points.begin(), other.points.end());
  }
  const std::vector<char> inside = are_inside(kept, points, execution);
  double outer_volume = 0.0;
  double inner_volume = 0.0;
  std::size_t crossing = 0;
  std::size_t open = is_open ? 1 : 0;
  auto next = inside.begin();
  for (const OtherComponent& other : others) {
    const auto end = next + static_cast<std::ptrdiff_t>(other.points.size());
    const auto within = static_cast<std::size_t>(std::count(next, end, 1));
    next = end;
    report.dropped_faces += other.faces;
    // A tenth of the points may be off, where both surfaces nearly touch.
    const bool is_inner = 10 * within >= 9 * other.points.size();
    if (is_inner) ++report.inner_components;
    if (10 * within > other.points.size() && !is_inner) ++crossing;
    open += other.is_open ? 1 : 0;
    (is_inner ? inner_volume : outer_volume) += other.volume;
  }
  report.inner_volume_fraction = inner_volume / report.volume;
  report.dropped_volume_fraction = outer_volume / (outer_volume + report.volume);
  if (report.dropped_volume_fraction > options.dropped_volume_limit) {
    if (seam > 0.0) refuse(open_seam_sentence(seam));
    if (crossing > 0 && open == 0) {
      refuse("The mesh has " + format_count(crossing + 1, "closed surface") +
             " that cross each other, so it is not clear what the grain is. Join them by " +
             mention(shrink_wrap_option, 1.0) + ".");
    }
    refuse("The mesh has " + std::to_string(report.components - report.inner_components) +
           " separate bodies and the largest has only " +
           format_percent(1.0 - report.dropped_volume_fraction) +
           " of their volume, so there is no main body" +
           (open > 0 ? "; " + format_count(open, "is", "are") + " open" : "") +
           ". Split the mesh (wscvt extract MESH OUT; in "
           "MeshLab Filters > Mesh Layer > Split in Connected Components) and remesh each body "
           "separately, or all of them by wscvt batch MESH -o OUT --parts.");
  }
}

/// Refuses the mesh if more area was repaired than allowed. `widest_share`: width of the widest
/// hole / diagonal of the bounding box. `seam` as in judge_others.
void judge_repair(const MeshCheckOptions& options, std::size_t boundary_edges, double widest_share,
                  double seam, const MeshCheckReport& report) {
  const double mended = report.flap_area_fraction + report.filled_area_fraction;
  const double limit = options.repaired_area_limit_percent;
  if (!(mended > 0.01 * limit)) return;
  if (seam > 0.0) refuse(open_seam_sentence(seam));
  std::string found;
  if (report.non_manifold_edges > 0) {
    found = format_count(report.non_manifold_edges, "non-manifold edge") +
            ", shared by more than two faces";
  }
  if (report.filled_holes > 0) {
    found += (found.empty() ? "" : ", and ") + format_count(boundary_edges, "boundary edge") +
             " around " + format_count(report.filled_holes, "hole");
  }
  Sentence sentence = "The mesh has " + found + ". Their repair would change " +
                      format_above(limit, 100.0 * mended) + " % of its area (limit " +
                      typed_text(limit) + " %). ";
  // Rounded up, because this number must be enough.
  const double enough = std::floor(1.0 + 1000.0 * mended) / 10.0;
  if (enough <= repaired_area_limit_option.maximum) {
    sentence += "Raise " + mention(repaired_area_limit_option) + " to " + typed_text(enough) +
                " % and check the result against the scan, close";
  } else {
    sentence += "Close";
  }
  sentence += " the openings first (" + where_meshlab_closes() + "), or scan the grain again.";
  // A ball as wide as the hole still enters it a little.
  const double percent = std::max(usual_opening_percent, std::ceil(120.0 * widest_share));
  if (percent <= coarsest_opening_percent) sentence += " " + wrap_advice(percent);
  refuse(sentence);
}

/// Refuses a mesh in which a vertex lies so far from all its neighbours that it is a fault of the
/// scan; reports nearer ones. Before points are welded, because the tolerance grows with the box.
void refuse_far_vertex(const IndexedMesh& mesh, MeshCheckReport& report) {
  constexpr double farthest = 30.0;
  const StrayVertex stray = find_stray_vertex(mesh);
  report.stray_distance = stray.distance;
  report.stray_vertex = stray.vertex;
  report.stray_place = stray.place;
  refuse_stray_vertex(stray, farthest);
}

/// A mesh with the rings of its edges, which are made when they are first needed after a change.
/// For a million vertices they take a tenth of a second.
class RingedMesh {
 public:
  RingedMesh(IndexedMesh given, const Execution& execution)
      : mesh(std::move(given)), execution_(execution) {}

  /// As edge_rings returns them.
  const std::vector<std::int32_t>& rings() {
    if (rings_.empty()) rings_ = edge_rings(mesh, execution_);
    return rings_;
  }

  /// Must follow a change that drops, adds or turns faces. Other names of vertices are no change.
  void forget_rings() { rings_ = {}; }

  IndexedMesh mesh;

 private:
  const Execution& execution_;
  std::vector<std::int32_t> rings_;
};

void merge_seams(RingedMesh& ringed, double diagonal, const Execution& execution,
                 MeshCheckReport& report) {
  const SeamWeld seams = find_seams(ringed.mesh, ringed.rings(), diagonal, execution);
  if (seams.weld.welded == 0) return;
  report.degenerate_faces += drop_degenerate_faces(ringed.mesh, seams.weld.first).faces;
  ringed.forget_rings();
  report.merged_corners = seams.weld.welded;
  report.merged_distance = seams.distance;
}

/// Refuses a mesh whose largest part is several bodies with common walls. Without the walls it
/// would be one body as large as all.
void refuse_common_walls(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                         const Execution& execution) {
  constexpr double largest_other = 0.05;  // of the volume; flaws of a scan enclose less
  const std::size_t beyond_two = execution.parallel_sum_of(
      rings.size(), usual_block, std::size_t{0}, [&](std::size_t h, std::size_t& count) {
        count += index(rings[index(rings[h])]) == h ? 0 : 1;
      });
  if (beyond_two == 0) return;  // so on nearly all scans
  const Components components = find_components(mesh, rings, execution);
  const std::size_t main = largest_of(components);
  if (components.list[main].non_manifold_edges == 0) return;
  IndexedMesh part = mesh;
  keep_faces(part, components, main);
  const MeshCells cells = find_mesh_cells(part, execution);
  std::vector<char> has_wall(cells.list.size(), 0);
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    const std::size_t before = index(cells.before(f));
    const std::size_t behind = index(cells.behind(f));
    if (before == behind || !cells.list[before].is_solid || !cells.list[behind].is_solid) continue;
    has_wall[before] = has_wall[behind] = 1;
  }
  std::size_t bodies = 0;
  double all = 0.0;
  double largest = 0.0;
  for (std::size_t c = 0; c < cells.list.size(); ++c) {
    if (has_wall[c] == 0) continue;
    ++bodies;
    all += std::max(0.0, cells.list[c].volume);
    largest = std::max(largest, cells.list[c].volume);
  }
  if (bodies < 2 || !(largest < (1.0 - largest_other) * all)) return;
  refuse("The mesh has " + std::to_string(bodies) +
         " bodies with common walls, and the largest has only " + format_percent(largest / all) +
         " of their volume. Split the mesh (wscvt extract MESH OUT) and remesh each body "
         "separately, or all of them by wscvt batch MESH -o OUT --parts.");
}

/// Refuses a mesh whose largest part is flat, because its faces are not connected.
void refuse_loose_faces(const IndexedMesh& mesh, std::size_t parts, const Execution& execution) {
  const MeshSums sums =
      mesh_sums(mesh.points, mesh.triangles, mesh.points[index(mesh.triangles[0][0])], execution);
  if (sums.volume() > flat_limit * portable::pow(sums.area(), 1.5)) return;
  refuse(
      "The mesh has " + std::to_string(parts) +
      " parts without a common edge, and the largest encloses no volume. If its faces are one "
      "surface, merge the corners that are close to each other (in MeshLab Filters > Cleaning and "
      "Repairing > Merge Close Vertices), or export it again with more digits.");
}

}  // namespace

void measure_closed(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report) {
  // Sums about a point of the mesh, because a scan in map coordinates would lose digits about the
  // origin.
  const Vector3 origin = mesh.points[index(mesh.triangles[0][0])];
  const MeshSums sums = mesh_sums(mesh.points, mesh.triangles, origin, execution);
  report.volume = sums.volume();
  report.area = sums.area();
  if (!(report.volume > flat_limit * portable::pow(report.area, 1.5))) {
    // Far from the origin, single precision leaves only a few different positions.
    const std::string precision = single_precision_warning(mesh, "The scan");
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
  refuse_far_vertex(mesh, report);
  const Box box = box_of_faces(mesh);
  check_scan_size(box.sizes());
  const double diagonal = box.sizes().norm();
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
DuplicateFaces drop_copies(RingedMesh& ringed, MeshCheckReport& report) {
  const DuplicateFaces duplicates = drop_duplicate_faces(ringed.mesh, ringed.rings());
  if (duplicates.copies + duplicates.folded > 0) ringed.forget_rings();
  report.duplicate_faces = duplicates.copies;
  report.back_to_back_faces = duplicates.folded;
  if (ringed.mesh.triangles.empty()) {
    refuse(
        "The faces of the mesh lie on each other in pairs, so it encloses no volume. Load the "
        "closed surface of a grain.");
  }
  return duplicates;
}

/// Keeps one component and separates its sheets.
ManifoldRepair separate_sheets_of(RingedMesh& ringed, const Components& components,
                                  std::size_t kept) {
  keep_faces(ringed.mesh, components, kept);
  if (components.list.size() > 1) ringed.forget_rings();
  const ManifoldRepair repair = separate_sheets(ringed.mesh, ringed.rings());
  ringed.forget_rings();
  return repair;
}

/// Keeps one component, turned outward, and fills its holes.
FilledHoles fill_holes_of(RingedMesh& ringed, const Components& components, std::size_t kept,
                          MeshCheckReport& report) {
  report.reoriented_faces = keep_component(ringed.mesh, components, kept);
  if (components.list.size() > 1 || report.reoriented_faces > 0) ringed.forget_rings();
  const FilledHoles filled = fill_holes(ringed.mesh, ringed.rings());
  ringed.forget_rings();
  report.filled_holes = filled.holes;
  report.filling_faces = filled.faces;
  return filled;
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
  require_in_range(options.repaired_area_limit_percent, repaired_area_limit_option);
  require_in_range(options.dropped_volume_limit, dropped_volume_limit_option);
  const std::string stage = "Checking the mesh";
  CheckedMesh result;
  MeshCheckReport& report = result.report;
  report.input_vertices = mesh.points.size();
  report.input_faces = mesh.triangles.size();
  execution.report(0.0, stage);
  report.lost_faces = keep_usable_faces(mesh);
  const double diagonal = weld(options.weld_tolerance, execution, mesh, report);
  execution.report(0.25, stage);
  RingedMesh ringed(std::move(mesh), execution);
  if (options.weld_tolerance > 0.0) merge_seams(ringed, diagonal, execution, report);
  refuse_common_walls(ringed.mesh, ringed.rings(), execution);
  const DuplicateFaces duplicates = drop_copies(ringed, report);
  execution.report(0.5, stage);

  std::vector<OtherComponent> others;
  Components components;
  std::size_t main = 0;
  const auto look = [&] {
    components = find_components(ringed.mesh, ringed.rings(), execution);
    main = largest_of(components);
    append_others(ringed.mesh, components, main, others);
  };
  look();
  // The repairs below are for the kept part. On a clean scan they only read counts.
  double flap_area = 0.0;
  if (components.list[main].non_manifold_edges > 0) {
    const ManifoldRepair repair = separate_sheets_of(ringed, components, main);
    report.non_manifold_edges = repair.edges;
    report.flap_faces = repair.dropped_faces;
    report.split_vertices = repair.added_vertices;
    flap_area = repair.dropped_area;
    look();
  }
  if (!components.list[main].orientable) {
    refuse(std::string(components.list.size() > 1 ? "The largest part of the mesh" : "The mesh") +
           " is not orientable: its faces cannot all be turned to face outward, so they enclose "
           "nothing. Give it two sides first (" +
           where_meshlab_closes() + "), or scan the grain again. " + wrap_advice());
  }
  FilledHoles filled;
  const std::size_t boundary_edges = components.list[main].boundary_edges;
  double seam = 0.0;
  if (boundary_edges > 0) {
    constexpr double wide = 1000.0;  // a seam of up to 1e-3 of the diagonal
    seam = find_seams(ringed.mesh, ringed.rings(), wide * diagonal, execution).distance;
    filled = fill_holes_of(ringed, components, main, report);
    look();
    // The side of an open surface's volume was a guess.
    if (components.list[main].volume < 0.0) {
      report.reoriented_faces =
          ringed.mesh.triangles.size() - filled.faces - report.reoriented_faces;
    }
  }
  execution.report(0.75, stage);
  report.split_vertices += split_touching_vertices(ringed.mesh, ringed.rings(), components.of_face,
                                                   static_cast<std::int32_t>(main), execution);
  ringed.forget_rings();  // frees memory
  mesh = std::move(ringed.mesh);
  const std::size_t turned = keep_component(mesh, components, main);
  if (boundary_edges == 0) report.reoriented_faces = turned;
  if (!others.empty()) refuse_loose_faces(mesh, others.size() + 1, execution);
  measure_closed(mesh, execution, report);
  report.duplicate_area_fraction = duplicates.copied_area / report.area;
  report.back_to_back_area_fraction = duplicates.folded_area / report.area;
  report.flap_area_fraction = flap_area / report.area;
  report.filled_area_fraction = filled.area / report.area;
  // First the bodies: a shrink-wrap of all would join them.
  judge_others(mesh, others, seam, boundary_edges > 0, options, execution, report);
  judge_repair(options, boundary_edges, filled.widest / diagonal, seam, report);
  report.has_voxel_steps = has_voxel_steps(mesh);
  result.mesh = std::move(mesh);
  execution.report(1.0, stage);
  return result;
}

}  // namespace wscvt
