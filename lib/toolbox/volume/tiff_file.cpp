// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/tiff_file.h"

#ifdef WSCVT_HAS_TIFF
#include <algorithm>
#include <cstdio>
#include <new>

#include "toolbox/volume/voxel_rows.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

TiffFile::TiffFile(const std::string& path) : path_(path) {
  // Refuses strips for which a damaged file claims more than they could unpack to.
  most_ = std::min<std::uint64_t>(1U << 30, 1100 * file_size(path) + (1 << 20));
  TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
  if (options == nullptr) throw std::bad_alloc();
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(most_));
  TIFFOpenOptionsSetErrorHandlerExtR(options, note_error, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options, pass_over, nullptr);
  tiff_ = TIFFOpenExt(path.c_str(), "r", options);
  TIFFOpenOptionsFree(options);
  if (tiff_ == nullptr) fail("is not a TIFF file");
}

std::int64_t TiffFile::pages() const {
  const std::int64_t count = TIFFNumberOfDirectories(tiff_);
  if (!said_.empty()) fail("has lost pages");
  return count;
}

std::string TiffFile::description() const {
  char* text = nullptr;
  if (TIFFGetField(tiff_, TIFFTAG_IMAGEDESCRIPTION, &text) == 0 || text == nullptr) return "";
  return text;
}

void TiffFile::fail(const std::string& what) const {
  refuse_volume(path_,
                what + (said_.empty() ? "" : " (" + shown(said_) + ")") + ". Export it again.");
}

int TiffFile::note_error(TIFF*, void* self, const char*, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  auto& said = static_cast<TiffFile*>(self)->said_;
  if (said.empty()) said = text;
  return 1;
}

}  // namespace wscvt
#endif
