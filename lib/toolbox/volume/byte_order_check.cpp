// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/byte_order_check.h"

#include <boost/endian/conversion.hpp>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "toolbox/volume/volume_choice.h"
#include "wscvt/base/text.h"

namespace wscvt {

namespace {

constexpr std::int64_t most_rows = 4096;
constexpr std::size_t enough_values = 3;
constexpr double far_more = 6.0;

/// The bits of a number.
template <std::size_t Bytes>
using BitsOf = std::conditional_t<Bytes == 2, std::uint16_t,
                                  std::conditional_t<Bytes == 4, std::uint32_t, std::uint64_t>>;

template <class Value>
Value value_of(BitsOf<sizeof(Value)> bits) {
  Value value{};
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Whether a float, other than 0, is none that a scan has.
template <class Value>
bool is_odd(Value value) {
  constexpr Value most = 1e15F;
  const Value size = std::abs(value);
  return !(size < most && size * most > Value{1});
}

/// Says that the numbers of a file are in the wrong byte order.
Sentence sentence_of_order(const VoxelType& type, const std::string& path) {
  const std::string found =
      "has numbers whose bytes are in the wrong order: neighbours are alike only in the other. ";
  const std::string ending = ending_of(path);
  if (ending == ".tif" || ending == ".tiff") {
    return found +
           "Import the raw numbers again in the other order (Fiji: Little-endian byte order), and "
           "save them again.";
  }
  const std::string right = type.big_endian ? "little" : "big";
  return found + "Correct the header (\"byte_order\": \"" + right +
         "\" in .json, endian: " + right +
         " in .nrrd, BinaryDataByteOrderMSB = " + (type.big_endian ? "False" : "True") +
         " in .mhd), or export the file again.";
}

}  // namespace

ByteOrderCheck::ByteOrderCheck(const VoxelType& type, const VoxelCounts& counts)
    : type_(type), width_(counts[0]), step_(std::int64_t{counts[1]} * counts[2] / most_rows + 1) {}

template <class Value>
void ByteOrderCheck::take_values(const char* bytes) {
  using Bits = BitsOf<sizeof(Value)>;
  double before = 0.0;
  double swapped_before = 0.0;
  bool has_before = false;  // a float
  for (std::int64_t k = 0; k < width_; ++k) {
    Bits bits = 0;
    std::memcpy(&bits, bytes + static_cast<std::size_t>(k) * sizeof(Bits), sizeof(Bits));
    bits = type_.big_endian ? boost::endian::big_to_native(bits)
                            : boost::endian::little_to_native(bits);
    const auto value = value_of<Value>(bits);
    const auto swapped = value_of<Value>(boost::endian::endian_reverse(bits));
    if constexpr (std::is_floating_point_v<Value>) {
      if (bits == 0 || std::isnan(value) || std::isnan(swapped)) continue;  // not scanned
      ++floats_;
      odd_ += is_odd(value) ? 1 : 0;
      swapped_odd_ += is_odd(swapped) ? 1 : 0;
      const double exponent = std::logb(value);
      const double swapped_exponent = std::logb(swapped);
      if (has_before && std::isfinite(exponent) && std::isfinite(swapped_exponent)) {
        differences_ += std::abs(exponent - before);
        swapped_differences_ += std::abs(swapped_exponent - swapped_before);
      }
      has_before = std::isfinite(exponent) && std::isfinite(swapped_exponent);
      before = exponent;
      swapped_before = swapped_exponent;
    } else {
      const auto number = static_cast<double>(value);
      const auto swapped_number = static_cast<double>(swapped);
      if (k > 0) {
        differences_ += std::abs(number - before);
        swapped_differences_ += std::abs(swapped_number - swapped_before);
      }
      before = number;
      swapped_before = swapped_number;
      if (bits == 0) continue;
      if (values_.size() < enough_values) values_.insert(bits);
      has_low_bytes_ = has_low_bytes_ || ((bits ^ *values_.begin()) & 0xffU) != 0;
    }
  }
}

void ByteOrderCheck::take(const char* bytes) {
  visit_number_type(type_, [&](auto number) {
    if constexpr (sizeof(number) > 1) take_values<decltype(number)>(bytes);
  });
}

bool ByteOrderCheck::is_swapped() const {
  if (type_.is_float) {
    constexpr std::int64_t part = 4;
    constexpr std::int64_t rare = 100;
    if (odd_ * part > floats_ && swapped_odd_ * rare < floats_) return true;
    // In the right order, neighbours have exponents of 2 that are near each other.
    constexpr double far = 5.0;
    return differences_ > far * static_cast<double>(floats_) &&
           differences_ > far_more * swapped_differences_;
  }
  // Two labels may be anything. Noise of a scan hides nothing up to a twentieth of its range.
  return values_.size() == enough_values && (type_.bytes > 2 || has_low_bytes_) &&
         differences_ > far_more * swapped_differences_;
}

void ByteOrderCheck::refuse_swapped(const std::string& path) const {
  if (is_swapped()) refuse_volume(path, sentence_of_order(type_, path));
}

void ByteOrderCheck::finish(LabelVolume& volume, bool as_grey, const std::string& path) {
  if (is_finished_) return;
  if (as_grey) refuse_swapped(path);
  if (is_swapped()) volume.add_warning("\"" + path + "\" " + sentence_of_order(type_, path));
  is_finished_ = true;
}

}  // namespace wscvt
