// SPDX-License-Identifier: GPL-3.0-or-later
// The built program as a user calls it: exit code, sentence, file.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "wscvt/scan/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own under the system's, gone at its end.
class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "wscvt_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  struct Outcome {
    int exit_code = -1;  ///< -1 when a signal ended it
    std::string output;
    std::string errors;
  };

  Outcome run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && '" WSCVT_PROGRAM "' " +
                                arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("stdout.txt"),
            content("stderr.txt")};
  }

  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  fs::path folder_;
  const std::string sand_ = "'" WSCVT_MESHES_DIR "/sand_7228.ply'";
};

TEST_F(CommandLine, RemeshesToTheExactCount) {
  const Outcome outcome = run(sand_ + " remesh.ply -n 100 --json report.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  const IndexedMesh mesh = read_mesh((folder_ / "remesh.ply").string());
  EXPECT_EQ(mesh.points.size(), 100U);
  EXPECT_EQ(mesh.triangles.size(), 196U);
  EXPECT_NE(outcome.output.find("100 nodes, 196 faces"), std::string::npos) << outcome.output;
  EXPECT_NE(content("report.json").find("wscvt-report"), std::string::npos);
}

TEST_F(CommandLine, RefusesBadCallsWithASentenceAndWritesNothing) {
  struct BadCall {
    std::string arguments;
    std::string part_of_the_sentence;
  };
  for (const BadCall& call :
       {BadCall{"missing.ply remesh.ply -n 100", "missing.ply"},
        BadCall{sand_ + " remesh.ply -n 3", "from 4 to"},
        BadCall{sand_ + " remesh.ply -n many", "many"},
        BadCall{sand_ + " remesh.ply -w heavy", "heavy"},
        BadCall{sand_ + " remesh.ply --coefficients ./report.json", "two names"},
        BadCall{sand_, "output"}}) {
    SCOPED_TRACE(call.arguments);
    const Outcome outcome = run(call.arguments + " -j report.json");
    EXPECT_GT(outcome.exit_code, 0);
    EXPECT_NE(outcome.errors.find(call.part_of_the_sentence), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_FALSE(fs::exists(folder_ / "remesh.ply"));
    EXPECT_FALSE(fs::exists(folder_ / "report.json"));
  }
}

}  // namespace
}  // namespace wscvt
