// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/scan_contacts.h"

#include <algorithm>

namespace wscvt {

namespace {

/// A remesh of few nodes extends farther than the scan.
constexpr double room = 1.2;

}  // namespace

ScanContacts::ScanContacts(const IndexedMesh& scan, const ShapeDescriptors& shape,
                           const Execution& execution)
    : frame_(shape) {
  const IndexedMesh unit = frame_.to_unit(scan);
  for (const Vector3& p : unit.points) reach_ = std::max(reach_, room * p.norm());
  distances_ = ContactHeights(unit, reach_, execution).distances(execution);
}

ContactError ScanContacts::error_of(const IndexedMesh& remesh, const Execution& execution) const {
  const ContactHeights heights(frame_.to_unit(remesh), reach_, execution);
  return contact_error(heights.distances(execution), distances_);
}

}  // namespace wscvt
