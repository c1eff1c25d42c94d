// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace wscvt {

/// Writes a file whole or not at all: beside the target, under a name that was free, then renamed
/// onto it, with the mode and owner of the file that was there; through symbolic links onto the
/// file they lead to, there or not yet. A file with several names (hard links) is written in place,
/// so that they go on naming one file. Pipes, devices and /dev/stdout are written to, never
/// replaced.
///
/// `write` puts the content into a binary stream in the classic locale and returns whether that
/// went well. Throws MachineRefused when the file cannot be written, and whatever `write`
/// throws; an existing file is then as it was, and nothing is left beside it.
void write_file(const std::string& path, const std::function<bool(std::ostream&)>& write);

/// The same for content that is there already.
void write_file(const std::string& path, const std::string& content);

/// Removes what a write_file of this path has left beside it that was killed. For files in a folder
/// of one's own: it may be in use by another process.
void remove_partial_file(const std::string& path);

/// Throws the MachineRefused that write_file would end with, as far as it can be told before
/// there is a content, and writes nothing.
void check_writable(const std::string& path);

/// Whether writing one path would write what the other names: one file by links of either kind, or
/// one that is not there yet. Two empty paths do not, nor do pipes and devices.
bool same_file(const std::string& a, const std::string& b);

}  // namespace wscvt
