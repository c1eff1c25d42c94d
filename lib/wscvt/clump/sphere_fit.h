// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "wscvt/clump/point_blocks.h"
#include "wscvt/clump/sphere.h"

namespace wscvt {

/// Spheres whose union is fitted to samples of a body. The residual of a sample is its distance to
/// the nearest of the spheres' surfaces, as of a union: the least over the spheres of |p - c| - r.
/// Samples of the surface are to have the residual 0; samples of the inside 0 or less, so that no
/// hollow is left between the spheres; samples of the outside 0 or more, since a sphere may touch
/// the surface from outside. The energy is the sum of the squares over the number of
/// surface samples.
///
/// Samples lie in blocks of neighbours. A sphere that moves visits only the blocks that it may be
/// near to, so that a step costs the less the more spheres there are.
///
/// Lengths are in equivalent radii about the centroid. One fit is the work of one thread.
class SphereFit {
 public:
  struct Limits {
    double smallest_radius = 0.0;                                     ///< no sphere becomes smaller
    double largest_radius = std::numeric_limits<double>::infinity();  ///< nor larger, freely
    /// Of the surface, if spheres must lie inside: a radius is the depth of the centre below them.
    const PointBlocks* depths = nullptr;
  };

  SphereFit(const std::vector<Vector3>& on_surface, const std::vector<Vector3>& inside,
            const std::vector<Vector3>& outside, const Limits& limits);

  const std::vector<Sphere>& spheres() const { return spheres_; }
  double energy() const { return energy_; }

  /// The energy that it would have with one sphere more.
  double energy_with(const Sphere& sphere) const;
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
  enum class Kind { Surface, Inside, Outside };
  /// Samples of one kind beside each other.
  struct Block : PointBlock {
    Kind kind = Kind::Surface;
    double most_first = 0.0;   ///< the largest distance to a nearest sphere
    double most_second = 0.0;  ///< and to a second one
    double cost = 0.0;

    /// No sample is nearer to the sphere.
    double reach(const Sphere& sphere) const { return sphere.distance(centre) - radius; }
  };
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

  double cost(Kind kind, double distance) const {
    const double residual = kind == Kind::Surface  ? distance
                            : kind == Kind::Inside ? std::max(distance, 0.0)
                                                   : std::min(distance, 0.0);
    return (residual < 0.0 ? inner_weight_ : 1.0) * residual * residual;
  }
  double distance(std::size_t i, const Sphere& sphere) const {
    return sphere.distance(Vector3(x_[i], y_[i], z_[i]));
  }
  void append(const std::vector<Vector3>& points, Kind kind);
  void update(Block& block);
  void add_up();
  bool try_sphere(std::size_t k, const Sphere& sphere);
  void improve_freely(std::size_t k);
  void improve_inside(std::size_t k);
  bool gauss_newton(std::size_t k, bool radius_follows, Sphere& moved) const;
  void wake(std::int32_t k) {
    if (k >= 0) steps_[static_cast<std::size_t>(k)].rests = false;
  }
  void find_nearest(std::size_t i);
  void move_nearest(std::size_t i, std::int32_t own, double distance);
  void take(std::size_t k, const Sphere& sphere);

  Limits limits_;
  std::size_t surface_count_;
  std::vector<Block> blocks_;
  std::vector<double> x_, y_, z_;
  std::vector<Sphere> spheres_;
  std::vector<Steps> steps_;
  std::vector<Nearest> nearest_;
  std::vector<double> first_, second_;  ///< distances of the two nearest
  double energy_ = 0.0;
  double inner_weight_ = 1.0;
};

}  // namespace wscvt
