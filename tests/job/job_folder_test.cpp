// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/job_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

TEST(JobFolder, NamesFilesAfterTheirGrainsAndTablesAfterTheirPart) {
  const JobFolder folder("out", "ascii.stl", {});
  EXPECT_EQ(folder.name_of("scans/a.b.ply"), "a.b.ascii.stl");
  EXPECT_EQ(folder.name_of("scans/a.ply.gz"), "a.ascii.stl");
  EXPECT_EQ(folder.name_of("scans/sample.nrrd/12"), "12.ascii.stl");
  EXPECT_EQ(folder.file_of("scans/a.ply"), "out/a.ascii.stl");
  EXPECT_EQ(folder.file_of("scans/a.ply", {"sdf", "npy.json"}), "out/sdf/a.npy.json");
  EXPECT_EQ(folder.table(), "out/grains.csv");
  const JobFolder named("out", "ply", {2, 5}, true);
  EXPECT_EQ(named.name_of("scans/sample.nii.gz/12"), "sample-12.ply");
  EXPECT_EQ(named.name_of("scans/a.ply"), "a.ply") << "a file has its own name";
  EXPECT_EQ(named.name_of("7"), "7.ply");
  EXPECT_EQ(named.file("shape", ".csv"), "out/shape-2-of-5.csv");
}

class KeptFiles : public test::FileFolder {
 protected:
  bool is_kept(const std::string& name) const { return is_kept_by_job(path(name)); }

  /// The folder of a job, with the tables of grains that lie elsewhere.
  void write_job(const std::string& folder, const std::string& call) const {
    for (const char* inner : {"node-table", "sdf"}) fs::create_directories(path(folder + inner));
    if (!call.empty()) file(folder + "call.json", call);
    file(folder + "grains.csv",
         "grain,status\r\nscans/a.stl,done\r\nscans/sample.nrrd/12,done\r\n");
  }
};

TEST_F(KeptFiles, AreTheTablesPagesAndFilesOfItsGrains) {
  write_job("out/", R"({"format": "wscvt-batch", "meshes": "ply"})");
  for (const char* name :
       {"grains.csv", "grains-1-of-2.csv", "shape.csv", "mass.csv", "labels.csv", "summary.html",
        "summary.json", "call.json", "a.ply", "12.ply", "sample-12.ply", "node-table/a.shp",
        "sdf/a.npy.json", "sdf/sample-12.vti"}) {
    EXPECT_TRUE(is_kept("out/" + std::string(name))) << name;
  }
  for (const char* name : {"b.ply", "a.stl", "other.csv", "node-table/b.csv", "sdf/grains.csv",
                           "a.ply.txt", "scans/a.ply"}) {
    EXPECT_FALSE(is_kept("out/" + std::string(name))) << name;
  }
  EXPECT_FALSE(is_kept("a.ply"));
  EXPECT_EQ(kept_call(path("out")), content("out/call.json"));
  EXPECT_EQ(kept_call(path("elsewhere")), "");
  EXPECT_EQ(format_of_call(content("out/call.json")), "wscvt-batch");
  EXPECT_EQ(format_of_call("no call"), "");
}

TEST_F(KeptFiles, AreThoseOfClumpsPartsLevelsAndPartsOfASampleToo) {
  write_job("clumps/", R"({"format": "wscvt-clumps", "clumps": "csv"})");
  EXPECT_TRUE(is_kept("clumps/a.csv"));
  write_job("convex/", R"({"format": "wscvt-convex", "parts": "urdf"})");
  EXPECT_TRUE(is_kept("convex/a.urdf"));
  EXPECT_FALSE(is_kept("convex/a.csv"));
  write_job("levels/n100/", "");
  EXPECT_FALSE(is_kept("levels/n100/a.ply"));
  file("levels/call.json", R"({"format": "wscvt-batch", "meshes": "ply"})");
  EXPECT_TRUE(is_kept("levels/n100/a.ply"));
  EXPECT_TRUE(is_kept("levels/n100/sdf/a.vti"));
  write_job("part/", "");
  file("part/call-1-of-2.json", R"({"format": "wscvt-batch", "meshes": "ply"})");
  EXPECT_TRUE(is_kept("part/a.ply"));
  EXPECT_EQ(kept_call(path("part")), content("part/call-1-of-2.json"));
}

TEST_F(KeptFiles, OfOtherCommandsAreNotReplaced) {
  for (const std::string table : {"labels", "bodies", "fragments", "grown", "templates"}) {
    const std::string name = file(table + ".csv", "grain,file\r\nx,one.ply\r\ny,\r\n");
    const auto refusal_of = [&](const std::string& own, const std::string& made) {
      return test::refusal(ErrorCode::InvalidInput, [&] {
        require_no_other_results(folder_.string(), own, {"two.ply", made});
      });
    };
    EXPECT_TRUE(test::holds(refusal_of("", "one.ply"), table + ".csv")) << table;
    EXPECT_NE(refusal_of("", table + ".csv"), "") << table;
    EXPECT_EQ(refusal_of("", "three.ply"), "") << table;
    EXPECT_EQ(refusal_of(table, "one.ply"), "") << "its own";
    fs::remove(name);
  }
  file("grains.csv", "grain,status\r\na,done\r\n");
  EXPECT_NO_THROW(require_own_table(folder_.string(), "grains.csv", "grain,status\r\n"));
  EXPECT_NO_THROW(require_own_table(folder_.string(), "none.csv", "grain\r\n"));
  for (const char* other : {"grain\r\n", "grain,status,error\r\n"}) {
    EXPECT_ERROR(require_own_table(folder_.string(), "grains.csv", other), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
