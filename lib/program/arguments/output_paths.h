// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace wscvt::program {

/// A file that the program reads or writes.
struct NamedFile {
  std::string meaning;  ///< "the remesh"
  std::string path;     ///< empty: no file
};

/// Throws wscvt::Error before any work is done if an output cannot be written, if two outputs are
/// one file, if an output is an input, or if an output is a file of a batch or the table of another
/// command's folder.
void check_output_paths(const std::vector<NamedFile>& inputs,
                        const std::vector<NamedFile>& outputs);

/// A folder for many files, made together with its missing parent folders. At the end, folders that
/// were made here and are still empty are removed. A refused call therefore leaves nothing behind.
class MadeFolder {
 public:
  /// If the folder cannot be made, the first write into it reports this.
  explicit MadeFolder(const std::string& path);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

/// Returns the reports, each with the meaning "a report".
std::vector<NamedFile> named_reports(const std::vector<std::string>& reports);

}  // namespace wscvt::program
