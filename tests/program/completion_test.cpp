// SPDX-License-Identifier: GPL-3.0-or-later
// What bash completes after the program's own script was read.
#include <set>
#include <sstream>
#include <string>

#include "program_run.h"
#include "wscvt/remesh/remesh_options.h"

namespace wscvt {
namespace {

class Completion : public test::ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    const Outcome script = run("--completion");
    ASSERT_EQ(script.exit_code, 0) << script.errors;
    std::ofstream(folder_ / "wscvt.bash") << script.output;
  }
  /// Of the last of the words, which may be empty.
  std::set<std::string> completed(const std::string& words) const {
    std::ofstream(folder_ / "complete.sh")
        << "set -u\n. ./wscvt.bash\nCOMP_WORDS=(" << words
        << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_wscvt\n"
           "for one in \"${COMPREPLY[@]}\"; do echo \"$one\"; done >completed.txt\n";
    EXPECT_EQ(std::system(("cd '" + folder_.string() + "' && bash complete.sh").c_str()), 0);
    std::istringstream lines(content("completed.txt"));
    std::set<std::string> result;
    for (std::string line; std::getline(lines, line);) result.insert(line);
    return result;
  }
};

using Words = std::set<std::string>;

TEST_F(Completion, KnowsCommandsOptionsAndChoices) {
  EXPECT_EQ(completed("wscvt c"), (Words{"clump", "convex", "create"}));
  EXPECT_EQ(completed("wscvt --v"), Words{"--version"});
  EXPECT_EQ(completed("wscvt remesh a.ply --max-"),
            (Words{"--max-error", "--max-handle-loop", "--max-nodes", "--max-overhang",
                   "--max-repaired-area"}));
  EXPECT_EQ(completed("wscvt a.ply b.ply --edge-r"), Words{"--edge-ratio"});
  EXPECT_EQ(completed("wscvt batch --sha"), Words{"--shard"});
  EXPECT_EQ(completed("wscvt describe a.ply --ref"), Words());
  Words weightings;
  for (const auto& row : enumerators<CellWeighting>()) weightings.emplace(row.key);
  for (const auto& row : enumerators<Weighting>()) weightings.emplace(row.key);
  EXPECT_EQ(completed("wscvt remesh --weighting ''"), weightings);
  // Both methods' values: those of the method on the scan are other ones.
  Words placements;
  for (const auto& row : enumerators<ScanPlacement>()) placements.emplace(row.key);
  for (const auto& row : enumerators<PublishedPlacement>()) placements.emplace(row.key);
  EXPECT_EQ(completed("wscvt remesh --placement ''"), placements);
  EXPECT_EQ(completed("wscvt a.ply b.ply -w wscvt-c"), Words{"wscvt-c"});
  EXPECT_EQ(completed("wscvt remesh --weighting = wscvt-c"), Words{"wscvt-c"});
  EXPECT_EQ(completed("wscvt remesh scan"), Words()) << "files are bash's own";
  EXPECT_EQ(completed("wscvt remesh --js"), Words()) << "that name is of old scripts";
}

TEST_F(Completion, TellsCommandsApart) {
  EXPECT_EQ(completed("wscvt he"), Words{"help"});
  EXPECT_EQ(completed("wscvt help cr"), Words{"create"});
  EXPECT_EQ(completed("wscvt remesh --frame ''"), (Words{"input", "centred", "principal"}));
  EXPECT_EQ(completed("wscvt extract --time ''"), Words()) << "a number";
  EXPECT_EQ(completed("wscvt create s"), Words{"superellipsoid"});
  EXPECT_EQ(completed("wscvt remesh s"), Words());
  EXPECT_EQ(completed("wscvt extract --out"), Words{"--output"});
}

}  // namespace
}  // namespace wscvt
