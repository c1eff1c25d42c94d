// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

// What refusals of scans with openings advise; tests follow it through MeshLab.

/// The filter of MeshLab that closes openings, by its menu and with its settings.
std::string closing_filter();

/// Where the envelope is to be had: its option of the program, and for MeshLab, whose filter has
/// none, closing_filter().
std::string where_envelopes_are();

}  // namespace wscvt
