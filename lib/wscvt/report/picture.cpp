// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/picture.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/report/html_document.h"

namespace wscvt {

namespace {

void append_number(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> shift));
  }
}

const Bytef* bytes_of(const std::string& text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

/// A chunk of a PNG file: length, type, data, check sum of the last two.
void append_chunk(std::string& file, const std::string& type, const std::string& data) {
  append_number(file, static_cast<std::uint32_t>(data.size()));
  const std::string checked = type + data;
  file += checked;
  append_number(file, static_cast<std::uint32_t>(
                          crc32(0, bytes_of(checked), static_cast<uInt>(checked.size()))));
}

std::string compressed(const std::string& data) {
  uLongf size = compressBound(static_cast<uLong>(data.size()));
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, bytes_of(data),
                static_cast<uLong>(data.size()), Z_BEST_COMPRESSION) != Z_OK) {
    throw Error(ErrorCode::NumericalFailure,
                "A picture could not be compressed. Use a .json or .csv report.");
  }
  result.resize(size);
  return result;
}

}  // namespace

Picture halved(const Picture& picture) {
  Picture result{picture.width / 2, picture.height / 2, {}};
  result.pixels.resize(static_cast<std::size_t>(result.width) * result.height);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const std::size_t first = static_cast<std::size_t>(2 * y) * picture.width + 2 * x;
      for (std::size_t c = 0; c < 3; ++c) {
        const int sum = picture.pixels[first][c] + picture.pixels[first + 1][c] +
                        picture.pixels[first + picture.width][c] +
                        picture.pixels[first + picture.width + 1][c];
        result.pixels[static_cast<std::size_t>(y) * result.width + x][c] =
            static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return result;
}

std::string png_of(const Picture& picture) {
  std::string header;
  append_number(header, static_cast<std::uint32_t>(picture.width));
  append_number(header, static_cast<std::uint32_t>(picture.height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits a channel, red green blue, plain
  std::string rows;
  for (int y = 0; y < picture.height; ++y) {
    rows += '\0';  // no filter: flat colours compress as well without
    for (int x = 0; x < picture.width; ++x) {
      for (const std::uint8_t channel :
           picture.pixels[static_cast<std::size_t>(y) * picture.width + x]) {
        rows += static_cast<char>(channel);
      }
    }
  }
  std::string file = "\x89PNG\r\n\x1a\n";
  append_chunk(file, "IHDR", header);
  append_chunk(file, "IDAT", compressed(rows));
  append_chunk(file, "IEND", "");
  return file;
}

std::string data_url(const Picture& picture) {
  return "data:image/png;base64," + base64(png_of(picture));
}

std::string image_element(const Picture& picture, const std::string& description) {
  return "<img width=\"" + std::to_string(picture.width) + "\" height=\"" +
         std::to_string(picture.height) + "\" alt=\"" + html_escaped(description) + "\" src=\"" +
         data_url(picture) + "\">";
}

Colour diverging_colour(double value) {
  constexpr Colour red = {190, 30, 45};
  constexpr Colour blue = {30, 80, 170};
  constexpr int white = 245;  // distinguishes the surface from the paper
  const double share = std::min(std::abs(value), 1.0);
  const Colour& end = value > 0.0 ? red : blue;
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = static_cast<std::uint8_t>(std::lround(white + share * (end[c] - white)));
  }
  return colour;
}

Colour part_colour(std::uint8_t part) {
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double wave = portable::cos(2.4 * part + 2.1 * static_cast<double>(c));
    colour[c] = static_cast<std::uint8_t>(std::lround(255.0 * (0.65 + 0.3 * wave)));
  }
  return colour;
}

}  // namespace wscvt
