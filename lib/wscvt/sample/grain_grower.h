// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/sample/grow_options.h"
#include "wscvt/sample/random_stream.h"
#include "wscvt/sample/sample_grain.h"

namespace wscvt {

/// A virtual grain.
struct GrownGrain {
  double radius = 0.0;              ///< of the sphere of equal volume, length
  std::vector<double> radial;       ///< as SampleGrain::radial
  std::vector<std::size_t> donors;  ///< numbers of the real grains, the base grain first
  int redraws = 0;                  ///< attempts before it that were not star-shaped
  /// Fraction of 24 caps of 40 degrees in which the fine relief follows that of one donor: waves of
  /// degree 7 and more, correlation above 0.8.
  double collage = 0.0;
};

/// Grows virtual grains with the statistics of real ones, as quilts. A base grain and real grains
/// near to it in form and roughness are made white (see SampleGrain), mirrored at random and joined
/// on the sphere by smooth Voronoi masks, whose weights keep the variance across the seams. Each
/// degree then gets the amplitude of the base grain, and the whole the inertia of the base grain,
/// moved a little towards that of a near one.
///
/// The base grains of grains 0 to n - 1 are all n grains of the sample once, so are those of the
/// next n. Each grain has a random stream of its own: grain k is the same in whatever order grains
/// are grown.
class GrainGrower {
 public:
  /// The grids must outlive the grower. Throws Error(InvalidInput) for fewer than
  /// `smallest_sample` grains and options out of range.
  GrainGrower(std::vector<SampleGrain> sample, const SampleGrids& grids,
              const GrowOptions& options);

  static constexpr std::size_t smallest_sample = 8;

  const std::vector<SampleGrain>& sample() const { return sample_; }

  /// Grain number `index`. May be called from several threads. Throws Error(NumericalFailure) if
  /// 200 attempts give no star-shaped grain.
  GrownGrain grow(std::size_t index) const;

 private:
  struct Quilt;
  std::vector<std::size_t> near_grains(std::size_t base) const;
  Quilt stitch(const std::vector<std::size_t>& donors, RandomStream& random) const;
  std::optional<GrownGrain> attempt(const std::vector<std::size_t>& near, std::size_t base,
                                    RandomStream& random) const;
  std::vector<double> finished(std::vector<double> radial, std::size_t base, std::size_t other,
                               double part) const;
  double collage_of(const Quilt& quilt) const;
  std::size_t base_of(std::size_t index) const;

  std::vector<SampleGrain> sample_;
  const SampleGrids& grids_;
  GrowOptions options_;
  std::vector<std::vector<double>> radial_amplitudes_;
  std::vector<std::vector<double>> white_amplitudes_;
  std::vector<Eigen::Matrix<double, 5, 1>> features_;
  std::vector<std::vector<std::size_t>> caps_;  ///< places of the white grid in each cap
  double size_jitter_ = 0.0;
};

}  // namespace wscvt
