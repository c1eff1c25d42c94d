// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// Returns the text with the letters A to Z as a to z. Other bytes stay. Does not depend on the
/// locale.
std::string lower_case(std::string_view text);

/// Returns the extension of a file name in lower case, with the point: ".ply". Empty if there is no
/// extension.
std::string ending_of(const std::string& path);

/// Returns words with commas between them, and ", ..." behind `most` words.
std::string listed(const std::vector<std::string>& words, std::size_t most = 1000000);

/// Returns words as a list: "A", "A or B", "A, B or C" for " or ".
std::string enumerated(const std::vector<std::string>& words, const std::string& before_last);

/// Compares names by the values of the numbers in them, as strverscmp of GNU does: 9 comes before
/// 10. Negative if `a` comes first, 0 if the names are equal. Names have no NUL.
int compare_numbered(const std::string& a, const std::string& b);

// Converts foreign text, such as a file name, for terminals, tables and HTML pages.

/// Returns the text as UTF-8 that is safe in a terminal, a table and a page. Bytes of control
/// characters, except those in `kept`, and bytes that are no UTF-8 become `\xNN`, with two
/// hexadecimal digits.
std::string readable(std::string_view text, std::string_view kept = "\n");

/// Applies `readable`, keeps tabs and line breaks, and escapes the markup characters of HTML, SVG
/// and XML. Also safe between the double quotes of an attribute.
std::string html_escaped(std::string_view text);

/// Returns a table field: `readable`, but tabs and line breaks stay. Puts a ' before a text that a
/// spreadsheet would read as a formula (=, +, - or @ and more after it), and before such a text
/// that begins with ' already.
std::string csv_field(std::string_view text);

/// Returns the text of a field of csv_field, without the ' that csv_field has put before it.
std::string_view text_of_field(std::string_view field);

}  // namespace wscvt
