// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/version.h"
#include "wscvt/report/open_table.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

/// Only its columns matter.
std::string example_csv(bool with_reference, bool with_resolution) {
  GrainMeasures measures;
  if (with_reference) {
    measures.reference.emplace();
    measures.distances.emplace();
  }
  if (with_resolution) {
    measures.resolution.emplace();
    for (const DescriptorValue& row : list_descriptors(measures.grain.descriptors)) {
      measures.resolution->rows.push_back({row.key});
    }
  }
  return descriptor_csv(measures, {});
}

void check(const std::string& path, const std::string& csv) {
  if (report_format(path) == ReportFormat::Row) return check_table(path, csv);
  check_writable(path);
}

}  // namespace

const std::vector<std::string>& report_endings() {
  static const std::vector<std::string> endings = {".html", ".json", ".csv"};
  return endings;
}

ReportFormat report_format(const std::string& path) {
  const auto& endings = report_endings();
  const auto found = std::find(endings.begin(), endings.end(), ending_of(path));
  if (found == endings.end()) {
    throw Error(ErrorCode::InvalidInput,
                "Unknown report format: \"" + path + "\". Use .html, .json or .csv.");
  }
  return static_cast<ReportFormat>(found - endings.begin());
}

bool shows_scan(const std::string& path) { return report_format(path) == ReportFormat::Page; }

void check_remesh_report(const std::string& path) { check(path, report_csv(RemeshResult(), {})); }

void check_descriptor_report(const std::string& path, bool with_reference, bool with_resolution) {
  check(path, example_csv(with_reference, with_resolution));
}

void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const Execution& execution) {
  switch (report_format(path)) {
    case ReportFormat::Page:
      return write_file(path, report_html(result, origin, execution));
    case ReportFormat::Document:
      return write_file(path, report_json(result, origin));
    case ReportFormat::Row:
      return append_to_table(path, report_csv(result, origin));
  }
}

void write_report(const std::string& path, const GrainMeasures& measures,
                  const ReportOrigin& origin, const Execution& execution) {
  switch (report_format(path)) {
    case ReportFormat::Page:
      return write_file(path, descriptor_html(measures, origin, execution));
    case ReportFormat::Document:
      return write_file(path, descriptor_json(measures, origin));
    case ReportFormat::Row:
      return append_to_table(path, descriptor_csv(measures, origin));
  }
}

std::string made_by() { return std::string("wscvt ") + version(); }

std::string origin_sentence(const ReportOrigin& origin) {
  return "Made " + (origin.source.empty() ? "" : "from " + origin.source + " ") + "by " +
         made_by() + (origin.date.empty() ? "" : " on " + origin.date) + ".";
}

}  // namespace wscvt
