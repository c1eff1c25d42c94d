// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef WSCVT_HAS_TIFF
#include <algorithm>
#include <cstring>
#include <utility>

#include "toolbox/volume/byte_order_check.h"
#include "toolbox/volume/tiff_pages.h"
#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#include "wscvt/base/error.h"

namespace wscvt {

namespace {

/// See volume_of_slices.
class TiffStack : public LabelVolume {
 public:
  TiffStack(const VolumeGeometry& geometry, const TiffPage& page, std::int64_t sample,
            std::vector<std::string> files, std::vector<SlicePage> slices)
      : LabelVolume(geometry),
        page_(page),
        sample_(static_cast<std::uint16_t>(page.samples == 1 ? 0 : sample)),
        files_(std::move(files)),
        slices_(std::move(slices)),
        next_row_(page.height),
        order_(page.type, geometry.counts) {}

  const std::vector<Label>& next_row() override {
    if (next_row_ == page_.height) next_page();
    const std::size_t in_band = next_row_ % band_rows_;
    if (in_band == 0) read_band();
    row_.resize(page_.width);
    unpack_row(band_.data() + in_band * row_bytes_);
    order_.look_at(voxels_.data(), number_++);
    labels_of(voxels_.data(), page_.type, coding(), row_,
              {file_->path(), next_row_, static_cast<std::int64_t>(next_slice_) - 1});
    ++next_row_;
    if (next_row_ == page_.height && next_slice_ == slices_.size()) {
      order_.finish(*this, coding().as_grey, file_->path());
    }
    return row_;
  }

  void rewind() override {
    number_ = 0;
    file_.reset();
    next_slice_ = 0;
    next_row_ = page_.height;
  }

 private:
  void next_page() {
    const SlicePage& slice = slices_.at(next_slice_);
    const bool is_same_file = file_ && file_at_ == slice.file;
    if (!is_same_file) {
      file_ = std::make_unique<TiffFile>(files_[slice.file]);
      file_at_ = slice.file;
      page_at_ = 0;
    }
    // Pages are a linked list: followed forwards, and restarted if necessary.
    bool is_found = true;
    if (slice.page < page_at_) {
      is_found = TIFFSetDirectory(file_->get(), static_cast<tdir_t>(slice.page)) != 0;
    } else {
      for (; is_found && page_at_ < slice.page; ++page_at_) {
        is_found = TIFFReadDirectory(file_->get()) != 0;
      }
    }
    page_at_ = slice.page;
    if (!is_found) refuse_volume(file_->path(), "has lost pages. Copy it again.");
    ++next_slice_;
    const TiffPage here = page_of(*file_);
    if (!(here == page_)) {
      refuse_volume(file_->path(), "has the page " + std::to_string(slice.page + 1) + " of " +
                                       here.text() + ", but the first has " + page_.text() +
                                       ". Save all slices alike.");
    }
    begin_page();
  }

  void begin_page() {
    // Some writers pad the last strip to a whole one. libdeflate then leaves rows unwritten.
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(file_->get(), TIFFTAG_COMPRESSION, &compression);
    if (compression == COMPRESSION_ADOBE_DEFLATE || compression == COMPRESSION_DEFLATE) {
      TIFFSetField(file_->get(), TIFFTAG_DEFLATE_SUBCODEC, DEFLATE_SUBCODEC_ZLIB);
    }
    std::uint32_t rows = 0;
    tile_width_ = 0;
    row_bytes_ = static_cast<std::size_t>(TIFFScanlineSize64(file_->get()));
    if (TIFFIsTiled(file_->get()) != 0) {
      TIFFGetField(file_->get(), TIFFTAG_TILEWIDTH, &tile_width_);
      TIFFGetField(file_->get(), TIFFTAG_TILELENGTH, &rows);
      // A tile may extend beyond the page, so it can be larger than the page.
      check_bytes(std::uint64_t{rows} * tile_width_);
    } else {
      TIFFGetFieldDefaulted(file_->get(), TIFFTAG_ROWSPERSTRIP, &rows);
    }
    band_rows_ = std::clamp<std::uint32_t>(rows, 1, page_.height);
    check_bytes(std::uint64_t{band_rows_} * page_.width);
    next_row_ = 0;
  }

  void check_bytes(std::uint64_t voxels) const {
    const auto bytes =
        static_cast<std::uint64_t>(page_.type.bytes) * static_cast<std::uint64_t>(page_.samples);
    if (voxels > file_->most_bytes() / bytes) {
      file_->fail("claims strips or tiles larger than itself");
    }
  }

  void read_band() {
    band_.resize(row_bytes_ * std::min(band_rows_, page_.height - next_row_));
    read_plane(page_.is_planar ? sample_ : std::uint16_t{0});
    if (!page_.is_planar || !page_.shows_colours) return;
    const std::vector<char> red = band_;
    for (const std::uint16_t plane : {std::uint16_t{1}, std::uint16_t{2}}) {
      read_plane(plane);
      if (band_ != red) refuse_colours(file_->path());
    }
  }

  void read_plane(std::uint16_t plane) {
    if (tile_width_ == 0) {
      read_strip(plane);
    } else {
      read_tiles(plane);
    }
  }

  void read_strip(std::uint16_t plane) {
    const auto wanted = static_cast<tmsize_t>(band_.size());
    const std::uint32_t strip = TIFFComputeStrip(file_->get(), next_row_, plane);
    if (TIFFReadEncodedStrip(file_->get(), strip, band_.data(), wanted) != wanted) {
      file_->fail("is cut short or damaged");
    }
  }

  /// Reads the tiles, side by side, of the next rows.
  void read_tiles(std::uint16_t plane) {
    const tmsize_t tile_bytes = TIFFTileSize(file_->get());
    const auto tile_row_bytes = static_cast<std::size_t>(TIFFTileRowSize(file_->get()));
    tile_.resize(static_cast<std::size_t>(tile_bytes));
    const std::size_t rows = band_.size() / row_bytes_;
    std::size_t begin = 0;
    for (std::uint32_t x = 0; x < page_.width; x += tile_width_, begin += tile_row_bytes) {
      const std::uint32_t tile = TIFFComputeTile(file_->get(), x, next_row_, 0, plane);
      if (TIFFReadEncodedTile(file_->get(), tile, tile_.data(), tile_bytes) != tile_bytes) {
        file_->fail("is cut short or damaged");
      }
      if (begin >= row_bytes_) file_->fail("has tiles of another width than it says");
      const std::size_t bytes = std::min(tile_row_bytes, row_bytes_ - begin);
      for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(band_.data() + row * row_bytes_ + begin, tile_.data() + row * tile_row_bytes,
                    bytes);
      }
    }
  }

  /// Extracts the selected numbers of a row, byte after byte.
  void unpack_row(const char* packed) {
    const auto size = static_cast<std::size_t>(page_.type.bytes);
    voxels_.resize(size * page_.width);
    if (page_.bits < 8) {
      const auto bits = static_cast<unsigned>(page_.bits);
      for (std::size_t x = 0; x < page_.width; ++x) {
        const auto byte = static_cast<unsigned char>(packed[x * bits / 8]);
        const auto shift = static_cast<unsigned>(8 - bits - x * bits % 8);
        voxels_[x] = static_cast<char>(byte >> shift & ((1U << bits) - 1U));
      }
    } else if (page_.samples == 1 || page_.is_planar) {
      std::memcpy(voxels_.data(), packed, voxels_.size());
    } else {
      const std::size_t step = size * static_cast<std::size_t>(page_.samples);
      for (std::size_t x = 0; x < page_.width; ++x) {
        std::memcpy(voxels_.data() + x * size, packed + x * step + sample_ * size, size);
        if (page_.shows_colours) check_colours_equal(packed + x * step, size, file_->path());
        if (page_.has_alpha) check_alpha(std::string(packed + x * step + size, size));
      }
    }
  }

  void check_alpha(const std::string& alpha) {
    if (alpha_.empty()) alpha_ = alpha;
    if (alpha == alpha_) return;
    refuse_volume(file_->path(),
                  "has a second channel, alpha, that is not constant. If the first has the labels, "
                  "choose it by " +
                      mention("select", "channel=1") + ".");
  }

  TiffPage page_;
  std::uint16_t sample_;
  std::string alpha_;  ///< of the first voxel
  std::vector<std::string> files_;
  std::vector<SlicePage> slices_;
  std::unique_ptr<TiffFile> file_;
  std::size_t file_at_ = 0;
  std::uint32_t page_at_ = 0;
  std::size_t next_slice_ = 0;
  std::uint32_t next_row_;
  ByteOrderCheck order_;
  std::int64_t number_ = 0;  ///< of the next row in the volume
  // A band is the part that the file unpacks at once: the rows of a strip, or of tiles side by
  // side.
  std::uint32_t band_rows_ = 1;
  std::uint32_t tile_width_ = 0;  // 0: strips
  std::size_t row_bytes_ = 0;     // of a band
  std::vector<char> band_;
  std::vector<char> tile_;
  std::vector<char> voxels_;
  std::vector<Label> row_;
};
}  // namespace

std::unique_ptr<LabelVolume> volume_of_slices(const VolumeGeometry& geometry, const TiffPage& page,
                                              std::int64_t sample, std::vector<std::string> files,
                                              std::vector<SlicePage> slices) {
  return std::make_unique<TiffStack>(geometry, page, sample, std::move(files), std::move(slices));
}

}  // namespace wscvt

#endif
