// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/remesh_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "differing_calls.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/report/sample_report.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;
using Row = test::CsvRow;
using test::holds;

/// An ellipsoid and a lumpy body away from the origin, and one that cannot be remeshed. Each scan
/// has a warning, as from its file.
class RemeshedScans : public NamedGrains {
 public:
  explicit RemeshedScans(std::size_t count = 3) : NamedGrains("scans/g", count, 1) {}

  static IndexedMesh mesh(std::size_t grain) {
    if (grain == 2) return test::box(1.0, 1.0, 0.0);
    const IndexedMesh shape =
        grain == 0 ? test::scaled(test::sphere(2), Vector3(1.0, 2.0, 3.0)) : test::lumpy(2);
    return test::transformed(shape, test::random_rotation(4 + grain),
                             Vector3(7.0, static_cast<double>(grain), -2.0));
  }

  GrainScan read(std::size_t grain, bool /*with_pictures*/, const Execution&) override {
    GrainScan scan;
    scan.mesh = mesh(grain);
    scan.warnings = {"Read with care."};
    scan.voxel_size = 0.6;
    if (grain == 1) {
      MeshAttribute height{"height", ScalarType::Float64, {}};
      for (const Vector3& p : scan.mesh.points) height.values.push_back(p.z());
      scan.attributes.of_vertices.push_back(height);
    }
    return scan;
  }
};

class Remeshes : public test::FileFolder {
 protected:
  std::map<std::string, Row> rows(const std::string& table) const {
    return test::csv_rows(content(table), "grain");
  }

  GrainJob run(const RemeshJob& options, std::size_t count = 3) const {
    check_job(options);
    const GrainJob job = make_job(options, path("out"));
    RemeshedScans grains(count);
    const JobEnd end = run_job(job, grains, {1});
    EXPECT_EQ(end.done, count);
    EXPECT_EQ(end.failed, count == 3 ? 1U : 0U);
    return job;
  }
};

// Each number is that of the grain alone, in the frame and size of its level's files.
TEST_F(Remeshes, OfLevelsAreThoseOfTheGrainAlone) {
  RemeshJob options;
  options.levels = {40, 60};
  options.remesh.node_count = 60;
  options.shapes.described = Described::Remesh;
  options.simulation.frame = {Frame::Centred, 1.0, 4.0};
  options.node_tables = {"csv"};
  const GrainJob job = run(options);
  for (const int nodes : options.levels) {
    const std::string level = "out/n" + std::to_string(nodes) + "/";
    const auto grains = rows(level + "grains.csv");
    const auto shapes = rows(level + "shape.csv");
    const auto masses = rows(level + "mass.csv");
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string name = RemeshedScans().name(k);
      const std::string file = "g" + std::to_string(k + 1) + ".ply";
      const IndexedMesh scan = RemeshedScans::mesh(k);
      const IndexedMesh made = read_mesh(path(level + file));
      EXPECT_EQ(made.points.size(), static_cast<std::size_t>(nodes));
      const ShapeDescriptors measured = describe_shape(made, Execution(1));
      EXPECT_NEAR(measured.volume, test::pi / 6.0 * 64.0, 1e-6);
      EXPECT_EQ(grains.at(name).at("result.vertices"), std::to_string(nodes));
      EXPECT_TRUE(holds(grains.at(name).at("warnings"), "Read with care."));
      const Row& shape = shapes.at(name);
      EXPECT_EQ(shape.at("file"), file);
      EXPECT_EQ(shape.at("nodes"), std::to_string(nodes));
      // The remesh is written larger; ratios stay.
      EXPECT_NEAR(std::stod(shape.at("remesh.sphericity_wadell")), measured.sphericity, 1e-6);
      const Row& mass = masses.at(name);
      EXPECT_EQ(mass.at("file"), file);
      EXPECT_NEAR(std::stod(mass.at("volume")), test::pi / 6.0 * 64.0, 1e-9);
      for (const char* axis : {"x", "y", "z"}) {
        EXPECT_NEAR(std::stod(mass.at("centroid." + std::string(axis))), 0.0, 1e-9);
      }
      const ShapeDescriptors of_scan = describe_shape(scan, Execution(1));
      const double scale = 4.0 / std::cbrt(6.0 / test::pi * of_scan.volume);
      EXPECT_NEAR(std::stod(mass.at("inertia_tensor.xx")),
                  of_scan.inertia_tensor(0, 0) * std::pow(scale, 5), 1e-8);
      const auto table =
          test::csv_records(content(level + "node-table/g" + std::to_string(k + 1) + ".csv"));
      ASSERT_EQ(table.size(), static_cast<std::size_t>(nodes) + 1);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(std::stod(table[1][static_cast<std::size_t>(axis)]), made.points[0][axis],
                    1e-6);
      }
    }
    for (const auto* table : {&grains, &shapes, &masses}) {
      const Row& failed = table->at("scans/g3");
      EXPECT_EQ(failed.at("status"), "failed");
      EXPECT_NE(failed.at("error"), "");
    }
    EXPECT_FALSE(fs::exists(path(level + "g3.ply")));
  }
  const std::vector<std::string> lines = write_summaries(job, Execution(1));
  ASSERT_GE(lines.size(), 2U);
  EXPECT_EQ(lines[0].rfind("n40: 3 grains: 2 remeshed, 2 of them with warnings, 1 failed", 0), 0U)
      << lines[0];
  for (const std::string level : {"out/n40/", "out/n60/"}) {
    const SampleSummary alone = summarise_table(path(level + "grains.csv"));
    EXPECT_EQ(content(level + "summary.json"), summary_json(alone));
    // The page is that of the sample, with the remeshes' own pictures.
    SampleReport report;
    add_sample(report, "", read_sample(path(level), Execution(1)), {}, 0.0, Execution(1));
    ASSERT_TRUE(report.samples.front().batch.has_value());
    for (const GrainDistance& one : report.samples.front().batch->farthest) {
      EXPECT_EQ(one.file, path(level + one.grain.substr(one.grain.rfind('/') + 1) + ".ply"));
    }
    const std::string page = content(level + "summary.html");
    EXPECT_EQ(page, sample_html(report, Execution(1)));
    EXPECT_TRUE(holds(page, "All remeshes, the farthest from its scan first"));
    EXPECT_TRUE(holds(page, "id=\"forms\""));
    EXPECT_TRUE(holds(page, "<td>scans/g3</td>"));
  }
}

TEST_F(Remeshes, HaveTheShapeOfTheirScanAtEachLevelAndWhatItsVoxelsDid) {
  RemeshJob options;
  options.levels = {30, 40};
  options.remesh.node_count = 40;
  options.shapes = {Described::Both, false, true};
  const GrainJob job = run(options, 1);
  const Row few = rows("out/n30/shape.csv").at("scans/g1");
  const Row many = rows("out/n40/shape.csv").at("scans/g1");
  std::size_t compared = 0;
  for (const auto& [column, value] : few) {
    const bool is_of_scan = column.rfind("scan.", 0) == 0 || column.rfind("resolution.", 0) == 0;
    if (!is_of_scan) continue;
    ++compared;
    EXPECT_EQ(many.at(column), value) << column;
  }
  EXPECT_GT(compared, 100U);
  EXPECT_NEAR(std::stod(few.at("scan.volume [length^3]")),
              describe_shape(RemeshedScans::mesh(0), Execution(1)).volume, 1e-9);
  EXPECT_EQ(std::stod(few.at("resolution.voxel_size [length]")), 0.6);
  const std::vector<std::string> lines = write_summaries(job, Execution(1));
  // The voxels resolve fewer than the most nodes, but more than the fewest.
  const double enough = std::stod(few.at("scan.area [length^2]")) / (1.2 * 1.2);
  EXPECT_GT(enough, 31.0);
  EXPECT_LT(enough, 39.0);
  ASSERT_GE(lines.size(), 2U);
  EXPECT_EQ(lines[lines.size() - 2].rfind("Voxels across a grain", 0), 0U);
  EXPECT_TRUE(holds(lines.back(), ": " + std::to_string(std::lround(enough)) + " are enough"));
}

TEST_F(Remeshes, HaveTheirOwnErrorsOfFirstContactWithoutTheShapeOfTheirScan) {
  RemeshJob options;
  options.levels = {20, 30};
  options.remesh.node_count = 30;
  options.shapes = {Described::Remesh, true, false};
  run(options, 1);
  const Row few = rows("out/n20/shape.csv").at("scans/g1");
  const Row many = rows("out/n30/shape.csv").at("scans/g1");
  EXPECT_EQ(few.at("status"), "done");
  EXPECT_NE(few.at("contact_error_mean [%]"), "");
  EXPECT_NE(few.at("contact_error_mean [%]"), many.at("contact_error_mean [%]"));
  EXPECT_EQ(few.count("scan.volume [length^3]"), 0U);
}

TEST_F(Remeshes, CarryTheAttributesOfTheirScans) {
  RemeshJob options;
  options.remesh.node_count = 40;
  options.shapes.described = Described::None;
  const GrainJob job = run(options);
  EXPECT_TRUE(job.reads_pictures);
  const MeshFile made = read_mesh_file(path("out/g2.ply"), Execution(1));
  ASSERT_EQ(made.attributes.of_vertices.size(), 1U);
  for (std::size_t v = 0; v < made.mesh.points.size(); ++v) {
    EXPECT_NEAR(made.attributes.of_vertices[0].values[v], made.mesh.points[v].z(), 0.2);
  }
  EXPECT_TRUE(read_mesh_file(path("out/g1.ply"), Execution(1)).attributes.of_vertices.empty());
  // Neither scans described nor files for a simulation: one table.
  EXPECT_FALSE(fs::exists(path("out/shape.csv")) || fs::exists(path("out/mass.csv")));
  GrainJob part = job;
  part.shard = {1, 2};
  EXPECT_TRUE(write_summaries(part, Execution(1)).empty());
  EXPECT_FALSE(fs::exists(path("out/summary.json")));
  // The labels of a batch are taken; those of extract, which may stand beside it, are written.
  for (const char* state : {"taken", "written"}) {
    std::string census = label_header();
    census +=
        "v/1,1,," + std::string(state) +
        std::string(static_cast<std::size_t>(std::count(census.begin(), census.end(), ',')) - 3,
                    ',') +
        "\r\n";
    file("out/labels.csv", census);
    write_summaries(job, Execution(1));
    EXPECT_FALSE(holds(content("out/summary.html"), "id=\"forms\""));
    EXPECT_EQ(content("out/summary.html").find("1 label:") != std::string::npos,
              std::string(state) == "taken");
  }
}

TEST_F(Remeshes, MakeGridsOfTheScanAtEachLevel) {
  RemeshJob options;
  options.levels = {30, 40};
  options.remesh.node_count = 40;
  options.shapes.described = Described::None;
  options.grids = {"npy"};
  options.simulation.grid.spacing = 0.5;
  const GrainJob job = run(options);
  for (const std::string kind : {"sdf/g1.npy", "sdf/g2.npy"}) {
    EXPECT_NE(content("out/n30/" + kind), "");
    EXPECT_EQ(content("out/n40/" + kind), content("out/n30/" + kind)) << "of the same scan";
  }
  const std::string description = content("out/n40/sdf/g2.npy.json");
  EXPECT_TRUE(holds(description, "\"scans/g2\""));
  // A description that is lost is made again, with its grain.
  fs::remove(path("out/n30/sdf/g2.npy.json"));
  run(options);
  EXPECT_TRUE(fs::exists(path("out/n30/sdf/g2.npy.json")));
}

TEST(RemeshJobs, GoOnOnlyWithTheSameOptions) {
  const std::vector<std::function<void(RemeshJob&)>> changes = {
      [](RemeshJob&) {},
      [](RemeshJob& job) { job.format = "stl"; },
      [](RemeshJob& job) {
        job.levels = {100, 500};
      },
      [](RemeshJob& job) { job.remesh.node_count = 77; },
      [](RemeshJob& job) { job.shapes.described = Described::Scan; },
      [](RemeshJob& job) { job.shapes.contacts = true; },
      [](RemeshJob& job) { job.shapes.resolution = true; },
      [](RemeshJob& job) { job.volume.smoothing = 3; },
      [](RemeshJob& job) { job.simulation.frame.frame = Frame::Centred; },
      [](RemeshJob& job) { job.simulation.frame.scale = 2.0; },
      [](RemeshJob& job) { job.simulation.frame.size = 2.0; },
      [](RemeshJob& job) { job.simulation.frame.size = 3.0; },
      [](RemeshJob& job) { job.node_tables = {"csv"}; },
      [](RemeshJob& job) { job.grids = {"npy"}; },
      [](RemeshJob& job) {
        job.grids = {"npy"};
        job.simulation.grid.spacing = 0.5;
      }};
  test::expect_calls_differ(changes);
  for (std::size_t k = 0; k < changes.size(); ++k) {
    RemeshJob options;
    changes[k](options);
    EXPECT_EQ(make_job(options, "out").tables.back().name == "mass", k >= 8) << k;
  }
}

TEST(RemeshJobs, RefuseOptionsThatDoNotGoTogether) {
  const std::vector<std::function<void(RemeshJob&)>> wrong = {
      [](RemeshJob& job) {
        job.levels = {50, 50};
      },
      [](RemeshJob& job) {
        job.levels = {50, 60};
        job.remesh.target.percent = 1.0;
      },
      [](RemeshJob& job) { job.remesh.node_count = 3; },
      [](RemeshJob& job) { job.format = "xyzzy"; },
      [](RemeshJob& job) { job.node_tables = {"shp"}; },
      [](RemeshJob& job) { job.grids = {"csv"}; },
      [](RemeshJob& job) {
        job.simulation.frame.size = 1.0;
        job.simulation.frame.scale = 2.0;
      }};
  EXPECT_NO_THROW(check_job(RemeshJob()));
  for (const auto& change : wrong) {
    RemeshJob job;
    change(job);
    EXPECT_ERROR(check_job(job), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
