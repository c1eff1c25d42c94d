// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "wscvt/base/option.h"

namespace wscvt {

/// Options of virtual grains.
struct GrowOptions {
  /// Number of real grains per virtual grain. With 2 the distributions are closest to the sample's.
  /// With 4 the grains resemble their donors least.
  int donors = 3;
  std::uint64_t seed = 1;
};

inline constexpr NumberOption<int> donors_option = {
    "donors", "number of donors", 2, 8, Ends::Both, "real grains per virtual grain"};
inline constexpr NumberOption<std::uint64_t> sample_seed_option = {
    "seed",     "seed",
    0,          std::numeric_limits<std::uint64_t>::max(),
    Ends::Both, "the same seed gives the same grains"};
/// Degree of the series with which grains of a sample are read and grown.
inline constexpr NumberOption<int> sample_degree_option = {
    "degree", "degree of the SH series", 4, 56, Ends::Both, "detail of the virtual grains"};

}  // namespace wscvt
