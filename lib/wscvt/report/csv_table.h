// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// Writes a header and a row, such as report_csv gives: to a new or empty file, or as one more row
/// of a table that has this header already. Whole or not at all; several processes may append to
/// one table. Pipes and devices get both. Throws Error: InvalidInput when the file holds another
/// header or ends within a row, and is then left as it was; InputOutput when it cannot be read or
/// written.
void append_to_table(const std::string& path, const std::string& header_and_row);

/// Throws what append_to_table would throw, as far as it can be told before there is a row, and
/// writes nothing. `header_and_row` may hold any row.
void check_table(const std::string& path, const std::string& header_and_row);

}  // namespace wscvt
