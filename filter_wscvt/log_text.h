// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
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

/// What fits into MeshLab's log panel on a screen of 1366 x 768, in characters.
constexpr std::size_t log_width = 55;

/// Rows of cells as lines of at most `log_width` characters: the first column flush left, broken
/// between words where it is too long; the others flush right. Cells that leave the first column
/// less than 16 characters stand below it, one a line.
std::vector<std::string> log_table(const std::vector<std::vector<std::string>>& rows);

/// The lines of a log: an empty one, because a host may have left progress text without a line end,
/// the lines, then the warnings: MeshLab scrolls to the end. A last line says how many there are if
/// they take more rows than a small panel shows. All are cut somewhat before the 4096 characters at
/// which hosts cut.
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
