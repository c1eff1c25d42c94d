// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/remesh.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report_addition.h"

namespace wscvt {
namespace {

using test::holds;

/// A result as the remesher fills it in, with a sphere of 10242 nodes as the scan.
RemeshResult example() {
  const Execution execution(1);
  const IndexedMesh scan = test::sphere(5);
  const IndexedMesh coarse = test::sphere(3);
  RemeshResult result;
  result.mesh = coarse;
  result.scan = describe_shape(scan, execution);
  result.remesh = describe_shape(coarse, execution);
  result.scan_quality = measure_quality(scan);
  result.quality = measure_quality(coarse);
  result.input.input_vertices = scan.points.size();
  result.input.input_faces = scan.triangles.size();
  result.input.vertices = scan.points.size();
  result.input.faces = scan.triangles.size();
  result.input.components = 1;
  result.input.equivalent_radius = 1.0;
  result.options.method = AsPublishedOptions();
  AsPublishedReport report;
  report.fit.requested_degree = 20;
  report.fit.degree = 20;
  report.fit.rays = scan.points.size();
  report.fit.residual = 0.0039;
  report.relaxation.outcome = RelaxationOutcome::Converged;
  report.relaxation.iterations = 2;
  report.relaxation.history = {{0.1, 0.2, 30}, {9e-4, 0.05, 1}};
  result.method = report;
  return result;
}

AsPublishedReport& published(RemeshResult& result) {
  return std::get<AsPublishedReport>(result.method);
}

/// The same result by the method on the scan.
RemeshResult on_scan_example() {
  RemeshResult result = example();
  result.options.method = OnScanOptions();
  OnScanReport report;
  report.nodes.proxy_vertices = 10242;
  report.nodes.equalization_steps = 100;
  report.nodes.fit_rounds = 40;
  report.nodes.fit_flips = 1;
  report.nodes.relocations = 2;
  report.nodes.volume_offset = 0.0125;
  report.nodes.mean_edge_ratio = 1.1035;
  result.method = report;
  return result;
}

std::string text_of(const RemeshResult& result) {
  std::string text;
  for (const std::string& line : report_lines(result)) text += line + "\n";
  return text;
}

TEST(Report, TextSaysWhatHappened) {
  const std::string text = text_of(example());
  for (const char* part :
       {"10242 vertices, 20480 faces", "none needed", "genus 0", "0 % of the solid angle",
        "degree 20, residual 0.0039 (0.39 % of the equivalent radius)", "WSCVT-D",
        "converged after 2 iterations", "displacement 0.0009 h",
        "642 nodes, 1280 faces, placement: SH surface", "error %"}) {
    EXPECT_TRUE(holds(text, part));
  }
  EXPECT_FALSE(holds(text, "lowered"));
  EXPECT_FALSE(holds(text, "Warning"));
}

TEST(Report, TextHasARowForEveryDescriptor) {
  const std::vector<std::string> lines = report_lines(example());
  for (const DescriptorValue& row : list_descriptors(ShapeDescriptors())) {
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const std::string& l) { return holds(l, row.label); }),
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
  result.input.weld_tolerance = 2.5e-12;
  result.input.duplicate_faces = 3;
  result.input.duplicate_area_fraction = 0.015;
  result.input.back_to_back_faces = 2;
  result.input.back_to_back_area_fraction = 0.001;
  result.input.non_manifold_edges = 7;
  result.input.flap_faces = 5;
  result.input.flap_area_fraction = 0.002;
  result.input.filled_holes = 6;
  result.input.filling_faces = 20;
  result.input.filled_area_fraction = 0.003;
  result.input.lost_faces = 8;
  result.input.components = 6;
  result.input.inner_components = 3;
  result.input.inner_volume_fraction = 0.25;
  result.input.dropped_faces = 100;
  result.input.dropped_volume_fraction = 0.0123;
  published(result).overhang_fraction = 0.0005;
  published(result).fit.requested_degree = 20;
  published(result).fit.degree = 9;
  published(result).fit.limit = DegreeLimit::Radius;
  published(result).fit.rays = 230;
  result.input.split_vertices = 2;
  result.input.sliver_faces = 1;
  published(result).relaxation.outcome = RelaxationOutcome::IterationLimit;
  result.warnings = {"First warning.", "Second warning."};
  const std::string text = text_of(result);
  for (const char* part :
       {"1 equal vertex merged (within 2.5e-12)", "4 degenerate faces removed",
        "3 duplicate faces removed (1.5 % of the area)",
        "2 back-to-back faces removed (0.1 % of the area)", "7 non-manifold edges separated",
        "5 faces of flaps and internal walls removed there (0.2 % of the area)", "6 holes filled",
        "20 faces put into them (0.3 % of the area)", "8 faces without a finite position removed",
        "3 inner surfaces removed (25 % of the volume)",
        "2 smaller bodies removed (1.23 % of the volume)", "100 faces removed with them",
        "2 vertices duplicated where the surface touches itself", "1 face of no area kept",
        "0.05 % of the solid angle",
        "degree 9 (lowered from 20: a series of higher degree is not positive everywhere)",
        "not converged: stopped at the limit of 2 iterations", "First warning.",
        "Second warning."}) {
    EXPECT_TRUE(holds(text, part));
  }
}

TEST(Report, SaysHowTheRelaxationEnded) {
  RemeshResult result = example();
  const std::map<RelaxationOutcome, std::string> texts = {
      {RelaxationOutcome::Converged, " converged after 2 iterations"},
      {RelaxationOutcome::Settled, " settled after 2 iterations"},
      {RelaxationOutcome::Stuck, " stuck after 2 iterations"},
      {RelaxationOutcome::IterationLimit, " not converged: stopped at the limit of 2 iterations"}};
  for (const auto& [outcome, text] : texts) {
    published(result).relaxation.outcome = outcome;
    EXPECT_TRUE(holds(text_of(result), text));
  }
}

/// The text of the line that begins with a topic; empty where there is none.
std::string line_of(const RemeshResult& result, const std::string& topic) {
  for (const std::string& line : report_lines(result)) {
    if (line.rfind(topic + " ", 0) != 0) continue;
    return line.substr(line.find_first_not_of(' ', topic.size()));
  }
  return "";
}

TEST(Report, TellsOfTheMethodOnTheScan) {
  RemeshResult result = on_scan_example();
  EXPECT_EQ(line_of(result, "Handles"), "");
  EXPECT_EQ(line_of(result, "Method").rfind("on the scan: ", 0), 0U);
  EXPECT_EQ(line_of(result, "Weighting"), label_of(CellWeighting::Area));
  EXPECT_EQ(line_of(result, "Nodes"),
            "coarsened on 10242 vertices, edge lengths equalized in 100 steps");
  EXPECT_EQ(line_of(result, "Fit"),
            "40 rounds, 1 edge flipped, 2 nodes relocated; volume corrected by an offset of 0.013");
  EXPECT_EQ(line_of(result, "Intersections"), "0 pairs of 1280 triangles");
  auto& report = std::get<OnScanReport>(result.method);
  report.nodes.self_intersections = 1;
  report.nodes.repaired_intersections = 3;
  report.nodes.mean_edge_ratio = 1.1375;
  EXPECT_EQ(line_of(result, "Edge ratio"), "mean 1.137 (wanted 1.1)");
  EXPECT_EQ(line_of(result, "Intersections"), "1 pair of 1280 triangles, 3 removed");
  report.handles.cut = {{0.25, {1, 2, 3}, 3}};
  EXPECT_EQ(line_of(result, "Handles"), "1 handle cut and closed: loop of 0.25 at (1, 2, 3)");
  report.handles.cut.assign(6, {0.5, {-1, 0, 1}, 3});
  std::string six = "6 handles cut and closed: loop of 0.5 at (-1, 0, 1)";
  for (int k = 1; k < 5; ++k) six += "; loop of 0.5 at (-1, 0, 1)";
  EXPECT_EQ(line_of(result, "Handles"), six + "; ...");
  report.handles.cut.clear();
  report.handles.kept = 2;
  report.handles.next = {0.75, {1, 0, 0}, 9};
  EXPECT_EQ(line_of(result, "Handles"),
            "0 handles cut and closed, 2 kept (the next has a loop of 0.75 at (1, 0, 0))");
}

TEST(Report, TellsOfSearchAndLevels) {
  RemeshResult result = example();
  EXPECT_EQ(line_of(result, "Node count"), "");
  result.options.target = {ErrorMeasure::Volume, 0.5, 20000};
  const double none = std::numeric_limits<double>::infinity();
  result.search = NodeCountSearch{true, 642, {{300, none}, {642, 0.4}}};
  EXPECT_EQ(line_of(result, "Node count"),
            "volume error of at most 0.5 %: met by 642 nodes. Tried 300: not possible, 642: 0.4 %");
  result.search->met = false;
  EXPECT_TRUE(holds(line_of(result, "Node count"), "not met, not even by 642 nodes"));
  EXPECT_TRUE(holds(line_of(result, "Relaxation"), "after 2 iterations, displacement"));
  published(result).relaxation.coarser_levels = {{40, 8, RelaxationOutcome::Converged},
                                                 {160, 9, RelaxationOutcome::Converged}};
  EXPECT_TRUE(holds(line_of(result, "Relaxation"),
                    "after 2 iterations (after 9 with 160 seeds, 8 with 40 seeds), displ"));
  std::get<AsPublishedOptions>(result.options.method).sampling = Sampling::Fibonacci;
  EXPECT_EQ(line_of(result, "Sampling"), label_of(Sampling::Fibonacci) + ", not relaxed");
  EXPECT_EQ(line_of(result, "Relaxation"), "");
}

TEST(Report, TellsScanFitAndDistance) {
  RemeshResult result = example();
  result.rms_distance = 0.25;
  result.largest_distance = 0.5;
  result.input.equivalent_radius = 2.0;
  EXPECT_EQ(line_of(result, "Distance"),
            "rms 0.25 (12.5 % of the equivalent radius), largest 0.5 (25 %), two-sided");
  published(result).fit.residual = 0.01;
  EXPECT_EQ(line_of(result, "Fit"),
            "SH series of degree 20, residual 0.01 (0.5 % of the equivalent radius)");
  result.input.input_faces = 0;
  result.input.unreferenced_vertices = 1;
  result.input.reoriented_faces = 2;
  EXPECT_EQ(line_of(result, "Repairs"),
            "1 unused vertex removed, 2 faces turned outward, points triangulated");
  result.input.input_vertices = 0;
  published(result).fit.rays = 0;
  EXPECT_EQ(line_of(result, "Scan"), "surface from a formula or coefficients, equivalent radius 2");
  for (const char* topic : {"Repairs", "Repaired", "Overhang", "Fit"}) {
    EXPECT_EQ(line_of(result, topic), "") << topic;
  }
}

/// The cells of the table's row that begins with a label, as the text of its lines.
std::vector<std::string> cells_of(const RemeshResult& result, const std::string& label) {
  for (const std::string& line : report_lines(result)) {
    if (line.rfind("  " + label + " ", 0) != 0) continue;
    std::istringstream rest(line.substr(2 + label.size()));
    return {std::istream_iterator<std::string>(rest), {}};
  }
  return {};
}

TEST(Report, TablesHoldDistancesAndQualityOfBoth) {
  using Cells = std::vector<std::string>;
  RemeshResult result = example();
  EXPECT_EQ(cells_of(result, "root mean square"), Cells());
  result.input.equivalent_radius = 2.0;
  result.distances = MeshDistances{{0.3, 0.2, 0.1}, {0.4, 0.25, 0.15}, 0.4, 0.25};
  EXPECT_EQ(cells_of(result, "largest"), (Cells{"0.3", "0.4", "0.4", "20"}));
  EXPECT_EQ(cells_of(result, "root mean square"), (Cells{"0.2", "0.25", "0.25", "12.5"}));
  EXPECT_EQ(cells_of(result, "mean"), (Cells{"0.1", "0.15", "0.15", "7.5"}));
  result.scan_quality.edge_length = {};
  result.scan_quality.edge_length.mean = 1.5;
  result.scan_quality.edge_length.standard_deviation = 0.5;
  result.quality.edge_length.mean = 3.0;
  result.quality.edge_length.standard_deviation = 0.75;
  result.scan_quality.valence_six_fraction = 0.5;
  result.quality.valence_six_fraction = 0.875;
  result.scan_quality.edge_variation = 0.0625;
  result.quality.edge_variation = 0.125;
  result.scan_quality.edge_ratio = {1.25, 0.25, 1.0, 5.5};
  result.quality.edge_ratio = {1.125, 0.375, 1.0, 6.5};
  result.scan_quality.smallest_angle = 8.0;
  result.quality.smallest_angle = 9.0;
  result.scan_quality.mean_smallest_angle = 30.0;
  result.quality.mean_smallest_angle = 31.0;
  EXPECT_EQ(cells_of(result, "edge length, CV (deviation / mean)"), (Cells{"0.0625", "0.125"}));
  EXPECT_EQ(cells_of(result, "edge ratio of the triangles, mean"), (Cells{"1.25", "1.125"}));
  EXPECT_EQ(cells_of(result, "edge ratio of the triangles, deviation"), (Cells{"0.25", "0.375"}));
  EXPECT_EQ(cells_of(result, "edge ratio of the triangles, largest"), (Cells{"5.5", "6.5"}));
  EXPECT_EQ(cells_of(result, "smallest angle, degrees"), (Cells{"8", "9"}));
  EXPECT_EQ(cells_of(result, "smallest angle of the triangles, mean, degrees"),
            (Cells{"30", "31"}));
  EXPECT_EQ(cells_of(result, "edge length, mean, length"), (Cells{"1.5", "3"}));
  EXPECT_EQ(cells_of(result, "edge length, deviation, length"), (Cells{"0.5", "0.75"}));
  EXPECT_EQ(cells_of(result, "vertices with six neighbours, %"), (Cells{"50", "87.5"}));
}

TEST(Report, MassTableHoldsTheWholeTensor) {
  NamedMass body{"one", {}};
  body.mass.centroid = Vector3(1, 2, 3);
  body.mass.inertia_tensor << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  body.mass.principal_moments = Vector3(4, 5, 6);
  body.mass.principal_axes = Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4);
  NamedMass other = body;
  other.name = "two";
  other.mass.centroid = Vector3(7, 8, 9);
  const auto rows = mass_rows({body, other});
  ASSERT_EQ(rows.size(), 6U);
  for (const auto& row : rows) ASSERT_EQ(row.size(), 3U);
  const char* const expected[] = {"one",        "1, 2, 3", "11, 22, 33",
                                  "12, 13, 23", "4, 5, 6", "0.1, 0.2, 0.3, 0.4"};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(rows[k][1], expected[k]);
  EXPECT_EQ(rows[0][2], "two");
  EXPECT_EQ(rows[1][2], "7, 8, 9");
}

TEST(Report, MassTableHasNoRounding) {
  NamedMass body{"one", {}};
  body.mass.volume = 4.18879;  // of radius 1
  body.mass.centroid = Vector3(8e-17, -1.7e-11, 1e-6);
  body.mass.inertia_tensor << 2, 1e-17, -1e-12, 1e-17, 2, 1e-7, -1e-12, 1e-7, 2;
  body.mass.principal_moments = Vector3(2, 2, 2);
  body.mass.principal_axes = Eigen::Quaterniond(0.5, 2e-11, -0.5, 1e-8);
  const auto rows = mass_rows({body});
  EXPECT_EQ(rows[1][1], "0, 0, 1e-06");
  EXPECT_EQ(rows[3][1], "0, 0, 1e-07");
  EXPECT_EQ(rows[5][1], "0.5, 0, -0.5, 1e-08");
}

// With six digits a grain of 2 would be 10 from its place.
TEST(Report, MassTableTellsThePlaceOfAGrainFarFromTheOrigin) {
  NamedMass body{"one", {}};
  body.mass.volume = 4.18879;  // of radius 1
  body.mass.centroid = Vector3(500000.3125, -4200000.7, 0.8125);
  EXPECT_EQ(mass_rows({body})[1][1], "500000.3125, -4200000.7, 0.8125");
  body.mass.centroid = Vector3(1.0 / 3.0, 1000.0 / 3.0, -1e7 / 3.0);
  EXPECT_EQ(mass_rows({body})[1][1], "0.333333, 333.33333, -3333333.33333");
}

TEST(Report, TextNamesAlphaOnlyWhereItMatters) {
  RemeshResult result = example();
  EXPECT_FALSE(holds(text_of(result), "alpha"));
  auto& options = std::get<AsPublishedOptions>(result.options.method);
  options.weighting = Weighting::Curvature;
  options.curvature_alpha = 1.25;
  EXPECT_TRUE(holds(text_of(result), "alpha 1.25"));
  RemeshResult on_scan = on_scan_example();
  EXPECT_FALSE(holds(text_of(on_scan), "alpha"));
  std::get<OnScanOptions>(on_scan.options.method).weighting = CellWeighting::Curvature;
  EXPECT_TRUE(holds(text_of(on_scan), "alpha 1"));
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
  RemeshResult result = example();
  const auto json = nlohmann::json::parse(report_json(result));
  EXPECT_EQ(json.at("version"), 3);
  EXPECT_EQ(json.at("format"), "wscvt-report");
  EXPECT_EQ(json.at("result").at("vertices"), 642);
  EXPECT_EQ(json.at("as_published").at("fit").at("residual").get<double>(),
            published(result).fit.residual);
  EXPECT_EQ(json.at("quality").at("remesh").at("edge_length").at("mean").get<double>(),
            result.quality.edge_length.mean);
  const auto& volume = json.at("descriptors").at("volume");
  EXPECT_EQ(volume.at("scan").get<double>(), result.scan.volume);
  EXPECT_EQ(volume.at("remesh").get<double>(), result.remesh.volume);
  EXPECT_EQ(volume.at("error_percent").get<double>(),
            relative_error_percent(result.remesh.volume, result.scan.volume));
  EXPECT_EQ(json.at("as_published").at("relaxation").at("history").at("flips"),
            nlohmann::json({30, 1}));
  EXPECT_TRUE(json.at("warnings").empty());
}

TEST(Report, HoldsTheMassPropertiesOfBothBodies) {
  RemeshResult result = example();
  result.scan = describe_shape(
      test::transformed(test::box(1, 2, 3), test::random_rotation(2), {7, 8, 9}), Execution(1));
  const auto mass = nlohmann::json::parse(report_json(result)).at("mass");
  const MassProperties original = mass_properties(result.scan);
  EXPECT_EQ(mass.at("scan").at("volume").get<double>(), original.volume);
  EXPECT_EQ(mass.at("scan").at("centroid").at("z").get<double>(), original.centroid.z());
  const auto& tensor = mass.at("scan").at("inertia_tensor");
  EXPECT_EQ(tensor.at("xx").get<double>(), original.inertia_tensor(0, 0));
  EXPECT_EQ(tensor.at("xz").get<double>(), original.inertia_tensor(0, 2));
  EXPECT_NEAR(mass.at("scan").at("principal_moments").at("least").get<double>(), 2.5, 1e-10);
  EXPECT_EQ(mass.at("scan").at("principal_axes").at("w").get<double>(),
            original.principal_axes.w());
  EXPECT_EQ(mass.at("remesh").at("volume").get<double>(), result.remesh.volume);
  const std::string text = text_of(result);
  for (const char* part : {"principal axes, quaternion w, x, y, z", "7, 8, 9", "2.5, 5, 6.5"}) {
    EXPECT_TRUE(holds(text, part));
  }
}

TEST(Report, JsonSaysWhetherTheScanIsInVoxelSteps) {
  RemeshResult result = example();
  for (const bool steps : {false, true}) {
    result.input.has_voxel_steps = steps;
    const auto json = nlohmann::json::parse(report_json(result));
    EXPECT_EQ(json.at("input").at("voxel_steps").get<bool>(), steps);
  }
}

TEST(Report, JsonStaysValidWithNumbersAndBytesItCannotHold) {
  RemeshResult result = example();
  result.remesh.sdq = std::numeric_limits<double>::quiet_NaN();
  result.scan.sdq = 0.0;
  result.input.equivalent_radius = 0.0;
  result.warnings = {"file \xff.ply", "a \"quote\"\n"};
  const auto json = nlohmann::json::parse(report_json(result));
  EXPECT_TRUE(json.at("descriptors").at("sdq_invariant").at("remesh").is_null());
  EXPECT_EQ(json.at("warnings").at(1), "a \"quote\"\n");
  EXPECT_FALSE(text_of(result).empty());
}

/// Results that fill what is empty in the example, and one without a fit.
std::vector<RemeshResult> examples() {
  RemeshResult full = example();
  full.warnings = {"One, with a comma.", "Two \"quoted\"."};
  full.distances = MeshDistances{{0.3, 0.2, 0.1}, {0.4, 0.25, 0.15}, 0.4, 0.25};
  full.search = NodeCountSearch{true, 642, {{300, 1.5}, {642, 0.9}}};
  published(full).relaxation.coarser_levels = {{162, 40, RelaxationOutcome::Converged}};
  RemeshResult formula = example();
  formula.input = MeshCheckReport();
  published(formula).fit = HarmonicFitReport();
  published(formula).relaxation.history.clear();
  RemeshResult on_scan = on_scan_example();
  std::get<OnScanReport>(on_scan.method).handles.cut = {{0.25, {1, 2, 3}, 3}};
  return {example(), full, formula, on_scan};
}

/// Numbers that are all different, one after the other.
class Distinct {
 public:
  template <class Number>
  void fill(Number& number) {
    number = static_cast<Number>(next_++);
  }

 private:
  int next_ = 11;
};

TEST(Report, EveryNumberStandsUnderItsOwnName) {
  RemeshResult result = example();
  // In the order of the report, so that a number in another's place shows.
  MeshCheckReport& input = result.input;
  Distinct number;
  std::vector<std::pair<std::string, std::function<double()>>> expected;
  const auto set = [&](const std::string& name, auto& field) {
    number.fill(field);
    expected.emplace_back(name, [&field] { return static_cast<double>(field); });
  };
  set("/input/vertices", input.input_vertices);
  set("/input/faces", input.input_faces);
  set("/input/lost_faces", input.lost_faces);
  set("/input/welded_vertices", input.welded_vertices);
  set("/input/weld_tolerance", input.weld_tolerance);
  set("/input/merged_corners", input.merged_corners);
  set("/input/merged_distance", input.merged_distance);
  set("/input/unreferenced_vertices", input.unreferenced_vertices);
  set("/input/degenerate_faces", input.degenerate_faces);
  set("/input/sliver_faces", input.sliver_faces);
  set("/input/duplicate_faces", input.duplicate_faces);
  set("/input/duplicate_area_fraction", input.duplicate_area_fraction);
  set("/input/back_to_back_faces", input.back_to_back_faces);
  set("/input/back_to_back_area_fraction", input.back_to_back_area_fraction);
  set("/input/non_manifold_edges", input.non_manifold_edges);
  set("/input/flap_faces", input.flap_faces);
  set("/input/flap_area_fraction", input.flap_area_fraction);
  set("/input/filled_holes", input.filled_holes);
  set("/input/filling_faces", input.filling_faces);
  set("/input/filled_area_fraction", input.filled_area_fraction);
  set("/input/reoriented_faces", input.reoriented_faces);
  set("/input/split_vertices", input.split_vertices);
  set("/input/components", input.components);
  set("/input/inner_components", input.inner_components);
  set("/input/inner_volume_fraction", input.inner_volume_fraction);
  set("/input/dropped_faces", input.dropped_faces);
  set("/input/dropped_volume_fraction", input.dropped_volume_fraction);
  set("/input/used_vertices", input.vertices);
  set("/input/used_faces", input.faces);
  set("/input/genus", input.genus);
  set("/input/centroid/x", input.centroid.x());
  set("/input/centroid/y", input.centroid.y());
  set("/input/centroid/z", input.centroid.z());
  set("/input/equivalent_radius", input.equivalent_radius);
  set("/centre/x", result.centre.x());
  set("/centre/y", result.centre.y());
  set("/centre/z", result.centre.z());
  set("/steep_area_fraction", result.steep_area_fraction);
  AsPublishedReport& method = published(result);
  set("/as_published/overhang_fraction", method.overhang_fraction);
  set("/as_published/fit/requested_degree", method.fit.requested_degree);
  set("/as_published/fit/degree", method.fit.degree);
  set("/as_published/fit/rays", method.fit.rays);
  set("/as_published/fit/residual", method.fit.residual);
  set("/as_published/fit/smallest_radius", method.fit.smallest_radius);
  for (auto [name, quality] : {std::pair("/quality/scan", &result.scan_quality),
                               std::pair("/quality/remesh", &result.quality)}) {
    const std::string of = name;
    set(of + "/edge_length/mean", quality->edge_length.mean);
    set(of + "/edge_length/standard_deviation", quality->edge_length.standard_deviation);
    set(of + "/edge_length/minimum", quality->edge_length.minimum);
    set(of + "/edge_length/maximum", quality->edge_length.maximum);
    set(of + "/edge_variation", quality->edge_variation);
    set(of + "/edge_ratio/mean", quality->edge_ratio.mean);
    set(of + "/edge_ratio/standard_deviation", quality->edge_ratio.standard_deviation);
    set(of + "/edge_ratio/minimum", quality->edge_ratio.minimum);
    set(of + "/edge_ratio/maximum", quality->edge_ratio.maximum);
    set(of + "/smallest_angle_degrees", quality->smallest_angle);
    set(of + "/mean_smallest_angle_degrees", quality->mean_smallest_angle);
    set(of + "/valence_six_fraction", quality->valence_six_fraction);
  }
  set("/rms_distance/two_sided", result.rms_distance);
  set("/largest_distance/two_sided", result.largest_distance);
  result.distances.emplace();
  set("/distances/from_remesh/maximum", result.distances->to_reference.maximum);
  set("/distances/from_remesh/root_mean_square", result.distances->to_reference.root_mean_square);
  set("/distances/from_remesh/mean", result.distances->to_reference.mean);
  set("/distances/from_scan/maximum", result.distances->from_reference.maximum);
  set("/distances/from_scan/root_mean_square", result.distances->from_reference.root_mean_square);
  set("/distances/from_scan/mean", result.distances->from_reference.mean);
  set("/distances/largest", result.distances->largest);
  set("/distances/root_mean_square", result.distances->root_mean_square);
  result.search.emplace();
  set("/node_count_search/node_count", result.search->node_count);
  result.search->trials = {{300, 1.5}, {642, 0.5}};
  method.relaxation.history = {{0.5, 0.25, 7}, {0.125, 0.0625, 3}};
  set("/as_published/relaxation/iterations", method.relaxation.iterations);
  set("/as_published/relaxation/rebuilds", method.relaxation.rebuilds);
  set("/as_published/relaxation/weight_scale", method.relaxation.weight_scale);

  const auto json = nlohmann::json::parse(report_json(result));
  for (const auto& [name, value] : expected) {
    EXPECT_EQ(json.at(nlohmann::json::json_pointer(name)).get<double>(), value()) << name;
  }
  const auto at = [&](const std::string& name) {
    return json.at(nlohmann::json::json_pointer(name));
  };
  EXPECT_NEAR(at("/as_published/fit/residual_percent_of_equivalent_radius").get<double>(),
              100.0 * method.fit.residual / input.equivalent_radius, 1e-12);
  EXPECT_NEAR(at("/rms_distance/percent_of_equivalent_radius").get<double>(),
              100.0 * result.rms_distance / input.equivalent_radius, 1e-12);
  EXPECT_EQ(at("/result/vertices"), result.mesh.points.size());
  EXPECT_EQ(at("/result/faces"), result.mesh.triangles.size());
  // The last of a history, and each list of its own numbers.
  EXPECT_EQ(at("/as_published/relaxation/displacement"), 0.125);
  EXPECT_EQ(at("/as_published/relaxation/area_spread"), 0.0625);
  EXPECT_EQ(at("/as_published/relaxation/history/displacement"), nlohmann::json({0.5, 0.125}));
  EXPECT_EQ(at("/as_published/relaxation/history/area_spread"), nlohmann::json({0.25, 0.0625}));
  EXPECT_EQ(at("/as_published/relaxation/history/flips"), nlohmann::json({7, 3}));
  EXPECT_EQ(at("/node_count_search/trials/1/node_count"), 642);
  EXPECT_EQ(at("/node_count_search/trials/1/error_percent"), 0.5);
  // The mass of each body, its tensor without symmetry between the axes.
  for (const auto& [name, body] : {std::pair(std::string("/mass/scan"), &result.scan),
                                   std::pair(std::string("/mass/remesh"), &result.remesh)}) {
    EXPECT_EQ(at(name + "/volume"), body->volume);
    EXPECT_EQ(at(name + "/inertia_tensor/yz").get<double>(), body->inertia_tensor(1, 2));
  }
}

TEST(Report, EveryNumberOfTheMethodOnTheScanStandsUnderItsOwnName) {
  RemeshResult result = on_scan_example();
  auto& method = std::get<OnScanReport>(result.method);
  Distinct number;
  std::vector<std::pair<std::string, std::function<double()>>> expected;
  const auto set = [&](const std::string& name, auto& field) {
    number.fill(field);
    expected.emplace_back("/on_scan/" + name, [&field] { return static_cast<double>(field); });
  };
  set("handles/kept", method.handles.kept);
  set("handles/volume_change", method.handles.volume_change);
  ScanNodesReport& nodes = method.nodes;
  set("genus", nodes.genus);
  set("split_vertices", nodes.split_vertices);
  set("coarsened_vertices", nodes.proxy_vertices);
  set("equalization_steps", nodes.equalization_steps);
  set("equalization_flips", nodes.equalization_flips);
  set("fit_rounds", nodes.fit_rounds);
  set("fit_flips", nodes.fit_flips);
  set("fit_relocations", nodes.relocations);
  set("volume_offset", nodes.volume_offset);
  set("mean_edge_ratio", nodes.mean_edge_ratio);
  set("removed_intersections", nodes.repaired_intersections);
  set("self_intersections", nodes.self_intersections);
  const auto json = nlohmann::json::parse(report_json(result));
  for (const auto& [name, value] : expected) {
    EXPECT_EQ(json.at(nlohmann::json::json_pointer(name)).get<double>(), value()) << name;
  }
  EXPECT_TRUE(json.at("as_published").at("fit").at("degree").is_null());
}

TEST(Report, MassHoldsEveryNumberOfTheTensorAndTheAxes) {
  MassProperties mass;
  mass.volume = 10.0;
  mass.centroid = Vector3(1, 2, 3);
  mass.inertia_tensor << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  mass.principal_moments = Vector3(4, 5, 6);
  mass.principal_axes = Eigen::Quaterniond(0.1, 0.2, 0.3, 0.4);
  const auto json = nlohmann::json::parse(json_of(mass).dump());
  EXPECT_EQ(json, nlohmann::json::parse(R"({"volume": 10.0,
      "centroid": {"x": 1.0, "y": 2.0, "z": 3.0},
      "inertia_tensor": {"xx": 11.0, "yy": 22.0, "zz": 33.0, "xy": 12.0, "xz": 13.0, "yz": 23.0},
      "principal_moments": {"least": 4.0, "middle": 5.0, "greatest": 6.0},
      "principal_axes": {"w": 0.1, "x": 0.2, "y": 0.3, "z": 0.4}})"));
}

TEST(Report, AdditionsFollowInDocumentAndPage) {
  const RemeshResult result = example();
  const std::vector<ReportAddition> additions = {{"Tetrahedra",
                                                  {"Tetrahedra: 7 of 9 points"},
                                                  "tetrahedra",
                                                  {{"count", 7}},
                                                  {{"angle", 12.5}}}};
  auto json = nlohmann::json::parse(report_json(result, {}, additions));
  EXPECT_EQ(json.at("tetrahedra"), nlohmann::json::parse(R"({"count": 7, "angle": 12.5})"));
  json.erase("tetrahedra");
  EXPECT_EQ(json, nlohmann::json::parse(report_json(result)));
  const std::string page = report_html(result, {}, additions, Execution(1));
  EXPECT_TRUE(holds(page, "Tetrahedra: 7 of 9 points"));
  EXPECT_FALSE(holds(report_html(result, {}, Execution(1)), "Tetrahedra"));
}

TEST(Report, CsvIsTheJsonWithoutItsLists) {
  for (const RemeshResult& result : examples()) {
    test::expect_csv_is_flat_json(report_csv(result), report_json(result));
  }
}

TEST(Report, CsvHasTheSameColumnsForEveryRemeshWithWarningsLast) {
  const auto header = test::csv_records(report_csv(example())).front();
  for (const RemeshResult& result : examples()) {
    EXPECT_EQ(test::csv_records(report_csv(result)).front(), header);
  }
  EXPECT_EQ(header.back(), "warnings");
  EXPECT_EQ(test::csv_records(report_csv(examples()[1])).back().back(),
            "One, with a comma. | Two \"quoted\".");
}

// What report.h says is left out of a CSV report, and no more.
TEST(Report, CsvLeavesOutTheListsThatTheHeaderNames) {
  const auto json = nlohmann::json::parse(report_json(examples()[1])).flatten();
  std::set<std::string> lists;
  for (const auto& [path, value] : json.items()) {
    const std::size_t digit = path.find_first_of("0123456789");
    if (digit != std::string::npos && path[digit - 1] == '/') lists.insert(path.substr(0, digit));
  }
  EXPECT_EQ(lists,
            (std::set<std::string>{"/as_published/relaxation/coarser_levels/",
                                   "/as_published/relaxation/history/area_spread/",
                                   "/as_published/relaxation/history/displacement/",
                                   "/as_published/relaxation/history/flips/", "/descriptor_names/",
                                   "/node_count_search/trials/", "/warnings/"}));
}

/// Collects what every option is called and what its value is typed as.
struct TypedOptions {
  std::map<std::string, std::string> values;

  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    values[std::string(option.key)] = typed_text(value);
  }
  void operator()(const bool& value, const FlagOption& option) {
    values[std::string(option.key)] = value ? "true" : "false";
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    values[std::string(EnumerationTable<Enumeration>::key)] = key_of(value);
  }
};

TEST(Report, NamesOptionsAsOneTypesThem) {
  RemeshResult result = example();
  OnScanOptions on_scan;
  on_scan.weighting = CellWeighting::Curvature;
  on_scan.edge_ratio = 1.3;
  result.options.method = on_scan;
  TypedOptions typed;
  for_each_option(result.options, typed);
  EXPECT_EQ(typed.values.at("weighting"), "wscvt-c");
  EXPECT_EQ(typed.values.at("handles"), "cut");
  typed.values.erase("handles");  // what the program does anyhow
  const auto options = nlohmann::json::parse(report_json(result)).at("options");
  // Those of the other method are there, and null.
  EXPECT_TRUE(options.at("sampling").is_null());
  EXPECT_EQ(
      std::count_if(options.begin(), options.end(), [](const auto& v) { return !v.is_null(); }),
      static_cast<std::ptrdiff_t>(typed.values.size()));
  const auto records = test::csv_records(report_csv(result));
  for (const auto& [key, value] : typed.values) {
    SCOPED_TRACE(key);
    const auto& in_json = options.at(key);
    if (in_json.is_number_float()) {
      EXPECT_EQ(typed_text(in_json.get<double>()), value);
    } else {
      EXPECT_EQ(in_json.is_string() ? in_json.get<std::string>() : in_json.dump(), value);
    }
    const auto column = std::find(records[0].begin(), records[0].end(), "options." + key);
    ASSERT_NE(column, records[0].end());
  }
}

TEST(Report, JsonKeysKeepTheirOrder) {
  const std::string json = report_json(example());
  std::size_t last = 0;
  for (const char* key : {"\"format\"", "\"options\"", "\"input\"", "\"on_scan\"", "\"fit\"",
                          "\"relaxation\"", "\"quality\"", "\"descriptors\"", "\"warnings\""}) {
    const std::size_t place = json.find(key, last);
    ASSERT_NE(place, std::string::npos) << key;
    last = place;
  }
}

}  // namespace

namespace {

RemeshResult remesh_of(const IndexedMesh& scan, int nodes) {
  RemeshOptions options;
  options.node_count = nodes;
  return remesh(scan, options, Execution(1));
}

std::string line_of(const std::vector<std::string>& lines, const std::string& topic) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.rfind(topic + " ", 0) == 0;
  });
  return found == lines.end() ? "" : *found;
}

/// The number behind a word of a line.
double number_behind(const std::string& line, const std::string& word) {
  const std::size_t at = line.find(word);
  return at == std::string::npos ? 1e300 : std::stod(line.substr(at + word.size()));
}

TEST(ReportSummary, TellsTheErrorsThatAPlainComputationGives) {
  const RemeshResult result = remesh_of(test::lumpy(5), 300);
  const std::vector<std::string> lines = summary_lines(result);
  const auto percent = [](double value, double scan) { return 100.0 * (value - scan) / scan; };
  const std::string errors = line_of(lines, "Errors");
  // Errors have three decimals.
  EXPECT_TRUE(holds(errors, "volume exact"));
  EXPECT_NEAR(number_behind(errors, " area "), percent(result.remesh.area, result.scan.area), 6e-4);
  EXPECT_NEAR(number_behind(errors, "sphericity "),
              percent(result.remesh.sphericity, result.scan.sphericity), 6e-4);
  EXPECT_NEAR(number_behind(errors, "aspect ratio "),
              percent(result.remesh.aspect_ratio, result.scan.aspect_ratio), 6e-4);
  const std::string remeshed = line_of(lines, "Remesh");
  EXPECT_EQ(number_behind(remeshed, "Remesh"), 300.0);
  EXPECT_NEAR(number_behind(remeshed, "smallest angle "), result.quality.smallest_angle, 0.06);
  const double rms = 100.0 * result.rms_distance / result.input.equivalent_radius;
  const std::string distance = line_of(lines, "Distance");
  EXPECT_NEAR(number_behind(distance, "rms "), rms, 0.006 * rms);
  const double largest = 100.0 * result.largest_distance / result.input.equivalent_radius;
  EXPECT_NEAR(number_behind(distance, "largest "), largest, 0.006 * largest);
  EXPECT_GT(largest, rms);
}

TEST(ReportSummary, IsShortAlsoForARepairedScan) {
  IndexedMesh scan = test::lumpy(4);
  scan.triangles.resize(scan.triangles.size() - 3);
  scan.triangles.push_back(scan.triangles.front());
  scan.points.emplace_back(9.0, 9.0, 9.0);
  const std::vector<std::string> lines = summary_lines(remesh_of(scan, 150));
  EXPECT_NE(line_of(lines, "Repairs"), "");
  EXPECT_LE(lines.size(), 6U);
  // A topic a line: who shows them breaks them.
  for (const std::string& line : lines) EXPECT_NE(line.front(), ' ') << line;
}

TEST(ReportSummary, SdqOfItsClipIsNoFaultOfTheRemesh) {
  RemeshResult result = remesh_of(test::lumpy(4), 300);
  result.warnings.clear();
  const auto errors = [&] {
    std::string text;
    for (const std::string& line : summary_lines(result)) text += line + "\n";
    return text;
  };
  EXPECT_FALSE(holds(errors(), "not reliable"));
  EXPECT_TRUE(report_warnings(result).empty());
  result.scan.sdq_half_clip = 1.04 * result.scan.sdq;
  result.scan.sdq_clipped_fraction = 0.09;
  EXPECT_EQ(verdict_line(result).substr(verdict_line(result).size() - 6), ": good");
  EXPECT_TRUE(holds(errors(), "Sdq not reliable"));
  // Whoever shows Sdq tells of it.
  const std::vector<Sentence> told = report_warnings(result);
  ASSERT_EQ(told.size(), 1U);
  for (const char* part :
       {"Sdq (invariant form) of the scan is not reliable", "9 % of its square", "4 % larger"}) {
    EXPECT_TRUE(holds(told[0].text(), part));
  }
  EXPECT_TRUE(holds(report_json(result), "is not reliable"));
  EXPECT_TRUE(holds(report_csv(result), "is not reliable"));
  EXPECT_EQ(report_lines(result).back().rfind("Warning     Sdq", 0), 0U);
}

TEST(ReportSummary, VerdictIsGoodWithoutWarningsOnly) {
  RemeshResult result = remesh_of(test::lumpy(4), 300);
  result.warnings.clear();
  const std::string good = verdict_line(result);
  EXPECT_EQ(good.rfind("300 nodes, volume exact, area ", 0), 0U) << good;
  EXPECT_EQ(good.substr(good.size() - 20), " of the radius: good") << good;
  EXPECT_LE(good.size(), 80U) << good;
  const auto end_with = [&](std::vector<Sentence> warnings) {
    result.warnings = std::move(warnings);
    const std::string line = verdict_line(result);
    EXPECT_EQ(line.substr(0, good.size() - 4), good.substr(0, good.size() - 4));
    return line.substr(good.size() - 4);
  };
  EXPECT_EQ(end_with({"One."}), "look at: One");
  EXPECT_EQ(end_with({"One is 0.5 %: odd.", "Two."}), "look at: One is 0.5 % and 1 more");
  EXPECT_EQ(end_with({"It has 2. Odd: odd.", "Two.", "Three."}), "look at: It has 2 and 2 more");
  EXPECT_EQ(end_with({"It stopped, because of this: that."}), "look at: It stopped");
}

}  // namespace
}  // namespace wscvt
