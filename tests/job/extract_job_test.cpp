// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/extract_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "differing_calls.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/test_shapes.h"
#include "toolbox/job/label_source.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Row = test::CsvRow;
using test::holds;

IndexedMesh turned_inward(IndexedMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

class ExtractedGrains : public test::FileFolder {
 protected:
  /// In the order of the file: an open ball; a box with a pore; one of 1.5 % and one of 0.5 % of
  /// its volume.
  std::string write_bodies() const {
    IndexedMesh open = test::moved(test::sphere(1), 1.0, {20, 0, 0});
    open.triangles.pop_back();
    IndexedMesh mesh = test::joined(open, test::box(10.0, 5.0, 4.0));
    mesh =
        test::joined(mesh, turned_inward(test::moved(test::box(1.0, 2.0, 0.5), 1.0, {2, 1, -1})));
    mesh = test::joined(mesh, test::moved(test::sphere(1), 1.0, {0, 30, 7}));
    mesh = test::joined(mesh, test::moved(test::box(1.0, 1.0, 1.0), 1.0, {0, 0, 40}));
    write_mesh(mesh, path("bodies.ply"));
    return path("bodies.ply");
  }

  /// A grain of 6 x 5 x 4 voxels, one in two pieces, one that is too small, and one at the border.
  std::unique_ptr<LabelGrains> labels(const std::string& spacings) const {
    test::MadeVolume volume({24, 20, 16});
    volume.fill_box(7, {2, 2, 2}, {8, 7, 6});
    volume.fill_box(4, {10, 2, 2}, {15, 8, 6});
    volume.fill_box(4, {18, 2, 2}, {20, 4, 4});
    volume.fill_box(5, {2, 10, 8}, {4, 12, 10});
    volume.fill_box(9, {12, 12, 10}, {18, 18, 16});
    test::write_bytes(folder_ / "v.nrrd",
                      test::nrrd(volume, "spacings: " + spacings + "\nspace units: \"mm\"\n"));
    VolumeOptions options;
    options.smallest = 20;
    return std::make_unique<LabelGrains>(path("v.nrrd"), options, Execution(1));
  }
};

TEST_F(ExtractedGrains, AreTheClosedBodiesThatAreLargeEnough) {
  const std::string mesh = write_bodies();
  EXPECT_EQ(BodyGrains(mesh, 0.0, Execution(1)).size(), 3U);
  EXPECT_EQ(BodyGrains(mesh, 100.0, Execution(1)).size(), 1U);
  BodyGrains grains(mesh, 1.0, Execution(1));
  ASSERT_EQ(grains.size(), 2U);
  EXPECT_EQ(grains.name(0), mesh + "/2");
  EXPECT_EQ(grains.name(1), mesh + "/3");
  EXPECT_EQ(grains.volumes(), 1U);
  // 79 faces of the open one, 24 of the box with its pore, 80 and 12 of the others.
  EXPECT_NEAR(grains.left_out(), 79.0 / (79.0 + 24.0 + 80.0 + 12.0), 1e-12);
  ASSERT_EQ(grains.warnings().size(), 1U);
  EXPECT_EQ(grains.warnings()[0].rfind("Open surfaces have 40.5 % of the faces.", 0), 0U)
      << grains.warnings()[0];

  const auto census = test::csv_rows(grains.census([](const std::string& grain) -> MadeGrain {
    return {grain.substr(grain.size() - 1) + ".stl"};
  }),
                                     "body");
  ASSERT_EQ(census.size(), 4U);
  const std::vector<std::string> states = {"open", "written", "written", "too small"};
  const std::vector<std::string> files = {"", "2.stl", "3.stl", ""};
  for (std::size_t k = 0; k < 4; ++k) {
    const Row& row = census.at(std::to_string(k + 1));
    EXPECT_EQ(row.at("state"), states[k]);
    EXPECT_EQ(row.at("file"), files[k]);
  }
  const Row& box = census.at("2");
  EXPECT_NEAR(std::stod(box.at("volume")), 200.0, 1e-12);
  EXPECT_EQ(box.at("pores"), "1");
  EXPECT_NEAR(std::stod(box.at("pore_volume")), 1.0, 1e-12);
  const std::vector<std::pair<std::string, std::string>> known = {
      {"boundary_edges", "0"}, {"x_min", "-5"},    {"x_max", "5"},
      {"y_min", "-2.5"},       {"y_max", "2.5"},   {"z_min", "-2"},
      {"z_max", "2"},          {"vertices", "16"}, {"faces", "24"}};
  for (const auto& [column, value] : known) EXPECT_EQ(box.at(column), value) << column;
  EXPECT_EQ(census.at("1").at("boundary_edges"), "3");
  EXPECT_EQ(census.at("3").at("faces"), "80");
  EXPECT_EQ(census.at("3").at("vertices"), "42");

  const CensusStates counted =
      census_states(grains.census([](const std::string&) -> MadeGrain { return {"a.ply"}; }));
  EXPECT_EQ(counted, (CensusStates{
                         {"all", 4}, {"written", 2}, {"open", 1}, {"too small", 1}, {"pores", 1}}));

  // The record of a made grain is its row behind its name.
  const GrainScan scan = grains.read(1, false, Execution(1));
  EXPECT_EQ(scan.mesh.triangles.size(), 80U);
  const auto record = test::csv_records(scan.record("3.stl"));
  ASSERT_EQ(record.size(), 1U);
  EXPECT_EQ(record[0][0], mesh + "/3");
  EXPECT_EQ(record[0][1], "3");
  EXPECT_EQ(record[0][2], "written");
  EXPECT_EQ(record[0][3], census.at("3").at("volume"));
}

TEST_F(ExtractedGrains, OfABodiesJobAreFilesAndATableOfAllBodies) {
  const std::string mesh = write_bodies();
  const auto run = [&](const ExtractJob& options, const Shard& shard) {
    JoinedGrains grains(shard);
    grains.add(std::make_unique<BodyGrains>(mesh, options.smallest_body, Execution(1)));
    const GrainJob job = make_job(options, path("out"), shard);
    EXPECT_EQ(run_job(job, grains, {1}).failed, 0U);
    return write_census(options, job, grains);
  };
  ExtractJob options;
  options.table = "bodies";
  options.describe = true;
  EXPECT_EQ(
      run(options, {}),
      (std::vector<std::string>{"4 bodies: 3 written, 1 open and only listed, 1 pore in them"}));
  EXPECT_NEAR(volume_of(read_mesh(path("out/2.ply")), Execution(1)), 199.0, 1e-9);
  EXPECT_TRUE(fs::exists(path("out/4.ply")));
  EXPECT_FALSE(fs::exists(path("out/grains.csv")));
  const auto shapes = test::csv_rows(content("out/shape.csv"), "grain");
  EXPECT_NEAR(std::stod(shapes.at(mesh + "/4").at("scan.volume [length^3]")), 1.0, 1e-12);
  EXPECT_EQ(shapes.at(mesh + "/4").count("resolution.voxel_size [length]"), 0U);
  // Twelve edges and six diagonals.
  EXPECT_NEAR(std::stod(shapes.at(mesh + "/4").at("scan.edge_length_mean [length]")),
              (12.0 + 6.0 * std::sqrt(2.0)) / 18.0, 1e-12);
  // A part writes no census; what an earlier call made and this one does not goes.
  options.smallest_body = 1.0;
  options.describe = false;
  for (const int index : {1, 2}) EXPECT_TRUE(run(options, {index, 2}).empty());
  EXPECT_EQ(test::csv_rows(content("out/bodies.csv"), "body").at("4").at("state"), "written");
  EXPECT_EQ(run(options, {}),
            (std::vector<std::string>{
                "4 bodies: 2 written, 1 too small, 1 open and only listed, 1 pore in them",
                "1 file of the earlier call removed"}));
  EXPECT_FALSE(fs::exists(path("out/4.ply")));
  EXPECT_TRUE(fs::exists(path("out/2.ply")) && fs::exists(path("out/3.ply")));
  EXPECT_EQ(test::csv_rows(content("out/bodies.csv"), "body").at("4").at("state"), "too small");
}

TEST_F(ExtractedGrains, OfLabelsHaveTheirSizeTheirWarningsAndTheirRows) {
  LabelSource grains(path("v.nrrd"), labels("0.5 0.5 0.5"));
  ASSERT_EQ(grains.size(), 2U);
  EXPECT_EQ(grains.unit(), "mm");
  EXPECT_EQ(grains.volumes(), 1U);
  EXPECT_NEAR(grains.left_out(), 8.0 / (120.0 + 120.0 + 8.0), 1e-12);
  std::map<std::string, std::string> records;
  for (std::size_t k = 0; k < 2; ++k) {
    const GrainScan scan = grains.read(k, false, Execution(1));
    EXPECT_TRUE(scan.refused.empty());
    EXPECT_EQ(scan.voxel_size, 0.5);
    EXPECT_NEAR(volume_of(scan.mesh, Execution(1)), 15.0, 1e-9);
    const bool is_in_pieces = grains.name(k) == path("v.nrrd/4");
    EXPECT_EQ(scan.warnings.size(), is_in_pieces ? 1U : 0U);
    records[grains.name(k)] = scan.record("made.ply");
  }
  const auto census = test::csv_rows(grains.census([&](const std::string& grain) -> MadeGrain {
    if (grain == path("v.nrrd/7")) return {"", "", "It broke."};
    return {"4.ply", records.at(grain)};
  }),
                                     "label");
  ASSERT_EQ(census.size(), 4U);
  EXPECT_EQ(census.at("4").at("state"), "in 2 pieces");
  EXPECT_EQ(census.at("4").at("file"), "made.ply");
  EXPECT_EQ(std::stod(census.at("4").at("mesh_volume")), 15.0);
  EXPECT_EQ(census.at("7").at("state"), "failed");
  EXPECT_EQ(census.at("7").at("error"), "It broke.");
  EXPECT_EQ(census.at("5").at("state"), "too small");
  EXPECT_EQ(census.at("9").at("state"), "at the border");
  EXPECT_EQ(census.at("9").at("voxels"), "216");
  // Voxels that are no cubes have no size.
  LabelSource flat(path("v.nrrd"), labels("0.5 0.5 0.6"));
  EXPECT_EQ(flat.read(0, false, Execution(1)).voxel_size, 0.0);
}

TEST_F(ExtractedGrains, OfBodiesHaveTheWarningsAndTheNamesOfTheirFile) {
  const IndexedMesh box = test::box(3.0, 2.0, 1.0);
  write_mesh(test::joined(box, test::moved(box, 1.0, {0.4, 0.3, 0.2})), path("a.stl"));
  file("a.stl", content("a.stl") + "more");
  const std::vector<std::string> warnings = BodyGrains(path("a.stl"), 0.0, Execution(1)).warnings();
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(holds(warnings[0], "has 4 bytes"));
  EXPECT_TRUE(holds(warnings[1], "Bodies 1 and 2 overlap"));
  const std::string faces = "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\n";
  file("b.obj", faces + "v 9 0 0\nv 10 0 0\nv 9 1 0\nv 9 0 1\no host\nf 1 3 2\nf 1 2 4\nf 1 4 3\n" +
                    "f 2 3 4\no crumb\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n");
  const auto census = test::csv_rows(
      BodyGrains(path("b.obj"), 0.0, Execution(1)).census([](const std::string&) -> MadeGrain {
        return {"a.ply"};
      }),
      "name");
  EXPECT_NEAR(std::stod(census.at("host").at("volume")), 4.0, 1e-12);
  EXPECT_EQ(census.at("crumb").at("body"), "2");
}

TEST_F(ExtractedGrains, ThatFailAreListedWithTheirErrors) {
  class Failing : public LabelSource {
   public:
    using LabelSource::LabelSource;
    GrainScan read(std::size_t grain, bool pictures, const Execution& execution) override {
      if (name(grain).back() == '7') throw Error(ErrorCode::InvalidInput, "It broke.");
      return LabelSource::read(grain, pictures, execution);
    }
  };
  Failing grains(path("v.nrrd"), labels("1 1 1"));
  const ExtractJob options;
  const GrainJob job = make_job(options, path("out"));
  EXPECT_EQ(run_job(job, grains, {1}).failed, 1U);
  EXPECT_EQ(write_census(options, job, grains).front(),
            "4 labels: 1 written (1 in pieces), 1 at the border, 1 too small, 1 failed");
  const auto census = test::csv_rows(content("out/labels.csv"), "label");
  EXPECT_EQ(census.at("7").at("state"), "failed");
  EXPECT_EQ(census.at("7").at("error"), "It broke.");
  EXPECT_EQ(census.at("4").at("file"), "4.ply");
}

TEST_F(ExtractedGrains, ThatAreCrumbsAreRefusedAndDescribedAsFailed) {
  test::MadeVolume volume({24, 20, 16});
  volume.fill_box(1, {2, 2, 2}, {10, 10, 10});
  for (int k = 0; k < 8; ++k) volume.fill_box(2, {12, 2, 2 * k + 0.0}, {20, 4, 2 * k + 1.0});
  for (int x = 12; x < 20; ++x) volume.at(x, 2, 0) = volume.at(x, 3, 0) = 0;
  test::write_bytes(folder_ / "v.nrrd", test::nrrd(volume, "spacings: 1 1 1\n"));
  VolumeOptions choice;
  choice.smallest = 50;
  ExtractJob options;
  options.describe = true;
  LabelSource grains(path("v.nrrd"),
                     std::make_unique<LabelGrains>(path("v.nrrd"), choice, Execution(1)));
  const GrainJob job = make_job(options, path("out"));
  const JobEnd end = run_job(job, grains, {1});
  EXPECT_EQ(end.done, 2U);
  EXPECT_FALSE(fs::exists(path("out/2.ply")));
  const auto shapes = test::csv_rows(content("out/shape.csv"), "grain");
  const Row& crumbs = shapes.at(path("v.nrrd/2"));
  EXPECT_EQ(crumbs.at("status"), "failed");
  EXPECT_TRUE(holds(crumbs.at("error"), "in 7 pieces"));
  const Row& cube = shapes.at(path("v.nrrd/1"));
  EXPECT_EQ(cube.at("status"), "done");
  EXPECT_EQ(cube.at("file"), "1.ply");
  EXPECT_NEAR(std::stod(cube.at("scan.volume [length^3]")), 512.0, 1e-9);
  EXPECT_NEAR(std::stod(cube.at("resolution.voxel_size [length]")), 1.0, 1e-12);
  const std::vector<std::string> lines = write_census(options, job, grains);
  ASSERT_GE(lines.size(), 2U);
  EXPECT_TRUE(holds(lines[1], "Voxels across a grain: 9.93"));
  const auto census = test::csv_rows(content("out/labels.csv"), "label");
  EXPECT_EQ(census.at("1").at("state"), "written");
  EXPECT_EQ(census.at("1").at("file"), "1.ply");
}

TEST(ExtractJobs, GoOnOnlyWithTheSameOptions) {
  const std::vector<std::function<void(ExtractJob&)>> changes = {
      [](ExtractJob&) {},
      [](ExtractJob& job) { job.format = "stl"; },
      [](ExtractJob& job) { job.volume.background = 3.0; },
      [](ExtractJob& job) { job.volume.background = std::nan(""); },
      [](ExtractJob& job) { job.volume.smallest = 7; },
      [](ExtractJob& job) { job.volume.at_border = true; },
      [](ExtractJob& job) { job.volume.smoothing = 3; },
      [](ExtractJob& job) { job.volume.parts = true; },
      [](ExtractJob& job) { job.volume.separate = 2.0; },
      [](ExtractJob& job) { job.volume.choice.channel = 2; },
      [](ExtractJob& job) { job.volume.choice.frame = 2; },
      [](ExtractJob& job) { job.volume.choice.array = "labels"; },
      [](ExtractJob& job) { job.volume.choice.unit = "mm"; },
      [](ExtractJob& job) { job.volume.choice.voxel_size = Vector3(1, 2, 3); },
      [](ExtractJob& job) { job.table = "bodies"; },
      [](ExtractJob& job) {
        job.table = "bodies";
        job.smallest_body = 2.0;
      }};
  test::expect_calls_differ(changes);
}

TEST(ExtractJobs, MeasureWhatVoxelsOfAKnownCubeDid) {
  const IndexedMesh scan = test::scaled(test::sphere(2), Vector3(12.0, 9.0, 7.0));
  const DetailedDescriptors descriptors =
      describe_shape_in_detail(scan, DetailedOptions(), Execution(1));
  const auto has_rows = [&](const VolumeOptions& volume, double voxel_size) {
    return !resolution_of(volume, voxel_size, scan, descriptors, Execution(1)).rows.empty();
  };
  VolumeOptions volume;
  EXPECT_FALSE(has_rows(volume, 0.0));
  EXPECT_TRUE(has_rows(volume, 1.0));
  volume.choice.voxel_size = Vector3(1.0, 1.0, 2.0);
  EXPECT_FALSE(has_rows(volume, 0.0)) << "no cube";
  volume.choice.voxel_size = Vector3(1.0, 1.0, 1.0);
  EXPECT_TRUE(has_rows(volume, 0.0));
  EXPECT_EQ(resolution_of(volume, 0.5, scan, descriptors, Execution(1)).voxel_size, 0.5)
      << "the scan's own is known";
  volume.smoothing = 3;
  EXPECT_FALSE(has_rows(volume, 1.0)) << "the biases are of another smoothing";
}

}  // namespace
}  // namespace wscvt
