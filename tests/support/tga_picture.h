// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wscvt::test {

/// A TGA file of a picture whose rows stand from the top, each pixel as red, green and blue.
inline std::string tga_picture(int width, int height, const std::vector<std::uint8_t>& colours) {
  std::string bytes(18, '\0');
  bytes[2] = 2;  // colours, not packed
  bytes[12] = static_cast<char>(width % 256);
  bytes[13] = static_cast<char>(width / 256);
  bytes[14] = static_cast<char>(height % 256);
  bytes[15] = static_cast<char>(height / 256);
  bytes[16] = 24;
  bytes[17] = 0x20;  // from the top
  for (std::size_t i = 0; i + 2 < colours.size(); i += 3) {
    for (const std::size_t part : {i + 2, i + 1, i}) bytes += static_cast<char>(colours[part]);
  }
  return bytes;
}

}  // namespace wscvt::test
