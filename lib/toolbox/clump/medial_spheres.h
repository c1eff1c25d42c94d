// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "toolbox/clump/sphere.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A point of a surface and its unit outward normal.
struct SurfaceSample {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

/// Returns `count` samples evenly distributed by area, with the normals of their faces. Throws
/// Error as area_uniform_places does.
std::vector<SurfaceSample> surface_samples(const IndexedMesh& mesh, std::size_t count);

/// For every `step`-th sample, returns the largest sphere inside the surface that touches it there.
/// A sphere of radius `largest` is shrunk until no sample lies within it (Ma, Bae and Choi 2012,
/// "3D medial axis point approximation using nearest neighbors and the normal field", Vis. Comput.
/// 28, 7-19). The centres lie on the medial axis, also in thin and hollow bodies. Between samples
/// the surface may come nearer, depending on their spacing. Samples replace the surface because
/// exact distances are slowest at centres of spheres, which are equally far from all faces.
std::vector<Sphere> medial_spheres(const std::vector<SurfaceSample>& samples, std::size_t step,
                                   double largest, const Execution& execution);

}  // namespace wscvt
