// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <map>
#include <utility>

#include "toolbox/volume/segmentation_steps.h"

namespace wscvt {

namespace {

struct Neck {
  std::uint16_t distance;
  std::uint32_t one;
  std::uint32_t other;
};

/// Returns the necks, the widest first.
std::vector<Neck> necks_of(const std::vector<std::uint32_t>& labels,
                           const std::vector<std::uint16_t>& distances, const VoxelCounts& counts) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint16_t> widest;
  for_each_pair(counts, [&](std::size_t a, std::size_t b) {
    if (labels[a] == labels[b] || labels[a] == 0 || labels[b] == 0) return;
    std::uint16_t& neck = widest[std::minmax(labels[a], labels[b])];
    neck = std::max(neck, std::min(distances[a], distances[b]));
  });
  std::vector<Neck> necks;
  for (const auto& [pair, distance] : widest) necks.push_back({distance, pair.first, pair.second});
  std::stable_sort(necks.begin(), necks.end(),
                   [](const Neck& a, const Neck& b) { return a.distance > b.distance; });
  return necks;
}

/// Voxels in a row along an axis; the balls around them as parabolas, whose value at a voxel is the
/// squared radius less the squared distance.
class BallRow {
 public:
  /// `length`: of a voxel along the axis.
  BallRow(std::size_t count, double length) : count_(count), squared_(length * length) {}

  /// Gives each voxel the largest value of a ball there, and the label of this ball. `powers`,
  /// `labels`: of the first voxel, the next ones at `stride`; a power of 0 is no ball.
  void spread(double* powers, std::uint32_t* labels, std::size_t stride) {
    largest_.clear();
    for (std::size_t k = 0; k < count_; ++k) {
      if (powers[k * stride] > 0.0) add({k, powers[k * stride], labels[k * stride], 0.0});
    }
    if (largest_.empty()) return;
    auto ball = largest_.begin();
    for (std::size_t k = 0; k < count_; ++k) {
      while (ball + 1 != largest_.end() && (ball + 1)->begin < static_cast<double>(k)) ++ball;
      const double away = static_cast<double>(k) - static_cast<double>(ball->place);
      powers[k * stride] = std::max(0.0, ball->power - squared_ * away * away);
      labels[k * stride] = ball->label;
    }
  }

 private:
  struct Ball {
    std::size_t place;
    double power;
    std::uint32_t label;
    double begin;  ///< from here on it is the largest one
  };

  void add(Ball ball) {
    while (!largest_.empty()) {
      const Ball& before = largest_.back();
      const auto apart = static_cast<double>(ball.place - before.place);
      ball.begin = 0.5 * static_cast<double>(ball.place + before.place) +
                   (before.power - ball.power) / (2.0 * squared_ * apart);
      if (ball.begin > before.begin) break;
      largest_.pop_back();
    }
    if (largest_.empty()) ball.begin = -1.0;
    largest_.push_back(ball);
  }

  std::size_t count_;
  double squared_;
  std::vector<Ball> largest_;
};

/// Gives voxels that are cut off from the deepest one of their grain the label of a neighbour.
void join_cut_off(std::vector<std::uint32_t>& labels, const std::vector<std::uint16_t>& distances,
                  const VoxelCounts& counts) {
  std::vector<std::uint8_t> is_joined(labels.size(), 0);
  std::vector<std::size_t> deepest(*std::max_element(labels.begin(), labels.end()) + std::size_t{1},
                                   labels.size());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    std::size_t& best = deepest[labels[k]];
    if (best == labels.size() || distances[k] > distances[best]) best = k;
  }
  std::vector<std::size_t> next;
  for (const std::size_t first : deepest) {
    if (first == labels.size() || labels[first] == 0) continue;
    is_joined[first] = 1;
    next.push_back(first);
  }
  while (!next.empty()) {
    const std::size_t k = next.back();
    next.pop_back();
    for_each_neighbour(k, counts, [&](std::size_t other) {
      if (is_joined[other] != 0 || labels[other] != labels[k]) return;
      is_joined[other] = 1;
      next.push_back(other);
    });
  }
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (labels[k] != 0 && is_joined[k] == 0) next.push_back(k);
  }
  // Layer by layer. A part of the mask that is cut off as a whole stays.
  std::vector<std::pair<std::size_t, std::uint32_t>> layer;
  do {
    layer.clear();
    for (const std::size_t k : next) {
      std::size_t best = labels.size();
      for_each_neighbour(k, counts, [&](std::size_t other) {
        if (is_joined[other] == 0) return;
        if (best == labels.size() || distances[other] > distances[best]) best = other;
      });
      if (best != labels.size()) layer.emplace_back(k, labels[best]);
    }
    for (const auto& [k, label] : layer) {
      labels[k] = label;
      is_joined[k] = 1;
    }
    next.erase(
        std::remove_if(next.begin(), next.end(), [&](std::size_t k) { return is_joined[k] != 0; }),
        next.end());
  } while (!layer.empty());
}

}  // namespace

std::vector<GrainNeck> join_wide_necks(std::vector<std::uint32_t>& labels,
                                       const std::vector<std::uint16_t>& distances,
                                       const VoxelCounts& counts, double neck) {
  if (labels.empty()) return {};
  const std::size_t count = *std::max_element(labels.begin(), labels.end()) + std::size_t{1};
  std::vector<std::uint16_t> radii(count, 0);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    radii[labels[k]] = std::max(radii[labels[k]], distances[k]);
  }
  boost::disjoint_sets_with_storage<> grains(count);
  const std::vector<Neck> necks = necks_of(labels, distances, counts);
  for (const Neck& one : necks) {
    const std::size_t a = grains.find_set(one.one);
    const std::size_t b = grains.find_set(one.other);
    if (a == b || !(one.distance > neck * std::min(radii[a], radii[b]))) continue;
    const std::uint16_t radius = std::max(radii[a], radii[b]);
    grains.link(a, b);
    radii[grains.find_set(a)] = radius;
  }
  std::vector<GrainNeck> found(count);
  for (std::uint32_t& label : labels) {
    label = static_cast<std::uint32_t>(grains.find_set(label));
    if (label != 0) ++found[label].voxels;
  }
  for (const Neck& one : necks) {
    std::size_t small = grains.find_set(one.one);
    std::size_t large = grains.find_set(one.other);
    if (small == large) continue;
    if (radii[small] > radii[large]) std::swap(small, large);
    found[small].neck =
        std::max(found[small].neck, static_cast<double>(one.distance) / radii[small]);
  }
  found.erase(std::remove_if(found.begin(), found.end(),
                             [](const GrainNeck& grain) { return grain.voxels == 0; }),
              found.end());
  return found;
}

void straighten_walls(std::vector<std::uint32_t>& labels,
                      const std::vector<std::uint16_t>& distances, const VoxelCounts& counts,
                      const Vector3& spacing, const Execution& execution) {
  if (labels.empty()) return;
  std::vector<double> powers(distances.size());
  for (std::size_t k = 0; k < powers.size(); ++k) {
    const double radius = labels[k] == 0 ? 0.0 : distances[k];
    powers[k] = radius * radius;
  }
  std::vector<std::uint32_t> deepest = labels;
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    execution.report(static_cast<double>(axis) / 3.0, "Straightening walls");
    const auto count = static_cast<std::size_t>(counts[axis]);
    const auto spread = [&](std::size_t begin, std::size_t end) {
      BallRow row(count, spacing[axis]);
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t first = k / stride * stride * count + k % stride;
        row.spread(&powers[first], &deepest[first], stride);
      }
    };
    constexpr std::size_t block = 256;
    execution.parallel_for(powers.size() / count, block, spread);
    stride *= count;
  }
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (powers[k] > 0.0 && labels[k] != 0) labels[k] = deepest[k];
  }
  join_cut_off(labels, distances, counts);
}

}  // namespace wscvt
