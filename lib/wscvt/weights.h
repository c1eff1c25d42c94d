// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace wscvt {

/// What a seed weighs, and so how large its cell becomes.
enum class Weighting {
  Constant,        ///< equal solid angles
  RadialDistance,  ///< WSCVT-D, eq. 10 as printed: w = S / (N pi r^2)
  Curvature,       ///< WSCVT-C, eqs. 11 to 14: more nodes where curvature is high
  Area,            ///< equal surface areas: w = S / (3.118 N g), g = dA/dOmega
};

}  // namespace wscvt
