// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace wscvt::test {

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

}  // namespace wscvt::test
