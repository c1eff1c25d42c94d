// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

class GivenSizes;

/// Options of the division of a grain into fragments.
struct FragmentOptions {
  int count = 20;          ///< exact number of fragments, 1 to 1000
  std::uint64_t seed = 1;  ///< of the places from which the cells start
  /// Relative volumes, one per fragment, each > 0; empty: about equal.
  std::vector<double> volumes;
  /// Points near which fragments are smaller, length. Their size grows with the distance to the
  /// nearest of these points plus a fifth of the equivalent radius. Not together with `volumes`.
  std::vector<Vector3> near;
};

inline constexpr NumberOption<int> fragment_count_option = {
    "count", "number of fragments", 1, 1000, Ends::Both, "exactly this many"};

/// Throws Error(InvalidInput) for options out of range or in conflict.
void check_options(const FragmentOptions& options);

/// Returns the volumes of `count` fragments, 1 or more, that follow a size curve, up to a factor:
/// of diameters whose fractions by number are in the middle of `count` equal intervals.
std::vector<double> fragment_volumes(const GivenSizes& sizes, int count);

}  // namespace wscvt
