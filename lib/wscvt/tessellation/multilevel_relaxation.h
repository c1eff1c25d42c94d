// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// How many seeds each level has, from the coarsest to `count`: cutting each edge in two turns V
/// seeds into 4 V - 6, and up to three are added on a level so that the last has exactly `count`.
/// Throws Error(InvalidInput) when a number is below 4.
std::vector<int> level_sizes(int count, int coarsest_seeds);

/// `levels` with so many `times` as many seeds on the coarsest level, as far as their range goes.
MultilevelOptions with_more_seeds(MultilevelOptions levels, int times);

/// The options of one level: those given on the finest, else the tolerances of MultilevelOptions.
RelaxationOptions level_options(const RelaxationOptions& options, const MultilevelOptions& levels,
                                bool finest, bool coarsest);

/// Relaxes `start`, the seeds of the coarsest level, then halves the edges and relaxes again, level
/// by level, until there are `count` seeds.
///
/// A subdivided tessellation has six neighbours at nearly every seed and its cells' sizes already
/// right, so the last level needs a few iterations where a lattice of as many seeds needs a
/// hundred, and keeps far fewer pairs of five and seven neighbours. `start` must have
/// level_sizes(...)[0] seeds. Errors as relax(), and Error(InvalidInput) for `levels` out of range.
RelaxationResult relax_multilevel(std::vector<Vector3> start, int count, const SeedModel& model,
                                  const RelaxationOptions& options, const MultilevelOptions& levels,
                                  const Execution& execution);

}  // namespace wscvt
