// SPDX-License-Identifier: GPL-3.0-or-later
// The program on grey values and on masks.

#include <csignal>
#include <string>

#include "limited_run.h"
#include "program_run.h"
#include "support/made_volume.h"
#include "support/page_tables.h"

namespace wscvt {
namespace {

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
  EXPECT_NE(outcome.output.find("Look at \"labels.html\" first. Then: wscvt batch labels.nrrd -o "
                                "out -n 500\n"),
            std::string::npos)
      << outcome.output;
  const std::string page = content("labels.html");
  EXPECT_EQ(test::count_of(page, "data:image/png"), 3U);
  EXPECT_NE(page.find("Made from scan.nrrd by wscvt"), std::string::npos);
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
  EXPECT_NE(all.find("\n1 grain"), std::string::npos) << all;
}

TEST_F(Segment, ReplacesNoPageOfItsUser) {
  test::write_bytes(folder_ / "labels.html", "<html><title>My notes</title></html>");
  const Outcome refused = run("segment scan.nrrd labels.nrrd -q");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("\"labels.html\" would be replaced"), std::string::npos)
      << refused.errors;
  EXPECT_NE(content("labels.html").find("My notes"), std::string::npos);
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
  EXPECT_NE(whole.errors.find("--separate 0.85 also separates"), std::string::npos) << whole.errors;
  EXPECT_NE(run("extract mask.nrrd parts --parts").output.find("2 labels: 2 written\n"),
            std::string::npos);
  const Outcome apart = run("extract mask.nrrd apart --separate 0.85");
  EXPECT_EQ(apart.exit_code, 0) << apart.errors;
  EXPECT_NE(apart.output.find("3 labels: 3 written\n"), std::string::npos) << apart.output;
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
  EXPECT_NE(outcome.errors.find("about 5.4 GB"), std::string::npos) << outcome.errors;
  const Outcome full =
      run_limited({"segment", "scan.nrrd", "labels.nrrd", "-q"}, {{RLIMIT_FSIZE, 200}});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_NE(full.errors.find("labels.nrrd"), std::string::npos) << full.errors;
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
