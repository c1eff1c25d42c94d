// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/file_name.h"

#include <filesystem>

#include "wscvt/base/lower_case.h"

namespace wscvt {

std::string ending_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

}  // namespace wscvt
