// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/tessellation/relaxation.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

/// Smallest number of seeds of a level. A tessellation of fewer than four times as many has one
/// level. On eight grains with 500 to 850 nodes, 2 to 10 % more seeds have six neighbours than
/// without a level below, and under most weightings all steps together cost a half to three
/// quarters. A level of 60 does as much for fewer nodes, but increases the distance of some grains
/// by up to 8 %.
inline constexpr int coarsest_seeds = 125;

/// Returns the number of seeds of each level, from the coarsest to `count`. Cutting each edge in
/// two turns V seeds into 4 V - 6, and up to three are added on a level so that the last has
/// exactly `count`. Throws Error(InvalidInput) if `count` is below 4.
std::vector<int> level_sizes(int count);

/// Relaxes `start`, the seeds of the coarsest level, then halves the edges and relaxes again, level
/// by level, until there are `count` seeds. On the coarser levels, an iteration costs little and
/// its evenness is inherited. There the tolerance of the displacement is finer, and the tolerance
/// of the areas is ignored.
///
/// In a subdivided tessellation, nearly every seed has six neighbours and the right cell size. The
/// last level therefore needs a few iterations, while a lattice of as many seeds needs a hundred,
/// and keeps far fewer pairs of five and seven neighbours. `start` must have level_sizes(count)[0]
/// seeds. Throws as relax().
RelaxationResult relax_multilevel(std::vector<Vector3> start, int count, const SeedModel& model,
                                  const RelaxationOptions& options, const Execution& execution);

}  // namespace wscvt
