// SPDX-License-Identifier: GPL-3.0-or-later
// The program on a mesh of several bodies.

#include <fstream>
#include <string>
#include <vector>

#include "program_run.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

class Bodies : public test::ProgramRun {
 protected:
  /// A ball with a pore, a crumb, and a smaller ball; as STL, whose corners are points each.
  void write_sample() {
    IndexedMesh mesh = test::moved(test::sphere(3), 5.0, {1, 2, 3});
    mesh = test::joined(mesh, test::moved(test::sphere(1), 0.25, {9, 9, 9}));
    mesh = test::joined(mesh, test::moved(test::sphere(2), 1.0, {2, 2, 3}));
    mesh = test::joined(mesh, test::moved(test::sphere(3), 4.0, {-12, 2, 3}));
    write_mesh(mesh, path("sample.stl"));
  }

  static double volume(const std::string& file) {
    return describe_shape(read_mesh(file), Execution(1)).volume;
  }
};

TEST_F(Bodies, WritesAFileABodyAndATable) {
  write_sample();
  const Outcome outcome = run("extract sample.stl out --smallest 1% --format off");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.rfind("3 bodies: 2 written, 1 too small, 1 pore in them\n"
                                 "Files       \"out\"\nTime        ",
                                 0),
            0U)
      << outcome.output;
  EXPECT_EQ(outcome.errors, "");
  const auto rows = test::csv_records(content("out/bodies.csv"));
  ASSERT_EQ(rows.size(), 4U);
  const std::vector<std::string> first = rows[1];
  EXPECT_EQ((std::vector<std::string>{first[0], first[1], first[3], first[5], first[14]}),
            (std::vector<std::string>{"1", "written", "1", "0", "1.off"}));
  EXPECT_EQ(rows[2][1], "too small");
  EXPECT_EQ(rows[2][14], "");
  EXPECT_EQ(rows[3][14], "3.off");
  EXPECT_NEAR(std::stod(rows[3][6]), -16.0, 1e-5);
  EXPECT_FALSE(exists("out/2.off"));
  // Single precision.
  EXPECT_NEAR(volume(path("out/1.off")), std::stod(first[2]) - std::stod(first[4]), 1e-3);
  EXPECT_NEAR(volume(path("out/3.off")) / std::stod(rows[3][2]), 1.0, 1e-6);
  EXPECT_NEAR(std::stod(rows[3][2]) / std::stod(first[2]), 0.512, 1e-5);
  // Welded.
  EXPECT_EQ(read_mesh(path("out/3.off")).points.size(), test::sphere(3).points.size());
}

// A refused mesh is split as its message says, in whatever format it is.
TEST_F(Bodies, SplitsWhatRemeshRefuses) {
  const IndexedMesh two =
      test::joined(test::sphere(3), test::moved(test::sphere(3), 1.0, {3, 0, 0}));
  for (const std::string ending : {"ply", "inp", "vtu", "msh"}) {
    const std::string name = "two." + ending;
    write_mesh(two, path(name));
    const Outcome refused = run("remesh " + name + " out.ply");
    EXPECT_TRUE(holds(refused.errors, "wscvt extract MESH OUT")) << ending;
    const Outcome outcome = run("extract " + name + " " + ending);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output.rfind("2 bodies: 2 written\n", 0), 0U) << outcome.output;
  }
}

TEST_F(Bodies, NamesBodiesAndOnlyListsOpenOnes) {
  IndexedMesh open = test::moved(test::sphere(2), 1.0, {9, 0, 0});
  open.triangles.pop_back();
  std::ofstream obj(path("named.obj"));
  std::size_t first = 1;
  for (const auto& [name, mesh] :
       {std::pair<std::string, IndexedMesh>("grain_11", test::box(2, 2, 2)),
        {"grain \"12\"", test::moved(test::box(2, 2, 2), 1.0, {2, 0, 0})},
        {"torn", open}}) {
    obj << "o " << name << "\n";
    for (const Vector3& p : mesh.points) obj << "v " << p.transpose() << "\n";
    for (const Triangle& t : mesh.triangles) {
      obj << "f " << t[0] + first << " " << t[1] + first << " " << t[2] + first << "\n";
    }
    first += mesh.points.size();
  }
  obj.close();
  const Outcome outcome = run("extract named.obj out");
  EXPECT_EQ(outcome.output.rfind("3 bodies: 2 written, 1 open and only listed\n", 0), 0U)
      << outcome.output << outcome.errors;
  // Most of the faces are not written.
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(holds(outcome.errors, "of the faces. They are only listed"));
  const auto rows = test::csv_records(content("out/bodies.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].back(), "name");
  EXPECT_EQ(rows[1].back(), "grain_11");
  EXPECT_EQ(rows[2].back(), "grain \"12\"");
  EXPECT_EQ(rows[3].back(), "torn");
  EXPECT_EQ(rows[3][1], "open");
  EXPECT_EQ(rows[3][14], "");
  EXPECT_FALSE(exists("out/3.ply"));
  EXPECT_NEAR(volume(path("out/2.ply")), 8.0, 1e-12);
  // One of two that touch is not taken for a grain, and the advice is followed.
  write_mesh(test::joined(test::box(2, 2, 2), test::moved(test::box(2, 2, 2), 1.0, {2, 0, 0})),
             path("touching.stl"));
  const Outcome whole = run("remesh touching.stl whole.ply -n 60");
  EXPECT_EQ(whole.exit_code, 1);
  EXPECT_TRUE(holds(whole.errors, "2 bodies with common walls"));
  EXPECT_EQ(run("batch touching.stl -o apart -n 60 --parts").exit_code, 0);
  EXPECT_NEAR(volume(path("apart/1.ply")), 8.0, 1e-9);
  EXPECT_NEAR(volume(path("apart/2.ply")), 8.0, 1e-9);
}

TEST_F(Bodies, SaysWhichCommandTakesAnotherInput) {
  write_sample();
  fs::create_directory(path("scans"));
  write_mesh(test::sphere(2), path("scans/a.ply"));
  std::ofstream(path("volume.vtk"))
      << "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n";
  expect_refused("remesh",
                 {{"volume.vtk o.ply", 2, "wscvt batch VOLUME -o OUT"},
                  {"scans o.ply", 2, "wscvt batch FOLDER -o OUT"},
                  {"nothere o.ply", 2, "does not exist"}},
                 {"o.ply"});
  expect_refused("describe", {{"scans", 2, "wscvt batch FOLDER -o OUT"}}, {});
  expect_refused("grow", {{"volume.vtk -o out", 2, "wscvt extract VOLUME OUT"}}, {});
  fs::create_directory(path("ct.zarr"));
  std::ofstream(path("ct.zarr/.zarray")) << "{}";
  const std::string way = "numpy.save(\"labels.npy\", zarr.open(";
  for (const char* command : {"batch", "clump", "convex", "fragment", "grow"}) {
    expect_refused(command, {{"ct.zarr -o out", 1, way}}, {});
  }
  expect_refused("remesh", {{"ct.zarr o.ply", 1, way}}, {"o.ply"});
  expect_refused("describe",
                 {{"ct.zarr", 1, way},
                  {"volume.vtk scans/a.ply --parts -o out", 2, "wscvt batch VOLUME -o OUT"},
                  {"scans/a.ply volume.vtk --parts", 2, "wscvt batch VOLUME -o OUT"}},
                 {"out"});
  expect_refused("sample", {{"ct.zarr", 1, way}, {"volume.vtk", 2, "wscvt batch VOLUME -o OUT"}},
                 {});
  expect_refused("batch", {{"nothere -o out", 2, "There is no file and no folder"}},
                 {"out/grains.csv"});
  expect_refused("sample", {{"/dev/zero", 1, "is a folder or a device"}}, {});
}

TEST_F(Bodies, IsDoneByABatchToo) {
  write_sample();
  write_mesh(test::sphere(3), path("alone.ply"));
  const Outcome outcome = run("batch sample.stl alone.ply no.ply -o out -n 60 --parts");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "sample.stl: 3 bodies\n"));
  const auto rows = test::csv_records(content("out/grains.csv"));
  ASSERT_EQ(rows.size(), 6U);
  const std::vector<std::string> names = {"sample.stl/1", "sample.stl/2", "sample.stl/3",
                                          "alone.ply", "no.ply"};
  for (std::size_t k = 0; k < names.size(); ++k) EXPECT_EQ(rows[k + 1][0], names[k]);
  EXPECT_EQ(rows[3][1], "done");
  EXPECT_EQ(rows[5][1], "failed");
  EXPECT_EQ(read_mesh(path("out/3.ply")).points.size(), 60U);
  EXPECT_NEAR(volume(path("out/3.ply")) / volume(path("out/1.ply")), 0.512, 1e-5);
  EXPECT_EQ(read_mesh(path("out/alone.ply")).points.size(), 60U);
  // Without it the bodies are one input, which is refused with what to call.
  const Outcome whole = run("remesh sample.stl whole.ply -n 60");
  EXPECT_EQ(whole.exit_code, 1);
  EXPECT_TRUE(holds(whole.errors, "wscvt extract MESH OUT"));
}

// Endings that scans, tables and volumes share are told apart by what they hold, or by being named.
TEST_F(Bodies, ABatchTellsMeshesFromTablesAndVolumesInAFolder) {
  fs::create_directory(path("scans"));
  const IndexedMesh body = test::scaled(test::sphere(3), Vector3(3, 4, 5));
  write_mesh(body, path("scans/mesh.vtk"));
  std::ofstream(path("scans/table.csv")) << "grain,status\n";
  std::ofstream(path("scans/volume.vtk"))
      << "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n";
  EXPECT_EQ(run("batch scans -o out -n 40 --format ascii.stl").exit_code, 0);
  EXPECT_EQ(test::csv_records(content("out/grains.csv")).size(), 2U);
  EXPECT_EQ(content("out/mesh.ascii.stl").rfind("solid grain\n", 0), 0U);
  // Points have to be named, and asked for.
  std::ofstream points(path("points.csv"));
  points << "x,y,z\n";
  for (const Vector3& p : body.points) points << p.x() << "," << p.y() << "," << p.z() << "\n";
  points.close();
  const Outcome plain = run("remesh points.csv remesh.msh -n 40");
  EXPECT_EQ(plain.exit_code, 1);
  EXPECT_TRUE(holds(plain.errors, "--points"));
  EXPECT_EQ(run("remesh points.csv remesh.msh -n 40 --points").exit_code, 0);
  EXPECT_EQ(content("remesh.msh").rfind("$MeshFormat\n4.1 0 8\n", 0), 0U);
}

TEST_F(Bodies, AreExtractedOnAfterAnInterruptionAndInParts) {
  write_sample();
  ASSERT_EQ(run("extract sample.stl out -q").exit_code, 0);
  const std::string bodies = content("out/bodies.csv");
  EXPECT_FALSE(exists("out/grains.csv") || exists("out/call.json")) << "only results stay";
  for (const std::string part : {"1/2", "2/2"}) {
    ASSERT_EQ(run("extract sample.stl parts -q --shard " + part).exit_code, 0);
    EXPECT_FALSE(exists("parts/bodies.csv"));
  }
  // A row that is cut, as by a kill, is made again, and only this.
  std::string cut;
  for (const std::string part : {"1", "2"}) {
    const std::string table = "parts/grains-" + part + "-of-2.csv";
    const std::size_t row = content(table).find("sample.stl/2");
    if (row == std::string::npos) continue;
    fs::resize_file(path(table), row + 20);
    cut = part;
  }
  ASSERT_NE(cut, "");
  const auto written = fs::last_write_time(path("parts/1.ply"));
  fs::remove(path("parts/2.ply"));
  ASSERT_EQ(run("extract sample.stl parts -q --shard " + cut + "/2").exit_code, 0);
  EXPECT_TRUE(exists("parts/2.ply"));
  ASSERT_EQ(run("extract sample.stl parts -q").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(path("parts/1.ply")), written) << "it was done";
  EXPECT_EQ(content("parts/bodies.csv"), bodies);
  EXPECT_FALSE(exists("parts/grains-1-of-2.csv") || exists("parts/call-2-of-2.json"));
  // Without parts all is made anew, and with other options too.
  ASSERT_EQ(run("extract sample.stl parts -q").exit_code, 0);
  EXPECT_EQ(content("parts/1.ply"), content("out/1.ply"));
  EXPECT_EQ(run("extract sample.stl out -q --format stl").exit_code, 0);
}

TEST_F(Bodies, OfTwoMeshesHaveFilesOfTheirOwn) {
  write_sample();
  fs::copy_file(path("sample.stl"), path("other.stl"));
  ASSERT_EQ(run("batch sample.stl other.stl -o out -n 60 -q --parts").exit_code, 0);
  EXPECT_FALSE(exists("out/1.ply"));
  EXPECT_NE(content("out/sample-3.ply"), "");
  EXPECT_EQ(content("out/sample-3.ply"), content("out/other-3.ply"));
}

TEST_F(Bodies, RefusesWhatMakesNoSense) {
  write_sample();
  expect_refused("extract",
                 {{"", 2, "input is required"},
                  {"sample.stl", 2, "output is required"},
                  {"sample.xyzzy out", 2, "ending of a volume"},
                  {"no.stl out", 1, "no.stl"},
                  {"sample.stl sample.stl", 2, "is the input itself"},
                  {"sample.stl out --format step", 2, "The format of the meshes"},
                  {"sample.stl out --smallest 10", 2, "Give a %: --smallest 0.1%"},
                  {"sample.stl out --smallest 101%", 2, "0 to 100"}},
                 {"out/1.ply"});
  // Nor is a batch begun with a file of no known format.
  expect_refused("batch", {{"sample.stl more.xyzzy -o out", 2, "There is no file and no folder"}},
                 {"out/grains.csv"});
  fs::create_directory(path("in"));
  fs::rename(path("sample.stl"), path("in/1.stl"));
  for (const std::string call :
       {"extract in/1.stl in --format stl", "batch in/1.stl -o in --format stl -n 60 --parts"}) {
    const Outcome refused = run(call);
    EXPECT_EQ(refused.exit_code, 2) << call;
    EXPECT_TRUE(holds(refused.errors, "would replace the scan"));
    EXPECT_FALSE(exists("in/3.stl"));
  }
}

}  // namespace
}  // namespace wscvt
