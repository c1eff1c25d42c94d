// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// What of a scan may be mended.
struct MeshCheckOptions {
  /// Points nearer to each other than this share of the diagonal of the mesh's box, in each
  /// coordinate, are welded; 0 to 0.01, 0: exact copies only. The poles of published asteroids
  /// lie 1e-17 apart; the default is far above what writing and reading numbers does, and far below
  /// the accuracy of any scan.
  double weld_tolerance = 1e-12;
  /// Largest share of the area that may be mended, in %, 0 to 100: of the faces dropped where more
  /// than two met in an edge and of those put into holes. Above it the mesh is refused.
  double mended_area_limit_percent = 5.0;
  /// Largest share in (0, 1) of the total volume that may be dropped with other bodies; above it
  /// there is no main body and the mesh is refused.
  double dropped_volume_limit = 0.25;
};

inline constexpr NumberOption<double> weld_tolerance_option = {
    "weld-tolerance", "tolerance of welding / size of the scan", 0.0, 0.01,
    Ends::Both,       "points nearer to each other are one"};
inline constexpr NumberOption<double> mended_area_limit_option = {
    "mend-limit", "largest share of the area to mend in %",
    0.0,          100.0,
    Ends::Both,   "above it the scan is refused"};
inline constexpr NumberOption<double> dropped_volume_limit_option = {
    "dropped-volume",
    "largest share of the volume to drop with smaller parts",
    0.0,
    1.0,
    Ends::Neither,
    "above it the scan is refused"};

/// What was found and what was mended. Shares of area are of the area of the mesh kept.
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
  double duplicate_area_share = 0.0;   ///< their share of area
  std::size_t folded_faces = 0;        ///< faces folded flat onto each other, dropped
  double folded_area_share = 0.0;      ///< their share of area
  std::size_t non_manifold_edges = 0;  ///< of the main part, on which more than two faces met
  std::size_t flap_faces = 0;          ///< faces of flaps and inner walls on them, dropped
  double flap_area_share = 0.0;        ///< their share of area
  std::size_t filled_holes = 0;        ///< of the mesh kept
  std::size_t filling_faces = 0;       ///< put into them
  double filled_area_share = 0.0;      ///< their share of area
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
};

/// A closed, oriented, connected 2-manifold and how it was obtained.
struct CheckedMesh {
  IndexedMesh mesh;  ///< in the input's coordinates, vertices and faces in the input's order
  MeshCheckReport report;
};

/// Makes one closed outer surface of a scan, by these repairs, each counted in the report:
/// - faces without a finite position are dropped, equal points are welded (see weld.h), degenerate,
///   doubled and folded faces are dropped (see degenerate_faces.h);
/// - of the parts connected through edges the one of largest volume is kept. Of the others those
///   inside it are pores or inclusions, those outside are other bodies;
/// - where more than two faces meet in an edge, flaps and walls are dropped and sheets taken apart
///   (see manifold_edges.h); of what comes apart the largest is kept again;
/// - faces are turned outward and holes are filled (see holes.h);
/// - where fans of faces touch in one vertex only, each gets a vertex of its own.
/// A clean scan goes through unchanged.
///
/// Throws Error(InvalidInput) with what to do about it when the mesh is empty, has indices out of
/// range, is too large or too small to compute with (1e-60 to 1e60), is not orientable, encloses no
/// volume, falls into parts of comparable volume, or would need more of its area mended than the
/// limit; and when an option is out of range.
CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution);

/// Fills in what a report says of a closed, outward mesh: sliver faces, vertices, faces, genus,
/// volume, area, centroid and equivalent radius. Throws Error(InvalidInput) when it encloses no
/// volume.
void measure_closed(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report);

}  // namespace wscvt
