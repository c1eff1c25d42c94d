// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wscvt/base/option.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/page_figures.h"
#include "wscvt/report/report_addition.h"

namespace wscvt {

namespace {

/// Options as on the command line.
class OptionRows {
 public:
  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    add(option.key, typed_text(value), option.subject);
  }
  void operator()(const bool& value, const FlagOption& option) {
    add(option.key, value ? "true" : "false", option.subject);
  }
  /// The usual treatment is no option of the program.
  void operator()(const HandleAction& value) {
    if (value != HandleAction::Cut) operator()<HandleAction>(value);
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    using Table = EnumerationTable<Enumeration>;
    add(Table::key, key_of(value), Table::subject);
  }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

 private:
  void add(std::string_view key, const std::string& value, std::string_view subject) {
    // A subject may end with a comma, because messages use it within a sentence.
    if (!subject.empty() && subject.back() == ',') subject.remove_suffix(1);
    rows_.push_back({"--" + std::string(key) + "=" + value, capitalised(subject)});
  }

  std::vector<std::vector<std::string>> rows_ = {{"option", "meaning"}};
};

Figure search_figure(const NodeCountSearch& search, const ErrorTarget& target) {
  std::vector<CurvePoint> points;
  for (const NodeCountTrial& trial : search.trials) {
    points.push_back({static_cast<double>(trial.node_count), trial.error});
  }
  return {logarithmic_figure("number of nodes", label_of(target.measure) + " error, %",
                             std::move(points), target.percent),
          "Error for each node count tried. The smallest count that met the allowed error was "
          "used. If no count met it, the largest was used."};
}

}  // namespace

std::string report_html(const RemeshResult& result, const ReportOrigin& origin,
                        const Execution& execution) {
  return report_html(result, origin, {}, execution);
}

std::string report_html(const RemeshResult& result, const ReportOrigin& origin,
                        const std::vector<ReportAddition>& additions, const Execution& execution) {
  std::optional<ShownMesh> reference;
  if (!result.repaired_scan.triangles.empty()) {
    reference.emplace(ShownMesh{result.repaired_scan, "scan"});
  }
  const PageFigures figures = page_figures(reference, {result.mesh, "remesh"}, execution);

  const std::string name = std::filesystem::path(origin.source).filename().string();
  HtmlDocument page("Remesh" + (name.empty() ? "" : " of " + name) + " with " +
                    std::to_string(result.mesh.points.size()) + " nodes");
  page.add_paragraph(origin_sentence(origin));
  for (const std::string& warning : report_warnings(result)) page.add_warning(warning);
  page.add_figures(figures.pictures);
  page.add_heading("Descriptors");
  page.add_table(
      compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh)),
      ComparisonNames());
  page.add_heading("Mass properties");
  page.add_rows(mass_rows(
      {{"scan", mass_properties(result.scan)}, {"remesh", mass_properties(result.remesh)}}));
  page.add_heading("Distributions");
  page.add_figures(figures.distributions);
  if (result.search) {
    page.add_heading("Error against the number of nodes");
    page.add_figures({search_figure(*result.search, result.options.target)});
  }
  for (const ReportAddition& addition : additions) {
    page.add_heading(addition.heading);
    page.add_lines(addition.lines);
  }
  page.add_heading("Options");
  OptionRows options;
  const RemeshOptions given = as_given(result.options);
  for_each_option(given, options);
  page.add_rows(options.rows(), RowKind::Typed);
  page.add_heading("Log");
  page.add_lines(result_lines(result));  // the page begins with the warnings
  page.add_html(figures.views);
  return page.text();
}

}  // namespace wscvt
