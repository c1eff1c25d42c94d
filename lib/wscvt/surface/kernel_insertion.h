// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Where a vertex was put.
struct Insertion {
  Vector3 direction = Vector3::UnitZ();
  bool clipped = false;  ///< the mean of its ring was of no use, the kernel's centroid was taken
};

/// Finds a place on the sphere for a vertex whose neighbours are at `ring` (unit vectors,
/// counter-clockwise), such that all its triangles are counter-clockwise, by exact predicates: a
/// point of the kernel of the ring. `distances` are those to the neighbours on the surface.
///
/// Without the vertex the ring must be triangulated, counter-clockwise, by the edges from
/// ring[apex] to the others, as after a collapse: then the kernel holds points close to ring[apex].
/// First the mean of the ring, weighted by inverse distance, is tried, then the centroid of the
/// kernel clipped from the gnomonic plane about ring[apex], then points ever closer to ring[apex].
/// Nothing is returned when the kernel is too thin for doubles.
std::optional<Insertion> insert_into_kernel(const std::vector<Vector3>& ring,
                                            const std::vector<double>& distances, std::size_t apex);

}  // namespace wscvt
