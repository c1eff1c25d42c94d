// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "toolbox/fabric/fabric.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// Returns an HTML page: the lines of fabric_lines, rose diagrams of the normals and of the branch
/// vectors in the three planes of the axes, the numbers of contacts of the grains, the tensors, the
/// areas before and after the correction.
std::string fabric_html(const Fabric& fabric, const ReportOrigin& origin);

}  // namespace wscvt
