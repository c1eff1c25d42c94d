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
/// of them is the scan and `overwrite` is not given; before any work is done.
void check_output_paths(const NamedFile& scan, const std::vector<NamedFile>& outputs,
                        bool overwrite);

}  // namespace wscvt::program
