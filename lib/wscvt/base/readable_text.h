// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace wscvt {

// Names and sentences from elsewhere, such as a file's name, as terminals, tables and pages take
// them.

/// The text as UTF-8 that a terminal, a table and a page take: each byte of a control character,
/// but for those in `kept`, and each that is no UTF-8 as \xNN, with two hexadecimal digits.
std::string readable(std::string_view text, std::string_view kept = "\n");

/// `readable` but for tabs and line breaks, with the signs written out that HTML, SVG and XML read
/// as their own; also between the double quotes of an attribute.
std::string html_escaped(std::string_view text);

/// A field as it stands in a table: `readable` but for tabs and line breaks, and with a ' before
/// it where a spreadsheet would take a text for a formula (=, +, -, @ and more behind it).
std::string csv_field(std::string_view text);

}  // namespace wscvt
