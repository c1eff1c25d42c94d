// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/error_measure.h"

#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"

namespace wscvt {

double error_percent(ErrorMeasure measure, const ShapeDescriptors& remesh,
                     const ShapeDescriptors& scan, const std::optional<MeshDistances>& distances) {
  switch (measure) {
    case ErrorMeasure::Volume:
      return std::abs(relative_error_percent(remesh.volume, scan.volume));
    case ErrorMeasure::Area:
      return std::abs(relative_error_percent(remesh.area, scan.area));
    case ErrorMeasure::Sphericity:
      return std::abs(relative_error_percent(remesh.sphericity, scan.sphericity));
    case ErrorMeasure::Inertia:
      return inertia_error_percent(remesh, scan);
    case ErrorMeasure::Distance:
      break;
  }
  if (!distances) {
    throw Error(ErrorCode::InvalidInput,
                "The result has no distances. Request them in the options of the remesh.");
  }
  return 100.0 * distances->root_mean_square / equivalent_radius(scan.volume);
}

}  // namespace wscvt
