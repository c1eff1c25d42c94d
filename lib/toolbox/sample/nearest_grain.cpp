// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/nearest_grain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/sorting.h"

namespace wscvt {

namespace {

constexpr std::size_t most_grains_of_usual = 400;

Eigen::VectorXd amplitudes_of(const std::vector<double>& radial) {
  const std::vector<double> amplitudes = degree_amplitudes(radial);
  return Eigen::Map<const Eigen::VectorXd>(amplitudes.data(), amplitudes.size());
}

bool is_odd(unsigned bits) { return ((bits ^ bits >> 1U ^ bits >> 2U) & 1U) != 0; }

}  // namespace

GrainSearch::GrainSearch(const std::vector<SampleGrain>& sample) {
  if (sample.empty()) refuse("The sample has no grains to compare with. Give at least one.");
  const std::size_t count = sample.front().radial.size();
  for (int wanted = 0; wanted < 8; ++wanted) {
    classes_[wanted] = places_.size();
    for (int l = 0; harmonic_count(l) <= count; ++l) {
      for (int m = -l; m <= l; ++m) {
        if (mirror_class(l, m) == wanted) {
          places_.push_back(harmonic_index(l, m));
        }
      }
    }
  }
  classes_[8] = places_.size();
  sorted_.resize(classes_[8], sample.size());
  for (std::size_t k = 0; k < sample.size(); ++k) {
    sorted_.col(k) = in_classes(sample[k].radial);
  }
  squares_ = sorted_.colwise().squaredNorm();
  amplitudes_.resize(degree_amplitudes(sample.front().radial).size(), sorted_.cols());
  for (std::size_t k = 0; k < sample.size(); ++k) {
    amplitudes_.col(k) = amplitudes_of(sample[k].radial);
  }
}

Eigen::VectorXd GrainSearch::in_classes(const std::vector<double>& radial) const {
  if (radial.size() != places_.size()) {
    refuse("The grain has " + std::to_string(radial.size()) + " coefficients, the sample " +
           std::to_string(places_.size()) + ". Give both the same degree.");
  }
  Eigen::VectorXd sorted(places_.size());
  for (Eigen::Index k = 0; k < sorted.size(); ++k) {
    sorted[k] = radial[places_[k]];
  }
  return sorted;
}

NearestGrain GrainSearch::nearest(const std::vector<double>& radial, std::size_t left_out) const {
  const Eigen::VectorXd grain = in_classes(radial);
  const double square = grain.squaredNorm();
  NearestGrain found;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](Eigen::Index k) {
    std::array<double, 8> products{};
    for (std::size_t c = 0; c < 8; ++c) {
      const Eigen::Index length = classes_[c + 1] - classes_[c];
      products[c] =
          grain.segment(classes_[c], length).dot(sorted_.col(k).segment(classes_[c], length));
    }
    for (unsigned mirror = 0; mirror < 8; ++mirror) {
      double product = 0.0;
      for (unsigned c = 0; c < 8; ++c) product += is_odd(c & mirror) ? -products[c] : products[c];
      const double distance = square + squares_[k] - 2.0 * product;
      if (distance < least) {
        least = distance;
        found.grain = k;
      }
    }
  };
  // Bounds, quick to compute: no mirror image is nearer than the amplitudes of the degrees.
  Eigen::VectorXd bounds =
      (amplitudes_.colwise() - amplitudes_of(radial)).colwise().squaredNorm().transpose();
  if (left_out < static_cast<std::size_t>(bounds.size())) {
    bounds[left_out] = std::numeric_limits<double>::infinity();
  }
  Eigen::Index likely = 0;
  if (std::isfinite(bounds.minCoeff(&likely))) look_at(likely);
  for (Eigen::Index k = 0; k < bounds.size(); ++k) {
    if (bounds[k] < least && k != likely) look_at(k);
  }
  found.distance = std::isfinite(least) ? std::sqrt(std::max(0.0, least) / (4.0 * pi)) : 0.0;
  return found;
}

double GrainSearch::usual_distance(const Execution& execution) const {
  const auto grains = static_cast<std::size_t>(sorted_.cols());
  if (grains < 2) return 0.0;
  const std::size_t count = std::min(grains, most_grains_of_usual);
  std::vector<double> distances(count);
  execution.parallel_for_each(count, 8, [&](std::size_t i) {
    const std::size_t grain = i * grains / count;
    const Eigen::VectorXd sorted = sorted_.col(grain);
    std::vector<double> radial(places_.size());
    for (std::size_t k = 0; k < radial.size(); ++k) {
      radial[places_[k]] = sorted[k];
    }
    distances[i] = nearest(radial, grain).distance;
  });
  return upper_median(distances);
}

}  // namespace wscvt
