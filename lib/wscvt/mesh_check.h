// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/execution.h"
#include "wscvt/mesh.h"

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
  std::size_t degenerate_faces = 0;       ///< faces of (exactly) no area, dropped
  std::size_t duplicate_faces = 0;        ///< faces on the same three vertices, dropped
  std::size_t reoriented_faces = 0;       ///< faces turned round to face outward
  std::size_t components = 0;             ///< connected components after welding
  std::size_t dropped_faces = 0;          ///< faces of the components not kept
  double dropped_volume_share = 0.0;      ///< their absolute volume / total absolute volume
  std::size_t vertices = 0;               ///< of the mesh kept
  std::size_t faces = 0;                  ///< of the mesh kept
  int genus = 0;                          ///< of the mesh kept
  double volume = 0.0;                    ///< length^3, > 0
  double area = 0.0;                      ///< length^2
  Vector3 centroid = Vector3::Zero();     ///< of the volume, in the input's coordinates
  double equivalent_radius = 0.0;         ///< (3 V / 4 pi)^(1/3), length
};

/// A closed, oriented, connected mesh and how it was obtained.
struct CheckedMesh {
  IndexedMesh mesh;  ///< in the input's coordinates
  MeshCheckReport report;
};

/// Welds equal points, drops degenerate faces, orients outward, keeps the component of largest
/// volume. Throws Error(InvalidInput) with what to do about it when the mesh is empty, has
/// coordinates that are not finite, indices out of range, boundary or non-manifold edges, is not
/// orientable, encloses no volume, or falls into parts of comparable volume.
CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution);

/// Share of the sphere, seen from `centre`, that the closed mesh covers more than once: the solid
/// angle of its faces that look back at the centre, / 4 pi. 0 for a star-shaped mesh; at least 1
/// when `centre` lies outside.
double folded_solid_angle(const IndexedMesh& mesh, const Vector3& centre,
                          const Execution& execution);

}  // namespace wscvt
