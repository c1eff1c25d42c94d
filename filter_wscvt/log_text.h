// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt::filter {

/// A line of a log.
struct LogLine {
  std::string text;
  bool warning = false;
};

/// How long a run took, as a line of a log.
std::string seconds_line(double seconds);

/// The lines of a log: an empty one, because a host may have left progress text without a line end,
/// the lines, then the warnings: MeshLab scrolls to the end. All are cut somewhat before the 4096
/// characters at which hosts cut.
std::vector<LogLine> as_log(const std::vector<std::string>& warnings,
                            const std::vector<std::string>& lines);

/// A line for a host that shows its log as HTML: columns keep their width, signs stay signs.
std::string html_line(const std::string& line);

/// Whether the host is a program with a window, which shows log and messages as HTML; others print
/// them.
bool host_has_window();

/// A line as the host shows it. In a window a warning is marked up here: given to the host as one,
/// it would put the word in front of everything logged before.
std::string shown_line(const LogLine& line);

/// The message of a failure as the host shows it.
std::string shown_sentence(const std::string& sentence);

}  // namespace wscvt::filter
