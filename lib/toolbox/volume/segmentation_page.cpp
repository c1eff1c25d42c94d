// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/segmentation_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include "toolbox/report/sample_summary.h"
#include "toolbox/sample/distribution.h"
#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"

namespace wscvt {

namespace {

constexpr const char* page_title = "Grains of a scan: ";

/// A slice across an axis: grey values and labels, rows along `down`.
struct ShownSlice {
  std::size_t axis;
  std::size_t right;
  std::size_t down;
  std::int32_t place;
  std::vector<Label> values;
  std::vector<Label> labels;
};

/// Reads the slices' parts of each row of a volume into the member `of` of each slice.
void read_slices(LabelVolume& volume, std::vector<ShownSlice>& slices,
                 std::vector<Label> ShownSlice::*of, const Execution& execution) {
  const auto take = [&](const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    for (ShownSlice& slice : slices) {
      std::vector<Label>& taken = slice.*of;
      if (slice.axis == 0) {
        taken.push_back(row[static_cast<std::size_t>(slice.place)]);
      } else if ((slice.axis == 1 ? y : z) == slice.place) {
        taken.insert(taken.end(), row.begin(), row.end());
      }
    }
  };
  for_each_row(volume, execution, "Drawing slices", take);
}

/// Returns the place of the slice across x, y and z with the most boundary of grains in it.
VoxelCounts fullest_slices(LabelVolume& labels, Label grains, const Execution& execution) {
  const VoxelCounts& counts = labels.geometry().counts;
  std::array<std::vector<std::uint64_t>, 3> boundary;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boundary[axis].resize(static_cast<std::size_t>(counts[axis]), 0);
  }
  const auto width = static_cast<std::size_t>(counts[0]);
  std::vector<Label> slice_before(width * static_cast<std::size_t>(counts[1]), 0);
  std::size_t k = 0;  // of the slice's voxels
  const auto take = [&](const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    if (y == 0) k = 0;
    Label left = 0;
    for (std::size_t x = 0; x < width; ++x, ++k) {
      const Label here = row[x] > grains ? 0 : row[x];
      const bool along_x = x > 0 && here != left;
      const bool along_y = y > 0 && here != slice_before[k - width];
      const bool along_z = z > 0 && here != slice_before[k];
      boundary[0][x] += (along_y ? 1U : 0U) + (along_z ? 1U : 0U);
      boundary[1][static_cast<std::size_t>(y)] += (along_x ? 1U : 0U) + (along_z ? 1U : 0U);
      boundary[2][static_cast<std::size_t>(z)] += (along_x ? 1U : 0U) + (along_y ? 1U : 0U);
      slice_before[k] = left = here;
    }
  };
  for_each_row(labels, execution, "Choosing slices", take);
  VoxelCounts places = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Of equal slices the one nearest to the middle.
    places[axis] = counts[axis] / 2;
    const auto at = [&](std::int32_t place) {
      return boundary[axis][static_cast<std::size_t>(place)];
    };
    for (std::int32_t step = 1; step < counts[axis]; ++step) {
      for (const std::int32_t place : {counts[axis] / 2 - step, counts[axis] / 2 + step}) {
        if (place < 0 || place >= counts[axis]) continue;
        if (at(place) > at(places[axis])) places[axis] = place;
      }
    }
  }
  return places;
}

/// Returns the values shown as black and white: all but a few at each end.
std::pair<double, double> shown_range(const std::vector<ShownSlice>& slices) {
  std::vector<double> values;
  for (const ShownSlice& slice : slices) {
    for (const Label code : slice.values) {
      if (std::isfinite(grey_value(code))) values.push_back(grey_value(code));
    }
  }
  std::sort(values.begin(), values.end());
  constexpr double left_out = 0.002;
  const double least = quantile(values, left_out);
  const double largest = quantile(values, 1.0 - left_out);
  return {least, largest > least ? largest : least + 1.0};
}

constexpr std::array<Colour, 6> outline_colours = {
    {{255, 220, 0}, {0, 220, 255}, {255, 90, 255}, {60, 230, 60}, {255, 150, 30}, {120, 160, 255}}};

Picture picture_of(const ShownSlice& slice, const VolumeGeometry& geometry, double pixel,
                   Label grains, const std::pair<double, double>& range) {
  const auto count = [&](std::size_t axis) { return geometry.counts[axis]; };
  const auto length = [&](std::size_t axis) {
    return geometry.axes.col(static_cast<Eigen::Index>(axis)).norm();
  };
  const auto pixels = [&](std::size_t axis) {
    return std::max(1, static_cast<int>(std::lround(count(axis) * length(axis) / pixel)));
  };
  Picture picture{pixels(slice.right), pixels(slice.down), {}};
  const auto voxel = [&](int u, int v) {
    const std::int64_t x = static_cast<std::int64_t>(u) * count(slice.right) / picture.width;
    const std::int64_t y = static_cast<std::int64_t>(v) * count(slice.down) / picture.height;
    return static_cast<std::size_t>(y * count(slice.right) + x);
  };
  const auto label = [&](int u, int v) {
    return slice
        .labels[voxel(std::clamp(u, 0, picture.width - 1), std::clamp(v, 0, picture.height - 1))];
  };
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      const float value = grey_value(slice.values[voxel(u, v)]);
      const double share =
          std::isnan(value) ? 0.0 : (value - range.first) / (range.second - range.first);
      const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
      Colour colour = {grey, grey, grey};
      const Label here = label(u, v);
      constexpr int wide = 2;
      const bool is_outline = label(u - wide, v) != here || label(u + wide, v) != here ||
                              label(u, v - wide) != here || label(u, v + wide) != here;
      if (here > grains) {
        colour = {255, static_cast<std::uint8_t>(grey / 3), static_cast<std::uint8_t>(grey / 3)};
      } else if (here != 0 && is_outline) {
        colour = outline_colours[here % outline_colours.size()];
      }
      picture.pixels.push_back(colour);
    }
  }
  return picture;
}

std::size_t grains_at_border(const Segmentation& segmentation) {
  const VoxelCounts& counts = segmentation.labels->geometry().counts;
  return static_cast<std::size_t>(
      std::count_if(segmentation.grains.begin(), segmentation.grains.end(),
                    [&](const LabelExtent& grain) { return grain.touches_border(counts); }));
}

double share_of(std::uint64_t part, std::uint64_t all) {
  return static_cast<double>(part) / static_cast<double>(all);
}

/// Returns the radius of a ball with the volume of the median grain; voxels.
double median_radius(const Segmentation& segmentation) {
  std::vector<std::uint64_t> voxels;
  for (const LabelExtent& grain : segmentation.grains) voxels.push_back(grain.voxels);
  if (voxels.empty()) return 0.0;
  return portable::cbrt(0.75 / pi * static_cast<double>(upper_median(voxels)));
}

/// Adds what two steps across the surfaces may be. Returns whether the grey values go on beyond a
/// layer, so that there are two outlines to choose from.
bool add_steps(const Segmentation& segmentation, std::vector<Sentence>& doubts) {
  bool goes_on = false;
  for (const EdgeSteps& steps : segmentation.steps) {
    if (!steps.are_told()) continue;
    const std::string layer =
        (steps.thickness == 0.0 ? "a layer less than 2 voxels thick"
                                : "a layer about " + format_number(steps.thickness, 2) +
                                      " voxels thick at the surface of " +
                                      format_percent(steps.fraction) + " of the grains") +
        " is near " + format_number(steps.layer, 4);
    const std::string values = ", the void near " + format_number(steps.space, 4) +
                               " and the inside near " + format_number(steps.inside, 4);
    const auto between = [](double a, double b) {
      return mention("threshold", format_number(0.5 * (a + b), 4));
    };
    if (steps.goes_on()) {
      goes_on = true;
      doubts.push_back(
          "Grey values change in two steps from the void to the inside of grains: " + layer +
          values +
          ". It may be a film of water, which is no grain, or the outer part of grains with a coat "
          "or a dense core. " +
          "The outlines may lie on either step or between them. For grains with the layer, segment "
          "once more by " +
          between(steps.space, steps.layer) + "; for grains without it, by " +
          between(steps.layer, steps.inside) + ".");
    } else {
      doubts.push_back("Grains differ more from the void at their surface than inside: " + layer +
                       values +
                       ". It may be a coat, beam hardening, or the grain around a pore. The "
                       "outlines are half way from the void to the layer, as by " +
                       between(steps.space, steps.layer) +
                       ". Of a layer of 2 voxels they are less exact: look at the slices.");
    }
  }
  return goes_on;
}

/// Whether the layers of most grains, and what is below them, are all peaks but the void's: these
/// grains are no minerals.
bool are_of_layers(const Segmentation& segmentation) {
  const std::vector<double>& peaks = segmentation.peaks;
  if (peaks.size() < 3) return false;
  const double near = 0.15 * (peaks.back() - peaks.front());
  constexpr double most = 0.5;
  return std::all_of(peaks.begin(), peaks.end(), [&](double peak) {
    return std::any_of(segmentation.steps.begin(), segmentation.steps.end(),
                       [&](const EdgeSteps& steps) {
                         if (steps.fraction < most || steps.thickness == 0.0) return false;
                         const double nearest =
                             std::min({std::abs(peak - steps.space), std::abs(peak - steps.layer),
                                       std::abs(peak - steps.inside)});
                         return nearest <= near;
                       });
  });
}

/// Adds how much too large or too small grains come out.
void add_biases(const Segmentation& segmentation, std::vector<Sentence>& doubts) {
  if (segmentation.has_fringes) {
    doubts.push_back(
        "Grains have a rim at their surface and the void beside them one of the other sign, as by "
        "phase contrast or by a filter that sharpens. The outlines are half way between the void "
        "and the inside of grains, away from both rims.");
  }
  // A layer says more of the edges than the blur.
  if (add_steps(segmentation, doubts)) return;
  const double radius = median_radius(segmentation);
  constexpr double small = 0.05;
  // What is not corrected moves the surface by its variance over the radius.
  const double rest = segmentation.blur * segmentation.blur - largest_blur * largest_blur;
  const double loss = radius > 0.0 ? 3.0 * rest / (radius * radius) : 0.0;
  if (loss > small && segmentation.medians == 1) {
    doubts.push_back(
        "The edges of the grains are soft, as by a blur with a standard deviation of " +
        format_number(segmentation.blur, 2) + " voxels. At most " + format_number(largest_blur, 2) +
        " is corrected: by such a blur, grains of the median size, " +
        format_number(2.0 * radius, 3) + " voxels across, come out about " +
        std::to_string(std::llround(100.0 * std::min(1.0, loss))) +
        " % too small, smaller ones more. A film around the grains makes soft edges too, and "
        "grains too large: look at the slices.");
  }
}

/// What is material but not in the labels.
void add_left_out(const Segmentation& segmentation, std::vector<Sentence>& doubts) {
  if (segmentation.wall > 0) {
    doubts.push_back("A smooth wall of one thickness, " +
                     format_percent(share_of(segmentation.wall, segmentation.voxels)) +
                     " of the volume, lies around the grains or beside them: it is taken for a "
                     "container, and left out. "
                     "Grains that touch it are parted from it at its thickness.");
  }
  if (segmentation.cut > 0) {
    doubts.push_back(format_count(segmentation.cut, "grain touches", "grains touch") +
                     " voxels that were not scanned and may be cut. The labels do not have them.");
  }
}

/// Adds a doubt on grey values that were cut off at the least, the largest or both.
void add_cut_off(const Segmentation& segmentation, std::vector<Sentence>& doubts) {
  const CutOffGreys& cut_off = segmentation.cut_off;
  std::string found;
  for (const bool is_least : {true, false}) {
    const double fraction = is_least ? cut_off.least : cut_off.largest;
    if (fraction == 0.0) continue;
    found += (found.empty() ? "" : ", and ") + format_percent(fraction) + " of the voxels of the " +
             (is_least == segmentation.is_dark ? "grains" : "space between the grains") +
             " have one value, the " + (is_least ? "least" : "largest") + " of the scan";
  }
  if (found.empty()) return;
  const bool are_both = cut_off.least > 0.0 && cut_off.largest > 0.0;
  const bool is_large = (cut_off.least > 0.0) == segmentation.is_dark;
  doubts.push_back(
      found +
      ". This is right for a mask that was smoothed or resampled. Of a scan the values "
      "beyond were cut off when it was saved, and grains come out too " +
      (are_both   ? "small or too large"
       : is_large ? "large"
                  : "small") +
      ". Save the scan again with a wider range of grey values. If you know those of "
      "grains and space before the cut, give " +
      mention("threshold") + " half way between them.");
}

/// The grey values of the peaks, as "3 peaks, at 40, 100 and 190".
std::string peaks_text(const std::vector<double>& peaks) {
  std::vector<std::string> values;
  for (const double peak : peaks) values.push_back(format_number(peak, 4));
  return std::to_string(peaks.size()) + " peaks, at " + enumerated(values, " and ");
}

/// Adds a doubt on material that is not the grains, but what is between them.
void add_inverted(const Segmentation& segmentation, const std::string& why,
                  std::vector<Sentence>& doubts) {
  const bool is_dark = segmentation.is_dark;
  const std::string grains = is_dark ? "brighter" : "darker";
  const Sentence other_side = is_dark ? "leave " + mention("dark", "true") + " out."
                                      : "give " + mention("dark", "true") + ".";
  // A resin with bubbles lies between the grains' grey value and that of the bubbles.
  const bool has_phases = segmentation.peaks.size() > 2 && !segmentation.is_chosen;
  doubts.push_back(why +
                   (has_phases
                        ? ". The grey values have " + peaks_text(segmentation.peaks) +
                              ". If only the " + (is_dark ? "darkest" : "brightest") +
                              " are grains, give their number, such as " + mention("phases", "1")
                        : Sentence("")) +
                   ". If the grains are " + grains + " than the rest, " + other_side);
}

/// Adds a doubt on where grains end.
void add_ends(const Segmentation& segmentation, std::vector<Sentence>& doubts) {
  const std::vector<std::size_t>& lost = segmentation.cutting_slices;
  if (!lost.empty()) {
    std::vector<std::string> numbers;
    for (const std::size_t slice : lost) numbers.push_back(std::to_string(slice));
    constexpr std::size_t most = 6;
    doubts.push_back(format_count(lost.size(), "slice has", "slices have") +
                     " one grey value, so that grains end there, as at slices that were lost: " +
                     listed(numbers, most) +
                     ", counted from 0. Replace each by a copy of its neighbour, in Python "
                     "scan[" +
                     numbers.front() + "] = scan[" + std::to_string(lost.front() - 1) + "].");
  }
  // At most .11 in 20 packings that were separated rightly, .2 and more of needles, blades and
  // flakes of 2 to 7 voxels, .5 of porous grains (tests/figures/study/scan_kinds.py has some).
  constexpr double many = 0.2;
  if (segmentation.wide_neck_fraction > many) {
    doubts.push_back(
        format_percent(segmentation.wide_neck_fraction) +
        " of the grains touch a larger one over a neck nearly as wide as themselves: they may be "
        "pieces of porous, thin or long grains, or grains that cement joins. Look at the slices. "
        "Close pores in Python by scipy.ndimage.grey_" +
        (segmentation.is_dark ? "opening" : "closing") +
        "(scipy.ndimage.median_filter(scan, 3), SIZE), with a SIZE just above the width of a pore "
        "in voxels. Scan thin grains with smaller voxels. A smaller " +
        mention("separate") + " joins pieces, a larger one parts grains.");
  }
}

/// Adds a doubt on the grey values of void and material.
void add_peaks(const Segmentation& segmentation, bool is_inverted, std::vector<Sentence>& doubts) {
  const bool is_uneven = !is_inverted && segmentation.brightest_space > segmentation.darkest_space;
  if (is_uneven) {
    doubts.push_back("The space between the grains has grey values from " +
                     format_number(segmentation.darkest_space, 4) + " to " +
                     format_number(segmentation.brightest_space, 4) +
                     " in parts of the volume, so that no threshold serves all of them. Correct "
                     "beam hardening or drift in the reconstruction, or take the background away, "
                     "in Python by scipy.ndimage." +
                     (segmentation.is_dark ? "black_tophat" : "white_tophat") +
                     "(scan, SIZE) with a SIZE above the largest grain's, in voxels.");
  }
  add_cut_off(segmentation, doubts);
  // Who chose the material has seen the peaks. Of inverted grains they are not the grains', and
  // of layers more is told.
  const std::size_t peaks =
      segmentation.is_chosen || is_inverted || is_uneven || are_of_layers(segmentation)
          ? 0
          : segmentation.peaks.size();
  if (peaks == 1) {
    doubts.push_back("The grey values have one peak, at " +
                     format_number(segmentation.peaks[0], 4) +
                     ": grains and the space between them do not differ much, or by less than the "
                     "noise or a background that is not even. Give " +
                     mention("threshold") +
                     " if the outlines are wrong. Beam hardening is corrected in the "
                     "reconstruction.");
  } else if (peaks > 2) {
    doubts.push_back("The grey values have " + peaks_text(segmentation.peaks) +
                     ", as of several minerals. The material is all " +
                     (segmentation.is_dark ? "up to " : "from ") +
                     format_number(segmentation.threshold, 4) +
                     (segmentation.is_dark ? "" : " on") + ". If only the " +
                     (segmentation.is_dark ? "darkest" : "brightest") +
                     " are grains, give their number, such as " + mention("phases", "1") + ".");
  }
}

}  // namespace

std::vector<Sentence> doubts_of(const Segmentation& segmentation) {
  std::vector<Sentence> doubts;
  if (segmentation.is_flat) {
    doubts.push_back(
        "Most voxels have the value of their neighbour: these may be labels already. wscvt batch "
        "and extract read labels directly.");
  }
  constexpr double much = 0.05;
  // Grains at the border of what was scanned leave some of it open.
  constexpr double full = 0.85;
  const bool is_inverted =
      segmentation.filled > 0 &&
      share_of(segmentation.material, segmentation.voxels - segmentation.not_scanned) > full;
  // The space between loose grains has -.3 to -.7, dense grains in contact +.1 and more.
  constexpr double least_fraction = -0.2;
  const bool is_space = !is_inverted && segmentation.island_fraction < least_fraction;
  if (is_inverted) {
    add_inverted(segmentation,
                 "The material fills the volume, with holes of " +
                     format_percent(share_of(segmentation.filled, segmentation.material)) +
                     " of it",
                 doubts);
  } else if (is_space) {
    add_inverted(segmentation,
                 "In slices the material has more holes than islands, as the space between grains "
                 "has",
                 doubts);
  }
  add_peaks(segmentation, is_inverted, doubts);
  if (!is_inverted) add_biases(segmentation, doubts);
  if (segmentation.medians > 1) {
    doubts.push_back("The noise is strong: the grey values were smoothed " +
                     std::to_string(segmentation.medians) +
                     " times before two peaks stood out. Grains of a few voxels may be lost, and "
                     "outlines are rough. If they are wrong, give " +
                     mention("threshold") + ".");
  }
  add_left_out(segmentation, doubts);
  if (!is_inverted && !is_space) add_ends(segmentation, doubts);
  if (share_of(segmentation.dropped, segmentation.material) > much) {
    doubts.push_back(format_percent(share_of(segmentation.dropped, segmentation.material)) +
                     " of the material is in parts that are too small, red in the slices: noise, "
                     "or a wrong threshold. Give " +
                     mention("threshold") + ", or a lower " + mention("smallest") + ".");
  }
  std::uint64_t largest = 0;
  for (const LabelExtent& grain : segmentation.grains) largest = std::max(largest, grain.voxels);
  constexpr double most = 0.75;
  // Inverted grains are one body, and no other separation helps.
  if (!is_inverted && segmentation.grains.size() != 2 &&
      share_of(largest, segmentation.material) > most) {
    doubts.push_back("One grain has " + format_percent(share_of(largest, segmentation.material)) +
                     " of the material: it may be several. Give a larger " + mention("separate") +
                     ", or a higher " + mention("threshold") + ".");
  }
  return doubts;
}

std::vector<std::string> segmentation_lines(const Segmentation& segmentation) {
  const std::size_t count = segmentation.grains.size() + segmentation.cut;
  std::vector<std::string> lines = {
      format_count(count, "grain") + ", " +
      std::to_string(grains_at_border(segmentation) + segmentation.cut) + " of them at the border"};
  if (segmentation.not_scanned > 0) {
    lines.push_back(format_percent(share_of(segmentation.not_scanned, segmentation.voxels)) +
                    " of the volume was not scanned: it is constant, or not a number");
  }
  lines.push_back(
      (segmentation.is_mask
           ? "The volume is a mask; its material is "
           : "Threshold " + format_number(segmentation.threshold) + "; the material is ") +
      format_percent(share_of(segmentation.material, segmentation.voxels)) +
      " of the volume, holes of " +
      format_percent(share_of(segmentation.filled, segmentation.material)) + " of it were filled");
  lines.push_back(format_percent(share_of(segmentation.dropped, segmentation.material)) +
                  " of the material is in parts that are too small and was dropped");
  for (const Sentence& doubt : doubts_of(segmentation)) lines.push_back("Look: " + doubt.text());
  return lines;
}

OutlinedSlices outlined_slices(LabelVolume& scan, const Segmentation& segmentation,
                               const Execution& execution) {
  const VolumeGeometry& geometry = scan.geometry();
  const auto grains = static_cast<Label>(segmentation.grains.size());
  OutlinedSlices result;
  result.places = fullest_slices(*segmentation.labels, grains, execution.part(0.0, 0.3));
  std::vector<ShownSlice> slices = {{2, 0, 1, result.places[2], {}, {}},
                                    {1, 0, 2, result.places[1], {}, {}},
                                    {0, 1, 2, result.places[0], {}, {}}};
  scan.read_grey_values();
  read_slices(scan, slices, &ShownSlice::values, execution.part(0.3, 0.6));
  read_slices(*segmentation.labels, slices, &ShownSlice::labels, execution.part(0.6, 1.0));
  double longest = 0.0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    longest = std::max(longest,
                       geometry.counts[static_cast<std::size_t>(k)] * geometry.axes.col(k).norm());
  }
  constexpr double pixels = 600.0;
  const std::pair<double, double> range = shown_range(slices);
  for (const ShownSlice& slice : slices) {
    result.pictures.push_back(picture_of(slice, geometry, longest / pixels, grains, range));
  }
  return result;
}

bool is_segmentation_page(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(512, '\0');  // more than comes before the title
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find(std::string("<title>") + page_title) != std::string::npos;
}

std::string segmentation_html(LabelVolume& scan, const Segmentation& segmentation,
                              const ReportOrigin& origin, const Execution& execution) {
  const VolumeGeometry& geometry = scan.geometry();
  HtmlDocument page(page_title + std::to_string(segmentation.grains.size()));
  page.add_paragraph(origin_sentence(origin));
  for (const Sentence& doubt : doubts_of(segmentation)) page.add_warning(doubt);
  const OutlinedSlices slices = outlined_slices(scan, segmentation, execution);
  const auto place = [&](const char* axis, std::size_t k) {
    return std::string(axis) + " = " + std::to_string(slices.places[k]) + " of " +
           std::to_string(geometry.counts[k]) + " voxels: ";
  };
  const std::array<std::string, 3> captions = {place("z", 2) + "x to the right, y down.",
                                               place("y", 1) + "x to the right, z down.",
                                               place("x", 0) + "y to the right, z down."};
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < slices.pictures.size(); ++k) {
    figures.push_back({image_element(slices.pictures[k], captions[k]), captions[k]});
  }
  page.add_figures(figures);
  page.add_paragraph("Each grain has its own outline. If an outline goes around two grains, make " +
                     mention("separate") + " larger. If a line cuts through a grain, make " +
                     mention("separate") +
                     " smaller. If outlines are off the edges of the grains, give " +
                     mention("threshold") + ". Red parts were dropped.");
  page.add_lines(segmentation_lines(segmentation));
  std::vector<double> diameters;
  for (const LabelExtent& grain : segmentation.grains) {
    const double volume = static_cast<double>(grain.voxels) * geometry.voxel_volume();
    diameters.push_back(portable::cbrt(6.0 * volume / pi));
  }
  std::sort(diameters.begin(), diameters.end());
  const std::string unit = geometry.unit.empty() ? "" : ", " + geometry.unit;
  const std::string what = "diameter of the sphere of equal volume" + unit;
  page.add_heading("Sizes");
  std::vector<std::string> row = {what};
  for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    row.push_back(format_number(quantile(diameters, share), 4));
  }
  page.add_rows({{"of the grains", "smallest", "10 %", "50 %", "90 %", "largest"}, row});
  page.add_figures({{histogram_figure(what, "grains", {{"", "#0a58b4", histogram_of(diameters)}}),
                     "Sizes of " + std::to_string(diameters.size()) + " grains."}});
  return page.text();
}

}  // namespace wscvt
