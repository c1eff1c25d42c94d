// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/error.h"

namespace wscvt {

/// Throws Error(InputOutput) for a file that is no such volume: "path" + what, and what to do.
[[noreturn]] void refuse_volume(const std::string& path, const Sentence& what);

}  // namespace wscvt
