// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "wscvt/base/error.h"

namespace wscvt {

/// Thrown when there is no file of the given name. The code is InputOutput.
class FileMissing : public Error {
 public:
  explicit FileMissing(Sentence sentence) : Error(ErrorCode::InputOutput, std::move(sentence)) {}
};

/// Thrown when the folder of a file is not there, for example because its disk is not mounted.
class FolderMissing : public MachineRefused {
 public:
  using MachineRefused::MachineRefused;
};

/// Throws the error for a file that could not be opened for reading, from the system's errno:
/// FileMissing, Error(InputOutput) if the file is not readable, FolderMissing, or MachineRefused if
/// the machine is at fault.
[[noreturn]] void refuse_to_open(const std::string& path, int error_number);

/// Throws MachineRefused for a file that was opened but could not be read to its end.
[[noreturn]] void refuse_to_read(const std::string& path);

}  // namespace wscvt
