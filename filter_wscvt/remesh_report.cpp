// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_report.h"

#include <algorithm>
#include <limits>
#include <map>

#include "log_text.h"
#include "node_parameters.h"
#include "shown_words.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/report/report.h"

namespace wscvt::filter {

namespace {

/// The descriptors of the short table, by key.
const std::map<std::string, std::string> short_labels = {{"volume", "volume"},
                                                         {"area", "surface area"},
                                                         {"sphericity_wadell", "sphericity"},
                                                         {"aspect_ratio_inertia", "aspect ratio"},
                                                         {"sdq_invariant", "Sdq"}};

/// Appends the lines of the library's report on these topics.
void append_topics(std::vector<std::string>& lines, const std::vector<std::string>& report,
                   const std::vector<std::string>& topics) {
  for (const std::string& line : report) {
    for (const std::string& topic : topics) {
      const bool is_news = line.find("none needed") == std::string::npos;
      if (line.rfind(topic + " ", 0) == 0 && is_news) lines.push_back(line);
    }
  }
}

/// The most important measures, one row each: scan, remesh, error in %.
std::vector<std::string> short_table(const RemeshResult& result) {
  std::vector<std::vector<std::string>> cells = {{"", "scan", "remesh", "error %"}};
  const auto add = [&](const std::string& label, double from, double to) {
    cells.push_back({"  " + label, format_number(from, 5), format_number(to, 5), ""});
  };
  // A surface from a formula has neither vertices nor triangles.
  const bool is_scan = result.input.input_vertices > 0;
  const double none = std::numeric_limits<double>::quiet_NaN();
  // Counts are never abbreviated.
  const auto add_count = [&](const std::string& label, std::size_t from, std::size_t to) {
    cells.push_back({"  " + label, is_scan ? std::to_string(from) : "-", std::to_string(to), ""});
  };
  add_count("vertices", result.input.vertices, result.mesh.points.size());
  add_count("faces", result.input.faces, result.mesh.triangles.size());
  for (const DescriptorComparison& row :
       compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh))) {
    const auto label = short_labels.find(row.key);
    if (label == short_labels.end()) continue;
    cells.push_back({"  " + label->second, format_number(row.reference, 5),
                     format_number(row.value, 5), format_error(row.error_percent)});
  }
  add("mean edge ratio", is_scan ? result.scan_quality.edge_ratio.mean : none,
      result.quality.edge_ratio.mean);
  add("smallest angle, degrees", is_scan ? result.scan_quality.smallest_angle : none,
      result.quality.smallest_angle);
  if (result.distances) {
    const double radius = result.input.equivalent_radius;
    const auto add_distance = [&](const std::string& label, double length) {
      cells.push_back({"  " + label + " distance, % of radius", "",
                       format_number(100.0 * length / radius, 3), ""});
    };
    add_distance("largest", result.distances->largest);
    add_distance("rms", result.distances->root_mean_square);
    add_distance("mean", std::max(result.distances->to_reference.mean,
                                  result.distances->from_reference.mean));
  }
  return log_table(cells);
}

/// Returns where the nodes are, by their signed distances from the scan.
std::string nodes_line(const std::vector<double>& distances) {
  const auto [lowest, highest] = std::minmax_element(distances.begin(), distances.end());
  const auto place = [](double distance) {
    if (distance == 0.0) return std::string("on the scan");
    return format_number(distance, 3) + (distance < 0.0 ? " (inside)" : " (outside)");
  };
  if (*lowest == *highest) return "All nodes are " + place(*lowest);
  return "Nodes are from " + place(*lowest) + " to " + place(*highest);
}

}  // namespace

std::vector<LogLine> log_lines(const RemeshResult& result, double seconds,
                               const std::vector<std::string>& notes) {
  std::vector<std::string> lines = short_table(result);
  const std::vector<std::string> report = report_lines(result);
  if (result.input.input_vertices > 0) append_topics(lines, report, {"Repairs"});
  append_topics(lines, report, {"Node count"});
  if (!result.vertex_distances.empty()) {
    lines.push_back(nodes_line(quality_values(result, VertexQuality::OriginalDistance)));
  }
  lines.push_back(seconds_line(seconds));
  lines.insert(lines.end(), notes.begin(), notes.end());
  std::vector<std::string> warnings;
  // The table above has a row of Sdq.
  for (const Sentence& warning : report_warnings(result)) warnings.push_back(shown_words(warning));
  return as_log(warnings, lines, verdict_line(result));
}

}  // namespace wscvt::filter
