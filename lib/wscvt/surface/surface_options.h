// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/option.h"
#include "wscvt/surface/fit_degree.h"
#include "wscvt/surface/parametrization.h"

namespace wscvt {

/// How a scan becomes a surface over the sphere.
struct SurfaceOptions {
  Parametrization parametrization = Parametrization::Auto;
  int degree = automatic_degree;    ///< of the harmonic series, see harmonic_degree_option
  double fold_limit_percent = 5.0;  ///< refuse above this folded_solid_angle; Radial only
};

inline constexpr NumberOption<double> fold_limit_option = {
    "fold-limit", "fold limit in %",
    0.0,          99.0,
    Ends::Both,   "the scan is refused when sheets beyond the first fill more of the solid angle"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_surface_options(const SurfaceOptions& options);

}  // namespace wscvt
