// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/text.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using std::string_literals::operator""s;

TEST(FileName, EndingsAreInLowerCaseWithTheirPoint) {
  EXPECT_EQ(ending_of("scan.ply"), ".ply");
  EXPECT_EQ(ending_of("/data/Scan.AZ.PLY"), ".ply");
  EXPECT_EQ(ending_of("sample.tar/grain.Stl2"), ".stl2");
  // Letters beyond ASCII are left as they are, whatever the locale.
  EXPECT_EQ(ending_of("scan.\xC3\x84Z"), ".\xC3\x84z");
}

TEST(FileName, WithoutAnEndingThereIsNone) {
  for (const char* path : {"", "scan", "sample.d/scan", ".hidden", "."}) {
    EXPECT_EQ(ending_of(path), "") << path;
  }
}

int sign(int value) { return (value > 0) - (value < 0); }

TEST(NumberedNames, NumbersAscendByTheirValues) {
  // The order of the manual of strverscmp, and slices.
  const std::string ascending[] = {"000", "00", "01", "010", "09", "0", "1", "9", "10"};
  for (const std::string& a : ascending) {
    for (const std::string& b : ascending) {
      EXPECT_EQ(sign(compare_numbered(a, b)), (&a > &b) - (&a < &b)) << a << " and " << b;
    }
  }
  EXPECT_LT(compare_numbered("slice9.tif", "slice10.tif"), 0);
  EXPECT_LT(compare_numbered("a2b10", "a10b2"), 0);
}

#ifdef __GLIBC__
TEST(NumberedNames, RandomNamesCompareAsGnuDoes) {
  const unsigned seed = 51;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 engine(seed);
  // Few letters, so that beginnings are often equal; one is above 127.
  const std::string letters = "0019.a\xc3";
  const auto name = [&] {
    std::string text(engine() % 8, ' ');
    for (char& letter : text) letter = letters[engine() % letters.size()];
    return text;
  };
  for (int k = 0; k < 200000; ++k) {
    const std::string a = name();
    const std::string b = name();
    ASSERT_EQ(sign(compare_numbered(a, b)), sign(::strverscmp(a.c_str(), b.c_str())))
        << a << " and " << b;
  }
}
#endif

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
  for (const std::string text : {"=1+1.ply", "+1+1", "-1+1", "@sum(a1)", "-a.ply", "\t=1", "'=1"}) {
    EXPECT_EQ(csv_field(text), "'" + text);
    EXPECT_EQ(text_of_field("'" + text), text);
  }
  for (const std::string text :
       {"a=1.ply", "-1.5", "-1e-05", "-", "=", "", "0", "1-2", "'", "'a", "''"}) {
    EXPECT_EQ(csv_field(text), text);
    EXPECT_EQ(text_of_field(text), text);
  }
  EXPECT_EQ(csv_record({"=a,\xFF", "-2", "x\0"s}), "\"'=a,\\xFF\",-2,x\\x00\r\n");
}

}  // namespace
}  // namespace wscvt
