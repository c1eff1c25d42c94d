// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
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

/// Half as wide and high: each pixel the mean of four. Width and height must be even.
Picture halved(const Picture& picture);

/// The bytes of a PNG file. Throws Error(NumericalFailure) when they cannot be compressed.
std::string png_of(const Picture& picture);

/// An HTML img element that holds the picture itself.
std::string image_element(const Picture& picture, const std::string& description);

/// Red for 1, white for 0, blue for -1; values outside count as the ends.
Colour diverging_colour(double value);

}  // namespace wscvt
