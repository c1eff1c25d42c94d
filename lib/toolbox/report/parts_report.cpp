// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/parts_report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/json.h"
#include "wscvt/report/page_figures.h"

namespace wscvt {

namespace {

double percent_of_radius(double length, const PartsMeasures& measures) {
  return 100.0 * length / equivalent_radius(measures.grain_volume);
}

std::string length_text(double length, const PartsMeasures& measures) {
  return format_number(length, 4) + " (" + format_number(percent_of_radius(length, measures), 3) +
         " % of the equivalent radius)";
}

std::string faces_text(const ConvexParts& parts) {
  if (parts.empty()) return "";
  const auto [least, most] = std::minmax_element(
      parts.begin(), parts.end(),
      [](const auto& a, const auto& b) { return a.triangles.size() < b.triangles.size(); });
  const std::string low = std::to_string(least->triangles.size());
  const std::string high = std::to_string(most->triangles.size());
  return (low == high ? low : low + " to " + high) + " faces" + (parts.size() > 1 ? " each" : "");
}

}  // namespace

std::vector<std::string> parts_lines(const PartsResult& result) {
  const PartsMeasures& m = result.measures;
  return {"Convex parts: " + std::to_string(result.parts.size()) + ", " + faces_text(result.parts),
          "Distance from the parts to the grain: rms " + length_text(m.rms_distance, m) +
              ", largest " + length_text(m.largest_distance, m),
          "Points of the grain outside of the parts: at most " + length_text(m.largest_gap, m),
          "Volume of the parts beyond the grain's: " +
              (m.excess_percent() == 0.0 ? std::string("exact")
                                         : format_number(m.excess_percent(), 3) + " %") +
              ", and " + format_number(100.0 * m.shared_volume / m.grain_volume, 3) +
              " % inside several parts"};
}

std::string parts_json(const PartsResult& result, const ReportOrigin& origin) {
  const PartsMeasures& m = result.measures;
  Json faces = Json::array();
  for (const IndexedMesh& part : result.parts) faces.push_back(part.triangles.size());
  return json_document({{"format", "wscvt-convex-parts"},
                        {"made_by", made_by()},
                        {"source", told(origin.source)},
                        {"date", told(origin.date)},
                        {"parts", result.parts.size()},
                        {"faces", faces},
                        {"largest_distance", m.largest_distance},
                        {"largest_distance_percent", percent_of_radius(m.largest_distance, m)},
                        {"rms_distance", m.rms_distance},
                        {"rms_distance_percent", percent_of_radius(m.rms_distance, m)},
                        {"largest_gap", m.largest_gap},
                        {"largest_gap_percent", percent_of_radius(m.largest_gap, m)},
                        {"parts_volume", m.parts_volume},
                        {"shared_volume", m.shared_volume},
                        {"excess_volume_percent", m.excess_percent()},
                        {"mass_properties", json_of(mass_properties(result.scan))},
                        {"warnings", result.warnings}});
}

std::string parts_html(const PartsResult& result, const ReportOrigin& origin,
                       const Execution& execution) {
  const IndexedMesh shown = joined(result.parts);
  // Faces between two parts are deep inside the grain, so their distances would use up the scale.
  std::vector<std::uint8_t> numbers;
  for (std::size_t k = 0; k < result.parts.size(); ++k) {
    numbers.resize(numbers.size() + result.parts[k].triangles.size(), static_cast<std::uint8_t>(k));
  }
  const PageFigures figures =
      page_figures(ShownMesh{result.grain, "grain"}, {shown, "parts", std::move(numbers)},
                   execution, outer_points(result.parts));
  const std::string name = std::filesystem::path(origin.source).filename().string();
  HtmlDocument page(format_count(result.parts.size(), "convex part") +
                    (name.empty() ? "" : " of " + name));
  page.add_paragraph(origin_sentence(origin));
  for (const std::string& warning : result.warnings) page.add_warning(warning);
  page.add_figures(figures.pictures);
  page.add_heading("Distances and volume");
  page.add_lines(parts_lines(result));
  page.add_heading("Mass properties of the grain");
  page.add_rows(mass_rows({{"grain", mass_properties(result.scan)}}));
  page.add_html(figures.views);
  return page.text();
}

std::string parts_csv(const PartsResult& result, const ReportOrigin& origin) {
  return csv_of(Json::parse(parts_json(result, origin)));
}

void check_parts_report(const std::string& path) {
  check_forms(path, [] { return parts_csv(PartsResult(), {}); });
}

void write_report(const std::string& path, const PartsResult& result, const ReportOrigin& origin,
                  const Execution& execution) {
  write_forms(path, {[&] { return parts_html(result, origin, execution); },
                     [&] { return parts_json(result, origin); },
                     [&] { return parts_csv(result, origin); }});
}

}  // namespace wscvt
