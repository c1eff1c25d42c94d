// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/neck_join.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <map>
#include <utility>

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
  const auto width = static_cast<std::size_t>(counts[0]);
  const std::size_t slice = width * static_cast<std::size_t>(counts[1]);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint16_t> widest;
  const auto look = [&](std::size_t a, std::size_t b) {
    if (labels[a] == labels[b] || labels[a] == 0 || labels[b] == 0) return;
    std::uint16_t& neck = widest[std::minmax(labels[a], labels[b])];
    neck = std::max(neck, std::min(distances[a], distances[b]));
  };
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (labels[k] == 0) continue;
    if (k % width > 0) look(k, k - 1);
    if (k % slice >= width) look(k, k - width);
    if (k >= slice) look(k, k - slice);
  }
  std::vector<Neck> necks;
  for (const auto& [pair, distance] : widest) necks.push_back({distance, pair.first, pair.second});
  std::stable_sort(necks.begin(), necks.end(),
                   [](const Neck& a, const Neck& b) { return a.distance > b.distance; });
  return necks;
}

}  // namespace

void join_wide_necks(std::vector<std::uint32_t>& labels,
                     const std::vector<std::uint16_t>& distances, const VoxelCounts& counts,
                     double neck) {
  if (labels.empty()) return;
  const std::size_t count = *std::max_element(labels.begin(), labels.end()) + std::size_t{1};
  std::vector<std::uint16_t> radii(count, 0);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    radii[labels[k]] = std::max(radii[labels[k]], distances[k]);
  }
  boost::disjoint_sets_with_storage<> grains(count);
  for (const Neck& one : necks_of(labels, distances, counts)) {
    const std::size_t a = grains.find_set(one.one);
    const std::size_t b = grains.find_set(one.other);
    if (a == b || !(one.distance > neck * std::min(radii[a], radii[b]))) continue;
    const std::uint16_t radius = std::max(radii[a], radii[b]);
    grains.link(a, b);
    radii[grains.find_set(a)] = radius;
  }
  for (std::uint32_t& label : labels) label = static_cast<std::uint32_t>(grains.find_set(label));
}

}  // namespace wscvt
