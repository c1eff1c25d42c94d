// SPDX-License-Identifier: GPL-3.0-or-later
// Templates of a sample by the program.

#include <string>
#include <vector>

#include "program_run.h"
#include "support/holds.h"
#include "support/random_sample.h"
#include "toolbox/sample/grain_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

class Templates : public test::ProgramRun {
 protected:
  void write_scans(int count) {
    fs::create_directory(path("scans"));
    int k = 0;
    for (const HarmonicSurface& surface : test::random_surfaces(count, 5, 51)) {
      write_mesh(mesh_of_surface(surface, 9, Execution(1)),
                 path("scans/s" + std::to_string(10 + k++) + ".stl"));
    }
  }
};

TEST_F(Templates, WritesMeshesAndTables) {
  write_scans(12);
  const Outcome outcome = run("grow --templates scans -k 4 -n 60 -o a --seed 2 -t 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(test::holds(outcome.output, "4 templates of 12 grains (0 left out), seed 2."));
  const GrainTable table = read_grain_table(path("a/templates.csv"));
  ASSERT_EQ(table.grains.size(), 4U);
  for (const char* weight : {"weight_by_number", "weight_by_mass"}) {
    EXPECT_NEAR(table.values.col(static_cast<Eigen::Index>(table.index_of(weight))).sum(), 1.0,
                1e-12);
  }
  for (const std::string& file : table.files) {
    const IndexedMesh mesh = read_mesh(path("a/" + file));
    EXPECT_EQ(mesh.points.size(), 60U);
    const ShapeDescriptors shape = describe_shape(mesh, Execution(1));
    EXPECT_NEAR(shape.volume, 3.14159265358979 / 6.0, 1e-9);
    EXPECT_LT(shape.centroid.norm(), 1e-9);
  }
  for (const char* file : {"a/sizes.csv", "a/distances.csv", "a/mercury_psd.csv"}) {
    EXPECT_TRUE(exists(file)) << file;
  }
  EXPECT_EQ(run("grow --templates scans -k 4 -n 60 -o b --seed 2 -t 2 -q").output, "");
  for (const char* file : {"templates.csv", "sizes.csv", "distances.csv", "template-04.ply"}) {
    EXPECT_EQ(content(std::string("a/") + file), content(std::string("b/") + file)) << file;
  }
  for (const std::string name : {"templates.csv", "sizes.csv", "distances.csv"}) {
    EXPECT_EQ(run("clump a/template-01.ply -k 2 -q -o a/" + name).exit_code, 2) << name;
    EXPECT_EQ(content("a/" + name), content("b/" + name));
  }
}

TEST_F(Templates, AreMadeInPartsToo) {
  write_scans(3);
  const std::string call = "grow --templates scans -k 2 -n 50 -q -o ";
  ASSERT_EQ(run(call + "whole").exit_code, 0);
  for (const std::string part : {"1/2", "2/2"}) {
    ASSERT_EQ(run(call + "parts --shard " + part).exit_code, 0);
    EXPECT_FALSE(exists("parts/sizes.csv"));
  }
  const auto written = fs::last_write_time(path("parts/template-01.ply"));
  ASSERT_EQ(run(call + "parts").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(path("parts/template-01.ply")), written) << "it was done";
  for (const std::string file : {"/templates.csv", "/sizes.csv", "/distances.csv"}) {
    EXPECT_EQ(content("parts" + file), content("whole" + file)) << file;
  }
  EXPECT_FALSE(exists("parts/call.json") || exists("parts/templates-1-of-2.csv"));
}

TEST_F(Templates, ReadsATableOfShapes) {
  write_scans(3);
  std::ofstream(path("shape.csv"))
      << "grain,file,scan.volume [length^3],scan.convexity,scan.roundness_wadell\r\n"
         "a,scans/s10.stl,8,0.9,0.5\r\nb,scans/s11.stl,1,0.8,0.3\r\nc,scans/s12.stl,27,0.7,\r\n";
  const Outcome outcome =
      run("grow --templates=convexity,roundness_wadell shape.csv -k 2 -n 50 -o out");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_TRUE(test::holds(outcome.output, "2 templates of 2 grains (1 left out)"));
  EXPECT_TRUE(test::holds(content("out/templates.csv"), "s10.stl,0.5,0.888"));
}

// The templates of a batch are remeshes of its scans, not of its remeshes, which have 50 nodes.
TEST_F(Templates, OfABatchsFolderAreMadeOfItsScans) {
  write_scans(4);
  ASSERT_EQ(run("batch scans -o batch -n 50 -q").exit_code, 0);
  ASSERT_EQ(run("grow --templates batch -k 2 -n 300 -o of_batch -q").exit_code, 0);
  const Outcome outcome = run("grow --templates scans -k 2 -n 300 -o of_scans -q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  for (const char* file : {"template-01.ply", "template-02.ply"}) {
    EXPECT_EQ(content(std::string("of_batch/") + file), content(std::string("of_scans/") + file))
        << file;
  }
}

TEST_F(Templates, OfABatchsFolderAreNotMadeOfOtherScans) {
  write_scans(4);
  ASSERT_EQ(run("batch scans -o batch -n 50 -q").exit_code, 0);
  // The same names in another place, or written anew.
  fs::copy_file(path("scans/s11.stl"), path("scans/s10.stl"), fs::copy_options::overwrite_existing);
  const Outcome outcome = run("grow --templates batch -k 4 -n 60 -o out");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(test::holds(outcome.errors, "\"scans/s10.stl\" has the volume ")) << outcome.errors;
  // What the sentence says works.
  EXPECT_EQ(run("grow --templates 'batch/*.ply' -k 4 -n 60 -o out -q").exit_code, 0);
  fs::remove(path("scans/s10.stl"));  // then the remesh is taken
  EXPECT_EQ(run("grow --templates batch -k 4 -n 60 -o out -q").exit_code, 0);
}

TEST_F(Templates, ReplaceNoScan) {
  write_scans(3);
  fs::rename(path("scans/s10.stl"), path("scans/template-02.stl"));
  const std::string before = content("scans/template-02.stl");
  expect_refused("grow --templates",
                 {{"scans -k 2 -n 60 -o scans --format stl", 2,
                   "would replace the scan \"scans/template-02.stl\""}},
                 {"scans/templates.csv", "scans/template-01.stl", "scans/call.json"});
  EXPECT_EQ(content("scans/template-02.stl"), before);
  std::ofstream(path("scans/sizes.csv")) << "my sieves,%\n";
  expect_refused("grow --templates", {{"scans -k 2 -n 60 -o scans", 1, "a sizes.csv of another"}},
                 {"scans/templates.csv"});
}

TEST_F(Templates, RefusesWrongCalls) {
  write_scans(3);
  std::ofstream(path("same.csv")) << "file,volume,convexity\na.ply,1,0.9\nb.ply,2,0.9\n";
  expect_refused("grow --templates",
                 {{"scans -k 4 -o out", 1, "3 grains"},
                  {"scans/s10.stl -k 1 -o out", 1, "one grain, so there is nothing to choose"},
                  {"scans/s10.stl -o out", 1, "Give at least two grains"},
                  {"scans -k 0 -o out", 2, "number of grains"},
                  {"scans -k 2 -o out --format xyz", 2, "format"},
                  {"scans -k 1001 -o out", 2, "templates"},
                  {"scans -k 2 -o out --size-curve s.csv", 2, "Leave out --size-curve"},
                  {"none.csv -k 2 -o out", 1, "none.csv"}},
                 {"out"});
  expect_refused("grow",
                 {{"scans -k 2 -o out --templates=volume,nonsense", 1, "nonsense"},
                  {"scans -k 2 -o out --templates=convexity,,volume", 1, "\"\""},
                  {"same.csv -k 1 -o out --templates=convexity", 1, "\"convexity\" is equal"}},
                 {"out"});
}

}  // namespace
}  // namespace wscvt
