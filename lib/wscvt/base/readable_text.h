// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace wscvt {

// Converts foreign text, such as a file name, for terminals, tables and HTML pages.

/// Returns the text as UTF-8 that is safe in a terminal, a table and a page. Bytes of control
/// characters, except those in `kept`, and bytes that are no UTF-8 become \xNN, with two
/// hexadecimal digits.
std::string readable(std::string_view text, std::string_view kept = "\n");

/// Applies `readable`, keeps tabs and line breaks, and escapes the markup characters of HTML, SVG
/// and XML. Also safe between the double quotes of an attribute.
std::string html_escaped(std::string_view text);

/// Returns a table field: `readable`, but tabs and line breaks stay. Puts a ' before a text that a
/// spreadsheet would read as a formula (=, +, - or @ and more after it).
std::string csv_field(std::string_view text);

}  // namespace wscvt
