// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "toolbox/volume/voxel_rows.h"
#ifdef WSCVT_HAS_TIFF
#include <tiffio.h>

#include <array>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>

#include "toolbox/volume/byte_order_check.h"
#include "toolbox/volume/tiff_layout.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_fields.h"
#endif

namespace wscvt {

#ifdef WSCVT_HAS_TIFF

namespace {

/// An open TIFF. Errors of libtiff are kept for the message.
class TiffFile {
 public:
  /// Throws Error(InputOutput) for a file that is no TIFF.
  explicit TiffFile(const std::string& path) : path_(path) {
    // Refuses strips for which a damaged file claims more than they could unpack to.
    most_ = std::min<std::uint64_t>(1U << 30, 1100 * file_size(path) + (1 << 20));
    TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
    if (options == nullptr) throw std::bad_alloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(most_));
    TIFFOpenOptionsSetErrorHandlerExtR(options, note_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options, pass_over, nullptr);
    // Not mapped to memory: the process would be killed where the file cannot be read.
    tiff_ = TIFFOpenExt(path.c_str(), "rm", options);
    TIFFOpenOptionsFree(options);
    if (tiff_ == nullptr) fail("is not a TIFF file");
  }
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;
  ~TiffFile() { TIFFClose(tiff_); }

  TIFF* get() const { return tiff_; }
  const std::string& path() const { return path_; }

  /// Returns the largest possible size of an unpacked strip or tile of the file.
  std::uint64_t most_bytes() const { return most_; }

  /// Returns the number of pages. Throws Error(InputOutput) for a file that was cut, because
  /// libtiff cannot reach its other pages.
  std::int64_t pages() const {
    const std::int64_t count = TIFFNumberOfDirectories(tiff_);
    if (!said_.empty()) fail("has lost pages");
    return count;
  }

  /// Returns the text that the writing program left on the current page; empty if there is none.
  std::string description() const {
    char* text = nullptr;
    if (TIFFGetField(tiff_, TIFFTAG_IMAGEDESCRIPTION, &text) == 0 || text == nullptr) return "";
    return text;
  }

  /// Throws Error(InputOutput): "path" + what, and libtiff's error.
  [[noreturn]] void fail(const std::string& what) const {
    refuse_volume(path_,
                  what + (said_.empty() ? "" : " (" + shown(said_) + ")") + ". Export it again.");
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

/// Size and type of a page.
struct Page {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 8;            ///< of a number: 1, 2, 4, or the type's
  VoxelType type;          ///< bytes for numbers of less than 8 bits
  int samples = 1;         ///< numbers per voxel
  bool is_planar = false;  ///< samples follow each other, not interleaved
  bool shows_0_as_white = false;
  bool shows_colours = false;  ///< samples are red, green and blue, and none was chosen
  bool has_alpha = false;      ///< samples are grey and transparency, and none was chosen
  int orientation = ORIENTATION_TOPLEFT;  ///< the first page's counts for all

  bool operator==(const Page& other) const {
    return width == other.width && height == other.height && bits == other.bits &&
           type.has_sign == other.type.has_sign && type.is_float == other.type.is_float &&
           samples == other.samples && is_planar == other.is_planar;
  }

  std::string text() const {
    return std::to_string(width) + " x " + std::to_string(height) + " voxels of " +
           std::to_string(samples) + " x " + std::to_string(bits) + " bits";
  }
};

Page page_of(const TiffFile& file) {
  TIFF* const tiff = file.get();
  Page page;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t planes = PLANARCONFIG_CONTIG;
  std::uint16_t compression = COMPRESSION_NONE;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  std::uint32_t depth = 1;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width) == 0 ||
      TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height) == 0) {
    file.fail("does not say how large its pages are");
  }
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_IMAGEDEPTH, &depth);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  if (compression == COMPRESSION_JPEG || compression == COMPRESSION_OJPEG) {
    file.fail("is packed by JPEG, which changes numbers, so they are not labels any more");
  }
  if (depth != 1) {
    refuse_volume(file.path(),
                  "has pages of " + std::to_string(depth) +
                      " slices. Save one slice a page, in Python by import tifffile; "
                      "tifffile.imwrite(\"pages.tif\", tifffile.imread(" +
                      in_quotes(std::filesystem::path(file.path()).filename().string()) + "))");
  }
  const bool is_float = format == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64);
  const bool has_sign = format == SAMPLEFORMAT_INT;
  const bool is_whole = (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID || has_sign) &&
                        (bits == 8 || bits == 16 || bits == 32 || bits == 64);
  const bool is_small =
      format == SAMPLEFORMAT_UINT && samples == 1 && (bits == 1 || bits == 2 || bits == 4);
  if (samples < 1 || (!is_whole && !is_small && !is_float)) {
    refuse_volume(file.path(), "has " + std::to_string(samples) + " numbers of " +
                                   std::to_string(bits) +
                                   " bits per voxel, of an unknown kind. Save labels as "
                                   "whole numbers of 8, 16, 32 or 64 bits.");
  }
  page.bits = bits;
  page.type = {std::max(1, bits / 8), has_sign || is_float, is_float,
               boost::endian::order::native == boost::endian::order::big};
  page.samples = samples;
  page.is_planar = planes == PLANARCONFIG_SEPARATE && samples > 1;
  page.shows_0_as_white = photometric == PHOTOMETRIC_MINISWHITE;
  page.shows_colours = photometric == PHOTOMETRIC_RGB && samples > 2 && !page.is_planar;
  std::uint16_t extra_samples = 0;
  std::uint16_t* kinds = nullptr;
  TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_samples, &kinds);
  page.has_alpha = samples == 2 && !page.is_planar && extra_samples == 1 &&
                   (kinds[0] == EXTRASAMPLE_ASSOCALPHA || kinds[0] == EXTRASAMPLE_UNASSALPHA);
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetField(tiff, TIFFTAG_ORIENTATION, &orientation);
  page.orientation = orientation >= 1 && orientation <= 8 ? orientation : ORIENTATION_TOPLEFT;
  return page;
}

/// The pages of a file that are slices.
struct PageList {
  std::vector<std::uint32_t> slices;  ///< numbers of pages, from 0
  std::int64_t left_out = 0;          ///< number of reduced images and masks of others
  std::int64_t marked = 0;  ///< number of slices that are marked as reduced, but are as large
  std::string text;         ///< of the first slice; without one, of the first page
};

/// What tells slices from previews.
struct PageForm {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint32_t marks = 0;  ///< bits of NewSubfileType

  bool is_like(const PageForm& other) const {
    return width == other.width && height == other.height && bits == other.bits &&
           samples == other.samples;
  }
  bool is_marked() const { return (marks & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0; }

  /// Whether it is smaller than `full` by one factor along both axes, up to rounding.
  bool is_scaled(const PageForm& full) const {
    const double factor = static_cast<double>(full.width) / width;
    return factor > 1.5 && std::abs(full.height - factor * height) <= factor;
  }
};

/// Reads the forms of all pages, and adds the reduced images behind pages (SubIFDs) to `left_out`.
std::vector<PageForm> page_forms(const TiffFile& file, std::int64_t& left_out) {
  std::vector<PageForm> forms;
  const std::int64_t count = file.pages();
  if (TIFFSetDirectory(file.get(), 0) == 0) file.fail("has lost pages");
  for (std::int64_t k = 0; k < count; ++k) {
    if (k > 0 && TIFFReadDirectory(file.get()) == 0) file.fail("has lost pages");
    PageForm form;
    TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &form.width);
    TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &form.height);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &form.bits);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_SAMPLESPERPIXEL, &form.samples);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_SUBFILETYPE, &form.marks);
    std::uint16_t behind = 0;
    std::uint64_t* places = nullptr;
    if (TIFFGetField(file.get(), TIFFTAG_SUBIFD, &behind, &places) != 0) left_out += behind;
    forms.push_back(form);
  }
  return forms;
}

/// Returns the form of which the file has the most voxels in unmarked pages; the first page's if
/// all are marked.
PageForm main_form(const std::vector<PageForm>& forms) {
  std::vector<std::pair<PageForm, double>> kinds;
  for (const PageForm& form : forms) {
    if (form.is_marked()) continue;
    const auto found = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const auto& kind) { return kind.first.is_like(form); });
    const double voxels = static_cast<double>(form.width) * form.height;
    if (found != kinds.end()) {
      found->second += voxels;
    } else {
      kinds.emplace_back(form, voxels);
    }
  }
  if (kinds.empty()) return forms.front();
  return std::max_element(kinds.begin(), kinds.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Finds the slices: all pages but those marked as reduced images or masks, the smaller levels of a
/// pyramid, and one or two smaller pages before or behind the slices. Other pages of another form
/// are listed, so that they are refused by name.
PageList list_pages(const TiffFile& file) {
  PageList list;
  const std::vector<PageForm> forms = page_forms(file, list.left_out);
  TIFFSetDirectory(file.get(), 0);
  list.text = file.description();
  const PageForm main = main_form(forms);
  const auto is_slice = [&](const PageForm& form) {
    return form.is_like(main) && ((form.marks & FILETYPE_MASK) == 0 || main.is_marked());
  };
  const auto first = std::find_if(forms.begin(), forms.end(), is_slice);
  const auto last = std::find_if(forms.rbegin(), forms.rend(), is_slice).base();
  const auto slices = std::count_if(first, last, is_slice);
  const auto outside = static_cast<std::ptrdiff_t>(forms.size()) - (last - first);
  for (auto form = forms.begin(); form != forms.end(); ++form) {
    const bool is_smaller = form->width < main.width && form->height < main.height;
    const bool is_outside = form < first || form >= last;
    constexpr std::ptrdiff_t most_previews = 2;
    const bool is_preview =
        is_smaller && is_outside &&
        ((outside <= most_previews && outside < slices) || (form >= last && form->is_scaled(main)));
    if (!is_slice(*form) && (form->is_marked() || is_preview)) {
      ++list.left_out;
      continue;
    }
    if (form->is_marked() && !main.is_marked()) ++list.marked;
    list.slices.push_back(static_cast<std::uint32_t>(form - forms.begin()));
  }
  TIFFSetDirectory(file.get(), static_cast<tdir_t>(list.slices.front()));
  const std::string text = file.description();
  if (!text.empty()) list.text = text;
  return list;
}

/// A slice: a page of a file.
struct SlicePage {
  std::size_t file = 0;
  std::uint32_t page = 0;
};

/// Slices that are pages of one file, or files of one page.
class TiffStack : public LabelVolume {
 public:
  /// `sample`: number of the selected sample of each voxel. Colours must be equal, alpha constant.
  TiffStack(const VolumeGeometry& geometry, const Page& page, std::int64_t sample,
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
    const Page here = page_of(*file_);
    if (!(here == page_)) {
      refuse_volume(file_->path(), "has the page " + std::to_string(slice.page + 1) + " of " +
                                       here.text() + ", but the first has " + page_.text() +
                                       ". Save all slices alike.");
    }
    begin_page();
  }

  void begin_page() {
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
    const std::uint16_t plane = page_.is_planar ? sample_ : std::uint16_t{0};
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

  Page page_;
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

/// Returns the size of a voxel along x and y from the resolution of a page, in centimetres if the
/// page has a unit; nothing without a resolution.
std::optional<Vector3> voxel_of_resolution(const TiffFile& file) {
  float across = 0.0F;
  float down = 0.0F;
  std::uint16_t unit = RESUNIT_INCH;
  if (TIFFGetField(file.get(), TIFFTAG_XRESOLUTION, &across) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_YRESOLUTION, &down) == 0 || !(across > 0.0F) ||
      !(down > 0.0F)) {
    return std::nullopt;
  }
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
  // Stored as fractions, which libtiff returns as float; ImageJ's have six digits.
  Vector3 size(1.0 / static_cast<double>(across), 1.0 / static_cast<double>(down), 0.0);
  if (unit == RESUNIT_INCH) size *= 2.54;
  return size;
}

/// Whether a resolution is a usual one of screens and printers, in dots per inch, and the distance
/// of slices does not fit it: then a program wrote it that knew no size of voxels.
bool is_of_a_screen(const Vector3& size_cm, const Vector3& size) {
  constexpr std::array<double, 14> usual = {72,  96,  100, 120, 144, 150, 180,
                                            200, 240, 300, 360, 400, 600, 1200};
  const double dots = 2.54 / size_cm.x();
  const bool is_usual = std::any_of(usual.begin(), usual.end(),
                                    [&](double dpi) { return std::abs(dots - dpi) < 2e-3 * dpi; });
  constexpr double far = 5.0;
  return is_usual && (size.z() > far * size.x() || size.x() > far * size.z());
}

/// Sets the directions of the axes by the orientation tag: where the first row and the first column
/// lie (TIFF 6.0, Orientation).
void set_lattice_turned(VolumeGeometry& geometry, const Vector3& size, int orientation,
                        const VolumeChoice& choice, const std::string& path) {
  const bool is_transposed = orientation >= ORIENTATION_LEFTTOP;
  if (is_transposed) geometry.order = {1, 0, 2};
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index axis = geometry.order[static_cast<std::size_t>(k)];
    axes(axis, k) = size[axis];
  }
  set_lattice(geometry, axes, 0.5 * size, choice, path);
  const bool is_from_right =
      orientation == ORIENTATION_TOPRIGHT || orientation == ORIENTATION_BOTRIGHT ||
      orientation == ORIENTATION_RIGHTTOP || orientation == ORIENTATION_RIGHTBOT;
  const bool is_from_below =
      orientation == ORIENTATION_BOTRIGHT || orientation == ORIENTATION_BOTLEFT ||
      orientation == ORIENTATION_RIGHTBOT || orientation == ORIENTATION_LEFTBOT;
  for (const Eigen::Index axis : {Eigen::Index{0}, Eigen::Index{1}}) {
    if (!(axis == 0 ? is_from_right : is_from_below)) continue;
    const Eigen::Index k = geometry.order[static_cast<std::size_t>(axis)];  // its own inverse
    geometry.corner += geometry.axes.col(k) * geometry.counts[static_cast<std::size_t>(k)];
    geometry.axes.col(k) = -geometry.axes.col(k);
  }
}

/// Whether the size of voxels is the page's: no text, or one that gives only the shape.
bool is_by_pages(const TiffLayout& layout) {
  return layout.writer.empty() || layout.writer == "tifffile";
}

/// Takes the page's resolution in its own unit where the text's unit would make the voxels flat by
/// the ratio of both: some programs note um, but a resolution per cm. `per_cm`: the page's lengths.
void take_unit_of_page(const Vector3& per_cm, TiffLayout& layout, Vector3& size) {
  const double factor = layout.unit == "um" ? 1e4 : layout.unit == "nm" ? 1e7 : 0.0;
  constexpr double flat = 100.0;
  constexpr double far = 10.0;
  const double taken = factor * per_cm.x();
  const bool is_alike = size.z() < far * taken && taken < far * size.z();
  if (size.z() < flat * size.x() || !is_alike) return;
  size.x() = factor * per_cm.x();
  size.y() = factor * per_cm.y();
  layout.notes.push_back(
      "The resolution was taken per cm or inch, as the TIFF says: in " + layout.unit +
      ", as ImageJ notes it, the voxels would be flat. If this is wrong, give the size by " +
      mention("voxel-size", "X,Y,Z") + ".");
}

/// Sets the lattice from the text of ImageJ or OME, or from the page's resolution.
void set_lattice_of_tiff(VolumeGeometry& geometry, const TiffFile& file, const Page& page,
                         TiffLayout& layout, const VolumeChoice& choice) {
  const std::optional<Vector3> resolution = voxel_of_resolution(file);
  Vector3 size = layout.voxel_size;
  std::uint16_t unit = RESUNIT_INCH;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
  geometry.size_source = layout.writer + "'s text";
  if (!layout.other_unit.empty() && !choice.voxel_size) {
    refuse_volume(file.path(), "has axes in " + in_quotes(layout.unit) + " and in " +
                                   in_quotes(layout.other_unit) +
                                   ". Give the size in one unit by " + mention("voxel-size") + ".");
  }
  const bool is_by_imagej = layout.writer == "ImageJ";
  // Their texts have the size along z only. OME's has all.
  if (size.z() > 0.0 && resolution &&
      (is_by_imagej || (is_by_pages(layout) && unit == RESUNIT_NONE))) {
    // In ImageJ's unit, not the page's.
    size.x() = unit == RESUNIT_INCH ? resolution->x() / 2.54 : resolution->x();
    size.y() = unit == RESUNIT_INCH ? resolution->y() / 2.54 : resolution->y();
    if (unit != RESUNIT_NONE) take_unit_of_page(*resolution, layout, size);
    const double cm = layout.unit == "inch" ? 2.54 : layout.unit == "cm" ? 1.0 : 0.1;
    const bool has_coarse_unit = cm >= 1.0 || layout.unit == "mm";
    if (has_coarse_unit && is_of_a_screen(cm * size, size)) {
      layout.notes.push_back("ImageJ noted voxels of " + format_number(size.x(), 4) + " x " +
                             format_number(size.y(), 4) + " x " + format_number(size.z(), 4) + " " +
                             layout.unit + ", " + format_number(2.54 / (cm * size.x())) +
                             " per inch: the resolution of a screen, not of a scan. It was not "
                             "used.");
      size = Vector3::Zero();
    }
    if (layout.unit.empty() && size == Vector3::Ones()) size = Vector3::Zero();  // of no scan
    if (layout.unit.empty() && size.minCoeff() > 0.0) {
      layout.notes.push_back(layout.writer +
                             "'s text has a distance of slices, but no unit: the unit is unknown. "
                             "Give it by " +
                             mention("voxel-size", "X,Y,Z") + ".");
    }
  } else if (is_by_pages(layout) && resolution && unit != RESUNIT_NONE) {
    // Screens and printers have up to 1200 dots per inch, 0.021 mm; a finer one is an instrument's.
    constexpr double finest_dot_cm = 2.54 / 1200.0;
    if (resolution->x() < 0.999 * finest_dot_cm && resolution->y() < 0.999 * finest_dot_cm) {
      size = 10.0 * Vector3(resolution->x(), resolution->y(), resolution->x());
      layout.unit = "mm";
      geometry.size_source = "the TIFF's resolution";
      layout.notes.push_back(
          "Voxel size from the TIFF's resolution, along z as along x: " + format_number(size.x()) +
          " mm. Give another by " + mention("voxel-size", "X,Y,Z") + ".");
    }
  } else if (layout.writer != "OME") {
    size = Vector3::Zero();
  }
  if (!layout.differing.empty()) {
    size = Vector3::Zero();
    layout.notes = {in_quotes(layout.differing) +
                    " says another size of voxels than the slices before it. None was used."};
  }
  geometry.has_size = size.minCoeff() > 0.0;
  if (!geometry.has_size) {
    size = Vector3::Ones();
  } else {
    geometry.unit = layout.unit;
  }
  set_lattice_turned(geometry, size, page.orientation, choice, file.path());
  if (page.orientation != ORIENTATION_TOPLEFT) {
    layout.more_notes.push_back("The pages were turned as their orientation tag, " +
                                std::to_string(page.orientation) + ", says.");
  }
}

/// Returns the positions of the selected slices in a file of pages.
std::vector<SlicePage> slices_of(const TiffLayout& layout, const std::vector<std::uint32_t>& pages,
                                 const std::vector<std::int64_t>& places) {
  std::vector<SlicePage> slices;
  std::int64_t count = 1;
  for (const VolumeAxis& axis : layout.axes) {
    if (axis.kind == AxisKind::Space) count = axis.count;
  }
  for (std::int64_t z = 0; z < count; ++z) {
    std::int64_t plane = 0;
    std::int64_t step = 1;
    for (std::size_t k = 0; k < layout.axes.size(); ++k) {
      plane += step * (layout.axes[k].kind == AxisKind::Space ? z : places[k]);
      step *= layout.axes[k].count;
    }
    const auto place = static_cast<std::size_t>(plane);
    slices.push_back(
        {0, layout.pages.empty() ? pages[place] : static_cast<std::uint32_t>(layout.pages[place])});
  }
  return slices;
}

void add_notes(const TiffLayout& layout, const PageList& pages, const Page& page,
               const VolumeChoice& choice, LabelVolume& volume) {
  for (const std::string& note : layout.notes) {
    if (!choice.voxel_size) volume.add_note(note);
  }
  for (const std::string& note : layout.more_notes) volume.add_note(note);
  if (pages.left_out > 0) {
    volume.add_note("Left out: " + std::to_string(pages.left_out) + " reduced image" +
                    (pages.left_out == 1 ? "" : "s") + " (preview, pyramid or mask).");
  }
  if (pages.marked > 0) {
    volume.add_warning(std::to_string(pages.marked) +
                       " of the pages are marked as reduced images, "
                       "but are as large as the others. They were read as slices.");
  }
  if (page.has_alpha) volume.add_note("Left out: the channel alpha, which is constant.");
}

/// Returns the channels in the voxels of a page. Three equal colours are one, and alpha is none.
VolumeAxis channels_of(const Page& page) {
  return {AxisKind::Channel, page.shows_colours || page.has_alpha ? 1 : page.samples};
}

/// Returns the channels in a file's dimensions or in its voxels; refuses a file with both.
VolumeAxis channels_of(const TiffLayout& layout, const Page& page, const std::string& path) {
  VolumeAxis channels = channels_of(page);
  for (const VolumeAxis& axis : layout.axes) {
    if (axis.kind != AxisKind::Channel || axis.count == 1) continue;
    if (channels.count > 1) {
      refuse_volume(path, "has " + std::to_string(axis.count) + " channels of " +
                              std::to_string(channels.count) +
                              " numbers per voxel. Save only one channel.");
    }
    channels.count = axis.count;
  }
  return channels;
}

std::unique_ptr<LabelVolume> volume_of_pages(const TiffFile& file, const PageList& list,
                                             const Page& page, const VolumeChoice& choice) {
  const std::string& path = file.path();
  const auto pages = static_cast<std::int64_t>(list.slices.size());
  TiffLayout layout = tiff_layout(
      list.text, pages, {page.width, page.height, page.samples, list.slices.back() + 1}, path);
  VolumeAxis frames = {AxisKind::Frame, 1};
  std::vector<std::int64_t> places;
  std::int64_t slices = 1;
  for (const VolumeAxis& axis : layout.axes) {
    if (axis.kind == AxisKind::Space) slices *= axis.count;
    if (axis.kind == AxisKind::Frame && axis.count > 1) {
      if (frames.count > 1) {
        refuse_volume(path, "has two dimensions besides space, of " + std::to_string(frames.count) +
                                " and " + std::to_string(axis.count) +
                                " places. Save only one volume.");
      }
      frames.count = axis.count;
    }
  }
  if (slices == 1 && pages > 1 && !layout.writer.empty()) {
    refuse_volume(path, "has one slice: " + layout.writer + "'s text says that its " +
                            std::to_string(pages) +
                            " pages are channels or frames. If they are slices, save it again with "
                            "the axes ZYX.");
  }
  // Each kind of dimension is selected once.
  const std::int64_t channel = chosen_place(channels_of(layout, page, path), choice, path);
  const std::int64_t frame = chosen_place(frames, choice, path);
  for (const VolumeAxis& axis : layout.axes) {
    const bool has_more = axis.count > 1;
    places.push_back(!has_more                        ? 0
                     : axis.kind == AxisKind::Channel ? channel
                     : axis.kind == AxisKind::Frame   ? frame
                                                      : 0);
  }
  VolumeGeometry geometry;
  geometry.counts = voxel_counts({page.width, page.height, slices}, path);
  set_lattice_of_tiff(geometry, file, page, layout, choice);
  std::unique_ptr<LabelVolume> volume;
  if (layout.may_be_one_block) {
    // Above 4 GiB, ImageJ writes one page, then all voxels uncompressed.
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_COMPRESSION, &compression);
    std::uint64_t* offsets = nullptr;
    if (compression != COMPRESSION_NONE || TIFFIsTiled(file.get()) != 0 || page.bits < 8 ||
        page.samples > 1 || TIFFGetField(file.get(), TIFFTAG_STRIPOFFSETS, &offsets) == 0) {
      std::int64_t images = 1;
      for (const VolumeAxis& axis : layout.axes) images *= axis.count;
      file.fail("has one page of the " + std::to_string(images) + " that " + layout.writer +
                " noted");
    }
    VoxelType type = page.type;
    type.big_endian = TIFFIsBigEndian(file.get()) != 0;
    std::vector<VolumeAxis> axes = {{AxisKind::Space, page.width}, {AxisKind::Space, page.height}};
    axes.insert(axes.end(), layout.axes.begin(), layout.axes.end());
    VoxelData data;
    data.paths = {path};
    data.offset = offsets[0];
    data.picks = picks_of(axes, choice, path);
    volume = volume_of_files(geometry, type, data);
  } else {
    volume = std::make_unique<TiffStack>(geometry, page, channel, std::vector<std::string>{path},
                                         slices_of(layout, list.slices, places));
  }
  volume->set_offset(layout.offset);
  add_notes(layout, list, page, choice, *volume);
  return volume;
}

/// Reads what the text of a slice, a file of its own, says of all.
TiffLayout layout_of_slice(const TiffFile& file, const PageList& list) {
  TiffLayout layout = slice_layout(list.text, file.path());
  const std::optional<Vector3> resolution = voxel_of_resolution(file);
  if (layout.writer != "ImageJ" || layout.voxel_size.z() > 0.0 || !resolution) return layout;
  std::uint16_t unit = RESUNIT_INCH;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
  layout.voxel_size.z() = resolution->x() / (unit == RESUNIT_INCH ? 2.54 : 1.0);
  layout.notes.push_back(
      "ImageJ noted no distance of slices: along z as along x. Give another by " +
      mention("voxel-size", "X,Y,Z") + ".");
  return layout;
}

/// Keeps the size of the first slices' voxels if this slice, the file `path`, says the same.
/// Otherwise no size is known. Refuses another shift of the numbers.
void take_size_of_slice(const TiffLayout& slice, const std::optional<Vector3>& first_resolution,
                        const std::optional<Vector3>& resolution, const std::string& path,
                        TiffLayout& layout) {
  if (slice.offset != layout.offset) {
    refuse_volume(path,
                  "has another calibration of its numbers than the slices before it. Save "
                  "all slices alike.");
  }
  if (!layout.differing.empty()) return;
  const auto differ = [](const Vector3& a, const Vector3& b) {
    return (a - b).cwiseAbs().maxCoeff() > 1e-4 * b.cwiseAbs().maxCoeff();
  };
  const Vector3 none = Vector3::Zero();
  if (slice.writer == layout.writer && slice.unit == layout.unit &&
      !differ(slice.voxel_size, layout.voxel_size) &&
      !differ(resolution.value_or(none), first_resolution.value_or(none))) {
    return;
  }
  layout.differing = std::filesystem::path(path).filename().string();
}

std::unique_ptr<LabelVolume> volume_of_page_files(const SliceFiles& slices, const TiffFile& first,
                                                  const PageList& list, const Page& page,
                                                  const VolumeChoice& choice) {
  std::vector<SlicePage> pages;
  PageList all;
  TiffLayout layout = layout_of_slice(first, list);
  const std::optional<Vector3> resolution = voxel_of_resolution(first);
  check_ome_slices(list.text, slices.paths);
  for (std::size_t k = 0; k < slices.paths.size(); ++k) {
    const TiffFile file(slices.paths[k]);
    const PageList of_slice = list_pages(file);
    const std::size_t count = of_slice.slices.size();
    all.left_out += of_slice.left_out;
    if (count > 1) {
      refuse_volume(slices.paths[k],
                    "has " + std::to_string(count) +
                        " pages, but a folder is one volume, whose files are slices of "
                        "one page. Save all slices in one file, or one in each.");
    }
    const Page here = page_of(file);
    if (!(here == page)) {
      refuse_volume(slices.paths[k], "is a slice of " + here.text() +
                                         ", but the slices before it have " + page.text() +
                                         ". Save all slices alike.");
    }
    take_size_of_slice(layout_of_slice(file, of_slice), resolution, voxel_of_resolution(file),
                       file.path(), layout);
    pages.push_back({k, of_slice.slices.front()});
  }
  const std::int64_t channel = chosen_place(channels_of(page), choice, slices.folder);
  chosen_place({AxisKind::Frame, 1}, choice, slices.folder);
  VolumeGeometry geometry;
  geometry.counts = voxel_counts({page.width, page.height, static_cast<std::int64_t>(pages.size())},
                                 slices.folder);
  set_lattice_of_tiff(geometry, first, page, layout, choice);
  std::unique_ptr<LabelVolume> volume =
      std::make_unique<TiffStack>(geometry, page, channel, slices.paths, std::move(pages));
  volume->set_offset(layout.offset);
  add_notes(layout, all, page, choice, *volume);
  return volume;
}

}  // namespace

std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices,
                                              const VolumeChoice& choice) {
  refuse_array_choice(choice, slices.folder);
  const TiffFile first(slices.paths.front());
  const PageList list = list_pages(first);
  Page page = page_of(first);
  page.shows_colours = page.shows_colours && !choice.channel;
  page.has_alpha = page.has_alpha && !choice.channel;
  std::unique_ptr<LabelVolume> volume =
      slices.paths.size() == 1 ? volume_of_pages(first, list, page, choice)
                               : volume_of_page_files(slices, first, list, page, choice);
  if (page.shows_0_as_white) {
    volume->add_note(
        "The TIFF shows 0 as white. Its numbers were used unchanged. This is correct if the space "
        "between the grains is white. Otherwise give " +
        mention("background") + ", or to segment it " + mention("dark") + ".");
  }
  return volume;
}

#else

std::unique_ptr<LabelVolume> open_tiff_slices(const SliceFiles& slices, const VolumeChoice&) {
  refuse_volume(slices.folder,
                "cannot be read: this program was built without libtiff. Install libtiff-dev "
                "and build it again, or save the volume as .nrrd.");
}

#endif

}  // namespace wscvt
