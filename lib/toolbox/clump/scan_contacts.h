// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/clump/first_contact.h"
#include "toolbox/clump/unit_frame.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// First contact of two copies of a scan, the reference for remeshes, over 992 random but fixed
/// pairs of poses.
class ScanContacts {
 public:
  /// The scan is closed and outward, in any unit; `shape` has its descriptors.
  ScanContacts(const IndexedMesh& scan, const ShapeDescriptors& shape, const Execution& execution);

  /// Returns the error of two copies of a remesh in the scan's coordinates. If scan and remesh are
  /// moved, turned or scaled together, the error stays the same, but for rounding.
  ContactError error_of(const IndexedMesh& remesh, const Execution& execution) const;

 private:
  UnitFrame frame_;
  double reach_ = 0.0;
  std::vector<double> distances_;
};

}  // namespace wscvt
