// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// How a scan is laid over the sphere, and what decided it.
struct ParametrizationChoice {
  Parametrization taken = Parametrization::Radial;  ///< not Auto
  double steep_share = 0.0;                         ///< see steep_share
  double folded_share = 0.0;                        ///< see folded_solid_angle
};

/// Decides Auto for a closed, outward mesh about `centre`: radial where it folds nowhere and
/// steep_share is at most steep_share_limit. With `needs_series` (a series is that of the radial
/// map) it is radial wherever the fold limit allows one. Throws Error(InvalidInput) for options out
/// of range, Error(Cancelled).
ParametrizationChoice choose_parametrization(const IndexedMesh& mesh, const Vector3& centre,
                                             const SurfaceOptions& options, bool needs_series,
                                             const Execution& execution);

/// Share of the area of a closed, outward mesh whose flanks are steep as seen from `centre`, or
/// look back at it. A face is judged as a whole, at its middle.
double steep_share(const IndexedMesh& mesh, const Vector3& centre, const Execution& execution);

}  // namespace wscvt
