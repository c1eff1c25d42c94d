// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace wscvt::test {

/// Whether a part stands in a text. A test that fails shows the text, of a long one the begin.
inline testing::AssertionResult holds(const std::string& text, const std::string& part) {
  const bool is_there = text.find(part) != std::string::npos;
  return (is_there ? testing::AssertionSuccess() : testing::AssertionFailure())
         << '"' << part << (is_there ? "\" is in: " : "\" is not in: ") << text.substr(0, 4000);
}

/// Whether a part stands in one of some texts or sentences.
template <class Texts>
testing::AssertionResult any_holds(const Texts& texts, const std::string& part) {
  std::string all;
  for (const std::string& text : texts) {
    if (holds(text, part)) return holds(text, part);
    all += "\n  " + text;
  }
  return holds(all, part);
}

}  // namespace wscvt::test
