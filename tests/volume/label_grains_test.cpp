// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/label_grains.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;
using test::MadeVolume;

class LabelGrainsOfAFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (fs::temp_directory_path() / ("wscvt_grains_" + std::to_string(getpid()))).string();
    path_ += ".nrrd";
  }
  void TearDown() override { fs::remove(path_); }

  void write(const MadeVolume& volume) const {
    test::write_bytes(
        path_,
        "NRRD0004\ntype: uint32\nendian: little\ndimension: 3\nspacings: 0.5 0.5 2\nsizes: " +
            volume.size_text() + "\nencoding: raw\n\n" + volume.bytes<std::uint32_t>());
  }

  std::string path_;
};

// Noise tells grey values from labels, small grains do not.
TEST_F(LabelGrainsOfAFile, RefusesGreyValuesButNoSmallGrains) {
  std::mt19937 random(static_cast<unsigned>(test::announced(20261127)));
  for (const std::array<int, 3>& counts :
       {std::array<int, 3>{30, 20, 20}, std::array<int, 3>{90, 70, 40}}) {
    MadeVolume scan(counts);
    scan.fill_ball(80, {12, 9, 9}, 7.0);
    for (Label& voxel : scan.labels) voxel += 60 + random() % 4;
    write(scan);
    for (const bool parts : {false, true}) {
      VolumeOptions options;
      options.parts = parts;
      const std::string sentence = test::refusal(
          ErrorCode::InvalidInput, [&] { LabelGrains(path_, options, Execution(1)); });
      EXPECT_TRUE(holds(sentence, "look like grey values"));
      EXPECT_TRUE(holds(sentence, "wscvt segment"));
    }
    // Touching grains of 3 voxels, and plates of one.
    MadeVolume grains(counts);
    MadeVolume plates(counts);
    for (std::size_t k = 0; k < grains.labels.size(); ++k) {
      const int x = static_cast<int>(k) % counts[0];
      const int y = static_cast<int>(k) / counts[0] % counts[1];
      const int z = static_cast<int>(k) / (counts[0] * counts[1]);
      grains.labels[k] = static_cast<Label>(1 + x / 3 + 100 * (y / 3) + 10000 * (z / 3));
      plates.labels[k] = static_cast<Label>(1 + x);
    }
    write(grains);
    EXPECT_GT(LabelGrains(path_, {}, Execution(1)).labels().size(), 100U);
    write(plates);
    EXPECT_EQ(LabelGrains(path_, {}, Execution(1)).labels().size(),
              static_cast<std::size_t>(counts[0]));
  }
}

TEST_F(LabelGrainsOfAFile, SortsLabelsOutAndReadsThemInTheOrderOfTheirLastSlices) {
  MadeVolume volume({60, 40, 50});
  const std::int64_t ball = volume.fill_ball(70000, {15, 15, 30}, 9.0);
  const std::int64_t other = volume.fill_ball(3, {40, 20, 15}, 8.0);
  volume.fill_box(5, {50, 30, 20}, {58, 38, 28});  // in two pieces
  volume.fill_box(5, {50, 5, 42}, {54, 9, 46});
  volume.fill_ball(9, {57, 20, 40}, 6.0);           // at the border
  volume.fill_box(11, {20, 30, 10}, {23, 33, 13});  // too small
  write(volume);
  VolumeOptions options;
  LabelGrains grains(path_, options, Execution(1));
  ASSERT_EQ(grains.labels().size(), 5U);
  std::vector<LabelState> states;
  for (const LabelExtent& label : grains.labels()) states.push_back(grains.state(label));
  EXPECT_EQ(states,
            (std::vector<LabelState>{LabelState::Taken, LabelState::Taken, LabelState::AtTheBorder,
                                     LabelState::TooSmall, LabelState::Taken}));
  EXPECT_EQ(grains.taken(), (std::vector<std::size_t>{0, 4, 1}));
  EXPECT_EQ(static_cast<std::int64_t>(grains.labels()[0].voxels), other);
  EXPECT_EQ(grains.labels()[0].begin, (VoxelCounts{32, 12, 7}));
  EXPECT_EQ(grains.labels()[0].end, (VoxelCounts{48, 28, 23}));

  grains.want({0, 1, 2});
  const LabelGrain first = grains.read(0, Execution(1));
  EXPECT_EQ(first.enclosed, other);
  EXPECT_TRUE(warnings_of(first).empty());
  const LabelGrain second = grains.read(1, Execution(1));
  const ShapeDescriptors shape = describe_shape(second.mesh, Execution(1));
  EXPECT_NEAR(shape.volume, 0.5 * static_cast<double>(ball), 1e-9 * shape.volume);
  EXPECT_LT((shape.centroid - Vector3(7.25, 7.25, 59.0)).norm(), 0.01);
  const LabelGrain third = grains.read(2, Execution(1));
  EXPECT_EQ(third.pieces, 2U);
  EXPECT_EQ(third.enclosed, 512);
  ASSERT_EQ(warnings_of(third).size(), 1U);
  EXPECT_TRUE(holds(warnings_of(third)[0], "2 pieces"));
  EXPECT_TRUE(holds(warnings_of(third)[0], "11.1 %"));

  options.at_border = true;
  options.smallest = 20;
  options.background = 3;
  // What lies between them, 0, is a label then.
  EXPECT_EQ(LabelGrains(path_, options, Execution(1)).taken().size(), 5U);
  // As a table.
  const std::string row = label_row("a.nrrd", grains, grains.labels()[1], {&third, "5.ply", ""});
  EXPECT_EQ(
      row,
      "a.nrrd/5,5,,in 2 pieces,,576,288,,24.75,2.25,39,28.75,18.75,91,2,0.11111111111111116,256," +
          std::to_string(third.mesh.points.size()) + "," +
          std::to_string(third.mesh.triangles.size()) + ",5.ply\r\n");
}

TEST_F(LabelGrainsOfAFile, TakesTheBackgroundThatOtherProgramsWrite) {
  // Two boxes, labels 0 and 7, in a background that is no label.
  const auto write_as = [&](const char* type, auto background, auto one) {
    using Value = decltype(background);
    std::vector<Value> values;
    for (int k = 0; k < 20 * 9 * 8; ++k) {
      const bool is_in = k / 20 % 9 > 1 && k / 20 % 9 < 7 && k / 180 > 1 && k / 180 < 6;
      const bool is_first = k % 20 > 1 && k % 20 < 8;
      const bool is_second = k % 20 > 10 && k % 20 < 16;
      values.push_back(!is_in || (!is_first && !is_second) ? background
                       : is_first                          ? Value{0}
                                                           : one);
    }
    test::write_bytes(path_,
                      std::string("NRRD0004\ntype: ") + type +
                          "\nendian: little\ndimension: 3\nsizes: 20 9 8\nencoding: raw\n\n" +
                          std::string(reinterpret_cast<const char*>(values.data()),
                                      values.size() * sizeof(Value)));
  };
  VolumeOptions options;
  const auto labels = [&] {
    std::vector<Label> found;
    const LabelGrains grains(path_, options, Execution(1));
    for (const LabelExtent& label : grains.labels()) {
      found.push_back(label.label);
    }
    return found;
  };
  const std::vector<Label> both = {0, 7};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  write_as("int32", std::int32_t{-1}, std::int32_t{7});
  const std::string sentence = test::refusal(ErrorCode::InputOutput, labels);
  EXPECT_TRUE(holds(sentence, "holds -1 at the voxel (0, 0, 0)"));
  EXPECT_TRUE(holds(sentence, "--background -1.")) << "the way that follows";
  EXPECT_FALSE(holds(sentence, "segment"));
  options.background = -1.0;
  EXPECT_EQ(labels(), both);
  write_as("float", -1.0F, 7.0F);
  EXPECT_EQ(labels(), both);
  options.background = 0.0;
  EXPECT_TRUE(holds(test::refusal(ErrorCode::InputOutput, labels), "--background -1."));
  write_as("float", std::numeric_limits<float>::quiet_NaN(), 7.0F);
  EXPECT_EQ(labels(), (std::vector<Label>{7})) << "NaN as well as 0 is background";
  options.background = nan;
  EXPECT_EQ(labels(), both);
  options.parts = true;
  EXPECT_EQ(labels(), (std::vector<Label>{1, 2}));
  options = {};
  write_as("double", 0.5, 7.0);
  EXPECT_TRUE(holds(test::refusal(ErrorCode::InputOutput, labels), "wscvt segment"));
}

TEST_F(LabelGrainsOfAFile, NumbersLargeLabelsAnewAndKeepsTheirNames) {
  for (const bool has_sign : {false, true}) {
    for (const bool is_parted : {false, true}) {
      std::vector<std::uint64_t> values(20 * 9 * 8, 0);
      const std::uint64_t large = has_sign ? 3000000000000U : 0xfffffffffffffff0U;
      for (std::size_t k = 3 * 180; k < 5 * 180; ++k) {
        if (k / 20 % 9 < 3 || k / 20 % 9 > 5) continue;
        if (k % 20 > 1 && k % 20 < 6) values[k] = large;
        if (k % 20 > 7 && k % 20 < 12) values[k] = 5;
        if (k % 20 > 13 && k % 20 < 18) values[k] = 10000000000U;
      }
      test::write_bytes(
          path_, std::string("NRRD0004\ntype: ") + (has_sign ? "int64" : "uint64") +
                     "\nendian: little\ndimension: 3\nsizes: 20 9 8\nencoding: "
                     "raw\n\n" +
                     std::string(reinterpret_cast<const char*>(values.data()), 8 * values.size()));
      VolumeOptions options;
      options.smallest = 1;
      options.parts = is_parted;
      const LabelGrains grains(path_, options, Execution(1));
      ASSERT_EQ(grains.labels().size(), 3U);
      if (is_parted) continue;
      EXPECT_EQ(grains.name_of(1), "5");
      EXPECT_EQ(grains.name_of(2), "10000000000");
      EXPECT_EQ(grains.name_of(3), std::to_string(large));
      EXPECT_EQ(grains.labels()[2].begin, (VoxelCounts{2, 3, 3}));
    }
  }
}

TEST_F(LabelGrainsOfAFile, TouchesTheBorderOnAnySide) {
  // A box in the middle of each of the six sides, and one that leaves a voxel free all round.
  MadeVolume volume({20, 22, 24});
  const std::vector<std::pair<Vector3, Vector3>> boxes = {
      {{0, 8, 8}, {3, 12, 12}},   {{17, 8, 8}, {20, 12, 12}}, {{8, 0, 8}, {12, 3, 12}},
      {{8, 19, 8}, {12, 22, 12}}, {{8, 8, 0}, {12, 12, 3}},   {{8, 8, 21}, {12, 12, 24}}};
  volume.fill_box(9, {1, 1, 1}, {19, 21, 23});
  std::uint32_t label = 0;
  for (const auto& [least, most] : boxes) volume.fill_box(++label, least, most);
  write(volume);
  VolumeOptions options;
  options.smallest = 48;  // which each of the six has, to the voxel
  const LabelGrains grains(path_, options, Execution(1));
  ASSERT_EQ(grains.labels().size(), 7U);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(grains.labels()[k].voxels, 48U);
    EXPECT_EQ(grains.state(grains.labels()[k]), LabelState::AtTheBorder) << k;
  }
  EXPECT_EQ(grains.state(grains.labels()[6]), LabelState::Taken);
  options.smallest = 49;
  const LabelGrains larger(path_, options, Execution(1));
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(larger.state(larger.labels()[k]), LabelState::TooSmall) << k;
  }
}

TEST_F(LabelGrainsOfAFile, SayWhyNoLabelIsTaken) {
  const std::tuple<int, int, const char*> cases[] = {
      {1, 0, "of 1 label 1 lies at the border. Give --at-border."},
      {0, 2, "of 2 labels 2 are too small. Give a smaller --smallest."},
      {2, 1,
       "of 3 labels 2 lie at the border and 1 is too small. Give --at-border or a smaller "
       "--smallest."}};
  for (const auto& [cut, small, text] : cases) {
    SCOPED_TRACE(text);
    MadeVolume volume({20, 22, 24});
    for (int k = 0; k < cut; ++k) {
      const double at = 8.0 * k;
      volume.fill_box(static_cast<Label>(5 + k), {0, at, 1}, {6, at + 6, 7});
    }
    for (int k = 0; k < small; ++k) {
      const double at = 8.0 + 4.0 * k;
      volume.fill_box(static_cast<Label>(15 + k), {10, at, 10}, {12, at + 2, 12});
    }
    write(volume);
    const LabelGrains grains(path_, {}, Execution(1));
    EXPECT_EQ(grains.none_taken().text(), "No label is a grain to mesh: " + std::string(text));
    ASSERT_EQ(grains.warnings().size(), 1U);
    EXPECT_EQ(grains.warnings().front(), grains.none_taken());
    EXPECT_EQ(grains.left_out(), 1.0);
    VolumeOptions advised;
    advised.at_border = cut > 0;
    advised.smallest = 8;
    const LabelGrains all(path_, advised, Execution(1));
    EXPECT_EQ(all.taken().size(), static_cast<std::size_t>(cut + small));
    EXPECT_TRUE(all.warnings().empty());
    EXPECT_TRUE(all.none_taken().empty());
    EXPECT_EQ(all.left_out(), 0.0);
  }
}

TEST_F(LabelGrainsOfAFile, RowsSayWhatBecameOfALabel) {
  MadeVolume volume({20, 20, 20});
  volume.fill_box(1, {2, 3, 4}, {12, 11, 9});
  volume.fill_box(0, {5, 5, 6}, {7, 7, 7});        // a pore
  volume.fill_box(2, {14, 14, 14}, {20, 16, 16});  // at the border
  volume.fill_box(3, {2, 2, 12}, {4, 4, 14});      // too small
  // Axes that are swapped, and turned against those of the file.
  test::write_bytes(
      path_,
      "NRRD0004\ntype: uint32\nendian: little\ndimension: 3\nspace directions: (0,-0.5,0) (-1,0,0) "
      "(0,0,2)\nspace origin: (0,0,0)\nspace units: \"um\" \"um\" \"um\"\nsizes: " +
          volume.size_text() + "\nencoding: raw\n\n" + volume.bytes<std::uint32_t>());
  VolumeOptions options;
  options.smallest = 9;
  LabelGrains grains(path_, options, Execution(1));
  const auto row = [&](std::size_t label, const LabelOutcome& outcome) {
    return label_row("v", grains, grains.labels()[label], outcome);
  };
  ASSERT_EQ(grains.labels().size(), 3U);
  grains.want({0});
  const LabelGrain one = grains.read(0, Execution(1));
  EXPECT_EQ(one.pore_voxels, 4);
  const std::string made =
      std::to_string(one.mesh.points.size()) + "," + std::to_string(one.mesh.triangles.size());
  // x of the volume goes down y of the file; the origin is the middle of the first voxel.
  EXPECT_EQ(
      row(0, {&one, "1.ply", ""}),
      "v/1,1,,written,,396,396,um,-10.5,-5.75,7,-2.5,-0.75,17,1,0,400," + made + ",1.ply\r\n");
  EXPECT_EQ(row(0, {nullptr, "", ""}).substr(0, 12), "v/1,1,,taken");
  EXPECT_EQ(row(0, {nullptr, "", "Broken."}).substr(0, 21), "v/1,1,,failed,Broken.");
  EXPECT_EQ(row(1, {nullptr, "", ""}).substr(0, 22), "v/2,2,,at the border,,");
  EXPECT_EQ(row(2, {nullptr, "", ""}).substr(0, 18), "v/3,3,,too small,,");
  // So small without its other pieces that no mesh was made of it.
  LabelGrain crumbs;
  crumbs.pieces = 2;
  EXPECT_EQ(row(0, {&crumbs, "", ""}).substr(0, 18), "v/1,1,,too small,,");
  EXPECT_EQ(row(0, {&crumbs, "", ""}).substr(row(0, {&crumbs, "", ""}).size() - 10),
            ",1,0,,,,\r\n");
  ASSERT_EQ(warnings_of(one).size(), 1U);
  EXPECT_TRUE(holds(warnings_of(one)[0], "pores of 1 % of its volume"));
}

TEST_F(LabelGrainsOfAFile, AreTheSameOnSeveralThreadsAndWhenSomeAreLeftOut) {
  MadeVolume volume({90, 90, 60});
  std::uint32_t label = 0;
  for (int k = 0; k < 27; ++k) {
    volume.fill_ball(++label, {15.0 + k % 3 * 30, 15.0 + k / 3 % 3 * 30, 11.0 + k / 9 * 18},
                     6.0 + 0.1 * (k * 7 % 11));
  }
  write(volume);
  LabelGrains grains(path_, VolumeOptions(), Execution(1));
  const std::size_t count = grains.taken().size();
  ASSERT_EQ(count, 27U);
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<LabelGrain> alone(count);
  grains.want(all);
  for (const std::size_t k : all) alone[k] = grains.read(k, Execution(1));

  std::vector<LabelGrain> together(count);
  grains.want(all);
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (std::size_t k = next++; k < count; k = next++) {
        together[k] = grains.read(k, Execution(1));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::size_t k : all) {
    EXPECT_EQ(together[k].mesh.points, alone[k].mesh.points);
    EXPECT_EQ(together[k].mesh.triangles, alone[k].mesh.triangles);
  }
  grains.want({4, 20});
  EXPECT_EQ(grains.read(4, Execution(1)).mesh.points, alone[4].mesh.points);
  EXPECT_EQ(grains.read(20, Execution(1)).mesh.points, alone[20].mesh.points);
}

TEST_F(LabelGrainsOfAFile, AreReadAgainWhereReadingOrWorkBrokeOff) {
  MadeVolume volume({40, 30, 60});
  volume.fill_ball(4, {12, 12, 12}, 8.0);
  volume.fill_ball(2, {27, 15, 25}, 7.0);  // reaches into the slices of both
  volume.fill_ball(9, {14, 14, 45}, 9.0);
  write(volume);
  LabelGrains grains(path_, {}, Execution(1));
  const std::vector<std::size_t> all = {0, 1, 2};
  grains.want(all);
  std::vector<IndexedMesh> meshes;
  for (const std::size_t grain : all) meshes.push_back(grains.read(grain, Execution(1)).mesh);
  const auto expect_mesh = [&](std::size_t grain) {
    const IndexedMesh mesh = grains.read(grain, Execution(1)).mesh;
    EXPECT_EQ(mesh.points, meshes[grain].points);
    EXPECT_EQ(mesh.triangles, meshes[grain].triangles);
  };
  // Each again, once it was taken, also out of turn.
  grains.want(all);
  for (const std::size_t grain : {0U, 0U, 1U, 0U, 2U, 1U, 2U}) expect_mesh(grain);
  // Broken off within the slices of two grains.
  for (int slices = 0; slices < 50; slices += 7) {
    grains.want(all);
    int told = 0;
    const Execution breaks(1, [&](double, const std::string&) { return told++ < slices; });
    EXPECT_ERROR(grains.read(2, breaks), Cancelled);
    for (const std::size_t grain : all) expect_mesh(grain);
  }
}

TEST_F(LabelGrainsOfAFile, AVolumeThatIsGoneIsNoFailureOfItsGrains) {
  MadeVolume volume({300, 300, 40});
  volume.fill_ball(4, {12, 12, 12}, 8.0);
  volume.fill_ball(9, {14, 14, 30}, 8.0);
  write(volume);
  LabelGrains grains(path_, {}, Execution(1));
  grains.want({0, 1});
  const std::uintmax_t size = fs::file_size(path_);
  fs::resize_file(path_, size / 2);
  EXPECT_THROW(grains.read(1, Execution(1)), MachineRefused);
  write(volume);
  EXPECT_FALSE(grains.read(0, Execution(1)).mesh.points.empty());
  EXPECT_FALSE(grains.read(1, Execution(1)).mesh.points.empty());
}

TEST_F(LabelGrainsOfAFile, RefusesGreyImagesEmptyOnesAndCancels) {
  MadeVolume grey({110, 100, 100});
  for (std::size_t k = 0; k < grey.labels.size(); ++k) grey.labels[k] = static_cast<Label>(k);
  write(grey);
  EXPECT_ERROR(LabelGrains(path_, VolumeOptions(), Execution(1)), InvalidInput);
  write(MadeVolume({4, 4, 4}));
  EXPECT_ERROR(LabelGrains(path_, VolumeOptions(), Execution(1)), InvalidInput);
  VolumeOptions wrong;
  wrong.smallest = 0;
  EXPECT_ERROR(LabelGrains(path_, wrong, Execution(1)), InvalidInput);
  MadeVolume one({20, 20, 20});
  one.fill_ball(1, {10, 10, 10}, 7.0);
  write(one);
  const Execution cancelled(1, [](double, const std::string&) { return false; });
  EXPECT_ERROR(LabelGrains(path_, VolumeOptions(), cancelled), Cancelled);
  LabelGrains grains(path_, VolumeOptions(), Execution(1));
  grains.want({0});
  EXPECT_ERROR(grains.read(0, cancelled), Cancelled);
}

}  // namespace
}  // namespace wscvt
