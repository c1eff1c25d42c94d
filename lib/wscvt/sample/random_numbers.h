// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace wscvt {

/// A generator of random numbers that gives the same numbers with every compiler (SplitMix64;
/// Steele, Lea and Flood 2014). Numbers with different `stream` do not depend on each other, so
/// that each repetition of a loop can have a generator of its own on any thread.
class RandomNumbers {
 public:
  RandomNumbers(std::uint64_t seed, std::uint64_t stream)
      : state_(mixed(seed) ^ mixed(~stream * 0xd1342543de82ef95ULL)) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    return mixed(state_);
  }

  /// Uniform among 0 to count - 1, for counts from 1 to 2^32; off by less than 2^-32.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(((next() >> 32) * static_cast<std::uint64_t>(count)) >> 32);
  }

 private:
  static std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
    return bits ^ (bits >> 31);
  }

  std::uint64_t state_;
};

}  // namespace wscvt
