// SPDX-License-Identifier: GPL-3.0-or-later
// What remesh and create return: arrays, the report, files of both. It pickles.
#ifndef WSCVT_PYTHON_REMESH_OBJECT_H_
#define WSCVT_PYTHON_REMESH_OBJECT_H_

#include <pybind11/pybind11.h>

#include <string>

#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/report.h"

namespace wscvt::python {

/// The stub says what its members are for Python.
struct Remesh {
  RemeshResult result;
  ReportOrigin origin;
  /// Of a pickled one, whose result holds arrays and warnings only; else empty.
  std::string pickled_report = {};
  std::string pickled_log = {};
};

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_REMESH_OBJECT_H_
