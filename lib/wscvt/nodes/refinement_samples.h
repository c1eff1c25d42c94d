// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

/// Places in an array of samples.
using SampleList = std::vector<std::int32_t>;

/// Points spread evenly by area over the original, about 32 for each of `triangles`, but 50,000 at
/// least and no more than fit in memory. Those that lie behind the original's outermost sheet, seen
/// from the origin, are left out. Throws Error(NumericalFailure) when a ray meets no face.
std::vector<Vector3> visible_samples(const MeshSurface& original, std::size_t triangles,
                                     const Execution& execution);

/// The samples in each triangle, seen from the origin; every sample stands in exactly one list.
std::vector<SampleList> samples_of_triangles(const std::vector<Vector3>& positions,
                                             const SphereTriangulation& triangulation,
                                             const std::vector<Vector3>& samples,
                                             const Execution& execution);

}  // namespace wscvt
