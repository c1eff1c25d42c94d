// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/descriptors.h"

namespace wscvt {

MassProperties mass_properties(const ShapeDescriptors& descriptors) {
  const Eigen::Matrix3d turn = descriptors.principal_axes.toRotationMatrix();
  return {descriptors.volume, descriptors.centroid, descriptors.inertia_tensor,
          (turn.transpose() * descriptors.inertia_tensor * turn).diagonal(),
          descriptors.principal_axes};
}

}  // namespace wscvt
