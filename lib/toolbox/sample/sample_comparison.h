// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/sample/distribution.h"
#include "toolbox/sample/grain_sample.h"
#include "wscvt/base/execution.h"

namespace wscvt {

/// A distance between two samples in one descriptor.
struct SampleDistance {
  double kolmogorov = 0.0;  ///< largest difference of the two fractions below a value, 0 to 1
  double wasserstein =
      0.0;  ///< area between the two distribution functions, in the descriptor's unit
  /// Fraction of random divisions of all grains that are at least as far apart (permutation test):
  /// small if the samples differ by more than chance. NaN without repetitions.
  double kolmogorov_p = 0.0;
  double wasserstein_p = 0.0;
};

struct ColumnComparison {
  GrainColumn column;
  double deviation = 0.0;  ///< of the first sample by number, as a scale for the distances
  SampleDistance by_number;
  SampleDistance by_mass;

  /// Returns a Wasserstein distance over the deviation, NaN if all grains of the first sample are
  /// equal.
  double in_deviations(const SampleDistance& distance) const;
};

/// Computes both distances (Kolmogorov 1933, Smirnov 1939; Wasserstein's of order 1); p is NaN. NaN
/// if one distribution is empty.
SampleDistance distance_between(const Distribution& one, const Distribution& other);

/// Compares the descriptors that both samples have, the size first. p = (1 + divisions at least as
/// far apart) / (1 + all), from options.repetitions random divisions, fewer above 4,000 grains but
/// at least 200. Equal options give the same bytes on any number of threads. Throws
/// Error(InvalidInput) if a descriptor or the size has two units, such as mm and um, where "length"
/// is any unit, and if the masses of the samples are from columns of two names, or of one sample
/// only.
std::vector<ColumnComparison> compare_samples(const GrainSample& one, const GrainSample& other,
                                              const SampleOptions& options,
                                              const Execution& execution);

}  // namespace wscvt
