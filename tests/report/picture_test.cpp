// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/picture.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "support/coded_bytes.h"
#include "support/holds.h"

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

TEST(Picture, ElementOfAPageHoldsTheFileWhole) {
  // Files that end in groups of one, two and three bytes.
  std::set<std::size_t> remainders;
  for (int k = 0; k < 57; ++k) {
    Picture picture{1 + k / 3, 1 + k % 3, {}};
    for (int i = 0; i < picture.width * picture.height; ++i) {
      picture.pixels.push_back({static_cast<std::uint8_t>(37 * i * i % 251),
                                static_cast<std::uint8_t>(91 * i),
                                static_cast<std::uint8_t>(201 * i)});
    }
    const std::string element = image_element(picture, "a \"b\"");
    const std::string opening = "base64,";
    const std::size_t begin = element.find(opening) + opening.size();
    EXPECT_EQ(test::decoded(element.substr(begin, element.find('"', begin) - begin)),
              png_of(picture));
    EXPECT_TRUE(test::holds(element, "width=\"" + std::to_string(picture.width) + "\" height=\"" +
                                         std::to_string(picture.height) + "\""));
    EXPECT_TRUE(test::holds(element, "alt=\"a &quot;b&quot;\""));
    remainders.insert(png_of(picture).size() % 3);
  }
  EXPECT_EQ(remainders.size(), 3U);
}

TEST(Picture, HalvesByTheRoundedMeanOfFour) {
  // A picture that is neither square nor even in its values.
  Picture picture{6, 4, {}};
  for (int k = 0; k < 24; ++k) {
    picture.pixels.push_back({static_cast<std::uint8_t>(k * k % 251),
                              static_cast<std::uint8_t>(255 - 10 * k),
                              static_cast<std::uint8_t>(7 * k)});
  }
  const Picture half = halved(picture);
  ASSERT_EQ(half.width, 3);
  ASSERT_EQ(half.height, 2);
  for (std::size_t y = 0; y < 2; ++y) {
    for (std::size_t x = 0; x < 3; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
          sum += picture.pixels[(2 * y + k / 2) * 6 + 2 * x + k % 2][c];
        }
        EXPECT_EQ(half.pixels[3 * y + x][c], std::floor(sum / 4.0 + 0.5)) << x << y << c;
      }
    }
  }
}

TEST(Picture, ColoursGoFromBlueOverWhiteToRed) {
  const Colour white = diverging_colour(0.0);
  const Colour red = diverging_colour(1.0);
  const Colour blue = diverging_colour(-1.0);
  EXPECT_EQ(*std::min_element(white.begin(), white.end()),
            *std::max_element(white.begin(), white.end()));
  EXPECT_GT(red[0], 2 * red[2]);
  EXPECT_GT(blue[2], 2 * blue[0]);
  EXPECT_EQ(diverging_colour(7.0), red);
  EXPECT_EQ(diverging_colour(-7.0), blue);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(diverging_colour(0.5)[c], 0.5 * (white[c] + red[c]), 1.0);
    EXPECT_NEAR(diverging_colour(-0.25)[c], 0.75 * white[c] + 0.25 * blue[c], 1.0);
  }
}

}  // namespace
}  // namespace wscvt
