// SPDX-License-Identifier: GPL-3.0-or-later
// The program on the contacts of a volume of labels.

#include <string>

#include "program_run.h"
#include "support/made_volume.h"
#include "support/page_tables.h"

namespace wscvt {
namespace {

class FabricCommand : public test::ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    test::MadeVolume labels({46, 30, 30});
    labels.fill_ball(1, {14, 14, 15}, 9.0);
    labels.fill_ball(2, {31, 15, 16}, 8.9);
    test::write_bytes(folder_ / "labels.nrrd", test::nrrd(labels, units_));
    for (std::uint32_t& value : labels.labels) value = value == 0 ? 60 : 160;
    test::write_bytes(folder_ / "scan.nrrd", test::nrrd(labels, units_));
  }
  std::string units_ = "spacings: 0.5 0.5 0.5\nspace units: \"mm\" \"mm\" \"mm\"\n";
};

TEST_F(FabricCommand, WritesTablesDiscsAndAPage) {
  const Outcome outcome = run("describe labels.nrrd -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("2 grains, 0 of them at the border\n1 pair of labels touches: 1 in "
                                "contact, 0 with"),
            std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("taken as exact"), std::string::npos);
  EXPECT_EQ(test::count_of(content("out/contacts.csv"), "\r\n"), 2U);
  EXPECT_EQ(test::count_of(content("out/grains.csv"), "\r\n"), 3U);
  EXPECT_NE(content("out/contacts.vtp").find("PolyData"), std::string::npos);
  EXPECT_EQ(test::count_of(content("out/fabric.html"), "<svg"), 6U);
  EXPECT_NE(content("out/fabric.html").find("Made from labels.nrrd by wscvt"), std::string::npos);

  const Outcome blurred = run("describe labels.nrrd scan.nrrd -o blurred");
  EXPECT_EQ(blurred.exit_code, 0) << blurred.errors;
  EXPECT_NE(blurred.output.find("Blur of the scan"), std::string::npos);
  EXPECT_NE(content("blurred/contacts.csv"), content("out/contacts.csv"));
  EXPECT_EQ(run("describe labels.nrrd -o out --voxel-size 12um -q").output, "");
  EXPECT_NE(content("out/contacts.csv").find(",um\r\n"), std::string::npos);
}

TEST_F(FabricCommand, RefusesWrongCallsBeforeAnythingIsMade) {
  test::write_bytes(folder_ / "grain.ply", "ply\n");
  test::MadeVolume one({20, 20, 20});
  one.fill_ball(2, {10, 10, 10}, 5.0);
  test::write_bytes(folder_ / "one.nrrd", test::nrrd(one, units_));
  expect_refused("describe",
                 {{"grain.ply -o out", 2, "Give --report"},
                  {"labels.nrrd -o out --report page.html", 2, "Leave out --report"},
                  {"nothing.nrrd -o out", 1, "cannot be opened"},
                  {"labels.nrrd -o labels.nrrd", 2, "the labels"},
                  {"one.nrrd -o out", 1, "one label, 2"},
                  {"labels.nrrd nothing.nrrd -o out", 1, "nothing.nrrd"},
                  {"labels.nrrd", 2, "--output"}},
                 {"out"});
}

}  // namespace
}  // namespace wscvt
