// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Computes the tensor. Throws Error(InvalidInput) if the mesh has no area.
OrientationTensor orientation_tensor(const IndexedMesh& mesh, const Execution& execution);

}  // namespace wscvt
