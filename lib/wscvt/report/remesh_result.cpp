// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_result.h"

#include "wscvt/nodes/error_measure.h"

namespace wscvt {

double error_percent(const RemeshResult& result, ErrorMeasure measure) {
  return error_percent(measure, result.remesh, result.original, result.distances);
}

}  // namespace wscvt
