// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// Writes a header and a row (see report_csv) to a new or empty file. If the file is a table with
/// this header, appends only the row. Pipes and devices always get both. Writes all or nothing.
/// Several processes may append to one table. Throws Error(InvalidInput) if the file has another
/// header or ends within a row, and leaves it unchanged. Throws Error(InputOutput) if it cannot be
/// read or written.
void append_to_table(const std::string& path, const std::string& header_and_row);

/// Checks the file and its header before the work, and throws the errors of append_to_table. Writes
/// nothing. `header_and_row` may contain any row.
void check_table(const std::string& path, const std::string& header_and_row);

}  // namespace wscvt
