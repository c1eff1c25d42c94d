// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

/// How the directions of the nodes are chosen.
enum class Sampling {
  Weighted,     ///< relaxed to a weighted centroidal tessellation: WSCVT
  Fibonacci,    ///< Fibonacci lattice, as it is
  EqualAngle,   ///< equal-angle grid with the number of points nearest to N
  Icosahedron,  ///< subdivided icosahedron with the number of points nearest to N
};

/// Where the seeds of a weighted sampling start.
enum class SeedStart {
  Multilevel,     ///< warped lattice of a few hundred, subdivided and relaxed level by level
  WarpedLattice,  ///< all N in a Fibonacci lattice warped to the wanted density
  Random,         ///< uniform directions from `random_seed`
};

struct SeedingOptions {
  Sampling sampling = Sampling::Weighted;  ///< the others ignore weighting and relaxation
  SeedStart start = SeedStart::Multilevel;
  std::uint64_t random_seed = 1;  ///< of SeedStart::Random
};

/// Whether a sampling has a form with any number of points.
bool takes_any_count(Sampling sampling);

/// The points of a sampling that is not relaxed: `count` of them, or the nearest possible number
/// (see takes_any_count). Unit vectors. Throws Error(InvalidInput) for Sampling::Weighted.
std::vector<Vector3> unrelaxed_seeds(Sampling sampling, int count);

/// `count` >= 4 unit vectors from which the relaxation starts: random, or a Fibonacci lattice
/// warped to the density that `model` wants.
std::vector<Vector3> start_seeds(const SeedingOptions& options, const SurfaceSeedModel& model,
                                 int count, const Execution& execution);

}  // namespace wscvt
