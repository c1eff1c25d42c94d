// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace wscvt {

/// Throws the error for a file that could not be opened for reading, from the system's errno:
/// Error(InputOutput) if the file is missing or not readable, MachineRefused if its folder is
/// missing or the machine is at fault.
[[noreturn]] void refuse_to_open(const std::string& path, int error_number);

/// Throws Error(InputOutput) for a folder or a device, such as /dev/zero, which has no end. Does
/// nothing for a file, a pipe, or a name without a file.
void refuse_device(const std::string& path);

/// Throws MachineRefused for a file that was opened but could not be read to its end.
[[noreturn]] void refuse_to_read(const std::string& path);

}  // namespace wscvt
