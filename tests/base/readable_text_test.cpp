// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/readable_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using std::string_literals::operator""s;

TEST(ReadableText, LeavesUtf8AsItIs) {
  // The first and the last character of one, two, three and four bytes, and about UTF-16's halves.
  for (const char* text : {"", "grain 5.ply", " ~", "\xC2\xA0", "\xDF\xBF", "\xE0\xA0\x80",
                           "\xED\x9F\xBF", "\xEE\x80\x80", "\xEF\xBF\xBF", "\xF0\x90\x80\x80",
                           "\xF4\x8F\xBF\xBF", "K\xC3\xB6rner.ply"}) {
    EXPECT_EQ(readable(text, ""), text);
  }
}

TEST(ReadableText, NamesEveryByteThatIsNone) {
  EXPECT_EQ(readable("a\xFFz.ply"), "a\\xFFz.ply");
  EXPECT_EQ(readable("K\xF6rner"), "K\\xF6rner");
  EXPECT_EQ(readable("cut \xE2\x82"), "cut \\xE2\\x82");
  EXPECT_EQ(readable("\xC3\xC3\xB6"), "\\xC3\xC3\xB6");
  // Longer than they need be, halves of UTF-16, beyond the last character, no first byte.
  for (const std::string bytes :
       {"\xC0\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xED\xBF\xBF", "\xF0\x8F\xBF\xBF",
        "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\x80", "\xBF"}) {
    EXPECT_EQ(readable(bytes).size(), 4 * bytes.size()) << readable(bytes);
  }
}

TEST(ReadableText, NamesControlCharacters) {
  EXPECT_EQ(readable("a\0b\x1B[31m\x7F"s), "a\\x00b\\x1B[31m\\x7F");
  EXPECT_EQ(readable("\xC2\x80\xC2\x9B\xC2\x9F"), "\\xC2\\x80\\xC2\\x9B\\xC2\\x9F");
  EXPECT_EQ(readable("two\nlines\r\t"), "two\nlines\\x0D\\x09");
  EXPECT_EQ(readable("two\nlines", ""), "two\\x0Alines");
  EXPECT_EQ(readable("\t\r\n", "\t\r\n"), "\t\r\n");
}

TEST(ReadableText, AFieldIsNoFormula) {
  for (const std::string text : {"=1+1.ply", "+1+1", "-1+1", "@sum(a1)", "-a.ply", "\t=1"}) {
    EXPECT_EQ(csv_field(text), "'" + text);
  }
  for (const std::string text : {"a=1.ply", "-1.5", "-1e-05", "-", "=", "", "0", "'=1", "1-2"}) {
    EXPECT_EQ(csv_field(text), text);
  }
  EXPECT_EQ(csv_record({"=a,\xFF", "-2", "x\0"s}), "\"'=a,\\xFF\",-2,x\\x00\r\n");
}

}  // namespace
}  // namespace wscvt
