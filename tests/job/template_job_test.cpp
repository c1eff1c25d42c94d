// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/template_job.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

std::vector<std::pair<double, double>> points_of(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "equivalent_diameter [length],finer_by_mass [%]\r");
  std::vector<std::pair<double, double>> points;
  char comma = 0;
  for (double d = 0.0, p = 0.0; lines >> d >> comma >> p;) points.emplace_back(d, p);
  return points;
}

// A grain of half the mass of all has its middle at 75 %, and the last small one at 7.5/16.
TEST(TemplateFiles, HoldTheSizeCurveByMass) {
  const auto points = points_of(size_curve_csv({2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}));
  ASSERT_EQ(points.size(), 51U);
  EXPECT_EQ(points.front().second, 0.0);
  EXPECT_EQ(points.back().second, 100.0);
  EXPECT_NEAR(points.front().first, 1.0, 1.1e-8);
  EXPECT_DOUBLE_EQ(points.back().first, 2.0);
  EXPECT_NEAR(points[23].first, 1.0, 1e-8);  // 46 %
  EXPECT_NEAR(points[30].first, 1.0 + (0.6 - 7.5 / 16.0) / (0.75 - 7.5 / 16.0), 2e-8);
  EXPECT_NEAR(points[38].first, 2.0, 1e-8);  // 76 %
  for (std::size_t k = 1; k < points.size(); ++k) EXPECT_GT(points[k].first, points[k - 1].first);
  EXPECT_EQ(points_of(size_curve_csv({3.0})).size(), 51U);
  EXPECT_ERROR(size_curve_csv({}), InvalidInput);
}

// Masses of 1, 8 and 64: half of all is 31.5 of the 36 between the middles of the last two.
TEST(TemplateFiles, HaveTheQuantilesOfStatistics) {
  const std::vector<double> diameters = {2.0, 4.0, 1.0};
  const double middle = 2.0 + 2.0 * 31.5 / 36.0;
  const auto points = points_of(size_curve_csv(diameters));
  ASSERT_EQ(points.size(), 51U);
  EXPECT_NEAR(points[25].second, 50.0, 1e-12);
  EXPECT_NEAR(points[25].first, middle, 1e-8 * middle);
  // MercuryDPM takes radii and fractions.
  std::istringstream lines(mercury_psd_csv(diameters));
  char comma = 0;
  std::size_t line = 0;
  for (double radius = 0.0, fraction = 0.0; lines >> radius >> comma >> fraction; ++line) {
    EXPECT_NEAR(radius, 0.5 * points[line].first, 1e-12);
    EXPECT_NEAR(fraction, 0.01 * points[line].second, 1e-12);
  }
  EXPECT_EQ(line, 51U);
}

/// Nine grains of two descriptors, with bodies that are not in their principal frames.
class TemplatesOfASample : public test::FileFolder {
 protected:
  static constexpr std::size_t count_ = 9;

  static DescribedSample sample() {
    DescribedSample result;
    result.descriptors.resize(count_, 2);
    for (std::size_t k = 0; k < count_; ++k) {
      const auto x = static_cast<double>(k);
      result.files.push_back("scans/s" + std::to_string(k) + ".stl");
      result.diameters.push_back(3.0 + std::sin(2.0 * x));
      result.descriptors(static_cast<Eigen::Index>(k), 0) = std::cos(x);
      result.descriptors(static_cast<Eigen::Index>(k), 1) = 5.0 + std::sin(1.7 * x * x);
    }
    result.left_out = 2;
    return result;
  }

  /// The body of a grain; its axes depend on its number.
  static IndexedMesh body(const std::string& file) {
    const int number = file.at(file.size() - 5) - '0';
    const Vector3 axes(1.0, 1.2, 1.5 + 0.3 * number);
    return test::transformed(test::scaled(test::sphere(2), axes),
                             test::random_rotation(static_cast<std::uint64_t>(number) + 1),
                             Vector3(4.0, -number, 1.0));
  }

  TemplateJob job() const {
    TemplateJob result;
    result.folder = path("out");
    result.nodes = 60;
    result.descriptors = {"one", "two"};
    result.options.count = 3;
    result.options.seed = 5;
    return result;
  }

  static MadeSample make(const TemplateJob& job, const DescribedSample& of = sample()) {
    return make_templates(
        job, of, [](const std::string& file, const Execution&) { return body(file); }, {1});
  }
};

TEST_F(TemplatesOfASample, HaveTheNumbersOfTheirGrains) {
  const MadeSample made = make(job());
  EXPECT_EQ(made.end.done, 3U);
  const DescribedSample of = sample();
  std::vector<double> masses;
  for (const double diameter : of.diameters) masses.push_back(std::pow(diameter, 3));
  const SampleTemplates chosen =
      choose_templates(of.descriptors, masses, job().options, Execution(1));
  const auto table = test::csv_records(content("out/templates.csv"));
  ASSERT_EQ(table.size(), 4U);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<std::string>& row = table[k + 1];
    const std::size_t grain = chosen.grains[k];
    const std::string name = "template-0" + std::to_string(k + 1);
    EXPECT_EQ(row[0], name);
    EXPECT_EQ(row[1], name + ".ply");
    EXPECT_EQ(row[2], "s" + std::to_string(grain) + ".stl");
    EXPECT_NEAR(std::stod(row[3]), chosen.by_number[k], 1e-12);
    EXPECT_NEAR(std::stod(row[4]), chosen.by_mass[k], 1e-12);
    double smallest = 9.0, largest = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (chosen.stands_for[i] != k) continue;
      smallest = std::min(smallest, of.diameters[i]);
      largest = std::max(largest, of.diameters[i]);
    }
    EXPECT_NEAR(std::stod(row[5]), of.diameters[grain], 1e-12);
    EXPECT_NEAR(std::stod(row[6]), smallest, 1e-12);
    EXPECT_NEAR(std::stod(row[7]), largest, 1e-12);
    for (Eigen::Index j = 0; j < 2; ++j) {
      EXPECT_NEAR(std::stod(row[8 + static_cast<std::size_t>(j)]),
                  of.descriptors(static_cast<Eigen::Index>(grain), j), 1e-12);
    }
    const IndexedMesh mesh = read_mesh(path("out/" + name + ".ply"));
    EXPECT_EQ(mesh.points.size(), 60U);
    const ShapeDescriptors shape = describe_shape(mesh, Execution(1));
    EXPECT_NEAR(shape.volume, test::pi / 6.0, 1e-6);
    EXPECT_LT(shape.centroid.norm(), 1e-6);
    const Eigen::Matrix3d& inertia = shape.inertia_tensor;
    EXPECT_LT(std::abs(inertia(0, 1)) + std::abs(inertia(0, 2)) + std::abs(inertia(1, 2)), 1e-6);
    EXPECT_LT(inertia(0, 0), inertia(1, 1));
    // The axes of the chosen grain.
    const Vector3 expected = describe_shape(body(of.files[grain]), Execution(1)).inertia_semi_axes;
    EXPECT_NEAR(shape.inertia_semi_axes[2] / shape.inertia_semi_axes[0], expected[2] / expected[0],
                0.04 * expected[2] / expected[0]);
  }
  EXPECT_EQ(content("out/sizes.csv"), size_curve_csv(of.diameters));
  EXPECT_EQ(content("out/mercury_psd.csv"), mercury_psd_csv(of.diameters));

  const auto distances = test::csv_records(content("out/distances.csv"));
  ASSERT_EQ(distances.size(), 4U);
  EXPECT_EQ(distances[0], (std::vector<std::string>{"descriptor", "by_number", "random_by_number",
                                                    "by_mass", "random_by_mass"}));
  const std::vector<const std::vector<double>*> columns = {
      &chosen.reached.by_number, &chosen.random.by_number, &chosen.reached.by_mass,
      &chosen.random.by_mass};
  for (std::size_t c = 0; c < 4; ++c) {
    const std::vector<double>& expected = *columns[c];
    EXPECT_NEAR(std::stod(distances[1][c + 1]), expected[0], 1e-12);
    EXPECT_NEAR(std::stod(distances[2][c + 1]), expected[1], 1e-12);
    EXPECT_NEAR(std::stod(distances[3][c + 1]), 0.5 * (expected[0] + expected[1]), 1e-12);
  }
  ASSERT_EQ(made.lines.size(), 6U);
  EXPECT_EQ(made.lines[0], "3 templates of 9 grains (2 left out), seed 5.");
  // The log has the same table.
  for (std::size_t r = 1; r < 4; ++r) {
    std::istringstream line(made.lines[r + 2]);
    std::string word;
    line >> word;
    EXPECT_EQ(word, distances[r][0]);
    for (std::size_t c = 1; c < 5; ++c) {
      double told = -1.0;
      line >> told;
      EXPECT_NEAR(told, std::stod(distances[r][c]), 0.005 * std::stod(distances[r][c])) << r << c;
    }
  }
}

// A table's diameter is that of the scan that its row names.
TEST_F(TemplatesOfASample, AreRefusedIfTheirScanIsNotTheOneOfTheTable) {
  DescribedSample of = sample();
  for (std::size_t k = 0; k < count_; ++k) {
    const double volume = describe_shape(body(of.files[k]), Execution(1)).volume;
    of.diameters[k] = std::cbrt(6.0 / test::pi * volume);
    of.measured_before.insert(of.files[k]);
  }
  EXPECT_EQ(make(job(), of).end.done, 3U);
  const std::string source = test::csv_records(content("out/templates.csv"))[2][2];
  std::filesystem::remove_all(path("out"));
  const auto chosen = static_cast<std::size_t>(source.at(1) - '0');
  of.diameters[chosen] *= 1.00001;
  EXPECT_ERROR(make(job(), of), InputOutput);
  // What was measured from the scan itself is not compared.
  of.measured_before.erase(of.files[chosen]);
  EXPECT_EQ(make(job(), of).end.done, 3U);
}

TEST_F(TemplatesOfASample, GoOnOnlyWithTheSameOptionsAndAsAWholeHaveTheFilesOfTheSample) {
  const std::vector<std::function<void(TemplateJob&)>> changes = {
      [](TemplateJob&) {},
      [](TemplateJob& job) { job.format = "stl"; },
      [](TemplateJob& job) { job.nodes = 41; },
      [](TemplateJob& job) { job.options.count = 2; },
      [](TemplateJob& job) { job.options.seed = 6; },
      [](TemplateJob& job) {
        job.descriptors = {"one", "three"};
      }};
  // In a part without grains only the call is written.
  Shard shard{1, 50};
  while (is_of(shard, "template-01") || is_of(shard, "template-02") ||
         is_of(shard, "template-03")) {
    ++shard.index;
  }
  const std::string call = "out/call-" + std::to_string(shard.index) + "-of-50.json";
  std::set<std::string> calls;
  for (const auto& change : changes) {
    std::filesystem::remove_all(path("out"));
    TemplateJob options = job();
    change(options);
    options.shard = shard;
    EXPECT_TRUE(make(options).lines.empty());
    EXPECT_TRUE(calls.insert(content(call)).second) << content(call);
    EXPECT_EQ(content("out/sizes.csv"), "");
  }
  // Scans that were replaced by others of the same names.
  std::filesystem::remove_all(path("out"));
  DescribedSample replaced = sample();
  replaced.diameters[4] *= 1.5;
  TemplateJob options = job();
  options.shard = shard;
  make(options, replaced);
  EXPECT_TRUE(calls.insert(content(call)).second) << content(call);
  const std::string scan = file("out/template-03.ply", "a scan");
  EXPECT_ERROR(require_scans_kept(job(), {scan}), InvalidInput);
}

}  // namespace
}  // namespace wscvt
