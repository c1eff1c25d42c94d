// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "figures/study/table.h"
#include "wscvt/base/execution.h"

namespace wscvt::study {

/// Each detailed descriptor on bodies whose value is known by formula (sphere, ellipsoid, box, and
/// a unit sphere with waves of one harmonic), measured on meshes of them turned at random.
struct ClosedFormErrors {
  Table all;  ///< one row a body and descriptor
  /// One row a descriptor: the largest error over the bodies, in % of the value, and where the
  /// value is 0 the largest measured (lengths in units of the sphere's radius).
  Table worst;
};
ClosedFormErrors closed_form_errors(const Execution& execution);

}  // namespace wscvt::study
