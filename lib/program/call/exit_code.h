// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

#include "wscvt/base/error.h"

namespace wscvt::program {

/// Exit codes of the program. A signal that cancels it gives 128 + its number. Shell scripts use
/// the codes; the help and lib/doc/program.md list them.
enum ExitCode {
  Done = 0,
  Failed = 1,          ///< the work could not be done; a message says why
  WrongArguments = 2,  ///< the call is wrong; no work was begun
  /// The work on many grains is done, but some grains failed, or more than 5 % of the voxels of a
  /// volume's grains were left out.
  SomeFailed = 3
};

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
