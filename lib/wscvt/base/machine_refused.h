// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// Throws the error of a file that could not be opened for reading, by the number that the system
/// gave (errno). Error(InputOutput) where this file is not there or is not to be read;
/// MachineRefused where its folder is gone, or the machine is at fault.
[[noreturn]] void refuse_to_open(const std::string& path, int error_number);

/// Throws the MachineRefused of a file that could be opened and not be read to its end.
[[noreturn]] void refuse_to_read(const std::string& path);

}  // namespace wscvt
