// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/segmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "grains/packing.h"
#include "support/expect_error.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "support/tiff_pages.h"
#include "support/volume_folder.h"
#include "toolbox/volume/itk_filters.h"
#include "toolbox/volume/label_grains.h"
#include "toolbox/volume/segmentation_page.h"
#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

using test::holds;
using test::MadeVolume;

class SegmentationOfAFile : public test::VolumeFolder {
 protected:
  void write_made(const std::string& spacings = "1 1 1") const {
    write("a.nrrd",
          test::nrrd(made_, "spacings: " + spacings + "\nspace units: \"mm\" \"mm\" \"mm\"\n"));
  }
  Segmentation segmented(const SegmentationOptions& options = {}, int threads = 1) const {
    return segment(*open_volume(path("a.nrrd")), options, Execution(threads));
  }
  /// Labels, what was dropped as 0.
  static std::vector<Label> kept(const Segmentation& found) {
    std::vector<Label> labels = all_of(*found.labels);
    for (Label& label : labels) label = label > found.grains.size() ? 0 : label;
    return labels;
  }
  /// The lines of the log that ask to look.
  static std::string looks(const Segmentation& found) {
    std::string text;
    for (const std::string& line : segmentation_lines(found)) {
      if (line.rfind("Look: ", 0) == 0) text += line + "\n";
    }
    return text;
  }
  static Vector3 middle_of(const LabelExtent& grain) {
    return 0.5 * Vector3(grain.begin[0] + grain.end[0], grain.begin[1] + grain.end[1],
                         grain.begin[2] + grain.end[2]);
  }
};

class SegmentationOfAPacking : public SegmentationOfAFile {
 protected:
  /// Grains of all sizes in contact, as a scan or as a mask.
  void pack(const Vector3& spacing, bool is_mask) {
    test::PackingOptions options;
    options.count = 12;
    options.smallest = 9.0;
    options.largest = 15.0;
    options.box = {66.0, 64.0, 66.0};
    static const std::vector<test::PackedGrain> packed = test::packing(options);
    grains_ = packed;
    voxels_ = test::voxels_of(grains_, options.box, spacing);
    made_ = MadeVolume(voxels_.counts);
    made_.labels = is_mask ? voxels_.truth : test::grey_values(voxels_, {});
    if (is_mask) {
      for (Label& label : made_.labels) label = label == 0 ? 0 : 255;
    }
    write_made(std::to_string(spacing[0]) + " " + std::to_string(spacing[1]) + " " +
               std::to_string(spacing[2]));
  }
  test::PackingFound score(const Segmentation& found) const {
    return test::found_in(kept(found), grains_, voxels_);
  }

  std::vector<test::PackedGrain> grains_;
  test::PackedVoxels voxels_;
};

TEST_F(SegmentationOfAPacking, FindsTheGrainsOfAScanAtAnyNumberOfThreads) {
  pack({1.0, 1.0, 1.0}, false);
  // They do touch: parts alone are fewer.
  SegmentationOptions parts;
  parts.separate = 0.0;
  EXPECT_LT(segmented(parts).grains.size(), grains_.size() / 2);
  const Segmentation found = segmented();
  const test::PackingFound met = score(found);
  EXPECT_EQ(met.one_to_one, grains_.size());
  EXPECT_EQ(met.labels, grains_.size());
  EXPECT_LT(std::abs(met.volume_bias), 0.02);
  EXPECT_NEAR(found.threshold, 110.0, 1.5) << "half way between 60 and 160";
  EXPECT_FALSE(found.is_mask);
  const std::vector<Label> labels = all_of(*found.labels);
  for (const int threads : {2, 5}) {
    EXPECT_EQ(all_of(*segmented({}, threads).labels), labels) << threads;
  }
  // Each grain is of one part, numbered as they begin, and its extent is told.
  const std::vector<LabelExtent> again = label_census(*found.labels, 0, Execution(1));
  Label next = 1;
  for (const Label label : labels) {
    ASSERT_LE(label, next);
    if (label == next) ++next;
  }
  ASSERT_EQ(found.grains.size(), grains_.size());
  for (std::size_t k = 0; k < found.grains.size(); ++k) {
    EXPECT_EQ(again[k].pieces, 1U);
    EXPECT_EQ(found.grains[k].label, again[k].label);
    EXPECT_EQ(found.grains[k].voxels, again[k].voxels);
    EXPECT_EQ(found.grains[k].begin, again[k].begin);
  }
}

TEST_F(SegmentationOfAPacking, FindsTheGrainsOfLongVoxels) {
  pack({0.8, 1.0, 1.5}, false);
  EXPECT_EQ(score(segmented()).one_to_one, grains_.size());
}

TEST_F(SegmentationOfAPacking, TakesMasksAsTheyAre) {
  pack({1.0, 1.0, 1.0}, true);
  const Segmentation found = segmented();
  EXPECT_TRUE(found.is_mask);
  EXPECT_EQ(score(found).one_to_one, grains_.size());
  const std::vector<Label> labels = all_of(*found.labels);
  const auto mask = made_.labels;
  std::size_t material = 0;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    EXPECT_TRUE(labels[k] != 0 || mask[k] == 0) << k;  // holes are filled
    material += mask[k] != 0 ? 1 : 0;
  }
  EXPECT_EQ(found.material, material + found.filled);

  // The same of one bit, and as extract and batch take it.
  const auto width = static_cast<std::size_t>(made_.counts[0]);
  const std::size_t row_bytes = (width + 7) / 8;
  std::vector<std::string> pages;
  for (std::size_t k = 0; k < mask.size(); k += width) {
    if (k % (width * static_cast<std::size_t>(made_.counts[1])) == 0) pages.emplace_back();
    std::string row(row_bytes, '\0');
    for (std::size_t x = 0; x < width; ++x) {
      if (mask[k + x] != 0) row[x / 8] = static_cast<char>(row[x / 8] | 0x80 >> x % 8);
    }
    pages.back() += row;
  }
  test::TiffPages one_bit;
  one_bit.width = made_.counts[0];
  one_bit.height = made_.counts[1];
  one_bit.bits = 1;
  test::write_tiff(path("one_bit.tif"), one_bit, pages);
  const std::unique_ptr<LabelVolume> volume = open_volume(path("one_bit.tif"));
  EXPECT_EQ(all_of(*segment(*volume, {}, Execution(1)).labels), labels);

  VolumeOptions options;
  options.separate = 0.85;
  options.smallest = 1;
  const LabelGrains grains(path("one_bit.tif"), options, Execution(1));
  EXPECT_EQ(grains.labels().size(), found.grains.size());
  EXPECT_EQ(grains.left_out(), 0.0);
  ASSERT_FALSE(grains.notes().empty());
  EXPECT_TRUE(holds(grains.notes()[0].text(), "voxel size"));
}

TEST_F(SegmentationOfAFile, MeasuresNecksAgainstTheSmallerGrain) {
  // Two balls of 12 in contact along z, and one that is a peanut of 9 and a shallow neck along x.
  const Vector3 spacing(1.0, 1.5, 2.5);
  made_ = MadeVolume({70, 30, 28});
  const auto ball = [&](const Vector3& middle, double radius) {
    made_.fill(
        1, [&](const Vector3& p) { return (p.cwiseProduct(spacing) - middle).norm() < radius; });
  };
  ball({15.0, 22.0, 18.0}, 12.0);
  ball({15.0, 22.0, 41.0}, 12.5);
  ball({42.0, 22.0, 35.0}, 9.0);
  ball({44.5, 22.0, 35.0}, 9.0);
  write_made("1 1.5 2.5");
  const Segmentation found = segmented();
  ASSERT_EQ(found.grains.size(), 3U);
  std::vector<Vector3> middles;
  for (const LabelExtent& grain : found.grains) {
    middles.push_back(middle_of(grain).cwiseProduct(spacing));
  }
  EXPECT_LT((middles[0] - Vector3(15.0, 22.0, 18.0)).norm(), 2.0);
  EXPECT_LT((middles[1] - Vector3(43.2, 22.0, 35.0)).norm(), 2.0);
  EXPECT_LT((middles[2] - Vector3(15.0, 22.0, 41.0)).norm(), 2.0);
  // The balls of 12 are 23 apart: their neck is 3.4 wide, of 12.
  SegmentationOptions wide;
  wide.separate = 0.15;
  EXPECT_EQ(segmented(wide).grains.size(), 2U);
  // The peanut is cut by nothing but 1: its neck is as wide as its ends but for 1 %.
  wide.separate = 0.9;
  EXPECT_EQ(segmented(wide).grains.size(), 3U);
}

TEST_F(SegmentationOfAFile, WallsAreStraightAlsoWhereVoxelsAreLong) {
  // Two balls of 15 that overlap: those of a watershed had 120 and 127 voxels on the wrong side.
  for (const double length : {1.0, 2.5}) {
    const Vector3 spacing(1.0, 1.0, length);
    const Vector3 middle(40.7, 30.8, 30.6);
    const Vector3 half = 13.0 * Vector3(2.0, 1.0, 1.5).normalized();
    const auto away = [&](const Vector3& p, double side) {
      return (p.cwiseProduct(spacing) - (middle + side * half)).norm();
    };
    made_ = MadeVolume({80, 60, static_cast<int>(60.0 / length)});
    made_.fill(2, [&](const Vector3& p) { return away(p, 1.0) < 15.0; });
    made_.fill(1, [&](const Vector3& p) { return away(p, -1.0) < std::min(15.0, away(p, 1.0)); });
    const std::vector<Label> truth(made_.labels.begin(), made_.labels.end());
    for (auto& label : made_.labels) label = label == 0 ? 0 : 1;
    write_made("1 1 " + std::to_string(length));
    const Segmentation found = segmented({}, 2);
    ASSERT_EQ(found.grains.size(), 2U) << length;
    const std::vector<Label> labels = kept(found);
    EXPECT_EQ(kept(segmented()), labels);
    std::array<int, 2> wrong = {0, 0};
    for (std::size_t k = 0; k < labels.size(); ++k) {
      if (labels[k] == 0) continue;
      ++wrong[labels[k] == truth[k] ? 1 : 0];
    }
    EXPECT_LE(std::min(wrong[0], wrong[1]), 30) << length;
  }
}

TEST_F(SegmentationOfAFile, FillsHolesDropsSpecksAndKnowsTheBorder) {
  made_ = MadeVolume({60, 40, 30});
  const std::int64_t ball = made_.fill_ball(200, {14, 14, 14}, 10.0);
  const std::int64_t hole = made_.fill_ball(50, {13, 15, 14}, 4.0);
  const std::int64_t cut = made_.fill_box(200, {40, 20, 10}, {60, 36, 25});
  made_.fill_box(50, {55, 25, 15}, {60, 30, 20});  // an open pit: it is no hole
  const std::int64_t speck = made_.fill_box(200, {30, 5, 20}, {34, 9, 24});
  for (Label& label : made_.labels) label = label == 0 ? 50 : label;
  write_made();
  const Segmentation found = segmented();
  ASSERT_EQ(found.grains.size(), 2U);
  EXPECT_EQ(found.filled, static_cast<std::uint64_t>(hole));
  EXPECT_EQ(found.dropped, static_cast<std::uint64_t>(speck));
  EXPECT_EQ(found.grains[0].voxels, static_cast<std::uint64_t>(ball));
  EXPECT_EQ(found.grains[1].voxels, static_cast<std::uint64_t>(cut - 125));
  EXPECT_EQ(found.material, static_cast<std::uint64_t>(ball + cut - 125 + speck));
  EXPECT_EQ(found.voxels, made_.labels.size());
  const std::vector<Label> labels = all_of(*found.labels);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 3), speck) << "one number for all dropped";
  EXPECT_EQ(segmentation_lines(found)[0], "2 grains, 1 of them at the border");
  SegmentationOptions options;
  options.smallest = speck;
  EXPECT_EQ(segmented(options).grains.size(), 3U);
  options.smallest = ball + cut;
  EXPECT_ERROR(segmented(options), InvalidInput);
}

TEST_F(SegmentationOfAFile, SmoothsNoiseAwayAndTakesAnyRangeOfValues) {
  // Values beyond 16 bits, with single voxels that are off, as a detector has.
  made_ = MadeVolume({30, 28, 26});
  const std::int64_t ball = made_.fill_ball(1, {15, 14, 13}, 9.0);
  for (std::size_t k = 0; k < made_.labels.size(); ++k) {
    const bool is_off = k % 101 == 0;
    made_.labels[k] = (made_.labels[k] != 0) != is_off ? 3000000000U : 2999000000U;
    made_.labels[k] += static_cast<Label>(k * 7919 % 100000);
  }
  write("a.nrrd", "NRRD0004\ntype: uint32\ndimension: 3\nencoding: raw\nendian: little\nsizes: " +
                      made_.size_text() + "\n\n" + made_.bytes<std::uint32_t>());
  const Segmentation found = segmented();
  ASSERT_EQ(found.grains.size(), 1U);
  EXPECT_EQ(found.material, found.grains[0].voxels) << "no specks";
  EXPECT_EQ(found.filled, 0U);
  EXPECT_NEAR(static_cast<double>(found.material), static_cast<double>(ball),
              0.03 * static_cast<double>(ball));
  EXPECT_NEAR(found.threshold, 2999550000.0, 1e5);
  SegmentationOptions options;
  options.threshold = 3000200000.0;
  EXPECT_ERROR(segmented(options), InvalidInput);
}

template <class Value>
std::string raw_bytes(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

TEST_F(SegmentationOfAFile, TakesFractionsNegativeValuesAndWhatIsNoNumber) {
  made_ = MadeVolume({30, 28, 26});
  const std::int64_t ball = made_.fill_ball(1, {15, 14, 13}, 9.0);
  // What a reconstruction gives: attenuation, hot voxels, nothing outside of its cylinder.
  std::vector<float> fractions;
  std::vector<std::int16_t> hounsfield;
  for (std::size_t k = 0; k < made_.labels.size(); ++k) {
    const double noise = static_cast<double>(k * 7919 % 101) / 101.0 - 0.5;
    fractions.push_back(static_cast<float>((made_.labels[k] != 0 ? 0.4 : -0.1) + 0.1 * noise));
    hounsfield.push_back(
        static_cast<std::int16_t>((made_.labels[k] != 0 ? 1500 : -1000) + 300 * noise));
  }
  for (std::size_t k = 0; k < 30 * 28; ++k) fractions[k] = std::numeric_limits<float>::quiet_NaN();
  fractions[5000] = 9e20F;
  fractions[5555] = -1e25F;
  const std::string header =
      "\ndimension: 3\nencoding: raw\nendian: little\nsizes: " + made_.size_text() + "\n\n";
  const auto expect_ball = [&](double threshold, double tolerance) {
    const Segmentation found = segmented();
    ASSERT_EQ(found.grains.size(), 1U);
    EXPECT_NEAR(found.threshold, threshold, tolerance);
    EXPECT_NEAR(static_cast<double>(found.material), static_cast<double>(ball),
                0.03 * static_cast<double>(ball));
  };
  write("a.nrrd", "NRRD0004\ntype: float" + header + raw_bytes(fractions));
  expect_ball(0.15, 0.02);  // a fifth of the noise
  const std::unique_ptr<LabelVolume> scan = open_volume(path("a.nrrd"));
  const Segmentation found = segment(*scan, {}, Execution(1));
  EXPECT_NE(segmentation_html(*scan, found, {}, Execution(1)), "");
  write("a.nrrd", "NRRD0004\ntype: int16" + header + raw_bytes(hounsfield));
  expect_ball(250.0, 30.0);
  SegmentationOptions options;
  options.threshold = -2000.0;
  EXPECT_EQ(segmented(options).material, made_.labels.size());
  // The codes rise with the values.
  const std::vector<float> values = {
      -std::numeric_limits<float>::infinity(), -3.5F, -1e-30F, 0.0F, 1e-30F, 7.0F,
      std::numeric_limits<float>::max()};
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_EQ(grey_value(grey_code(values[k])), values[k]);
    const Label before = k == 0 ? 0 : grey_code(values[k - 1]);
    EXPECT_LT(before, grey_code(values[k])) << "0 is what is no number";
  }
}

/// Eight balls in two minerals and a void, with noise, as 8-bit values.
class SegmentationOfTwoMinerals : public SegmentationOfAFile {
 protected:
  static constexpr Label void_grey = 40;
  static constexpr Label quartz = 110;

  /// `grey`: of the void, of six grains and of two.
  void make(const std::array<Label, 3>& grey, int noise = 12) {
    made_ = MadeVolume({56, 52, 40});
    made_.fill(grey[0], [](const Vector3&) { return true; });
    int k = 0;
    for (const double x : {15.0, 40.0}) {
      for (const double y : {14.0, 38.0}) {
        for (const double z : {10.0, 29.0}) {
          const bool is_second = k == 2 || k == 5;
          made_.fill_ball(grey[is_second ? 2 : 1], {x, y, z}, 6.0 + 0.3 * k);
          ++k;
        }
      }
    }
    std::mt19937 random(5);
    for (Label& value : made_.labels) {
      value += static_cast<Label>(random() % (2U * static_cast<unsigned>(noise) + 1U));
      value -= static_cast<Label>(noise);
    }
  }
};

/// A ball with a blur, of a radius and grey values between 0 and `grey`, as in the volume of the
/// edge of a plane: exact enough far from the middle.
double blurred_ball(double distance, double radius, double grey, double blur) {
  return 0.5 * grey * std::erfc((distance - radius) / (std::sqrt(2.0) * blur));
}

/// Four balls with grey values over a void of 40, each with its own, and what else a test adds.
class SegmentationOfFourBalls : public SegmentationOfTwoMinerals {
 protected:
  static constexpr double radius = 8.0;
  static constexpr double ball_volume = 4.0 / 3.0 * pi * radius * radius * radius;

  /// `add`: grey value at a point besides the balls'. `margin`: of voxels along x and y.
  template <class Add>
  void write_scan(const std::array<double, 4>& over, double blur, const Add& add,
                  bool is_mirrored = false, int margin = 0) {
    std::mt19937 random(6);
    const int width = 54 + 2 * margin;
    made_ = MadeVolume({width, width, 27});
    for (std::size_t k = 0; k < made_.labels.size(); ++k) {
      const int n = static_cast<int>(k);
      const Vector3 p(n % width - margin + 0.5, n / width % width - margin + 0.5,
                      n / (width * width) + 0.5);
      double grey = 40.0 + add(p);
      for (std::size_t ball = 0; ball < middles_.size(); ++ball) {
        grey += blurred_ball((p - middles_[ball]).norm(), radius, over[ball], blur);
      }
      made_.labels[k] = static_cast<Label>(grey + static_cast<double>(random() % 9));
      if (is_mirrored) made_.labels[k] = 1000 - made_.labels[k];
    }
    write_made();
  }
  /// Volumes of the grains over a ball's, by their labels.
  static std::vector<double> volumes(const Segmentation& found) {
    std::vector<double> shares;
    for (const LabelExtent& grain : found.grains) {
      shares.push_back(static_cast<double>(grain.voxels) / ball_volume);
    }
    return shares;
  }
  static double nothing(const Vector3& /*point*/) { return 0.0; }

  const std::array<Vector3, 4> middles_ = {Vector3(13.1, 13.4, 13.2), Vector3(40.3, 13.2, 13.7),
                                           Vector3(13.6, 40.1, 13.9), Vector3(40.4, 40.7, 13.3)};
};

TEST_F(SegmentationOfFourBalls, EachGrainHasItsOwnEdge) {
  // With one level for all, the bright ball is 30 % too large and more.
  for (const double bright : {90.0, 150.0, 400.0}) {
    for (const bool is_dark : {false, true}) {
      write_scan({40, 40, 40, bright}, 0.8, nothing, is_dark);
      SegmentationOptions options;
      options.dark = is_dark;
      const Segmentation found = segmented(options);
      ASSERT_EQ(found.grains.size(), 4U) << bright;
      for (const double volume : volumes(found)) {
        // The level of .05 of a contrast is a blur's 1.6 standard deviations out, or 40 %.
        EXPECT_NEAR(volume, 1.0, 0.05) << bright << (is_dark ? " dark" : "");
      }
      EXPECT_FALSE(holds(looks(found), "too large"));
    }
  }
}

// A coat of 2 voxels, as of iron oxide: the surface is half way to it. By the core's grey value a
// ball of 8 voxels radius comes out 18 and 28 % too large.
TEST_F(SegmentationOfFourBalls, TheCoatOfAGrainIsItsEdge) {
  constexpr double core = 70.0;
  for (const double coat : {120.0, 180.0}) {
    for (const bool is_dark : {false, true}) {
      write_scan(
          {core, core, core, core}, 0.7,
          [&](const Vector3& p) {
            double grey = 0.0;
            for (const Vector3& middle : middles_) {
              const double distance = (p - middle).norm();
              grey += blurred_ball(distance, radius, coat - core, 0.7) -
                      blurred_ball(distance, radius - 2.0, coat - core, 0.7);
            }
            return grey;
          },
          is_dark);
      SegmentationOptions options;
      options.dark = is_dark;
      EXPECT_FALSE(segmented(options).has_fringes);
      const std::vector<double> found = volumes(segmented(options));
      ASSERT_EQ(found.size(), 4U) << coat;
      for (const double volume : found) EXPECT_NEAR(volume, 1.0, 0.12) << coat;
    }
  }
}

// Layers of both kinds, told by their grey values; the volumes are those of the whole balls.
TEST_F(SegmentationOfFourBalls, ALayerAtTheSurfaceIsToldAndTheAdviceWorks) {
  constexpr double layer = 110.0;
  const auto write_core = [&](double core, double core_radius) {
    write_scan({layer, layer, layer, layer}, 0.8, [&](const Vector3& p) {
      double grey = 0.0;
      for (const Vector3& middle : middles_) {
        grey += blurred_ball((p - middle).norm(), core_radius, core - layer, 0.8);
      }
      return grey;
    });
  };
  // A pore; it leaves shells of 3 voxels.
  write_core(5.0, 5.0);
  const Segmentation pores = segmented();
  EXPECT_TRUE(holds(looks(pores), "near 15"));
  EXPECT_FALSE(holds(looks(pores), "noise"));
  ASSERT_EQ(pores.grains.size(), 4U);
  for (const double volume : volumes(pores)) EXPECT_NEAR(volume, 1.0, 0.03);
  // A dense core, or a film around it.
  write_core(190.0, 5.5);
  const Segmentation cores = segmented();
  ASSERT_EQ(cores.steps.size(), 1U) << looks(cores);
  EXPECT_TRUE(cores.steps[0].goes_on());
  EXPECT_NEAR(cores.steps[0].layer, 44.0 + layer, 10.0);
  EXPECT_NEAR(cores.steps[0].inside, 44.0 + 190.0, 10.0);
  EXPECT_TRUE(holds(looks(cores), "in two steps"));
  EXPECT_FALSE(holds(looks(cores), "several minerals"));
  SegmentationOptions options;
  options.threshold = 0.5 * (cores.steps[0].space + cores.steps[0].layer);
  const std::vector<double> whole = volumes(segmented(options));
  ASSERT_EQ(whole.size(), 4U);
  for (const double volume : whole) EXPECT_NEAR(volume, 1.0, 0.04);
  // A film that the blur nearly hides: one step by a blur of 1.9 voxels is as near as .01.
  write_scan({70, 70, 70, 70}, 1.2, [&](const Vector3& p) {
    double grey = 0.0;
    for (const Vector3& middle : middles_) {
      grey += blurred_ball((p - middle).norm(), radius - 2.5, 70.0, 1.2);
    }
    return grey;
  });
  const Segmentation films = segmented();
  ASSERT_EQ(films.steps.size(), 1U) << looks(films);
  EXPECT_TRUE(films.steps[0].goes_on());
  EXPECT_NEAR(films.steps[0].layer, 44.0 + 70.0, 12.0);
  EXPECT_TRUE(holds(looks(films), "in two steps"));
  // Plain balls have none.
  write_scan({layer, layer, layer, layer}, 0.8, nothing);
  EXPECT_TRUE(segmented().steps.empty());
}

TEST_F(SegmentationOfFourBalls, AnInclusionIsNotTheEdgeOfItsGrain) {
  // In one grain, from 5 and from 4 voxels below its surface on.
  for (const double core : {3.0, 4.0}) {
    write_scan({80, 80, 80, 80}, 0.8, [&](const Vector3& p) {
      return blurred_ball((p - Vector3(13.1, 13.4, 13.2)).norm(), core, 400, 0.8);
    });
    const std::vector<double> found = volumes(segmented());
    ASSERT_EQ(found.size(), 4U);
    // The core's blur makes a quarter of what is measured brighter; its own edge would take 60 %.
    for (const double volume : found) EXPECT_NEAR(volume, 1.0, 0.06) << core;
  }
}

TEST_F(SegmentationOfFourBalls, ABlurBeyondWhatIsCorrectedIsTold) {
  for (const double blur : {0.8, 1.4}) {
    write_scan({120, 120, 120, 120}, blur, nothing);
    EXPECT_EQ(looks(segmented()), "") << blur;
  }
  write_scan({120, 120, 120, 120}, 2.5, nothing);
  const std::string soft = looks(segmented());
  EXPECT_TRUE(holds(soft, "too small, smaller ones more"));
  EXPECT_TRUE(holds(soft, "% too small"));
}

/// As blurred_ball, exactly: the convolution of a ball and a Gaussian.
double exactly_blurred_ball(double distance, double radius, double grey, double blur) {
  const double near = (radius - distance) / (std::sqrt(2.0) * blur);
  const double far = (radius + distance) / (std::sqrt(2.0) * blur);
  return grey * (0.5 * (std::erf(near) + std::erf(far)) -
                 blur / (distance * std::sqrt(2.0 * pi)) *
                     (std::exp(-near * near) - std::exp(-far * far)));
}

// The shell that gives a grain its own grey value is below the blur. Within it the grain is nearer
// to the void, which made these balls 5 % too large, while the log said too small.
TEST_F(SegmentationOfFourBalls, ABlurMakesGrainsTooSmallAsTold) {
  constexpr double blur = 2.5;
  write_scan({0, 0, 0, 0}, blur, [&](const Vector3& p) {
    double grey = 0.0;
    for (const Vector3& middle : middles_) {
      grey += exactly_blurred_ball((p - middle).norm(), radius, 120.0, blur);
    }
    return grey;
  });
  const Segmentation found = segmented();
  // What is not corrected moves the surface by its variance over the radius.
  const double told = 3.0 * (blur * blur - 1.5 * 1.5) / (radius * radius);
  ASSERT_EQ(found.grains.size(), 4U);
  for (const double volume : volumes(found)) {
    EXPECT_LT(volume, 0.97);
    EXPECT_GT(volume, 1.0 - told);
  }
}

TEST_F(SegmentationOfFourBalls, TheWallOfAContainerIsNoGrainAndIsTold) {
  // Walls that touch all balls: a tube in air, a box at the border, and a plate below. They are as
  // bright as the balls, darker and brighter.
  const auto edge = [](double inwards, double thickness, double grey) {
    constexpr double width = 1.13;  // of the blur
    return grey * 0.25 * std::erfc(-inwards / width) * std::erfc((inwards - thickness) / width);
  };
  for (const double grey : {120.0, 60.0, 300.0}) {
    const auto tube = [&](const Vector3& p) {
      return edge(31.0 - std::hypot(p[0] - 26.9, p[1] - 27.0), 4.0, grey);
    };
    const auto box = [&](const Vector3& p) {
      return edge(std::min({p[0], p[1], 54.0 - p[0], 54.0 - p[1]}) + 4.0, 9.1, grey);
    };
    const auto plate = [&](const Vector3& p) { return edge(p[2] - 1.3, 4.0, grey); };
    for (int kind = 0; kind < 3; ++kind) {
      SCOPED_TRACE(std::to_string(kind) + " of " + std::to_string(grey));
      if (kind == 0) write_scan({120, 120, 120, 120}, 0.8, tube, false, 6);
      if (kind == 1) write_scan({120, 120, 120, 120}, 0.8, box);
      if (kind == 2) write_scan({120, 120, 120, 120}, 0.8, plate);
      const Segmentation found = segmented();
      EXPECT_TRUE(holds(looks(found), "taken for a container"));
      ASSERT_EQ(found.grains.size(), 4U);
      EXPECT_GT(found.wall, 0U);
      // Where a ball touches, a cap of 1.8 voxels, 3.5 %, may go with the wall; one of a box
      // touches two.
      for (const double volume : volumes(found)) EXPECT_NEAR(volume, 1.0, 0.07);
    }
  }
  // The same in a mask. Without a wall there is none, not even of one hollow grain.
  for (Label& label : made_.labels) label = label > 100 ? 255 : 0;
  write_made();
  EXPECT_TRUE(segmented().is_mask);
  EXPECT_EQ(segmented().grains.size(), 4U);
  EXPECT_GT(segmented().wall, 0U);
  made_ = MadeVolume({40, 38, 36});
  const std::int64_t ball = made_.fill_ball(200, {20, 19, 18}, 15.0);
  made_.fill_ball(0, {20, 19, 18}, 11.0);
  made_.fill_ball(200, {20, 19, 18}, 3.0);
  write_made();
  EXPECT_EQ(segmented().wall, 0U);
  ASSERT_EQ(segmented().grains.size(), 1U);
  EXPECT_EQ(segmented().grains[0].voxels, static_cast<std::uint64_t>(ball));
}

// After smoothing, the void has 3 values and the grains too: no phases.
TEST_F(SegmentationOfTwoMinerals, LittleNoiseMakesNoPhases) {
  for (const bool is_dark : {false, true}) {
    make({is_dark ? Label{110} : void_grey, is_dark ? void_grey : Label{110},
          is_dark ? void_grey : Label{110}},
         0);
    std::mt19937 random(12);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (Label& value : made_.labels) {
      value = static_cast<Label>(std::lround(static_cast<double>(value) + noise(random)));
    }
    write_made();
    SegmentationOptions options;
    options.dark = is_dark;
    const Segmentation found = segmented(options);
    EXPECT_EQ(found.grains.size(), 8U);
    EXPECT_NEAR(found.threshold, 75.0, 2.0);
    EXPECT_EQ(found.peaks.size(), 2U);
  }
}

TEST(Film, IsARiseBetweenTwoPhasesAndIsTold) {
  // Between phases at 40 and 180; blur has the fewest in the middle.
  std::vector<std::uint64_t> counts(256, 0);
  for (int k = 30; k < 190; ++k) {
    counts[static_cast<std::size_t>(k)] = static_cast<std::uint64_t>(300 + (k - 110) * (k - 110));
  }
  EXPECT_FALSE(film_between(counts, 110.0, 140.0));
  for (std::size_t k = 84; k < 96; ++k) counts[k] += 6000;
  const std::optional<double> film = film_between(counts, 110.0, 140.0);
  ASSERT_TRUE(film);
  EXPECT_NEAR(*film, 90.0, 7.0) << "a window";

  Segmentation found;
  found.voxels = 10000;
  found.material = 1500;
  found.peaks = {40.0, 180.0};
  found.steps = {{40.0, 110.0, 180.0, 0.0, 1.0}};
  bool is_told = false;
  for (const Sentence& doubt : doubts_of(found)) {
    const std::string text = doubt.text();
    is_told = is_told || (text.find("a layer less than 2 voxels thick") != std::string::npos &&
                          text.find("--threshold 75;") != std::string::npos &&
                          text.find("--threshold 145.") != std::string::npos);
  }
  EXPECT_TRUE(is_told);
}

TEST_F(SegmentationOfTwoMinerals, TakesBothNamesThePeaksAndFollowsItsAdvice) {
  make({void_grey, quartz, 220});
  write_made();
  const Segmentation found = segmented();
  EXPECT_EQ(found.grains.size(), 8U);
  ASSERT_EQ(found.peaks.size(), 3U);
  // Noise of 12 of any value; the smoothed peak is as wide as a fraction of it.
  EXPECT_NEAR(found.peaks[0], 40.0, 4.0);
  EXPECT_NEAR(found.peaks[1], 110.0, 4.0);
  EXPECT_NEAR(found.peaks[2], 220.0, 4.0);
  EXPECT_NEAR(found.threshold, 75.0, 4.0);
  EXPECT_TRUE(holds(looks(found), "3 peaks"));
  EXPECT_TRUE(holds(looks(found), "--phases 1"));
  SegmentationOptions options;
  options.phases = 1;
  const Segmentation bright = segmented(options);
  EXPECT_EQ(bright.grains.size(), 2U);
  EXPECT_NEAR(bright.threshold, 165.0, 5.0);
  options.phases = 3;
  EXPECT_ERROR(segmented(options), InvalidInput);
  options.phases = 2;
  options.threshold = 100.0;
  EXPECT_ERROR(segmented(options), InvalidInput);
}

TEST_F(SegmentationOfTwoMinerals, DenseCoresAndStrongNoiseLeaveTheGrains) {
  // Cores ten times as bright as the grains, of any share of the voxels.
  for (const double core : {1.0, 3.0}) {
    make({1000, 3000, 3000}, 200);
    for (const double x : {15.0, 40.0}) {
      for (const double y : {14.0, 38.0}) {
        for (const double z : {10.0, 29.0}) made_.fill_ball(30000, {x, y, z}, core);
      }
    }
    write_made();
    const Segmentation found = segmented();
    EXPECT_EQ(found.grains.size(), 8U) << core;
    EXPECT_NEAR(found.threshold, 2000.0, 50.0) << core;
    // A phase of more than a thousandth of the voxels is named, and can be had alone.
    EXPECT_EQ(found.peaks.size(), core > 2.0 ? 3U : 2U);
    if (core < 2.0) continue;
    EXPECT_TRUE(holds(looks(found), "--phases 1"));
    SegmentationOptions options;
    options.phases = 1;
    options.smallest = 50;
    EXPECT_EQ(segmented(options).grains.size(), 8U);
    EXPECT_LT(segmented(options).material, found.material / 5);
  }
  // Noise as strong as .8 of the contrast.
  make({1000, 1100, 1100}, 139);
  write_made();
  const Segmentation noisy = segmented();
  EXPECT_EQ(noisy.grains.size(), 8U);
  EXPECT_NEAR(noisy.threshold, 1050.0, 5.0);
  EXPECT_TRUE(holds(looks(noisy), "The noise is strong"));
}

TEST_F(SegmentationOfTwoMinerals, MasksOfPhasesAreNoLabels) {
  for (const Label step : {1U, 127U}) {
    make({0, step, 2 * step}, 0);
    write_made();
    const Segmentation found = segmented();
    EXPECT_EQ(found.grains.size(), 8U) << step;
    EXPECT_FALSE(holds(looks(found), "labels already"));
    EXPECT_TRUE(holds(looks(found), "--phases 1"));
    SegmentationOptions options;
    options.phases = 1;
    EXPECT_EQ(segmented(options).grains.size(), 2U) << step;
  }
}

TEST_F(SegmentationOfAFile, MasksAreTakenAsTheyAre) {
  made_ = MadeVolume({60, 26, 26});
  std::int64_t grains = 0;
  for (const double x : {14.0, 45.0}) {
    made_.fill_ball(1, {x, 13, 13}, 9.5);
    grains += made_.fill_ball(2, {x, 13, 13}, 6.5);
  }
  write_made();
  SegmentationOptions options;
  for (const bool is_dark : {false, true}) {
    options.dark = is_dark;
    options.phases = 1;
    const Segmentation found = segmented(options);
    EXPECT_TRUE(found.is_mask);
    EXPECT_EQ(found.grains.size(), 2U);
    EXPECT_EQ(found.material, static_cast<std::uint64_t>(grains));
    options.phases = 3;
    EXPECT_TRUE(holds(test::refusal(ErrorCode::InvalidInput, [&] { segmented(options); }),
                      "at most 2 can be material"));
    for (Label& label : made_.labels) label = 2 - label;
    write_made();
  }
  options = {};
  options.threshold = 2.0;
  EXPECT_EQ(segmented(options).material, static_cast<std::uint64_t>(grains));
  // NaN is the void, also at the border.
  std::vector<float> values;
  for (const Label label : made_.labels) {
    values.push_back(label == 2 ? 1.0F : std::numeric_limits<float>::quiet_NaN());
  }
  write("a.nrrd", "NRRD0004\ntype: float\ndimension: 3\nencoding: raw\nendian: little\nsizes: " +
                      made_.size_text() + "\n\n" + raw_bytes(values));
  const Segmentation found = segmented();
  EXPECT_EQ(found.grains.size(), 2U);
  EXPECT_EQ(found.material, static_cast<std::uint64_t>(grains));
  EXPECT_EQ(found.not_scanned, 0U);
}

TEST_F(SegmentationOfAFile, BlurAndMedianDoNotMoveCurvedSurfaces) {
  // The share of a voxel in the body, from four points along each axis; then a Gaussian blur of .8
  // voxels and noise of 5 % of the contrast.
  const Vector3 middle(15.7, 16.1, 15.9);
  for (const Vector3& axes : {Vector3(8, 8, 8), Vector3(10, 10, 10), Vector3(13, 10, 8)}) {
    made_ = MadeVolume({32, 32, 32});
    std::vector<double> share;
    double inside = 0.0;
    for (std::size_t k = 0; k < made_.labels.size(); ++k) {
      const Vector3 voxel(static_cast<double>(k % 32), static_cast<double>(k / 32 % 32),
                          static_cast<double>(k / 1024));
      int in = 0;
      for (int point = 0; point < 64; ++point) {
        const Vector3 at =
            voxel + Vector3(point % 4 + 0.5, point / 4 % 4 + 0.5, point / 16 + 0.5) / 4.0;
        if ((at - middle).cwiseQuotient(axes).squaredNorm() <= 1.0) ++in;
      }
      share.push_back(in / 64.0);
      inside += in / 64.0;
    }
    for (const std::size_t step : {1U, 32U, 1024U}) {
      const std::vector<double> before = share;
      for (std::size_t k = 3 * step; k + 3 * step < share.size(); ++k) {
        double sum = 0.0;
        double weights = 0.0;
        for (int away = -3; away <= 3; ++away) {
          const double weight = std::exp(-0.5 * away * away / 0.64);
          sum += weight * before[k + step * static_cast<std::size_t>(away + 3) - 3 * step];
          weights += weight;
        }
        share[k] = sum / weights;
      }
    }
    std::mt19937 random(7);
    for (std::size_t k = 0; k < share.size(); ++k) {
      // Uniform noise of the same variance.
      const double noise = 8.66 * (2.0 * random() / 4294967295.0 - 1.0);
      made_.labels[k] = static_cast<Label>(std::lround(100.0 + 100.0 * share[k] + noise));
    }
    write_made();
    const Segmentation found = segmented();
    ASSERT_EQ(found.grains.size(), 1U);
    // The median of 27 voxels and the blur take 6 % of the ball of 8 voxels radius.
    EXPECT_NEAR(static_cast<double>(found.material) / inside, 1.0, 0.02) << axes.transpose();
  }
}

TEST_F(SegmentationOfTwoMinerals, DarkGrainsAreFoundAsTheAdviceSays) {
  make({200, 90, 90});
  write_made();
  EXPECT_TRUE(holds(looks(segmented()), "--dark"));
  SegmentationOptions options;
  options.dark = true;
  const Segmentation found = segmented(options);
  EXPECT_EQ(found.grains.size(), 8U);
  EXPECT_EQ(looks(found), "");
  make({200, 90, 30});
  write_made();
  EXPECT_TRUE(holds(looks(segmented()), "If the grains are darker than the rest, give --dark"));
  EXPECT_EQ(segmented(options).grains.size(), 8U);
  options.phases = 1;
  EXPECT_EQ(segmented(options).grains.size(), 2U);
  // Also if a circle was scanned only.
  options.phases.reset();
  make({200, 90, 90});
  for (int z = 0; z < 40; ++z) {
    for (int y = 0; y < 52; ++y) {
      for (int x = 0; x < 56; ++x) {
        if (std::hypot(x - 27.5, y - 25.5) > 26.9) made_.at(x, y, z) = 0;
      }
    }
  }
  write_made();
  EXPECT_GT(segmented().not_scanned, 0U);
  EXPECT_TRUE(holds(looks(segmented()), "--dark"));
  EXPECT_EQ(segmented(options).grains.size(), 8U);
  // The wrong way round is told too.
  make({40, 110, 110});
  write_made();
  options.phases.reset();
  EXPECT_TRUE(holds(looks(segmented(options)), "leave --dark out"));
}

TEST_F(SegmentationOfTwoMinerals, WhatWasNotScannedIsLeftOutAndCutsGrains) {
  make({void_grey, quartz, quartz});
  // A cylinder along z. Its wall cuts no ball, or all of them.
  const auto outside_of = [&](double radius, const auto& put) {
    for (int z = 0; z < 40; ++z) {
      for (int y = 0; y < 52; ++y) {
        for (int x = 0; x < 56; ++x) {
          const double dx = x - 27.5;
          const double dy = y - 25.5;
          if (dx * dx + dy * dy > radius * radius)
            put(static_cast<std::size_t>((z * 52 + y) * 56 + x));
        }
      }
    }
  };
  const std::string header =
      "\ndimension: 3\nencoding: raw\nendian: little\nsizes: " + made_.size_text() + "\n\n";
  for (const float fill : {0.0F, -3024.0F, 1000.0F, std::numeric_limits<float>::quiet_NaN()}) {
    for (const bool cuts : {false, true}) {
      std::vector<float> values(made_.labels.begin(), made_.labels.end());
      outside_of(cuts ? 19.0 : 26.9, [&](std::size_t k) { values[k] = fill; });
      write("a.nrrd", "NRRD0004\ntype: float" + header + raw_bytes(values));
      const Segmentation found = segmented();
      EXPECT_EQ(found.cut, cuts ? 8U : 0U) << fill;
      EXPECT_EQ(found.grains.size(), cuts ? 0U : 8U) << fill;
      EXPECT_GT(found.not_scanned, 0U) << fill;
      EXPECT_NEAR(found.threshold, 75.0, 4.0) << fill;
      EXPECT_EQ(segmentation_lines(found)[0],
                cuts ? "8 grains, 8 of them at the border" : "8 grains, 0 of them at the border")
          << fill;
      EXPECT_EQ(looks(found).find("may be cut") != std::string::npos, cuts) << looks(found);
    }
  }
  // Slices that were added at both ends of the cylinder, and around a box.
  for (const bool is_box : {false, true}) {
    std::vector<float> values(made_.labels.begin(), made_.labels.end());
    outside_of(is_box ? 99.0 : 26.9, [&](std::size_t k) { values[k] = 0.0F; });
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t x = k % 56;
      const std::size_t z = k / (56 * 52);
      const bool is_beside = is_box && (x < 2 || x > 53 || k / 56 % 52 < 2 || k / 56 % 52 > 49);
      if (z < 1 || z > 38 || is_beside) values[k] = 0.0F;
    }
    write("a.nrrd", "NRRD0004\ntype: float" + header + raw_bytes(values));
    const Segmentation found = segmented();
    EXPECT_EQ(found.grains.size() + static_cast<std::size_t>(found.cut), 8U) << is_box;
    EXPECT_NEAR(found.threshold, 75.0, 4.0) << is_box;
  }
  // A box in a constant void is a grain, also with a pore.
  for (const float pore : {255.0F, 90.0F}) {
    std::vector<float> values(made_.labels.size(), 0.0F);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t x = k % 56;
      const std::size_t y = k / 56 % 52;
      const std::size_t z = k / (56 * 52);
      const auto is_in = [&](std::size_t margin) {
        return x > 9 + margin && x < 40 - margin && y > 11 + margin && y < 35 - margin &&
               z > 7 + margin && z < 30 - margin;
      };
      if (is_in(0)) values[k] = is_in(8) ? pore : 255.0F;
    }
    write("a.nrrd", "NRRD0004\ntype: float" + header + raw_bytes(values));
    const Segmentation found = segmented();
    EXPECT_EQ(found.grains.size(), 1U) << pore;
    EXPECT_EQ(found.cut, 0) << pore;
  }
  // One side, and slices at the end, from the middles of two and four balls on.
  for (const bool is_side : {false, true}) {
    std::vector<float> values(made_.labels.begin(), made_.labels.end());
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (is_side ? k % 56 >= 40 : k / (56 * 52) >= 29) values[k] = 0.0F;
    }
    write("a.nrrd", "NRRD0004\ntype: float" + header + raw_bytes(values));
    const Segmentation found = segmented();
    EXPECT_EQ(found.cut, 4U) << is_side;
    EXPECT_EQ(found.grains.size(), 4U) << is_side;
    EXPECT_NEAR(found.threshold, 75.0, 4.0) << is_side;
  }
  // The space between grains of a made volume is constant too, and was scanned.
  made_ = MadeVolume({40, 30, 30});
  made_.fill(7, [](const Vector3&) { return true; });
  made_.fill_ball(200, {12, 15, 15}, 8.0);
  made_.fill_ball(190, {29, 15, 15}, 7.0);
  write_made();
  EXPECT_EQ(segmented().not_scanned, 0U);
  EXPECT_EQ(segmented().grains.size(), 2U);
}

TEST_F(SegmentationOfAFile, DoubtsOneGrainAndDarkGrains) {
  made_ = MadeVolume({40, 30, 26});
  const auto fill = [&](Label grain, Label rest) {
    made_.fill(rest, [](const Vector3&) { return true; });
    made_.fill_ball(grain, {12, 14, 13}, 8.0);
    made_.fill_ball(grain, {29, 14, 13}, 7.0);
    made_.at(0, 0, 0) = rest + 1;  // not a mask
    write_made();
  };
  const auto has = [&](const Segmentation& found, const char* words) {
    for (const std::string& line : segmentation_lines(found)) {
      if (line.rfind("Look: ", 0) == 0 && line.find(words) != std::string::npos) return true;
    }
    return false;
  };
  fill(200, 50);
  EXPECT_FALSE(has(segmented(), "One grain"));
  EXPECT_FALSE(has(segmented(), "darker"));
  SegmentationOptions low;
  low.threshold = 20.0;
  EXPECT_TRUE(has(segmented(low), "One grain has 100 %"));
  EXPECT_FALSE(has(segmented(low), "darker"));
  fill(50, 200);
  EXPECT_TRUE(has(segmented(), "darker than the rest"));
}

// Dark grains in a packing touch each other and the border, so that they are no holes.
TEST_F(SegmentationOfAFile, DoubtsThatTheSpaceBetweenDarkGrainsIsGrains) {
  double of_grains = 0.0;
  double of_space = 0.0;
  for (const bool are_dark : {false, true}) {
    made_ = MadeVolume({50, 48, 46});
    made_.fill(are_dark ? 200 : 50, [](const Vector3&) { return true; });
    for (int k = 0; k < 64; ++k) {
      // No symmetry: each ball a little beside its place.
      const Vector3 place(k % 4, k / 4 % 4, k / 16);
      const Vector3 beside(std::sin(k), std::sin(2.3 * k + 1.0), std::sin(3.1 * k + 2.0));
      made_.fill_ball(are_dark ? 50 : 200, 6.0 * Vector3::Ones() + 12.0 * place + beside, 5.6);
    }
    made_.at(0, 0, 0) = are_dark ? 201 : 51;  // not a mask
    write_made();
    const auto is_told = [&](const SegmentationOptions& options) {
      const Segmentation found = segmented(options);
      (options.dark == are_dark ? of_grains : of_space) = found.island_fraction;
      const std::vector<Sentence> doubts = doubts_of(found);
      return std::any_of(doubts.begin(), doubts.end(), [](const std::string& doubt) {
        return doubt.rfind("In slices the material has more holes than islands", 0) == 0;
      });
    };
    SegmentationOptions right;
    right.dark = are_dark;
    SegmentationOptions wrong;
    wrong.dark = !are_dark;
    EXPECT_FALSE(is_told(right)) << are_dark;
    EXPECT_TRUE(is_told(wrong)) << are_dark;
    EXPECT_GT(of_grains, 0.3);
    EXPECT_LT(of_space, -0.3);
  }
}

// Beam hardening darkens void and grains in the middle. Grains of two minerals are not that.
TEST_F(SegmentationOfAFile, DoubtsGrainsThatAreDarkerInTheMiddle) {
  const auto is_told = [&](double darkening, double other_mineral) {
    made_ = MadeVolume({60, 60, 40});
    std::mt19937_64 engine(test::announced(11));
    std::normal_distribution<double> noise(0.0, 4.0);
    made_.set([&](const Vector3& p) {
      // Balls in a lattice, every third of the other mineral.
      const Vector3 cell(std::floor(p.x() / 15.0), std::floor(p.y() / 15.0),
                         std::floor(p.z() / 13.4));
      const Vector3 middle = (cell + Vector3(0.5, 0.5, 0.5)).cwiseProduct(Vector3(15, 15, 13.4));
      const bool is_grain = (p - middle).norm() < 6.2;
      const bool is_other = static_cast<int>(cell.dot(Vector3(1, 2, 4))) % 3 == 0;
      const double grey = is_grain ? 160.0 + (is_other ? other_mineral : 0.0) : 60.0;
      const double off =
          ((p.x() - 30.0) * (p.x() - 30.0) + (p.y() - 30.0) * (p.y() - 30.0)) / 900.0;
      return 10.0 * (grey * (1.0 - darkening * std::max(0.0, 1.0 - off)) + noise(engine));
    });
    write_made();
    const std::vector<Sentence> doubts = doubts_of(segmented());
    return std::any_of(doubts.begin(), doubts.end(), [](const std::string& doubt) {
      return doubt.rfind("The space between the grains has grey values from", 0) == 0;
    });
  };
  EXPECT_FALSE(is_told(0.0, 0.0));
  EXPECT_FALSE(is_told(0.0, 50.0));
  EXPECT_FALSE(is_told(0.1, 0.0));
  EXPECT_TRUE(is_told(0.3, 0.0));
}

/// 64 balls of radius 5.6 in a box of 50 x 48 x 46, each a little beside its place in a lattice.
class SegmentationOfALattice : public SegmentationOfTwoMinerals {
 protected:
  void make_balls(double background, double grain, double lower_background, double noise = 3.0) {
    made_ = MadeVolume({50, 48, 46});
    std::mt19937_64 engine(test::announced(17));
    std::normal_distribution<double> noises(0.0, noise);
    made_.set([&](const Vector3& p) {
      double grey = p.z() < 23 ? lower_background : background;
      if (is_in_ball(p)) grey = grain;
      return std::max(0.0, 10.0 * (grey + noises(engine)));
    });
  }
  static bool is_in_ball(const Vector3& voxel) {
    for (int k = 0; k < 64; ++k) {
      const Vector3 place(k % 4, k / 4 % 4, k / 16);
      const Vector3 beside(std::sin(k), std::sin(2.3 * k + 1.0), std::sin(3.1 * k + 2.0));
      if ((voxel - 6.0 * Vector3::Ones() - 12.0 * place - beside).norm() < 5.0) return true;
    }
    return false;
  }
};

// Water in the lower half has a smooth surface and one thickness.
TEST_F(SegmentationOfALattice, WaterInHalfTheVolumeIsNoWallAndIsTold) {
  make_balls(60.0, 170.0, 110.0);
  write_made();
  const Segmentation found = segmented();
  EXPECT_EQ(found.wall, 0U);
  EXPECT_NE(looks(found), "");
  SegmentationOptions brightest;
  brightest.phases = 1;
  EXPECT_EQ(segmented(brightest).grains.size(), 64U);
}

// A resin is between its bubbles and the grains: its holes are no grains.
TEST_F(SegmentationOfALattice, AResinWithBubblesHasThreePeaksAndTheAdviceWorks) {
  make_balls(100.0, 190.0, 100.0);
  std::size_t bubbles = 0;
  for (int k = 0; k < 27; ++k) {
    const Vector3 place(k % 3, k / 3 % 3, k / 9);
    for (std::size_t voxel = 0; voxel < made_.labels.size(); ++voxel) {
      const Vector3 at(voxel % 50, voxel / 50 % 48, voxel / (50 * 48));
      if ((at - 12.0 * (place + Vector3::Ones())).norm() > 4.0 || is_in_ball(at)) continue;
      made_.labels[voxel] -= 600;
      ++bubbles;
    }
  }
  write_made();
  ASSERT_GT(bubbles, 4000U);
  const std::string told = looks(segmented());
  EXPECT_TRUE(holds(told, "The material fills the volume"));
  EXPECT_TRUE(holds(told, "3 peaks, at "));
  EXPECT_TRUE(
      holds(told, "If only the brightest are grains, give their number, such as --phases 1"));
  SegmentationOptions brightest;
  brightest.phases = 1;
  EXPECT_EQ(segmented(brightest).grains.size(), 64U);
}

TEST_F(SegmentationOfALattice, LostSlicesAreToldAndTheAdviceWorks) {
  make_balls(60.0, 170.0, 60.0);
  const std::size_t slice = std::size_t{50} * 48;
  const auto place = [&](std::size_t z) {
    return made_.labels.begin() + static_cast<std::ptrdiff_t>(z * slice);
  };
  write_made();
  EXPECT_FALSE(holds(looks(segmented()), "one grey value"));
  for (const std::size_t z : {6, 7, 19}) std::fill(place(z), place(z + 1), Label{0});
  // At the end nothing goes on behind it.
  std::fill(place(45), place(46), Label{0});
  write_made();
  const Segmentation found = segmented();
  // Smoothing closes the gap of one slice.
  EXPECT_EQ(found.cutting_slices, (std::vector<std::size_t>{6, 7}));
  EXPECT_GT(found.grains.size(), 70U);
  const std::string told = looks(found);
  EXPECT_TRUE(holds(told, "2 slices have one grey value, so that grains end there"));
  EXPECT_TRUE(holds(told, ": 6, 7, counted from 0."));
  EXPECT_TRUE(holds(told, "scan[6] = scan[5]"));
  for (const std::size_t z : {6, 7}) std::copy(place(z - 1), place(z), place(z));
  write_made();
  EXPECT_EQ(segmented().grains.size(), 64U);
  EXPECT_FALSE(holds(looks(segmented()), "one grey value"));
  // A mask may have slices without a grain.
  for (Label& value : made_.labels) value = value > 1150 ? 1 : 0;
  for (const std::size_t z : {6, 7}) std::fill(place(z), place(z + 1), Label{0});
  write_made();
  EXPECT_TRUE(segmented().cutting_slices.empty());
}

// Pores that are open to the void leave necks between parts of a grain.
TEST_F(SegmentationOfAFile, PiecesOfPorousGrainsAreToldAndClosingThePoresWorks) {
  made_ = MadeVolume({58, 56, 54});
  made_.fill(600, [](const Vector3&) { return true; });
  for (int k = 0; k < 8; ++k) {
    made_.fill_ball(1700, 14.0 * Vector3::Ones() + 28.0 * Vector3(k % 2, k / 2 % 2, k / 4), 13.0);
  }
  std::mt19937_64 engine(test::announced(5));
  for (int k = 0; k < 700; ++k) {
    const Vector3 place(engine() % 58, engine() % 56, engine() % 54);
    made_.fill_ball(600, place, 2.3);
  }
  write_made();
  constexpr const char* told = "over a neck nearly as wide as themselves";
  const Segmentation pieces = segmented();
  EXPECT_GT(pieces.grains.size(), 16U);
  EXPECT_GT(pieces.wide_neck_fraction, 0.3);
  EXPECT_TRUE(holds(looks(pieces), told));
  // What scipy.ndimage.grey_closing does with a size of 5.
  for (const bool is_largest : {true, false}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      MadeVolume before = made_;
      for (std::int32_t z = 0; z < 54; ++z) {
        for (std::int32_t y = 0; y < 56; ++y) {
          for (std::int32_t x = 0; x < 58; ++x) {
            for (std::int32_t away = -2; away <= 2; ++away) {
              std::array<std::int32_t, 3> at = {x, y, z};
              at[axis] = std::clamp(at[axis] + away, 0, before.counts[axis] - 1);
              const Label other = before.at(at[0], at[1], at[2]);
              Label& value = made_.at(x, y, z);
              value = is_largest ? std::max(value, other) : std::min(value, other);
            }
          }
        }
      }
    }
  }
  write_made();
  EXPECT_EQ(segmented().grains.size(), 8U);
  EXPECT_FALSE(holds(looks(segmented()), told));
}

// The far side of a bar of 7 voxels is no darker inside.
TEST_F(SegmentationOfAFile, ThinGrainsHaveNoLayer) {
  made_ = MadeVolume({60, 50, 48});
  std::mt19937_64 engine(test::announced(3));
  std::normal_distribution<double> noise(0.0, 60.0);
  const auto part = [](double away, double half) {
    return 0.5 * std::erfc((std::abs(away) - half) / (std::sqrt(2.0) * 0.8));
  };
  made_.set([&](const Vector3& p) {
    const double across = part(std::fmod(p.y(), 12.3) - 6.1, 3.5);
    const double up = part(std::fmod(p.z(), 11.8) - 5.9, 3.5);
    const double grey = 600.0 + 1100.0 * part(p.x() - 30.2, 24.0) * across * up;
    return std::max(0.0, grey + noise(engine));
  });
  write_made();
  const Segmentation found = segmented();
  EXPECT_EQ(found.grains.size(), 16U);
  EXPECT_TRUE(found.steps.empty());
}

// Phase contrast adds the second derivative across the surface, and a filter that sharpens nearly
// so. It is 0 at the surface. The level half way to the rim makes a ball 5 % too small.
TEST_F(SegmentationOfAFile, FringesAreNoLayerAndAreTold) {
  constexpr double radius = 12.5;
  for (const bool is_dark : {false, true}) {
    made_ = MadeVolume({58, 56, 54});
    std::mt19937_64 engine(test::announced(8));
    std::normal_distribution<double> noise(0.0, 8.0);
    made_.set([&](const Vector3& p) {
      double grey = 100.0 + noise(engine);
      for (int k = 0; k < 8; ++k) {
        const Vector3 middle(14.3 + 29 * (k % 2), 14.1 + 28 * (k / 2 % 2), 13.6 + 27 * (k / 4));
        const double depth = radius - (p - middle).norm();
        const double rim = depth / 1.7;
        grey += 55.0 * std::erfc(-depth / (std::sqrt(2.0) * 0.8)) +
                38.0 * rim * std::exp(0.5 - 0.5 * rim * rim);
      }
      return is_dark ? 1000.0 - grey : grey;
    });
    write_made();
    SegmentationOptions options;
    options.dark = is_dark;
    const Segmentation found = segmented(options);
    EXPECT_TRUE(found.has_fringes);
    ASSERT_EQ(found.grains.size(), 8U);
    const double volume = 4.0 / 3.0 * pi * radius * radius * radius;
    for (const LabelExtent& grain : found.grains) {
      EXPECT_NEAR(static_cast<double>(grain.voxels) / volume, 1.0, 0.03);
    }
    EXPECT_TRUE(holds(looks(found), "Look: Grains have a rim at their surface"));
  }
}

TEST_F(SegmentationOfAFile, NecksAreMeasuredInTheSmallerGrainsRadius) {
  // Balls of radius 9 and 7 whose surfaces cross in a circle of radius 5.6, .8 of 7.
  const double radius = 5.6;
  const double apart = std::sqrt(81.0 - radius * radius) + std::sqrt(49.0 - radius * radius);
  made_ = MadeVolume({60, 30, 28});
  made_.fill_ball(1, {14.3, 14.6, 13.8}, 9.0);
  made_.fill_ball(1, {14.3 + apart, 14.6, 13.8}, 7.0);
  made_.fill_ball(1, {50.2, 14.1, 13.9}, 6.0);
  write_made();
  SegmentationOptions everywhere;
  everywhere.separate = 1.0;
  EXPECT_EQ(segmented(everywhere).grains.size(), 3U);
  // One of three: the larger one has no larger neighbour.
  EXPECT_NEAR(segmented(everywhere).wide_neck_fraction, 1.0 / 3.0, 1e-15);
  SegmentationOptions joined;
  joined.separate = 0.6;
  EXPECT_EQ(segmented(joined).grains.size(), 2U);
  EXPECT_EQ(segmented(joined).wide_neck_fraction, 0.0);
  // Small grains do not count.
  everywhere.smallest = 1000;
  EXPECT_NEAR(segmented(everywhere).wide_neck_fraction, 1.0 / 2.0, 1e-15);
}

TEST_F(SegmentationOfAFile, IslandsAreThoseOfSlices) {
  // Boxes by themselves are an island of each of their slices, along each axis.
  made_ = MadeVolume({40, 30, 26});
  made_.fill_box(1, {3, 2, 4}, {12, 9, 15});
  made_.fill_box(1, {20, 5, 3}, {31, 19, 12});
  write_made();
  EXPECT_EQ(segmented().grains.size(), 2U);
  EXPECT_EQ(segmented().island_fraction, 1.0);
  // A tube is a ring in the slices across it, an island with a hole. Of the 16 slices along it, 8
  // meet its hole and have two islands.
  made_ = MadeVolume({40, 30, 26});
  made_.fill_box(1, {10, 5, 3}, {30, 21, 19});
  made_.fill_box(0, {10, 9, 7}, {30, 17, 15});
  write_made();
  const Segmentation tube = segmented();
  double slices = 0.0;
  for (const LabelExtent& grain : tube.grains) {
    for (std::size_t axis = 0; axis < 3; ++axis) slices += grain.end[axis] - grain.begin[axis];
  }
  EXPECT_NEAR(tube.island_fraction * slices, 2.0 * (8 + 2 * 8), 1e-9);
}

// A rising background, as of drift or beam hardening, makes peaks of its own and grains too large.
TEST_F(SegmentationOfAFile, DoubtsABackgroundThatIsNotEven) {
  const auto doubts = [&](Label rise, bool is_dark = false) {
    made_ = MadeVolume({48, 30, 26});
    std::mt19937_64 engine(test::announced(7));
    std::normal_distribution<double> noise(0.0, 4.0);
    made_.set([&](const Vector3& p) {
      const bool is_grain =
          (p - Vector3(12, 14, 13)).norm() < 8.0 || (p - Vector3(33, 16, 12)).norm() < 8.0;
      const double grey = (is_grain ? 1600.0 : 600.0) + 10.0 * noise(engine) + rise * p.x() / 48.0;
      return is_dark ? 3000.0 - grey : grey;
    });
    write_made();
    SegmentationOptions options;
    options.dark = is_dark;
    std::string text;
    for (const std::string& line : segmentation_lines(segmented(options))) text += line + "\n";
    return text;
  };
  EXPECT_FALSE(holds(doubts(0), "grey values from"));
  EXPECT_FALSE(holds(doubts(150), "grey values from"));
  const std::string text = doubts(600);
  EXPECT_TRUE(holds(text, "white_tophat"));
  EXPECT_FALSE(holds(text, "as of several minerals"));
  // A tenth of the void is darker than this in the first and the last quarter, 600 + 600 / 40 and
  // 450 more; of dark grains a tenth is brighter.
  for (const bool is_dark : {false, true}) {
    const std::string told = doubts(600, is_dark);
    const std::string words = "has grey values from ";
    ASSERT_TRUE(holds(told, words));
    double least = 0.0, largest = 0.0;
    ASSERT_EQ(
        std::sscanf(told.c_str() + told.find(words) + words.size(), "%lf to %lf", &least, &largest),
        2);
    EXPECT_NEAR(least, is_dark ? 1935.0 : 615.0, 40.0);
    EXPECT_NEAR(largest, is_dark ? 2385.0 : 1065.0, 40.0);
  }
}

// In much void most neighbours are equal without noise, as in labels, but the edges are of a scan.
TEST_F(SegmentationOfAFile, TakesAScanWithoutNoiseForNoLabels) {
  made_ = MadeVolume({60, 48, 44});
  made_.set([&](const Vector3& p) {
    const double depth = 8.0 - (p - Vector3(25, 22, 20)).norm();
    const double grey = 200.0 + 100.0 * std::erf(depth / std::sqrt(2.0));
    return std::lround(grey);
  });
  write_made();
  SegmentationOptions options;
  for (const bool is_known : {false, true}) {
    if (is_known) options.threshold = 200.0;
    for (const std::string& line : segmentation_lines(segmented(options))) {
      EXPECT_FALSE(holds(line, "labels already")) << is_known;
    }
  }
}

// A window of grey values that is too narrow moves the middle of the peaks, and so all surfaces.
TEST_F(SegmentationOfAFile, DoubtsGreyValuesThatWereCutOff) {
  // Void at 100 and grains at 300, with a blur of 1 voxel, between the values of the window.
  const auto doubts = [&](double least, double largest, double noise, bool is_dark) {
    made_ = MadeVolume({48, 30, 26});
    std::mt19937_64 engine(test::announced(8));
    std::normal_distribution<double> deviation(0.0, 1.0);
    made_.set([&](const Vector3& p) {
      const double depth =
          std::max(8.0 - (p - Vector3(12, 14, 13)).norm(), 8.0 - (p - Vector3(33, 16, 12)).norm());
      const double inside = 0.5 + 0.5 * std::erf(depth / std::sqrt(2.0));
      const double grey =
          100.0 + 200.0 * (is_dark ? 1.0 - inside : inside) + noise * deviation(engine);
      return std::lround(std::clamp(grey, least, largest));
    });
    write_made();
    SegmentationOptions options;
    options.dark = is_dark;
    std::string text;
    for (const std::string& line : segmentation_lines(segmented(options))) text += line + "\n";
    return text;
  };
  for (const double noise : {0.0, 2.0, 10.0}) {
    const std::string clean = doubts(0.0, 500.0, noise, false);
    for (const char* words : {"cut off", "labels already"}) {
      EXPECT_FALSE(holds(clean, words)) << noise;
    }
  }
  EXPECT_FALSE(holds(doubts(95.0, 305.0, 10.0, false), "cut off"));
  for (const bool is_dark : {false, true}) {
    const std::string low = doubts(150.0, 500.0, 10.0, is_dark);
    EXPECT_TRUE(holds(low, "have one value, the least of the scan. "));
    EXPECT_TRUE(holds(low, is_dark ? "come out too large" : "come out too small"));
    const std::string high = doubts(0.0, 250.0, 10.0, is_dark);
    EXPECT_TRUE(holds(high, "have one value, the largest of the scan. "));
    EXPECT_TRUE(holds(high, is_dark ? "come out too small" : "come out too large"));
    // Of both ends, with and without noise that reaches into the window.
    const std::string both = doubts(113.0, 287.0, 10.0, is_dark);
    EXPECT_TRUE(holds(both, "the least of the scan, and"));
    EXPECT_TRUE(holds(both, "too small or too large"));
    const std::string sharp = doubts(118.0, 282.0, 2.0, is_dark);
    EXPECT_TRUE(holds(sharp, "the least of the scan, and"));
    EXPECT_FALSE(holds(sharp, "labels already"));
  }
}

// All sides are flat, and the block crosses the volume as a container does.
TEST_F(SegmentationOfAFile, TakesNoSpaceBetweenDarkGrainsForAWall) {
  made_ = MadeVolume({40, 24, 24});
  made_.fill(200, [](const Vector3&) { return true; });
  made_.fill_ball(50, {12, 12, 12}, 7.0);
  made_.fill_ball(50, {28, 12, 12}, 7.0);
  made_.at(0, 0, 0) = 201;  // not a mask
  write_made();
  EXPECT_EQ(segmented().wall, 0U);
}

TEST_F(SegmentationOfAFile, DoubtsLabels) {
  made_ = MadeVolume({30, 20, 20});
  made_.fill_ball(1, {9, 10, 10}, 6.0);
  made_.fill_ball(2, {22, 10, 10}, 6.0);
  write_made();
  SegmentationOptions options;
  options.threshold = 1.0;
  const std::vector<std::string> lines = segmentation_lines(segmented(options));
  EXPECT_TRUE(holds(lines.back(), "may be labels already"));
}

TEST_F(SegmentationOfAFile, RefusesWhatItCannotDo) {
  made_ = MadeVolume({9, 8, 7});
  std::fill(made_.labels.begin(), made_.labels.end(), 7);
  write_made();
  EXPECT_TRUE(holds(test::refusal(ErrorCode::InvalidInput, [&] { segmented(); }), "are 7"));
  made_.fill_box(9, {2, 2, 2}, {6, 6, 6});
  made_.fill_box(8, {2, 2, 2}, {4, 4, 4});
  write_made();
  const std::unique_ptr<LabelVolume> labels = open_volume(path("a.nrrd"));
  EXPECT_TRUE(holds(
      test::refusal(ErrorCode::InvalidInput, [&] { separated(*labels, 7, 0.75, Execution(1)); }),
      "8 and 9"));
  SegmentationOptions options;
  options.separate = 0.0;
  EXPECT_ERROR(segmented(options), InvalidInput);
  options = {};
  options.smallest = 0;
  EXPECT_ERROR(segmented(options), InvalidInput);
  EXPECT_ERROR(check_label_file("labels.tif"), InvalidInput);
}

/// Voxels that touch by faces and have one label, numbered from 1; void stays 0.
std::vector<std::uint32_t> pieces_of(const std::vector<std::uint32_t>& labels,
                                     const VoxelCounts& counts) {
  std::vector<std::uint32_t> pieces(labels.size(), 0);
  std::uint32_t count = 0;
  for (std::size_t first = 0; first < labels.size(); ++first) {
    if (labels[first] == 0 || pieces[first] != 0) continue;
    std::vector<std::size_t> next = {first};
    pieces[first] = ++count;
    while (!next.empty()) {
      const std::size_t k = next.back();
      next.pop_back();
      for_each_neighbour(k, counts, [&](std::size_t other) {
        if (pieces[other] != 0 || labels[other] != labels[k]) return;
        pieces[other] = count;
        next.push_back(other);
      });
    }
  }
  return pieces;
}

// A ball can be the deepest around voxels that its grain reaches only through another grain.
TEST(StraightenedWalls, LeaveEachGrainInOnePiece) {
  constexpr int size = 36;
  std::mt19937_64 numbers(test::announced(57));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int packing = 0; packing < 4; ++packing) {
    SCOPED_TRACE(packing);
    MadeVolume made({size, size, size});
    for (std::uint32_t grain = 1; grain <= 14; ++grain) {
      const Vector3 middle = size * Vector3(unit(numbers), unit(numbers), unit(numbers));
      const Vector3 axes =
          Vector3::Constant(2.0) + 7.0 * Vector3(unit(numbers), unit(numbers), unit(numbers));
      const Eigen::Matrix3d turn = test::random_rotation(numbers());
      made.fill(grain, [&](const Vector3& p) {
        return (turn * (p - middle)).cwiseQuotient(axes).norm() < 1.0;
      });
    }
    std::vector<std::uint8_t> mask;
    for (const std::uint32_t label : made.labels) mask.push_back(label == 0 ? 0 : 1);
    const VoxelCounts counts = {size, size, size};
    const Basins basins = basins_of(mask, counts, {1.0, 1.0, 1.0}, 0.5, Execution(1));
    std::vector<std::uint32_t> labels = pieces_of(made.labels, counts);
    const std::uint32_t before = *std::max_element(labels.begin(), labels.end());
    straighten_walls(labels, basins.distances, counts, Vector3::Constant(1.0 / basins.step),
                     Execution(1));
    const std::vector<std::uint32_t> pieces = pieces_of(labels, counts);
    std::map<std::uint32_t, std::uint32_t> piece_of;
    for (std::size_t k = 0; k < labels.size(); ++k) {
      EXPECT_EQ(labels[k] == 0, made.labels[k] == 0);
      if (labels[k] == 0) continue;
      ASSERT_EQ(piece_of.emplace(labels[k], pieces[k]).first->second, pieces[k]) << labels[k];
    }
    EXPECT_LE(piece_of.size(), before);
  }
}

TEST_F(SegmentationOfAPacking, IsStopped) {
  pack({1.5, 1.5, 1.5}, false);
  const auto run = [&](const Execution& execution) {
    segment(*open_volume(path("a.nrrd")), {}, execution);
  };
  std::map<std::string, int> reports;
  run(Execution(1, [&](double /*fraction*/, const std::string& stage) {
    ++reports[stage];
    return true;
  }));
  for (const char* stage : {"Smoothing grey values", "Filling holes", "Measuring distances",
                            "Separating grains", "Counting labels"}) {
    SCOPED_TRACE(stage);
    // The last may come from a destructor, which must not throw.
    test::expect_to_be_stopped(run, stage, reports[stage]);
  }
}

TEST(ItkFilters, MedianIsThatOfTheNeighboursInEveryBlock) {
  const FilterCounts counts = {4, 5, 27};
  std::vector<std::uint16_t> grey;
  for (std::size_t k = 0; k < 540; ++k) grey.push_back(static_cast<std::uint16_t>(k * k % 65521));
  const std::vector<std::uint16_t> smoothed = median_of(grey, counts, Execution(1));
  for (int z = 0; z < counts[2]; ++z) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int x = 0; x < counts[0]; ++x) {
        std::vector<std::uint16_t> around;
        for (int k = 0; k < 27; ++k) {
          const int a = std::clamp(x + k % 3 - 1, 0, counts[0] - 1);
          const int b = std::clamp(y + k / 3 % 3 - 1, 0, counts[1] - 1);
          const int c = std::clamp(z + k / 9 - 1, 0, counts[2] - 1);
          around.push_back(grey[static_cast<std::size_t>((c * counts[1] + b) * counts[0] + a)]);
        }
        std::sort(around.begin(), around.end());
        EXPECT_EQ(smoothed[static_cast<std::size_t>((z * counts[1] + y) * counts[0] + x)],
                  around[13]);
      }
    }
  }
}

TEST(ItkFilters, BasinsFollowLengths) {
  // Two boxes of 12 x 12 x 16 and a neck of 6 across, where a voxel is 4 along z: in voxels all are
  // as thin as the neck.
  const FilterCounts counts = {38, 16, 6};
  std::vector<std::uint8_t> mask;
  for (int z = 0; z < counts[2]; ++z) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int x = 0; x < counts[0]; ++x) {
        const bool is_box = (x >= 2 && x < 14) || (x >= 24 && x < 36);
        const bool is_neck = x >= 14 && x < 24 && y >= 5 && y < 11;
        const bool is_in = z >= 1 && z < 5 && y >= 2 && y < 14;
        mask.push_back(is_in && (is_box || is_neck) ? 1 : 0);
      }
    }
  }
  const auto basins = [&](const std::array<double, 3>& spacing) {
    const std::vector<std::uint32_t> found =
        basins_of(mask, counts, spacing, 1.5, Execution(1)).labels;
    for (std::size_t k = 0; k < mask.size(); ++k) EXPECT_EQ(found[k] != 0, mask[k] != 0) << k;
    return *std::max_element(found.begin(), found.end());
  };
  EXPECT_EQ(basins({1.0, 1.0, 4.0}), 2U);
  EXPECT_EQ(basins({1.0, 1.0, 1.0}), 1U);
  mask.assign(mask.size(), 1);
  EXPECT_EQ(basins({1.0, 1.0, 1.0}), 1U);
  mask.assign(mask.size(), 0);
  EXPECT_EQ(basins({1.0, 1.0, 1.0}), 0U);
}

TEST(ItkFilters, HolesHangTogetherByFaces) {
  const FilterCounts counts = {6, 5, 4};
  std::vector<std::uint8_t> mask(120, 1);
  const auto at = [&](int x, int y, int z) -> std::uint8_t& {
    return mask[static_cast<std::size_t>((z * counts[1] + y) * counts[0] + x)];
  };
  at(2, 2, 2) = 0;
  at(1, 1, 2) = 0;  // by an edge
  at(0, 1, 2) = 0;  // open to the border
  fill_holes(mask, counts, Execution(1));
  EXPECT_EQ(at(2, 2, 2), 1);
  EXPECT_EQ(at(1, 1, 2), 0);
  EXPECT_EQ(std::count(mask.begin(), mask.end(), 0), 2);
}

TEST(GreyThreshold, LiesBetweenThePeaksWhateverTheirShares) {
  const auto bell = [](double x, double middle, double width) {
    const double d = (x - middle) / width;
    return std::exp(-0.5 * d * d) / width;
  };
  for (const double share : {0.05, 0.3, 0.7, 0.95}) {
    for (const double scale : {1.0, 40.0}) {
      std::vector<std::uint64_t> counts;
      for (int k = 0; k < static_cast<int>(300 * scale); ++k) {
        const double density =
            (1.0 - share) * bell(k / scale, 60.0, 5.0) + share * bell(k / scale, 160.0, 12.0);
        counts.push_back(static_cast<std::uint64_t>(1e6 * density));
      }
      EXPECT_NEAR(level_between_peaks(counts), 110.0 * scale, 1.0 * scale)
          << share << " at " << scale;
    }
  }
  std::vector<std::uint64_t> two(12, 0);
  two[3] = 5;
  two[10] = 1;
  EXPECT_EQ(otsu_level(two), 10.0);
  EXPECT_EQ(level_between_peaks(two), 6.5);
}

class LabelWriter : public test::VolumeFolder {};

TEST_F(LabelWriter, WritesWhatIsReadAgain) {
  for (const bool is_long : {false, true}) {
    made_.labels[17] = is_long ? 70000 : 65535;
    write("a.nrrd",
          "NRRD0004\ntype: uint32\ndimension: 3\nencoding: raw\nendian: little\nsizes: " +
              made_.size_text() +
              "\nspace dimension: 3\nspace directions: (0.5,0.1,0) (-0.2,1.25,0) (0,0.3,2)\n"
              "space origin: (7,-3,0.125)\nspace units: \"mm\" \"mm\" \"mm\"\n\n" +
              made_.bytes<std::uint32_t>());
    const std::unique_ptr<LabelVolume> volume = open_volume(path("a.nrrd"));
    for (const std::string name : {"b.nrrd", "b.mha"}) {
      write_labels(path(name), *volume, is_long ? 70000 : 65535, Execution(1));
      expect_made(name);
      const VolumeGeometry found = geometry(name);
      EXPECT_LT((found.axes - volume->geometry().axes).norm(), 1e-14) << name;
      EXPECT_LT((found.corner - volume->geometry().corner).norm(), 1e-14) << name;
      EXPECT_EQ(found.unit, "mm") << name;
      EXPECT_TRUE(found.has_size);
    }
    write_labels(path("c.nrrd"), *volume, 126, Execution(1));
    std::vector<Label> wanted = made_.labels;
    for (Label& label : wanted) label = label > 126 ? 0 : label;
    EXPECT_EQ(labels_of("c.nrrd"), wanted);
  }
}

TEST_F(SegmentationOfAFile, ShowsSlicesWithOutlines) {
  // A long box, a cube and a speck; voxels three times as long along z.
  made_ = MadeVolume({40, 30, 20});
  for (Label& label : made_.labels) label = 10;
  made_.fill_box(90, {4, 10, 6}, {24, 20, 14});
  made_.fill_box(90, {27, 8, 5}, {37, 22, 15});
  made_.fill_box(90, {19, 24, 9}, {23, 28, 13});
  made_.at(0, 0, 0) = 11;  // not a mask
  write_made("1 1 3");
  const Segmentation found = segmented();
  ASSERT_EQ(found.grains.size(), 2U);
  const std::unique_ptr<LabelVolume> scan = open_volume(path("a.nrrd"));
  const std::vector<Picture> pictures = outlined_slices(*scan, found, Execution(1)).pictures;
  ASSERT_EQ(pictures.size(), 3U);
  // 60 along z is the longest, 600 pixels.
  const std::vector<std::array<int, 2>> sizes = {{400, 300}, {400, 600}, {300, 600}};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(pictures[k].width, sizes[k][0]);
    EXPECT_EQ(pictures[k].height, sizes[k][1]);
    ASSERT_EQ(pictures[k].pixels.size(), static_cast<std::size_t>(sizes[k][0]) * sizes[k][1]);
  }
  const auto colour = [&](std::size_t picture, double x, double y) {
    const Picture& of = pictures[picture];
    return of.pixels[static_cast<std::size_t>(y) * of.width + static_cast<std::size_t>(x)];
  };
  const auto is_grey = [](const Colour& c) { return c[0] == c[1] && c[1] == c[2]; };
  EXPECT_EQ(colour(0, 100, 150), (Colour{255, 255, 255})) << "in the box";
  EXPECT_EQ(colour(0, 250, 50), (Colour{0, 0, 0}));
  EXPECT_FALSE(is_grey(colour(0, 41, 150))) << "its outline";
  EXPECT_FALSE(is_grey(colour(0, 150, 198)));
  EXPECT_TRUE(is_grey(colour(0, 36, 150)));
  EXPECT_NE(colour(0, 41, 150), colour(0, 271, 150)) << "another grain's";
  const Colour red = colour(0, 205, 255);
  EXPECT_GT(red[0], 2 * red[1]) << "dropped";
  // Across y, z runs down; across x, y runs to the right.
  EXPECT_EQ(colour(1, 100, 300), (Colour{255, 255, 255}));
  EXPECT_FALSE(is_grey(colour(1, 100, 181)));
  EXPECT_TRUE(is_grey(colour(1, 100, 176)));
  EXPECT_FALSE(is_grey(colour(2, 81, 300))) << "the cube, which has more boundary";
  EXPECT_TRUE(is_grey(colour(2, 76, 300)));

  const std::string page = segmentation_html(*scan, found, {"a.nrrd", ""}, Execution(1));
  for (const char* part : {"Grains of a scan: 2", "a.nrrd", "0 of them at the border", ", mm",
                           "smallest", "data:image/png"}) {
    EXPECT_TRUE(holds(page, part));
  }
}

}  // namespace
}  // namespace wscvt
