// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace wscvt::test {

/// Where random bodies and options take their choices from: bytes that a fuzzer changes, and after
/// their end a generator seeded by them, so that few bytes make a whole body. Without bytes all
/// choices follow from the seed.
class Choices {
 public:
  explicit Choices(std::uint64_t seed) : engine_(seed) {}
  Choices(const std::uint8_t* bytes, std::size_t count) : bytes_(bytes), count_(count) {
    std::uint64_t hash = 1469598103934665603U;  // FNV-1a
    for (std::size_t i = 0; i < count; ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
    engine_.seed(hash);
  }

  std::uint8_t byte() {
    return place_ < count_ ? bytes_[place_++] : static_cast<std::uint8_t>(engine_());
  }
  std::uint32_t word() {
    std::uint32_t result = 0;
    for (int i = 0; i < 4; ++i) result = result << 8U | byte();
    return result;
  }
  /// In [low, high].
  int whole(int low, int high) {
    const auto span = static_cast<std::uint32_t>(high - low);
    const std::uint32_t value = span < 256 ? byte() : word();
    return low + static_cast<int>(value % (span + 1));
  }
  std::size_t below(std::size_t count) { return word() % count; }
  double real(double low, double high) { return low + (high - low) * (word() / 4294967296.0); }
  /// True once in `count`.
  bool one_in(int count) { return whole(0, count - 1) == 0; }

 private:
  const std::uint8_t* bytes_ = nullptr;
  std::size_t count_ = 0;
  std::size_t place_ = 0;
  std::mt19937_64 engine_;
};

}  // namespace wscvt::test
