// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <locale>
#include <string>

namespace wscvt::test {

/// Writes numbers as in German, on machines without that locale too.
class CommaDecimals : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Makes German numbers the global locale as long as it lives, also when a test ends early.
class GermanNumbers {
 public:
  GermanNumbers() : before_(std::locale::global(std::locale(std::locale(), new CommaDecimals))) {}
  ~GermanNumbers() { std::locale::global(before_); }
  GermanNumbers(const GermanNumbers&) = delete;
  GermanNumbers& operator=(const GermanNumbers&) = delete;

 private:
  std::locale before_;
};

}  // namespace wscvt::test
