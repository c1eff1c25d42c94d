// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt::filter {

/// Returns a sentence in the words of MeshLab's window. An option of the program ("--degree")
/// becomes the label of its parameter, or "wscvt --handles" if only the program has it. A parameter
/// of a script ("Parameter ReportFile") gets its label, "Parameter \"Report file\" (ReportFile)".
/// Values of options ("the method on-scan") become the choices of the dialog.
std::string shown_words(const std::string& sentence);

}  // namespace wscvt::filter
