// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <tiffio.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/made_volume.h"

namespace wscvt::test {

/// How pages of a TIFF are written.
struct TiffPages {
  std::string mode = "w";  ///< "w", "wb", "wl", "w8"; "a" adds pages to a file
  int width = 0;
  int height = 0;
  int bits = 16;
  int samples = 1;
  bool is_planar = false;  ///< samples one behind the other
  int format = SAMPLEFORMAT_UINT;
  int compression = COMPRESSION_NONE;
  int rows = 2;       ///< of a strip
  bool pads = false;  ///< zeros behind each page, packed by zlib, make one strip of `rows`
  int tile = 0;       ///< side of a tile; 0: strips
  int photometric = PHOTOMETRIC_MINISBLACK;
  int orientation = ORIENTATION_TOPLEFT;
  int extra = -1;           ///< kind of the last sample, EXTRASAMPLE_...; -1: none is extra
  int marks = 0;            ///< bits of NewSubfileType
  int depth = 1;            ///< slices of a page
  int behind_first = 0;     ///< number of the pages after the first that are its SubIFDs
  std::string text;         ///< of the first page
  double resolution = 0.0;  ///< along x; half of it along y; 0: none
  int resolution_unit = RESUNIT_INCH;
};

/// Writes pages of bytes: rows of packed numbers one behind the other, of planar pages those of the
/// first sample before those of the second.
inline void write_tiff(const std::string& path, const TiffPages& as,
                       const std::vector<std::string>& pages) {
  TIFF* const file = TIFFOpen(path.c_str(), as.mode.c_str());
  ASSERT_NE(file, nullptr);
  for (std::size_t k = 0; k < pages.size(); ++k) {
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, as.width);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, as.height);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, as.bits);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, as.samples);
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, as.format);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, as.photometric);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG,
                 as.is_planar ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_COMPRESSION, as.compression);
    TIFFSetField(file, TIFFTAG_ORIENTATION, as.orientation);
    TIFFSetField(file, TIFFTAG_SUBFILETYPE, as.marks);
    if (as.depth > 1) TIFFSetField(file, TIFFTAG_IMAGEDEPTH, as.depth);
    if (as.extra >= 0) {
      const auto kind = static_cast<std::uint16_t>(as.extra);
      TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &kind);
    }
    if (k == 0 && as.behind_first > 0) {
      const std::vector<std::uint64_t> places(static_cast<std::size_t>(as.behind_first));
      TIFFSetField(file, TIFFTAG_SUBIFD, as.behind_first, places.data());
    }
    if (k == 0 && !as.text.empty()) {
      TIFFSetField(file, TIFFTAG_IMAGEDESCRIPTION, as.text.c_str());
    }
    if (as.resolution > 0.0) {
      TIFFSetField(file, TIFFTAG_XRESOLUTION, as.resolution);
      TIFFSetField(file, TIFFTAG_YRESOLUTION, as.resolution / 2.0);
      TIFFSetField(file, TIFFTAG_RESOLUTIONUNIT, as.resolution_unit);
    }
    const std::size_t in_row = as.is_planar ? 1 : static_cast<std::size_t>(as.samples);
    const std::size_t row_bytes =
        (static_cast<std::size_t>(as.width) * in_row * static_cast<std::size_t>(as.bits) + 7) / 8;
    const auto height = static_cast<std::size_t>(as.height);
    std::string page = pages[k];
    const int planes = as.is_planar ? as.samples : 1;
    ASSERT_EQ(page.size(), row_bytes * height * static_cast<std::size_t>(planes));
    if (as.pads) {
      TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, as.rows);
      page.resize(row_bytes * static_cast<std::size_t>(as.rows));
      std::string strip = packed(page, false);
      ASSERT_GT(TIFFWriteRawStrip(file, 0, strip.data(), static_cast<tmsize_t>(strip.size())), 0);
    } else if (as.tile == 0) {
      TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, as.rows);
      for (int plane = 0; plane < planes; ++plane) {
        for (std::size_t y = 0; y < height; ++y) {
          char* const row =
              page.data() + (static_cast<std::size_t>(plane) * height + y) * row_bytes;
          ASSERT_EQ(TIFFWriteScanline(file, row, static_cast<std::uint32_t>(y),
                                      static_cast<std::uint16_t>(plane)),
                    1);
        }
      }
    } else {
      TIFFSetField(file, TIFFTAG_TILEWIDTH, as.tile);
      TIFFSetField(file, TIFFTAG_TILELENGTH, as.tile);
      const std::size_t tile_row =
          static_cast<std::size_t>(as.tile) * in_row * static_cast<std::size_t>(as.bits) / 8;
      for (int top = 0; top < as.height; top += as.tile) {
        for (int left = 0; left < as.width; left += as.tile) {
          // What lies beyond the rim is to be passed over.
          std::string tile(tile_row * static_cast<std::size_t>(as.tile), '\x63');
          const std::size_t begin = static_cast<std::size_t>(left / as.tile) * tile_row;
          for (int y = top; y < std::min(top + as.tile, as.height); ++y) {
            const std::string part = page.substr(static_cast<std::size_t>(y) * row_bytes + begin,
                                                 std::min(tile_row, row_bytes - begin));
            tile.replace(static_cast<std::size_t>(y - top) * tile_row, part.size(), part);
          }
          ASSERT_GT(TIFFWriteTile(file, tile.data(), static_cast<std::uint32_t>(left),
                                  static_cast<std::uint32_t>(top), 0, 0),
                    0);
        }
      }
    }
    ASSERT_EQ(TIFFWriteDirectory(file), 1);
  }
  TIFFClose(file);
}

}  // namespace wscvt::test
