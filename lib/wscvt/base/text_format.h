// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace wscvt {

// Numbers and tables as text, independent of the locale.

/// Formats a number for people, with `significant` >= 1 digits; "-" for NaN.
std::string format_number(double value, int significant = 6);

/// Formats a coordinate of a body with 6 digits, and far from the origin with more: to a hundred
/// thousandth of the body's size.
std::string format_coordinate(double value, double size);

/// Returns the shortest decimal text that reads back as the same number, as a person types it:
/// 1000000, not 1e+06; 0.001, not 1e-03. Uses an exponent below 1e-6 and from 1e15 on. Returns
/// "nan" or "inf" for such values.
std::string format_typed(double value);

/// Formats a fraction for people, in per cent with three digits: 0.05 is "5 %".
std::string format_percent(double fraction);

/// Formats a value above a limit for people, with three digits, or as many as tell it from the
/// limit.
std::string format_above(double limit, double value);

/// Formats an error in per cent for people, with its sign and three decimals, and in exponent form
/// below 0.001. Returns "exact" below 1e-9, which is rounding, and "-" if it is not finite.
std::string format_error(double percent);

/// Returns such an error with its unit: "-0.323 %", "exact" or "-".
std::string error_text(double percent);

/// Formats a number for programs: the shortest text that reads back to the same bits. Empty if it
/// is not finite.
std::string format_exact(double value);

/// Returns "1 face", "2 faces". `many`: if it is not `one` with an s, such as "bodies".
std::string format_count(std::size_t count, const std::string& one, const std::string& many = "");

/// Returns rows of cells as lines: the first column is flush left, the others flush right, two
/// spaces apart.
std::vector<std::string> aligned_lines(const std::vector<std::vector<std::string>>& rows);

/// Returns one CSV record after RFC 4180, with its CR LF. Quotes fields with a comma, a quote or a
/// line break, and doubles their quotes.
std::string csv_record(const std::vector<std::string>& fields);

}  // namespace wscvt
