// SPDX-License-Identifier: GPL-3.0-or-later
// The result of remesh and create: arrays, report, and functions that write files. It can be
// pickled.
#ifndef WSCVT_PYTHON_REMESH_OBJECT_H_
#define WSCVT_PYTHON_REMESH_OBJECT_H_

#include <pybind11/pybind11.h>

#include <string>

#include "wscvt/remesh/remesh_result.h"
#include "wscvt/report/report.h"

namespace wscvt::python {

/// The stub describes the members for Python.
struct Remesh {
  RemeshResult result;
  ReportOrigin origin;
  /// Report of a pickled object, whose result has only arrays and warnings; else empty.
  std::string pickled_report = {};
  std::string pickled_log = {};
};

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_REMESH_OBJECT_H_
