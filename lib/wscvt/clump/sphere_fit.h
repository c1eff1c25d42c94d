// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/clump/sphere.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

/// Spheres whose union is fitted to samples of a body. The residual of a sample is its distance to
/// the nearest of the spheres' surfaces, as of a union: the least over the spheres of |p - c| - r.
/// Samples of the surface are to have the residual 0; samples of the inside 0 or less, so that no
/// hollow is left between the spheres; samples of the outside 0 or more, since a sphere may touch
/// the surface from outside. The energy is the sum of the squares over the number of
/// surface samples.
///
/// Lengths are in equivalent radii about the centroid. One fit is the work of one thread.
class SphereFit {
 public:
  struct Limits {
    double smallest_radius = 0.0;           ///< no sphere becomes smaller
    const MeshDistance* surface = nullptr;  ///< where spheres must lie inside: of the body
  };

  SphereFit(const std::vector<Vector3>& on_surface, const std::vector<Vector3>& inside,
            const std::vector<Vector3>& outside, const Limits& limits);

  const std::vector<Sphere>& spheres() const { return spheres_; }
  double energy() const { return energy_; }

  /// The energy that it would have with one sphere more; and an estimate of it from an eighth of
  /// the samples.
  double energy_with(const Sphere& sphere) const;
  double rough_energy_with(const Sphere& sphere) const;
  void add(const Sphere& sphere);

  /// The sphere without which the energy rises least. There must be two or more.
  std::size_t least_needed() const;
  void remove(std::size_t k);

  /// How much more the squares of residuals below 0 count, of samples that a sphere hides; at first
  /// 1. Weights above 1 keep the spheres within the body, and that leaves room for more of them: a
  /// sphere that bulges out on one side and stays within on the other is at rest, and no sphere
  /// more lowers its energy.
  void set_inner_weight(double weight);

  /// Improves each sphere in turn by one step; the energy never rises.
  void sweep();

 private:
  /// The two nearest spheres of a sample; distances as of a union.
  struct Nearest {
    std::int32_t first = -1;
    std::int32_t second = -1;
  };
  /// How a sphere is changed.
  struct Steps {
    double damping = 0.01;  ///< of Gauss-Newton, per sample
    double length = 0.1;    ///< of steps of a sphere that must lie inside, over its radius
    bool rests = false;     ///< no step helps, until a sample gets another nearest sphere
  };

  double weight(double residual) const { return residual < 0.0 ? inner_weight_ : 1.0; }
  double cost(std::size_t i, double distance) const {
    const double residual = std::min(std::max(distance, lowest_[i]), highest_[i]);
    return weight(residual) * residual * residual;
  }
  /// Sum over the first samples of the costs of distance_of(i), over the surface samples. In four
  /// sums, so that the compiler adds four at a time, always in the same order.
  template <class DistanceOf>
  double sum_of_costs(std::size_t samples, const DistanceOf& distance_of) const {
    std::array<double, 4> sums{};
    const std::size_t whole = samples / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4) {
      for (std::size_t lane = 0; lane < 4; ++lane) {
        sums[lane] += cost(i + lane, distance_of(i + lane));
      }
    }
    for (std::size_t i = whole; i < samples; ++i) sums[0] += cost(i, distance_of(i));
    return (sums[0] + sums[1] + (sums[2] + sums[3])) / static_cast<double>(surface_count_);
  }
  double energy_with(const Sphere& sphere, std::size_t samples) const;
  void add_up();
  void distances_to(const Sphere& sphere, std::vector<double>& distances) const;
  bool try_sphere(std::size_t k, const Sphere& sphere);
  void improve_freely(std::size_t k);
  void improve_inside(std::size_t k);
  bool gauss_newton(std::size_t k, bool radius_follows, Sphere& moved) const;
  void wake(std::int32_t k) {
    if (k >= 0) steps_[static_cast<std::size_t>(k)].rests = false;
  }
  void find_nearest(std::size_t i);
  void take(std::size_t k, const Sphere& sphere);

  Limits limits_;
  std::size_t surface_count_;
  std::size_t rough_count_ = 0;  ///< samples of the rough energy, the first ones
  std::vector<double> x_, y_, z_;
  /// Limits of the residual: none on the surface, 0 or more inside, 0 or less outside.
  std::vector<double> lowest_, highest_;
  std::vector<Sphere> spheres_;
  std::vector<Steps> steps_;
  std::vector<std::vector<double>> distances_;  ///< of each sphere, to each sample
  std::vector<Nearest> nearest_;
  std::vector<double> first_, second_;  ///< distances of the two nearest
  double energy_ = 0.0;
  double inner_weight_ = 1.0;
};

}  // namespace wscvt
