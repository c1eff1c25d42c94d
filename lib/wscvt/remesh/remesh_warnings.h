// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// Overhang fraction above which a result of the method AsPublished carries a warning.
inline constexpr double overhang_warning_limit = 0.01;

/// Residual of the SH fit / equivalent radius above which the result carries a warning.
inline constexpr double residual_warning_limit = 0.05;

/// Rms distance / equivalent radius, and the fraction of area lost or won, above which a remesh is
/// not accurate.
inline constexpr double distance_warning_limit = 0.01;
inline constexpr double area_warning_limit = 0.02;

/// Whether the remesh is farther from the scan than either limit. What a contact fit is fitted to
/// is not the scan's shape, so it is never inaccurate; nor is the remesh of a scan in voxel steps,
/// from which it should differ.
bool is_inaccurate(const RemeshResult& result);

/// Adds a sentence about each of the scan's bodies that were left out, surfaces inside, and area
/// that repairs changed. `done` is what became of the body that is left, such as "remeshed".
void append_repair_warnings(const MeshCheckReport& input, const std::string& done,
                            std::vector<std::string>& warnings);

/// What the user of anything that is made of the scan ought to know, if it is not the remesh: how
/// the scan was taken and repaired, and its handles.
std::vector<std::string> scan_warnings(const RemeshResult& result);

/// What the user of a result ought to know, a sentence or more each, the scan's faults first. The
/// first of all is `of_precision`, if it is not empty (see precision_warning).
std::vector<std::string> remesh_warnings(const RemeshResult& result,
                                         const std::string& of_precision);

}  // namespace wscvt
