// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Converts a grain's coordinates to its principal axes about the centroid, in equivalent radii.
struct UnitFrame {
  Vector3 centroid;
  Eigen::Matrix3d axes;  ///< columns: the principal axes
  double radius;

  explicit UnitFrame(const ShapeDescriptors& grain)
      : centroid(grain.centroid),
        axes(grain.principal_axes.toRotationMatrix()),
        radius(equivalent_radius(grain.volume)) {}

  Vector3 to_unit(const Vector3& p) const { return axes.transpose() * (p - centroid) / radius; }
  Vector3 to_scan(const Vector3& p) const { return centroid + radius * (axes * p); }
  IndexedMesh to_unit(IndexedMesh mesh) const {
    for (Vector3& p : mesh.points) p = to_unit(p);
    return mesh;
  }
};

}  // namespace wscvt
