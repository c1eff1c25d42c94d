// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef WSCVT_HAS_TIFF
#include <tiffio.h>

#include <cstdarg>
#include <cstdint>
#include <string>

namespace wscvt {

/// One open TIFF. What libtiff says of an error is kept for the sentence.
class TiffFile {
 public:
  /// Throws Error(InputOutput) for what is no TIFF.
  explicit TiffFile(const std::string& path);
  TiffFile(const TiffFile&) = delete;
  TiffFile& operator=(const TiffFile&) = delete;
  ~TiffFile() { TIFFClose(tiff_); }

  TIFF* get() const { return tiff_; }
  const std::string& path() const { return path_; }

  /// The most that a strip or tile of the file could be unpacked to.
  std::uint64_t most_bytes() const { return most_; }

  /// How many there are. A file that was cut has lost the way to the others, and libtiff ends
  /// there: throws Error(InputOutput).
  std::int64_t pages() const;

  /// The text that the program which wrote the file left on the first page; empty: none.
  std::string description() const;

  /// Throws Error(InputOutput): "path" + what, and what libtiff said.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  static int note_error(TIFF*, void* self, const char*, const char* format, va_list arguments);
  static int pass_over(TIFF*, void*, const char*, const char*, va_list) { return 1; }

  std::string path_;
  std::string said_;
  std::uint64_t most_ = 0;
  TIFF* tiff_ = nullptr;
};

}  // namespace wscvt
#endif
