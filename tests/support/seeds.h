// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <iostream>

namespace wscvt::test {

/// The seed, after printing it: ctest shows it with a test that fails, so that the failure can be
/// repeated without the source.
inline std::uint64_t announced(std::uint64_t seed) {
  std::cout << "seed " << seed << '\n';
  return seed;
}

}  // namespace wscvt::test
