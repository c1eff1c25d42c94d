// SPDX-License-Identifier: GPL-3.0-or-later
// The program that makes clumps and convex parts, of one grain and of a sample.

#include <algorithm>
#include <string>
#include <vector>

#include "program_run.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

using test::holds;

class ClumpProgram : public test::ProgramRun {
 protected:
  void write_sample() {
    std::filesystem::create_directory(folder_ / "scans");
    write_mesh(test::lumpy(3), path("scans/a.ply"));
    write_mesh(test::moved(test::sphere(3), 2.0, {1, 2, 3}), path("scans/b.ply"));
    std::ofstream(folder_ / "scans/torn.ply") << "ply\n";
  }
};

TEST_F(ClumpProgram, WritesReportsAndIsCompared) {
  write_mesh(test::lumpy(3), path("scan.ply"));
  const Outcome outcome = run(
      "clump scan.ply -k 4 -o c.csv -o c.mclump -o c.molecule --density 3 --report r.html --report "
      "r.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "first contact"));
  EXPECT_TRUE(holds(outcome.output, "Files       \"c.csv\", \"c.mclump\", "));
  EXPECT_TRUE(holds(outcome.output, "\nTime        "));
  EXPECT_TRUE(exists("c.mclump/Inertia/TOI.txt"));
  EXPECT_TRUE(holds(content("c.molecule"), "density 3\n"));
  EXPECT_TRUE(holds(content("r.html"), "Distance of clump to scan"));
  EXPECT_TRUE(holds(content("r.json"), "\"scatter_percent\""));
  const Outcome compared = run("describe c.csv scan.ply -v");
  EXPECT_EQ(compared.exit_code, 0) << compared.errors;
  EXPECT_TRUE(holds(compared.output, "root mean square, from the reference"));
  // A point cloud of centres is no grain.
  for (const char* call : {"remesh c.csv out.ply -n 100", "remesh c.csv out.ply -n 100 --points",
                           "convex c.csv -o parts.obj", "clump c.csv -k 2 -o d.csv",
                           "batch c.csv -o out -n 100", "describe scan.ply c.csv"}) {
    const Outcome refused = run(call);
    EXPECT_NE(refused.exit_code, 0) << call;
    EXPECT_TRUE(holds(refused.errors, "wscvt describe CLUMP.csv SCAN")) << call;
  }
}

TEST_F(ClumpProgram, ASampleGoesOnAndIsParted) {
  write_sample();
  ASSERT_EQ(run("clump scans -k 2 -o out -q").exit_code, 3);
  const std::string table = content("out/grains.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
  EXPECT_TRUE(exists("out/a.csv"));
  EXPECT_TRUE(holds(table, "torn.ply,failed,"));
  // Cut within its second row, as by a kill.
  const std::size_t second = table.find("scans/b.ply");
  std::ofstream(folder_ / "out/grains.csv", std::ios::binary) << table.substr(0, second + 20);
  std::filesystem::remove(folder_ / "out/b.csv");
  std::filesystem::remove(folder_ / "out/a.csv");
  ASSERT_EQ(run("clump scans -k 2 -o out -q -t 1").exit_code, 3);
  EXPECT_EQ(content("out/grains.csv"), table);
  EXPECT_TRUE(exists("out/b.csv"));
  EXPECT_TRUE(exists("out/a.csv"));  // its row was there, the file was not
  EXPECT_EQ(run("clump scans -k 3 -o out -q").exit_code, 2);
  ASSERT_LE(run("clump scans -k 2 -o parts -q --shard 1/2").exit_code, 3);
  ASSERT_LE(run("clump scans -k 2 -o parts -q --shard 2/2").exit_code, 3);
  ASSERT_EQ(run("clump scans -k 2 -o parts -q").exit_code, 3);
  EXPECT_EQ(content("parts/grains.csv"), table);
  EXPECT_EQ(run("clump scans -k 2 -o molecules -q --format molecule --density 3").exit_code, 3);
  EXPECT_TRUE(holds(content("molecules/b.molecule"), "density 3\n"));
  EXPECT_EQ(run("clump scans -k 2 -o molecules -q --format molecule").exit_code, 2);
}

TEST_F(ClumpProgram, TheFolderOfABatchWithSeveralNumbersOfNodesIsRefused) {
  write_sample();
  ASSERT_EQ(run("batch scans -n 30,40 -o out -q").exit_code, 3);
  const std::string call = content("out/call.json");
  EXPECT_EQ(run("clump scans -k 2 -o out -q").exit_code, 2);
  EXPECT_EQ(content("out/call.json"), call);
  EXPECT_FALSE(exists("out/grains.csv"));
}

TEST_F(ClumpProgram, ConvexPartsOfASampleAreThoseOfItsGrains) {
  write_sample();
  const std::string options = " -k 3 -n 60 -q --frame principal --density 2 ";
  ASSERT_EQ(run("convex scans -o out --format urdf" + options).exit_code, 3);
  ASSERT_EQ(run("convex scans/a.ply -o a.urdf --report a.csv" + options).exit_code, 0);
  EXPECT_EQ(content("out/a.urdf"), content("a.urdf"));
  EXPECT_NE(content("a_1.obj"), "");
  EXPECT_EQ(content("out/a_1.obj"), content("a_1.obj"));
  const std::string table = content("out/grains.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
  EXPECT_TRUE(holds(table, "torn.ply,failed,"));
  // The row is that of the report, but for the date.
  const std::string row = content("a.csv").substr(content("a.csv").find("\r\n") + 2);
  const std::string numbers = row.substr(row.find(",202") + 11);
  EXPECT_NE(numbers.find(','), std::string::npos) << row;
  EXPECT_TRUE(holds(table, numbers)) << row;
  // Cut within its second row, as by a kill; and in parts.
  std::ofstream(folder_ / "out/grains.csv", std::ios::binary)
      << table.substr(0, table.find("scans/b.ply") + 20);
  std::filesystem::remove(folder_ / "out/b.urdf");
  std::filesystem::remove(folder_ / "out/a.urdf");
  ASSERT_EQ(run("convex scans -o out --format urdf -t 1" + options).exit_code, 3);
  EXPECT_EQ(content("out/grains.csv"), table);
  EXPECT_TRUE(exists("out/b.urdf"));
  EXPECT_TRUE(exists("out/a.urdf")) << "its row was there, the file was not";
  for (const std::string part : {"1/2", "2/2"}) {
    ASSERT_LE(run("convex scans -o parts --format urdf --shard " + part + options).exit_code, 3);
  }
  ASSERT_EQ(run("convex scans -o parts --format urdf" + options).exit_code, 3);
  EXPECT_EQ(content("parts/grains.csv"), table);
  expect_refused("convex scans",
                 {{"-o parts.obj", 2, "one folder with -o"},
                  {"-o new --report r.html", 2, "Leave out --report"},
                  {"-o new --format stl", 2, "ends in .obj"},
                  {"-o out --format urdf -k 4", 2, "out/call.json"}},
                 {"parts.obj", "new"});
}

// Whether engines run the folder is tested by tests/run_all.sh engines.
TEST_F(ClumpProgram, AFolderForAnEngineHasWhatItNeeds) {
  write_sample();
  std::ofstream(path("curve.csv")) << "Sieves\nmm;%\n0,1;0\n0,3;100\n";
  const std::string call =
      "clump scans -k 2 -o out --size 0.2 --engine lammps --size-curve curve.csv";
  const Outcome outcome = run(call);
  ASSERT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "cd out && python3 run.py"));
  const std::string heading = "equivalent_diameter [length],finer_by_mass [%]\r\n";
  EXPECT_EQ(content("out/sizes.csv"), heading + "0.1,0\r\n0.3,100\r\n");
  EXPECT_TRUE(holds(content("out/run.py"), "import packing"));
  EXPECT_TRUE(exists("out/packing.py"));
  const std::string scene = content("out/scene.json");
  EXPECT_TRUE(holds(content("out/shapes.json"), "\"grain\": \"scans/b.ply\""));
  EXPECT_TRUE(holds(content("out/shapes.json"), "\"file\": \"b.csv\""));
  EXPECT_TRUE(holds(scene, "\"size\": 0.2"));
  EXPECT_TRUE(exists("out/b.csv"));
  EXPECT_TRUE(holds(scene, "\"density\": 2650.0"));
  ASSERT_EQ(run("clump scans -k 2 -o dense --engine lammps --density 1").exit_code, 3);
  EXPECT_TRUE(holds(content("dense/scene.json"), "\"density\": 1.0"));
  // A curve of an earlier call is not that of this one, unless it is given; both advices work.
  const std::string own_sizes = "clump scans -k 2 -o out --size 0.2 --engine lammps";
  expect_refused("", {{own_sizes, 2, "has a size curve, sizes.csv"}}, {});
  EXPECT_EQ(run(own_sizes + " --size-curve out/sizes.csv").exit_code, 3);
  EXPECT_EQ(content("out/sizes.csv"), heading + "0.1,0\r\n0.3,100\r\n");
  std::filesystem::remove(path("out/sizes.csv"));
  EXPECT_EQ(run(own_sizes).exit_code, 3);
  EXPECT_FALSE(exists("out/sizes.csv"));
  // What a person changed stays, and a grain that was added later is packed too.
  std::ofstream(path("out/scene.json")) << "{}";
  std::filesystem::copy(path("scans/b.ply"), path("scans/z.ply"));
  EXPECT_EQ(run(call).exit_code, 3);
  EXPECT_EQ(content("out/scene.json"), "{}");
  EXPECT_TRUE(holds(content("out/shapes.json"), "\"file\": \"z.csv\""));
  std::filesystem::remove(path("scans/z.ply"));
  // One scan is a sample too, and is named as in grains.csv; templates bring their weights and
  // sizes.
  std::filesystem::copy(path("scans/a.ply"), path("=a.ply"));
  ASSERT_EQ(run("convex =a.ply -k 1 -n 60 -q -o hull --engine yade").exit_code, 0);
  EXPECT_TRUE(exists("hull/=a.obj"));
  EXPECT_TRUE(holds(content("hull/grains.csv"), "\n'=a.ply,"));
  EXPECT_TRUE(holds(content("hull/shapes.json"), "\"grain\": \"'=a.ply\""));
  std::filesystem::remove(path("scans/torn.ply"));
  std::ofstream(path("scans/templates.csv")) << "file,weight_by_number\na.ply,0.3\nb.ply,0.7\n";
  std::ofstream(path("scans/sizes.csv"), std::ios::binary) << heading + "1,0\r\n2,100\r\n";
  ASSERT_EQ(run("convex scans -k 2 -n 60 -q -o parts --engine bullet").exit_code, 0);
  EXPECT_TRUE(exists("parts/bullet_settle.cpp"));
  EXPECT_EQ(content("parts/templates.csv"), content("scans/templates.csv"));
  EXPECT_EQ(content("parts/sizes.csv"), heading + "1,0\r\n2,100\r\n");
  // What a person wrote or changed is not replaced.
  std::ofstream(path("parts/run.py"), std::ios::app) << "# my settings\n";
  std::filesystem::create_directory(path("mine"));
  std::ofstream(path("mine/sizes.csv")) << "my sieves,%\n1,0\n2,100\n";
  expect_refused("",
                 {{"convex scans -k 2 -n 60 -o parts --engine bullet", 2, "rename it"},
                  {"clump scans -k 2 -o mine --engine yade", 2, "a sizes.csv of another"},
                  {"clump scans -k 2 -o scans --engine yade --scale 2", 2, "scaled too"}},
                 {"mine/run.py", "scans/run.py"});
  std::filesystem::rename(path("parts/run.py"), path("parts/my_run.py"));
  EXPECT_EQ(run("convex scans -k 2 -n 60 -q -o parts --engine bullet").exit_code, 0);
  // All lengths are scaled, and --size is the size of all grains.
  ASSERT_EQ(run("clump scans -k 2 -q -o large --engine yade --scale 1000").exit_code, 0);
  EXPECT_EQ(content("large/sizes.csv"), heading + "1000,0\r\n2000,100\r\n");
  // Other grains do not get these weights and sizes.
  const std::string other = "clump scans/a.ply -k 2 -q -o large --engine yade";
  expect_refused("", {{other, 2, "has weights of templates"}}, {});
  std::filesystem::remove(path("large/templates.csv"));
  expect_refused("", {{other, 2, "has a size curve"}}, {});
  ASSERT_EQ(run("clump scans -k 2 -q -o equal --engine yade --size 3").exit_code, 0);
  EXPECT_FALSE(exists("equal/sizes.csv"));
  // Level sets are the meshes, nodes and grids of a batch.
  ASSERT_EQ(run("batch scans -n 60 -q -o level --size 2 --sdf-spacing 0.2 --sdf npy --engine yade")
                .exit_code,
            0);
  EXPECT_TRUE(holds(content("level/shapes.json"), "\"file\": \"a.obj\""));
  for (const char* file : {"a.obj", "node-table/b.csv", "sdf/b.npy", "run.py", "packing.py",
                           "scene.json", "yade_level_sets.py", "templates.csv", "summary.html"}) {
    EXPECT_TRUE(exists(std::string("level/") + file)) << file;
  }
  EXPECT_TRUE(holds(content("level/sdf/a.npy.json"), "\"name\": \"principal\""));
  EXPECT_FALSE(exists("large/yade_level_sets.py"));
  expect_refused("batch scans -o new -n 60",
                 {{"--engine lammps", 2, "takes no level sets. Use wscvt clump"},
                  {"--engine yade -n 50,60", 2, "a single number of nodes"},
                  {"--engine yade --format ply", 2, "Leave out --format"},
                  {"--engine yade --frame centred", 2, "Leave out --frame"}},
                 {"new"});
  expect_refused("clump scans -o new",
                 {{"--engine mujoco", 2, "Use wscvt convex"},
                  {"--engine lamps", 2, "yade, lammps, liggghts"},
                  {"--engine yade --format py", 2, "Leave out --format"},
                  {"--engine yade --frame centred", 2, "Leave out --frame"},
                  {"--engine yade --size-curve scans/a.ply", 2, "a.ply"},
                  {"--size-curve curve.csv", 2, "Give --engine"}},
                 {"new"});
  ASSERT_EQ(run("convex scans -k 2 -n 60 -q -o rounded --engine rockable").exit_code, 0);
  EXPECT_TRUE(holds(content("rounded/shapes.json"), "\"file\": \"a.shp\""));
  EXPECT_TRUE(holds(content("rounded/a.shp"), "preCompDone y"));
  expect_refused("convex scans -o new",
                 {{"--engine yade", 2, "Give -k 1"},
                  {"--engine rockable --format obj", 2, "Leave out --format"}},
                 {"new"});
}

TEST_F(ClumpProgram, WrongCallsAreRefused) {
  write_sample();
  expect_refused("clump",
                 {{"scans/a.ply -o clump.stl", 2, "ends in .csv"},
                  {"scans/a.ply -o c.csv -k 0", 2, "1 to 1000"},
                  {"scans/a.ply", 2, "--output"},
                  {"scans -o clump.csv", 2, "one folder with -o"},
                  {"scans -o out --report r.html", 2, "Leave out --report"},
                  {"scans -o out --format stl", 2, "ends in .csv"},
                  {"scans/torn.ply -o c.csv", 1, "torn.ply"},
                  {"scans/a.ply -o c.csv --size 1 --scale 2", 2, "Give one of them"},
                  {"scans/a.ply -o c.molecule --density 0", 2, "The density is"},
                  {"scans/a.ply -o c.csv --shard 1/2", 2, "--shard is for several"},
                  {"scans/a.ply -o c.csv --format csv", 2, "--format is for several"}},
                 {"clump.stl", "c.csv", "c.molecule", "out"});
  expect_refused("convex scans/a.ply -o parts.obj",
                 {{"--shard 2/2", 2, "--shard is for several"},
                  {"--format urdf", 2, "the ending of --output selects the format"}},
                 {"parts.obj", "parts.urdf"});
}

}  // namespace
}  // namespace wscvt
