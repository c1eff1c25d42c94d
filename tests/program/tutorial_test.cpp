// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of the tutorial lib/doc/sample.md, run word for word.
#include <sstream>
#include <string>

#include "program_run.h"
#include "support/test_shapes.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

class Tutorial : public test::ProgramRun {};

TEST_F(Tutorial, OfSamplesRunsWordForWord) {
  fs::create_directory(folder_ / "scans");
  for (int k = 0; k < 4; ++k) {
    const Vector3 axes(1.0 + 0.2 * k, 0.9 - 0.05 * k, 0.6);
    write_mesh(test::transformed(test::sphere(2), axes.asDiagonal()),
               path("scans/" + std::to_string(k) + ".ply"));
  }
  std::ostringstream text;
  text << std::ifstream(fs::path(WSCVT_MESHES_DIR).parent_path() / "lib/doc/sample.md").rdbuf();
  std::istringstream lines(text.str());
  int commands = 0;
  const std::string program = "    wscvt ";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(program, 0) != 0) continue;
    ++commands;
    const Outcome outcome = run(line.substr(program.size()));
    EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.errors;
    EXPECT_EQ(outcome.errors, "") << line;
  }
  EXPECT_GE(commands, 8);
  for (const char* made : {"out/n100/shape.csv", "out/n300/0.ply", "sample.html", "sample.csv",
                           "both.html", "parts/shape.csv"}) {
    EXPECT_TRUE(exists(made)) << made;
  }
}

}  // namespace
}  // namespace wscvt
