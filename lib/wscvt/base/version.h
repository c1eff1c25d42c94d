// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// Returns the library's version, such as "1.0.0", for reports and programs.
const char* version();

}  // namespace wscvt
