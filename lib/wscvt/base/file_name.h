// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// The ending of a file's name in lower case, with its point: ".ply"; empty where there is none.
std::string ending_of(const std::string& path);

}  // namespace wscvt
