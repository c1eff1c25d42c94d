// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#ifdef WSCVT_HAS_TIFF
#include <tiffio.h>

#include <cstdarg>
#include <cstdint>
#include <string>

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

  /// Returns the text that the writing program left on the first page; empty if there is none.
  std::string description() const;

  /// Throws Error(InputOutput): "path" + what, and libtiff's error.
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
