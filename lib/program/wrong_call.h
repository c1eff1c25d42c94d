// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "wscvt/base/error.h"

namespace wscvt::program {

/// The arguments are wrong, and nothing was begun: the program ends with WrongArguments.
class WrongCall : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What `check` gives, which looks at arguments before anything is begun. Throws WrongCall in the
/// place of Error(InvalidInput); a file that cannot be read or written stays what it is.
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
