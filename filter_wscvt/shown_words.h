// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt::filter {

/// A sentence in the words of MeshLab's window: an option of the program ("--degree") becomes the
/// label of its parameter, or "wscvt --handles" if only the program has it; a parameter of a script
/// ("Parameter ReportFile") gets its label, "Parameter \"Report file\" (ReportFile)"; values of
/// options ("the method on-scan") become the choices of the dialog.
std::string shown_words(const std::string& sentence);

}  // namespace wscvt::filter
