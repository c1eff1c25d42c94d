// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sample/grain_grower.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

namespace {

constexpr double mask_sharpness = 10.0;  ///< a seam is about 2 / this radians wide
constexpr double largest_gain = 3.0;     ///< of a degree's amplitude, and its inverse the smallest
constexpr int first_fine_degree = 7;     ///< from here on amplitudes are set in the final frame too
constexpr double smallest_radius_left = 0.02;  ///< of a grain of radius 1
constexpr double near_fraction = 0.02;         ///< of the sample that donors are taken from
constexpr std::size_t fewest_near = 5;
constexpr double jitter_of_size = 0.15;  ///< over the deviation of the logarithm of the sizes
constexpr int most_attempts = 200;
constexpr int caps_of_collage = 24;
constexpr double cap_angle = 40.0 * pi / 180.0;
constexpr double follows = 0.8;

/// Streams of the order of base grains have keys that no grain's number reaches.
constexpr std::uint64_t order_key = std::uint64_t{1} << 62;

double mean_log(const std::vector<double>& amplitudes, std::size_t first, std::size_t end) {
  double sum = 0.0;
  end = std::min(end, amplitudes.size());
  for (std::size_t l = first; l < end; ++l) sum += std::log(std::max(amplitudes[l], 1e-12));
  return end > first ? sum / static_cast<double>(end - first) : 0.0;
}

void set_degree_gain(std::vector<double>& coefficients, std::size_t l, double gain) {
  for (std::size_t k = l * l; k < (l + 1) * (l + 1); ++k) coefficients[k] *= gain;
}

Vector3 random_signs(RandomStream& random) {
  const std::size_t bits = random.below(8);
  return {(bits & 1) != 0 ? -1.0 : 1.0, (bits & 2) != 0 ? -1.0 : 1.0, (bits & 4) != 0 ? -1.0 : 1.0};
}

std::vector<double> fine_part(std::vector<double> coefficients) {
  constexpr std::size_t coarse = first_fine_degree * first_fine_degree;
  std::fill_n(coefficients.begin(), std::min(coarse, coefficients.size()), 0.0);
  return coefficients;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b,
                   const std::vector<std::size_t>& places, const std::vector<double>& weights) {
  double sum = 0.0, sum_a = 0.0, sum_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (const std::size_t k : places) {
    const double w = weights[k];
    sum += w;
    sum_a += w * a[k];
    sum_b += w * b[k];
    aa += w * a[k] * a[k];
    bb += w * b[k] * b[k];
    ab += w * a[k] * b[k];
  }
  const double spread = (aa - sum_a * sum_a / sum) * (bb - sum_b * sum_b / sum);
  return spread > 0.0 ? (ab - sum_a * sum_b / sum) / std::sqrt(spread) : 0.0;
}

/// Per column: mean 0, deviation 1.
void standardise(std::vector<Eigen::Matrix<double, 5, 1>>& features) {
  const auto count = static_cast<double>(features.size());
  Eigen::Matrix<double, 5, 1> mean = Eigen::Matrix<double, 5, 1>::Zero();
  for (const auto& f : features) mean += f / count;
  Eigen::Matrix<double, 5, 1> square = Eigen::Matrix<double, 5, 1>::Zero();
  for (auto& f : features) {
    f -= mean;
    square += f.cwiseAbs2() / count;
  }
  for (auto& f : features) f.array() /= square.array().sqrt().max(1e-12);
}

}  // namespace

/// A white grain that is joined of donors.
struct GrainGrower::Quilt {
  std::vector<std::vector<double>> donors;  ///< their series, mirrored
  std::vector<double> series;               ///< of the whole, of the logarithm of the radius
};

GrainGrower::GrainGrower(std::vector<SampleGrain> sample, const SampleGrids& grids,
                         const GrowOptions& options)
    : sample_(std::move(sample)), grids_(grids), options_(options) {
  require_in_range(options.donors, donors_option);
  if (sample_.size() < smallest_sample) {
    refuse("The sample has " + std::to_string(sample_.size()) +
           " usable grains; growing takes at least " + std::to_string(smallest_sample) +
           ", and some hundreds for distributions that hold.");
  }
  double sum = 0.0, square = 0.0;
  for (const SampleGrain& grain : sample_) {
    radial_amplitudes_.push_back(degree_amplitudes(grain.radial));
    white_amplitudes_.push_back(degree_amplitudes(grain.white));
    const std::vector<double>& white = white_amplitudes_.back();
    const Vector3 form = grain.deviations.array().log();
    features_.emplace_back();
    features_.back() << form[1] - form[0], form[2] - form[1], mean_log(white, 2, 5),
        mean_log(white, 5, 9), mean_log(white, 9, static_cast<std::size_t>(grids.degree()) + 1);
    sum += std::log(grain.radius);
    square += std::log(grain.radius) * std::log(grain.radius);
  }
  standardise(features_);
  const auto count = static_cast<double>(sample_.size());
  size_jitter_ =
      jitter_of_size * std::sqrt(std::max(0.0, square / count - sum * sum / (count * count)));
  const std::vector<Vector3>& directions = grids.white().directions();
  for (const Vector3& centre : fibonacci_lattice(caps_of_collage)) {
    caps_.emplace_back();
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (directions[k].dot(centre) > std::cos(cap_angle)) caps_.back().push_back(k);
    }
  }
}

std::size_t GrainGrower::base_of(std::size_t index) const {
  std::vector<std::size_t> order(sample_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  RandomStream random(options_.seed, order_key, index / sample_.size());
  for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
  return order[index % sample_.size()];
}

std::vector<std::size_t> GrainGrower::near_grains(std::size_t base) const {
  std::vector<std::pair<double, std::size_t>> distances;
  for (std::size_t k = 0; k < sample_.size(); ++k) {
    if (k != base) distances.emplace_back((features_[k] - features_[base]).squaredNorm(), k);
  }
  const auto wanted =
      static_cast<std::size_t>(std::lround(near_fraction * static_cast<double>(sample_.size())));
  const std::size_t count = std::min(distances.size(), std::max(fewest_near, wanted));
  std::partial_sort(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(count),
                    distances.end());
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < count; ++k) near.push_back(distances[k].second);
  return near;
}

GrainGrower::Quilt GrainGrower::stitch(const std::vector<std::size_t>& donors,
                                       RandomStream& random) const {
  Quilt quilt;
  std::vector<Vector3> centres;
  std::vector<std::vector<double>> fields;
  for (const std::size_t donor : donors) {
    quilt.donors.push_back(mirrored(sample_[donor].white, random_signs(random)));
    centres.push_back(mask_sharpness * random.direction());
    fields.push_back(grids_.white().values(quilt.donors.back()));
  }
  const std::vector<Vector3>& directions = grids_.white().directions();
  std::vector<double> joined(directions.size());
  std::vector<double> shares(donors.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = centres[i].dot(directions[k]);
    const double largest = *std::max_element(shares.begin(), shares.end());
    double value = 0.0, square = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const double share = std::exp(shares[i] - largest);
      value += share * fields[i][k];
      square += share * share;
    }
    joined[k] = value / std::sqrt(square);  // the shares' squares sum to 1: variance is kept
  }
  quilt.series = grids_.white().coefficients(std::move(joined));
  const std::vector<double> amplitudes = degree_amplitudes(quilt.series);
  const std::vector<double>& wanted = white_amplitudes_[donors.front()];
  for (std::size_t l = 2; l < amplitudes.size(); ++l) {
    const double gain = wanted[l] / std::max(amplitudes[l], 1e-9);
    set_degree_gain(quilt.series, l, std::clamp(gain, 1.0 / largest_gain, largest_gain));
  }
  return quilt;
}

double GrainGrower::collage_of(const Quilt& quilt) const {
  const HarmonicGrid& grid = grids_.white();
  const std::vector<double> relief = grid.values(fine_part(quilt.series));
  std::vector<bool> is_followed(caps_.size(), false);
  for (const std::vector<double>& donor : quilt.donors) {
    const std::vector<double> other = grid.values(fine_part(donor));
    for (std::size_t cap = 0; cap < caps_.size(); ++cap) {
      if (correlation(relief, other, caps_[cap], grid.weights()) > follows) is_followed[cap] = true;
    }
  }
  return static_cast<double>(std::count(is_followed.begin(), is_followed.end(), true)) /
         static_cast<double>(caps_.size());
}

std::vector<double> GrainGrower::finished(std::vector<double> radial, std::size_t base,
                                          std::size_t other, double part) const {
  const std::vector<double> amplitudes = degree_amplitudes(radial);
  for (std::size_t l = first_fine_degree; l < amplitudes.size(); ++l) {
    const double wanted = std::pow(radial_amplitudes_[base][l], 1.0 - part) *
                          std::pow(radial_amplitudes_[other][l], part);
    set_degree_gain(radial, l, wanted / std::max(amplitudes[l], 1e-9));
  }
  return radial;
}

std::optional<GrownGrain> GrainGrower::attempt(const std::vector<std::size_t>& near,
                                               std::size_t base, RandomStream& random) const {
  const auto pick = [&] { return near[random.below(near.size())]; };
  GrownGrain grain;
  grain.donors.push_back(base);
  while (grain.donors.size() < static_cast<std::size_t>(options_.donors)) {
    grain.donors.push_back(pick());
  }
  const Quilt quilt = stitch(grain.donors, random);
  std::vector<double> radii = grids_.white().values(quilt.series);
  for (double& radius : radii) radius = std::exp(radius);
  const RadialMoments moments = radial_moments(grids_.white(), radii);

  // The form: that of the base grain, moved along the line to a near one.
  const double form_part = random.uniform(-0.5, 0.5);
  const Vector3 deviations = sample_[base].deviations.array().pow(1.0 - form_part) *
                             sample_[pick()].deviations.array().pow(form_part);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.covariance);
  const Eigen::Matrix3d map = deviations.asDiagonal() * solver.operatorInverseSqrt();
  const HarmonicSeries white(quilt.series);
  const LogRadii surface = [&](const std::vector<Vector3>& directions,
                               std::vector<double>& values) {
    white.sum(directions.data(), directions.size(), values.data());
    return true;
  };
  const HarmonicGrid& grid = grids_.radial();
  const auto formed = radii_in_frame(surface, moments.centroid, map.inverse(), grid.directions());
  grain.radius = sample_[base].radius * std::exp(size_jitter_ * random.normal());
  const double fine_part = random.uniform(-0.5, 0.5);
  const std::size_t other = pick();
  if (!formed) return {};
  const double unit = std::cbrt(radial_moments(grid, *formed).volume / (4.0 * pi / 3.0));
  grain.radial = grid.coefficients(*formed);
  for (double& coefficient : grain.radial) coefficient /= unit;
  grain.radial = finished(std::move(grain.radial), base, other, fine_part);
  const std::vector<double> last = grid.values(grain.radial);
  if (*std::min_element(last.begin(), last.end()) <= smallest_radius_left) return {};
  grain.collage = collage_of(quilt);
  return grain;
}

GrownGrain GrainGrower::grow(std::size_t index) const {
  const std::size_t base = base_of(index);
  const std::vector<std::size_t> near = near_grains(base);
  for (int draw = 0; draw < most_attempts; ++draw) {
    RandomStream random(options_.seed, index, static_cast<std::uint64_t>(draw));
    if (std::optional<GrownGrain> grain = attempt(near, base, random)) {
      grain->redraws = draw;
      return std::move(*grain);
    }
  }
  throw Error(ErrorCode::NumericalFailure,
              "Of virtual grain " + std::to_string(index) + " " + std::to_string(most_attempts) +
                  " attempts were not star-shaped; lower the degree or leave out flat and long "
                  "grains.");
}

}  // namespace wscvt
