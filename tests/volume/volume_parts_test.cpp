// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/volume_parts.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <vector>

#include "support/seeds.h"
#include "support/volume_folder.h"
#include "toolbox/volume/label_grains.h"

namespace wscvt {
namespace {

using test::MadeVolume;

/// The part of each voxel, numbered in the order in which they begin, by flooding; 0: background.
std::vector<Label> flooded(const MadeVolume& volume, Label background) {
  std::vector<Label> parts(volume.labels.size(), 0);
  const auto& n = volume.counts;
  Label next = 0;
  for (std::size_t start = 0; start < parts.size(); ++start) {
    if (volume.labels[start] == background || parts[start] != 0) continue;
    ++next;
    std::vector<std::size_t> open = {start};
    parts[start] = next;
    while (!open.empty()) {
      const std::size_t here = open.back();
      open.pop_back();
      const int x = static_cast<int>(here) % n[0];
      const int y = static_cast<int>(here) / n[0] % n[1];
      const int z = static_cast<int>(here) / (n[0] * n[1]);
      const int steps[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
      for (const auto& step : steps) {
        const int a = x + step[0];
        const int b = y + step[1];
        const int c = z + step[2];
        if (a < 0 || b < 0 || c < 0 || a >= n[0] || b >= n[1] || c >= n[2]) continue;
        const auto there = static_cast<std::size_t>((c * n[1] + b) * n[0] + a);
        if (parts[there] != 0 || volume.labels[there] != volume.labels[start]) continue;
        parts[there] = next;
        open.push_back(there);
      }
    }
  }
  return parts;
}

class VolumeParts : public test::VolumeFolder {
 protected:
  void write_made() const { write("a.nrrd", test::nrrd(made_, "spacings: 1 1 1\n")); }
  /// Labels 0 to `most` with runs, so that parts are long and meet late.
  void make_random(const std::array<int, 3>& counts, unsigned most, std::mt19937& random) {
    made_ = MadeVolume(counts);
    for (std::size_t k = 0; k < made_.labels.size(); ++k) {
      const bool goes_on = k > 0 && random() % 3 != 0;
      made_.labels[k] = goes_on ? made_.labels[k - 1] : static_cast<Label>(random() % (most + 1));
    }
  }
};

TEST_F(VolumeParts, AreThoseOfAFlood) {
  std::mt19937 random(static_cast<unsigned>(test::announced(20261125)));
  const std::vector<std::array<int, 3>> all = {{9, 7, 5}, {2, 2, 2}, {17, 3, 4}, {5, 20, 2}};
  for (int round = 0; round < 60; ++round) {
    make_random(all[static_cast<std::size_t>(round) % all.size()], 1 + round % 3U, random);
    write_made();
    const Label background = round % 5 == 0 ? 1 : 0;
    const std::vector<Label> wanted = flooded(made_, background);
    const std::unique_ptr<LabelVolume> parts =
        parts_of(open_volume(path("a.nrrd")), background, Execution(1));
    // Left in the middle, and begun again.
    for (int row = 0; row < 3; ++row) parts->next_row();
    EXPECT_EQ(all_of(*parts), wanted) << "round " << round;

    // The census counts them, slice by slice.
    const std::unique_ptr<LabelVolume> volume = open_volume(path("a.nrrd"));
    std::map<Label, std::map<Label, std::uint64_t>> sizes;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (wanted[k] != 0) ++sizes[made_.labels[k]][wanted[k]];
    }
    const std::vector<LabelExtent> labels = label_census(*volume, background, Execution(1));
    ASSERT_EQ(labels.size(), sizes.size());
    for (const LabelExtent& label : labels) {
      std::uint64_t voxels = 0;
      std::uint64_t largest = 0;
      for (const auto& [part, count] : sizes[label.label]) {
        voxels += count;
        largest = std::max(largest, count);
      }
      EXPECT_EQ(label.voxels, voxels);
      EXPECT_EQ(label.pieces, sizes[label.label].size()) << "round " << round;
      EXPECT_EQ(label.largest_piece, largest) << "round " << round;
    }
  }
}

TEST_F(VolumeParts, BecomeGrains) {
  made_ = MadeVolume({40, 30, 30});
  const std::int64_t ball = made_.fill_ball(255, {10, 10, 15}, 7.0);
  const std::int64_t other = made_.fill_ball(255, {30, 18, 12}, 6.0);
  const std::int64_t speck = made_.fill_box(255, {20, 25, 20}, {22, 27, 22});
  write_made();
  VolumeOptions options;
  const LabelGrains whole(path("a.nrrd"), options, Execution(1));
  ASSERT_EQ(whole.labels().size(), 1U);
  EXPECT_EQ(whole.labels()[0].pieces, 3U);
  const double all = static_cast<double>(ball + other + speck);
  EXPECT_NEAR(whole.left_out(), static_cast<double>(other + speck) / all, 1e-12);
  EXPECT_NEAR(whole.labels()[0].left_out(), whole.left_out(), 1e-15);
  options.smallest = ball + 1;
  EXPECT_EQ(LabelGrains(path("a.nrrd"), options, Execution(1)).left_out(), 1.0);

  options = {};
  options.parts = true;
  LabelGrains parts(path("a.nrrd"), options, Execution(1));
  ASSERT_EQ(parts.labels().size(), 3U);
  EXPECT_EQ(parts.taken().size(), 2U);
  EXPECT_EQ(parts.left_out(), 0.0);
  EXPECT_EQ(static_cast<std::int64_t>(parts.labels()[0].voxels), other) << "it begins first";
  parts.want({0, 1});
  EXPECT_EQ(parts.read(0, Execution(1)).enclosed, other);
  EXPECT_EQ(parts.read(1, Execution(1)).enclosed, ball);
}

}  // namespace
}  // namespace wscvt
