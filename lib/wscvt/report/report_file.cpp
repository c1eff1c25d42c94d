// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/version.h"
#include "wscvt/report/open_table.h"
#include "wscvt/report/report_addition.h"

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

}  // namespace

const std::vector<std::string>& report_endings() {
  static const std::vector<std::string> endings = {".html", ".json", ".csv"};
  return endings;
}

ReportFormat report_format(const std::string& path) {
  const auto& endings = report_endings();
  const auto found = std::find(endings.begin(), endings.end(), ending_of(path));
  if (found == endings.end()) {
    refuse("Unknown report format: \"" + path + "\". Use .html, .json or .csv.");
  }
  return static_cast<ReportFormat>(found - endings.begin());
}

bool shows_scan(const std::string& path) { return report_format(path) == ReportFormat::Page; }

void write_forms(const std::string& path, const ReportForms& forms) {
  switch (report_format(path)) {
    case ReportFormat::Page:
      return write_file(path, forms.page());
    case ReportFormat::Document:
      return write_file(path, forms.document());
    case ReportFormat::Row:
      return append_to_table(path, forms.row());
  }
}

void check_forms(const std::string& path, const std::function<std::string()>& row) {
  if (report_format(path) == ReportFormat::Row) return check_table(path, row());
  check_writable(path);
}

void check_remesh_report(const std::string& path) {
  check_forms(path, [] { return report_csv(RemeshResult()); });
}

void check_descriptor_report(const std::string& path, bool with_reference, bool with_resolution) {
  check_forms(path, [&] { return example_csv(with_reference, with_resolution); });
}

void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const Execution& execution) {
  write_report(path, result, origin, {}, execution);
}

void write_report(const std::string& path, const RemeshResult& result, const ReportOrigin& origin,
                  const std::vector<ReportAddition>& additions, const Execution& execution) {
  write_forms(path, {[&] { return report_html(result, origin, additions, execution); },
                     [&] { return report_json(result, origin, additions); },
                     [&] { return report_csv(result, origin); }});
}

void write_report(const std::string& path, const GrainMeasures& measures,
                  const ReportOrigin& origin, const Execution& execution) {
  write_forms(path, {[&] { return descriptor_html(measures, origin, execution); },
                     [&] { return descriptor_json(measures, origin); },
                     [&] { return descriptor_csv(measures, origin); }});
}

std::string made_by() { return std::string("wscvt ") + version(); }

std::string origin_sentence(const ReportOrigin& origin) {
  return "Made " + (origin.source.empty() ? "" : "from " + origin.source + " ") + "by " +
         made_by() + (origin.date.empty() ? "" : " on " + origin.date) + ".";
}

}  // namespace wscvt
