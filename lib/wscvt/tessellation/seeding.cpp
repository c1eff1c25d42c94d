// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/seeding.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

/// More seeds than this surround the centre for any random seed: 50 random points all lie in one
/// half of the sphere with a probability of 2e-12 (Wendel 1962).
constexpr int surely_surrounding = 50;

bool can_be_triangulated(const std::vector<Vector3>& seeds) {
  return static_cast<int>(seeds.size()) > surely_surrounding ||
         SphereTriangulation::try_build(seeds).has_value();
}

}  // namespace

bool takes_any_count(Sampling sampling) {
  return sampling == Sampling::Weighted || sampling == Sampling::Fibonacci;
}

std::vector<Vector3> unrelaxed_seeds(Sampling sampling, int count) {
  switch (sampling) {
    case Sampling::Fibonacci:
      return fibonacci_lattice(count);
    case Sampling::EqualAngle:
      return nearest_equal_angle_grid(count);
    case Sampling::Icosahedron:
      return nearest_subdivided_icosahedron(count);
    case Sampling::Weighted:
      break;
  }
  throw Error(
      ErrorCode::InvalidInput,
      "The weighted sampling is the result of a relaxation. Use another sampling, or relax.");
}

std::vector<Vector3> start_seeds(const SurfaceSeedModel& model, int count,
                                 const Execution& execution) {
  const int rows = std::clamp(static_cast<int>(2.0 * std::sqrt(count)), 64, 360);
  const auto density = [&](const std::vector<Vector3>& directions) {
    return model.number_densities(directions, execution);
  };
  std::vector<Vector3> seeds = warped_lattice(count, density, rows);
  return can_be_triangulated(seeds) ? seeds : fibonacci_lattice(count);
}

}  // namespace wscvt
