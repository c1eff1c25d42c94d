// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, with "report.txt" holding "before".
class OutputFile : public test::FileFolder {
 protected:
  void SetUp() override {
    FileFolder::SetUp();
    write_file(path("report.txt"), "before");
  }

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
};

TEST_F(OutputFile, ReplacesAndLeavesNothingBeside) {
  write_file(path("report.txt"), std::string("a\0b\r\n", 5));
  expect_only(std::string("a\0b\r\n", 5));
}

TEST_F(OutputFile, StaysAsItWasWhenWritingFails) {
  const auto breaks = [](std::ostream& stream) {
    stream << "half";
    stream.setstate(std::ios::badbit);
  };
  EXPECT_ERROR(write_file(path("report.txt"), breaks), InputOutput);
  expect_only("before");
  const auto throws = [](std::ostream&) { throw std::runtime_error("no"); };
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
      EXPECT_TRUE(test::holds(error.what(), name));
      EXPECT_TRUE(test::holds(error.what(), "Check"));
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

TEST_F(OutputFile, WritesThroughALinkToAFileThatIsNotThereYet) {
  fs::create_directory(path("folder"));
  fs::create_symlink("folder/new.txt", path("first.txt"));
  fs::create_symlink(path("first.txt"), path("second.txt"));
  write_file(path("second.txt"), "after");
  EXPECT_TRUE(fs::is_symlink(path("first.txt")));
  EXPECT_TRUE(fs::is_symlink(path("second.txt")));
  EXPECT_EQ(read(path("folder/new.txt")), "after");
  fs::create_symlink(path("circle.txt"), path("circle.txt"));
  EXPECT_ERROR(write_file(path("circle.txt"), "after"), InputOutput);
  EXPECT_TRUE(fs::is_symlink(path("circle.txt")));
}

TEST_F(OutputFile, FollowsAsManyLinksAsTheSystemDoes) {
  std::string last = "report.txt";
  int followed = 0;
  for (int links = 1; links <= 45; ++links) {
    const std::string name = "link" + std::to_string(links);
    fs::create_symlink(last, path(name));
    last = name;
    const std::string text = "after " + name;
    if (std::ifstream(path(name)).good()) {
      write_file(path(name), text);
      EXPECT_EQ(read(path("report.txt")), text);
      ++followed;
    } else {
      EXPECT_ERROR(write_file(path(name), text), InputOutput);
      EXPECT_ERROR(check_writable(path(name)), InputOutput);
    }
  }
  EXPECT_GT(followed, 0);
  EXPECT_LT(followed, 45);
  EXPECT_EQ(read(path("report.txt")), "after link" + std::to_string(followed));
}

TEST_F(OutputFile, KeepsModeAndHardLinks) {
  fs::permissions(path("report.txt"), fs::perms::owner_all);
  write_file(path("report.txt"), "private");
  EXPECT_EQ(fs::status(path("report.txt")).permissions(), fs::perms::owner_all);
  fs::create_hard_link(path("report.txt"), path("other.txt"));
  write_file(path("report.txt"), "after");
  EXPECT_EQ(read(path("other.txt")), "after");
  EXPECT_EQ(fs::hard_link_count(path("report.txt")), 2U);
  EXPECT_FALSE(fs::exists(path("report.txt.part")));
  write_file(path("other.txt"), "");
  EXPECT_EQ(read(path("report.txt")), "");
}

TEST_F(OutputFile, KeepsTheOwner) {
  if (geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  ASSERT_EQ(chown(path("report.txt").c_str(), 12345, 23456), 0);
  write_file(path("report.txt"), "after");
  struct stat there {};
  ASSERT_EQ(stat(path("report.txt").c_str(), &there), 0);
  EXPECT_EQ(there.st_uid, 12345U);
  EXPECT_EQ(there.st_gid, 23456U);
  EXPECT_EQ(read(path("report.txt")), "after");
}

TEST_F(OutputFile, WritesIntoPipesAndDevicesWithoutReplacingThem) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read(path("pipe")); });
  write_file(path("pipe"), "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));

  fs::create_symlink("/dev/null", path("null"));
  write_file(path("null"), "nothing");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::is_symlink(path("null")));
  fs::create_symlink("/dev/full", path("full"));
  EXPECT_ERROR(write_file(path("full"), "nothing"), InputOutput);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(OutputFile, WritesToTheStandardOutputWhereItStands) {
  // The shell's file is open; a new file in its place would take what comes later away from it.
  const int before = dup(1);
  const int file = open(path("report.txt").c_str(), O_WRONLY | O_TRUNC);
  ASSERT_EQ(write(file, "first ", 6), 6);
  dup2(file, 1);
  write_file("/dev/stdout", "second ");
  check_writable("/dev/stdout");
  const auto last = write(1, "third", 5);
  dup2(before, 1);
  close(before);
  close(file);
  EXPECT_EQ(last, 5);
  expect_only("first second third");
}

TEST_F(OutputFile, TellsBeforehandWhatCannotBeWritten) {
  check_writable(path("report.txt"));
  check_writable(path("new.txt"));
  check_writable("/dev/null");
  expect_only("before");
  EXPECT_ERROR(check_writable(path("no folder/report.txt")), InputOutput);
  EXPECT_ERROR(check_writable(fs::path(path("report.txt")).parent_path().string()), InputOutput);
  EXPECT_ERROR(check_writable(path("report.txt/inside.txt")), InputOutput);
  expect_only("before");
}

TEST_F(OutputFile, NeedsNoRoomBesideAPipe) {
  // With the longest name that there is, so that no name beside it could be made for a new file.
  const std::string pipe = path(std::string(255, 'p'));
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NO_THROW(check_writable(pipe));
  expect_only("before");
}

TEST_F(OutputFile, KnowsOneFileByItsNames) {
  fs::create_symlink(path("report.txt"), path("link.txt"));
  fs::create_hard_link(path("report.txt"), path("hard.txt"));
  fs::create_symlink("not there", path("dangling"));
  EXPECT_TRUE(same_file(path("report.txt"), path("hard.txt")));
  EXPECT_TRUE(same_file(path("link.txt"), path("hard.txt")));
  EXPECT_TRUE(same_file(path("dangling"), path("not there")));
  EXPECT_FALSE(same_file("/dev/null", "/dev/null"));
  EXPECT_FALSE(same_file("/dev/stdout", "/dev/stdout"));
  EXPECT_TRUE(same_file(path("report.txt"), path("./report.txt")));
  EXPECT_TRUE(same_file(path("report.txt"), path("link.txt")));
  EXPECT_TRUE(same_file(path("not there"), path("./not there")));
  EXPECT_TRUE(same_file("not there", "./not there"));
  EXPECT_FALSE(same_file(path("report.txt"), path("other.txt")));
  std::ofstream(path("other.txt")) << "on the same disk";
  EXPECT_FALSE(same_file(path("report.txt"), path("other.txt")));
  EXPECT_FALSE(same_file("", ""));
}

}  // namespace
}  // namespace wscvt
