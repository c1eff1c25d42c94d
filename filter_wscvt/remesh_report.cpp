// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_report.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <utility>

#include "html_report.h"
#include "log_text.h"
#include "report_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/report/report.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/scan/point_cloud.h"

namespace wscvt::filter {

namespace {

std::string quality_line(const RemeshResult& result, VertexQuality quality) {
  const std::vector<double>& values = quality_values(result, quality);
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  std::ostringstream line;
  line.imbue(std::locale::classic());
  line << "Stored      vertex quality: " << quality_names()[static_cast<std::size_t>(quality)];
  if (lowest != values.end()) line << ", " << *lowest << " to " << *highest;
  return line.str();
}

std::string seed_line(const RemeshOptions& options) {
  return options.seeding.start == SeedStart::Random
             ? "Seed        " + std::to_string(options.seeding.random_seed)
             : "Seed        not used: nothing was random";
}

}  // namespace

std::vector<std::string> log_lines(const RemeshResult& result, VertexQuality quality,
                                   double seconds) {
  std::vector<std::string> lines{""};
  for (std::string& line : report_lines(result)) lines.push_back(std::move(line));
  lines.push_back(quality_line(result, quality));
  lines.push_back(seconds_line(seconds));
  lines.push_back(seed_line(result.options));
  cut_lines(lines);
  return lines;
}

namespace {

std::string html_report(const RemeshResult& result, IndexedMesh original) {
  HtmlReport report("Remesh with " + std::to_string(result.mesh.points.size()) + " nodes");
  for (const std::string& warning : result.warnings) report.add_paragraph(warning);
  report.add_table(
      compare_descriptors(list_descriptors(result.original), list_descriptors(result.remesh)),
      ComparisonNames());
  if (original.triangles.empty() && !original.points.empty()) {
    original = mesh_of_points(std::move(original.points));
  }
  if (!original.triangles.empty()) {
    original = check_mesh(std::move(original), result.options.check, Execution()).mesh;
  }
  report.add_histograms(original, result.mesh, ComparisonNames());
  report.add_lines("Everything", report_lines(result));
  return report.text();
}

}  // namespace

void write_report(const RemeshResult& result, const IndexedMesh& original,
                  const std::string& path) {
  switch (report_format(path)) {
    case ReportFormat::None:
      return;
    case ReportFormat::Html:
      return write_file(path, html_report(result, original));
    case ReportFormat::Json:
      return write_file(path, report_json(result));
    case ReportFormat::Csv:
      return write_file(path, report_csv(result));
  }
}

}  // namespace wscvt::filter
