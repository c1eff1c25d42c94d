// SPDX-License-Identifier: GPL-3.0-or-later
// Slices as BMP files: SkyScan's reconstructions have them. Microsoft's BITMAPINFOHEADER,
// uncompressed.
#include <boost/endian/conversion.hpp>
#include <memory>
#include <utility>

#include "toolbox/volume/byte_source.h"
#include "toolbox/volume/image_stack.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"

namespace wscvt {

namespace {

/// Size and form of an image.
struct BmpImage {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::uint16_t bits = 8;
  bool is_from_above = false;  ///< the first row in the file is the top
  std::uint32_t offset = 0;    ///< of the rows

  bool operator==(const BmpImage& other) const {
    return width == other.width && height == other.height && bits == other.bits;
  }
  std::size_t row_bytes() const {  // rows end at multiples of four bytes
    return (static_cast<std::size_t>(width) * bits + 31) / 32 * 4;
  }
  std::string text() const {
    return std::to_string(width) + " x " + std::to_string(height) + " voxels of " +
           std::to_string(bits) + " bits";
  }
};

BmpImage image_of(const std::string& path) {
  char head[54] = {};
  if (file_bytes(path, 0)->read(head, sizeof head) < sizeof head || head[0] != 'B' ||
      head[1] != 'M') {
    refuse_volume(path, "is not a BMP file. Export it again.");
  }
  const auto four = [&](std::size_t begin) {
    return boost::endian::load_little_s32(reinterpret_cast<unsigned char*>(head) + begin);
  };
  BmpImage image;
  image.offset = static_cast<std::uint32_t>(four(10));
  image.width = four(18);
  image.height = four(22);
  image.is_from_above = image.height < 0;
  constexpr std::int32_t most = 1000000;
  if (image.width < 1 || image.width > most || image.height == 0 || image.height < -most ||
      image.height > most) {
    refuse_volume(path, "is a BMP file without a size. Export it again.");
  }
  if (image.is_from_above) image.height = -image.height;
  image.bits = boost::endian::load_little_u16(reinterpret_cast<unsigned char*>(head) + 28);
  if (four(30) != 0 || (image.bits != 8 && image.bits != 24 && image.bits != 32)) {
    refuse_volume(path, "is a BMP file of " + std::to_string(image.bits) +
                            " bits, or a packed one. Save the slices as TIFF or PNG.");
  }
  const std::uint64_t wanted = image.offset + static_cast<std::uint64_t>(image.row_bytes()) *
                                                  static_cast<std::uint64_t>(image.height);
  check_voxel_bytes(wanted, file_size(path), Packing::None, path);
  return image;
}

class BmpStack : public LabelVolume {
 public:
  BmpStack(const VolumeGeometry& geometry, const BmpImage& image, std::vector<std::string> paths)
      : LabelVolume(geometry), image_(image), paths_(std::move(paths)), next_row_(image.height) {}

  const std::vector<Label>& next_row() override {
    if (next_row_ == image_.height) next_slice();
    const std::int32_t place = is_from_above_ ? next_row_ : image_.height - 1 - next_row_;
    const char* const packed = slice_.data() + static_cast<std::size_t>(place) * image_.row_bytes();
    const auto width = static_cast<std::size_t>(image_.width);
    const std::size_t step = image_.bits / 8;
    voxels_.resize(width);
    for (std::size_t x = 0; x < width; ++x) {
      if (step > 1) check_colours_equal(packed + x * step, 1, paths_[next_slice_ - 1]);
      voxels_[x] = packed[x * step];
    }
    row_.resize(width);
    labels_of(voxels_.data(), {1, false, false, false}, coding(), row_,
              {paths_[next_slice_ - 1], next_row_, static_cast<std::int64_t>(next_slice_) - 1});
    ++next_row_;
    return row_;
  }

  void rewind() override {
    next_slice_ = 0;
    next_row_ = image_.height;
  }

 private:
  void next_slice() {
    const std::string& path = paths_.at(next_slice_++);
    const BmpImage here = image_of(path);
    slice_.resize(here.row_bytes() * static_cast<std::size_t>(here.height));
    is_from_above_ = here.is_from_above;
    next_row_ = 0;
    if (here == image_ &&
        file_bytes(path, here.offset)->read(slice_.data(), slice_.size()) == slice_.size()) {
      return;
    }
    refuse_volume(path, "was changed while it was read. Run the command again.");
  }

  BmpImage image_;
  std::vector<std::string> paths_;
  std::size_t next_slice_ = 0;
  std::int32_t next_row_;
  bool is_from_above_ = false;
  std::vector<char> slice_;
  std::vector<char> voxels_;
  std::vector<Label> row_;
};

}  // namespace

std::unique_ptr<LabelVolume> open_bmp_slices(const SliceFiles& slices, const VolumeChoice& choice) {
  refuse_array_choice(choice, slices.folder);
  const BmpImage image = image_of(slices.paths.front());
  for (const std::string& path : slices.paths) {
    const BmpImage here = image_of(path);
    if (here == image) continue;
    refuse_volume(path, "is a slice of " + here.text() + ", but the slices before it have " +
                            image.text() + ". Save all slices alike.");
  }
  chosen_place({AxisKind::Channel, 1}, choice, slices.folder);
  chosen_place({AxisKind::Frame, 1}, choice, slices.folder);
  VolumeGeometry geometry;
  geometry.counts = voxel_counts(
      {image.width, image.height, static_cast<std::int64_t>(slices.paths.size())}, slices.folder);
  set_lattice(geometry, Eigen::Matrix3d::Identity(), Vector3::Constant(0.5), choice, slices.folder);
  return std::make_unique<BmpStack>(geometry, image, slices.paths);
}

}  // namespace wscvt
