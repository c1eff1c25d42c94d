// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

// What refusals and warnings about scans with openings advise; tests follow it.

/// Where the envelope is to be had: its option of the program, and for MeshLab, whose filter has
/// none, a filter of its own by its menu and with its settings.
std::string where_envelopes_are();

/// A sentence for handles, or pores, that a remesh does not follow.
std::string envelope_of_flaws_advice();

/// A sentence for points that have no one radius in each direction.
std::string surface_of_points_advice();

}  // namespace wscvt
