// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/file_name.h"

#include <gtest/gtest.h>

namespace wscvt {
namespace {

TEST(FileName, EndingsAreInLowerCaseWithTheirPoint) {
  EXPECT_EQ(ending_of("scan.ply"), ".ply");
  EXPECT_EQ(ending_of("/data/Scan.AZ.PLY"), ".ply");
  EXPECT_EQ(ending_of("sample.tar/grain.Stl2"), ".stl2");
  // Letters beyond ASCII are left as they are, whatever the locale.
  EXPECT_EQ(ending_of("scan.\xC3\x84Z"), ".\xC3\x84z");
}

TEST(FileName, WithoutAnEndingThereIsNone) {
  for (const char* path : {"", "scan", "sample.d/scan", ".hidden", "."}) {
    EXPECT_EQ(ending_of(path), "") << path;
  }
}

}  // namespace
}  // namespace wscvt
