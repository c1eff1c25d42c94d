// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt::filter {

/// How long a run took, as a line of a log.
std::string seconds_line(double seconds);

/// Cuts what is longer than the 4096 characters at which hosts cut, somewhat before.
void cut_lines(std::vector<std::string>& lines);

/// A line for a host that shows its log as HTML: columns keep their width, signs stay signs.
std::string html_line(const std::string& line);

}  // namespace wscvt::filter
