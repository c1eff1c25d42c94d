// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wscvt::test {

/// Bytes in base64 (RFC 4648).
inline std::string base64(const std::string& bytes) {
  const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t word = 0;
    const std::size_t held = std::min<std::size_t>(3, bytes.size() - k);
    for (std::size_t i = 0; i < 3; ++i) {
      word = word << 8 | (i < held ? static_cast<unsigned char>(bytes[k + i]) : 0U);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      text += i <= held ? letters[word >> (18 - 6 * i) & 63U] : '=';
    }
  }
  return text;
}

/// The bytes that a text in base64 stands for (RFC 4648).
inline std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0U);
  std::string bytes;
  for (std::size_t i = 0; i + 4 <= text.size(); i += 4) {
    std::uint32_t group = 0;
    std::size_t held = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t digit = digits.find(text[i + k]);
      held += digit == std::string::npos ? 0 : 1;
      group = group << 6U | static_cast<std::uint32_t>(digit == std::string::npos ? 0 : digit);
    }
    for (std::size_t k = 0; k + 1 < held; ++k) {
      bytes += static_cast<char>(group >> (16U - 8U * k) & 255U);
    }
  }
  return bytes;
}

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
