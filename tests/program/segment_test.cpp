// SPDX-License-Identifier: GPL-3.0-or-later
// The program on grey values and on masks.

#include <csignal>
#include <string>

#include "limited_run.h"
#include "program_run.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/page_tables.h"

namespace wscvt {
namespace {

using test::holds;

class Segment : public test::LimitedRun {
 protected:
  /// Two balls in contact and one apart, noise of a few grey values.
  void SetUp() override {
    LimitedRun::SetUp();
    fill(160);
    for (std::size_t k = 0; k < scan_.labels.size(); ++k) {
      std::uint32_t& value = scan_.labels[k];
      value = (value == 0 ? 60 : value) + static_cast<std::uint32_t>(k * 7919 % 11);
    }
    test::write_bytes(folder_ / "scan.nrrd", test::nrrd(scan_, units_));
    scan_.labels.assign(scan_.labels.size(), 0);
    fill(255);
    test::write_bytes(folder_ / "mask.nrrd", test::nrrd(scan_, units_));
  }
  void fill(std::uint32_t value) {
    scan_.fill_ball(value, {14, 14, 15}, 9.0);
    scan_.fill_ball(value, {33, 14, 16}, 10.5);
    scan_.fill_ball(value, {14, 36, 15}, 8.0);
  }

  std::string units_ = "spacings: 0.5 0.5 0.5\nspace units: \"mm\" \"mm\" \"mm\"\n";
  test::MadeVolume scan_{{46, 48, 30}};
};

TEST_F(Segment, MakesLabelsAndAPageThatBatchGoesOnFrom) {
  const Outcome outcome = run("segment scan.nrrd labels.nrrd");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.output.rfind("46 x 48 x 30 voxels of 0.5 x 0.5 x 0.5 mm, from the file's "
                                 "header.\n3 grains, 0 of them at the border\nThreshold 114.5; ",
                                 0),
            0U)
      << outcome.output;
  EXPECT_TRUE(holds(outcome.output,
                    "Look at \"labels.html\" first. Then: wscvt batch labels.nrrd -o "
                    "out -n 500\n"));
  const std::string page = content("labels.html");
  EXPECT_EQ(test::count_of(page, "data:image/png"), 3U);
  EXPECT_TRUE(holds(page, "Made from scan.nrrd by wscvt"));
  EXPECT_EQ(content("labels.nrrd").rfind("NRRD0004", 0), 0U);

  EXPECT_EQ(run("batch labels.nrrd -o out -n 60 -q").exit_code, 0);
  for (const char* grain : {"out/1.ply", "out/2.ply", "out/3.ply"}) EXPECT_TRUE(exists(grain));

  // The same bytes at any number of threads, another format and page, nothing said.
  EXPECT_EQ(run("segment scan.nrrd again.nrrd --report page.html -t 3 -q").output, "");
  EXPECT_EQ(content("again.nrrd"), content("labels.nrrd"));
  EXPECT_TRUE(exists("page.html"));
  EXPECT_FALSE(exists("again.html"));
  EXPECT_EQ(run("segment scan.nrrd labels.mha --threshold 500 -q").exit_code, 1);
  EXPECT_FALSE(exists("labels.mha"));
  const std::string all = run("segment mask.nrrd labels.mha --separate 0 --smallest 3000").output;
  EXPECT_TRUE(holds(all, "\n1 grain"));
}

TEST_F(Segment, ReplacesNoPageOfItsUser) {
  test::write_bytes(folder_ / "labels.html", "<html><title>My notes</title></html>");
  const Outcome refused = run("segment scan.nrrd labels.nrrd -q");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(holds(refused.errors, "\"labels.html\" would be replaced"));
  EXPECT_TRUE(holds(content("labels.html"), "My notes"));
  EXPECT_FALSE(exists("labels.nrrd"));
  // As it advises. Its own page is replaced.
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(run("segment scan.nrrd labels.nrrd -q --report page.html").exit_code, 0);
    EXPECT_EQ(run("segment scan.nrrd others.nrrd -q").exit_code, 0);
  }
}

TEST_F(Segment, SeparatesMasksOnTheWayToMeshes) {
  const Outcome whole = run("extract mask.nrrd whole");
  EXPECT_EQ(whole.exit_code, 3);
  EXPECT_TRUE(holds(whole.errors, "--separate 0.85 also separates"));
  EXPECT_TRUE(holds(run("extract mask.nrrd parts --parts").output, "2 labels: 2 written\n"));
  const Outcome apart = run("extract mask.nrrd apart --separate 0.85");
  EXPECT_EQ(apart.exit_code, 0) << apart.errors;
  EXPECT_TRUE(holds(apart.output, "3 labels: 3 written\n"));
  EXPECT_EQ(run("batch mask.nrrd -o out -n 60 -q --separate 0.85").exit_code, 0);
  EXPECT_TRUE(exists("out/3.ply"));
  // What it was called with belongs to the batch.
  EXPECT_EQ(run("batch mask.nrrd -o out -n 60 -q --separate 0.6").exit_code, 2);
}

TEST_F(Segment, RefusesWrongCallsBeforeAnythingIsMade) {
  test::write_bytes(folder_ / "grain.ply", "ply\n");
  expect_refused("segment",
                 {{"scan.nrrd labels.tif", 2, ".nrrd or .mha"},
                  {"scan.nrrd labels.mha --report page.json", 2, ".html"},
                  {"scan.nrrd labels.mha --separate 1.5", 2, "1.5"},
                  {"scan.nrrd labels.mha --smallest 0", 2, "1 or more"},
                  {"scan.nrrd labels.mha --threshold high", 2, "\"high\""},
                  {"scan.nrrd scan.nrrd", 2, "the scan itself"},
                  {"scan.nrrd labels.mha --select channel=2", 1, "--select channel=2"},
                  {"grain.ply labels.mha", 2, "the ending of a volume"},
                  {"nothing.nrrd labels.mha", 1, "cannot be opened"},
                  {"scan.nrrd gone/labels.mha", 1, "gone"}},
                 {"labels.mha", "labels.html", "page.json"});
  EXPECT_EQ(run("extract mask.nrrd apart --separate 2").exit_code, 2);
}

TEST_F(Segment, SaysWhatTheMachineRefuses) {
  // Enough to begin with, too little for the filters of 200 million voxels.
  test::write_bytes(
      folder_ / "large.json",
      "{\"dimensions\": [600, 600, 600], \"type\": \"uint8\", \"file\": \"large.raw\"}");
  test::write_bytes(folder_ / "large.raw", "\xff");
  std::filesystem::resize_file(folder_ / "large.raw", 600 * 600 * 600);
  const Outcome outcome = run_limited({"segment", "large.json", "labels.nrrd", "-q"},
                                      {{RLIMIT_AS, rlim_t{700} << 20U}});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(holds(outcome.errors, "about 5.4 GB"));
  const Outcome full =
      run_limited({"segment", "scan.nrrd", "labels.nrrd", "-q"}, {{RLIMIT_FSIZE, 200}});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_TRUE(holds(full.errors, "labels.nrrd"));
  EXPECT_FALSE(exists("labels.nrrd"));
}

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
  EXPECT_TRUE(holds(outcome.output,
                    "2 grains, 0 of them at the border\n1 pair of labels touches: 1 in "
                    "contact, 0 with"));
  EXPECT_TRUE(holds(outcome.output, "taken as exact"));
  EXPECT_EQ(test::count_of(content("out/contacts.csv"), "\r\n"), 2U);
  EXPECT_EQ(test::count_of(content("out/grains.csv"), "\r\n"), 3U);
  EXPECT_TRUE(holds(content("out/contacts.vtp"), "PolyData"));
  EXPECT_EQ(test::count_of(content("out/fabric.html"), "<svg"), 6U);
  EXPECT_TRUE(holds(content("out/fabric.html"), "Made from labels.nrrd by wscvt"));

  const Outcome blurred = run("describe labels.nrrd scan.nrrd -o blurred");
  EXPECT_EQ(blurred.exit_code, 0) << blurred.errors;
  EXPECT_TRUE(holds(blurred.output, "Blur of the scan"));
  EXPECT_NE(content("blurred/contacts.csv"), content("out/contacts.csv"));
  EXPECT_EQ(run("describe labels.nrrd -o out --voxel-size 12um -q").output, "");
  EXPECT_TRUE(holds(content("out/contacts.csv"), ",um\r\n"));
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
