// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt::program {

/// What the program returns, or 128 and the number of the signal that cancelled it. A caller in a
/// shell branches on it; the help and lib/README.md name the codes.
enum ExitCode {
  Done = 0,
  Failed = 1,          ///< the work could not be done: a sentence says why
  WrongArguments = 2,  ///< the call makes no sense: nothing was begun
  /// Of many grains: the work is done, but grains of it failed, or more than 5 % of the voxels of a
  /// volume's grains were left out.
  SomeFailed = 3
};

}  // namespace wscvt::program
