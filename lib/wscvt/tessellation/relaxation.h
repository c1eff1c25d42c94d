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
  SphereTriangulation triangulation;  ///< the regular one of the seeds and their weights
  std::vector<double> cell_areas;     ///< solid angles
  RelaxationReport report;
};

/// Moves the seeds towards the centroids of their cells until one of these holds: both the rms
/// displacement and the standard deviation of (cell area / target) are below their tolerances, the
/// seeds are at rest, a further step would tear the triangulation, or the iterations are used up.
/// The report says which.
///
/// Each step is 1.2 times the way from seed to centroid, plus Nesterov's momentum, dropped whenever
/// it points uphill (O'Donoghue and Candes 2015, "Adaptive restart for accelerated gradient
/// schemes"). The target cell area is 3.118 w + C.
///
/// Throws Error(InvalidInput) for fewer than 4 seeds, Error(NumericalFailure) if the seeds cannot
/// be triangulated, Error(Cancelled).
RelaxationResult relax(std::vector<Vector3> seeds, const SeedModel& model,
                       const RelaxationOptions& options, const Execution& execution);

/// Relaxes from a triangulation of the seeds, which saves building one.
RelaxationResult relax(std::vector<Vector3> seeds, SphereTriangulation triangulation,
                       const SeedModel& model, const RelaxationOptions& options,
                       const Execution& execution);

/// Returns why a relaxation ends at `step`; empty if it continues.
std::optional<RelaxationOutcome> outcome_at(const RelaxationStep& step,
                                            const RelaxationOptions& options, int iterations);

}  // namespace wscvt
