// SPDX-License-Identifier: GPL-3.0-or-later
// The program as a whole: files in and out, exit codes, sentences.
#include <string>

#include "program_run.h"
#include "wscvt/base/version.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt {
namespace {

class CommandLine : public test::ProgramRun {
 protected:
  const std::string sand_ = "'" WSCVT_MESHES_DIR "/sand_7228.ply'";
};

TEST_F(CommandLine, RemeshesToTheExactCount) {
  const Outcome outcome = run(sand_ + " remesh.ply -n 100 --json report.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  const IndexedMesh mesh = read_mesh(path("remesh.ply"));
  EXPECT_EQ(mesh.points.size(), 100U);
  EXPECT_EQ(mesh.triangles.size(), 196U);
  EXPECT_NE(outcome.output.find("100 nodes, 196 faces"), std::string::npos) << outcome.output;
  EXPECT_NE(content("report.json").find("wscvt-report"), std::string::npos);
}

TEST_F(CommandLine, SaysItsVersion) {
  const Outcome outcome = run("--version");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, std::string("wscvt ") + version() + "\n");
  EXPECT_EQ(outcome.errors, "");
}

TEST_F(CommandLine, TellsAWrongCallFromWorkThatFails) {
  struct BadCall {
    std::string arguments;
    int exit_code;
    std::string part_of_the_sentence;
  };
  for (const BadCall& call :
       {BadCall{"missing.ply remesh.ply -n 100", 1, "missing.ply"},
        BadCall{sand_ + " remesh.ply -r 10", 1, "least squares"},
        BadCall{sand_ + " remesh.ply --coefficients ./report.json", 1, "two names"},
        BadCall{sand_ + " remesh.ply --nodse 100", 2, "nodse"},
        BadCall{sand_ + " remesh.ply more.ply", 2, "more.ply"}, BadCall{sand_, 2, "output"}}) {
    SCOPED_TRACE(call.arguments);
    const Outcome outcome = run(call.arguments + " -j report.json");
    EXPECT_EQ(outcome.exit_code, call.exit_code);
    EXPECT_NE(outcome.errors.find(call.part_of_the_sentence), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_FALSE(exists("remesh.ply"));
    EXPECT_FALSE(exists("report.json"));
  }
}

}  // namespace
}  // namespace wscvt
