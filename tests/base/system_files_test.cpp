// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/system_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/file_folder.h"
#include "wscvt/base/output_file.h"

namespace wscvt::system_files {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own.
class SystemFiles : public test::FileFolder {
 protected:
  void SetUp() override {
    FileFolder::SetUp();
    fs::create_directory(path("sub"));
  }
};

TEST_F(SystemFiles, ATakenNameIsNotMadeAgain) {
  EXPECT_EQ(create_file(path("new")), Creation::Done);
  EXPECT_EQ(create_file(path("new")), Creation::NameTaken);
  EXPECT_EQ(create_file(path("no folder/new")), Creation::Refused);
}

TEST_F(SystemFiles, TwoNamesOfAFileHaveOneNumber) {
  write_file(path("a"), "");
  write_file(path("c"), "");
  fs::create_hard_link(path("a"), path("b"));
  const auto a = file_state(path("a"));
  const auto b = file_state(path("b"));
  const auto c = file_state(path("c"));
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->names, 2U);
  EXPECT_EQ(a->number, b->number);
  EXPECT_EQ(a->device, b->device);
  EXPECT_NE(a->number, c->number);
  EXPECT_TRUE(a->is_regular && !a->is_folder);
  EXPECT_TRUE(file_state(path("sub"))->is_folder);
  EXPECT_FALSE(file_state(path("none")));
}

TEST_F(SystemFiles, AnotherOpeningOfALockedFileIsToldSo) {
  const std::string name = path("table.csv");
  {
    LockedFile first;
    ASSERT_EQ(first.open(name, true, false), Opening::Done);
    EXPECT_TRUE(first.append("abc"));
    EXPECT_TRUE(first.append("def"));
    LockedFile second;
    EXPECT_EQ(second.open(name, true, false), Opening::Locked);
    EXPECT_EQ(first.size(), 6U);
    EXPECT_EQ(first.read(2, 3), "cde");
    EXPECT_EQ(first.read(4, 30), "ef");
    EXPECT_TRUE(first.cut(4));
    EXPECT_TRUE(first.append("x"));
    EXPECT_EQ(first.read(0, 9), "abcdx");
  }
  LockedFile third;
  EXPECT_EQ(third.open(name, false, false), Opening::Done);
  EXPECT_EQ(third.size(), 5U);
  LockedFile none;
  EXPECT_EQ(none.open(path("none"), false, false), Opening::Refused);
}

TEST_F(SystemFiles, PatternsFindNamesAndFolders) {
  for (const char* name : {"b1.ply", "a1.ply", "a2.ply", "a10.ply", ".hidden.ply", "a1.csv",
                           "sub/a1.ply", "sub/d.ply"}) {
    write_file(path(name), "");
  }
  const auto found = [this](const std::string& pattern) {
    std::vector<std::string> names;
    for (const std::string& file : matching_files(path(pattern))) {
      names.push_back(fs::relative(file, path("")).generic_string());
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(found("*.ply"), (Names{"a1.ply", "a10.ply", "a2.ply", "b1.ply"}));
  EXPECT_EQ(found("a?.ply"), (Names{"a1.ply", "a2.ply"}));
  EXPECT_EQ(found("[b-z]*.ply"), (Names{"b1.ply"}));
  EXPECT_EQ(found("[!a]1.ply"), (Names{"b1.ply"}));
  EXPECT_EQ(found("s*/[ad]*.ply"), (Names{"sub/a1.ply", "sub/d.ply"}));
  EXPECT_EQ(found("*/d.ply"), (Names{"sub/d.ply"}));
  EXPECT_EQ(found(".h*"), (Names{".hidden.ply"}));
  EXPECT_EQ(found("*.off"), Names{});
}

}  // namespace
}  // namespace wscvt::system_files
