// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What Debian's emscripten does not have, and what includes it expects: this comes before every
// file.
#ifdef __cplusplus

// Eigen shall have packets of two doubles as on x86. It then includes the header of MMX, of which
// it uses nothing, and has assembler against optimisations that the build does not ask for and
// against faults of old GCC.
#define __MMINTRIN_H
// A matrix product adds up in blocks, whose sizes Eigen takes from the number of registers and the
// caches. It has other numbers for machines that it does not know.
#define EIGEN_ARCH_DEFAULT_NUMBER_OF_REGISTERS 16
#define EIGEN_DEFAULT_L1_CACHE_SIZE (32 * 1024)
#define EIGEN_DEFAULT_L2_CACHE_SIZE (256 * 1024)
#define EIGEN_DEFAULT_L3_CACHE_SIZE (2 * 1024 * 1024)
#define EIGEN_OPTIMIZATION_BARRIER(X)
#include <Eigen/src/Core/util/Macros.h>
#undef EIGEN_COMP_GNUC
#define EIGEN_COMP_GNUC 0
#include <Eigen/Core>
// CGAL has assembler for it.
#undef __SSE2__

#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

// Conversions between double and text. They give the same bytes as those of GCC's library for what
// the library asks: emscripten's C library rounds correctly in both directions.
namespace std {

inline to_chars_result wscvt_copied(char* first, char* last, const string& text) {
  if (text.size() > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

template <class... Values>
string wscvt_printed(const char* format, Values... values) {
  string text(static_cast<size_t>(snprintf(nullptr, 0, format, values...)), '\0');
  snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

/// The fewest digits that read back as the value, as d.ddde+xx.
inline string wscvt_shortest(double value) {
  for (int digits = 0; digits < 16; ++digits) {
    const string text = wscvt_printed("%.*e", digits, value);
    if (strtod(text.c_str(), nullptr) == value) return text;
  }
  return wscvt_printed("%.16e", value);
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format format,
                                int precision) {
  const char letter[] = {'%', '.', '*', format == chars_format::general ? 'g' : 'f', '\0'};
  return wscvt_copied(first, last, wscvt_printed(letter, precision, value));
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format) {
  if (!(value - value == 0.0)) return wscvt_copied(first, last, wscvt_printed("%f", value));
  const string text = wscvt_shortest(value);
  const size_t mark = text.find('e');
  const int digits = mark > 1 + (value < 0.0) ? static_cast<int>(mark) - 2 - (text[0] == '-') : 0;
  const int decimals = digits - atoi(text.c_str() + mark + 1);
  if (decimals >= 0) return wscvt_copied(first, last, wscvt_printed("%.*f", decimals, value));
  // A large whole number has all of its digits.
  return wscvt_copied(first, last, wscvt_printed("%.0f", value));
}

/// The shorter of both forms; of equal ones that without an exponent.
inline to_chars_result to_chars(char* first, char* last, double value) {
  if (!(value - value == 0.0)) return wscvt_copied(first, last, wscvt_printed("%f", value));
  char fixed[400];
  const to_chars_result end = to_chars(fixed, fixed + sizeof fixed, value, chars_format::fixed);
  const string other = wscvt_shortest(value);
  const string plain(fixed, end.ptr);
  return wscvt_copied(first, last, plain.size() <= other.size() ? plain : other);
}

inline from_chars_result from_chars(const char* first, const char* last, double& value,
                                    chars_format = chars_format::general) {
  // strtod also takes blanks, a plus sign and hexadecimal digits.
  size_t length = 0;
  const size_t size = static_cast<size_t>(last - first);
  while (length < size && strchr("0123456789+-.eEinfatyINFATY", first[length]) != nullptr &&
         first[length] != '\0') {
    ++length;
  }
  if (length == 0 || first[0] == '+') return {first, errc::invalid_argument};
  const string text(first, length);
  char* end = nullptr;
  const double read = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* const rest = first + (end - text.c_str());
  const bool overflows = read - read != 0.0 && text.find_first_of("nN") == string::npos;
  const bool underflows = read == 0.0 && text.find_first_of("123456789") < text.find_first_of("eE");
  if (overflows || underflows) return {rest, errc::result_out_of_range};
  value = read;
  return {rest, errc()};
}

}  // namespace std

#endif
