// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

/// Random numbers by SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number
/// generators", OOPSLA) and own arithmetic, so that a seed gives the same numbers with every
/// compiler. Streams of different keys are independent, so each grain has its own, whatever thread
/// uses it.
class RandomStream {
 public:
  /// The stream of a seed for the keys, such as the grain's number and the attempt.
  RandomStream(std::uint64_t seed, std::uint64_t key, std::uint64_t second_key = 0)
      : state_(
            mixed(mixed(mixed(seed + golden) ^ (key + 1) * golden) ^ (second_key + 1) * golden)) {}

  std::uint64_t bits() {
    state_ += golden;
    return mixed(state_);
  }
  /// Returns a number in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  /// Returns a whole number below `count` >= 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }
  /// Returns a normal number, mean 0, deviation 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * portable::log(1.0 - uniform()));
    return radius * portable::cos(2.0 * pi * uniform());
  }
  /// Returns a direction, uniform on the sphere.
  Vector3 direction() {
    const double z = uniform(-1.0, 1.0);
    const double azimuth = 2.0 * pi * uniform();
    const double sine = std::sqrt((1.0 - z) * (1.0 + z));
    return {sine * portable::cos(azimuth), sine * portable::sin(azimuth), z};
  }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  static std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }
  std::uint64_t state_;
};

/// Returns the place of number `index` of `count` in a random permutation given by the seed and the
/// key. Takes the same time for any count (a Feistel network of six rounds).
inline std::size_t drawn_place(std::size_t index, std::size_t count, std::uint64_t seed,
                               std::uint64_t key) {
  unsigned half = 1;
  while ((count - 1) >> (2 * half) != 0) ++half;
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  std::uint64_t place = index;
  do {
    std::uint64_t left = place >> half, right = place & mask;
    for (std::uint64_t round = 0; round < 6; ++round) {
      const std::uint64_t next =
          left ^ (RandomStream(seed, key, (round << 32) + right).bits() & mask);
      left = right;
      right = next;
    }
    place = (left << half) + right;
  } while (place >= count);
  return static_cast<std::size_t>(place);
}

}  // namespace wscvt
