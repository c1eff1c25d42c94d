// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a segmentation whose numbers are made by hand, beside a plain computation.
#include "toolbox/volume/segmentation_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/holds.h"
#include "toolbox/volume/segmentation_steps.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"

namespace wscvt {
namespace {

using test::holds;

class EmptyVolume : public LabelVolume {
 public:
  explicit EmptyVolume(const VolumeGeometry& geometry)
      : LabelVolume(geometry), row_(static_cast<std::size_t>(geometry.counts[0]), 0) {}
  const std::vector<Label>& next_row() override { return row_; }
  void rewind() override {}

 private:
  std::vector<Label> row_;
};

/// 100,000 voxels with 7 grains, of which 2 are at the border; nothing to doubt.
Segmentation plain_segmentation() {
  Segmentation found;
  VolumeGeometry geometry;
  geometry.counts = {100, 50, 20};
  found.labels = std::make_unique<EmptyVolume>(geometry);
  found.voxels = 100000;
  for (Label k = 1; k <= 7; ++k) {
    LabelExtent grain;
    grain.label = k;
    grain.voxels = 1000 * k;
    grain.begin = {k < 3 ? 0 : 10, 10, 5};
    grain.end = {40, 40, 15};
    found.grains.push_back(grain);
    found.material += grain.voxels;
  }
  found.threshold = 120.0;
  found.peaks = {40.0, 200.0};
  found.island_fraction = 0.5;
  return found;
}

std::string doubts_text(const Segmentation& found) {
  std::string text;
  for (const Sentence& doubt : doubts_of(found)) text += doubt.text() + "\n";
  return text;
}

TEST(SegmentationDoubts, ThereAreNoneWithoutASign) {
  EXPECT_EQ(doubts_text(plain_segmentation()), "");
}

TEST(SegmentationDoubts, TheLossOfABlurIsThatOfTheMedianGrain) {
  // Surfaces of a ball of radius r move by s^2 / r, and the volume by three times this over r. The
  // median grain has 4,000 voxels.
  const double radius = std::cbrt(3.0 * 4000.0 / (4.0 * pi));
  Segmentation found = plain_segmentation();
  for (const double blur : {1.9, 2.4}) {
    found.blur = blur;
    const double loss = 3.0 * (blur * blur - largest_blur * largest_blur) / (radius * radius);
    const std::string text = doubts_text(found);
    const std::string share = std::to_string(std::lround(100.0 * loss)) + " % too small";
    EXPECT_EQ(holds(text, "edges of the grains are soft"), loss > 0.05) << text;
    EXPECT_EQ(holds(text, share), loss > 0.05) << text;
    EXPECT_EQ(holds(text, format_number(2.0 * radius, 3) + " voxels across"), loss > 0.05);
  }
  EXPECT_TRUE(holds(doubts_text(found), "too small"));
  found.blur = 1.5;  // all of it is corrected
  EXPECT_EQ(doubts_text(found), "");
}

TEST(SegmentationDoubts, AdviceOnTwoStepsIsHalfWayOnEach) {
  Segmentation found = plain_segmentation();
  found.steps = {{40.0, 100.0, 200.0, 3.0, 0.25}};
  std::string text = doubts_text(found);
  EXPECT_TRUE(holds(text, "about 3 voxels thick at the surface of 25 % of the grains is near 100"));
  EXPECT_TRUE(holds(text, "the void near 40 and the inside near 200"));
  EXPECT_TRUE(holds(text, "For grains with the layer, segment once more by --threshold 70;"));
  EXPECT_TRUE(holds(text, "for grains without it, by --threshold 150."));
  found.steps = {{40.0, 260.0, 200.0, 3.0, 0.25}};
  text = doubts_text(found);
  EXPECT_TRUE(holds(text, "Grains differ more from the void at their surface than inside"));
  EXPECT_TRUE(holds(text, "as by --threshold 150.")) << "half way from the void to the layer";
  found.steps[0].fraction = 0.05;
  EXPECT_EQ(doubts_text(found), "");
}

TEST(SegmentationDoubts, LayersOfMostGrainsAreNoMineralsOfFewAre) {
  Segmentation found = plain_segmentation();
  found.peaks = {40.0, 100.0, 200.0};
  const std::string minerals = "The grey values have 3 peaks, at 40, 100 and 200";
  EXPECT_TRUE(holds(doubts_text(found), minerals));
  found.steps = {{40.0, 100.0, 200.0, 3.0, 0.6}};
  EXPECT_FALSE(holds(doubts_text(found), minerals));
  found.steps[0].fraction = 0.4;
  EXPECT_TRUE(holds(doubts_text(found), minerals));
}

TEST(SegmentationDoubts, PartsThatAreLostAreOfTheMaterial) {
  Segmentation found = plain_segmentation();  // 28,000 voxels of material
  found.dropped = 1400;
  EXPECT_EQ(doubts_text(found), "");  // 5 %
  found.dropped = 2800;
  EXPECT_TRUE(holds(doubts_text(found), "10 % of the material is in parts that are too small"));
  found = plain_segmentation();
  found.grains.resize(3);
  found.grains[2].voxels = 22400;
  EXPECT_TRUE(holds(doubts_text(found), "One grain has 80 % of the material"));
  found.grains[2].voxels = 20000;
  EXPECT_FALSE(holds(doubts_text(found), "One grain has"));
}

TEST(SegmentationDoubts, CutOffValuesAreOfTheSideThatHasThem) {
  for (const bool is_dark : {false, true}) {
    for (const bool is_least : {false, true}) {
      Segmentation found = plain_segmentation();
      found.is_dark = is_dark;
      (is_least ? found.cut_off.least : found.cut_off.largest) = 0.3;
      const std::string text = doubts_text(found);
      const bool of_grains = is_dark == is_least;
      EXPECT_TRUE(holds(text, std::string("30 % of the voxels of the ") +
                                  (of_grains ? "grains" : "space between the grains") +
                                  " have one value, the " + (is_least ? "least" : "largest")))
          << text;
      // A void that is cut off is nearer to the grains than it was, so that half way is too.
      EXPECT_TRUE(holds(text, of_grains ? "come out too large" : "come out too small")) << text;
    }
  }
}

TEST(SegmentationDoubts, SlicesNoiseWallsAndVoidsHaveTheirNumbers) {
  Segmentation found = plain_segmentation();
  found.cutting_slices = {7, 8};
  EXPECT_TRUE(holds(doubts_text(found), "2 slices have one grey value"));
  EXPECT_TRUE(holds(doubts_text(found), "7, 8, counted from 0"));
  EXPECT_TRUE(holds(doubts_text(found), "scan[7] = scan[6]"));
  found = plain_segmentation();
  found.medians = 2;
  EXPECT_TRUE(holds(doubts_text(found), "the grey values were smoothed 2 times"));
  found = plain_segmentation();
  found.wall = 3000;
  found.cut = 2;
  EXPECT_TRUE(holds(doubts_text(found), "3 % of the volume, lies around the grains"));
  EXPECT_TRUE(holds(doubts_text(found), "2 grains touch voxels that were not scanned"));
  found = plain_segmentation();
  found.wide_neck_fraction = 0.25;
  EXPECT_TRUE(holds(doubts_text(found), "25 % of the grains touch a larger one"));
  found = plain_segmentation();
  found.darkest_space = 30.0;
  found.brightest_space = 130.0;
  EXPECT_TRUE(holds(doubts_text(found), "grey values from 30 to 130 in parts"));
  // Of 100,000 voxels 60,000 were scanned, and 52,000 are material.
  found = plain_segmentation();
  found.not_scanned = 40000;
  found.material = 52000;
  found.filled = 5200;
  EXPECT_TRUE(holds(doubts_text(found), "fills the volume, with holes of 10 % of it"));
}

TEST(SegmentationLines, AreThoseOfTheCounts) {
  Segmentation found = plain_segmentation();
  found.not_scanned = 20000;
  found.cut = 3;
  found.filled = 1400;
  found.dropped = 280;
  const std::vector<std::string> lines = segmentation_lines(found);
  ASSERT_GE(lines.size(), 4U);
  EXPECT_EQ(lines[0], "10 grains, 5 of them at the border") << "and those that are cut";
  EXPECT_TRUE(holds(lines[1], "20 % of the volume was not scanned"));
  EXPECT_EQ(lines[2],
            "Threshold 120; the material is 28 % of the volume, holes of 5 % of it were filled");
  EXPECT_TRUE(holds(lines[3], "1 % of the material is in parts that are too small"));
}

}  // namespace
}  // namespace wscvt
