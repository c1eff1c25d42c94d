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
  SphereTriangulation triangulation;  ///< of those seeds: the regular one of their weights
  std::vector<double> cell_areas;     ///< solid angles
  RelaxationReport report;
};

/// Moves the seeds towards the centroids of their cells until both the rms displacement and the
/// spread of (cell area / target) are below their tolerances, or the seeds have come to rest, or
/// they cannot go further without tearing the triangulation, or the iterations are used up; which
/// of these is said in the report.
///
/// Each step goes 1.2 times the way from seed to centroid and carries Nesterov's momentum, dropped
/// whenever it points uphill (O'Donoghue and Candes 2015, "Adaptive restart for accelerated
/// gradient schemes"). The target cell area is 3.118 w + C.
///
/// Throws Error(InvalidInput) for fewer than 4 seeds,
/// Error(NumericalFailure) when the seeds cannot be triangulated, Error(Cancelled).
RelaxationResult relax(std::vector<Vector3> seeds, const SeedModel& model,
                       const RelaxationOptions& options, const Execution& execution);

/// The same from a triangulation of the seeds, which saves building one.
RelaxationResult relax(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                       const SeedModel& model, const RelaxationOptions& options,
                       const Execution& execution);

/// Why a relaxation ends at `step`; empty when it goes on.
std::optional<RelaxationOutcome> outcome_at(const RelaxationStep& step,
                                            const RelaxationOptions& options, int iterations);

}  // namespace wscvt
