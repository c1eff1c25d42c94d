// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// Compares names by the values of the numbers in them, as strverscmp of GNU does: 9 comes before
/// 10. Negative if `a` comes first, 0 if the names are equal. Names have no NUL.
int compare_numbered(const std::string& a, const std::string& b);

}  // namespace wscvt
