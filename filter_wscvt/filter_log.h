// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "parameters.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

/// The log of a run: the library's report, what the vertex quality holds, seed and seconds. The
/// first line is empty, because a host may have left progress text without a line end; every line
/// is shorter than the 4096 characters at which hosts cut.
std::vector<std::string> log_lines(const RemeshResult& result, const FilterSettings& settings,
                                   double seconds);

/// A line for a host that shows its log as HTML: columns keep their width, signs stay signs.
std::string html_line(const std::string& line);

}  // namespace wscvt::filter
