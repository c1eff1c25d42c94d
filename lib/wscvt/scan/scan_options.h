// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

// How a scan becomes one closed surface, and what was done to it.

/// Limits of the repair of a scan.
struct MeshCheckOptions {
  /// Points nearer to each other than this fraction of the diagonal of the mesh's box, in each
  /// coordinate, are welded; 0 to 0.01, 0: exact copies only. The poles of published asteroids
  /// lie 1e-17 apart; the default is far above what writing and reading numbers does, and far below
  /// the accuracy of any scan.
  double weld_tolerance = 1e-12;
  /// Max. repaired fraction of the area, in %, 0 to 100: of the faces dropped where more
  /// than two met in an edge and of those put into holes. Above it the mesh is refused.
  double mended_area_limit_percent = 5.0;
  /// Max. fraction in (0, 1) of the total volume that may be dropped with other bodies; above it
  /// there is no main body and the mesh is refused.
  double dropped_volume_limit = 0.25;
};

/// Not an option of a remesh: the default serves every scan tried.
inline constexpr NumberOption<double> weld_tolerance_option = {
    "weld-tolerance", "tolerance of welding / size of the scan", 0.0, 0.01,
    Ends::Both,       "points nearer to each other are one"};
inline constexpr NumberOption<double> mended_area_limit_option = {
    "max-repaired-area",
    "max. repaired area in %",
    0.0,
    100.0,
    Ends::Both,
    "of the scan's area; the scan is refused if repairs change more"};
/// Not an option of a remesh either: above a quarter there is no main body.
inline constexpr NumberOption<double> dropped_volume_limit_option = {
    "dropped-volume",
    "largest fraction of the volume to drop with smaller parts",
    0.0,
    1.0,
    Ends::Neither,
    "above it the scan is refused"};

/// Faults and repairs of a scan. Fractions of area refer to the mesh that was kept.
struct MeshCheckReport {
  std::size_t input_vertices = 0;
  std::size_t input_faces = 0;
  std::size_t lost_faces = 0;       ///< faces with a vertex that has no finite position, dropped
  std::size_t welded_vertices = 0;  ///< vertices merged into an equal one
  double weld_tolerance = 0.0;      ///< within which vertices were equal, length
  std::size_t unreferenced_vertices = 0;  ///< vertices of no face, dropped
  std::size_t degenerate_faces = 0;       ///< faces with two equal corners after welding, dropped
  std::size_t sliver_faces = 0;  ///< faces of no area with three corners: kept, else a hole opens
  std::size_t duplicate_faces = 0;     ///< copies of a face kept, dropped
  double duplicate_area_share = 0.0;   ///< their fraction of area
  std::size_t folded_faces = 0;        ///< faces folded flat onto each other, dropped
  double folded_area_share = 0.0;      ///< their fraction of area
  std::size_t non_manifold_edges = 0;  ///< of the main part, on which more than two faces met
  std::size_t flap_faces = 0;          ///< faces of flaps and inner walls on them, dropped
  double flap_area_share = 0.0;        ///< their fraction of area
  std::size_t filled_holes = 0;        ///< of the mesh kept
  std::size_t filling_faces = 0;       ///< put into them
  double filled_area_share = 0.0;      ///< their fraction of area
  std::size_t reoriented_faces = 0;    ///< faces kept that were turned round to face outward
  std::size_t split_vertices = 0;      ///< vertices added where the surface touched itself
  std::size_t components = 0;          ///< parts after the repairs, the one kept included
  std::size_t inner_components = 0;    ///< of them inside the one kept: pores, inclusions
  double inner_volume_share = 0.0;     ///< sum of what each encloses / volume of the mesh kept
  std::size_t dropped_faces = 0;       ///< faces of the components not kept
  double dropped_volume_share = 0.0;   ///< of those outside / of those and the one kept
  std::size_t vertices = 0;            ///< of the mesh kept
  std::size_t faces = 0;               ///< of the mesh kept
  int genus = 0;                       ///< of the mesh kept
  double volume = 0.0;                 ///< of its outer surface, length^3, > 0
  double area = 0.0;                   ///< length^2
  Vector3 centroid = Vector3::Zero();  ///< of the volume, in the input's coordinates
  double equivalent_radius = 0.0;      ///< (3 V / 4 pi)^(1/3), length
  bool has_voxel_steps = false;        ///< the mesh kept is the faces of voxels
};

/// A closed, oriented, connected 2-manifold and how it was obtained.
struct CheckedMesh {
  IndexedMesh mesh;  ///< in the input's coordinates, vertices and faces in the input's order
  MeshCheckReport report;
};

/// Whether a scan is taken by its envelope, and how coarse that is.
struct EnvelopeOptions {
  /// Openings up to this wide are closed, in % of the diagonal of the scan's bounding box; 0: the
  /// scan itself is taken.
  double opening_percent = 0.0;
};

inline constexpr NumberOption<double> envelope_option = {
    "shrink-wrap",
    "shrink-wrap in %",
    0.0,
    50.0,
    Ends::Both,
    "wrap the scan (CGAL alpha wrap), which closes pores, holes and gaps up to this width, in % of "
    "the bounding box's diagonal; 0: the scan itself. For scans that are refused for flaws or "
    "pores"};

/// Smallest opening but 0. The finer the shrink-wrap, the longer it takes: of a porous scan of
/// 31,000 faces with its remesh 7 s at 5 %, 52 s at 2 %, 165 s at 1 %, on a busy machine.
inline constexpr double smallest_opening_percent = 1.0;

/// Throws Error(InvalidInput), with the range, for an opening that is neither 0 nor from
/// smallest_opening_percent to 50.
void check_envelope_options(const EnvelopeOptions& options);

/// Treatment of handles: tunnels through the grain, and bridges from one place to another.
enum class HandleAction {
  Cut,     ///< those with a short loop, which are the scanner's, are cut; others stay
  Keep,    ///< all stay
  Refuse,  ///< a scan with any is refused
};

template <>
struct EnumerationTable<HandleAction> {
  static constexpr std::string_view key = "handles";
  static constexpr std::string_view subject = "treatment of handles";
  static constexpr Enumerator<HandleAction> rows[] = {
      {HandleAction::Cut, "cut", "cut",
       "handles with a loop up to --max-handle-loop, which scanners make, are removed; larger "
       "ones, "
       "as of a ring, stay"},
      {HandleAction::Keep, "keep", "keep", "all stay"},
      {HandleAction::Refuse, "refuse", "refuse", "a scan with a handle is refused"},
  };
};

/// Options that decide which handles are cut.
struct HandleOptions {
  HandleAction action = HandleAction::Cut;
  /// Longest loop along which a handle is cut, in equivalent radii; >= 0. Scanner noise makes
  /// handles of a few voxels, up to half a radius on a rough scan; a ring, whose hole is real, has
  /// no loop below 0.7 radii unless its tube is 150 times thinner than the ring is wide.
  double length_limit = 0.7;
};

/// Scans with more handles are refused before one is cut: they are porous, and no sheet of nodes
/// that a simulation can afford follows their pores. Rough scans had up to 5, a coral 149.
inline constexpr std::size_t most_handles_cut = 50;

inline constexpr NumberOption<double> max_handle_loop_option{
    "max-handle-loop",
    "max. loop of a handle that is cut",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::Both,
    "in equivalent radii; handles with a longer loop are real and stay"};

/// A handle, by the loop along which it is cut.
struct CutHandle {
  double length = 0.0;              ///< of the loop, length
  Vector3 place = Vector3::Zero();  ///< mean of the loop's vertices, in the input's coordinates
  int edges = 0;                    ///< of the loop
};

/// Handles that were cut, and those that stay.
struct HandleReport {
  std::vector<CutHandle> cut;  ///< in the order in which they were cut, shortest loops first
  int kept = 0;                ///< handles left: the genus of the mesh remeshed
  CutHandle next;  ///< of those kept the one with the shortest loop, where it was looked for
  /// Volume afterwards / before, less 1, no unit: what filling tunnels adds, cutting bridges takes
  /// away.
  double volume_change = 0.0;
};

}  // namespace wscvt
