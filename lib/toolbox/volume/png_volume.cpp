// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef WSCVT_HAS_PACKERS
#include <png.h>
#endif

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <new>
#include <utility>

#include "toolbox/volume/image_stack.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

#ifdef WSCVT_HAS_PACKERS

namespace {

/// Size and type of an image.
struct PngImage {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bits = 8;
  int channels = 1;
  int passes = 1;

  bool operator==(const PngImage& other) const {
    return width == other.width && height == other.height && bits == other.bits &&
           channels == other.channels;
  }
  std::string text() const {
    return std::to_string(width) + " x " + std::to_string(height) + " voxels of " +
           std::to_string(channels) + " x " + std::to_string(bits) + " bits";
  }
};

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
  }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
  ~PngFile() { close(); }

  const PngImage& image() const { return image_; }

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.channels) *
           (image_.bits == 16 ? 2 : 1);
  }

  /// Reads a row over the content of `row`, as an interlaced file needs. Throws Error(InputOutput).
  void read_row(char* row) {
    if (!try_row(row)) {
      refuse_volume(path_, "is cut short or damaged (" + shown(said_) + "). Export it again.");
    }
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
    image_.width = png_get_image_width(png_, info_);
    image_.height = png_get_image_height(png_, info_);
    image_.bits = png_get_bit_depth(png_, info_);
    image_.channels = png_get_channels(png_, info_);
    png_set_packing(png_);  // numbers of less than 8 bits become bytes with equal values
    image_.passes = png_set_interlace_handling(png_);
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
  PngImage image_;
  char said_[128] = "";
};

/// Slices in separate files.
class PngStack : public LabelVolume {
 public:
  /// `channel`: the selected one; -1: all colours must be equal.
  PngStack(const VolumeGeometry& geometry, const PngImage& image, int channel,
           std::vector<std::string> paths)
      : LabelVolume(geometry),
        image_(image),
        channel_(static_cast<std::size_t>(std::max(0, channel))),
        needs_grey_(channel < 0),
        paths_(std::move(paths)),
        next_row_(image.height) {}

  const std::vector<Label>& next_row() override {
    if (next_row_ == image_.height) next_slice();
    const char* packed = nullptr;
    if (file_->image().passes > 1) {
      packed = slice_.data() + std::size_t{next_row_} * file_->row_bytes();
    } else {
      slice_.resize(file_->row_bytes());
      file_->read_row(slice_.data());
      packed = slice_.data();
    }
    const VoxelType type{image_.bits == 16 ? 2 : 1, false, false, true};
    const auto size = static_cast<std::size_t>(type.bytes);
    row_.resize(image_.width);
    const RowPlace place = {paths_[next_slice_ - 1], next_row_,
                            static_cast<std::int64_t>(next_slice_) - 1};
    ++next_row_;
    if (image_.channels == 1) {
      labels_of(packed, type, coding(), row_, place);
      return row_;
    }
    const auto channels = static_cast<std::size_t>(image_.channels);
    voxels_.resize(size * image_.width);
    for (std::size_t k = 0; k < voxels_.size(); ++k) {
      voxels_[k] = packed[(k / size * channels + channel_) * size + k % size];
    }
    for (std::size_t x = 0; needs_grey_ && x < image_.width; ++x) {
      check_colours_equal(packed + x * channels * size, size, place.path);
    }
    labels_of(voxels_.data(), type, coding(), row_, place);
    return row_;
  }

  void rewind() override {
    file_.reset();
    next_slice_ = 0;
    next_row_ = image_.height;
  }

 private:
  void next_slice() {
    file_ = std::make_unique<PngFile>(paths_.at(next_slice_++));
    next_row_ = 0;
    if (!(file_->image() == image_)) {  // checked when it was opened, so it has changed since
      refuse_volume(paths_[next_slice_ - 1],
                    "was changed while it was read. Run the command again.");
    }
    if (file_->image().passes == 1) return;
    // An interlaced image is complete only after its last pass.
    slice_.assign(file_->row_bytes() * image_.height, '\0');
    for (int pass = 0; pass < file_->image().passes; ++pass) {
      for (std::size_t y = 0; y < image_.height; ++y) {
        file_->read_row(slice_.data() + y * file_->row_bytes());
      }
    }
  }

  PngImage image_;
  std::size_t channel_;
  bool needs_grey_;
  std::vector<std::string> paths_;
  std::unique_ptr<PngFile> file_;
  std::size_t next_slice_ = 0;
  png_uint_32 next_row_;
  std::vector<char> slice_;  ///< all rows of an interlaced file, else one
  std::vector<char> voxels_;
  std::vector<Label> row_;
};

}  // namespace

std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice& choice) {
  refuse_array_choice(choice, slices.folder);
  const PngImage image = PngFile(slices.paths.front()).image();
  for (const std::string& path : slices.paths) {
    const PngImage here = PngFile(path).image();
    if (here == image) continue;
    refuse_volume(path, "is a slice of " + here.text() + ", but the slices before it have " +
                            image.text() + ". Save all slices alike.");
  }
  // Transparency is no channel of labels; three equal colours are one.
  const bool is_grey = image.channels > 1 && !choice.channel;
  const std::int64_t channel =
      chosen_place({AxisKind::Channel, is_grey ? 1 : image.channels}, choice, slices.folder);
  chosen_place({AxisKind::Frame, 1}, choice, slices.folder);
  VolumeGeometry geometry;
  geometry.counts = voxel_counts(
      {image.width, image.height, static_cast<std::int64_t>(slices.paths.size())}, slices.folder);
  set_lattice(geometry, Eigen::Matrix3d::Identity(), Vector3::Constant(0.5), choice, slices.folder);
  return std::make_unique<PngStack>(geometry, image,
                                    is_grey && image.channels > 2 ? -1 : static_cast<int>(channel),
                                    slices.paths);
}

#else

std::unique_ptr<LabelVolume> open_png_slices(const SliceFiles& slices, const VolumeChoice&) {
  refuse_volume(slices.folder,
                "cannot be read: this program was built without libpng. Install libpng-dev and "
                "build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
