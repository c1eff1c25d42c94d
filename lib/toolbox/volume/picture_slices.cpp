// SPDX-License-Identifier: GPL-3.0-or-later
// Slices as PNG files, and as BMP files, which SkyScan's reconstructions have: Microsoft's
// BITMAPINFOHEADER, uncompressed.
#ifdef WSCVT_HAS_PACKERS
#include <png.h>
#endif

#include <boost/endian/conversion.hpp>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_bytes.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

#ifdef WSCVT_HAS_PACKERS

namespace {

/// An open PNG. libpng reports errors by longjmp, which must not skip destructors. So the functions
/// that call libpng have no objects with destructors.
class PngFile {
 public:
  explicit PngFile(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "rb")) {
    if (file_ == nullptr) refuse_volume(path, "cannot be opened. Check that the file is readable.");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, note_error, pass_over);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      close();
      throw std::bad_alloc();
    }
    if (!read_header()) {
      const std::string said = said_;
      close();
      refuse_volume(path, "is not a PNG file (" + shown(said) + "). Export it again.");
    }
    form_.numbers = std::to_string(form_.channels) + " x " + std::to_string(bits_) + " bits";
  }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
  ~PngFile() { close(); }

  const SliceImage& form() const { return form_; }

  /// Throws Error(InputOutput) if the file is too short for the size that it gives.
  void check_size() const {
    const auto row_bits = static_cast<std::uint64_t>(form_.width) * form_.channels *
                          static_cast<std::uint64_t>(bits_);
    check_voxel_bytes((row_bits + 7) / 8 * static_cast<std::uint64_t>(form_.height),
                      file_size(path_), Packing::Deflate, path_);
  }

  /// Returns the rows. An interlaced image is complete only after its last pass, each of which
  /// reads over the rows of the pass before. Throws Error(InputOutput).
  std::vector<char> rows() {
    const auto height = static_cast<std::size_t>(form_.height);
    const std::size_t row_bytes =
        static_cast<std::size_t>(form_.width) * form_.channels * form_.bytes;
    std::vector<char> rows(row_bytes * height);
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::size_t y = 0; y < height; ++y) {
        if (try_row(rows.data() + y * row_bytes)) continue;
        refuse_volume(path_, "is cut short or damaged (" + shown(said_) + "). Export it again.");
      }
    }
    return rows;
  }

 private:
  static void note_error(png_structp png, png_const_charp text) {
    auto* const self = static_cast<PngFile*>(png_get_error_ptr(png));
    std::snprintf(self->said_, sizeof self->said_, "%s", text);
    png_longjmp(png, 1);
  }
  static void pass_over(png_structp, png_const_charp) {}

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, file_);
    png_set_user_limits(png_, 1000000, 1000000);
    png_read_info(png_, info_);
    form_.width = png_get_image_width(png_, info_);
    form_.height = png_get_image_height(png_, info_);
    bits_ = png_get_bit_depth(png_, info_);
    form_.bytes = bits_ == 16 ? 2 : 1;
    form_.channels = png_get_channels(png_, info_);
    png_set_packing(png_);  // numbers of less than 8 bits become bytes with equal values
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool try_row(char* row) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, reinterpret_cast<png_bytep>(row), nullptr);
    return true;
  }

  void close() {
    png_destroy_read_struct(&png_, &info_, nullptr);
    std::fclose(file_);
  }

  std::string path_;
  std::FILE* file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  SliceImage form_;
  int bits_ = 8;
  int passes_ = 1;
  char said_[128] = "";
};

SliceImage read_png(const std::string& path, bool with_content) {
  PngFile file(path);
  file.check_size();
  SliceImage image = file.form();
  if (with_content) image.content = file.rows();
  return image;
}

}  // namespace

std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice& choice) {
  return open_images(slices, choice, read_png);
}

#else

std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice&) {
  refuse_without(slices.folder, "libpng", "libpng-dev");
}

#endif

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
