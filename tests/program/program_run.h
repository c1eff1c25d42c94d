// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/holds.h"

namespace wscvt::test {

/// The built program as a user calls it, in a folder of the test's own, which is gone at its end.
class ProgramRun : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "wscvt_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
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

  /// A call that is refused, with its exit code and a part of what is said.
  struct BadCall {
    std::string arguments;
    int exit_code;
    std::string part_of_the_sentence;
  };

  /// Expects each call of `command` to be refused as it says, and that none of `files` is there
  /// afterwards.
  void expect_refused(const std::string& command, const std::vector<BadCall>& calls,
                      const std::vector<std::string>& files) const {
    for (const BadCall& call : calls) {
      SCOPED_TRACE(call.arguments);
      const Outcome outcome = run(command + " " + call.arguments);
      EXPECT_EQ(outcome.exit_code, call.exit_code);
      EXPECT_TRUE(holds(outcome.errors, call.part_of_the_sentence));
      EXPECT_EQ(outcome.output, "");
      for (const std::string& file : files) EXPECT_FALSE(exists(file)) << file;
    }
  }

  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return text.str();
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  std::filesystem::path folder_;  ///< the test's own
};

}  // namespace wscvt::test
