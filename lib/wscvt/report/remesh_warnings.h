// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/report/remesh_result.h"

namespace wscvt {

/// Share of the sphere covered more than once above which the result carries a warning.
inline constexpr double fold_warning_limit = 0.01;

/// Residual of the fit / equivalent radius above which the result carries a warning.
inline constexpr double residual_warning_limit = 0.05;

/// Misfit / equivalent radius, and the share of area lost or won, above which the same.
inline constexpr double misfit_warning_limit = 0.01;
inline constexpr double area_warning_limit = 0.02;

/// Whether the remesh is farther from the scan than either limit.
bool misses_the_scan(const RemeshResult& result);

/// What the user of a result ought to know, a sentence each, the scan's faults first. The first of
/// all is `of_precision`, if it is not empty (see precision_warning). `asked` are the options
/// given, from which those of the result may differ.
std::vector<std::string> remesh_warnings(const RemeshResult& result, const RemeshOptions& asked,
                                         const std::string& of_precision = "");

}  // namespace wscvt
