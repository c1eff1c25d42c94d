// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/option.h"
#include "wscvt/surface/fit_degree.h"
#include "wscvt/surface/parametrization.h"

namespace wscvt {

/// Share of the solid angle in sheets beyond the first, in %, up to which a body is taken for one
/// with a radius in each direction unless another limit is given: its outermost layer stands in for
/// it. Fold counts as in folded_solid_angle.
inline constexpr double usual_fold_limit_percent = 5.0;

/// How a scan becomes a surface over the sphere.
struct SurfaceOptions {
  Parametrization parametrization = Parametrization::Auto;
  int degree = automatic_degree;  ///< of the harmonic series, see harmonic_degree_option
  /// Refuse above this folded_solid_angle; Radial only.
  double fold_limit_percent = usual_fold_limit_percent;
};

inline constexpr NumberOption<double> fold_limit_option = {
    "fold-limit", "fold limit in %",
    0.0,          99.0,
    Ends::Both,   "the scan is refused when sheets beyond the first fill more of the solid angle"};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_surface_options(const SurfaceOptions& options);

}  // namespace wscvt
