// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
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

/// A folder for many files, made together with the folders that it stands in. At the end those that
/// were made for it and are still empty are removed, so that a refused call leaves nothing behind.
class MadeFolder {
 public:
  /// If it cannot be made, writing into it tells.
  explicit MadeFolder(const std::string& path);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

/// "a report" for each of them.
std::vector<NamedFile> named_reports(const std::vector<std::string>& reports);

}  // namespace wscvt::program
