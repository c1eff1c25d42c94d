// SPDX-License-Identifier: GPL-3.0-or-later
// The program on a volume of labels.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "program_run.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/test_shapes.h"
#include "wscvt/base/mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

class Extract : public test::ProgramRun {
 protected:
  /// Two balls, a pair of boxes under one label, and what is listed only: 3, 8, 5, 9, 11.
  void write_sample(const std::string& name = "sample.nrrd") {
    ball_ = volume_.fill_ball(3, {20, 20, 30}, 12.0);
    other_ = volume_.fill_ball(8, {50, 20, 20}, 10.0);
    volume_.fill_box(5, {40, 45, 20}, {50, 55, 30});
    volume_.fill_box(5, {60, 45, 20}, {64, 49, 24});
    volume_.fill_ball(9, {68, 30, 50}, 6.0);
    volume_.fill_box(11, {30, 50, 50}, {33, 53, 53});
    test::write_bytes(folder_ / name,
                      test::nrrd(volume_, "spacings: 0.5 0.5 0.5\nspace units: \"mm\"\n"));
  }

  /// The rows of a table by a column's values.
  std::map<std::string, test::CsvRow> rows(const std::string& table, const std::string& by) const {
    return test::csv_rows(content(table), by);
  }

  test::MadeVolume volume_{{70, 60, 60}};
  std::int64_t ball_ = 0;
  std::int64_t other_ = 0;
};

// A volume that was cut out of a larger one: all its grains are cut.
TEST_F(Extract, OfNoGrainSaysWhyAndIsNotDone) {
  test::MadeVolume cut({20, 20, 20});
  cut.fill_box(3, {0, 2, 2}, {10, 18, 18});
  cut.fill_box(4, {12, 2, 2}, {20, 18, 18});
  test::write_bytes(folder_ / "cut.nrrd", test::nrrd(cut, ""));
  for (const char* call : {"extract cut.nrrd out", "batch cut.nrrd -n 40 -o batch"}) {
    SCOPED_TRACE(call);
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.errors,
              "Warning: No label is a grain to mesh: of 2 labels 2 lie at the border. Give "
              "--at-border.\n");
    EXPECT_TRUE(holds(outcome.output, "2 labels: 0 written, 2 at the border"));
  }
  const Outcome walls = run("extract cut.nrrd walls --edge-length 4");
  EXPECT_EQ(walls.exit_code, 1);
  EXPECT_EQ(walls.errors,
            "No label is a grain to mesh: of 2 labels 2 lie at the border. Give --at-border.\n");
  EXPECT_EQ(run("extract cut.nrrd out --at-border").exit_code, 0);
}

TEST_F(Extract, MakesAMeshALabelAndListsTheOthers) {
  write_sample();
  const Outcome outcome = run("extract sample.nrrd out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(
      holds(outcome.output, "5 labels: 3 written (1 in pieces), 1 at the border, 1 too small\n"));
  EXPECT_EQ(
      outcome.errors.rfind("Warning: 1 label of 3 is in several parts. Only the largest part of "
                           "each label is used. The others, 0.512 % of all voxels, are left out. "
                           "To make each part a grain, use --parts, and another output folder.",
                           0),
      0U)
      << outcome.errors;
  auto table = rows("out/labels.csv", "label");
  ASSERT_EQ(table.size(), 5U);
  EXPECT_EQ(table["3"]["state"], "written");
  EXPECT_EQ(table["8"]["state"], "written");
  EXPECT_EQ(table["5"]["state"], "in 2 pieces");
  EXPECT_EQ(table["9"]["state"], "at the border");
  EXPECT_EQ(table["11"]["state"], "too small");
  EXPECT_EQ(table["3"]["voxels"], std::to_string(ball_));
  EXPECT_EQ(std::stod(table["3"]["volume"]), 0.125 * static_cast<double>(ball_));
  EXPECT_EQ(table["3"]["unit"], "mm");
  EXPECT_EQ(table["5"]["voxels"], "1064");
  EXPECT_EQ(std::stod(table["5"]["mesh_volume"]), 125.0);
  EXPECT_EQ(table["5"]["pieces"], "2");
  EXPECT_NEAR(std::stod(table["5"]["left_out"]), 64.0 / 1064.0, 1e-12);
  EXPECT_EQ(table["9"]["pieces"], "1");
  EXPECT_EQ(table["9"]["left_out"], "0");
  // The middle of the first voxel is 0.
  EXPECT_EQ(table["11"]["x_min"], "14.75");
  EXPECT_EQ(table["11"]["z_max"], "26.25");
  EXPECT_EQ(table["9"]["file"], "");

  const IndexedMesh mesh = read_mesh(path("out/3.ply"));
  EXPECT_EQ(std::to_string(mesh.triangles.size()), table["3"]["faces"]);
  to_mesh(mesh);  // throws unless it is a manifold
  const ShapeDescriptors shape = describe_shape(mesh, Execution(1));
  EXPECT_NEAR(shape.volume / (0.125 * static_cast<double>(ball_)), 1.0, 1e-12);
  EXPECT_LT((shape.centroid - Vector3(9.75, 9.75, 14.75)).norm(), 1e-9);
  EXPECT_NEAR(shape.area / (4.0 * 3.14159265358979 * 36.0), 1.0, 0.02);
  EXPECT_FALSE(exists("out/9.ply") || exists("out/11.ply"));

  // On a system's own terms: other options, other labels.
  ASSERT_EQ(run("extract sample.nrrd all -q --at-border --smallest 27 --smoothing 0 --voxel-size "
                "1,2,3 --format off")
                .exit_code,
            0);
  EXPECT_NEAR(describe_shape(read_mesh(path("all/11.off")), Execution(1)).volume, 27.0 * 6.0, 1e-9);
  // Not smoothed: the faces of 3 x 3 x 3 voxels of 1 x 2 x 3.
  EXPECT_NEAR(describe_shape(read_mesh(path("all/11.off")), Execution(1)).area, 198.0, 1e-9);
  EXPECT_TRUE(exists("all/9.off"));
  EXPECT_EQ(rows("all/labels.csv", "label")["11"]["unit"], "mm");
  ASSERT_EQ(run("extract sample.nrrd between -q --background 3 --smallest 100000").exit_code, 3);
  table = rows("between/labels.csv", "label");
  EXPECT_EQ(table.count("3"), 0U);
  EXPECT_EQ(table["0"]["state"], "at the border");
}

// membrain-pick 16, MorphoLibJ: one label for all grains.
TEST_F(Extract, RemeshesAllGrainsAtOnceWithCommonWalls) {
  volume_.fill_ball(3, {20, 30, 30}, 12.0);
  volume_.fill_ball(8, {42, 30, 30}, 12.0);
  test::write_bytes(folder_ / "pair.nrrd", test::nrrd(volume_, "spacings: 0.5 0.5 0.5\n"));
  const Outcome outcome = run("extract pair.nrrd out --edge-length 1.5");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  auto grains = rows("out/grains.csv", "grain");
  ASSERT_EQ(grains.size(), 2U);
  for (const char* label : {"3", "8"}) {
    auto& row = grains.at(label);
    const IndexedMesh mesh = read_mesh((folder_ / "out" / row.at("file")).string());
    EXPECT_EQ(std::to_string(mesh.points.size()), row.at("nodes"));
    EXPECT_EQ(std::to_string(mesh.triangles.size()), row.at("triangles"));
    EXPECT_EQ(row.at("contacts"), "1");
    // Each voxel is an eighth. The table's numbers read back to the same bits.
    EXPECT_EQ(std::stod(row.at("voxel_volume")), 0.125 * std::stod(row.at("voxels")));
    EXPECT_NEAR(std::stod(row.at("volume")), std::stod(row.at("voxel_volume")), 1e-8);
  }
  auto walls = rows("out/walls.csv", "first");
  ASSERT_EQ(walls.size(), 1U);
  // The middle of the common disc, at (31, 30, 30) voxels; its rim moves it by less than a voxel.
  EXPECT_NEAR(std::stod(walls.at("3").at("x")), 15.5, 0.5);
  EXPECT_NEAR(std::stod(walls.at("3").at("y")), 15.0, 0.5);
  EXPECT_EQ(content("out/walls.vtu").rfind("<?xml", 0), 0U);
  EXPECT_TRUE(holds(content("out/walls.msh"), "\"wall_3_8\""));
  EXPECT_TRUE(holds(content("out/walls.msh"), "\"grain_8\""));
  // Tables of others stay, and with them what they name.
  for (const char* call : {"extract pair.nrrd out", "describe pair.nrrd -o out"}) {
    EXPECT_TRUE(holds(run(call).errors, "a grains.csv of another command")) << call;
  }
  EXPECT_EQ(rows("out/grains.csv", "grain"), grains);
  // A call over the meshes of another segmentation leaves none of them.
  volume_.fill_ball(3, {42, 30, 30}, 12.0);
  test::write_bytes(folder_ / "one.nrrd", test::nrrd(volume_, "spacings: 0.5 0.5 0.5\n"));
  const Outcome again = run("extract one.nrrd out --edge-length 1.5");
  EXPECT_TRUE(holds(again.output, "1 file of the earlier call removed"));
  EXPECT_FALSE(exists("out/8.ply"));
  ASSERT_EQ(run("extract pair.nrrd plain").exit_code, 0);
  EXPECT_TRUE(holds(run("extract one.nrrd plain").output, "1 file of the earlier call removed"));
  EXPECT_FALSE(exists("plain/8.ply"));
  EXPECT_TRUE(exists("plain/3.ply"));
  ASSERT_EQ(run("extract pair.nrrd few -n 150").exit_code, 0);
  for (const auto& [label, row] : rows("few/grains.csv", "grain")) {
    EXPECT_NEAR(std::stod(row.at("nodes")), 150.0, 30.0) << label;
  }
}

TEST_F(Extract, ReplacesNoMeshesOfAnotherSample) {
  write_sample();
  IndexedMesh mesh = test::sphere(2);
  for (const double x : {4.0, 8.0}) {
    mesh = test::joined(mesh, test::moved(test::sphere(2), 1.0, {x, 0, 0}));
  }
  write_mesh(mesh, path("bodies.obj"));
  ASSERT_EQ(run("extract sample.nrrd labels -q").exit_code, 0);
  ASSERT_EQ(run("extract bodies.obj bodies -q").exit_code, 0);
  const std::string label = content("labels/3.ply");
  const std::string body = content("bodies/3.ply");
  const std::string table = content("labels/labels.csv");
  for (const std::string call :
       {"extract bodies.obj labels", "extract sample.nrrd bodies",
        "extract sample.nrrd bodies --edge-length 0", "batch bodies.obj -o labels --parts -n 60",
        "batch sample.nrrd -o bodies -n 60", "batch sample.nrrd -o labels -n 60 --format off",
        "batch sample.nrrd -o labels -n 60,80"}) {
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.exit_code, 2) << call << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "has the results of another command (")) << call;
  }
  EXPECT_EQ(content("labels/3.ply"), label);
  EXPECT_EQ(content("bodies/3.ply"), body);
  EXPECT_EQ(content("labels/labels.csv"), table);
  for (const char* file : {"labels/bodies.csv", "labels/call.json", "bodies/labels.csv"}) {
    EXPECT_FALSE(exists(file)) << file;
  }
  for (const std::string name : {"labels/labels.csv", "bodies/bodies.csv"}) {
    const std::string before = content(name);
    EXPECT_EQ(run("clump labels/3.ply -k 2 -q -o " + name).exit_code, 2) << name;
    EXPECT_EQ(content(name), before);
  }
  // Other files beside them.
  EXPECT_EQ(run("clump sample.nrrd -k 2 -o labels -q").exit_code, 0);
}

TEST_F(Extract, LengthsOfTwoUnitsAreInNoTable) {
  write_sample("mm.nrrd");
  test::write_bytes(folder_ / "um.nrrd",
                    test::nrrd(volume_, "spacings: 500 500 500\nspace units: \"um\"\n"));
  const Outcome outcome = run("batch mm.nrrd um.nrrd -o both -n 40");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_TRUE(holds(outcome.errors, "are in mm, and of \"um.nrrd\" in um"));
  EXPECT_FALSE(exists("both"));
}

TEST_F(Extract, SaysThatAMaskHasPartsAndTakesThemAsGrains) {
  const std::int64_t ball = volume_.fill_ball(255, {20, 20, 30}, 12.0);
  const std::int64_t other = volume_.fill_ball(255, {50, 20, 20}, 10.0);
  test::write_bytes(folder_ / "mask.nrrd", test::nrrd(volume_, ""));
  for (const std::string call : {"extract mask.nrrd out", "batch mask.nrrd -o remeshed -n 60"}) {
    const Outcome outcome = run(call + " -q");
    EXPECT_EQ(outcome.exit_code, 3) << call;
    EXPECT_TRUE(holds(outcome.errors, "one label, 255, in 2 parts"));
    EXPECT_TRUE(holds(outcome.errors, "--parts"));
    EXPECT_EQ(outcome.output, "");
  }
  auto table = rows("out/labels.csv", "label");
  EXPECT_EQ(table["255"]["state"], "in 2 pieces");
  EXPECT_NEAR(std::stod(table["255"]["left_out"]),
              static_cast<double>(other) / static_cast<double>(ball + other), 1e-12);
  // The command that it names.
  const Outcome parted = run("extract mask.nrrd out --parts");
  EXPECT_EQ(parted.exit_code, 0) << parted.errors;
  EXPECT_EQ(parted.errors, "");
  const std::string lines = parted.output.substr(parted.output.find('\n') + 1);
  EXPECT_EQ(lines.rfind("No voxel size found: lengths in voxels. Give it by --voxel-size.\n"
                        "2 labels: 2 written\n1 file of the earlier call removed\n"
                        "Files       \"out\"\nTime        ",
                        0),
            0U)
      << lines;
  EXPECT_FALSE(exists("out/255.ply"));
  table = rows("out/labels.csv", "label");
  EXPECT_EQ(table["1"]["voxels"], std::to_string(other));
  EXPECT_EQ(table["2"]["voxels"], std::to_string(ball));
  EXPECT_EQ(run("batch mask.nrrd -o parts -n 60 -q --parts").exit_code, 0);
  EXPECT_EQ(read_mesh(path("parts/2.ply")).points.size(), 60U);
  EXPECT_EQ(run("batch mask.nrrd -o parts -n 60 -q").exit_code, 2) << "another call";
  // Just below and just above one part in twenty.
  test::MadeVolume most({70, 60, 60});
  most.fill_box(1, {10, 10, 10}, {20, 20, 29});
  most.fill_box(1, {40, 40, 40}, {44, 45, 45});
  test::write_bytes(folder_ / "most.nrrd", test::nrrd(most, ""));
  EXPECT_EQ(run("extract most.nrrd out -q").exit_code, 0) << "100 of 2000: not more than 5 %";
  most.at(44, 44, 44) = 1;
  test::write_bytes(folder_ / "most.nrrd", test::nrrd(most, ""));
  EXPECT_EQ(run("extract most.nrrd out -q").exit_code, 3);
}

TEST_F(Extract, CountsWhatBecameOfTheLabels) {
  volume_.fill_box(12, {0, 0, 0}, {20, 20, 4});
  write_sample();
  const Outcome outcome = run("extract sample.nrrd out");
  EXPECT_TRUE(
      holds(outcome.output, "6 labels: 3 written (1 in pieces), 2 at the border, 1 too small\n"));
}

TEST_F(Extract, NamesALabelThatIsTooSmallForWalls) {
  volume_.fill_ball(3, {20, 20, 30}, 8.0);
  volume_.fill_box(7, {40, 40, 40}, {41, 41, 41});
  test::write_bytes(folder_ / "sample.nrrd", test::nrrd(volume_, ""));
  EXPECT_TRUE(holds(run("extract sample.nrrd out --edge-length 0 --smallest 1").errors,
                    "Label 7 has only 1 voxel in its largest piece. "))
      << content("stderr.txt");
  EXPECT_TRUE(holds(content("stderr.txt"), "--smallest 64."));
  EXPECT_EQ(run("extract sample.nrrd out --edge-length 0 --smallest 64").exit_code, 0);
}

TEST_F(Extract, SaysWhichSmallestLeavesOutWhatHasNoWall) {
  // A plate between two grains, a voxel thick, and a label in crumbs.
  test::MadeVolume made({40, 40, 40});
  made.fill_box(1, {5, 5, 5}, {35, 35, 20});
  made.fill_box(2, {5, 5, 21}, {35, 35, 35});
  made.fill_box(3, {5, 5, 20}, {35, 35, 21});
  for (double x = 5.0; x < 35.0; x += 5.0) made.fill_box(4, {x, 1, 1}, {x + 3.0, 4, 4});
  test::write_bytes(folder_ / "thin.nrrd", test::nrrd(made, ""));
  const Outcome refused = run("extract thin.nrrd out --edge-length 3");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_TRUE(holds(refused.errors, "in its largest piece, and 1 other has as few. "))
      << refused.errors;
  const std::string advice = "Leave out the small labels by --smallest 901.";
  EXPECT_TRUE(holds(refused.errors, advice)) << refused.errors;
  EXPECT_EQ(run("extract thin.nrrd out --edge-length 3 --smallest 901").exit_code, 0);
}

TEST_F(Extract, CountsLabelsInEachCommand) {
  write_sample();
  const std::string line = "5 labels: 3 taken, 1 at the border, 1 too small\n";
  for (const std::string call :
       {"extract sample.nrrd walls --edge-length 0", "clump sample.nrrd -k 2 -o clumps",
        "batch sample.nrrd -o out -n 60 --describe none"}) {
    const Outcome outcome = run(call);
    EXPECT_TRUE(holds(outcome.output, line)) << call;
  }
  // A batch of meshes beside a table of the user's.
  write_mesh(test::sphere(2), path("ball.ply"));
  fs::create_directory(path("mine"));
  std::ofstream(path("mine/labels.csv")) << "number\n1\n";
  EXPECT_EQ(run("batch ball.ply -o mine -n 40 -q --describe none").exit_code, 0);
  EXPECT_FALSE(holds(content("mine/summary.json"), "labels"));
  const std::string json = content("out/summary.json");
  EXPECT_TRUE(holds(json, "\"at the border\": 1"));
  EXPECT_TRUE(holds(content("out/summary.html"), "1 at the border, 1 too small."));
}

TEST_F(Extract, TakesSizesWithUnitsAndTheChosenVolumeOfAFile) {
  volume_.fill_box(3, {10, 10, 10}, {20, 20, 20});
  test::MadeVolume two({70, 60, 120});
  std::copy(volume_.labels.begin(), volume_.labels.end(), two.labels.begin() + 70 * 60 * 60);
  two.fill_box(7, {10, 10, 10}, {14, 14, 14});
  std::string bytes = test::nrrd(two, "");
  const std::string one = "dimension: 3";
  bytes.replace(bytes.find(one), one.size(), "dimension: 4");
  const std::string sizes = "sizes: 70 60 120";
  bytes.replace(bytes.find(sizes), sizes.size(), "sizes: 70 60 60 2");
  test::write_bytes(folder_ / "two.nrrd", bytes);
  expect_refused(
      "extract",
      {{"two.nrrd out", 1, "2 frames"},
       {"two.nrrd out --select time=3", 1, "2 frames, not a frame 3"},
       {"two.nrrd out --select time=0", 2, "1 to 1000000"},
       {"two.nrrd out --select time=2 --select array=x", 1, "--select array=x"},
       {"two.nrrd out --select time", 2, "Give channel=N, time=N or array=NAME"},
       {"two.nrrd out --select array=", 2, "Give channel=N, time=N or array=NAME"},
       {"two.nrrd out --select layer=2", 2, "\"layer=2\""},
       {"two.nrrd out --select time=2,channel=1", 2, "\"2,channel=1\""},
       {"two.nrrd out --select time=2 --voxel-size 3ells", 2, "one of the units nm"},
       {"two.nrrd out --select time=2 --voxel-size 3um,3mm,3um", 2, "one of the units nm"}},
      {"out"});
  for (const auto& [size, unit, volume] :
       std::vector<std::tuple<std::string, std::string, double>>{{"12um", "um", 1728.0},
                                                                 {"0.1mm", "mm", 1e-3},
                                                                 {"'2 \xc2\xb5m'", "um", 8.0},
                                                                 {"1,2,3nm", "nm", 6.0},
                                                                 {"1mm,2mm,3mm", "mm", 6.0},
                                                                 {"2", "", 8.0},
                                                                 {"1e-3m", "m", 1e-9}}) {
    ASSERT_EQ(run("extract two.nrrd out -q --select time=2 --voxel-size " + size).exit_code, 0)
        << size;
    auto table = rows("out/labels.csv", "label");
    ASSERT_EQ(table.size(), 1U);
    EXPECT_EQ(table["3"]["unit"], unit);
    EXPECT_NEAR(std::stod(table["3"]["volume"]) / (1000.0 * volume), 1.0, 1e-12) << size;
  }
}

TEST_F(Extract, HasTheSameBytesAtAnyNumberOfThreads) {
  write_sample();
  for (const std::string threads : {"1", "2", "5"}) {
    ASSERT_EQ(run("extract sample.nrrd dense" + threads + " -q -t " + threads).exit_code, 0);
    ASSERT_EQ(run("batch sample.nrrd -o out" + threads + " -n 60 -q -t " + threads).exit_code, 0);
    for (const std::string name : {"/labels.csv", "/3.ply", "/5.ply", "/8.ply"}) {
      EXPECT_EQ(content("dense" + threads + name), content("dense1" + name)) << name;
      EXPECT_EQ(content("out" + threads + name), content("out1" + name)) << name;
    }
    EXPECT_EQ(content("out" + threads + "/grains.csv"), content("out1/grains.csv"));
  }
}

TEST_F(Extract, GoesOnToNodesWithoutFilesInBetween) {
  write_sample();
  const Outcome outcome = run("batch sample.nrrd -o out -n 60");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.rfind("70 x 60 x 60 voxels of 0.5 x 0.5 x 0.5 mm", 0), 0U);
  EXPECT_TRUE(holds(outcome.output, "\n3 grains: 3 remeshed, "));
  EXPECT_EQ(read_mesh(path("out/8.ply")).points.size(), 60U);
  auto labels = rows("out/labels.csv", "grain");
  EXPECT_EQ(labels.size(), 5U);
  EXPECT_EQ(labels["sample.nrrd/3"]["state"], "taken");
  EXPECT_EQ(labels["sample.nrrd/9"]["state"], "at the border");
  // In the order in which the grains end in the volume.
  const auto records = test::csv_records(content("out/grains.csv"));
  ASSERT_EQ(records.size(), 4U);
  EXPECT_EQ(records[1][0], "sample.nrrd/5");
  EXPECT_EQ(records[2][0], "sample.nrrd/8");
  EXPECT_EQ(records[3][0], "sample.nrrd/3");
  EXPECT_TRUE(holds(records[1].back(), "2 pieces"));
  EXPECT_FALSE(holds(records[2].back(), "pieces"));

  // The same as through files, and as a batch that takes the volume among others.
  ASSERT_EQ(run("extract sample.nrrd dense -q").exit_code, 0);
  ASSERT_EQ(run("remesh dense/8.ply 8.ply -q -n 60").exit_code, 0);
  EXPECT_EQ(content("8.ply"), content("out/8.ply"));
  fs::copy_file(folder_ / "dense/8.ply", folder_ / "more.ply");
  ASSERT_EQ(run("batch more.ply sample.nrrd -o both -n 60 -q --shard 1/1").exit_code, 0);
  EXPECT_EQ(content("both/more.ply"), content("out/8.ply"));
  EXPECT_EQ(content("both/3.ply"), content("out/3.ply"));
  EXPECT_EQ(content("both/labels.csv"), content("out/labels.csv"));
  auto grains = rows("both/grains.csv", "grain");
  EXPECT_EQ(grains.size(), 4U);
  EXPECT_EQ(grains["sample.nrrd/8"]["result.vertices"], grains["more.ply"]["result.vertices"]);

  // Parts join to the whole, and what was cut goes on.
  for (const std::string part : {"1", "2"}) {
    ASSERT_EQ(run("batch sample.nrrd -o parts -n 60 -q --shard " + part + "/2").exit_code, 0);
  }
  ASSERT_EQ(run("batch sample.nrrd -o parts -n 60 -q").exit_code, 0);
  const std::string whole = content("out/grains.csv");
  EXPECT_EQ(content("parts/grains.csv"), whole);
  fs::resize_file(folder_ / "out/grains.csv", whole.size() - 40);
  const std::string first = content("out/5.ply");
  fs::remove(folder_ / "out/5.ply");
  ASSERT_EQ(run("batch sample.nrrd -o out -n 60 -q").exit_code, 0);
  EXPECT_EQ(content("out/grains.csv"), whole);
  EXPECT_EQ(content("out/5.ply"), first) << "a lost file is made again";
  for (const std::string other : {"--smoothing 7", "--at-border", "--smallest 27", "--parts",
                                  "--background 3", "--voxel-size 2", "--format off"}) {
    EXPECT_EQ(run("batch sample.nrrd -o out -n 60 -q " + other).exit_code, 2) << other;
  }
}

TEST_F(Extract, RefusesWhatMakesNoSenseAndBeginsNothing) {
  write_sample();
  test::write_bytes(folder_ / "cut.nrrd", content("sample.nrrd").substr(0, 100000));
  test::write_bytes(folder_ / "empty.nrrd", test::nrrd(test::MadeVolume({9, 9, 9}), ""));
  expect_refused("extract",
                 {{"sample.nrrd out --smallest 0", 2, "1 or more"},
                  {"sample.nrrd out --smoothing 1001", 2, "from 0 to 1000"},
                  {"sample.nrrd out --voxel-size 0", 2, "above 0"},
                  {"sample.nrrd out --voxel-size 1,2", 2, "three numbers with commas"},
                  {"sample.nrrd out --voxel-size 1,2,3,4", 2, "three numbers with commas"},
                  {"sample.nrrd out --background x", 2, "The number of the background is \"x\""},
                  {"sample.nrrd out --format step", 2, "The format of the meshes"},
                  {"sample.nrrd out --smallest 5%", 2, "Give it without %"},
                  {"sample.ply out", 1, "sample.ply"},
                  {"sample.ply out --edge-length 3", 2, "wscvt batch MESH --parts -n N -o OUT"},
                  {"sample.ply out -n 50 --tetrahedra a.vtu", 2, "--nodes, --tetrahedra remeshes"},
                  {"sample.nrrd out -n 50 --shard 1/2", 2, "Leave out --shard"},
                  {"sample.nrrd out -n 50 --edge-length 3", 2, "not both"},
                  {"missing.nrrd out", 1, "missing.nrrd"},
                  {"cut.nrrd out", 1, "bytes of voxels"},
                  {"empty.nrrd out", 1, "no label except the background"},
                  {"sample.nrrd sample.nrrd", 2, "the input itself"}},
                 {"out"});
  // A mesh that cannot be written is no failure of its grain.
  fs::create_directories(folder_ / "out/8.ply");
  const Outcome outcome = run("extract sample.nrrd out -q");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(holds(outcome.errors, "8.ply\" is a folder"));
  EXPECT_FALSE(exists("out/labels.csv"));
}

TEST_F(Extract, MemoryFollowsTheGrainsInWorkNotTheVolume) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep what is freed";
#endif
  const auto peak = [&](int slices) {
    const std::string name = std::to_string(slices) + ".nrrd";
    test::MadeVolume volume({300, 300, slices});
    std::uint32_t label = 0;
    for (int z = 25; z + 25 < slices; z += 50) {
      volume.fill_box(++label, {100, 100, z - 20.0}, {140, 140, z + 20.0});
    }
    test::write_bytes(folder_ / name, test::nrrd(volume, ""));
    // By a small process: what a child has of ours until it becomes the program counts as its own.
    const std::string command = "cd '" + folder_.string() +
                                "' && /usr/bin/time -f %M -o peak.txt '" WSCVT_PROGRAM
                                "' extract " +
                                name + " " + name + "_out -q -t 2";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return std::stol(content("peak.txt"));  // KiB
  };
  const long small = peak(100);  // 18 MB
  const long large = peak(500);  // 90 MB
  EXPECT_LT(large, small + 8192);
}

TEST_F(Extract, DescribesEachGrainIfAsked) {
  write_sample();
  const Outcome outcome = run("extract sample.nrrd dense --describe");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "Voxels across a grain: "));
  EXPECT_FALSE(holds(outcome.output, "fewer nodes")) << "it has no nodes";
  // The scan's columns of a batch, which measures edges in another unit.
  ASSERT_EQ(run("batch sample.nrrd -o out -n 100 -q --describe scan").exit_code, 0);
  const auto shapes = rows("dense/shape.csv", "grain");
  const auto expected = rows("out/shape.csv", "grain");
  ASSERT_EQ(shapes.size(), 3U);
  for (const auto& [grain, row] : expected) {
    SCOPED_TRACE(grain);
    EXPECT_NE(row.at("resolution.area.corrected [mm^2]"), "");
    for (const auto& [name, cell] : row) {
      if (name == "nodes" || name == "rms_distance [mm]") continue;
      const std::string& ours = shapes.at(grain).at(name);
      const double value = std::strtod(cell.c_str(), nullptr);
      if (value == 0.0)
        EXPECT_EQ(ours, cell) << name;
      else
        EXPECT_NEAR(std::stod(ours) / value, 1.0, 1e-12) << name;
    }
  }
  const std::string table = content("dense/shape.csv");
  EXPECT_EQ(run("extract sample.nrrd dense --describe -q -t 1").exit_code, 0);
  EXPECT_EQ(content("dense/shape.csv"), table);
  EXPECT_EQ(run("sample dense -q --report page.html").exit_code, 0);
  EXPECT_EQ(run("extract sample.nrrd plain -q").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plain/shape.csv"));
  EXPECT_EQ(run("extract sample.nrrd walls -n 50 --describe").exit_code, 2);
}

TEST_F(Extract, BatchTellsWhatTheVoxelsDid) {
  write_sample();
  const Outcome outcome = run("batch sample.nrrd -o out -n 1000");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "Voxels across a grain: "));
  EXPECT_TRUE(holds(outcome.output, "resolve fewer nodes than were asked for"));
  auto shapes = rows("out/shape.csv", "grain");
  ASSERT_EQ(shapes.size(), 3U);
  auto& ball = shapes["sample.nrrd/3"];
  const auto number = [&](const std::string& name) { return std::stod(ball.at(name)); };
  EXPECT_EQ(number("resolution.voxel_size [mm]"), 0.5);
  EXPECT_NEAR(number("resolution.voxels_across"), 24.0, 0.2);  // of a radius of 12 voxels
  EXPECT_GE(number("resolution.sphericity_wadell.high"), 1.0);
  EXPECT_LT(number("resolution.area.low [mm^2]"), number("resolution.area.high [mm^2]"));
  EXPECT_EQ(ball.at("resolution.sq.corrected [mm]"), "");  // not resolved
  // As the grain alone.
  EXPECT_EQ(run("extract sample.nrrd dense -q").exit_code, 0);
  EXPECT_EQ(run("describe dense/3.ply -q --voxel-size 0.5 --report ball.csv").exit_code, 0);
  const auto records = test::csv_records(content("ball.csv"));
  const auto& names = records[0];
  const auto place = std::find_if(names.begin(), names.end(), [](const std::string& name) {
    return name.rfind("resolution.area.corrected", 0) == 0;
  });
  ASSERT_NE(place, names.end());
  const double alone = std::stod(records[1][static_cast<std::size_t>(place - names.begin())]);
  // Meshes are written with single precision.
  EXPECT_NEAR(number("resolution.area.corrected [mm^2]") / alone, 1.0, 1e-3);

  EXPECT_EQ(run("batch sample.nrrd -o none -n 100 -q --describe remesh").exit_code, 0);
  EXPECT_FALSE(holds(content("none/shape.csv"), "resolution."));
  EXPECT_EQ(run("batch dense -o meshes -n 100 -q").exit_code, 0);  // of voxels nobody knows
  EXPECT_FALSE(holds(content("meshes/shape.csv"), "resolution."));
  const Outcome given = run("batch dense -o given -n 100 --voxel-size 0.5");
  EXPECT_TRUE(holds(given.output, "Voxels across a grain: "));
  const Outcome rough = run("batch sample.nrrd -o rough -n 100 --smoothing 3");
  EXPECT_FALSE(holds(rough.output, "Voxels across")) << "no biases of this smoothing";
}

}  // namespace
}  // namespace wscvt
