// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "wscvt/base/error.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, with "report.txt" holding "before".
class OutputFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write_file(path("report.txt"), "before");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static std::string read(const std::string& name) {
    std::ifstream stream(name, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  void expect_only(const std::string& content) const {
    EXPECT_EQ(read(path("report.txt")), content);
    std::size_t entries = 0;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      entries += entry.is_regular_file() ? 1 : 0;
    }
    EXPECT_EQ(entries, 1U);
  }

 private:
  fs::path folder_;
};

TEST_F(OutputFile, ReplacesAndLeavesNothingBeside) {
  write_file(path("report.txt"), std::string("a\0b\r\n", 5));
  expect_only(std::string("a\0b\r\n", 5));
}

TEST_F(OutputFile, StaysAsItWasWhenWritingFails) {
  const auto gives_up = [](std::ostream& stream) {
    stream << "half";
    return false;
  };
  EXPECT_THROW(write_file(path("report.txt"), gives_up), Error);
  expect_only("before");
  const auto breaks = [](std::ostream& stream) {
    stream.setstate(std::ios::badbit);
    return true;
  };
  EXPECT_THROW(write_file(path("report.txt"), breaks), Error);
  expect_only("before");
  const auto throws = [](std::ostream&) -> bool { throw std::runtime_error("no"); };
  EXPECT_THROW(write_file(path("report.txt"), throws), std::runtime_error);
  expect_only("before");
}

TEST_F(OutputFile, SaysWhatIsWrong) {
  fs::create_directory(path("taken"));
  for (const std::string& name : {path("taken"), path("no folder/report.txt")}) {
    try {
      write_file(name, "content");
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InputOutput);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("check"), std::string::npos);
    }
  }
  expect_only("before");
}

TEST_F(OutputFile, LeavesAFileThatHasTheTemporaryName) {
  write_file(path("new.txt.part"), "mine");
  write_file(path("new.txt"), "content");
  EXPECT_EQ(read(path("new.txt.part")), "mine");
  EXPECT_EQ(read(path("new.txt")), "content");
}

TEST_F(OutputFile, WritesThroughALink) {
  fs::create_symlink(path("report.txt"), path("link.txt"));
  write_file(path("link.txt"), "after");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(read(path("report.txt")), "after");
}

TEST_F(OutputFile, KnowsOneFileByItsNames) {
  fs::create_symlink(path("report.txt"), path("link.txt"));
  EXPECT_TRUE(same_file(path("report.txt"), path("./report.txt")));
  EXPECT_TRUE(same_file(path("report.txt"), path("link.txt")));
  EXPECT_TRUE(same_file(path("not there"), path("./not there")));
  EXPECT_TRUE(same_file("not there", "./not there"));
  EXPECT_FALSE(same_file(path("report.txt"), path("other.txt")));
  EXPECT_FALSE(same_file("", ""));
}

}  // namespace
}  // namespace wscvt
