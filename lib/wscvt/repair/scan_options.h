// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

// Options and reports of the repair of a scan, which makes it one closed surface.

/// Limits of the repair of a scan.
struct MeshCheckOptions {
  /// Points closer than this fraction of the diagonal of the mesh's box, in each coordinate, are
  /// welded. 0 to 0.01; 0: only exact copies, also along open edges (see find_seams in weld.h). The
  /// poles of published asteroids are 1e-17 apart. The default is far above the rounding of numbers
  /// in files, and far below the accuracy of any scan.
  double weld_tolerance = 1e-12;
  /// Max. repaired fraction of the area, in %, 0 to 100: faces dropped at non-manifold edges and
  /// faces added in holes. Above it the mesh is refused.
  double repaired_area_limit_percent = 5.0;
  /// Max. fraction in (0, 1) of the total volume that is dropped with other bodies. Above it there
  /// is no main body, and the mesh is refused.
  double dropped_volume_limit = 0.25;
};

/// Not an option of a remesh: the default works for every scan tried.
inline constexpr NumberOption<double> weld_tolerance_option = {
    "weld-tolerance",          "tolerance of welding / size of the scan", 0.0, 0.01, Ends::Both,
    "closer points are merged"};
inline constexpr NumberOption<double> repaired_area_limit_option = {
    "max-repaired-area",
    "max. repaired area in %",
    0.0,
    100.0,
    Ends::Both,
    "refuse the scan if repairs change more of its area"};
/// Not an option of a remesh either: above a quarter there is no main body.
inline constexpr NumberOption<double> dropped_volume_limit_option = {
    "dropped-volume",
    "max. fraction of the volume to drop with smaller parts",
    0.0,
    1.0,
    Ends::Neither,
    "above it, refuse the scan"};

/// Faults and repairs of a scan. Fractions of area refer to the mesh that was kept.
struct MeshCheckReport {
  std::size_t input_vertices = 0;
  std::size_t input_faces = 0;
  std::size_t lost_faces = 0;       ///< faces with a vertex that has no finite position, dropped
  std::size_t welded_vertices = 0;  ///< vertices merged with an equal vertex
  double weld_tolerance = 0.0;      ///< distance within which vertices are equal, length
  double stray_distance = 0.0;      ///< of a vertex far from all its neighbours, length; 0: none
  std::size_t stray_vertex = 0;     ///< its index in the input
  Vector3 stray_place = Vector3::Zero();  ///< in the input's coordinates
  std::size_t merged_corners = 0;  ///< vertices of open edges merged with a near one (see weld.h)
  double merged_distance = 0.0;    ///< largest distance of these, length
  std::size_t unreferenced_vertices = 0;  ///< vertices of no face, dropped
  std::size_t degenerate_faces = 0;       ///< faces with two equal corners after welding, dropped
  std::size_t sliver_faces = 0;  ///< faces of zero area with three corners; kept, else a hole opens
  std::size_t duplicate_faces = 0;          ///< copies of a face kept, dropped
  double duplicate_area_fraction = 0.0;     ///< their fraction of area
  std::size_t back_to_back_faces = 0;       ///< faces folded flat onto each other, dropped
  double back_to_back_area_fraction = 0.0;  ///< their fraction of area
  std::size_t non_manifold_edges = 0;       ///< edges of the main part with more than two faces
  std::size_t flap_faces = 0;               ///< faces of flaps and inner walls on them, dropped
  double flap_area_fraction = 0.0;          ///< their fraction of area
  std::size_t filled_holes = 0;             ///< of the mesh kept
  std::size_t filling_faces = 0;            ///< added in the holes
  double filled_area_fraction = 0.0;        ///< their fraction of area
  std::size_t reoriented_faces = 0;         ///< faces kept that were turned round to face outward
  std::size_t split_vertices = 0;    ///< vertices added at places where the surface touched itself
  std::size_t components = 0;        ///< parts after the repairs, with the part kept
  std::size_t inner_components = 0;  ///< parts inside the part kept: pores, inclusions
  double inner_volume_fraction = 0.0;    ///< sum of their volumes / volume of the mesh kept
  std::size_t dropped_faces = 0;         ///< faces of the components not kept
  double dropped_volume_fraction = 0.0;  ///< of parts outside / of these and the part kept
  std::size_t vertices = 0;              ///< of the mesh kept
  std::size_t faces = 0;                 ///< of the mesh kept
  int genus = 0;                         ///< of the mesh kept
  double volume = 0.0;                   ///< enclosed by its outer surface, length^3, > 0
  double area = 0.0;                     ///< length^2
  Vector3 centroid = Vector3::Zero();    ///< of the volume, in the input's coordinates
  double equivalent_radius = 0.0;        ///< (3 V / 4 pi)^(1/3), length
  bool has_voxel_steps = false;          ///< the mesh kept consists of voxel faces
};

/// A closed, oriented, connected 2-manifold and the report of its repair.
struct CheckedMesh {
  IndexedMesh mesh;  ///< in the input's coordinates, vertices and faces in the input's order
  MeshCheckReport report;
};

/// Options of the shrink-wrap of a scan.
struct ShrinkWrapOptions {
  /// Width up to which openings are closed, in % of the diagonal of the scan's bounding box. 0: no
  /// shrink-wrap.
  double opening_percent = 0.0;
};

inline constexpr NumberOption<double> shrink_wrap_option = {
    "shrink-wrap",
    "shrink-wrap in %",
    0.0,
    50.0,
    Ends::Both,
    "wrap the scan (CGAL alpha wrap) to close pores, holes and gaps up to this width, in % of the "
    "bounding box's diagonal; 0: no wrap. For scans that are refused because of flaws or pores"};

/// Smallest opening above 0. A finer shrink-wrap takes longer. A porous scan of 31,000 faces and
/// its remesh took 7 s at 5 %, 52 s at 2 % and 165 s at 1 %, on a busy machine.
inline constexpr double smallest_opening_percent = 1.0;

/// Throws Error(InvalidInput), with the range, for an opening that is neither 0 nor from
/// smallest_opening_percent to 50.
void check_shrink_wrap_options(const ShrinkWrapOptions& options);

/// Treatment of handles: tunnels through the grain, and bridges from one place to another.
enum class HandleAction {
  Cut,     ///< handles with a short loop, made by the scanner, are cut; others stay
  Keep,    ///< all stay
  Refuse,  ///< a scan with a handle is refused
};

template <>
struct EnumerationTable<HandleAction> {
  static constexpr std::string_view key = "handles";
  static constexpr std::string_view subject = "treatment of handles";
  static constexpr Enumerator<HandleAction> rows[] = {
      {HandleAction::Cut, "cut", "cut",
       "remove handles with a short loop, because scanners make them; keep "
       "larger handles, such as a ring's"},
      {HandleAction::Keep, "keep", "keep", "keep all handles"},
      {HandleAction::Refuse, "refuse", "refuse", "refuse a scan with a handle"},
  };
};

/// Options that decide which handles are cut.
struct HandleOptions {
  HandleAction action = HandleAction::Cut;
  /// Longest loop along which a handle is cut, in equivalent radii; >= 0; 0 keeps all. Scanner
  /// noise makes handles of a few voxels, up to half a radius on a rough scan. A ring, with a real
  /// hole, has no loop below 0.7 radii, unless its tube is 150 times thinner than the ring is wide.
  double length_limit = 0.7;
};

/// Scans with more handles are refused before any handle is cut. Such scans are porous, and a
/// simulation cannot afford the nodes that follow their pores. Rough scans had up to 5 handles, a
/// coral 149.
inline constexpr std::size_t most_handles_cut = 50;

inline constexpr NumberOption<double> max_handle_loop_option{
    "max-handle-loop",
    "max. loop of a handle that is cut",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::Both,
    "in equivalent radii. Handles with a longer loop are real and are kept; 0 keeps all"};

/// Loop along which a handle is cut.
struct CutHandle {
  double length = 0.0;              ///< of the loop, length
  Vector3 place = Vector3::Zero();  ///< mean of the loop's vertices, in the input's coordinates
  int edges = 0;                    ///< of the loop
};

/// Handles that were cut, and handles that stay.
struct HandleReport {
  std::vector<CutHandle> cut;  ///< in the order in which they were cut, shortest loops first
  int kept = 0;                ///< handles left: the genus of the mesh remeshed
  CutHandle next;              ///< kept handle with the shortest loop, if it was searched
  /// Volume afterwards / before - 1, no unit. Filled tunnels add volume, cut bridges remove it.
  double volume_change = 0.0;
};

}  // namespace wscvt
