// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "wscvt/base/error.h"

namespace wscvt::program {

/// Wrong arguments, found before the work: the program ends with WrongArguments.
class WrongCall : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the result of `check`, which checks arguments before the work. Throws WrongCall instead
/// of Error(InvalidInput). Errors of files that cannot be read or written pass unchanged.
template <class Check>
auto checked(const Check& check) {
  try {
    return check();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InvalidInput) throw;
    throw WrongCall(error.what());
  }
}

}  // namespace wscvt::program
