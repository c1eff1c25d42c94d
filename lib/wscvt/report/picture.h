// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace wscvt {

/// Red, green and blue, 0 to 255.
using Colour = std::array<std::uint8_t, 3>;

/// Rows of pixels from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Colour> pixels;  ///< width x height
};

/// Returns the picture at half its size: each pixel is the mean of four. Width and height must be
/// even.
Picture halved(const Picture& picture);

/// Returns a PNG file. Throws Error(NumericalFailure) if the compression fails.
std::string png_of(const Picture& picture);

/// Returns a PNG file as a data URL, for data within a document.
std::string data_url(const Picture& picture);

/// Returns an HTML img element that contains the picture.
std::string image_element(const Picture& picture, const std::string& description);

/// Returns red for 1, white for 0, blue for -1. Values outside are clamped.
Colour diverging_colour(double value);

/// Returns the colour of a part or sphere by its number, as view.js has it. Those of the next
/// numbers differ.
Colour part_colour(std::uint8_t part);

}  // namespace wscvt
