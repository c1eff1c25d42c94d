// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/machine_refused.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Whether the error concerns the file itself, not the machine.
bool is_of_the_file(int error_number) {
  switch (error_number) {
    case 0:  // unknown: a stream failed without a system call
    case EACCES:
    case EISDIR:
    case ELOOP:
    case ENAMETOOLONG:
    case ENOENT:
    case ENOTDIR:
    case ENXIO:
    case EPERM:
      return true;
    default:
      return false;
  }
}

}  // namespace

void refuse_to_open(const std::string& path, int error_number) {
  const std::string file = "\"" + path + "\" ";
  if (!is_of_the_file(error_number)) {
    throw MachineRefused(file +
                         "could not be opened: " + std::generic_category().message(error_number) +
                         ". Check the disk and the machine's limits (ulimit -a).");
  }
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (error_number == ENOENT && !folder.empty() && !fs::exists(folder, error)) {
    throw FolderMissing(file + "cannot be opened: the folder \"" + folder.string() +
                        "\" is not there. Check its name and that its disk is mounted.");
  }
  const std::string sentence =
      file + "cannot be opened. Check that the file exists and is readable.";
  if (error_number == ENOENT) throw FileMissing(sentence);
  throw Error(ErrorCode::InputOutput, sentence);
}

void refuse_to_read(const std::string& path) {
  throw MachineRefused("\"" + path + "\" could not be read to its end. Check the disk.");
}

}  // namespace wscvt
