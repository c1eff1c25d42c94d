// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Surface orientation tensor of Orosz, Angelidakis and Bagi (2021), "Surface orientation tensor to
/// predict preferred contact orientation and characterise the form of individual particles", Powder
/// Technology, 312-325, doi 10.1016/j.powtec.2021.08.054: f = (1/A) sum A_k n_k (x) n_k over the
/// faces, A_k their areas and n_k their unit normals. No unit; trace 1; eigenvalues f1 >= f2 >= f3.
/// The three measures add up to 1.
struct OrientationTensor {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  Vector3 eigenvalues = Vector3::Zero();  ///< f1, f2, f3
  double compactness = 0.0;               ///< f3 / f1, 1 for a sphere or a cube
  double flakiness = 0.0;                 ///< (f1 - f2) / f1, towards 1 for a plate
  double rodness = 0.0;                   ///< (f2 - f3) / f1, towards 1 for a rod
};

/// Throws Error(InvalidInput) if the mesh has no area.
OrientationTensor orientation_tensor(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
