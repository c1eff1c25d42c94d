// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace wscvt {

/// Writes a file whole or not at all: beside the target, under a name that was free, then renamed
/// onto it; through a symbolic link onto the file it points to. `write` puts the
/// content into a binary stream in the classic locale and returns whether that went well. Throws
/// Error(InputOutput) when the file cannot be written, and whatever `write` throws; an existing
/// file is then as it was, and nothing is left beside it.
void write_file(const std::string& path, const std::function<bool(std::ostream&)>& write);

/// The same for content that is there already.
void write_file(const std::string& path, const std::string& content);

/// Whether two paths name one file, there or not yet: by its canonical path. Two empty ones do not.
bool same_file(const std::string& a, const std::string& b);

}  // namespace wscvt
