// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"

namespace wscvt::test {

/// The sentence of the Error that `action` throws, which must have this code; empty when it throws
/// none.
template <class Action>
std::string refusal(ErrorCode code, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "";
}

/// Fails unless `action` throws an Error with this code.
template <class Action>
void expect_error(ErrorCode code, const Action& action) {
  EXPECT_NE(refusal(code, action), "") << "No error was thrown.";
}

}  // namespace wscvt::test

/// The same for one expression: EXPECT_ERROR(remesh(scan, options), InvalidInput).
#define EXPECT_ERROR(expression, code_name) \
  ::wscvt::test::expect_error(::wscvt::ErrorCode::code_name, [&] { static_cast<void>(expression); })

namespace wscvt::test {

/// Fails unless run(execution) reports at least so often under the name of a stage and, asked to
/// stop at the first and at the last of these reports, stops there with Error(Cancelled).
template <class Run>
void expect_to_be_stopped(const Run& run, const std::string& stage, int reports) {
  for (const int last : {1, reports}) {
    int count = 0;
    int later = 0;
    const Execution execution(1, [&](double /*fraction*/, const std::string& reported) {
      if (count >= last) ++later;
      if (reported == stage) ++count;
      return count < last;
    });
    EXPECT_ERROR(run(execution), Cancelled);
    EXPECT_EQ(count, last);
    EXPECT_EQ(later, 0);
  }
}

}  // namespace wscvt::test
