// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {

/// How a scan becomes a surface over the sphere.
struct SurfaceOptions {
  int degree = 20;           ///< of the harmonic series, in [1, 60]
  double fold_limit = 0.05;  ///< refuse above this folded_solid_angle, in [0, 1)
};

/// Throws Error(InvalidInput), with the range, for options out of range.
void check_surface_options(const SurfaceOptions& options);

/// A grain of equivalent radius 1 about the origin, wherever and however large it was, so that
/// tolerances and table floors mean the same for every scan. All its lengths are in `unit`.
struct Grain {
  double unit = 1.0;                 ///< length of the input per length here: its equivalent radius
  Vector3 centre = Vector3::Zero();  ///< of the grain, in the input's coordinates
  IndexedMesh mesh;                  ///< the scan, or points of the formula's surface
  bool is_scan = true;               ///< not a formula, whose own points are exact
  std::unique_ptr<const RadialSurface> surface;  ///< the fitted series, or the formula
  double folded_share = 0.0;                     ///< see folded_solid_angle; 0 of a formula
  HarmonicFitReport fit;                         ///< of the series; empty of a formula
  std::vector<double> coefficients;              ///< of the series; empty of a formula
  std::optional<MeshSurface> rays;               ///< at the mesh; of a formula only if asked for
  std::optional<CurvatureSamples> curvatures;    ///< of the scan itself, for who weighs by them
};

/// Centres a scan on its volume centroid and fits the series. Leaves `curvatures` empty.
/// Throws Error: InvalidInput for options out of range, NotStarShaped when the folded share exceeds
/// the limit or the centroid is not inside, NumericalFailure, Cancelled.
Grain grain_of_scan(CheckedMesh scan, const SurfaceOptions& options, const Execution& execution);

/// The grain of a surface given by a formula or by coefficients, about its own origin, whose
/// `integrals` are given. Its mesh has 40,962 points. `surface` must outlive the grain.
Grain grain_of_surface(const RadialSurface& surface, const SurfaceIntegrals& integrals,
                       const Execution& execution);

}  // namespace wscvt
