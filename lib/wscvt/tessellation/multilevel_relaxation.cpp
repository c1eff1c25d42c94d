// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/multilevel_relaxation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

struct Tessellation {
  std::vector<Vector3> seeds;
  std::vector<Triangle> triangles;
};

/// Splits every edge at its middle, and every triangle in four.
Tessellation subdivide(const std::vector<Vector3>& seeds,
                       const SphereTriangulation& triangulation) {
  Tessellation fine;
  fine.seeds = seeds;
  fine.seeds.reserve(4 * seeds.size());
  std::vector<std::int32_t> middle(triangulation.opposite().size());  // vertex on each half-edge
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(middle.size()); ++h) {
    const std::int32_t other = triangulation.opposite()[h];
    if (h < other) {
      const std::int32_t a = triangulation.origin(h);
      const std::int32_t b = triangulation.origin(other);
      middle[h] = static_cast<std::int32_t>(fine.seeds.size());
      fine.seeds.push_back((seeds[a] + seeds[b]).normalized());
    } else {
      middle[h] = middle[other];
    }
  }
  fine.triangles.reserve(4 * triangulation.triangles().size());
  for (std::size_t t = 0; t < triangulation.triangles().size(); ++t) {
    const auto [a, b, c] = triangulation.triangles()[t];
    const std::int32_t ab = middle[3 * t];
    const std::int32_t bc = middle[3 * t + 1];
    const std::int32_t ca = middle[3 * t + 2];
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({ab, b, bc});
    fine.triangles.push_back({ca, bc, c});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

/// Adds `extra` seeds, at most three, in the middles of the largest triangles, because they disturb
/// least there.
void insert_seeds(Tessellation& tessellation, int extra) {
  if (extra == 0) return;
  std::vector<std::size_t> order(tessellation.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> areas;
  areas.reserve(order.size());
  for (const auto& [a, b, c] : tessellation.triangles) {
    areas.push_back(
        doubled_area_normal(tessellation.seeds[a], tessellation.seeds[b], tessellation.seeds[c])
            .squaredNorm());
  }
  std::partial_sort(
      order.begin(), order.begin() + extra, order.end(),
      // A fixed order for equal areas, as of a lattice's triangles, must not depend on the sort.
      [&](std::size_t i, std::size_t j) {
        return areas[i] != areas[j] ? areas[i] > areas[j] : i < j;
      });
  for (int k = 0; k < extra; ++k) {
    const auto [a, b, c] = tessellation.triangles[order[k]];
    const auto v = static_cast<std::int32_t>(tessellation.seeds.size());
    tessellation.seeds.push_back(
        (tessellation.seeds[a] + tessellation.seeds[b] + tessellation.seeds[c]).normalized());
    tessellation.triangles[order[k]] = {a, b, v};
    tessellation.triangles.push_back({b, c, v});
    tessellation.triangles.push_back({c, a, v});
  }
}

/// Returns the options of a level before the last.
RelaxationOptions coarse_options(RelaxationOptions options, bool coarsest) {
  // Displacement tolerances of the coarsest and the middle levels.
  constexpr double coarsest_tolerance = 1e-4;
  constexpr double middle_tolerance = 3e-4;
  options.displacement_tolerance =
      std::min(options.displacement_tolerance, coarsest ? coarsest_tolerance : middle_tolerance);
  // The areas of few seeds on a rough grain never vary as little as the last level requires.
  options.area_tolerance = std::numeric_limits<double>::max();
  return options;
}

}  // namespace

std::vector<int> level_sizes(int count) {
  if (count < 4) {
    refuse("A tessellation needs at least 4 seeds, not " + std::to_string(count) + ".");
  }
  std::vector<int> sizes = {count};
  // V seeds have 3 V - 6 edges, and the next level has a seed in the middle of each: 4 V - 6.
  while ((sizes.back() - 2) / 4 + 2 >= coarsest_seeds) sizes.push_back((sizes.back() - 2) / 4 + 2);
  std::reverse(sizes.begin(), sizes.end());
  return sizes;
}

RelaxationResult relax_multilevel(std::vector<Vector3> start, int count, const SeedModel& model,
                                  const RelaxationOptions& options, const Execution& execution) {
  const std::vector<int> sizes = level_sizes(count);
  if (static_cast<int>(start.size()) != sizes.front()) {
    refuse("The coarsest level has " + std::to_string(start.size()) + " seeds instead of " +
           std::to_string(sizes.front()) + ".");
  }
  // Progress by the number of seeds to move; the last level has three quarters of them.
  const auto options_of = [&](std::size_t level) {
    return level + 1 == sizes.size() ? options : coarse_options(options, level == 0);
  };
  double done = 0.0;
  double all = 0.0;
  for (const int size : sizes) all += size;
  const auto execution_of = [&](std::size_t level) {
    const double begin = done;
    done += sizes[level];
    return execution.part(begin / all, done / all);
  };

  RelaxationResult result = relax(std::move(start), model, options_of(0), execution_of(0));
  std::vector<RelaxationLevel> coarser;
  for (std::size_t level = 1; level < sizes.size(); ++level) {
    coarser.push_back({sizes[level - 1], result.report.iterations, result.report.outcome});
    Tessellation fine = subdivide(result.seeds, result.triangulation);
    insert_seeds(fine, sizes[level] - static_cast<int>(fine.seeds.size()));
    SphereTriangulation triangulation(fine.seeds, std::move(fine.triangles), execution);
    // Reports counts of all levels, but displacements and outcome of the last.
    const int rebuilds = result.report.rebuilds;
    const double weight_scale = result.report.weight_scale;
    result = relax(std::move(fine.seeds), model, options_of(level), execution_of(level),
                   std::move(triangulation));
    result.report.rebuilds += rebuilds;
    result.report.weight_scale = std::min(result.report.weight_scale, weight_scale);
  }
  result.report.coarser_levels = std::move(coarser);
  return result;
}

}  // namespace wscvt
