// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grain_grower.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "toolbox/sample/sample_grain.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

constexpr double mask_sharpness = 10.0;  ///< a seam is about 2 / this radians wide
constexpr double largest_gain = 3.0;     ///< of a degree's amplitude; the smallest is its inverse
constexpr int first_fine_degree = 7;     ///< from here on amplitudes are set in the final frame too
constexpr double smallest_radius_left = 0.02;  ///< of a grain of radius 1
constexpr double near_fraction = 0.02;         ///< of the sample; donors are drawn from it
constexpr std::size_t fewest_near = 5;
constexpr double jitter_of_size = 0.15;  ///< over the deviation of the logarithm of the sizes
constexpr int most_attempts = 200;
/// Number of usable attempts, of which the nearest to the base grain in sphericity and convexity is
/// used. Seams make hollows: without a choice convexity was 0.13 deviations too low.
constexpr std::size_t candidates_of_grain = 3;
constexpr int caps_of_collage = 24;
constexpr double cap_angle = 40.0 * pi / 180.0;
constexpr double follows = 0.8;

/// First key of the order of base grains, one key per round; larger than any grain's number.
constexpr std::uint64_t order_key = std::uint64_t{1} << 62;

double mean_log(const std::vector<double>& amplitudes, std::size_t first, std::size_t end) {
  double sum = 0.0;
  end = std::min(end, amplitudes.size());
  for (std::size_t l = first; l < end; ++l) sum += portable::log(std::max(amplitudes[l], 1e-12));
  return end > first ? sum / static_cast<double>(end - first) : 0.0;
}

void set_degree_gain(std::vector<double>& coefficients, std::size_t l, double gain) {
  for (std::size_t k = l * l; k < (l + 1) * (l + 1); ++k) coefficients[k] *= gain;
}

Vector3 signs_of(std::size_t bits) {
  return {(bits & 1) != 0 ? -1.0 : 1.0, (bits & 2) != 0 ? -1.0 : 1.0, (bits & 4) != 0 ? -1.0 : 1.0};
}

Vector3 random_signs(RandomStream& random) { return signs_of(random.below(8)); }

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

/// Returns nothing for a mesh that encloses no volume.
std::optional<QuickShape> shape_of(const IndexedMesh& mesh) {
  try {
    return quick_shape(mesh, Execution(1));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InvalidInput) throw;
    return {};
  }
}

Vector3 powers(const Vector3& bases, double exponent) {
  return bases.unaryExpr([exponent](double base) { return portable::pow(base, exponent); });
}

/// Returns the deviations of sphericity and convexity over the sample; above 0.
Eigen::Vector2d deviations_of(const std::vector<SampleGrain>& sample) {
  Eigen::Array2Xd values(2, sample.size());
  for (std::size_t k = 0; k < sample.size(); ++k) {
    values.col(k) << sample[k].sphericity, sample[k].convexity;
  }
  values.colwise() -= values.rowwise().mean().eval();
  return values.square().rowwise().mean().sqrt().max(1e-12);
}

/// Scales each column to mean 0, deviation 1.
void standardise(std::vector<GrainFeatures>& features) {
  const auto count = static_cast<double>(features.size());
  GrainFeatures mean = GrainFeatures::Zero();
  for (const auto& f : features) mean += f / count;
  GrainFeatures square = GrainFeatures::Zero();
  for (auto& f : features) {
    f -= mean;
    square += f.cwiseAbs2() / count;
  }
  for (auto& f : features) f.array() /= square.array().sqrt().max(1e-12);
}

/// Smooth Voronoi masks, a weight per direction and donor. The weights' squares sum to 1, which
/// keeps the variance of unrelated fields. For aligned fields, the weights sum to 1.
class Masks {
 public:
  Masks(const std::vector<Vector3>& directions, const std::vector<Vector3>& centres,
        bool are_aligned)
      : donors_(centres.size()) {
    for (const Vector3& direction : directions) {
      const auto first = static_cast<std::ptrdiff_t>(shares_.size());
      for (const Vector3& centre : centres) shares_.push_back(centre.dot(direction));
      const double largest = *std::max_element(shares_.begin() + first, shares_.end());
      double sum = 0.0;
      for (auto share = shares_.begin() + first; share != shares_.end(); ++share) {
        *share = portable::exp(*share - largest);
        sum += are_aligned ? *share : *share * *share;
      }
      lengths_.push_back(are_aligned ? sum : std::sqrt(sum));
    }
  }

  /// Returns the values of a field joined from the donors' series; an empty series is 0.
  std::vector<double> joined(const HarmonicGrid& grid,
                             const std::vector<std::vector<double>>& series) const {
    std::vector<double> sums(lengths_.size(), 0.0);
    for (std::size_t i = 0; i < donors_; ++i) {
      if (series[i].empty()) continue;
      const std::vector<double> values = grid.values(series[i]);
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += shares_[k * donors_ + i] * values[k];
    }
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= lengths_[k];
    return sums;
  }

 private:
  std::size_t donors_;
  std::vector<double> shares_;
  std::vector<double> lengths_;
};

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return a.empty() || b.empty() ? 0.0 : std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Returns the mirror image of a white grain that fits best on another white grain.
Vector3 aligned_signs(const SampleGrain& grain, const std::vector<double>& series,
                      const OffsetSeries& offset) {
  Vector3 best = Vector3::Ones();
  double most = -std::numeric_limits<double>::infinity();
  for (unsigned bits = 0; bits < 8; ++bits) {
    const Vector3 signs = signs_of(bits);
    const OffsetSeries image = mirrored_offset(grain.white_offset, signs);
    double match = product(mirrored(grain.white, signs), series);
    for (std::size_t axis = 0; axis < 3; ++axis) match += product(image[axis], offset[axis]);
    if (match > most) {
      most = match;
      best = signs;
    }
  }
  return best;
}

}  // namespace

/// A white grain joined from donors.
struct GrainGrower::Quilt {
  std::vector<std::vector<double>> donors;  ///< their series, mirrored
  std::vector<double> series;               ///< the joined series of the logarithm of the radius
  OffsetSeries offset;                      ///< the joined offset
};

/// A usable attempt.
struct GrainGrower::Candidate {
  GrownGrain grain;
  Quilt quilt;
  double distance = 0.0;  ///< to the base grain, in squared deviations of the sample
};

GrainGrower::GrainGrower(std::vector<SampleGrain> sample, const SampleGrids& grids,
                         const GrowOptions& options)
    : sample_(std::move(sample)), grids_(grids), options_(options) {
  require_in_range(options.donors, donors_option);
  if (sample_.size() < smallest_sample) {
    refuse("The sample has " + format_count(sample_.size(), "usable grain") +
           ". Growing needs at least " + std::to_string(smallest_sample) +
           ", and some hundreds for reliable distributions.");
  }
  double sum = 0.0, square = 0.0;
  for (const SampleGrain& grain : sample_) {
    radial_amplitudes_.push_back(degree_amplitudes(grain.radial));
    white_amplitudes_.push_back(degree_amplitudes(grain.white));
    const std::vector<double>& white = white_amplitudes_.back();
    const Vector3 form = grain.deviations.unaryExpr([](double x) { return portable::log(x); });
    features_.emplace_back();
    features_.back() << form[1] - form[0], form[2] - form[1], mean_log(white, 2, 5),
        mean_log(white, 5, 9), mean_log(white, 9, static_cast<std::size_t>(grids.degree()) + 1),
        rms_offset(grain.white_offset);
    sum += portable::log(grain.radius);
    square += portable::log(grain.radius) * portable::log(grain.radius);
  }
  standardise(features_);
  deviations_ = deviations_of(sample_);
  const auto count = static_cast<double>(sample_.size());
  size_jitter_ =
      jitter_of_size * std::sqrt(std::max(0.0, square / count - sum * sum / (count * count)));
  const std::vector<Vector3>& directions = grids.white().directions();
  for (const Vector3& centre : fibonacci_lattice(caps_of_collage)) {
    caps_.emplace_back();
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (directions[k].dot(centre) > portable::cos(cap_angle)) caps_.back().push_back(k);
    }
  }
}

std::size_t GrainGrower::base_of(std::size_t index) const {
  return drawn_place(index % sample_.size(), sample_.size(), options_.seed,
                     order_key + index / sample_.size());
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
  std::vector<OffsetSeries> offsets;
  const bool any_offset = std::any_of(donors.begin(), donors.end(), [&](std::size_t k) {
    return has_offset(sample_[k].white_offset);
  });
  for (const std::size_t donor : donors) {
    const SampleGrain& grain = sample_[donor];
    Vector3 signs = random_signs(random);
    // Half a hook and half its mirror image would not make a hook.
    if (any_offset && !offsets.empty()) {
      signs = aligned_signs(grain, quilt.donors.front(), offsets.front());
    }
    quilt.donors.push_back(mirrored(grain.white, signs));
    offsets.push_back(mirrored_offset(grain.white_offset, signs));
    centres.push_back(mask_sharpness * random.direction());
  }
  const Masks masks(grids_.white().directions(), centres, any_offset);
  quilt.series = grids_.white().coefficients(masks.joined(grids_.white(), quilt.donors));
  if (any_offset) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<std::vector<double>> parts;
      parts.reserve(offsets.size());
      for (const OffsetSeries& offset : offsets) parts.push_back(offset[axis]);
      quilt.offset[axis] = grids_.white().coefficients(masks.joined(grids_.white(), parts));
    }
  }
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
    const double wanted = portable::pow(radial_amplitudes_[base][l], 1.0 - part) *
                          portable::pow(radial_amplitudes_[other][l], part);
    set_degree_gain(radial, l, wanted / std::max(amplitudes[l], 1e-9));
  }
  return radial;
}

bool GrainGrower::take_form(GrownGrain& grain, const Quilt& quilt,
                            const Vector3& deviations) const {
  std::vector<double> radii = grids_.white().values(quilt.series);
  for (double& radius : radii) radius = portable::exp(radius);
  const RadialMoments moments = radial_moments(grids_.white(), radii);
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
  if (!formed) return false;
  const double unit = portable::cbrt(radial_moments(grid, *formed).volume / (4.0 * pi / 3.0));
  grain.radial = grid.coefficients(*formed);
  for (double& coefficient : grain.radial) coefficient /= unit;
  return true;
}

bool GrainGrower::take_form_with_offset(GrownGrain& grain, const Quilt& quilt,
                                        const Vector3& deviations) const {
  const auto points_of = [&](const std::vector<Vector3>& directions) {
    std::vector<double> logarithms(directions.size());
    HarmonicSeries(quilt.series).sum(directions.data(), directions.size(), logarithms.data());
    std::vector<Vector3> points = offset_values(quilt.offset, directions);
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] += portable::exp(logarithms[k]) * directions[k];
    }
    return points;
  };
  const std::optional<QuickShape> described =
      shape_of({points_of(grids_.sphere().points), grids_.sphere().triangles});
  if (!described) return false;
  const ShapeDescriptors& shape = described->shape;
  const Eigen::Matrix3d turn = shape.principal_axes.toRotationMatrix();
  const Vector3 stretch = shape.inertia_semi_axes.reverse().cwiseInverse();
  Eigen::Matrix3d map = deviations.asDiagonal() * turn * stretch.asDiagonal() * turn.transpose();
  map *= portable::cbrt(4.0 * pi / 3.0 / (shape.volume * map.determinant()));
  const Eigen::Matrix3d inverse = map.inverse();
  const HarmonicGrid& grid = grids_.radial();
  std::vector<Vector3> directions = grid.directions();
  for (Vector3& direction : directions) direction = (inverse * direction).normalized();
  std::vector<Vector3> points = points_of(directions);
  for (Vector3& point : points) point = map * (point - shape.centroid);
  RadiiAndOffsets parts = split_points(points, grid.directions());
  grain.radial = grid.coefficients(std::move(parts.radii));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grain.offset[axis] = grid.coefficients(std::move(parts.offsets[axis]));
  }
  return true;
}

double GrainGrower::distance_to_base(const GrownGrain& grain) const {
  const IndexedMesh& sphere = grids_.sphere();
  const std::optional<QuickShape> quick =
      shape_of({surface_points(grain.radial, grain.offset, sphere.points), sphere.triangles});
  if (!quick) return std::numeric_limits<double>::infinity();
  const SampleGrain& base = sample_[grain.donors.front()];
  const Eigen::Vector2d difference(quick->shape.sphericity - base.sphericity,
                                   quick->convexity - base.convexity);
  return difference.cwiseQuotient(deviations_).squaredNorm();
}

bool GrainGrower::is_usable(const GrownGrain& grain) const {
  if (!has_offset(grain.offset)) {
    const std::vector<double> radii = grids_.radial().values(grain.radial);
    return *std::min_element(radii.begin(), radii.end()) > smallest_radius_left;
  }
  const IndexedMesh& sphere = grids_.sphere();
  return self_intersections(
             {surface_points(grain.radial, grain.offset, sphere.points), sphere.triangles})
      .empty();
}

std::optional<GrainGrower::Candidate> GrainGrower::attempt(const std::vector<std::size_t>& near,
                                                           std::size_t base,
                                                           RandomStream& random) const {
  const auto pick = [&] { return near[random.below(near.size())]; };
  GrownGrain grain;
  grain.donors.push_back(base);
  while (grain.donors.size() < static_cast<std::size_t>(options_.donors)) {
    grain.donors.push_back(pick());
  }
  const Quilt quilt = stitch(grain.donors, random);
  // The form of the base grain, moved along the line to a similar grain's.
  const double form_part = random.uniform(-0.5, 0.5);
  const Vector3 deviations = powers(sample_[base].deviations, 1.0 - form_part)
                                 .cwiseProduct(powers(sample_[pick()].deviations, form_part));
  grain.radius = sample_[base].radius * portable::exp(size_jitter_ * random.normal());
  const double fine_part = random.uniform(-0.5, 0.5);
  const std::size_t other = pick();
  const bool is_formed = has_offset(quilt.offset) ? take_form_with_offset(grain, quilt, deviations)
                                                  : take_form(grain, quilt, deviations);
  if (!is_formed) return {};
  grain.radial = finished(std::move(grain.radial), base, other, fine_part);
  if (!is_usable(grain)) return {};
  Candidate candidate{std::move(grain), quilt, 0.0};
  candidate.distance = distance_to_base(candidate.grain);
  if (!std::isfinite(candidate.distance)) return {};
  return candidate;
}

GrownGrain GrainGrower::grow(std::size_t index, const GrainCheck& is_accepted) const {
  const std::size_t base = base_of(index);
  const std::vector<std::size_t> near = near_grains(base);
  std::vector<Candidate> candidates;
  int unusable = 0;
  for (int draw = 0; draw < most_attempts; ++draw) {
    const bool is_last = draw + 1 == most_attempts;
    RandomStream random(options_.seed, index, static_cast<std::uint64_t>(draw));
    if (std::optional<Candidate> candidate = attempt(near, base, random)) {
      candidates.push_back(std::move(*candidate));
    } else {
      ++unusable;
    }
    if (candidates.size() < candidates_of_grain && !is_last) continue;
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    for (Candidate& candidate : candidates) {
      if (!is_accepted(candidate.grain)) {
        ++unusable;
        continue;
      }
      candidate.grain.redraws = unusable;
      candidate.grain.collage = collage_of(candidate.quilt);
      return std::move(candidate.grain);
    }
    candidates.clear();
  }
  throw Error(
      ErrorCode::NumericalFailure,
      std::to_string(most_attempts) + " attempts at virtual grain " + std::to_string(index) +
          " were not star-shaped or intersected themselves. Lower the degree, "
          "give more nodes, or leave out flat grains, long grains and grains with deep overhangs.");
}

}  // namespace wscvt
