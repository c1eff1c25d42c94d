// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual grains by the program.

#include <string>
#include <vector>

#include "program_run.h"
#include "support/random_sample.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

class Grow : public test::ProgramRun {
 protected:
  void write_sample(int count) {
    fs::create_directory(path("real"));
    int k = 0;
    for (const HarmonicSurface& surface : test::random_surfaces(count, 6, 31)) {
      write_harmonics(path("real/g" + std::to_string(10 + k++) + ".json"), surface);
    }
  }
};

TEST_F(Grow, WritesMeshesAndATableThatThreadsDoNotChange) {
  write_sample(9);
  const std::string call = "grow real -n 12 --nodes 80 --degree 6 --seed 3";
  const Outcome outcome = run(call + " -o a -t 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  EXPECT_NE(outcome.output.find("12 virtual grains of 9 real ones (0 left out), 3 donors each"),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("Distance to the nearest real grain"), std::string::npos);
  EXPECT_NE(outcome.output.find("Collage"), std::string::npos);
  EXPECT_EQ(run(call + " -o b -t 2 -q").output, "");
  EXPECT_EQ(content("a/grown.csv"), content("b/grown.csv"));
  for (const char* file : {"grown-00001.ply", "grown-00012.ply"}) {
    EXPECT_EQ(content(std::string("a/") + file), content(std::string("b/") + file));
    EXPECT_EQ(read_mesh(path(std::string("a/") + file)).points.size(), 80U);
  }
  EXPECT_FALSE(exists("a/grown-00013.ply"));
  EXPECT_EQ(run("grow real -n 2 --nodes 80 --degree 6 --seed 4 -o c -q").exit_code, 0);
  EXPECT_NE(content("a/grown-00001.ply"), content("c/grown-00001.ply"));
}

TEST_F(Grow, ReadsScansAndLeavesOutWhatHasNoRadius) {
  fs::create_directory(path("scans"));
  int k = 0;
  for (const HarmonicSurface& surface : test::random_surfaces(8, 6, 32)) {
    write_mesh(mesh_of_surface(surface, 10, Execution(1)),
               path("scans/s" + std::to_string(k++) + ".stl"));
  }
  write_mesh(test::torus(3.0, 1.0, 24), path("scans/ring.stl"));
  const Outcome outcome = run("grow scans -n 3 --nodes 60 --degree 6 -o out --coefficients");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.errors.find("ring.stl"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.output.find("(1 left out)"), std::string::npos) << outcome.output;
  EXPECT_EQ(read_harmonics(path("out/grown-00003.json")).degree(), 6);
}

TEST_F(Grow, FollowsAGivenSizeCurve) {
  write_sample(8);
  std::ofstream(path("sizes.csv")) << "2,0\n4,100\n";
  ASSERT_EQ(run("grow real -n 9 --nodes 60 --degree 6 -o out --sizes sizes.csv").exit_code, 0);
  double least = 9.0, most = 0.0;
  for (int k = 1; k <= 9; ++k) {
    const IndexedMesh mesh = read_mesh(path("out/grown-0000" + std::to_string(k) + ".ply"));
    const double diameter = std::cbrt(6.0 / 3.14159265 * describe_shape(mesh, Execution(1)).volume);
    least = std::min(least, diameter);
    most = std::max(most, diameter);
  }
  EXPECT_GT(least, 2.0);
  EXPECT_LT(least, 2.15);
  EXPECT_GT(most, 2.9);
  EXPECT_LT(most, 4.0);
}

TEST_F(Grow, RefusesWrongCalls) {
  write_sample(7);
  expect_refused("grow",
                 {{"real -o out --degree 6", 1, "7 usable grains"},
                  {"real -o out --donors 1", 2, "donors"},
                  {"real -o out --degree 3", 2, "degree"},
                  {"real -o out --format xyz", 2, "format"},
                  {"none.ply -o out", 1, "none.ply"},
                  {"real", 2, "output"}},
                 {"out/grown.csv"});
}

}  // namespace
}  // namespace wscvt
