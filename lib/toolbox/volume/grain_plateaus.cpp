// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "toolbox/volume/segmentation.h"
#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/sorting.h"

namespace wscvt {

namespace {

/// Distance from the mask's surface up to which voxels may change sides; voxels. The level of a
/// grain ten times as bright as another is 1.3 standard deviations of the blur out, 2.5 of 1.9.
constexpr double reach = 2.5;

/// Grey values of a basin, ascending.
using Greys = std::vector<std::pair<std::uint32_t, std::uint16_t>>;

/// Returns the grey value of the phase nearest to the void that has a quarter of the values
/// [begin, end): its own lower quartile, because an inclusion below makes others brighter.
double plateau_of(const Greys& greys, std::size_t begin, std::size_t end, const Phases& phases) {
  const double sign = phases.materials.front() < phases.space ? -1.0 : 1.0;
  const auto at = [&](std::size_t k) {
    return static_cast<double>(greys[sign > 0.0 ? begin + k : end - 1 - k].second);
  };
  const std::size_t count = end - begin;
  std::size_t first = 0;
  for (std::size_t phase = 0; phase < phases.materials.size(); ++phase) {
    std::size_t last = count;
    if (phase + 1 < phases.materials.size()) {
      const double border = 0.5 * (phases.materials[phase] + phases.materials[phase + 1]);
      last = first;
      while (last < count && sign * (at(last) - border) < 0.0) ++last;
    }
    if (4 * (last - first) >= count) return at(first + (last - first) / 4);
    first = last;
  }
  return at(count / 2);
}

/// The mask by basins, and how deep each voxel is below its surface.
struct Depths {
  const std::vector<std::uint16_t>& grey;
  const std::vector<std::uint8_t>& mask;
  const Basins& basins;
  double voxel;

  double of(std::size_t k) const { return basins.step * basins.distances[k] / voxel; }
};

/// Returns the grey value of each basin, that of a shell below its surface.
std::vector<double> plateaus_of(const Depths& depths, const Phases& phases, double blur) {
  // Below the blur. A bright grain's surface is about a voxel below the mask's. Of small basins the
  // shell begins at a part of their radius.
  const double begin_of_shell = 2.5 * std::max(1.0, blur);
  constexpr double thickness = 2.5;
  constexpr double of_radius = 0.75;
  const std::vector<std::uint32_t>& labels = depths.basins.labels;
  std::vector<double> radii(*std::max_element(labels.begin(), labels.end()) + std::size_t{1}, 0.0);
  for (std::size_t k = 0; k < labels.size(); ++k) {
    radii[labels[k]] = std::max(radii[labels[k]], depths.of(k));
  }
  Greys shell;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    if (depths.mask[k] == 0) continue;
    const double begin = std::min(begin_of_shell, of_radius * radii[labels[k]]);
    if (depths.of(k) >= begin && depths.of(k) <= begin + thickness) {
      shell.emplace_back(labels[k], depths.grey[k]);
    }
  }
  std::sort(shell.begin(), shell.end());
  std::vector<double> plateaus(radii.size(), phases.materials.front());
  for (std::size_t begin = 0; begin < shell.size();) {
    const std::uint32_t label = shell[begin].first;
    std::size_t end = begin;
    while (end < shell.size() && shell[end].first == label) ++end;
    plateaus[label] = plateau_of(shell, begin, end, phases);
    begin = end;
  }
  return plateaus;
}

/// Returns the median of the void's voxels that no grown label has; `otherwise` if there are few.
double space_of(const std::vector<std::uint16_t>& grey, const std::vector<std::uint8_t>& left_out,
                const std::vector<std::uint32_t>& grown, double otherwise) {
  std::vector<std::uint16_t> values;
  for (std::size_t k = 0; k < grey.size(); ++k) {
    if (grown[k] == 0 && !is_marked(left_out, k)) values.push_back(grey[k]);
  }
  constexpr std::size_t few = 1000;
  if (values.size() < few) return otherwise;
  return upper_median(values);
}

/// Gives voxels of 0 up to a few faces away from a label that label.
void grow(std::vector<std::uint32_t>& labels, const VoxelCounts& counts) {
  // The sides of the median, of the mean and of the Laplacian of level_mask.
  constexpr int faces = 3;
  std::vector<std::pair<std::size_t, std::uint32_t>> next;
  for (int face = 0; face < faces; ++face) {
    next.clear();
    for (std::size_t k = 0; k < labels.size(); ++k) {
      if (labels[k] != 0) continue;
      std::uint32_t found = 0;
      for_each_neighbour(k, counts,
                         [&](std::size_t other) { found = std::max(found, labels[other]); });
      if (found != 0) next.emplace_back(k, found);
    }
    for (const auto& [k, label] : next) labels[k] = label;
  }
}

}  // namespace

EvenContrast even_contrast(const LevelledVolume& volume, const std::vector<std::uint16_t>& scan,
                           Basins basins, Phases phases) {
  const std::vector<std::uint16_t>& grey = volume.grey;
  const double voxel = portable::cbrt(volume.spacing[0] * volume.spacing[1] * volume.spacing[2]);
  const Depths depths = {grey, volume.mask, basins, voxel};
  std::vector<double> plateaus = plateaus_of(depths, phases, volume.blur);
  const bool is_dark = phases.materials.front() < phases.space;
  EvenContrast result;
  result.layers = use_layers(volume, scan, basins.labels, is_dark, phases.space, plateaus);
  grow(basins.labels, volume.counts);
  phases.space = space_of(grey, volume.left_out, basins.labels, phases.space);
  result.grey.resize(grey.size());
  for (std::size_t k = 0; k < grey.size(); ++k) {
    if (basins.step * basins.distances[k] > reach * voxel) {
      result.grey[k] = volume.mask[k] != 0 ? even_full : 0;
      continue;
    }
    const std::uint32_t label = basins.labels[k];
    const double plateau = label == 0 ? phases.materials.front() : plateaus[label];
    const double share = (static_cast<double>(grey[k]) - phases.space) / (plateau - phases.space);
    result.grey[k] =
        static_cast<std::uint16_t>(std::lround(even_full * std::clamp(share, 0.0, 1.0)));
  }
  return result;
}

}  // namespace wscvt
