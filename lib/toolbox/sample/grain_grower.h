// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "toolbox/sample/random_stream.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"

namespace wscvt {

/// Options of virtual grains.
struct GrowOptions {
  /// Number of real grains per virtual grain, 2 to 8. With 2, 47 % of the caps of 40 degrees follow
  /// one donor, with 3 28 %, with 4 18 %. With 4, grown grains are easier to tell from real ones
  /// (tests/figures/study/virtual_grains.md). Users always have 3.
  int donors = 3;
  std::uint64_t seed = 1;
};

inline constexpr NumberOption<int> donors_option = {
    "donors", "number of donors", 2, 8, Ends::Both, "real grains per virtual grain"};
inline constexpr NumberOption<std::uint64_t> sample_seed_option = {
    "seed",     "seed",
    0,          std::numeric_limits<std::uint64_t>::max(),
    Ends::Both, "the same seed gives the same grains"};

/// Features for finding similar grains: two of the form, three of the relief, one of the overhangs.
using GrainFeatures = Eigen::Matrix<double, 6, 1>;

/// A virtual grain.
struct GrownGrain {
  double radius = 0.0;              ///< of the sphere of equal volume, length
  std::vector<double> radial;       ///< as SampleGrain::radial
  OffsetSeries offset;              ///< as SampleGrain::radial_offset
  std::vector<std::size_t> donors;  ///< numbers of the real grains, the base grain first
  int redraws = 0;                  ///< unusable attempts before it
  /// Fraction of 24 caps of 40 degrees in which the fine relief follows that of one donor: waves of
  /// degree 7 and more, correlation above 0.8.
  double collage = 0.0;
};

/// Grows virtual grains with the statistics of real ones, as quilts. A base grain and real grains
/// of similar form and roughness are made white (see SampleGrain), mirrored at random and joined on
/// the sphere by smooth Voronoi masks, whose weights keep the variance across the seams. Each
/// degree then gets the amplitude of the base grain. The whole gets the inertia of the base grain,
/// moved a little towards a similar grain's. Offsets of grains with overhangs are joined by the
/// same masks, and amplitudes are the radii's.
///
/// The base grains of grains 0 to n - 1 are all n grains of the sample once, and so on for each
/// further n. Each grain has its own random stream, so grain k does not depend on the order of
/// growing.
class GrainGrower {
 public:
  using GrainCheck = std::function<bool(const GrownGrain&)>;

  /// The grids must outlive the grower. Throws Error(InvalidInput) for fewer than
  /// `smallest_sample` grains and options out of range.
  GrainGrower(std::vector<SampleGrain> sample, const SampleGrids& grids,
              const GrowOptions& options);

  static constexpr std::size_t smallest_sample = 8;

  const std::vector<SampleGrain>& sample() const { return sample_; }

  /// Returns grain number `index`. Attempts are usable if they are star-shaped or, with an offset,
  /// do not intersect themselves. Of each three usable attempts, or fewer at the end, the one with
  /// sphericity and convexity nearest to the base grain's that passes `is_accepted` is returned.
  /// May be called from several threads. Throws Error(NumericalFailure) if 200 attempts give no
  /// such grain.
  GrownGrain grow(std::size_t index, const GrainCheck& is_accepted) const;
  GrownGrain grow(std::size_t index) const {
    return grow(index, [](const GrownGrain&) { return true; });
  }

 private:
  struct Quilt;
  struct Candidate;
  std::vector<std::size_t> near_grains(std::size_t base) const;
  Quilt stitch(const std::vector<std::size_t>& donors, RandomStream& random) const;
  bool take_form(GrownGrain& grain, const Quilt& quilt, const Vector3& deviations) const;
  bool take_form_with_offset(GrownGrain& grain, const Quilt& quilt,
                             const Vector3& deviations) const;
  double distance_to_base(const GrownGrain& grain) const;
  bool is_usable(const GrownGrain& grain) const;
  std::optional<Candidate> attempt(const std::vector<std::size_t>& near, std::size_t base,
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
  std::vector<GrainFeatures> features_;
  std::vector<std::vector<std::size_t>> caps_;  ///< places of the white grid in each cap
  double size_jitter_ = 0.0;
  Eigen::Vector2d deviations_;  ///< of sphericity and convexity over the sample
};

}  // namespace wscvt
