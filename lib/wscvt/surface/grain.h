// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/scan/scan_options.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/surface/harmonic_map.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/parametrization_choice.h"
#include "wscvt/surface/sphere_map.h"
#include "wscvt/surface/sphere_surface.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// A grain of equivalent radius 1 about the origin, wherever and however large it was, so that
/// tolerances and table floors mean the same for every scan. All its lengths are in `unit`.
struct Grain {
  double unit = 1.0;                 ///< length of the input per length here: its equivalent radius
  Vector3 centre = Vector3::Zero();  ///< of the grain, in the input's coordinates
  IndexedMesh mesh;                  ///< the scan, or points of the formula's surface
  bool is_scan = true;               ///< not a formula, whose own points are exact
  /// Radial or Spherical: how the grain is laid over the sphere. Spherical grains have `mapped` and
  /// `map`, the others `surface`, `fit` and `coefficients`.
  Parametrization parametrization = Parametrization::Radial;
  double steep_share = 0.0;                      ///< see steep_share; 0 of a formula
  std::unique_ptr<const RadialSurface> surface;  ///< the fitted series, or the formula
  /// The scan over the sphere, or, of a very dense one, an early level of its own collapse.
  std::optional<MappedSurface> mapped;
  bool is_level = false;                       ///< `mapped` is such a level
  SphereMap map;                               ///< of `mapped`; its directions have moved there
  double folded_share = 0.0;                   ///< see folded_solid_angle; 0 of a formula
  HarmonicFitReport fit;                       ///< of the series; empty of a formula
  std::vector<double> coefficients;            ///< of the series; empty of a formula
  std::optional<MeshSurface> rays;             ///< at the mesh; of a formula only if asked for
  std::optional<CurvatureSamples> curvatures;  ///< of the scan itself, for who weighs by them
  std::optional<HarmonicMapFit> map_series;    ///< of `mapped`, for who reads it
  /// At the vertices of `mapped`, for who weighs by them: see curvatures_in_space.
  std::vector<PrincipalCurvatures> map_curvatures;
};

/// Centres a scan on its volume centroid and fits the series, or maps it to the sphere, as was
/// chosen for it. Leaves `curvatures`, `map_series` and
/// `map_curvatures` empty.
///
/// A dense scan need not be mapped whole: one with more than 50,000 vertices and more than 40 a
/// node of the `largest_node_count` that will be asked for is collapsed to that number first. The
/// nodes are relaxed on that level and put on to the scan, or fitted to it, afterwards.
///
/// An automatic degree of the series is that of fit_harmonics_for_nodes for `node_count`.
///
/// Throws Error: InvalidInput for options out of range and for a spherical map of a surface with
/// handles, NotStarShaped when the folded share of a grain that is to be Radial exceeds the limit
/// or the centroid is not inside, NumericalFailure, Cancelled.
Grain grain_of_scan(CheckedMesh scan, const ParametrizationChoice& choice,
                    const SurfaceOptions& options, int node_count, const Execution& execution);

/// The grain of a surface given by a formula or by coefficients, about its own origin, whose
/// `integrals` are given. Its mesh has 40,962 points. `surface` must outlive the grain.
Grain grain_of_surface(const RadialSurface& surface, const SurfaceIntegrals& integrals,
                       const Execution& execution);

}  // namespace wscvt
