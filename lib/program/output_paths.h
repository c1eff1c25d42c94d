// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace wscvt::program {

/// A file that the program is to read or write.
struct NamedFile {
  std::string meaning;  ///< "the remesh"
  std::string path;     ///< empty: not asked for
};

/// Throws wscvt::Error when an output cannot be written, when two outputs are one file, or when one
/// of them is an input and `overwrite` is not given; before any work is done.
void check_output_paths(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs,
                        bool overwrite);

/// "a report" for each of them.
std::vector<NamedFile> named_reports(const std::vector<std::string>& reports);

}  // namespace wscvt::program
