// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// A triangle of the wall between two grains.
struct WallTriangle {
  Triangle corners;    ///< counter-clockwise seen from `outer`
  std::int32_t inner;  ///< index of the grain, the larger one
  std::int32_t outer;  ///< index of the smaller one; -1: background
};

}  // namespace wscvt
