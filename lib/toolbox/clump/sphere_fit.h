// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "toolbox/clump/point_blocks.h"
#include "toolbox/clump/sphere.h"

namespace wscvt {

/// Spheres whose union is fitted to samples of a body. The residual of a sample is its distance to
/// the union: the minimum of |p - c| - r over the spheres. Samples on the surface should have the
/// residual 0. Samples inside should have 0 or less, so that no hollow is left between the spheres.
/// Samples outside should have 0 or more, because a sphere may touch the surface from outside. The
/// energy is the sum of the squares over the number of surface samples.
///
/// Samples are stored in blocks of neighbours. A sphere that moves visits only the blocks near it,
/// so a step is cheaper with more spheres.
///
/// Lengths are in equivalent radii about the centroid. Each fit runs on one thread.
class SphereFit {
 public:
  struct Limits {
    double smallest_radius = 0.0;                                     ///< no sphere becomes smaller
    double largest_radius = std::numeric_limits<double>::infinity();  ///< nor larger, freely
    /// Of the surface, if spheres must be inside: a radius is then the centre's distance to them.
    const PointBlocks* depths = nullptr;
  };

  SphereFit(const std::vector<Vector3>& on_surface, const std::vector<Vector3>& inside,
            const std::vector<Vector3>& outside, const Limits& limits);

  const std::vector<Sphere>& spheres() const { return spheres_; }
  double energy() const { return energy_; }

  /// Returns the energy with one more sphere.
  double energy_with(const Sphere& sphere) const;
  void add(const Sphere& sphere);

  /// Returns the sphere whose removal raises the energy least. There must be two or more.
  std::size_t least_needed() const;
  void remove(std::size_t k);

  /// Sets the weight of squared residuals below 0, of samples within a sphere; at first 1. Weights
  /// above 1 keep the spheres within the body, which leaves room for more spheres. Otherwise a
  /// sphere that bulges out on one side and stays within on the other is at rest, and no additional
  /// sphere lowers the energy.
  void set_inner_weight(double weight);

  /// Improves each sphere in turn by one step; the energy never rises.
  void sweep();

 private:
  enum class Kind { Surface, Inside, Outside };
  /// Neighbouring samples of one kind.
  struct Block : PointBlock {
    Kind kind = Kind::Surface;
    double most_first = 0.0;   ///< largest distance to a nearest sphere
    double most_second = 0.0;  ///< largest distance to a second nearest sphere
    double cost = 0.0;

    /// Lower bound of the samples' distances to the sphere.
    double reach(const Sphere& sphere) const { return sphere.distance(centre) - radius; }
  };
  /// The two nearest spheres of a sample; distances as to a union.
  struct Nearest {
    std::int32_t first = -1;
    std::int32_t second = -1;
  };
  /// Step control of a sphere.
  struct Steps {
    double damping = 0.01;  ///< of Gauss-Newton, per sample
    double length = 0.1;    ///< of steps of a sphere that must be inside, over its radius
    bool rests = false;     ///< no step helps until a sample gets another nearest sphere
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
    if (k >= 0) steps_[k].rests = false;
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
