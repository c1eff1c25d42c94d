// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the tutorials lib/doc/sample.md and lib/doc/grow.md.
#include <regex>
#include <sstream>
#include <string>

#include "program_run.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

class Tutorial : public test::ProgramRun {
 protected:
  /// Runs the lines of a document of lib/doc that begin with the program; gives their number. If
  /// `small`, they make clumps of 2 spheres, 12 grains, and meshes of 40 nodes.
  int run_commands(const std::string& document, bool small) {
    std::ostringstream text;
    text << std::ifstream(fs::path(WSCVT_MESHES_DIR).parent_path() / "lib/doc" / document).rdbuf();
    std::istringstream lines(text.str());
    int commands = 0;
    const std::string program = "    wscvt ";
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(program, 0) != 0) continue;
      ++commands;
      if (small) {
        line = std::regex_replace(line, std::regex("-k 12"), "-k 2");
        line = std::regex_replace(line, std::regex("-k 500"), "-k 12");
        line = std::regex_replace(line, std::regex("-n 300"), "-n 40");
      }
      const Outcome outcome = run(line.substr(program.size()));
      EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.errors;
      EXPECT_EQ(outcome.errors, "") << line;
    }
    return commands;
  }

  void write_scans(int count) {
    fs::create_directory(folder_ / "scans");
    for (int k = 0; k < count; ++k) {
      const Vector3 axes(1.0 + 0.03 * k, 0.9 - 0.01 * k, 0.6 + 0.001 * k * k);
      IndexedMesh scan = test::transformed(test::sphere(2), axes.asDiagonal());
      for (Vector3& point : scan.points) point *= 1.0 + 0.1 * std::sin(3.0 * point.x() + k);
      write_mesh(scan, path("scans/" + std::to_string(k) + ".ply"));
    }
  }
};

TEST_F(Tutorial, OfSamplesRunsWordForWord) {
  write_scans(4);
  EXPECT_GE(run_commands("sample.md", false), 8);
  for (const char* made : {"out/n100/shape.csv", "out/n300/0.ply", "sample.html", "sample.csv",
                           "both.html", "parts/shape.csv"}) {
    EXPECT_TRUE(exists(made)) << made;
  }
}

// With its own numbers tests/engines/growing.sh runs it.
TEST_F(Tutorial, OfGrowingRuns) {
  write_scans(21);
  EXPECT_GE(run_commands("grow.md", true), 2);
  for (const char* made : {"templates/template-20.ply", "templating/run.py",
                           "grown/grown-00012.ply", "packing/run.py"}) {
    EXPECT_TRUE(exists(made)) << made;
  }
}

}  // namespace
}  // namespace wscvt
