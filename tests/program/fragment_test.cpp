// SPDX-License-Identifier: GPL-3.0-or-later
// The program divides a grain into fragments.

#include <fstream>
#include <string>
#include <vector>

#include "program_run.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

using test::holds;

class FragmentCommand : public test::ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    write_mesh(grain, path("grain.ply"));
  }
  double number(const std::vector<std::string>& row, std::size_t column) const {
    return std::stod(row.at(column));
  }

  const IndexedMesh grain = test::moved(test::lumpy(3), 2.0, Vector3(10.0, 0.0, -4.0));
};

TEST_F(FragmentCommand, WritesFragmentsAndTheirTables) {
  const Outcome outcome = run("fragment grain.ply -k 6 -o deep/out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.rfind("Fragments: 6, volumes ", 0), 0U) << outcome.output;
  EXPECT_TRUE(holds(outcome.output, "\nFiles       \"deep/out\"\nTime        "));
  const auto rows = test::csv_records(content("deep/out/fragments.csv"));
  ASSERT_EQ(rows.size(), 7U);
  double sum = 0.0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k][0], std::to_string(k));
    const IndexedMesh mesh = read_mesh(path("deep/out/" + rows[k][1]));
    EXPECT_EQ(test::bad_edges(mesh), 0U);
    EXPECT_NEAR(volume_of(mesh, Execution(1)) / number(rows[k], 2), 1.0, 1e-9);
    sum += number(rows[k], 2);
  }
  EXPECT_NEAR(sum / volume_of(grain, Execution(1)), 1.0, 1e-11);
  const auto contacts = test::csv_records(content("deep/out/contacts.csv"));
  EXPECT_EQ(contacts[0],
            (std::vector<std::string>{"first", "second", "area", "x", "y", "z", "nx", "ny", "nz"}));
  double twice = 0.0;
  double walls = 0.0;
  for (std::size_t k = 1; k < contacts.size(); ++k) twice += 2.0 * number(contacts[k], 2);
  for (std::size_t k = 1; k < rows.size(); ++k) walls += number(rows[k], 11);
  EXPECT_NEAR(twice / walls, 1.0, 1e-12);
}

TEST_F(FragmentCommand, WritesTheFormatsOfEngines) {
  EXPECT_EQ(run("fragment grain.ply -k 3 -o out --format urdf --density 2650").exit_code, 0);
  EXPECT_TRUE(exists("out/fragment_3.urdf"));
  EXPECT_TRUE(exists("out/fragment_3_1.obj"));
  EXPECT_EQ(run("fragment grain.ply -k 3 -o out --format xml").exit_code, 0);
  EXPECT_TRUE(holds(content("out/fragment_2.xml"), "freejoint"));
  write_mesh(test::moved(grain, 1e-3, Vector3::Zero()), path("metres.ply"));
  EXPECT_TRUE(holds(run("fragment metres.ply -k 3 -o metres --format xml").errors,
                    "multiply the grain's coordinates by 1000, set --density 1e-09"));
  const Outcome rounded = run("fragment grain.ply -k 3 -o out --format shp -n 80");
  EXPECT_EQ(rounded.exit_code, 0);
  EXPECT_TRUE(holds(rounded.output, "Rounded for Rockable by "));
  const std::string shape = content("out/fragment_1.shp");
  EXPECT_TRUE(holds(shape, "name fragment_1\n"));
  const std::size_t nodes = std::stoul(shape.substr(shape.find("nv ") + 3));
  EXPECT_NEAR(static_cast<double>(nodes), 80.0, 20.0) << "about the nodes";
}

TEST_F(FragmentCommand, LeavesNoFragmentOfAnEarlierCall) {
  ASSERT_EQ(run("fragment grain.ply -k 5 -o out").exit_code, 0);
  ASSERT_EQ(run("fragment grain.ply -k 3 -o out --format off").exit_code, 0);
  const Outcome outcome = run("fragment grain.ply -k 3 -o out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_FALSE(exists("out/fragment_4.ply"));
  EXPECT_TRUE(exists("out/fragment_3.ply"));
  EXPECT_TRUE(exists("out/fragment_3.off"));
  ASSERT_EQ(run("fragment grain.ply -k 3 -o out --format urdf").exit_code, 0);
  EXPECT_TRUE(exists("out/fragment_3.ply")) << "the same in another format";
  ASSERT_EQ(run("fragment grain.ply -k 3 --seed 2 -o out").exit_code, 0);
  for (const char* old : {"out/fragment_1.urdf", "out/fragment_1_1.obj", "out/fragment_3_1.obj"}) {
    EXPECT_FALSE(exists(old)) << old << " is of another division";
  }
  std::ofstream(path("out/contacts.csv")) << "mine\n";
  EXPECT_TRUE(
      holds(run("fragment grain.ply -k 2 -o out").errors, "a contacts.csv of another command"));
  EXPECT_EQ(content("out/contacts.csv"), "mine\n");
  EXPECT_TRUE(exists("out/fragment_3.ply"));
}

TEST_F(FragmentCommand, ReplacesNoFragmentsOfAnotherGrain) {
  IndexedMesh other = grain;
  for (Vector3& point : other.points) point.x() *= 1.01;
  write_mesh(other, path("other.ply"));
  write_mesh(grain, path("same.stl"));
  ASSERT_EQ(run("fragment grain.ply -k 4 -o out -n 60 -q").exit_code, 0);
  const std::string table = content("out/fragments.csv");
  const std::string mesh = content("out/fragment_1.ply");
  const Outcome outcome = run("fragment other.ply -k 2 -o out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(holds(outcome.errors, "\"out\" has the fragments of another grain"));
  for (const std::string name : {"out/fragments.csv", "out/contacts.csv"}) {
    EXPECT_EQ(run("clump grain.ply -k 2 -q -o " + name).exit_code, 2) << name;
  }
  EXPECT_EQ(content("out/fragments.csv"), table);
  EXPECT_EQ(content("out/fragment_1.ply"), mesh);
  EXPECT_TRUE(exists("out/fragment_4.ply"));
  EXPECT_EQ(run("fragment same.stl -k 2 -o out -q").exit_code, 0) << "another file of the grain";
  EXPECT_FALSE(exists("out/fragment_4.ply"));
}

TEST_F(FragmentCommand, RemeshesWithCommonWalls) {
  const Outcome outcome = run("fragment grain.ply -k 4 -o out -n 100");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "4 fragments with "));
  const auto rows = test::csv_records(content("out/fragments.csv"));
  double sum = 0.0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const IndexedMesh mesh = read_mesh(path("out/" + rows[k][1]));
    EXPECT_EQ(test::bad_edges(mesh), 0U);
    EXPECT_NEAR(static_cast<double>(mesh.points.size()), 100.0, 20.0);
    sum += number(rows[k], 2);
  }
  EXPECT_NEAR(sum / volume_of(grain, Execution(1)), 1.0, 1e-11);
}

TEST_F(FragmentCommand, FollowsASizeCurve) {
  std::ofstream(path("curve.csv")) << "1,0\n3,100\n";
  EXPECT_EQ(run("fragment grain.ply -k 12 -o out --size-curve curve.csv").exit_code, 0);
  const auto rows = test::csv_records(content("out/fragments.csv"));
  ASSERT_EQ(rows.size(), 13U);
  // Fractions by number run with d^-3 from 1 to 3: (1 - (k + .5) / 12 * 26 / 27)^-1 are volumes.
  for (std::size_t k = 2; k < rows.size(); ++k) {
    const auto wanted = [](std::size_t row) {
      return 1.0 / (1.0 - (static_cast<double>(row) - 0.5) / 12.0 * 26.0 / 27.0);
    };
    EXPECT_NEAR(number(rows[k], 2) / number(rows[1], 2) / (wanted(k) / wanted(1)), 1.0, 3e-3);
  }
}

TEST_F(FragmentCommand, IsRefusedAndLeavesFilesAsTheyWere) {
  std::ofstream(path("curve.csv")) << "1,0\n3,90\n";
  IndexedMesh open = grain;
  open.triangles.resize(open.triangles.size() / 2);
  write_mesh(open, path("open.ply"));
  write_mesh(grain, path("fragment_2.ply"));
  write_mesh(grain, path("fragment_1_1.obj"));
  const std::string before = content("fragment_2.ply");
  const std::string part = content("fragment_1_1.obj");
  expect_refused("fragment",
                 {{"grain.ply -k 0 -o out", 2, "from 1 to 1000"},
                  {"grain.ply -k 1001 -o out", 2, "from 1 to 1000"},
                  {"grain.ply -k 3", 2, "--output"},
                  {"grain.ply -k 3 -o out --near 1,2", 2, "is not a point"},
                  {"grain.ply -k 3 -o out -n 100 --edge-length 1", 2, "not both"},
                  {"grain.ply -k 3 -o out -n -1", 2, "nodes"},
                  {"grain.ply -k 3 -o out --near 1,2,3x", 2, "is not a point"},
                  {"grain.ply -k 3 -o out --size-curve curve.csv", 2, "at 100 %"},
                  {"grain.ply -k 3 -o out --format tif", 2, "Rockable"},
                  {"grain.ply -k 3 -o out --density 0", 2, "ensity"},
                  {"fragment_2.ply -k 3 -o .", 2, "is the grain itself"},
                  {"fragment_1_1.obj -k 3 -o . --format urdf", 2, "is the grain itself"},
                  {"absent.ply -k 3 -o out", 1, "absent.ply"},
                  {"open.ply -k 3 -o out", 1, ""}},
                 {"out", "fragment_1.ply", "fragments.csv"});
  EXPECT_EQ(content("fragment_2.ply"), before);
  EXPECT_EQ(content("fragment_1_1.obj"), part);
}

}  // namespace
}  // namespace wscvt
