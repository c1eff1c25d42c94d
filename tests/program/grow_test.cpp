// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual grains by the program.

#include <string>
#include <variant>
#include <vector>

#include "grains/bent_grain.h"
#include "program_run.h"
#include "support/holds.h"
#include "support/random_sample.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

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
  const std::string call = "grow real -k 12 -n 80 --degree 6 --seed 3";
  const Outcome outcome = run(call + " -o a -t 1");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  EXPECT_TRUE(
      holds(outcome.output, "12 virtual grains of 9 real ones (0 left out), 3 donors each"));
  EXPECT_TRUE(holds(outcome.output, "Distance to the nearest real grain"));
  EXPECT_TRUE(holds(outcome.output, "Collage"));
  EXPECT_EQ(run(call + " -o b -t 2 -q").output, "");
  EXPECT_EQ(content("a/grown.csv"), content("b/grown.csv"));
  for (const char* file : {"grown-00001.ply", "grown-00012.ply"}) {
    EXPECT_EQ(content(std::string("a/") + file), content(std::string("b/") + file));
    EXPECT_EQ(read_mesh(path(std::string("a/") + file)).points.size(), 80U);
  }
  EXPECT_FALSE(exists("a/grown-00013.ply"));
  EXPECT_EQ(run("grow real -k 2 -n 80 --degree 6 --seed 4 -o c -q").exit_code, 0);
  EXPECT_NE(content("a/grown-00001.ply"), content("c/grown-00001.ply"));
}

TEST_F(Grow, GoesOnAfterAnInterruptionAndInParts) {
  write_sample(9);
  const std::string call = "grow real -k 6 -n 60 --degree 6 -o ";
  const Outcome whole = run(call + "whole");
  ASSERT_EQ(whole.exit_code, 0) << whole.errors;
  const std::string table = content("whole/grown.csv");
  EXPECT_FALSE(exists("whole/call.json")) << "only results stay";
  for (const std::string part : {"1/2", "2/2"}) {
    ASSERT_EQ(run(call + "parts -q --shard " + part).exit_code, 0);
  }
  const std::string first = content("parts/grown-1-of-2.csv");
  const std::size_t end = first.find("\r\ngrown-") + 2;
  fs::resize_file(path("parts/grown-1-of-2.csv"), end + 20);  // as by a kill
  for (int k = 1; k <= 6; ++k) fs::remove(path("parts/grown-0000" + std::to_string(k) + ".ply"));
  ASSERT_EQ(run(call + "parts -q --shard 1/2").exit_code, 0);
  EXPECT_EQ(content("parts/grown-1-of-2.csv"), first);
  const std::string made = first.substr(end, 11) + ".ply";
  EXPECT_EQ(content("parts/" + made), content("whole/" + made));
  const Outcome joined = run(call + "parts");
  const auto statistics = [](const std::string& log) { return log.substr(0, log.find("Files ")); };
  EXPECT_EQ(statistics(joined.output), statistics(whole.output))
      << "also of the grains that were made before";
  EXPECT_EQ(content("parts/grown.csv"), table);
  EXPECT_FALSE(exists("parts/call.json") || exists("parts/grown-2-of-2.csv"));
  EXPECT_EQ(run("grow real -k 6 -n 60 --degree 7 -o parts -q").exit_code, 0);
  EXPECT_NE(content("parts/grown.csv"), table);
}

TEST_F(Grow, ReadsScansAndLeavesOutWhatHasNoRadius) {
  fs::create_directory(path("scans"));
  int k = 0;
  for (const HarmonicSurface& surface : test::random_surfaces(8, 6, 32)) {
    write_mesh(mesh_of_surface(surface, 10, Execution(1)),
               path("scans/s" + std::to_string(k++) + ".stl"));
  }
  write_mesh(test::torus(3.0, 1.0, 24), path("scans/ring.stl"));
  const Outcome outcome = run("grow scans -k 3 -n 60 --degree 6 -o out --format json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(holds(outcome.errors, "ring.stl"));
  EXPECT_TRUE(holds(outcome.output, "(1 left out)"));
  EXPECT_EQ(std::get<HarmonicSurface>(read_harmonics(path("out/grown-00003.json"))).degree(), 6);
}

// A C has overhangs, which the star-shaped grains beside it have not.
TEST_F(Grow, TakesScansThatRaysDoNotSeeWhole) {
  write_sample(6);
  for (int k = 0; k < 3; ++k) {
    const Vector3 stretch(1.0 + 0.1 * k, 1.0, 1.1 - 0.1 * k);
    const IndexedMesh scan = test::bent_grain_mesh(test::bent_grain("C-shape"), 900);
    write_mesh(test::scaled(scan, stretch), path("c" + std::to_string(k) + ".ply"));
  }
  const std::string call = "grow real 'c*.ply' -k 9 -n 150 --degree 12";
  const Outcome outcome = run(call + " -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(holds(outcome.output, "Overhang fraction, mean: "));
  EXPECT_EQ(run(call + " -o series --format json -q").exit_code, 0);
  std::size_t bent = 0;
  for (int k = 1; k <= 9; ++k) {
    const std::string name = "grown-0000" + std::to_string(k);
    const IndexedMesh mesh = read_mesh(path("out/" + name + ".ply"));
    EXPECT_EQ(mesh.points.size(), 150U);
    EXPECT_TRUE(self_intersections(mesh).empty()) << name;
    const HarmonicShape shape = read_harmonics(path("series/" + name + ".json"));
    const auto* const map = std::get_if<HarmonicMap>(&shape);
    if (map == nullptr) continue;
    ++bent;
    EXPECT_NEAR(volume_of(mesh_of_surface(*map, 24, Execution(1)), Execution(1)) /
                    volume_of(mesh, Execution(1)),
                1.0, 0.15);
  }
  EXPECT_GE(bent, 3U);
  // The series of a grain with overhangs is a grain of a sample itself.
  EXPECT_EQ(run("grow series -k 2 -n 150 --degree 8 -o again -q").exit_code, 0);
  EXPECT_EQ(run("grow series --templates -k 3 -n 50 -o chosen -q").exit_code, 0);
}

TEST_F(Grow, FollowsAGivenSizeCurve) {
  write_sample(8);
  std::ofstream(path("sizes.csv")) << "2,0\n4,100\n";
  ASSERT_EQ(run("grow real -k 9 -n 60 --degree 6 -o out --size-curve sizes.csv").exit_code, 0);
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

TEST_F(Grow, ReplacesNoRealGrain) {
  write_sample(8);
  fs::rename(path("real/g10.json"), path("real/grown-00001.json"));
  fs::create_directory_symlink("real", path("link"));
  const std::string before = content("real/grown-00001.json");
  expect_refused("grow",
                 {{"real -o real -k 2 --degree 6 --format json", 2,
                   "would replace the scan \"real/grown-00001.json\""},
                  {"real -o link -k 2 --degree 6 --format json", 2, "would replace the scan"}},
                 {"real/grown.csv", "real/call.json"});
  EXPECT_EQ(content("real/grown-00001.json"), before);
  const Outcome other = run("grow real -o real -k 2 --degree 6 -n 60");
  EXPECT_EQ(other.exit_code, 0) << other.errors << "another format";
}

TEST_F(Grow, RefusesWrongCalls) {
  write_sample(7);
  expect_refused("grow",
                 {{"real -o out --degree 6", 1, "7 usable grains"},
                  {"real -o out --degree 3", 2, "degree"},
                  {"real -o out --format xyz", 2, "format"},
                  {"none.ply -o out", 1, "none.ply"},
                  {"real -o deep/down/out --degree 6", 1, "7 usable grains"},
                  {"real", 2, "output"}},
                 {"out", "deep"});
}

}  // namespace
}  // namespace wscvt
