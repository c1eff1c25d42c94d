// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/clump/clump_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/clump/medial_spheres.h"
#include "wscvt/clump/sphere_fit.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/inscribed_sphere.h"
#include "wscvt/scan/enclosure.h"

namespace wscvt {

namespace {

constexpr double held_weight = 8.0;  ///< of what bulges out, while spheres are added
constexpr std::size_t most_candidates = 3000;
constexpr std::size_t judged = 20000;  ///< samples that errors are told of
constexpr double least_radius = 1e-3;
constexpr const char* stage_name = "Fitting spheres";

/// Points of a grid, those inside of the mesh and those outside: some 2,000 inside of a body as
/// thick as wide.
struct GridPoints {
  std::vector<Vector3> inside;
  std::vector<Vector3> outside;
};
GridPoints grid_points(const IndexedMesh& mesh, const Execution& execution) {
  constexpr double spacing = 0.13;
  Vector3 low = mesh.points[static_cast<std::size_t>(mesh.triangles.front()[0])];
  Vector3 high = low;
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) {
      low = low.cwiseMin(mesh.points[static_cast<std::size_t>(v)]);
      high = high.cwiseMax(mesh.points[static_cast<std::size_t>(v)]);
    }
  }
  // A long body of equivalent radius 1 is thin, but its box may be large where it lies askew in it.
  constexpr double most_points = 20000.0;
  const double step = std::max(spacing, std::cbrt((high - low).prod() / most_points));
  const Vector3 middle = 0.5 * (low + high);
  const Eigen::Array3d half = ((high - low) / (2.0 * step)).array().ceil() + 1.0;
  std::vector<Vector3> all;
  for (double i = -half[0]; i <= half[0]; ++i) {
    for (double j = -half[1]; j <= half[1]; ++j) {
      for (double k = -half[2]; k <= half[2]; ++k) all.push_back(middle + step * Vector3(i, j, k));
    }
  }
  const std::vector<char> inside = are_inside(mesh, all, execution);
  GridPoints points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    (inside[i] != 0 ? points.inside : points.outside).push_back(all[i]);
  }
  return points;
}

/// A fit that grows.
class Growth {
 public:
  Growth(const IndexedMesh& grain, const ClumpOptions& options, const Execution& execution)
      : options_(options),
        execution_(execution),
        smallest_(std::max(least_radius, 0.01 * options.smallest_radius_percent)),
        surface_(grain, execution),
        judged_(area_uniform_samples(grain, judged)),
        fit_(begin(grain)) {}

  FittedSpheres run() {
    const bool is_target = options_.max_error_percent > 0.0;
    const auto most =
        static_cast<std::size_t>(is_target ? options_.most_spheres : options_.sphere_count);
    FittedSpheres result;
    std::size_t next_stage = 1;
    while (true) {
      const std::size_t count = fit_.spheres().size();
      if (count >= next_stage || count >= most) {
        const double error = rms_distance(let_down(fit_));
        result.stages.push_back({count, error});
        next_stage = count + std::max<std::size_t>(1, count / (is_target ? 10 : 4));
        if (is_target && 100.0 * error <= options_.max_error_percent) break;
      }
      if (count >= most || !add_sphere()) break;
      execution_.report(0.9 * static_cast<double>(count) / static_cast<double>(most), stage_name);
    }
    relocate();
    fit_ = let_down(std::move(fit_));
    for (double before = 2.0 * fit_.energy(); fit_.energy() < 0.9999 * before;) {
      before = fit_.energy();
      sweep(fit_, 10);
    }
    result.stages.back() = {fit_.spheres().size(), rms_distance(fit_)};
    result.spheres = fit_.spheres();
    return result;
  }

 private:
  SphereFit begin(const IndexedMesh& grain) {
    const InscribedSphere largest = largest_inscribed_sphere(grain, execution_);
    if (options_.inside && largest.radius < smallest_) {
      refuse("The largest sphere inside the grain has a radius of " +
             format_number(100.0 * largest.radius, 3) +
             " % of the equivalent radius, less than --smallest-radius, so that no sphere fits "
             "inside; give a smaller one, or leave out --inside.");
    }
    const bool is_target = options_.max_error_percent > 0.0;
    const auto count =
        static_cast<std::size_t>(is_target ? options_.most_spheres : options_.sphere_count);
    // Four unknowns a sphere, and none of them may follow single samples.
    const std::vector<SurfaceSample> samples =
        surface_samples(grain, std::max<std::size_t>(4000, 80 * count));
    std::vector<Vector3> points;
    points.reserve(samples.size());
    for (const SurfaceSample& sample : samples) points.push_back(sample.point);
    const std::size_t step = (samples.size() + most_candidates - 1) / most_candidates;
    for (Sphere& sphere : medial_spheres(samples, step, 1.001 * largest.upper_bound, execution_)) {
      if (options_.inside && sphere.radius < smallest_) continue;
      sphere.radius = std::max(sphere.radius, smallest_);
      candidates_.push_back(sphere);
    }
    const GridPoints grid = grid_points(grain, execution_);
    SphereFit fit(points, grid.inside, grid.outside,
                  {smallest_, options_.inside ? &surface_ : nullptr});
    fit.set_inner_weight(held_weight);
    fit.add({largest.centre, std::max(largest.radius, smallest_)});
    sweep(fit, 10);
    return fit;
  }

  void sweep(SphereFit& fit, int times) const {
    for (int i = 0; i < times; ++i) {
      execution_.report(0.9, stage_name);
      fit.sweep();
    }
  }

  /// Adds the candidate that lowers the energy most, of those that do so by an eighth of the
  /// samples.
  bool add_sphere() {
    constexpr std::size_t looked_at = 24;
    if (candidates_.empty()) return false;
    using Judged = std::pair<double, std::size_t>;  // energy, candidate
    std::vector<Judged> energies(candidates_.size());
    execution_.parallel_for(candidates_.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        energies[i] = {fit_.rough_energy_with(candidates_[i]), i};
      }
    });
    const std::size_t count = std::min(looked_at, energies.size());
    std::partial_sort(energies.begin(), energies.begin() + static_cast<std::ptrdiff_t>(count),
                      energies.end());
    energies.resize(count);
    for (auto& [energy, i] : energies) {
      if (options_.inside) keep_inside(candidates_[i]);
      energy = fit_.energy_with(candidates_[i]);
    }
    const Sphere& best = candidates_[std::min_element(energies.begin(), energies.end())->second];
    if (options_.inside && best.radius < smallest_) return false;
    fit_.add(best);
    sweep(fit_, 4);
    return true;
  }

  /// Takes the candidate back from the surface between the samples. One that is too small after
  /// that is put far away, where it lowers no energy.
  void keep_inside(Sphere& candidate) const {
    const double depth = surface_.distance(candidate.centre);
    candidate.radius = std::min(candidate.radius, depth);
    if (candidate.radius >= smallest_ && surface_.contains(candidate.centre)) return;
    candidate = {Vector3::Constant(1e3), 0.0};
  }

  /// Takes out the spheres that matter least and adds as many, one at first and one more after each
  /// time that did not help.
  void relocate() {
    constexpr int most_failures = 4;
    constexpr int most_moves = 40;
    const std::size_t count = fit_.spheres().size();
    int failures = 0;
    for (int move = 0; move < most_moves && failures < most_failures; ++move) {
      if (count < static_cast<std::size_t>(failures) + 2) break;
      SphereFit before = fit_;
      for (int i = 0; i <= failures; ++i) fit_.remove(fit_.least_needed());
      while (fit_.spheres().size() < count && add_sphere()) continue;
      sweep(fit_, 6);
      const bool is_better = fit_.energy() < 0.9999 * before.energy();
      failures = is_better ? 0 : failures + 1;
      if (!is_better) fit_ = std::move(before);
    }
  }

  /// The weight of what bulges out let down to that of gaps.
  SphereFit let_down(SphereFit fit) const {
    for (double weight = 0.5 * held_weight; weight >= 1.0; weight *= 0.5) {
      fit.set_inner_weight(weight);
      sweep(fit, options_.inside ? 2 : 12);
    }
    return fit;
  }

  double rms_distance(const SphereFit& fit) const {
    return union_distance(judged_, fit.spheres(), execution_).root_mean_square;
  }

  const ClumpOptions& options_;
  const Execution& execution_;
  double smallest_;  ///< radius
  MeshDistance surface_;
  std::vector<Vector3> judged_;
  std::vector<Sphere> candidates_;
  SphereFit fit_;
};

}  // namespace

UnionDistance union_distance(const std::vector<Vector3>& points, const std::vector<Sphere>& spheres,
                             const Execution& execution) {
  constexpr std::size_t block = 1024;
  struct Sums {
    double squares = 0.0;
    double largest = 0.0;
    Sums& operator+=(const Sums& other) {
      squares += other.squares;
      largest = std::max(largest, other.largest);
      return *this;
    }
  };
  const Sums sums =
      execution.parallel_sum(points.size(), block, Sums(), [&](std::size_t begin, std::size_t end) {
        Sums part;
        for (std::size_t i = begin; i < end; ++i) {
          double least = spheres.front().distance(points[i]);
          for (const Sphere& sphere : spheres) {
            least = std::min(least, sphere.distance(points[i]));
          }
          part.squares += least * least;
          part.largest = std::max(part.largest, std::abs(least));
        }
        return part;
      });
  return {std::sqrt(sums.squares / static_cast<double>(points.size())), sums.largest};
}

FittedSpheres fit_spheres(const IndexedMesh& unit_grain, const ClumpOptions& options,
                          const Execution& execution) {
  execution.report(0.0, stage_name);
  return Growth(unit_grain, options, execution).run();
}

}  // namespace wscvt
