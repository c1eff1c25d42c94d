// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

// The grey values of the scan along lines across the surface, from 5 voxels outside to 6 inside.
constexpr double first_place = -5.0;
constexpr double bin_width = 0.5;
constexpr std::size_t bins = 23;

/// Sums of the places and grey values in each bin.
struct Profile {
  std::array<float, bins> counts = {};
  std::array<float, bins> places = {};
  std::array<float, bins> values = {};

  void add(double place, double value) {
    const double bin = std::round((place - first_place) / bin_width);
    if (bin < 0.0 || bin >= static_cast<double>(bins)) return;
    const auto k = static_cast<std::size_t>(bin);
    counts[k] += 1.0F;
    places[k] += static_cast<float>(place);
    values[k] += static_cast<float>(value);
  }
  void add(const Profile& other) {
    for (std::size_t k = 0; k < bins; ++k) {
      counts[k] += other.counts[k];
      places[k] += other.places[k];
      values[k] += other.values[k];
    }
  }
  float size() const {
    float sum = 0.0F;
    for (const float count : counts) sum += count;
    return sum;
  }
};

/// Follows lines across the surface of grains, along the axes that are near its normal.
class EdgeLines {
 public:
  EdgeLines(const LevelledVolume& volume, const std::vector<std::uint16_t>& scan,
            const std::vector<std::uint32_t>& labels, bool is_dark)
      : volume_(volume), scan_(scan), labels_(labels), sign_(is_dark ? -1.0 : 1.0) {
    steps_ = {1, volume.counts[0], std::ptrdiff_t{volume.counts[0]} * volume.counts[1]};
  }

  /// Returns the profile of each label.
  std::vector<Profile> profiles() {
    profiles_.resize(*std::max_element(labels_.begin(), labels_.end()) + std::size_t{1});
    const auto& [width, rows, slices] = volume_.counts;
    // The blur along much longer edges of voxels is another one.
    constexpr double longest = 1.5;
    const double shortest = *std::min_element(volume_.spacing.begin(), volume_.spacing.end());
    std::ptrdiff_t k = 0;
    for (int z = 0; z < slices; ++z) {
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < width; ++x, ++k) {
          const std::array<int, 3> at = {x, y, z};
          if (std::min({x, y, z, width - 1 - x, rows - 1 - y, slices - 1 - z}) < 2) continue;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (volume_.spacing[axis] > longest * shortest) continue;
            look(k, at, axis, 1);
            look(k, at, axis, -1);
          }
        }
      }
    }
    return std::move(profiles_);
  }

 private:
  double over(std::ptrdiff_t k) const {
    return sign_ * (static_cast<double>(volume_.grey[static_cast<std::size_t>(k)]) - volume_.level);
  }
  std::uint32_t label(std::ptrdiff_t k) const { return labels_[static_cast<std::size_t>(k)]; }

  /// Returns how much a line along an axis is along the gradient.
  double cosine(std::ptrdiff_t k, std::size_t axis) const {
    std::array<double, 3> gradient = {};
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const double value = over(k + x + y * steps_[1] + z * steps_[2]);
          gradient[0] += x * value / volume_.spacing[0];
          gradient[1] += y * value / volume_.spacing[1];
          gradient[2] += z * value / volume_.spacing[2];
        }
      }
    }
    const double length = std::sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] +
                                    gradient[2] * gradient[2]);
    return length > 0.0 ? gradient[axis] / length : 0.0;
  }

  /// Takes the line from voxel `k` on, if the surface is between it and the next one.
  void look(std::ptrdiff_t k, const std::array<int, 3>& at, std::size_t axis, int direction) {
    const std::ptrdiff_t step = direction * steps_[axis];
    const double before = over(k);
    const double behind = over(k + step);
    const std::uint32_t inside = label(k + 2 * step);
    if (!(before < 0.0 && behind >= 0.0) || inside == 0 || label(k - step) != 0) return;
    constexpr double least_cosine = 0.85;
    const double along = direction * cosine(k, axis);
    if (along < least_cosine) return;
    const double voxel =
        portable::cbrt(volume_.spacing[0] * volume_.spacing[1] * volume_.spacing[2]);
    const double scale = along * volume_.spacing[axis] / voxel;
    const double surface = before / (before - behind);
    const int size = volume_.counts[axis];
    constexpr int farthest = 8;
    const auto add = [&](int away) {
      const auto other = static_cast<std::size_t>(k + away * step);
      if (is_marked(volume_.left_out, other)) return false;
      profiles_[inside].add(scale * (away - surface), scan_[other]);
      return true;
    };
    const auto is_in = [&](int away) {
      const int place = at[axis] + direction * away;
      return place >= 0 && place < size;
    };
    // Up to the blur of the other side, which thin grains have near.
    for (int away = 1; away <= farthest && is_in(away + 2); ++away) {
      if (label(k + (away + 2) * step) != inside || !add(away)) break;
    }
    // Up to the blur of the next grain.
    for (int away = 0; away >= -farthest && is_in(away - 2); --away) {
      if (label(k + (away - 1) * step) != 0 || label(k + (away - 2) * step) != 0) break;
      if (!add(away)) break;
    }
  }

  const LevelledVolume& volume_;
  const std::vector<std::uint16_t>& scan_;
  const std::vector<std::uint32_t>& labels_;
  double sign_;
  std::array<std::ptrdiff_t, 3> steps_ = {};
  std::vector<Profile> profiles_;
};

/// Grey values of a blurred step, or of two.
struct FittedEdge {
  double error = std::numeric_limits<double>::max();  ///< mean square
  double blur = 0.0;                                  ///< a standard deviation, voxels
  EdgeSteps steps;
};

/// Mean grey values of a profile, of bins with enough of them.
struct ProfilePoints {
  explicit ProfilePoints(const Profile& profile) {
    constexpr float fewest = 8.0F;
    constexpr float most = 40.0F;
    for (std::size_t k = 0; k < bins; ++k) {
      if (profile.counts[k] < fewest) continue;
      places.push_back(profile.places[k] / profile.counts[k]);
      values.push_back(profile.values[k] / profile.counts[k]);
      weights.push_back(std::min(profile.counts[k], most));
    }
  }
  std::vector<double> places;
  std::vector<double> values;
  std::vector<double> weights;
};

/// Fits blurred steps by their shares at the points: void, layer, inside; `deeper` empty: one step.
/// Keeps the better one of this and `best`.
void fit_steps(const ProfilePoints& points, const std::vector<double>& first,
               const std::vector<double>* deeper, const FittedEdge& of, FittedEdge& best) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0;
  double weights = 0.0;
  for (std::size_t k = 0; k < points.places.size(); ++k) {
    const double weight = points.weights[k];
    const Eigen::Vector3d row(1.0, first[k], deeper != nullptr ? (*deeper)[k] : 0.0);
    matrix += weight * row * row.transpose();
    right += weight * points.values[k] * row;
    squares += weight * points.values[k] * points.values[k];
    weights += weight;
  }
  if (deeper == nullptr) matrix(2, 2) = 1.0;
  const Eigen::Vector3d found = matrix.ldlt().solve(right);
  const double error = (squares - found.dot(right)) / weights;
  if (!(error < best.error)) return;
  best = of;
  best.error = error;
  best.steps.space = found[0];
  best.steps.layer = found[0] + found[1];
  best.steps.inside = best.steps.layer + found[2];
}

/// Returns the best fit of one step and of two by a blur.
std::array<FittedEdge, 2> fitted(const ProfilePoints& points, double blur) {
  constexpr double first = -3.5;
  constexpr double step = 0.1;
  constexpr std::size_t surfaces = 56;
  constexpr std::size_t thinnest = 15;
  constexpr std::size_t thickest = 50;
  std::vector<std::vector<double>> shares(surfaces + thickest);
  for (std::size_t place = 0; place < shares.size(); ++place) {
    for (const double at : points.places) {
      const double away = (at - first - step * static_cast<double>(place)) / blur;
      // The integral of a Gaussian, within .0004 (Page 1977, Applied Statistics 26, 75).
      const double bent = std::sqrt(2.0 / pi) * (away + 0.044715 * away * away * away);
      shares[place].push_back(0.5 + 0.5 * portable::tanh(bent));
    }
  }
  std::array<FittedEdge, 2> best;
  FittedEdge of;
  of.blur = blur;
  for (std::size_t place = 0; place < surfaces; ++place) {
    of.steps.thickness = 0.0;
    fit_steps(points, shares[place], nullptr, of, best[0]);
    for (std::size_t layer = thinnest; layer <= thickest; layer += 5) {
      of.steps.thickness = step * static_cast<double>(layer);
      fit_steps(points, shares[place], &shares[place + layer], of, best[1]);
    }
  }
  return best;
}

/// The best fits of one step, and of two.
struct BestFits {
  FittedEdge one;
  FittedEdge two;
  FittedEdge soft_two;  ///< by any blur
};

/// One step may be more blurred than two: without that, a soft scan would have a layer everywhere.
BestFits best_fits(const ProfilePoints& points) {
  constexpr int least = 4;  // tenths of a voxel
  constexpr int most_of_two = 16;
  constexpr int most = 40;
  BestFits best;
  for (int tenths = least; tenths <= most; ++tenths) {
    const std::array<FittedEdge, 2> found = fitted(points, 0.1 * tenths);
    if (found[0].error < best.one.error) best.one = found[0];
    if (found[1].error < best.soft_two.error) best.soft_two = found[1];
    if (tenths <= most_of_two && found[1].error < best.two.error) best.two = found[1];
  }
  return best;
}

double contrast_of(const EdgeSteps& steps) {
  return std::max(std::abs(steps.layer - steps.space), std::abs(steps.inside - steps.space));
}

/// Whether each of two steps has enough of the contrast.
bool are_clear(const EdgeSteps& steps) {
  const double least = 0.1 * contrast_of(steps);
  return std::abs(steps.inside - steps.layer) > least &&
         std::abs(steps.layer - steps.space) > least;
}

/// Returns the steps of a film that the blur hides: two steps are nearer to the profile of all
/// grains, and their blur is clearly less than that of one. Empty: one step is as good.
std::optional<EdgeSteps> hidden_steps(const BestFits& best) {
  const EdgeSteps& steps = best.soft_two.steps;
  const double contrast = contrast_of(steps);
  // Of 51 packings without a film, with blurs of .7 to 2.4 voxels and noise of 2 to 25 %, also
  // smoothed, those with blurs that differ so much were nearer by up to 1.7e-5. All of 15 with
  // films of 2.5 voxels, blurred by 1.2, by 3.3e-5 and more, with blurs of up to .82 of the other.
  constexpr double narrower = 0.83;
  constexpr double nearer = 2.4e-5;
  const bool are_two = best.soft_two.blur < narrower * best.one.blur &&
                       best.one.error - best.soft_two.error > nearer * contrast * contrast &&
                       steps.goes_on() && are_clear(steps);
  if (!are_two) return std::nullopt;
  return steps;
}

/// Returns the two steps of a profile; empty: one step describes it, or there are too few values.
std::optional<EdgeSteps> steps_of(const Profile& profile, const BestFits& best) {
  const ProfilePoints points(profile);
  constexpr std::size_t fewest = 14;
  if (points.places.size() < fewest) return std::nullopt;
  const FittedEdge one = fitted(points, best.one.blur)[0];
  const FittedEdge two = fitted(points, best.two.blur)[1];
  const EdgeSteps& steps = two.steps;
  const double contrast = contrast_of(steps);
  // Balls with blur and noise have an error of 1 % of the contrast.
  constexpr double clear = 0.015;
  constexpr double better = 3.0;
  const bool are_two = one.error > clear * clear * contrast * contrast &&
                       one.error > better * two.error && are_clear(steps);
  if (!are_two) return std::nullopt;
  return steps;
}

/// Whether most grains have a rim at their surface, and the void beside them a rim of the other
/// sign, at least a third as high.
bool are_fringes(const ProfilePoints& all, const std::vector<EdgeSteps>& found, double sign,
                 double space) {
  constexpr double most = 0.5;
  constexpr double outside = -0.75;  // voxels
  double rim = 0.0;
  for (const EdgeSteps& steps : found) {
    if (!steps.goes_on() && steps.fraction > most) rim = sign * (steps.layer - steps.inside);
  }
  double beside = 0.0;
  for (std::size_t k = 0; k < all.places.size(); ++k) {
    if (all.places[k] < outside) beside = std::max(beside, sign * (space - all.values[k]));
  }
  return rim > 0.0 && 3.0 * beside > rim;
}

}  // namespace

EdgeLayers use_layers(const LevelledVolume& volume, const std::vector<std::uint16_t>& scan,
                      const std::vector<std::uint32_t>& labels, bool is_dark, double space,
                      std::vector<double>& plateaus) {
  const std::vector<Profile> profiles = EdgeLines(volume, scan, labels, is_dark).profiles();
  Profile all;
  for (const Profile& profile : profiles) all.add(profile);
  const ProfilePoints points(all);
  if (points.places.empty()) return {};
  const BestFits best = best_fits(points);
  const double sign = is_dark ? -1.0 : 1.0;
  std::array<Profile, 2> kinds;
  std::vector<double> layers = plateaus;
  std::vector<double> insides = plateaus;
  for (std::size_t label = 1; label < profiles.size(); ++label) {
    const std::optional<EdgeSteps> steps = steps_of(profiles[label], best);
    if (!steps || sign * (steps->layer - steps->space) < 0.0) continue;
    kinds[steps->goes_on() ? 0 : 1].add(profiles[label]);
    if (steps->goes_on()) continue;
    layers[label] = steps->layer;
    insides[label] = steps->inside;
  }
  EdgeLayers found;
  for (const Profile& kind : kinds) {
    std::optional<EdgeSteps> steps = steps_of(kind, best);
    if (!steps) continue;
    steps->fraction = kind.size() / all.size();
    found.steps.push_back(*steps);
  }
  const bool has_fringes = are_fringes(points, found.steps, sign, space);
  plateaus = std::move(has_fringes ? insides : layers);
  if (has_fringes) return {{}, true};
  std::optional<EdgeSteps> hidden = hidden_steps(best);
  if (found.steps.empty() && hidden && sign * (hidden->layer - hidden->space) > 0.0) {
    hidden->fraction = 1.0;
    found.steps.push_back(*hidden);
  }
  return found;
}

}  // namespace wscvt
