// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/error.h"

namespace wscvt::filter {

/// Returns a sentence in the words of MeshLab's window. An option becomes the label of its
/// parameter, with its value as the dialog shows it, or "wscvt --handles" if only the program has
/// it. A parameter of a script ("Parameter ReportFile") gets its label, "Parameter \"Report file\"
/// (ReportFile)".
std::string shown_words(const Sentence& sentence);

}  // namespace wscvt::filter
