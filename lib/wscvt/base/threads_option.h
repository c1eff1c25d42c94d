// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "wscvt/base/option.h"

namespace wscvt {

/// The threads of an Execution. They change no result, so reports do not hold them.
inline constexpr NumberOption<int> threads_option = {
    "threads", "number of threads", 0, std::numeric_limits<int>::max(), Ends::Both, "0 for all"};

}  // namespace wscvt
