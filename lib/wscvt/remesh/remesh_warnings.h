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

/// Rms and largest distance / equivalent radius, and relative difference of the area, above which a
/// remesh is not accurate. On 41 ordinary grains the largest is up to 4.4 % at 1000 nodes.
inline constexpr double distance_warning_limit = 0.01;
inline constexpr double largest_warning_limit = 0.05;
inline constexpr double area_warning_limit = 0.02;

/// Relative difference of the area above which a remesh as published is another body, such as a
/// ball for a plate. The very first warning says so.
inline constexpr double other_body_limit = 0.2;

/// Volume error above which a contact fit is not accurate; its other limits are twice those above.
/// Its nodes go off the scan by the sagitta of an edge: ordinary grains of 100 nodes become 9 to
/// 10 % larger, sand_7228 of 200 nodes 6 %, a plate of 30:1 with 150 nodes 89 %.
inline constexpr double contact_volume_limit = 0.06;

/// Returns whether the remesh exceeds any limit. That of a scan in voxel steps never does, because
/// it should differ from the scan.
bool is_inaccurate(const RemeshResult& result);

/// Appends a sentence each about the scan's omitted bodies, inner surfaces and repaired area.
/// `done` says what was done with the remaining body, such as "remeshed".
void append_repair_warnings(const MeshCheckReport& input, const std::string& done,
                            std::vector<Sentence>& warnings);

/// Returns warnings for users of anything else than the remesh that is made of the scan: how the
/// scan was read and repaired, and its handles.
std::vector<Sentence> scan_warnings(const RemeshResult& result);

/// Returns the warnings of a result, the scan's faults first. The very first is `of_precision`, if
/// it is not empty (see precision_warning).
std::vector<Sentence> remesh_warnings(const RemeshResult& result, const std::string& of_precision);

}  // namespace wscvt
