// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "wscvt/base/error.h"

namespace wscvt::filter {

/// A line of a log.
struct LogLine {
  std::string text;
  bool warning = false;  ///< or a verdict that names one; red in a window
};

/// Returns the line of the log with a run's time.
std::string seconds_line(double seconds);

/// Width of MeshLab's log panel on a screen of 1366 x 768, in characters.
constexpr std::size_t log_width = 55;

/// Formats rows of cells as lines of at most `log_width` characters. The first column is flush left
/// and broken between words, the others are flush right. If they leave the first column less than
/// 16 characters, they are below it, one per line.
std::vector<std::string> log_table(const std::vector<std::vector<std::string>>& rows);

/// Returns a log: an empty line, because the host's progress text may lack a line end; the lines;
/// the warnings; then the verdict, if there is one. MeshLab scrolls to the end and adds rows of its
/// own, so that a small panel shows little more than the verdict. Lines are cut slightly before
/// the hosts' limit of 4096 characters.
std::vector<LogLine> as_log(const std::vector<std::string>& warnings,
                            const std::vector<std::string>& lines, const LogLine& verdict);

/// Returns a line for a host that shows its log as HTML. Columns keep their width, and special
/// characters are escaped.
std::string html_line(const std::string& line);

/// Whether the host has a window, which shows log and messages as HTML. Other hosts print them.
bool host_has_window();

/// Returns a line for the host. Warnings are marked up here for windows: MeshLab's own warnings
/// would put the word before all earlier lines.
std::string shown_line(const LogLine& line);

/// Returns an error message for the host.
std::string shown_sentence(const std::string& sentence);

/// Returns a sentence in the words of MeshLab's window. An option becomes the label of its
/// parameter, with its value as the dialog shows it, or "wscvt --shrink-wrap" if only the program
/// has it. A parameter of a script ("Parameter ReportFile") gets its label, "Parameter \"Report
/// file\" (ReportFile)".
std::string shown_words(const Sentence& sentence);

}  // namespace wscvt::filter
