// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/report/remesh_options.h"

namespace wscvt::program {

/// Everything a call of the program says.
struct Arguments {
  std::string input;
  std::string output;
  std::string json;                  ///< empty: none
  std::vector<std::string> reports;  ///< the ending says what each becomes
  std::string coefficients;          ///< empty: none
  int threads = 0;                   ///< 0: all
  bool overwrite = false;            ///< an output may replace the scan
  bool quiet = false;
  RemeshOptions options;
};

/// What the program returns, or 128 and the number of the signal that cancelled it. A caller in a
/// shell branches on it; the help names the codes.
enum ExitCode {
  Done = 0,
  Failed = 1,         ///< the work could not be done: a sentence says why
  WrongArguments = 2  ///< the call makes no sense: nothing was begun
};

/// Reads the call. Help and version are printed; they, and arguments that make no sense, for which
/// a sentence goes to the standard error, leave `exit_code` with what the program is to return at
/// once; otherwise it is -1.
Arguments read_arguments(int argc, char** argv, int& exit_code);

}  // namespace wscvt::program
