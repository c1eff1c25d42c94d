// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/segmentation_steps.h"
#include "toolbox/volume/volume_parts.h"
#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

/// Labels in memory.
class HeldVolume : public LabelVolume {
 public:
  HeldVolume(const VolumeGeometry& geometry, std::vector<Label> labels)
      : LabelVolume(geometry), labels_(std::move(labels)) {}

  const std::vector<Label>& next_row() override {
    const auto begin = labels_.begin() + static_cast<std::ptrdiff_t>(next_);
    row_.assign(begin, begin + geometry().counts[0]);
    next_ += row_.size();
    return row_;
  }
  void rewind() override { next_ = 0; }

 private:
  std::vector<Label> labels_;
  std::vector<Label> row_;
  std::size_t next_ = 0;
};

constexpr const char* reading_stage = "Reading the volume";

/// A volume of so few values may be a mask of phases.
constexpr std::size_t most_phases = 8;

/// Statistics of the grey values of a volume; values that are not finite are ignored.
struct GreyRange {
  float least = std::numeric_limits<float>::max();
  float largest = std::numeric_limits<float>::lowest();
  std::vector<float> values;  ///< ascending, up to one more than most_phases
  bool has_nan = false;
  bool are_whole = true;
  /// Range of all values but a thousandth at each end, widened by a quarter of it at both ends.
  float lower = 0.0F;
  float upper = 0.0F;
  double equal_neighbours = 0.0;             ///< fraction of equal neighbours along x
  std::vector<std::size_t> constant_slices;  ///< along z, those of one value
};

/// `outside`: 1 for voxels that were not scanned, which are ignored; empty: none.
GreyRange range_of(LabelVolume& volume, const std::vector<std::uint8_t>& outside,
                   const Execution& execution) {
  GreyRange range;
  std::vector<float> sample;
  std::uint64_t count = 0;
  std::uint64_t equal = 0;
  std::size_t voxel = 0;
  Label slice_code = 0;
  bool is_constant = false;
  for_each_row(volume, execution, reading_stage, [&](const std::vector<Label>& row, int y, int z) {
    if (y == 0) slice_code = row.front();
    is_constant = (y == 0 || is_constant) && std::all_of(row.begin(), row.end(), [&](Label code) {
                    return code == slice_code;
                  });
    if (is_constant && y + 1 == volume.geometry().counts[1]) {
      range.constant_slices.push_back(static_cast<std::size_t>(z));
    }
    float before = std::numeric_limits<float>::quiet_NaN();
    for (const Label code : row) {
      const float value = grey_value(code);
      range.has_nan = range.has_nan || code == 0;
      if (is_marked(outside, voxel++) || !std::isfinite(value)) continue;
      if (value == before) ++equal;
      constexpr std::uint64_t sampled = 61;  // no common factor with usual row lengths
      if (count++ % sampled == 0) sample.push_back(value);
      if (value == before) continue;
      before = value;
      if (range.values.size() <= most_phases) {
        const auto place = std::lower_bound(range.values.begin(), range.values.end(), value);
        if (place == range.values.end() || *place != value) range.values.insert(place, value);
      }
      range.least = std::min(range.least, value);
      range.largest = std::max(range.largest, value);
      range.are_whole = range.are_whole && value == std::floor(value);
    }
  });
  // What is no number is the void of a mask of one value.
  if (count == 0 || (!(range.least < range.largest) && !range.has_nan)) {
    refuse(count == 0 ? "The volume has no number."
                      : "All voxels of the volume are " + format_number(range.least) +
                            ": there is nothing to separate. If the file has several volumes, " +
                            "choose one by " + mention("select") + ".");
  }
  range.equal_neighbours = static_cast<double>(equal) / static_cast<double>(count);
  std::sort(sample.begin(), sample.end());
  const float first = sample[sample.size() / 1000];
  const float last = sample[sample.size() - 1 - sample.size() / 1000];
  // All but a thousandth may have one value.
  const float beyond = first < last ? 0.25F * (last - first) : range.largest - range.least;
  range.lower = std::max(range.least, first - beyond);
  range.upper = std::min(range.largest, last + beyond);
  return range;
}

/// Returns a mask of the voxels for which `is_material` is true.
template <class IsMaterial>
std::vector<std::uint8_t> mask_of(LabelVolume& volume, const Execution& execution,
                                  const IsMaterial& is_material) {
  std::vector<std::uint8_t> mask;
  mask.reserve(VoxelGrid(volume.geometry().counts).voxels);
  for_each_row(volume, execution, reading_stage, [&](const std::vector<Label>& row) {
    for (const Label value : row) mask.push_back(is_material(value) ? 1 : 0);
  });
  return mask;
}

std::uint64_t material_count(const std::vector<std::uint8_t>& mask) {
  return static_cast<std::uint64_t>(std::count(mask.begin(), mask.end(), 1));
}

/// Returns the median difference of neighbours along x, noise; `values`: the number of greys.
std::size_t noise_of(const std::vector<std::uint16_t>& grey, const VoxelCounts& sizes,
                     std::size_t values) {
  const auto width = static_cast<std::size_t>(sizes[0]);
  std::vector<std::uint64_t> differences(values, 0);
  for (std::size_t k = 0; k < grey.size(); ++k) {
    if (k % width == 0) continue;
    ++differences[static_cast<std::size_t>(std::abs(int{grey[k]} - int{grey[k - 1]}))];
  }
  return quantile_of(differences, 0.5);
}

/// Returns the histogram of the voxels whose six neighbours are alike. Voxels at the surface of
/// grains are not: their values lie between two phases, and would look like a third one.
std::vector<std::uint64_t> counts_inside(const std::vector<std::uint16_t>& grey,
                                         const std::vector<std::uint8_t>& outside,
                                         const VoxelCounts& sizes,
                                         const std::vector<std::uint64_t>& counts) {
  // Most neighbours differ by noise only. Surfaces differ by a third of the contrast and more.
  const std::size_t noise = noise_of(grey, sizes, counts.size());
  // A few voxels of a very bright phase do not widen the range.
  constexpr double rare = 0.05;
  const std::size_t range = quantile_of(counts, 1.0 - rare) - quantile_of(counts, rare);
  const std::size_t alike = std::max<std::size_t>({1, 4 * noise, range / 16});
  std::vector<std::uint8_t> is_inside(grey.size(), 1);
  for_each_pair(sizes, [&](std::size_t a, std::size_t b) {
    const auto difference = static_cast<std::size_t>(std::abs(int{grey[a]} - int{grey[b]}));
    if (difference > alike) is_inside[a] = is_inside[b] = 0;
  });
  std::vector<std::uint64_t> inside(counts.size(), 0);
  for (std::size_t k = 0; k < grey.size(); ++k) {
    if (is_inside[k] != 0 && !is_marked(outside, k)) ++inside[grey[k]];
  }
  return inside;
}

struct GreyCounts {
  std::vector<std::uint64_t> all;
  std::vector<std::uint64_t> inside;  ///< of phases
  bool has_noise = false;             ///< the scan has more values than a mask of phases
};

/// Chooses the level of the material from the histogram of all voxels and of those inside of
/// phases. Sets `peaks` to those of the latter.
double level_of(const GreyCounts& found_counts, const SegmentationOptions& options,
                std::vector<GreyPeak>& peaks) {
  const auto& [counts, inside, has_noise] = found_counts;
  if (values_in(counts) < 2) {
    refuse("All voxels have one grey value after smoothing. Give " + mention("threshold") + ".");
  }
  if (values_in(inside) >= 2) peaks = peaks_of(inside, has_noise);
  const auto found = static_cast<int>(peaks.size());
  // Noise and small dense bodies lead Otsu's threshold astray, but not the peaks.
  if (found < 2 && !options.phases) return level_between_peaks(counts);
  const int phases = options.phases.value_or(found - 1);
  if (phases >= found) {
    refuse("The grey values have " + format_count(peaks.size(), "peak") + ", so at most " +
           std::to_string(found - 1) + " can be material. Give " + mention("threshold") +
           ", or a lower " + mention("phases") + ".");
  }
  return level_below(inside, peaks,
                     static_cast<std::size_t>(options.dark ? phases : found - phases));
}

/// Whether a volume of few values is a mask of phases: in labels, each value has one part only.
bool are_phases(const std::vector<std::uint16_t>& grey, const VolumeGeometry& geometry,
                std::size_t values, const SegmentationOptions& options,
                const Execution& execution) {
  if (values > most_phases) return false;
  constexpr Label none = std::numeric_limits<Label>::max();
  const std::unique_ptr<LabelVolume> parts =
      parts_of(std::make_unique<HeldVolume>(geometry, std::vector<Label>(grey.begin(), grey.end())),
               none, execution);
  std::vector<std::int64_t> voxels;  // of each part
  for_each_row(*parts, execution, reading_stage, [&](const std::vector<Label>& row) {
    for (const Label part : row) {
      if (part >= voxels.size()) voxels.resize(part + std::size_t{1}, 0);
      ++voxels[part];
    }
  });
  const auto large = std::count_if(voxels.begin(), voxels.end(),
                                   [&](std::int64_t count) { return count >= options.smallest; });
  return large >= 2 * static_cast<std::ptrdiff_t>(values);
}

/// Grey values in 16 bits: base + step * grey.
struct ShortGrey {
  std::vector<std::uint16_t> grey;
  double base = 0.0;
  double step = 1.0;
};

ShortGrey short_grey(LabelVolume& scan, const GreyRange& range,
                     const std::vector<std::uint8_t>& outside, const Execution& execution) {
  constexpr double most = std::numeric_limits<std::uint16_t>::max();
  // Whole numbers of 16 bits are used as they are. Other values are quantized; a few outliers must
  // not widen the steps.
  const bool is_short = range.are_whole && double{range.largest} - range.least <= most;
  ShortGrey result;
  result.base = is_short ? range.least : range.lower;
  result.step = is_short ? 1.0 : (range.upper - result.base) / most;
  std::vector<std::uint16_t>& grey = result.grey;
  grey.reserve(VoxelGrid(scan.geometry().counts).voxels);
  for_each_row(scan, execution, reading_stage, [&](const std::vector<Label>& row) {
    // What was not scanned gets the value before it, so that smoothing does not change its
    // neighbours.
    float value = range.least;
    for (const Label code : row) {
      if (code != 0 && !is_marked(outside, grey.size())) value = grey_value(code);
      grey.push_back(static_cast<std::uint16_t>(
          std::clamp(std::round((value - result.base) / result.step), 0.0, most)));
    }
  });
  return result;
}

GreyCounts counts_of(const std::vector<std::uint16_t>& grey,
                     const std::vector<std::uint8_t>& outside, const VoxelCounts& sizes,
                     bool has_noise) {
  GreyCounts counts;
  counts.has_noise = has_noise;
  counts.all = counts_of_all(grey, outside);
  counts.inside = counts_inside(grey, outside, sizes, counts.all);
  return counts;
}

/// Smooths on if the grey values have one peak, because of noise, until they have two. If they
/// never do, they stay as they are.
void smooth_until_peaks(std::vector<std::uint16_t>& grey, GreyCounts& counts,
                        const std::vector<std::uint8_t>& outside, const VoxelCounts& sizes,
                        Segmentation& result, const Execution& execution) {
  constexpr int most_medians = 3;
  std::vector<std::uint16_t> smoother;
  GreyCounts found = counts;
  for (int medians = 1; medians <= most_medians; ++medians) {
    if (peaks_of(found.inside, found.has_noise).size() > 1) {
      if (medians == 1) return;
      grey = std::move(smoother);
      counts = std::move(found);
      result.medians = medians;
      return;
    }
    // Thin grains, and those with a large pore, have no peak inside.
    if (medians == 1 && peaks_of(counts.all, counts.has_noise).size() == 2) {
      counts.inside = counts.all;
      return;
    }
    if (medians == most_medians) return;
    smoother = median_of(medians == 1 ? grey : smoother, sizes, execution);
    found = counts_of(smoother, outside, sizes, found.has_noise);
  }
}

/// Edge of a cube with the volume of a voxel; a length.
double voxel_length(const VolumeGeometry& geometry) {
  return portable::cbrt(geometry.axes.colwise().norm().prod());
}

/// Returns the basins of a mask, so fine that they cut every neck.
Basins fine_basins(const std::vector<std::uint8_t>& mask, const VolumeGeometry& geometry,
                   const Execution& execution) {
  // Steps of voxels make false maxima of up to half a voxel.
  constexpr double depth = 0.5;
  const Vector3 spacing = geometry.axes.colwise().norm();
  return basins_of(mask, geometry.counts, {spacing[0], spacing[1], spacing[2]},
                   depth * voxel_length(geometry), execution);
}

/// Returns the phases, if the void is one of them; those of material are beyond the level.
std::optional<Phases> phases_of(const std::vector<GreyPeak>& peaks, double level, bool is_dark) {
  Phases phases;
  std::size_t spaces = 0;
  for (const GreyPeak& peak : peaks) {
    const auto value = static_cast<double>(peak.value);
    if ((value < level) != is_dark) {
      phases.space = value;
      ++spaces;
    } else {
      phases.materials.push_back(value);
    }
  }
  if (is_dark) std::reverse(phases.materials.begin(), phases.materials.end());
  if (spaces != 1 || phases.materials.empty()) return std::nullopt;
  return phases;
}

/// Returns the material with the surface of each grain half way from its own grey value to the
/// void, from that by one level. Sets `layers` to those at the surfaces. `unsmoothed`: returns
/// the grey values of the scan.
template <class Unsmoothed>
std::vector<std::uint8_t> material_of_each(const LevelledVolume& volume,
                                           const VolumeGeometry& geometry, const Phases& phases,
                                           int medians, const Unsmoothed& unsmoothed,
                                           EdgeLayers& layers, const Execution& execution) {
  std::vector<std::uint8_t> filled = volume.mask;
  fill_holes(filled, geometry.counts, execution.part(0.0, 0.1));
  Basins basins = fine_basins(filled, geometry, execution.part(0.1, 0.85));
  filled = {};
  EvenContrast even =
      even_contrast(volume, unsmoothed(execution.part(0.85, 0.9)), std::move(basins), phases);
  layers = std::move(even.layers);
  return level_mask(even.grey, volume.left_out, geometry.counts,
                    {0.5 * even_full, even_full, false, medians}, execution.part(0.9, 1.0));
}

/// Adds the wall of a container among material to what is left out; whether there is one.
bool leave_out_wall(const std::vector<std::uint8_t>& mask, const VolumeGeometry& geometry,
                    std::vector<std::uint8_t>& left_out, Segmentation& result,
                    const Execution& execution) {
  const ContainerWall wall =
      container_wall(mask, geometry.counts, geometry.axes.colwise().norm(), execution);
  if (wall.voxels == 0) return false;
  if (left_out.empty()) left_out.assign(mask.size(), 0);
  for (std::size_t k = 0; k < mask.size(); ++k) left_out[k] |= wall.marks[k];
  result.wall += wall.voxels;
  return true;
}

/// Parts of a volume, 4 along each axis.
using GreyParts = std::array<std::vector<std::uint16_t>, 64>;

/// Returns the grey values in the parts, without those of voxels that are left out.
GreyParts greys_in_parts(const std::vector<std::uint16_t>& grey, const VoxelCounts& sizes,
                         const std::vector<std::uint8_t>& left_out) {
  constexpr std::size_t along = 4;
  GreyParts parts;
  const VoxelGrid grid(sizes);
  constexpr std::size_t enough = 4'000'000;  // voxels, for memory
  for (std::size_t k = 0; k < grey.size(); k += 1 + grey.size() / enough) {
    if (is_marked(left_out, k)) continue;
    const std::array<std::size_t, 3> place = grid.place(k);
    const auto at = [&](std::size_t axis) { return place[axis] * along / grid.sizes[axis]; };
    parts[(at(2) * along + at(1)) * along + at(0)].push_back(grey[k]);
  }
  return parts;
}

/// Returns a quantile of each part that has enough voxels.
std::vector<double> quantiles_of(GreyParts& parts, double fraction) {
  constexpr std::size_t fewest_voxels = 64;
  std::vector<double> quantiles;
  for (std::vector<std::uint16_t>& part : parts) {
    if (part.size() < fewest_voxels) continue;
    const auto place =
        part.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(part.size()));
    std::nth_element(part.begin(), place, part.end());
    quantiles.push_back(*place);
  }
  return quantiles;
}

/// Returns the least and the largest value but for a sixteenth of them; equal ones if there are
/// few.
std::pair<double, double> usual_range(std::vector<double> values) {
  if (values.size() < 4) return {0.0, 0.0};
  std::sort(values.begin(), values.end());
  const std::size_t few = values.size() / 16;
  return {values[few], values[values.size() - 1 - few]};
}

/// Notes the grey values of the void in parts of the volume if both ends of the grey values differ
/// among the parts, one by much of the contrast, as by drift or beam hardening. Several minerals do
/// not change the void, nor do parts without grains.
void note_space(const ShortGrey& values, const std::vector<std::uint8_t>& left_out,
                const VoxelCounts& sizes, const std::vector<GreyPeak>& peaks,
                Segmentation& result) {
  constexpr double much_of_one = 0.5;
  constexpr double much_of_other = 0.15;
  const double level = (result.threshold - values.base) / values.step;
  const auto upper = std::find_if(peaks.begin(), peaks.end(), [&](const GreyPeak& peak) {
    return static_cast<double>(peak.value) > level;
  });
  if (upper == peaks.begin() || upper == peaks.end()) return;
  const auto contrast = static_cast<double>(upper->value - (upper - 1)->value);
  GreyParts parts = greys_in_parts(values.grey, sizes, left_out);
  const std::pair<double, double> low = usual_range(quantiles_of(parts, 0.1));
  const std::pair<double, double> high = usual_range(quantiles_of(parts, 0.9));
  const auto [less, more] =
      std::minmax({(low.second - low.first) / contrast, (high.second - high.first) / contrast});
  if (more <= much_of_one || less <= much_of_other) return;
  const auto [darkest, brightest] = result.is_dark ? high : low;
  result.darkest_space = values.base + values.step * darkest;
  result.brightest_space = values.base + values.step * brightest;
}

/// Notes the layers of the grains, or a `film` that is too thin for lines across the surface.
void note_layers(EdgeLayers layers, const std::optional<double>& film, const Phases& phases,
                 const ShortGrey& values, Segmentation& result) {
  result.has_fringes = layers.has_fringes;
  if (result.has_fringes) {
    // The rims beside grains fill the void where grains are close.
    result.darkest_space = result.brightest_space = 0.0;
    return;
  }
  result.steps = std::move(layers.steps);
  const bool has_layer =
      std::any_of(result.steps.begin(), result.steps.end(),
                  [](const EdgeSteps& steps) { return steps.goes_on() && steps.are_told(); });
  if (film && !has_layer) {
    result.steps.push_back({phases.space, *film, phases.materials.front(), 0.0, 1.0});
  }
  for (EdgeSteps& steps : result.steps) {
    for (double* value : {&steps.space, &steps.layer, &steps.inside}) {
      *value = values.base + values.step * *value;
    }
  }
}

/// Returns the material among grey values; sets `threshold` to the computed one if it was not
/// given, and the peaks of `result`. `left_out`: what was not scanned, to which the wall of a
/// container is added.
std::vector<std::uint8_t> material_of(LabelVolume& scan, const GreyRange& range,
                                      std::vector<std::uint8_t>& left_out,
                                      const SegmentationOptions& options, Segmentation& result,
                                      const Execution& execution) {
  const VoxelCounts& sizes = scan.geometry().counts;
  ShortGrey values = short_grey(scan, range, left_out, execution.part(0.0, 0.1));
  auto& grey = values.grey;  // no structured binding: a lambda cannot capture one
  const double base = values.base;
  const double step = values.step;
  const CutOffGreys cut_off = cut_off_greys(grey, left_out, sizes);
  if (!options.threshold) result.cut_off = cut_off;
  grey = median_of(grey, sizes, execution.part(0.1, 0.3));
  const bool has_noise = range.values.size() > most_phases;
  GreyCounts counts = counts_of(grey, left_out, sizes, has_noise);
  std::vector<GreyPeak> peaks;
  std::vector<std::uint8_t> mask;
  const auto find_material = [&] {
    peaks.clear();
    result.threshold =
        options.threshold ? *options.threshold : base + step * level_of(counts, options, peaks);
    const double at = (result.threshold - base) / step;
    mask = level_mask(grey, left_out, sizes,
                      {at, contrast_at(counts.all, at), options.dark, result.medians},
                      execution.part(0.4, 0.45));
  };
  if (!options.threshold && !options.phases) {
    smooth_until_peaks(grey, counts, left_out, sizes, result, execution.part(0.3, 0.4));
  }
  find_material();
  // A tube may have another one inside.
  constexpr int most_walls = 3;
  for (int walls = 0; walls < most_walls && leave_out_wall(mask, scan.geometry(), left_out, result,
                                                           execution.part(0.45, 0.5));
       ++walls) {
    counts = counts_of(grey, left_out, sizes, has_noise);
    find_material();
  }
  note_space(values, left_out, sizes, peaks, result);
  for (const GreyPeak& peak : peaks) {
    result.peaks.push_back(base + step * static_cast<double>(peak.value));
  }
  result.is_flat = result.is_flat && !cut_off.has_edges;
  if (result.is_flat) {
    const auto smoothed = static_cast<std::size_t>(values_in(counts.all));
    result.is_flat =
        !are_phases(grey, scan.geometry(), smoothed, options, execution.part(0.5, 0.55));
  }
  const double level = (result.threshold - base) / step;
  // Soft grains have no peak of their own among all voxels.
  const double contrast = peaks.size() == 2 ? static_cast<double>(peaks[1].value - peaks[0].value)
                                            : contrast_at(counts.all, level);
  result.blur = blur_at(values.grey, left_out, sizes, {level, contrast, false, 1});
  const std::optional<Phases> phases = phases_of(peaks, level, options.dark);
  if (!phases) return mask;
  const Vector3 spacing = scan.geometry().axes.colwise().norm();
  const LevelledVolume volume = {
      grey, mask, left_out, sizes, {spacing[0], spacing[1], spacing[2]}, level, result.blur};
  // Smoothing hides thin layers. The scan is read again, because its values would add 2 bytes a
  // voxel to the watershed's memory.
  EdgeLayers layers;
  mask = material_of_each(
      volume, scan.geometry(), *phases, result.medians,
      [&](const Execution& reading) { return short_grey(scan, range, left_out, reading).grey; },
      layers, execution.part(0.55, 1.0));
  std::optional<double> film;
  if (peaks.size() == 2) film = film_between(counts.all, level, contrast);
  note_layers(std::move(layers), film, *phases, values, result);
  return mask;
}

/// Returns whether each label of a volume is within two voxels of one that was not scanned.
std::vector<char> labels_beside(LabelVolume& labels, const std::vector<std::uint8_t>& outside,
                                const Execution& execution) {
  std::vector<char> beside;
  if (outside.empty()) return beside;
  const VoxelCounts& counts = labels.geometry().counts;
  std::size_t next = 0;
  for_each_row(labels, execution, reading_stage, [&](const std::vector<Label>& row) {
    for (const Label label : row) {
      const std::size_t k = next++;
      if (label == 0) continue;
      bool touches = false;
      const auto look = [&](std::size_t other) { touches = touches || outside[other] != 0; };
      // The median takes a voxel away beside what was not scanned.
      for (const std::size_t away : {1, 2}) for_each_neighbour(k, counts, look, away);
      if (!touches) continue;
      if (label >= beside.size()) beside.resize(label + std::size_t{1}, 0);
      beside[label] = 1;
    }
  });
  return beside;
}

/// Returns the parts of a mask, with touching parts separated.
std::unique_ptr<LabelVolume> parts_of_mask(std::vector<std::uint8_t> mask,
                                           const VolumeGeometry& geometry, double neck,
                                           const Execution& execution,
                                           std::vector<GrainNeck>* necks = nullptr) {
  Basins basins = fine_basins(mask, geometry, execution.part(0.0, 0.8));
  mask = {};
  std::vector<GrainNeck> found =
      join_wide_necks(basins.labels, basins.distances, geometry.counts, neck);
  if (necks != nullptr) *necks = std::move(found);
  if (basins.step > 0.0) {
    straighten_walls(basins.labels, basins.distances, geometry.counts,
                     geometry.axes.colwise().norm().transpose() / basins.step,
                     execution.part(0.8, 0.9));
  }
  basins.distances = {};
  return parts_of(std::make_unique<HeldVolume>(geometry, std::move(basins.labels)), 0,
                  execution.part(0.9, 1.0));
}

/// Numbers the grains from 1, and gives one more number to all that are too small or cut.
void drop_small(Segmentation& result, std::int64_t smallest, const std::vector<char>& cut,
                const Execution& execution) {
  const std::vector<LabelExtent> all = label_census(*result.labels, 0, execution.part(0.0, 0.5));
  std::vector<Label> numbers(all.size() + 1, 0);  // parts are numbered without gaps
  for (const LabelExtent& part : all) {
    result.material += part.voxels;
    if (static_cast<std::int64_t>(part.voxels) < smallest) {
      result.dropped += part.voxels;
      continue;
    }
    if (part.label < cut.size() && cut[part.label] != 0) {
      ++result.cut;
      continue;
    }
    result.grains.push_back(part);
    result.grains.back().label = static_cast<Label>(result.grains.size());
    numbers[part.label] = result.grains.back().label;
  }
  if (result.grains.empty() && result.cut == 0) {
    refuse("No grain is left: all " + std::to_string(all.size()) + " parts of material from " +
           format_number(result.threshold) + (result.is_dark ? " down" : " on") +
           " have fewer than " + std::to_string(smallest) + " voxels. Give another " +
           mention("threshold") + ", or a lower " + mention("smallest") + ".");
  }
  for (std::size_t part = 1; part < numbers.size(); ++part) {
    if (numbers[part] == 0) numbers[part] = static_cast<Label>(result.grains.size() + 1);
  }
  std::vector<Label> labels;
  labels.reserve(static_cast<std::size_t>(result.voxels));
  for_each_row(*result.labels, execution.part(0.5, 1.0), reading_stage,
               [&](const std::vector<Label>& row) {
                 for (const Label part : row) labels.push_back(numbers[part]);
               });
  result.labels = std::make_unique<HeldVolume>(result.labels->geometry(), std::move(labels));
}

/// Returns the result of `work`. If memory is insufficient, throws MachineRefused with the amount
/// needed.
template <class Work>
auto with_memory(const VoxelCounts& counts, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    constexpr double bytes_a_voxel = 25e-9;
    throw MachineRefused(
        "There is not enough memory to separate the grains of a volume of this size, about " +
        format_number(bytes_a_voxel * static_cast<double>(VoxelGrid(counts).voxels), 2) +
        " GB. Cut the volume into parts, or halve its resolution.");
  }
}

/// Returns the material of a mask, without what is left out, to which the wall of a container is
/// added; sets `threshold`.
std::vector<std::uint8_t> material_of_mask(LabelVolume& scan, const GreyRange& range,
                                           std::vector<std::uint8_t>& left_out,
                                           const SegmentationOptions& options, Segmentation& result,
                                           const Execution& execution) {
  const std::size_t values = range.values.size();
  const auto phases = static_cast<std::size_t>(options.phases.value_or(1));
  if (phases > 1 && phases >= values) {
    refuse(values <= 2 ? "The volume is a mask of two values, so one phase is material. Leave " +
                             mention("phases") + " out."
                       : "The volume is a mask of " + std::to_string(values) +
                             " values, so at most " + std::to_string(values - 1) +
                             " can be material. Give a lower " + mention("phases") + ".");
  }
  result.threshold =
      options.threshold.value_or(range.values[options.dark ? phases - 1 : values - phases]);
  std::vector<std::uint8_t> mask = mask_of(scan, execution, [&](Label code) {
    const float value = grey_value(code);
    return options.dark ? value <= result.threshold : value >= result.threshold;
  });
  if (result.is_flat) {
    result.is_flat = !are_phases(short_grey(scan, range, left_out, execution).grey, scan.geometry(),
                                 values, options, execution);
  }
  const auto clear = [&] {
    for (std::size_t k = 0; k < left_out.size(); ++k) {
      if (left_out[k] != 0) mask[k] = 0;
    }
  };
  clear();
  if (leave_out_wall(mask, scan.geometry(), left_out, result, execution)) clear();
  return mask;
}

/// Returns islands of a mask minus holes in them, over all slices along the three axes: a quarter
/// of the squares of 2 x 2 voxels with one voxel of the mask, minus those with three. It is the
/// mean of the Euler numbers for neighbours at edges and at corners (Gray 1971, IEEE Trans. Comput.
/// C-20, 551-561).
double islands_of(const std::vector<std::uint8_t>& mask, const VoxelCounts& counts,
                  const Execution& execution) {
  const auto width = static_cast<std::size_t>(counts[0]);
  const std::size_t slice = width * static_cast<std::size_t>(counts[1]);
  constexpr std::array<int, 5> score = {0, 1, 0, -1, 0};  // of so many voxels
  const auto in_rows = [&](std::size_t begin, std::size_t end) {
    std::int64_t sum = 0;
    for (std::size_t row = begin; row < end; ++row) {
      const std::size_t from = row * width;
      const bool has_above = (from % slice) + width < slice;
      const bool has_behind = from + slice < mask.size();
      for (std::size_t k = from; k < from + width; ++k) {
        const bool has_beside = k + 1 < from + width;
        const auto square = [&](std::size_t a, std::size_t b) {
          sum += score[static_cast<std::size_t>(mask[k] + mask[k + a] + mask[k + b] +
                                                mask[k + a + b])];
        };
        if (has_beside && has_above) square(1, width);
        if (has_beside && has_behind) square(1, slice);
        if (has_above && has_behind) square(width, slice);
      }
    }
    return sum;
  };
  return 0.25 * static_cast<double>(
                    execution.parallel_sum(mask.size() / width, 64, std::int64_t{0}, in_rows));
}

/// Returns those of the slices of one grey value at which grains end that go on behind them, as
/// where slices were lost.
std::vector<std::size_t> cutting_slices(const std::vector<std::uint8_t>& mask,
                                        const std::vector<std::size_t>& constant,
                                        const VoxelCounts& counts) {
  const VoxelGrid grid(counts);
  std::vector<std::size_t> cutting;
  for (std::size_t first = 0, last = 0; first < constant.size(); first = last + 1) {
    last = first;
    while (last + 1 < constant.size() && constant[last + 1] == constant[last] + 1) ++last;
    if (constant[first] == 0 || constant[last] + 1 == grid.sizes[2]) continue;
    const auto* const before = &mask[(constant[first] - 1) * grid.steps[2]];
    const auto* const behind = &mask[(constant[last] + 1) * grid.steps[2]];
    for (std::size_t k = first; k <= last; ++k) {
      const auto* const slice = &mask[constant[k] * grid.steps[2]];
      std::size_t goes_on = 0;
      std::size_t ends = 0;
      for (std::size_t i = 0; i < grid.steps[2]; ++i) {
        if (before[i] == 0 || behind[i] == 0) continue;
        ++goes_on;
        ends += slice[i] == 0 ? 1 : 0;
      }
      if (2 * ends > goes_on) cutting.push_back(constant[k]);
    }
  }
  return cutting;
}

/// Returns the fraction of the grains of at least `smallest` voxels that touch a larger one over a
/// neck which is nearly as wide as themselves.
double wide_neck_fraction(const std::vector<GrainNeck>& necks, std::int64_t smallest) {
  constexpr double wide = 0.7;
  std::size_t all = 0;
  std::size_t found = 0;
  for (const GrainNeck& grain : necks) {
    if (grain.voxels < static_cast<std::uint64_t>(smallest)) continue;
    ++all;
    found += grain.neck > wide ? 1 : 0;
  }
  return all == 0 ? 0.0 : static_cast<double>(found) / static_cast<double>(all);
}

Segmentation segmented(LabelVolume& scan, const SegmentationOptions& options,
                       const Execution& execution) {
  if (options.threshold) require_in_range(*options.threshold, threshold_option);
  if (options.phases) require_in_range(*options.phases, phases_option);
  if (options.phases && options.threshold) {
    refuse(mention("phases") + " chooses a threshold, but " + mention("threshold") +
           " gives one. Leave one of them out.");
  }
  require_in_range(options.separate, separate_option);
  require_in_range(options.smallest, smallest_kept_option);
  require_filters();
  const VolumeGeometry& geometry = scan.geometry();
  scan.read_grey_values();
  std::vector<std::uint8_t> outside = not_scanned(scan, execution.part(0.0, 0.05));
  const GreyRange range = range_of(scan, outside, execution.part(0.05, 0.1));
  const std::size_t values = range.values.size();
  if (values == 1) outside.clear();
  Segmentation result;
  result.not_scanned = material_count(outside);
  result.is_dark = options.dark;
  result.is_chosen = options.threshold || options.phases;
  result.is_flat = values > 2 && range.equal_neighbours > 0.9;
  result.is_mask = values <= 2 || (values <= most_phases && result.is_flat && result.is_chosen);
  result.voxels = VoxelGrid(geometry.counts).voxels;
  std::vector<std::uint8_t> left_out = outside;
  const auto find_material = result.is_mask ? material_of_mask : material_of;
  std::vector<std::uint8_t> mask =
      find_material(scan, range, left_out, options, result, execution.part(0.1, 0.4));
  left_out = {};
  const std::uint64_t open = material_count(mask);
  fill_holes(mask, geometry.counts, execution.part(0.4, 0.5));
  result.filled = material_count(mask) - open;
  const double islands = islands_of(mask, geometry.counts, execution.part(0.5, 0.5));
  if (!result.is_mask) {
    result.cutting_slices = cutting_slices(mask, range.constant_slices, geometry.counts);
  }
  std::vector<GrainNeck> necks;
  result.labels =
      parts_of_mask(std::move(mask), geometry, options.separate, execution.part(0.5, 0.95), &necks);
  result.wide_neck_fraction = wide_neck_fraction(necks, options.smallest);
  const std::vector<char> cut = labels_beside(*result.labels, outside, execution.part(0.95, 0.97));
  drop_small(result, options.smallest, cut, execution.part(0.97, 1.0));
  double slices = 0.0;
  for (const LabelExtent& grain : result.grains) {
    for (std::size_t axis = 0; axis < 3; ++axis) slices += grain.end[axis] - grain.begin[axis];
  }
  if (slices > 0.0) result.island_fraction = islands / slices;
  return result;
}

}  // namespace

std::vector<std::uint64_t> counts_of_all(const std::vector<std::uint16_t>& grey,
                                         const std::vector<std::uint8_t>& outside) {
  std::vector<std::uint64_t> counts(
      std::size_t{std::numeric_limits<std::uint16_t>::max()} + std::size_t{1}, 0);
  for (std::size_t k = 0; k < grey.size(); ++k) {
    if (!is_marked(outside, k)) ++counts[grey[k]];
  }
  return counts;
}

Segmentation segment(LabelVolume& scan, const SegmentationOptions& options,
                     const Execution& execution) {
  return with_memory(scan.geometry().counts, [&] { return segmented(scan, options, execution); });
}

std::unique_ptr<LabelVolume> separated(LabelVolume& mask, Label background, double neck,
                                       const Execution& execution) {
  require_filters();
  require_in_range(neck, separate_option);
  std::optional<Label> material;
  const auto is_material = [&](Label value) {
    if (value == background) return false;
    if (material && *material != value) {
      refuse("The volume has the labels " + std::to_string(*material) + " and " +
             std::to_string(value) + ", but " + mention("separate") +
             " needs a mask with one label. Leave it out.");
    }
    material = value;
    return true;
  };
  std::unique_ptr<LabelVolume> parts = with_memory(mask.geometry().counts, [&] {
    std::vector<std::uint8_t> voxels = mask_of(mask, execution.part(0.0, 0.2), is_material);
    fill_holes(voxels, mask.geometry().counts, execution.part(0.2, 0.3));
    return parts_of_mask(std::move(voxels), mask.geometry(), neck, execution.part(0.3, 1.0));
  });
  parts->take_notes_of(mask);
  return parts;
}

}  // namespace wscvt
