// SPDX-License-Identifier: GPL-3.0-or-later
// Slices as BMP files: SkyScan's reconstructions have them. Microsoft's BITMAPINFOHEADER,
// uncompressed.
#include <boost/endian/conversion.hpp>
#include <cstdlib>
#include <memory>
#include <utility>

#include "toolbox/volume/byte_source.h"
#include "toolbox/volume/image_stack.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"

namespace wscvt {

namespace {

SliceImage read_bmp(const std::string& path, bool with_content) {
  char head[54] = {};
  if (file_bytes(path, 0)->read(head, sizeof head) < sizeof head || head[0] != 'B' ||
      head[1] != 'M') {
    refuse_volume(path, "is not a BMP file. Export it again.");
  }
  const auto four = [&](std::size_t begin) {
    return boost::endian::load_little_s32(reinterpret_cast<unsigned char*>(head) + begin);
  };
  SliceImage image;
  image.width = four(18);
  image.height = std::abs(std::int64_t{four(22)});
  const bool is_from_above = four(22) < 0;
  constexpr std::int64_t most = 1000000;
  if (image.width < 1 || image.width > most || image.height == 0 || image.height > most) {
    refuse_volume(path, "is a BMP file without a size. Export it again.");
  }
  const std::size_t bits =
      boost::endian::load_little_u16(reinterpret_cast<unsigned char*>(head) + 28);
  if (four(30) != 0 || (bits != 8 && bits != 24 && bits != 32)) {
    refuse_volume(path, "is a BMP file of " + std::to_string(bits) +
                            " bits, or a packed one. Save the slices as TIFF or PNG.");
  }
  image.numbers = std::to_string(bits) + " bits";
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::size_t row_bytes = (width * bits + 31) / 32 * 4;  // rows end at multiples of four
  const auto offset = static_cast<std::uint32_t>(four(10));
  check_voxel_bytes(offset + std::uint64_t{row_bytes} * height, file_size(path), Packing::None,
                    path);
  if (!with_content) return image;
  std::vector<char> rows(row_bytes * height);
  if (file_bytes(path, offset)->read(rows.data(), rows.size()) < rows.size()) {
    refuse_volume(path, "was changed while it was read. Run the command again.");
  }
  image.content.reserve(width * height);
  const std::size_t step = bits / 8;
  for (std::size_t y = 0; y < height; ++y) {
    const char* const row = rows.data() + (is_from_above ? y : height - 1 - y) * row_bytes;
    for (std::size_t x = 0; x < width; ++x) {
      if (step > 1) check_colours_equal(row + x * step, 1, path);
      image.content.push_back(row[x * step]);
    }
  }
  return image;
}

}  // namespace

std::unique_ptr<LabelVolume> open_bmp_slices(const SliceFiles& slices, const VolumeChoice& choice) {
  return open_images(slices, choice, read_bmp);
}

}  // namespace wscvt
