// SPDX-License-Identifier: GPL-3.0-or-later
// Names of files that terminals, tables and pages do not take as they are.
#include <algorithm>
#include <string>
#include <vector>

#include "program_run.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/made_volume.h"
#include "support/test_shapes.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using test::holds;

class FileNames : public test::ProgramRun {
 protected:
  /// Whether it is UTF-8 whose only control characters are line ends and tabs.
  static bool is_clean(const std::string& text) { return readable(text, "\t\r\n") == text; }

  void write_scans(const std::vector<std::string>& names) const {
    fs::create_directory(folder_ / "scans");
    const IndexedMesh body = test::scaled(test::sphere(3), Vector3(1.0, 0.85, 0.7));
    write_mesh(body, path("body.ply"));
    for (const std::string& name : names) {
      fs::copy_file(folder_ / "body.ply", folder_ / "scans" / name);
    }
  }
};

TEST_F(FileNames, OfAnyBytesMakeTablesAndPagesThatProgramsTake) {
  write_scans({"=1+1.ply", "K\xF6rner.ply", "esc\x1B[31m.ply", "line\nend.ply", "tab\tcr\r.ply"});
  std::ofstream(folder_ / "scans/zz\xFF.ply") << "no mesh";
  const std::string call = "batch scans -o out -n 60";
  const Outcome outcome = run(call);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
  EXPECT_TRUE(is_clean(outcome.errors)) << outcome.errors;
  EXPECT_TRUE(holds(outcome.errors, "zz\\xFF.ply: "));
  for (const char* made : {"out/grains.csv", "out/summary.html", "out/summary.json"}) {
    EXPECT_TRUE(is_clean(content(made))) << made;
  }
  const auto rows = test::csv_records(content("out/grains.csv"));
  ASSERT_EQ(rows.size(), 7U);
  for (const auto& row : rows) {
    for (const std::string& cell : row) EXPECT_NE(cell.substr(0, 1), "=") << cell;
  }
  // A row of such a name is known again.
  const std::string whole = content("out/grains.csv");
  fs::resize_file(folder_ / "out/grains.csv", whole.size() - 20);
  EXPECT_EQ(run(call).exit_code, 3);
  EXPECT_EQ(content("out/grains.csv"), whole);
}

TEST_F(FileNames, OfAnyBytesMakeReportsThatProgramsTake) {
  write_scans({"=K\xF6rner\x1B[31m.ply"});
  const std::string scan = "'scans/=K\xF6rner\x1B[31m.ply'";
  fs::create_directory(folder_ / "=");
  fs::copy_file(folder_ / "body.ply", folder_ / "=/a.ply");
  ASSERT_EQ(run("describe =/a.ply -q --report formula.csv").exit_code, 0);
  const auto cells = test::csv_records(content("formula.csv")).at(1);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), "'=/a.ply"), 1);
  for (const std::string& command : {"remesh " + scan + " made.ply -n 60", "describe " + scan,
                                     "describe " + scan + " " + scan}) {
    SCOPED_TRACE(command);
    const Outcome outcome = run(command + " --report r.html --report r.json --report r.csv");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_TRUE(is_clean(outcome.output)) << outcome.output;
    EXPECT_TRUE(is_clean(outcome.errors)) << outcome.errors;
    for (const char* made : {"r.html", "r.json", "r.csv"}) {
      EXPECT_TRUE(is_clean(content(made))) << made;
      fs::remove(folder_ / made);
    }
  }
}

TEST_F(FileNames, InSentencesHaveNoControlCharacters) {
  for (const std::string call :
       {"remesh 'no\x1B[31m.ply' made.ply", "describe 'no\xFF.ply'", "batch 'no\x1B[2J*' -o out",
        "'no\x1B[2Jcommand'", "remesh a.ply 'made\x1B.xyz'"}) {
    const Outcome outcome = run(call);
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 2);
    EXPECT_TRUE(is_clean(outcome.errors)) << outcome.errors;
    EXPECT_TRUE(holds(outcome.errors, "\\x"));
  }
}

TEST_F(FileNames, ThatAHeaderGivesHaveNoControlCharacters) {
  test::MadeVolume volume({9, 9, 9});
  volume.fill_ball(1, {4, 4, 4}, 3.0);
  test::write_bytes(folder_ / "voxels", volume.bytes<std::uint8_t>());
  const auto header = [&](const std::string& file) {
    test::write_bytes(folder_ / "sample.nhdr",
                      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 9 9 9\nencoding: raw\n"
                      "data file: " +
                          file + "\n\n");
  };
  header("voxels");
  EXPECT_EQ(run("extract sample.nhdr out -q --smallest 1").exit_code, 0);
  using std::string_literals::operator""s;
  // Up to the NUL it is the name of a file that is there.
  for (const std::string& name : {"voxels\0more"s, "vox\x1B[31mels"s, "vox\x07 els"s, "vox\x7F"s}) {
    header(name);
    const Outcome outcome = run("extract sample.nhdr out2 -q --smallest 1");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(holds(outcome.errors, "which contains control characters. Correct it."));
    EXPECT_TRUE(is_clean(outcome.errors)) << outcome.errors;
  }
  test::write_bytes(folder_ / "list.txt", "body.ply\0more\n"s);
  const Outcome list = run("batch @list.txt -o out3");
  EXPECT_EQ(list.exit_code, 2);
  EXPECT_TRUE(holds(list.errors, "contains a NUL"));
}

}  // namespace
}  // namespace wscvt
