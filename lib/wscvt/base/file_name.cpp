// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/file_name.h"

#include <filesystem>

namespace wscvt {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  // Not std::tolower, which asks the locale.
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

}  // namespace wscvt
