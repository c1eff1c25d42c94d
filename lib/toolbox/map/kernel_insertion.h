// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// The position of an inserted vertex.
struct Insertion {
  Vector3 direction = Vector3::UnitZ();
  bool clipped = false;  ///< the kernel's centroid was used, because the mean of the ring failed
};

/// Finds a point of the ring's kernel: a position on the sphere for a vertex with neighbours at
/// `ring` (unit vectors, counter-clockwise) such that all its triangles are counter-clockwise by
/// exact predicates. `distances` are the distances to the neighbours on the surface.
///
/// The edges from ring[apex] to the others must triangulate the ring counter-clockwise, as after a
/// collapse. Then the kernel contains points close to ring[apex]. Tries first the mean of the ring,
/// weighted by inverse distance, then the centroid of the kernel clipped from the gnomonic plane
/// about ring[apex], then points ever closer to ring[apex]. Returns nothing if the kernel is too
/// thin for doubles.
std::optional<Insertion> insert_into_kernel(const std::vector<Vector3>& ring,
                                            const std::vector<double>& distances, std::size_t apex);

}  // namespace wscvt
