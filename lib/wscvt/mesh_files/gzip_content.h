// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "wscvt/base/execution.h"

namespace wscvt {

/// Whether a file begins as a gzip file.
bool is_gzip(const std::string& path);

/// Returns the unpacked content of a gzip file. Throws Error(InputOutput) if it cannot be read, is
/// cut or damaged; Error(Cancelled).
std::string gzip_content(const std::string& path, const Execution& execution);

}  // namespace wscvt
