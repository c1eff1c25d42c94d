// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include "volume/volume_formats.h"
#include "volume/voxel_rows.h"
#ifdef WSCVT_HAS_TIFF
#include <tiffio.h>

#include <boost/endian/conversion.hpp>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/scan/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_TIFF

namespace {

namespace fs = std::filesystem;

/// One open file. What libtiff says of an error is kept for the sentence.
class TiffFile {
 public:
  explicit TiffFile(const std::string& path) : path_(path) {
    // A strip that a damaged file claims to be larger than what it could unpack to is refused.
    const std::uint64_t most =
        std::min<std::uint64_t>(1U << 30, 1100 * file_size(path) + (1 << 20));
    TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
    if (options == nullptr) throw std::bad_alloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(most));
    TIFFOpenOptionsSetErrorHandlerExtR(options, note_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, pass_over, nullptr);
    most_ = most;
    tiff_ = TIFFOpenExt(path.c_str(), "r", options);
    TIFFOpenOptionsFree(options);
    if (tiff_ == nullptr) fail("is not a TIFF file");
  }
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;
  ~TiffFile() { TIFFClose(tiff_); }

  TIFF* get() const { return tiff_; }
  const std::string& path() const { return path_; }
  std::uint64_t most_bytes() const { return most_; }

  /// How many there are. A file that was cut has lost the way to the others, and libtiff ends
  /// there.
  std::int64_t pages() const {
    const std::int64_t count = TIFFNumberOfDirectories(tiff_);
    if (!said_.empty()) fail("has lost pages");
    return count;
  }

  [[noreturn]] void fail(const std::string& what) const {
    refuse_volume(path_,
                  what + (said_.empty() ? "" : " (" + shown(said_) + ")") + "; export it again.");
  }

 private:
  static int note_error(TIFF*, void* self, const char*, const char* format, va_list arguments) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, arguments);
    auto& said = static_cast<TiffFile*>(self)->said_;
    if (said.empty()) said = text;
    return 1;
  }
  static int pass_over(TIFF*, void*, const char*, const char*, va_list) { return 1; }

  std::string path_;
  std::string said_;
  std::uint64_t most_ = 0;
  TIFF* tiff_ = nullptr;
};

/// What a page says of itself.
struct Page {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  VoxelType type;

  bool operator==(const Page& other) const {
    return width == other.width && height == other.height && type.bytes == other.type.bytes &&
           type.has_sign == other.type.has_sign;
  }
};

Page page_of(const TiffFile& file) {
  TIFF* const tiff = file.get();
  Page page;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width) == 0 ||
      TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height) == 0) {
    file.fail("does not say how large its pages are");
  }
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  const bool is_whole = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT;
  if (samples != 1 || !is_whole || (bits != 8 && bits != 16 && bits != 32 && bits != 64)) {
    refuse_volume(file.path(), "has " + std::to_string(samples) + " numbers of " +
                                   std::to_string(bits) +
                                   " bits a voxel, or decimals; save labels as whole numbers of 8, "
                                   "16, 32 or 64 bits.");
  }
  page.type = {bits / 8, format == SAMPLEFORMAT_INT,
               boost::endian::order::native == boost::endian::order::big};
  return page;
}

/// What ImageJ writes into its stacks: lines of "key=value".
class ImageJText {
 public:
  explicit ImageJText(const TiffFile& file) {
    char* text = nullptr;
    if (TIFFGetField(file.get(), TIFFTAG_IMAGEDESCRIPTION, &text) != 0 && text != nullptr &&
        std::strncmp(text, "ImageJ=", 7) == 0) {
      text_ = std::string("\n") + text;
    }
  }

  bool is_there() const { return !text_.empty(); }

  /// Empty where there is none.
  std::string value(const std::string& key) const {
    const std::size_t place = text_.find("\n" + key + "=");
    if (place == std::string::npos) return "";
    const std::size_t begin = place + key.size() + 2;
    return text_.substr(begin, text_.find('\n', begin) - begin);
  }

  std::int64_t images() const { return whole_number_in(value("images")).value_or(1); }

 private:
  std::string text_;
};

/// The voxel size that ImageJ noted; other programs' resolutions are of paper.
void set_lattice_of_imagej(VolumeGeometry& geometry, const TiffFile& file,
                           const std::optional<Vector3>& voxel_size) {
  const ImageJText text(file);
  float across = 0.0F;
  float down = 0.0F;
  Vector3 spacing = Vector3::Ones();
  if (text.is_there() && TIFFGetField(file.get(), TIFFTAG_XRESOLUTION, &across) != 0 &&
      TIFFGetField(file.get(), TIFFTAG_YRESOLUTION, &down) != 0 && across > 0.0F && down > 0.0F) {
    // Stored as fractions, which libtiff gives as float; ImageJ's are of six digits.
    spacing = {1.0 / static_cast<double>(across), 1.0 / static_cast<double>(down), 0.0};
    spacing.z() = number_in(text.value("spacing")).value_or(spacing.x());
    geometry.unit = text.value("unit");
  }
  if (geometry.unit == "\\u00B5m" || geometry.unit == "micron") geometry.unit = "um";
  set_lattice(geometry, spacing.asDiagonal(), 0.5 * spacing, voxel_size, file.path());
}

/// Slices that are pages of one file, or files of one page.
class TiffStack : public LabelVolume {
 public:
  TiffStack(const VolumeGeometry& geometry, const Page& page, std::vector<std::string> files)
      : LabelVolume(geometry), page_(page), files_(std::move(files)) {}

  const std::vector<Label>& next_row() override {
    if (next_row_ == page_.height) next_page();
    const std::size_t in_band = next_row_ % band_rows_;
    if (in_band == 0) {
      band_.resize(row_bytes() * std::min(band_rows_, page_.height - next_row_));
      if (tile_width_ == 0) {
        read_strip();
      } else {
        read_tiles();
      }
    }
    row_.resize(page_.width);
    labels_of(band_.data() + in_band * row_bytes(), page_.type, row_, file_->path());
    ++next_row_;
    return row_;
  }

  void rewind() override {
    file_.reset();
    next_file_ = 0;
    next_row_ = page_.height;
  }

 private:
  void next_page() {
    if (!file_ || TIFFReadDirectory(file_->get()) == 0) {
      if (next_file_ == files_.size())
        refuse_volume(files_.back(), "has lost pages; copy it again.");
      file_ = std::make_unique<TiffFile>(files_[next_file_++]);
    }
    if (!(page_of(*file_) == page_)) {
      refuse_volume(file_->path(),
                    "has a page of another size or type than the first; save slices "
                    "that are alike.");
    }
    std::uint32_t rows = 0;
    tile_width_ = 0;
    if (TIFFIsTiled(file_->get()) != 0) {
      TIFFGetField(file_->get(), TIFFTAG_TILEWIDTH, &tile_width_);
      TIFFGetField(file_->get(), TIFFTAG_TILELENGTH, &rows);
      // A tile hangs over the page's rim, so that it can be larger than the page.
      check_bytes(std::uint64_t{rows} * tile_width_);
    } else {
      TIFFGetFieldDefaulted(file_->get(), TIFFTAG_ROWSPERSTRIP, &rows);
    }
    band_rows_ = std::clamp<std::uint32_t>(rows, 1, page_.height);
    check_bytes(std::uint64_t{band_rows_} * page_.width);
    next_row_ = 0;
  }

  void check_bytes(std::uint64_t voxels) const {
    if (voxels > file_->most_bytes() / static_cast<std::uint64_t>(page_.type.bytes)) {
      file_->fail("claims strips or tiles larger than itself");
    }
  }

  std::size_t bytes_of(std::uint32_t voxels) const {
    return std::size_t{voxels} * static_cast<std::size_t>(page_.type.bytes);
  }
  std::size_t row_bytes() const { return bytes_of(page_.width); }

  void read_strip() {
    const auto wanted = static_cast<tmsize_t>(band_.size());
    const std::uint32_t strip = next_row_ / band_rows_;
    if (TIFFReadEncodedStrip(file_->get(), strip, band_.data(), wanted) != wanted) {
      file_->fail("is cut short or damaged");
    }
  }

  /// Those beside each other that hold the next rows.
  void read_tiles() {
    const tmsize_t tile_bytes = TIFFTileSize(file_->get());
    const tmsize_t tile_row_bytes = TIFFTileRowSize(file_->get());
    tile_.resize(static_cast<std::size_t>(tile_bytes));
    const auto rows = static_cast<tmsize_t>(band_.size() / row_bytes());
    for (std::uint32_t x = 0; x < page_.width; x += tile_width_) {
      const std::uint32_t tile = TIFFComputeTile(file_->get(), x, next_row_, 0, 0);
      if (TIFFReadEncodedTile(file_->get(), tile, tile_.data(), tile_bytes) != tile_bytes) {
        file_->fail("is cut short or damaged");
      }
      const std::size_t bytes = bytes_of(std::min(tile_width_, page_.width - x));
      char* to = band_.data() + bytes_of(x);
      for (tmsize_t row = 0; row < rows; ++row, to += row_bytes()) {
        std::memcpy(to, tile_.data() + row * tile_row_bytes, bytes);
      }
    }
  }

  Page page_;
  std::vector<std::string> files_;
  std::size_t next_file_ = 0;
  std::unique_ptr<TiffFile> file_;
  std::uint32_t next_row_ = page_.height;
  // A band is what the file unpacks at once: the rows of a strip, or of the tiles beside each
  // other.
  std::uint32_t band_rows_ = 1;
  std::uint32_t tile_width_ = 0;  // 0: strips
  std::vector<char> band_;
  std::vector<char> tile_;
  std::vector<Label> row_;
};

/// The TIFF files of a folder in the order of the numbers in their names.
std::vector<std::string> slices_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string ending = ending_of(entry.path().string());
    if (ending == ".tif" || ending == ".tiff") files.push_back(entry.path().string());
  }
  if (files.empty()) refuse_volume(folder, "holds no .tif file; check its name.");
  std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
    return ::strverscmp(a.c_str(), b.c_str()) < 0;
  });
  return files;
}

}  // namespace

std::unique_ptr<LabelVolume> open_tiff(const std::string& path,
                                       const std::optional<Vector3>& voxel_size) {
  std::error_code error;
  const std::vector<std::string> files =
      fs::is_directory(path, error) ? slices_in(path) : std::vector<std::string>{path};
  const TiffFile first(files.front());
  const Page page = page_of(first);
  const ImageJText text(first);
  std::uint64_t offset = 0;
  std::uint64_t* offsets = nullptr;
  if (TIFFGetField(first.get(), TIFFTAG_STRIPOFFSETS, &offsets) != 0) offset = offsets[0];
  VolumeGeometry geometry;
  std::int64_t slices = 0;
  for (const std::string& file : files) {
    slices += files.size() == 1 ? first.pages() : TiffFile(file).pages();
  }
  // Above 4 GiB ImageJ writes one page and the voxels of all behind it, as they are.
  const bool is_one_block = slices == 1 && text.is_there() && text.images() > 1;
  if (is_one_block) {
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(first.get(), TIFFTAG_COMPRESSION, &compression);
    if (compression != COMPRESSION_NONE || TIFFIsTiled(first.get()) != 0) {
      first.fail("has one page of the " + std::to_string(text.images()) + " that ImageJ noted");
    }
    slices = text.images();
  }
  geometry.counts = voxel_counts({page.width, page.height, slices}, path);
  set_lattice_of_imagej(geometry, first, voxel_size);
  if (is_one_block) {
    VoxelType type = page.type;
    type.big_endian = TIFFIsBigEndian(first.get()) != 0;
    return volume_of_file(geometry, type, {files.front(), offset});
  }
  return std::make_unique<TiffStack>(geometry, page, files);
}

#else

std::unique_ptr<LabelVolume> open_tiff(const std::string& path, const std::optional<Vector3>&) {
  refuse_volume(path,
                "cannot be read: this program was built without libtiff; install libtiff-dev "
                "and build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
