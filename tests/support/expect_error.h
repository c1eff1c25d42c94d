// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "wscvt/base/error.h"

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
