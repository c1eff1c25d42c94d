// SPDX-License-Identifier: GPL-3.0-or-later
// Two parts of the C library of MinGW that this program needs otherwise. The linker takes those
// that come before the library.
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <cwchar>

namespace {

constexpr std::size_t is_invalid = static_cast<std::size_t>(-1);
constexpr std::size_t is_cut = static_cast<std::size_t>(-2);

/// Returns the number of bytes of the character that begins with `first`; 0 if none begins so.
std::size_t bytes_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xc2) return 0;
  if (first < 0xe0) return 2;
  if (first < 0xf0) return 3;
  return first < 0xf5 ? 4 : 0;
}

/// Returns the character of `count` bytes. A value that no character has if the bytes are none.
std::uint32_t character(const unsigned char* bytes, std::size_t count) {
  constexpr std::uint32_t none = 0xd800;
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  if (count == 1) return bytes[0];
  std::uint32_t value = bytes[0] & (0x7fU >> count);
  for (std::size_t k = 1; k < count; ++k) {
    if ((bytes[k] & 0xc0U) != 0x80U) return none;
    value = value << 6U | (bytes[k] & 0x3fU);
  }
  return value < smallest[count] || value > 0x10ffff ? none : value;
}

}  // namespace

// No star in a call is replaced before the program reads it: its own patterns are those of the
// help.
extern "C" {
extern int _CRT_glob;
int _CRT_glob = 0;
}

// Names of files are UTF-8. The manifest says so to Windows. It cannot say so to
// std::filesystem::path of GCC, which asks this function for the wide characters of a name. The
// library's takes the bytes for Latin-1. A character beyond 16 bits has two wide ones. The first
// one counts three of its bytes. The second one waits in the state for the last byte.
extern "C" std::size_t mbrtowc(wchar_t* wide, const char* text, std::size_t size,
                               std::mbstate_t* state) {
  static thread_local std::mbstate_t own;
  if (state == nullptr) state = &own;
  if (text == nullptr) return *state = 0, 0;
  if (size == 0) return is_cut;
  if (*state != 0) {
    if (wide != nullptr) *wide = static_cast<wchar_t>(*state);
    *state = 0;
    return 1;
  }
  unsigned char bytes[4] = {};
  std::memcpy(bytes, text, 1);
  const std::size_t count = bytes_of(bytes[0]);
  if (count != 0 && size < count) return is_cut;
  if (count != 0) std::memcpy(bytes, text, count);
  const std::uint32_t value = count == 0 ? 0xd800 : character(bytes, count);
  if (value >= 0xd800 && value < 0xe000) {
    errno = EILSEQ;
    return is_invalid;
  }
  if (value < 0x10000) {
    if (wide != nullptr) *wide = static_cast<wchar_t>(value);
    return value == 0 ? 0 : count;
  }
  if (wide != nullptr) *wide = static_cast<wchar_t>(0xd800 + ((value - 0x10000) >> 10U));
  *state = static_cast<std::mbstate_t>(0xdc00 + ((value - 0x10000) & 0x3ffU));
  return 3;
}

// The library has this one in the same file, so that both come from here.
extern "C" std::size_t mbrlen(const char* text, std::size_t size, std::mbstate_t* state) {
  static thread_local std::mbstate_t own;
  return mbrtowc(nullptr, text, size, state == nullptr ? &own : state);
}
