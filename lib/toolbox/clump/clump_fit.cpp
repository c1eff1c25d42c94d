// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/clump_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "toolbox/clump/point_blocks.h"
#include "toolbox/clump/sphere_fit.h"
#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/distances.h"
#include "wscvt/repair/components.h"

namespace wscvt {

namespace {

constexpr double held_weight = 8.0;  ///< of spheres that bulge out, while spheres are added
constexpr std::size_t most_candidates = 3000;
constexpr std::size_t judged = 20000;  ///< samples for the reported errors
constexpr std::size_t depth_samples = 40000;
constexpr double least_radius = 1e-3;
/// Largest radius of a sphere / radius of the largest inscribed sphere. Without a limit, the face
/// of a thin plate would become part of a sphere that contains everything on one side of it.
constexpr double most_bulge = 2.0;
constexpr const char* stage_name = "Fitting spheres";

/// A point of a surface and its unit outward normal.
struct SurfaceSample {
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
};

/// Returns `count` samples evenly distributed by area, with the normals of their faces.
std::vector<SurfaceSample> surface_samples(const IndexedMesh& mesh, std::size_t count) {
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  for (const MeshPlace& place : area_uniform_places(mesh, count)) {
    samples.push_back(
        {point_at(mesh, place), doubled_area_normal(mesh, place.triangle).normalized()});
  }
  return samples;
}

std::vector<Vector3> points_of(const std::vector<SurfaceSample>& samples) {
  std::vector<Vector3> points;
  points.reserve(samples.size());
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  return points;
}

Sphere shrunk(const SurfaceSample& sample, const PointBlocks& blocks, double largest) {
  constexpr int most_steps = 30;
  constexpr double tolerance = 1e-6;
  double radius = largest;
  for (int step = 0; step < most_steps; ++step) {
    const Vector3 centre = sample.point - radius * sample.normal;
    const Vector3& nearest = blocks.points()[blocks.nearest(centre)];
    // The sample itself is nearest, or a point equally near.
    if ((nearest - centre).norm() >= radius * (1.0 - tolerance)) break;
    const Vector3 chord = sample.point - nearest;
    const double reach = sample.normal.dot(chord);
    if (!(reach > 0.0)) break;
    const double next = 0.5 * chord.squaredNorm() / reach;
    if (!(next < radius)) break;
    radius = next;
  }
  return {sample.point - radius * sample.normal, radius};
}

/// For every `step`-th sample, returns the largest sphere inside the surface that touches it there.
/// A sphere of radius `largest` is shrunk until no sample lies within it (Ma, Bae and Choi 2012,
/// "3D medial axis point approximation using nearest neighbors and the normal field", Vis. Comput.
/// 28, 7-19). The centres lie on the medial axis, also in thin and hollow bodies. Between samples
/// the surface may come nearer, depending on their spacing. Samples replace the surface because
/// exact distances are slowest at centres of spheres, which are equally far from all faces.
std::vector<Sphere> medial_spheres(const std::vector<SurfaceSample>& samples, std::size_t step,
                                   double largest, const Execution& execution) {
  constexpr std::size_t block = 32;
  const PointBlocks blocks(points_of(samples));
  std::vector<Sphere> spheres((samples.size() + step - 1) / step);
  execution.parallel_for_each(spheres.size(), block, [&](std::size_t i) {
    spheres[i] = shrunk(samples[i * step], blocks, largest);
  });
  return spheres;
}

/// Points of a grid, inside and outside the mesh: some 2,000 inside a body as thick as wide.
struct GridPoints {
  std::vector<Vector3> inside;
  std::vector<Vector3> outside;
};
GridPoints grid_points(const IndexedMesh& mesh, const Execution& execution) {
  constexpr double spacing = 0.13;
  const Eigen::AlignedBox3d box = box_of_faces(mesh);
  // A long body of equivalent radius 1 is thin, but its box may be large if it is inclined.
  constexpr double most_points = 20000.0;
  const double step = std::max(spacing, portable::cbrt(box.sizes().prod() / most_points));
  const Vector3 middle = 0.5 * (box.min() + box.max());
  const Eigen::Array3i half = (box.sizes() / (2.0 * step)).array().ceil().cast<int>() + 1;
  std::vector<Vector3> all;
  for (int i = -half[0]; i <= half[0]; ++i) {
    for (int j = -half[1]; j <= half[1]; ++j) {
      for (int k = -half[2]; k <= half[2]; ++k) all.push_back(middle + step * Vector3(i, j, k));
    }
  }
  const std::vector<char> inside = are_inside(mesh, all, execution);
  GridPoints points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    (inside[i] != 0 ? points.inside : points.outside).push_back(all[i]);
  }
  return points;
}

/// A fit to which spheres are added.
class Growth {
 public:
  Growth(const IndexedMesh& grain, const ClumpOptions& options, const Execution& execution,
         const std::function<double(const std::vector<Sphere>&)>& error_percent)
      : options_(options),
        execution_(execution),
        error_percent_(error_percent),
        smallest_(std::max(least_radius, 0.01 * options.smallest_radius_percent)),
        surface_(grain, execution),
        volume_(volume_of(grain, execution)),
        judged_(area_uniform_samples(grain, judged)),
        depths_(options.inside ? area_uniform_samples(grain, depth_samples)
                               : std::vector<Vector3>()),
        fit_(begin(grain)) {}

  FittedSpheres run() {
    FittedSpheres result;
    while (true) {
      grow(result.stages);
      const SphereFit held = fit_;
      relocate();
      fit_ = let_down(std::move(fit_));
      for (double before = 2.0 * fit_.energy(); fit_.energy() < 0.9999 * before;) {
        before = fit_.energy();
        sweep(fit_, 10);
      }
      result.spheres = fit_.spheres();
      if (options_.inside) {
        keep_inside(result.spheres);
      } else {
        match_volume(result.spheres);
      }
      result.stages.back() = {result.spheres.size(), rms_distance(result.spheres)};
      if (!is_target() || held.spheres().size() >= most_spheres() || meets(result.spheres)) break;
      // Refined spheres have a smaller distance, but may have a larger error of another kind.
      fit_ = held;
      next_judging_ = 0;
      if (!add_sphere()) break;
    }
    return result;
  }

 private:
  bool is_target() const { return options_.max_error_percent > 0.0; }
  std::size_t most_spheres() const {
    return static_cast<std::size_t>(is_target() ? options_.most_spheres : options_.sphere_count);
  }
  double rms_distance(const std::vector<Sphere>& spheres) const {
    return union_distance(judged_, spheres, execution_).root_mean_square;
  }
  bool meets(const std::vector<Sphere>& spheres) const {
    const double error = error_percent_ ? error_percent_(spheres) : 100.0 * rms_distance(spheres);
    return error <= options_.max_error_percent;
  }

  /// Adds spheres until they are enough.
  void grow(std::vector<ClumpStage>& stages) {
    std::size_t next_stage = fit_.spheres().size();
    while (true) {
      const std::size_t count = fit_.spheres().size();
      if (count >= next_stage || count >= most_spheres()) {
        const std::vector<Sphere> spheres = let_down(fit_).spheres();
        stages.push_back({count, rms_distance(spheres)});
        next_stage = count + std::max<std::size_t>(1, count / (is_target() ? 10 : 4));
        if (is_target() && meets(spheres)) break;
      }
      if (count >= most_spheres() || !add_sphere()) break;
      execution_.report(0.9 * static_cast<double>(count) / static_cast<double>(most_spheres()),
                        stage_name);
    }
  }

  SphereFit begin(const IndexedMesh& grain) {
    const InscribedSphere largest = largest_inscribed_sphere(grain, execution_);
    if (options_.inside && largest.radius < smallest_) {
      refuse("No sphere fits inside the grain: the largest has a radius of " +
             format_number(100.0 * largest.radius, 3) + " % of the equivalent radius, less than " +
             mention("smallest-radius") + ". Give a smaller " + mention("smallest-radius") +
             ", or leave out " + mention("inside") + ".");
    }
    const std::size_t count = most_spheres();
    // A sphere has four unknowns, and none of them may follow single samples.
    const std::vector<SurfaceSample> samples =
        surface_samples(grain, std::max<std::size_t>(4000, 80 * count));
    const std::size_t step = (samples.size() + most_candidates - 1) / most_candidates;
    const double smallest = smallest_in_fit(grain);
    for (Sphere& sphere : medial_spheres(samples, step, 1.001 * largest.upper_bound, execution_)) {
      if (options_.inside) {
        const Vector3& nearest = depths_.points()[depths_.nearest(sphere.centre)];
        sphere.radius = std::min(sphere.radius, (nearest - sphere.centre).norm());
        if (sphere.radius < smallest) continue;
      }
      sphere.radius = std::max(sphere.radius, smallest);
      candidates_.push_back(sphere);
    }
    const GridPoints grid = grid_points(grain, execution_);
    SphereFit fit(points_of(samples), grid.inside, grid.outside,
                  {smallest, std::max(smallest, most_bulge * largest.upper_bound),
                   options_.inside ? &depths_ : nullptr});
    fit.set_inner_weight(held_weight);
    inscribed_ = {largest.centre, std::max(largest.radius, smallest_)};
    fit.add(inscribed_);
    sweep(fit, 10);
    return fit;
  }

  void sweep(SphereFit& fit, int times) const {
    for (int i = 0; i < times; ++i) {
      execution_.report(0.9, stage_name);
      fit.sweep();
    }
  }

  /// Returns the smallest radius during the fit. Between the samples of the depths the surface may
  /// be nearer, and a sphere that is shrunk to it must not become too small.
  double smallest_in_fit(const IndexedMesh& grain) const {
    if (!options_.inside || options_.smallest_radius_percent == 0.0) return smallest_;
    double area = 0.0;
    for (const Triangle& t : grain.triangles) area += triangle_area(grain, t);
    return std::sqrt(smallest_ * smallest_ + area / depth_samples);
  }

  /// Adds the candidate that lowers the energy most. Gains nearly always fall as spheres are added.
  /// So usually only the candidates with the largest gains are evaluated again, and sometimes all.
  bool add_sphere() {
    if (candidates_.empty()) return false;
    const std::size_t count = fit_.spheres().size();
    const bool all = count >= next_judging_ || gains_.size() != candidates_.size();
    const auto judge = [&](std::size_t i) {
      gains_[i] = fit_.energy() - fit_.energy_with(candidates_[i]);
    };
    if (all) {
      gains_.resize(candidates_.size());
      next_judging_ = count + 1 + count / 64;
      execution_.parallel_for_each(candidates_.size(), 256, [&](std::size_t i) { judge(i); });
    }
    std::vector<char> is_judged(candidates_.size(), all ? 1 : 0);
    std::size_t best = 0;
    while (true) {
      best =
          static_cast<std::size_t>(std::max_element(gains_.begin(), gains_.end()) - gains_.begin());
      if (is_judged[best] != 0) break;
      judge(best);
      is_judged[best] = 1;
    }
    fit_.add(candidates_[best]);
    sweep(fit_, 4);
    return true;
  }

  /// Shrinks the spheres to the surface between the samples, and drops spheres that are then too
  /// small. The largest inscribed one always remains: the fit may have moved it out of a thin
  /// place.
  void keep_inside(std::vector<Sphere>& spheres) const {
    for (Sphere& sphere : spheres) {
      sphere.radius = surface_.contains(sphere.centre) ? surface_.distance(sphere.centre) : 0.0;
    }
    spheres.erase(std::remove_if(spheres.begin(), spheres.end(),
                                 [&](const Sphere& sphere) { return sphere.radius < smallest_; }),
                  spheres.end());
    if (spheres.empty()) spheres.push_back(inscribed_);
  }

  /// Changes all radii by one length, so that the union has the grain's volume. The fit minimizes
  /// distances, and its volume is off by some % with few spheres. Spheres that are too few to fill
  /// the grain are left as they are, because larger ones would only bulge out.
  void match_volume(std::vector<Sphere>& spheres) const {
    constexpr int most_steps = 4;
    constexpr double tolerance = 2e-4;  // of the volume; the union's mesh is not closer
    constexpr double most_missing = 0.1;
    std::vector<Sphere> matched = spheres;
    for (int step = 0; step < most_steps; ++step) {
      const IndexedMesh mesh = sphere_union_mesh(matched, execution_);
      const MeshSums sums = mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), execution_);
      const double missing = volume_ - sums.volume();
      if (std::abs(missing) > most_missing * volume_) return;
      if (std::abs(missing) <= tolerance * volume_) break;
      // The area is the volume's derivative.
      const double change = missing / sums.area();
      for (Sphere& sphere : matched) sphere.radius = std::max(smallest_, sphere.radius + change);
    }
    spheres = std::move(matched);
  }

  /// Removes the spheres that matter least and adds as many: one at first, and one more after each
  /// failure.
  void relocate() {
    constexpr int most_failures = 4;
    constexpr int most_moves = 40;
    const std::size_t count = fit_.spheres().size();
    int failures = 0;
    for (int move = 0; move < most_moves && failures < most_failures; ++move) {
      if (count < static_cast<std::size_t>(failures) + 2) break;
      SphereFit before = fit_;
      for (int i = 0; i <= failures; ++i) fit_.remove(fit_.least_needed());
      next_judging_ = 0;
      while (fit_.spheres().size() < count && add_sphere()) continue;
      sweep(fit_, 6);
      const bool is_better = fit_.energy() < 0.9999 * before.energy();
      failures = is_better ? 0 : failures + 1;
      if (!is_better) fit_ = std::move(before);
    }
  }

  /// Reduces the weight of spheres that bulge out to the weight of gaps.
  SphereFit let_down(SphereFit fit) const {
    for (double weight = 0.5 * held_weight; weight >= 1.0; weight *= 0.5) {
      fit.set_inner_weight(weight);
      sweep(fit, options_.inside ? 2 : 12);
    }
    return fit;
  }

  const ClumpOptions& options_;
  const Execution& execution_;
  const std::function<double(const std::vector<Sphere>&)>& error_percent_;
  double smallest_;  ///< radius
  MeshDistance surface_;
  double volume_;
  std::vector<Vector3> judged_;
  PointBlocks depths_;  ///< of the surface, if spheres must be inside
  std::vector<Sphere> candidates_;
  std::vector<double> gains_;     ///< energy that each candidate saved when last evaluated
  std::size_t next_judging_ = 0;  ///< number of spheres at which all are evaluated again
  Sphere inscribed_;              ///< the largest inside, from which the fit begins
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
      execution.parallel_sum_of(points.size(), block, Sums(), [&](std::size_t i, Sums& part) {
        double least = spheres.front().distance(points[i]);
        for (const Sphere& sphere : spheres) {
          least = std::min(least, sphere.distance(points[i]));
        }
        part.squares += least * least;
        part.largest = std::max(part.largest, std::abs(least));
      });
  return {std::sqrt(sums.squares / static_cast<double>(points.size())), sums.largest};
}

FittedSpheres fit_spheres(const IndexedMesh& unit_grain, const ClumpOptions& options,
                          const Execution& execution,
                          const std::function<double(const std::vector<Sphere>&)>& error_percent) {
  execution.report(0.0, stage_name);
  return Growth(unit_grain, options, execution, error_percent).run();
}

}  // namespace wscvt
