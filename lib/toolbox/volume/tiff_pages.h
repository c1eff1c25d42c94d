// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiffio.h>

#include <cstdarg>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "toolbox/volume/tiff_layout.h"
#include "toolbox/volume/voxel_rows.h"

namespace wscvt {

/// An open TIFF. Errors of libtiff are kept for the message.
class TiffFile {
 public:
  /// Throws Error(InputOutput) for a file that is no TIFF.
  explicit TiffFile(const std::string& path);
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;
  ~TiffFile() { TIFFClose(tiff_); }

  TIFF* get() const { return tiff_; }
  const std::string& path() const { return path_; }

  /// Returns the largest possible size of an unpacked strip or tile of the file.
  std::uint64_t most_bytes() const { return most_; }

  /// Returns the number of pages. Throws Error(InputOutput) for a file that was cut, because
  /// libtiff cannot reach its other pages.
  std::int64_t pages() const;

  /// Returns the text that the writing program left on the current page; empty if there is none.
  std::string description() const;

  /// Throws Error(InputOutput): "path" + what, and libtiff's error.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  static int note_error(TIFF*, void* self, const char*, const char* format, va_list arguments);

  std::string path_;
  std::string said_;
  std::uint64_t most_ = 0;
  TIFF* tiff_ = nullptr;
};

/// Size and type of a page.
struct TiffPage {
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

  bool operator==(const TiffPage& other) const {
    return width == other.width && height == other.height && bits == other.bits &&
           type.has_sign == other.type.has_sign && type.is_float == other.type.is_float &&
           samples == other.samples && is_planar == other.is_planar;
  }

  std::string text() const {
    return std::to_string(width) + " x " + std::to_string(height) + " voxels of " +
           std::to_string(samples) + " x " + std::to_string(bits) + " bits";
  }
};

/// Reads the current page. Throws Error(InputOutput), naming the file, for one that is not of plain
/// numbers.
TiffPage page_of(const TiffFile& file);

/// The pages of a file that are slices.
struct TiffPageList {
  std::vector<std::uint32_t> slices;  ///< numbers of pages, from 0
  std::int64_t left_out = 0;          ///< number of reduced images and masks of others
  std::int64_t marked = 0;  ///< number of slices that are marked as reduced, but are as large
  std::string text;         ///< of the first slice; without one, of the first page
};

/// Finds the slices: all pages but those marked as reduced images or masks, the smaller levels of a
/// pyramid, and one or two smaller pages before or behind the slices. Other pages of another form
/// are listed, so that they are refused by name. The first slice becomes the current page.
TiffPageList list_pages(const TiffFile& file);

/// Returns the size of a voxel along x and y from the resolution of a page, in centimetres if the
/// page has a unit; nothing without a resolution.
std::optional<Vector3> voxel_of_resolution(const TiffFile& file);

/// Sets the lattice from the text of ImageJ or OME, or from the page's resolution. Adds to the
/// layout's notes. Throws Error(InputOutput), naming the file, for axes in several units.
void set_lattice_of_tiff(VolumeGeometry& geometry, const TiffFile& file, const TiffPage& page,
                         TiffLayout& layout, const VolumeChoice& choice);

/// A slice: a page of a file.
struct SlicePage {
  std::size_t file = 0;
  std::uint32_t page = 0;
};
/// Returns the volume of slices that are pages of one file, or files of one page. `sample`: number
/// of the selected sample of each voxel. Its rows throw Error(InputOutput), naming the file, for a
/// page unlike `page` or damaged, for colours that are not equal and for an alpha that is not
/// constant.
std::unique_ptr<LabelVolume> volume_of_slices(const VolumeGeometry& geometry, const TiffPage& page,
                                              std::int64_t sample, std::vector<std::string> files,
                                              std::vector<SlicePage> slices);

}  // namespace wscvt
