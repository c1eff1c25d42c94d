// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace wscvt {

/// Writes a file completely or not at all. Writes a new file with a free name beside the target and
/// renames it onto the target. Keeps the mode and owner of an existing file. Follows symbolic
/// links, also to a file that does not exist yet. Writes a file with several hard links in place,
/// so that all names keep one file. Writes to pipes, devices and /dev/stdout and never replaces
/// them.
///
/// `write` writes the content into a binary stream in the classic locale. Throws MachineRefused if
/// the file cannot be written or the stream is then not good, and the exceptions of `write`. An
/// existing file is then unchanged, and no partial file remains.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& write);

/// Writes `content` as the function above.
void write_file(const std::string& path, const std::string& content);

/// Removes the partial file that a killed write_file of this path has left. Only for files in a
/// private folder, because another process may be writing the partial file.
void remove_partial_file(const std::string& path);

/// Throws the MachineRefused that write_file would throw, as far as this is known before writing.
/// Writes nothing.
void check_writable(const std::string& path);

/// Whether both paths lead to one file, also by symbolic or hard links, or to one file that does
/// not exist yet. False for two empty paths, pipes and devices.
bool same_file(const std::string& a, const std::string& b);

}  // namespace wscvt
