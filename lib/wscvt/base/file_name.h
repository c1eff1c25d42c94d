// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// Returns the extension of a file name in lower case, with the point: ".ply". Empty if there is no
/// extension.
std::string ending_of(const std::string& path);

}  // namespace wscvt
