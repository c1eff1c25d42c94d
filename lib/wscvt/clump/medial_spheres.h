// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/clump/sphere.h"

namespace wscvt {

/// A point of a surface and the unit normal there, outward.
struct SurfaceSample {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

/// `count` samples spread evenly by area, with the normals of their faces (see
/// area_uniform_places). Throws the same.
std::vector<SurfaceSample> surface_samples(const IndexedMesh& mesh, std::size_t count);

/// For every `step`-th sample the largest sphere inside the surface that touches it there, found by
/// shrinking one of radius `largest` until no sample lies within it (Ma, Bae and Choi 2012, "3D
/// medial axis point approximation using nearest neighbors and the normal field", Vis. Comput. 28,
/// 7-19). The centres lie on the medial axis of thin and of hollow bodies too. Between samples the
/// surface may come as near as their spacing says. Samples stand for the surface because exact
/// distances take the longest at centres of spheres, which have all faces at one distance.
std::vector<Sphere> medial_spheres(const std::vector<SurfaceSample>& samples, std::size_t step,
                                   double largest, const Execution& execution);

}  // namespace wscvt
