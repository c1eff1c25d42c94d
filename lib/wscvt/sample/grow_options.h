// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>

#include "wscvt/base/option.h"

namespace wscvt {

/// How virtual grains are grown.
struct GrowOptions {
  /// Real grains that one virtual grain is made of. With 2 the distributions are closest to the
  /// sample's, with 4 the grains resemble their donors least.
  int donors = 3;
  std::uint64_t seed = 1;
};

inline constexpr NumberOption<int> donors_option = {
    "donors", "number of donors", 2,
    8,        Ends::Both,         "real grains that each virtual grain is made of"};
inline constexpr NumberOption<std::uint64_t> sample_seed_option = {
    "seed",     "seed",
    0,          std::numeric_limits<std::uint64_t>::max(),
    Ends::Both, "the same seed gives the same grains"};
/// Degree of the series that the grains of a sample are read and grown with.
inline constexpr NumberOption<int> sample_degree_option = {
    "degree", "degree of the SH series", 4, 56, Ends::Both, "detail of the virtual grains"};

}  // namespace wscvt
