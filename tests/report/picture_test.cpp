// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/picture.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>

namespace wscvt {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

TEST(Picture, PngReadsBackToItsPixels) {
  Picture picture{3, 2, {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
  const std::string file = png_of(picture);
  ASSERT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::string data;
  for (std::size_t at = 8; at < file.size();) {
    const std::uint32_t size = number_at(file, at);
    const std::string type = file.substr(at + 4, 4);
    const std::string checked = file.substr(at + 4, 4 + size);
    EXPECT_EQ(
        number_at(file, at + 8 + size),
        crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())))
        << type;
    if (type == "IHDR") {
      EXPECT_EQ(number_at(file, at + 8), 3U);
      EXPECT_EQ(number_at(file, at + 12), 2U);
    }
    if (type == "IDAT") data = file.substr(at + 8, size);
    at += 12 + size;
  }
  std::string rows(2 * (1 + 3 * 3), '\0');
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                       reinterpret_cast<const Bytef*>(data.data()), data.size()),
            Z_OK);
  ASSERT_EQ(size, rows.size());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(static_cast<std::uint8_t>(rows[i / 3 * 10 + 1 + i % 3 * 3 + c]),
                picture.pixels[i][c]);
    }
  }
  EXPECT_EQ(halved({2, 2, {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {12, 1, 1}}}).pixels[0],
            (Colour{6, 0, 0}));
}

}  // namespace
}  // namespace wscvt
