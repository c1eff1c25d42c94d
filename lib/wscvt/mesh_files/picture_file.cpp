// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "wscvt/base/error.h"
#include "wscvt/mesh_files/readers.h"

#ifdef WSCVT_HAS_STB_IMAGE
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MAX_DIMENSIONS (1 << 16)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop
#endif

namespace wscvt {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::InputOutput, "\"" + path + "\" " + what);
}

}  // namespace

#ifdef WSCVT_HAS_STB_IMAGE

TexturePicture read_picture(const std::string& path) {
  constexpr double most_pixels = 4e8;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) fail(path, "is not there or is no file.");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr) fail(path, "cannot be opened.");
  TexturePicture picture;
  int parts = 0;
  const bool is_known =
      stbi_info_from_file(file.get(), &picture.width, &picture.height, &parts) != 0;
  if (is_known && static_cast<double>(picture.width) * picture.height > most_pixels) {
    fail(path, "is larger than 400 million pixels. Save it smaller.");
  }
  // Pictures of one colour shrink to a hundredth of a byte a pixel. Large ones would only fill the
  // memory.
  constexpr double always_read = 5e7;
  constexpr double most_pixels_a_byte = 100.0;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  const double pixels_held = static_cast<double>(picture.width) * picture.height;
  if (is_known && !error && pixels_held > always_read &&
      pixels_held > most_pixels_a_byte * static_cast<double>(bytes)) {
    fail(path, "holds nearly nothing for its " + std::to_string(picture.width) + " x " +
                   std::to_string(picture.height) + " pixels. Save it smaller.");
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      is_known ? stbi_load_from_file(file.get(), &picture.width, &picture.height, &parts, 3)
               : nullptr,
      &stbi_image_free);
  if (pixels == nullptr && std::string_view(stbi_failure_reason()) == "outofmem") {
    throw std::bad_alloc();
  }
  if (pixels == nullptr) fail(path, "is not a readable picture, or is cut short.");
  const std::size_t size = std::size_t{3} * static_cast<std::size_t>(picture.width) *
                           static_cast<std::size_t>(picture.height);
  picture.colours.assign(pixels.get(), pixels.get() + size);
  return picture;
}

#else

TexturePicture read_picture(const std::string& path) {
  fail(path, "cannot be read: this wscvt was built without Debian's package libstb-dev.");
}

#endif

}  // namespace wscvt
