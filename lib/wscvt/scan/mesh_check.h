// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

struct MeshCheckOptions {
  /// Largest share in (0, 1) of the total volume that may be dropped with secondary components;
  /// above it there is no main body and the mesh is refused.
  double dropped_volume_limit = 0.25;
};

/// What was found and what was mended.
struct MeshCheckReport {
  std::size_t input_vertices = 0;
  std::size_t input_faces = 0;
  std::size_t welded_vertices = 0;        ///< vertices merged into an equal one
  std::size_t unreferenced_vertices = 0;  ///< vertices of no face, dropped
  std::size_t degenerate_faces = 0;       ///< faces with two equal corners after welding, dropped
  std::size_t sliver_faces = 0;  ///< faces of no area with three corners: kept, else a hole opens
  std::size_t duplicate_faces = 0;     ///< faces on the same three vertices, dropped
  std::size_t reoriented_faces = 0;    ///< faces kept that were turned round to face outward
  std::size_t split_vertices = 0;      ///< vertices added where the surface touched itself in one
  std::size_t components = 0;          ///< parts connected through edges, after welding
  std::size_t dropped_faces = 0;       ///< faces of the components not kept
  double dropped_volume_share = 0.0;   ///< their absolute volume / total absolute volume
  std::size_t vertices = 0;            ///< of the mesh kept
  std::size_t faces = 0;               ///< of the mesh kept
  int genus = 0;                       ///< of the mesh kept
  double volume = 0.0;                 ///< length^3, > 0
  double area = 0.0;                   ///< length^2
  Vector3 centroid = Vector3::Zero();  ///< of the volume, in the input's coordinates
  double equivalent_radius = 0.0;      ///< (3 V / 4 pi)^(1/3), length
};

/// A closed, oriented, connected 2-manifold and how it was obtained.
struct CheckedMesh {
  IndexedMesh mesh;  ///< in the input's coordinates, vertices and faces in the input's order
  MeshCheckReport report;
};

/// Welds equal points, drops degenerate and duplicate faces, orients outward, keeps the component
/// of largest volume. Where fans of faces touch in one vertex only, each gets a vertex of its own.
/// Of faces on the same three vertices one is kept when the faces around need it to close (doubled
/// faces), none when they close without it (a flap folded flat). Only the component kept has to be
/// closed: an open crumb beside a grain is dropped with the rest.
///
/// Throws Error(InvalidInput) with what to do about it when the mesh is empty, has coordinates that
/// are not finite, indices out of range, boundary or non-manifold edges, is not orientable,
/// encloses no volume, or falls into parts of comparable volume, and when the option is out of
/// range.
CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution);

}  // namespace wscvt
