// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "support/comma_decimals.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptor_table.h"

namespace wscvt {
namespace {

/// A result as the remesher fills it in, with a sphere of 10242 nodes as the scan.
RemeshResult example() {
  const Execution execution(1);
  const IndexedMesh scan = test::sphere(5);
  const IndexedMesh coarse = test::sphere(3);
  RemeshResult result;
  result.mesh = coarse;
  result.original = describe_shape(scan, execution);
  result.remesh = describe_shape(coarse, execution);
  result.original_quality = measure_quality(scan);
  result.quality = measure_quality(coarse);
  result.input.input_vertices = scan.points.size();
  result.input.input_faces = scan.triangles.size();
  result.input.vertices = scan.points.size();
  result.input.faces = scan.triangles.size();
  result.input.components = 1;
  result.input.equivalent_radius = 1.0;
  result.fit.requested_degree = 20;
  result.fit.degree = 20;
  result.fit.rays = scan.points.size();
  result.fit.residual = 0.0039;
  result.relaxation.outcome = RelaxationOutcome::Converged;
  result.relaxation.iterations = 2;
  result.relaxation.history = {{0.1, 0.2, 30}, {9e-4, 0.05, 1}};
  return result;
}

std::string text_of(const RemeshResult& result) {
  std::string text;
  for (const std::string& line : report_lines(result)) text += line + "\n";
  return text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Report, TextSaysWhatHappened) {
  const std::string text = text_of(example());
  for (const char* part :
       {"10242 vertices, 20480 faces", "none needed", "genus 0", "0 % of the solid angle",
        "degree 20, residual 0.0039 (0.39 % of the equivalent radius)", "WSCVT-D",
        "converged after 2 iterations", "displacement 0.0009 h", "642 nodes, 1280 faces",
        "error %"}) {
    EXPECT_TRUE(contains(text, part)) << part << "\nnot in\n" << text;
  }
  EXPECT_FALSE(contains(text, "lowered"));
  EXPECT_FALSE(contains(text, "Warning"));
}

TEST(Report, TextHasARowForEveryDescriptor) {
  const std::vector<std::string> lines = report_lines(example());
  for (const DescriptorValue& row : list_descriptors(ShapeDescriptors())) {
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const std::string& l) { return contains(l, row.label); }),
              1)
        << row.label;
  }
}

TEST(Report, TableColumnsLineUp) {
  const std::vector<std::string> lines = report_lines(example());
  const auto head = std::find_if(lines.begin(), lines.end(), [](const std::string& l) {
    return l.rfind("Descriptor", 0) == 0;
  });
  ASSERT_NE(head, lines.end());
  const std::size_t rows = list_descriptors(ShapeDescriptors()).size();
  ASSERT_GE(static_cast<std::size_t>(lines.end() - head), rows + 1);
  for (std::size_t i = 1; i <= rows; ++i) {
    EXPECT_EQ((head + static_cast<std::ptrdiff_t>(i))->size(), head->size());
  }
}

TEST(Report, TextNamesRepairsLoweredDegreeAndTheLimit) {
  RemeshResult result = example();
  result.input.welded_vertices = 1;
  result.input.degenerate_faces = 4;
  result.input.components = 3;
  result.input.dropped_faces = 100;
  result.input.dropped_volume_share = 0.0123;
  result.folded_share = 0.0005;
  result.fit.requested_degree = 20;
  result.fit.degree = 9;
  result.fit.rays = 230;
  result.input.split_vertices = 2;
  result.input.sliver_faces = 1;
  result.relaxation.outcome = RelaxationOutcome::IterationLimit;
  result.warnings = {"First warning.", "Second warning."};
  const std::string text = text_of(result);
  for (const char* part :
       {"1 equal vertex merged", "4 degenerate faces dropped",
        "2 smaller components dropped (100 faces, 1.23 % of the volume)",
        "2 vertices added where the surface touched itself", "1 face of no area kept",
        "0.05 % of the solid angle",
        "degree 9 (lowered from 20: above it the series is not positive everywhere)",
        "not converged: stopped at the limit of 2 iterations", "First warning.",
        "Second warning."}) {
    EXPECT_TRUE(contains(text, part)) << part << "\nnot in\n" << text;
  }
}

TEST(Report, TextNamesSeedAndExponentsOnlyWhereTheyMatter) {
  RemeshResult result = example();
  EXPECT_FALSE(contains(text_of(result), "alpha"));
  EXPECT_FALSE(contains(text_of(result), "exponent"));
  result.options.weighting.kind = Weighting::Curvature;
  result.options.weighting.curvature_alpha = 1.25;
  result.options.seeding.start = SeedStart::Random;
  result.options.seeding.random_seed = 77;
  EXPECT_TRUE(contains(text_of(result), "alpha 1.25"));
  EXPECT_TRUE(contains(text_of(result), "seed 77"));
  result.options.weighting.kind = Weighting::ErrorAdaptive;
  result.options.weighting.adaptive_exponent = 0.75;
  EXPECT_TRUE(contains(text_of(result), "curvature exponent 0.75"));
}

TEST(Report, DoesNotDependOnTheLocale) {
  const RemeshResult result = example();
  const std::string text = text_of(result);
  const std::string json = report_json(result);
  const std::string csv = report_csv(result);
  const test::GermanNumbers german;
  EXPECT_EQ(text_of(result), text);
  EXPECT_EQ(report_json(result), json);
  EXPECT_EQ(report_csv(result), csv);
}

TEST(Report, JsonHoldsTheNumbersToTheLastBit) {
  const RemeshResult result = example();
  const auto json = nlohmann::json::parse(report_json(result));
  EXPECT_EQ(json.at("format"), "wscvt-report");
  EXPECT_EQ(json.at("result").at("vertices"), 642);
  EXPECT_EQ(json.at("fit").at("residual").get<double>(), result.fit.residual);
  EXPECT_EQ(json.at("quality").at("remesh").at("edge_length").at("mean").get<double>(),
            result.quality.edge_length.mean);
  const auto& volume = json.at("descriptors").at("volume");
  EXPECT_EQ(volume.at("original").get<double>(), result.original.volume);
  EXPECT_EQ(volume.at("remesh").get<double>(), result.remesh.volume);
  EXPECT_EQ(volume.at("error_percent").get<double>(),
            relative_error_percent(result.remesh.volume, result.original.volume));
  EXPECT_EQ(json.at("relaxation").at("history").at("flips"), nlohmann::json({30, 1}));
  EXPECT_TRUE(json.at("warnings").empty());
}

TEST(Report, JsonStaysValidWithNumbersAndBytesItCannotHold) {
  RemeshResult result = example();
  result.remesh.sdq = std::numeric_limits<double>::quiet_NaN();
  result.original.sdq = 0.0;
  result.input.equivalent_radius = 0.0;
  result.warnings = {"file \xff.ply", "a \"quote\"\n"};
  const auto json = nlohmann::json::parse(report_json(result));
  EXPECT_TRUE(json.at("descriptors").at("sdq_invariant").at("remesh").is_null());
  EXPECT_EQ(json.at("warnings").at(1), "a \"quote\"\n");
  EXPECT_FALSE(text_of(result).empty());
}

TEST(Report, CsvIsAHeaderAndARowOfAsManyFields) {
  RemeshResult result = example();
  result.warnings = {"One, with a comma.", "Two \"quoted\"."};
  const std::string csv = report_csv(result);
  const std::size_t header_end = csv.find("\r\n");
  ASSERT_NE(header_end, std::string::npos);
  EXPECT_EQ(csv.find("\r\n", header_end + 2), csv.size() - 2);
  const std::string header = csv.substr(0, header_end);
  const std::string row = csv.substr(header_end + 2);
  // The warnings' quoted field holds one comma of its own.
  EXPECT_EQ(std::count(header.begin(), header.end(), ',') + 1,
            std::count(row.begin(), row.end(), ','));
  EXPECT_EQ(header.rfind("nodes,faces,sampling,weighting", 0), 0U);
  EXPECT_EQ(row.rfind("642,1280,weighted,radial distance (WSCVT-D)", 0), 0U);
  EXPECT_TRUE(contains(header, "volume_original,volume_remesh,volume_error_percent"));
  EXPECT_TRUE(contains(row, "\"One, with a comma. Two \"\"quoted\"\".\"\r\n"));
}

TEST(Report, JsonKeysKeepTheirOrder) {
  const std::string json = report_json(example());
  std::size_t last = 0;
  for (const char* key : {"\"format\"", "\"options\"", "\"input\"", "\"fit\"", "\"relaxation\"",
                          "\"quality\"", "\"descriptors\"", "\"warnings\""}) {
    const std::size_t place = json.find(key, last);
    ASSERT_NE(place, std::string::npos) << key;
    last = place;
  }
}

}  // namespace
}  // namespace wscvt
