// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

constexpr std::size_t summary_topic_width = 12;

/// Appends a topic and its text.
void append_topic(std::vector<std::string>& lines, const std::string& topic,
                  const std::string& text) {
  lines.push_back(topic + std::string(summary_topic_width - topic.size(), ' ') + text);
}

/// The errors of the paper's descriptors, in its order.
std::vector<std::string> descriptor_errors(const RemeshResult& result) {
  constexpr std::array<std::pair<const char*, const char*>, 5> shown = {
      {{"volume", "volume"},
       {"area", "area"},
       {"aspect_ratio_inertia", "aspect ratio"},
       {"sphericity_wadell", "sphericity"},
       {"sdq_invariant", "Sdq"}}};
  const std::vector<DescriptorComparison> rows =
      compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh));
  std::vector<std::string> errors;
  for (const auto& [key, label] : shown) {
    for (const DescriptorComparison& row : rows) {
      if (row.key != key) continue;
      const bool is_reliable =
          row.key != "sdq_invariant" || sdq_clip_sentence("", result.scan).empty();
      errors.push_back(std::string(label) + " " +
                       (is_reliable ? error_text(row.error_percent) : "not reliable"));
    }
  }
  return errors;
}

std::string percent_of_radius(const RemeshResult& result, double length) {
  return format_number(100.0 * length / result.input.equivalent_radius, 3) + " %";
}

}  // namespace

std::string verdict_line(const RemeshResult& result) {
  const std::vector<std::string> errors = descriptor_errors(result);
  const std::string measured = std::to_string(result.mesh.points.size()) + " nodes, " + errors[0] +
                               ", " + errors[1] + ", rms " +
                               percent_of_radius(result, result.rms_distance) + " of the radius: ";
  return measured + (result.warnings.empty() ? "good" : "see above");
}

std::vector<std::string> summary_lines(const RemeshResult& result) {
  std::vector<std::string> lines;
  // Of the whole report, what was read, repaired and searched.
  for (const std::string& line : report_lines(result)) {
    const bool is_shown = line.rfind("Scan ", 0) == 0 || line.rfind("Repairs ", 0) == 0 ||
                          line.rfind("Handles ", 0) == 0 || line.rfind("Node count ", 0) == 0;
    if (!is_shown || line.find("none needed") != std::string::npos) continue;
    const std::size_t gap = line.find_first_of(' ', line.rfind("Node", 0) == 0 ? 5 : 0);
    const std::size_t text = line.find_first_not_of(' ', gap);
    append_topic(lines, line.substr(0, gap), line.substr(text));
  }
  append_topic(lines, "Remesh",
               std::to_string(result.mesh.points.size()) + " nodes, " +
                   std::to_string(result.mesh.triangles.size()) + " faces, edge ratio " +
                   format_number(result.quality.edge_ratio.mean, 4) + ", smallest angle " +
                   format_number(result.quality.smallest_angle, 3) + " degrees");
  append_topic(lines, "Errors", listed(descriptor_errors(result)));
  append_topic(lines, "Distance",
               "rms " + percent_of_radius(result, result.rms_distance) + ", largest " +
                   percent_of_radius(result, result.largest_distance) +
                   " of the equivalent radius " + format_number(result.input.equivalent_radius));
  return lines;
}

}  // namespace wscvt
