// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/text_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "support/file_folder.h"

namespace wscvt {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(TextFormat, ValueAboveALimitDiffersFromIt) {
  EXPECT_EQ(format_above(5.0, 28.8243), "28.8");
  EXPECT_EQ(format_above(28.8, 28.8243), "28.82");
  EXPECT_EQ(format_above(28.81, 28.8243), "28.82");
  EXPECT_EQ(format_above(28.824, 28.8243), "28.8243");
}

TEST(TextFormat, Numbers) {
  EXPECT_EQ(format_number(1234.5678), "1234.57");
  EXPECT_EQ(format_number(1234.5678, 3), "1.23e+03");
  EXPECT_EQ(format_number(0.0), "0");
  EXPECT_EQ(format_number(not_a_number), "-");
}

TEST(TextFormat, Errors) {
  EXPECT_EQ(format_error(0.66), "+0.660");
  EXPECT_EQ(format_error(-12.34567), "-12.346");
  EXPECT_EQ(format_error(0.0), "exact");
  EXPECT_EQ(format_error(-9.5e-10), "exact");
  EXPECT_EQ(format_error(-1.2e-9), "-1.2e-09");
  EXPECT_EQ(format_error(0.001), "+0.001");
  EXPECT_EQ(format_error(-0.000999), "-1.0e-03");
  EXPECT_EQ(format_error(not_a_number), "-");
  EXPECT_EQ(format_error(infinite), "-");
}

TEST(TextFormat, ExactNumbersReadBackToTheSameBits) {
  const std::uint64_t seed = 3;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> exponent(-200.0, 200.0);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::pow(10.0, exponent(engine)) * (i % 2 == 0 ? 1.0 : -1.0);
    EXPECT_EQ(std::stod(format_exact(value)), value);
  }
  EXPECT_EQ(format_exact(not_a_number), "");
  EXPECT_EQ(format_exact(-infinite), "");
}

TEST(TextFormat, TypedNumbersAreWrittenOutAndReadBack) {
  EXPECT_EQ(format_typed(1000000.0), "1000000");
  EXPECT_EQ(format_typed(0.001), "0.001");
  EXPECT_EQ(format_typed(2.0 / 3.0), "0.6666666666666666");
  EXPECT_EQ(format_typed(0.0), "0");
  EXPECT_EQ(format_typed(1e-6), "0.000001");
  EXPECT_EQ(format_typed(1e-7), "1e-07");
  EXPECT_EQ(format_typed(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
  EXPECT_EQ(format_typed(not_a_number), "nan");
  EXPECT_EQ(format_typed(-infinite), "-inf");
  // The longest there are without an exponent.
  for (const double value : {-1.2345678901234567e-6, -999999999999999.9}) {
    EXPECT_EQ(std::stod(format_typed(value)), value);
  }
}

TEST(TextFormat, DoesNotDependOnTheLocale) {
  const test::GermanNumbers german;
  std::ostringstream stream;
  stream << 1234.5;
  ASSERT_EQ(stream.str(), "1.234,5");  // else the rest proves nothing
  EXPECT_EQ(format_number(1234.5), "1234.5");
  EXPECT_EQ(format_error(1234.5), "+1234.500");
  EXPECT_EQ(format_exact(1234.5), "1234.5");
  EXPECT_EQ(format_typed(1234.5), "1234.5");
}

TEST(TextFormat, TablesLineUp) {
  const std::vector<std::string> lines =
      aligned_lines({{"name", "a", "long"}, {"x", "12345", "1"}, {"longer name"}});
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "name             a  long");
  EXPECT_EQ(lines[1], "x            12345     1");
  EXPECT_EQ(lines[2], "longer name");
  EXPECT_TRUE(aligned_lines({}).empty());
}

TEST(TextFormat, CsvQuotesWhatNeedsIt) {
  EXPECT_EQ(csv_record({"plain", "", "1.5"}), "plain,,1.5\r\n");
  EXPECT_EQ(csv_record({"a,b", "say \"so\"", "two\nlines"}),
            "\"a,b\",\"say \"\"so\"\"\",\"two\nlines\"\r\n");
  // Each of the signs alone, at either end and in the middle.
  for (const char sign : {',', '"', '\r', '\n'}) {
    const std::string doubled(sign == '"' ? 2 : 1, sign);
    for (const std::string before : {"", "a"}) {
      for (const std::string after : {"", "b"}) {
        // A cell that begins with a carriage return is kept from being a formula.
        const std::string guard = before.empty() && !after.empty() && sign == '\r' ? "'" : "";
        EXPECT_EQ(csv_record({before + sign + after, "c"}),
                  "\"" + guard + before + doubled + after + "\",c\r\n");
      }
    }
  }
}

}  // namespace
}  // namespace wscvt
