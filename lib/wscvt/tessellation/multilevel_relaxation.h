// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/tessellation/relaxation.h"

namespace wscvt {

struct MultilevelOptions {
  /// Smallest number of seeds of a level. A tessellation of fewer than four times as many has
  /// one level.
  int coarsest_seeds = 250;
  /// Displacement tolerances of the coarsest and of the levels between, if smaller than that of the
  /// relaxation's own: an iteration there costs little and its evenness is inherited. The
  /// spread of the cells' areas is asked for on the last level only, since fewer seeds may be
  /// unable to reach it.
  double coarsest_tolerance = 1e-4;
  double middle_tolerance = 3e-4;
};

inline constexpr NumberOption<int> coarsest_seeds_option = {
    "coarsest-seeds", "smallest number of seeds of a level", 4, std::numeric_limits<int>::max()};
inline constexpr NumberOption<double> coarsest_tolerance_option = {
    "coarsest-tolerance",
    "tolerance of the rms displacement on the coarsest level",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::NotMinimum,
    "in cell sizes"};
inline constexpr NumberOption<double> middle_tolerance_option = {
    "middle-tolerance",
    "tolerance of the rms displacement on the levels between",
    0.0,
    std::numeric_limits<double>::infinity(),
    Ends::NotMinimum,
    "in cell sizes"};

/// How many seeds each level has, from the coarsest to `count`: cutting each edge in two turns V
/// seeds into 4 V - 6, and up to three are added on a level so that the last has exactly `count`.
/// Throws Error(InvalidInput) when a number is below 4.
std::vector<int> level_sizes(int count, int coarsest_seeds);

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

/// Throws Error(InvalidInput) for options out of range.
void check_multilevel_options(const MultilevelOptions& options);

}  // namespace wscvt
