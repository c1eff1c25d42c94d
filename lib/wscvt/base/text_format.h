// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt {

// Numbers and tables as text, the same in every locale.

/// A number for reading, with `significant` >= 1 digits; "-" for one that is not a number.
std::string format_number(double value, int significant = 6);

/// The shortest decimal text that reads back as the same number, written as a person types it:
/// 1000000 and not 1e+06, 0.001 and not 1e-03. Below 1e-6 and from 1e15 on with an exponent; "nan"
/// and "inf" for what is not a number and not finite.
std::string format_typed(double value);

/// A share for reading, in per cent with three digits: 0.05 is "5 %".
std::string format_percent(double share);

/// An error in per cent for reading, with its sign and three decimals, in exponent form below
/// 0.001; "exact" below 1e-9, which is rounding; "-" for one that is not finite.
std::string format_error(double percent);

/// A number for another program: the shortest text that reads back to the same bits; empty for one
/// that is not finite.
std::string format_exact(double value);

/// Rows of cells as lines: the first column flush left, the others flush right, two spaces apart.
std::vector<std::string> aligned_lines(const std::vector<std::vector<std::string>>& rows);

/// One record of a CSV file after RFC 4180, with its CR LF: fields that hold a comma, a quote or a
/// line break are quoted, quotes doubled.
std::string csv_record(const std::vector<std::string>& fields);

}  // namespace wscvt
