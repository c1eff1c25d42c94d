// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "toolbox/fabric/contact_lines.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/option.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

constexpr std::size_t side = 6;  ///< voxels on each side of an edge
constexpr std::size_t profile_length = 2 * side;
constexpr std::size_t fewest_profiles = 100;

/// Grey values across an edge, from the grain to the void.
struct Profile {
  std::array<float, profile_length> values = {};
  float step = 0.0F;  ///< size of a voxel along the line
};

/// Keeps every n-th profile, with the smallest n that keeps memory small.
class Profiles {
 public:
  void add(const Profile& profile) {
    if (seen_++ % stride_ != 0) return;
    if (kept_.size() == most) {
      for (std::size_t k = 0; 2 * k < most; ++k) kept_[k] = kept_[2 * k];
      kept_.resize(most / 2);
      stride_ *= 2;
      if ((seen_ - 1) % stride_ != 0) return;
    }
    kept_.push_back(profile);
  }
  const std::vector<Profile>& kept() const { return kept_; }

 private:
  static constexpr std::size_t most = std::size_t{1} << 17U;
  std::vector<Profile> kept_;
  std::size_t seen_ = 0;
  std::size_t stride_ = 1;
};

/// A slice of both volumes.
struct Slice {
  std::size_t width;
  std::vector<Label> labels;
  std::vector<float> greys;
};

/// Adds the profiles of a line of `count` voxels, `stride` apart.
void add_line(const Slice& slice, std::size_t first, std::size_t stride, std::size_t count,
              Label background, double step, Profiles& profiles) {
  const auto label = [&](std::size_t k) { return slice.labels[first + k * stride]; };
  std::size_t before = 0;  // voxels of the stretch before
  for (std::size_t begin = 0; begin < count;) {
    std::size_t end = begin + 1;
    while (end < count && label(end) == label(begin)) ++end;
    const bool is_edge = begin > 0 && before >= side && end - begin >= side &&
                         (label(begin) == background) != (label(begin - 1) == background);
    if (is_edge) {
      const bool is_forward = label(begin) == background;
      Profile profile;
      profile.step = static_cast<float>(step);
      for (std::size_t k = 0; k < profile_length; ++k) {
        const std::size_t place = is_forward ? begin - side + k : begin + side - 1 - k;
        profile.values[k] = slice.greys[first + place * stride];
      }
      if (std::all_of(profile.values.begin(), profile.values.end(),
                      [](float value) { return std::isfinite(value); })) {
        profiles.add(profile);
      }
    }
    before = end - begin;
    begin = end;
  }
}

double width_of(const std::vector<Profile>& profiles) {
  // Medians: along lines that graze a surface the ends are not yet inside or outside.
  std::vector<double> inside;
  std::vector<double> outside;
  std::vector<double> differences;
  for (const Profile& profile : profiles) {
    const auto& v = profile.values;
    inside.push_back(v[0]);
    outside.push_back(v[profile_length - 1]);
    differences.push_back(std::abs(double{v[profile_length - 1]} - v[profile_length - 2]));
  }
  const double grain = upper_median(inside);
  const double between = upper_median(outside);
  const double contrast = grain - between;
  // Most neighbours far from the edge differ by noise only. The median of the difference of two
  // normal numbers is sqrt(2) times .6745 standard deviations.
  const double deviation = upper_median(differences) / (std::sqrt(2.0) * 0.67448975 * contrast);
  const double noise = deviation * deviation;
  constexpr double least_contrast = 1e-6;
  if (!(std::abs(contrast) > least_contrast * std::max(std::abs(grain), std::abs(between))) ||
      !(noise < 1.0)) {
    refuse(
        "The scan's grey values in the grains and between them do not differ. Give the scan from "
        "which the labels were made.");
  }
  std::vector<double> integrals;
  integrals.reserve(profiles.size());
  for (const Profile& profile : profiles) {
    double sum = static_cast<double>(profile_length) * noise;
    for (const float value : profile.values) {
      const double v = (value - between) / contrast;
      sum += v * (1.0 - v);
    }
    integrals.push_back(sum * profile.step);
  }
  // Lines that graze a surface seldom have six voxels on both sides. Known blurs of .58 to 1.33
  // voxels came out at .93 of their value.
  constexpr double of_grazing = 1.07;
  return std::max(0.0, of_grazing * upper_median(integrals) * std::sqrt(0.5 * pi));
}

/// Throws if a scan has voxels of another number, or of another size where both are known.
void require_same_voxels(const VolumeGeometry& labels, const VolumeGeometry& scan) {
  const std::string advice = ". Give the scan from which the labels were made";
  const auto counts = [](const VolumeGeometry& g) {
    return std::to_string(g.counts[0]) + " x " + std::to_string(g.counts[1]) + " x " +
           std::to_string(g.counts[2]);
  };
  if (scan.counts != labels.counts) {
    refuse("The labels have " + counts(labels) + " voxels, the scan has " + counts(scan) + advice +
           ".");
  }
  if (!labels.has_size || !scan.has_size || labels.unit != scan.unit) return;
  const auto size = [](const VolumeGeometry& g) { return Vector3(g.axes.colwise().norm()); };
  const auto text = [&](const Vector3& s) {
    return format_number(s[0]) + " x " + format_number(s[1]) + " x " + format_number(s[2]) +
           (labels.unit.empty() ? "" : " ") + labels.unit;
  };
  constexpr double rounding = 1e-3;  // of sizes that a file has with few digits
  if ((size(scan) - size(labels)).norm() <= rounding * size(labels).norm()) return;
  refuse("The voxels of the labels are " + text(size(labels)) + ", those of the scan " +
         text(size(scan)) + advice + ", or the size of both by " + mention("voxel-size") + ".");
}

}  // namespace

double edge_width(LabelVolume& labels, Label background, LabelVolume& scan,
                  const Execution& execution) {
  const VolumeGeometry& geometry = labels.geometry();
  const VoxelCounts& counts = geometry.counts;
  require_same_voxels(geometry, scan.geometry());
  scan.read_grey_values();
  labels.rewind();
  scan.rewind();
  const auto width = static_cast<std::size_t>(counts[0]);
  const auto height = static_cast<std::size_t>(counts[1]);
  Slice slice{width, std::vector<Label>(width * height), std::vector<float>(width * height)};
  Profiles profiles;
  for (std::int32_t z = 0; z < counts[2]; ++z) {
    execution.report(static_cast<double>(z) / counts[2], "Measuring the edges");
    for (std::size_t y = 0; y < height; ++y) {
      const auto to = static_cast<std::ptrdiff_t>(y * width);
      const std::vector<Label>& row = labels.next_row();
      std::copy(row.begin(), row.end(), slice.labels.begin() + to);
      const std::vector<Label>& codes = scan.next_row();
      std::transform(codes.begin(), codes.end(), slice.greys.begin() + to, grey_value);
      add_line(slice, y * width, 1, width, background, geometry.axes.col(0).norm(), profiles);
    }
    for (std::size_t x = 0; x < width; ++x) {
      add_line(slice, x, width, height, background, geometry.axes.col(1).norm(), profiles);
    }
  }
  if (profiles.kept().size() < fewest_profiles) {
    refuse("Only " + std::to_string(profiles.kept().size()) +
           " lines of voxels cross the edge of a grain with " + std::to_string(side) +
           " voxels on both sides, too few to measure the blur of the scan. Leave the scan out.");
  }
  return width_of(profiles.kept());
}

}  // namespace wscvt
