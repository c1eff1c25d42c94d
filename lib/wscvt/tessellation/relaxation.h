// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/tessellation/seed_model.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

struct RelaxationResult {
  std::vector<Vector3> seeds;         ///< unit vectors, in the order given
  SphereTriangulation triangulation;  ///< of those seeds, as the metric defines it
  std::vector<double> cell_areas;     ///< solid angles (Sphere) or surface areas (Surface)
  RelaxationReport report;
};

/// Moves the seeds towards the centroids of their cells until both the rms displacement and the
/// spread of (cell area / target) are below their tolerances, or the seeds have come to rest, or
/// they cannot go further without tearing the triangulation, or the iterations are used up; which
/// of these is said in the report.
///
/// Each step goes `over_relaxation` times the way from seed to centroid. With `acceleration` the
/// steps carry Nesterov's momentum, dropped whenever it points uphill (O'Donoghue and Candes 2015,
/// "Adaptive restart for accelerated gradient schemes"). The target cell area is 3.118 w + C on the
/// sphere and inversely proportional to the wanted density on the surface.
///
/// On rough grains such steps of the surface metric can go round in circles. Once the displacement
/// has been above both twice its smallest and 1e-3 h for 30 steps since that, the rest are plain
/// steps: factor 1 at most and no momentum. They are slower, but went to about 1e-3 h or less on
/// every scan tried.
///
/// Throws Error(InvalidInput) for options out of range or fewer than 4 seeds,
/// Error(NumericalFailure) when the seeds cannot be triangulated, Error(Cancelled).
RelaxationResult relax(std::vector<Vector3> seeds, const SeedModel& model,
                       const RelaxationOptions& options, const Execution& execution);

/// The same from a triangulation of the seeds, which saves building one.
RelaxationResult relax(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                       const SeedModel& model, const RelaxationOptions& options,
                       const Execution& execution);

/// Why a relaxation ends at `step`; empty when it goes on. Below `rest` times the displacement
/// tolerance the seeds have settled, whatever their cells' areas.
std::optional<RelaxationOutcome> outcome_at(const RelaxationStep& step,
                                            const RelaxationOptions& options, int iterations,
                                            double rest);

}  // namespace wscvt
