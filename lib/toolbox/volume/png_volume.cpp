// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef WSCVT_HAS_PACKERS
#include <png.h>
#endif

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <new>

#include "toolbox/volume/image_stack.h"
#include "toolbox/volume/volume_formats.h"
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
  refuse_volume(slices.folder,
                "cannot be read: this program was built without libpng. Install libpng-dev and "
                "build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
