// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// The library's version, such as "1.0.0": what reports and programs say they were made by.
const char* version();

}  // namespace wscvt
