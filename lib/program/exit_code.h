// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

}  // namespace wscvt::program
