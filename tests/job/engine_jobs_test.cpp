// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/engine_jobs.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "differing_calls.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Row = test::CsvRow;

/// A long body away from the origin, and one that has no volume.
class EngineScans : public NamedGrains {
 public:
  EngineScans() : NamedGrains("scans/g", 2, 1) {}

  static IndexedMesh mesh() {
    return test::moved(test::scaled(test::box(1.0, 1.0, 1.0), Vector3(3.0, 2.0, 1.0)), 1.0,
                       {5.0, -1.0, 2.0});
  }

  GrainScan read(std::size_t grain, bool /*with_pictures*/, const Execution&) override {
    GrainScan scan;
    scan.mesh = grain == 0 ? mesh() : test::box(1.0, 1.0, 0.0);
    scan.warnings = {"Read with care."};
    return scan;
  }
};

class EngineJobs : public test::FileFolder {
 protected:
  /// Runs a job on the two scans; the rows of its table.
  template <class Job>
  std::vector<Row> rows_of(const Job& options) const {
    check_job(options);
    EngineScans grains;
    const JobEnd end = run_job(make_job(options, path("out")), grains, {1});
    EXPECT_EQ(end.done, 2U);
    EXPECT_EQ(end.failed, 1U);
    EXPECT_EQ(grains_with_warnings(make_job(options, path("out"))), 1U);
    const std::vector<Row> rows = test::csv_rows(content("out/grains.csv"));
    EXPECT_EQ(rows.size(), 2U);
    return rows;
  }

  static void expect_made_and_failed(const std::vector<Row>& rows) {
    EXPECT_EQ(rows[0].at("grain"), "scans/g1");
    EXPECT_EQ(rows[0].at("status"), "done");
    EXPECT_EQ(rows[0].at("source"), "scans/g1");
    EXPECT_EQ(rows[0].at("warnings").rfind("Read with care.", 0), 0U) << rows[0].at("warnings");
    EXPECT_EQ(rows[1].at("status"), "failed");
    EXPECT_NE(rows[1].at("error"), "");
  }
};

/// Returns the number before or behind a text.
double number_at(const std::string& text, const std::string& before, const std::string& behind) {
  const std::size_t end = text.find(behind, text.find(before) + before.size());
  const std::size_t line = text.find_last_of("\n\"", end - 1);
  EXPECT_NE(end, std::string::npos) << text;
  return std::stod(text.substr(line + 1));
}

TEST_F(EngineJobs, WriteClumpsInTheirSizeAndDensity) {
  ClumpJob options;
  options.clump.sphere_count = 2;
  options.frame = {Frame::Principal, 1.0, 4.0};
  options.density = 2.5;
  options.format = "molecule";
  const std::vector<Row> rows = rows_of(options);
  expect_made_and_failed(rows);
  EXPECT_NEAR(std::stod(rows[0].at("grain.volume")), 6.0, 1e-12);
  EXPECT_EQ(rows[0].at("sphere_count"), "2");
  EXPECT_EQ(rows[1].at("grain.volume"), "");
  const std::string file = content("out/g1.molecule");
  EXPECT_EQ(number_at(file, "", " atoms"), 2.0);
  EXPECT_NEAR(number_at(file, "", " mass\n"), 2.5 * test::pi / 6.0 * 64.0, 1e-9);
  EXPECT_FALSE(fs::exists(path("out/g2.molecule")));
}

// MuJoCo takes no inertia as small as that of a grain in metres, which the writer warns of.
TEST_F(EngineJobs, WritePartsInTheirSizeAndDensity) {
  ConvexJob options;
  options.remesh.node_count = 50;
  options.convex.parts = 1;
  options.frame = {Frame::Centred, 1.0, 1e-5};
  options.density = 2.5;
  options.format = "xml";
  const std::vector<Row> rows = rows_of(options);
  expect_made_and_failed(rows);
  EXPECT_TRUE(test::holds(rows[0].at("warnings"), "MuJoCo"));
  EXPECT_NEAR(std::stod(rows[0].at("mass_properties.volume")), 6.0, 1e-12);
  EXPECT_EQ(rows[0].at("parts"), "1");
  EXPECT_EQ(rows[1].at("mass_properties.volume"), "");
  EXPECT_NEAR(number_at(content("out/g1.xml"), " mass=", "\" fullinertia") / 1e-15,
              2.5 * test::pi / 6.0, 1e-9);
  // Beside a .urdf there may be as many files as parts.
  options.convex.parts = 2;
  options.format = "urdf";
  EXPECT_EQ(make_job(options, path("out")).beside(path("a.urdf")),
            (std::vector<std::string>{path("a_1.obj"), path("a_2.obj")}));
}

TEST(EngineOptions, MustBeTheSameToGoOn) {
  test::expect_calls_differ<ClumpJob>({[](ClumpJob&) {}, [](ClumpJob& job) { job.format = "py"; },
                                       [](ClumpJob& job) { job.density = 2.0; },
                                       [](ClumpJob& job) { job.frame.frame = Frame::Principal; },
                                       [](ClumpJob& job) { job.frame.size = 2.0; },
                                       [](ClumpJob& job) { job.frame.scale = 2.0; },
                                       [](ClumpJob& job) { job.clump.sphere_count = 7; },
                                       [](ClumpJob& job) { job.clump.inside = true; }});
  test::expect_calls_differ<ConvexJob>(
      {[](ConvexJob&) {}, [](ConvexJob& job) { job.format = "xml"; },
       [](ConvexJob& job) { job.density = 2.0; },
       [](ConvexJob& job) { job.frame.frame = Frame::Principal; },
       [](ConvexJob& job) { job.frame.size = 2.0; }, [](ConvexJob& job) { job.frame.scale = 2.0; },
       [](ConvexJob& job) { job.convex.parts = 3; }, [](ConvexJob& job) { job.convex.faces = 30; },
       [](ConvexJob& job) { job.convex.tolerance = 3.0; },
       [](ConvexJob& job) { job.remesh.node_count = 77; }});
}

TEST(EngineOptions, AreRefusedOutOfTheirRanges) {
  const auto refuses = [](auto job, const auto& change) {
    EXPECT_NO_THROW(check_job(job));
    change(job);
    EXPECT_ERROR(check_job(job), InvalidInput);
  };
  refuses(ClumpJob(), [](ClumpJob& job) { job.density = 0.0; });
  refuses(ClumpJob(), [](ClumpJob& job) { job.frame.scale = 0.0; });
  refuses(ClumpJob(), [](ClumpJob& job) { job.clump.sphere_count = 0; });
  refuses(ClumpJob(), [](ClumpJob& job) { job.format = "obj"; });
  refuses(ConvexJob(), [](ConvexJob& job) { job.density = 0.0; });
  refuses(ConvexJob(), [](ConvexJob& job) { job.frame.scale = 0.0; });
  refuses(ConvexJob(), [](ConvexJob& job) { job.convex.parts = 0; });
  refuses(ConvexJob(), [](ConvexJob& job) { job.remesh.node_count = 3; });
  refuses(ConvexJob(), [](ConvexJob& job) { job.format = "csv"; });
}

}  // namespace
}  // namespace wscvt
