// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>
#include <utility>

#include "toolbox/report/sample_report.h"
#include "toolbox/sample/distribution.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/voxel_resolution.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/json.h"
#include "wscvt/report/mesh_view.h"
#include "wscvt/report/report.h"

namespace wscvt {

/// sample_page.js, which CMake makes a text.
extern const char* const sample_page_script;

namespace {

/// Keeps the page below 6 MB: 50 descriptors of 10,000 grains are 4 MB with four digits.
constexpr std::size_t most_grains = 10000;
constexpr std::size_t most_thumbnails = 100;
constexpr int thumbnail_pixels = 72;

/// A table with more rows is collapsed.
constexpr std::size_t most_open_rows = 16;

using Rows = std::vector<std::vector<std::string>>;

/// Whether a table shows a column of the sample.
using ColumnFilter = bool (*)(const std::string& column);

constexpr const char* page_style =
    "<style>select, input { font: inherit; } select { max-width: 100%; } input { width: 5em; } "
    "figcaption button { "
    "margin-left: 0.5em; font-size: 0.9em; } @media print { button, select, input { display: none; "
    "} }</style>\n";

/// Returns the words for a column of a table: those of a descriptor, else the column's name with
/// spaces.
std::string words_of(const std::string& column) {
  std::string words = descriptor_words(column);
  if (!words.empty()) return words;
  words = column;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string heading_in_words(const GrainColumn& column) {
  return words_of(column.name) + (column.unit.empty() ? "" : ", " + column.unit);
}

/// Returns at most `most` of the rows `order`, evenly spaced in the order of size. They keep the
/// shape of the distribution.
std::vector<std::size_t> evenly_by_size(const GrainSample& sample, std::vector<std::size_t> order,
                                        std::size_t most) {
  if (order.size() <= most) return order;
  const auto size = [&](std::size_t k) { return sample.sizes[static_cast<Eigen::Index>(k)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k) {
    chosen.push_back(order[k * (order.size() - 1) / (most - 1)]);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Four digits are enough for a figure.
void append_short(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 4);
  text.append(digits.data(), end.ptr);
}

template <class Vector>
std::string short_list(const Vector& values, const std::vector<std::size_t>& rows) {
  std::string text = "[";
  for (const std::size_t row : rows) {
    if (text.size() > 1) text += ',';
    append_short(text, values[static_cast<Eigen::Index>(row)]);
  }
  return text + "]";
}

/// Writes JSON that is safe inside an HTML element.
std::string in_page(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

/// Returns a picture of a mesh, nothing if it cannot be read.
std::optional<Picture> thumbnail(const std::string& file, const Execution& execution) {
  execution.report(0.0, "Drawing the grains");
  try {
    return thumbnail_of(read_mesh(file, execution), thumbnail_pixels);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return {};
  }
}

std::string thumbnails(const ReportedSample& one, const std::vector<std::size_t>& rows,
                       std::size_t most, const Execution& execution) {
  std::string text = "{";
  if (!one.folder.empty() && !one.sample.files.empty()) {
    const std::vector<std::size_t> shown = evenly_by_size(one.sample, rows, most);
    for (std::size_t place = 0; place < rows.size(); ++place) {
      if (!std::binary_search(shown.begin(), shown.end(), rows[place])) continue;
      const auto file = std::filesystem::path(one.folder) / one.sample.files[rows[place]];
      const auto picture = thumbnail(file.string(), execution);
      if (!picture) continue;
      text += (text.size() > 1 ? ",\"" : "\"") + std::to_string(place) + "\":\"" +
              data_url(*picture) + "\"";
    }
  }
  return text + "}";
}

std::string sample_data(const ReportedSample& one, std::size_t samples,
                        const Execution& execution) {
  const GrainSample& sample = one.sample;
  std::vector<std::size_t> all(sample.grains.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::size_t> rows =
      evenly_by_size(sample, std::move(all), most_grains / samples);
  Json grains = Json::array();
  for (const std::size_t row : rows) {
    grains.push_back(std::filesystem::path(sample.grains[row]).filename().string());
  }
  Json columns = Json::array();
  std::string values = "[";
  for (std::size_t k = 0; k < sample.columns.size(); ++k) {
    const GrainColumn& column = sample.columns[k];
    columns.push_back(
        {{"name", column.name}, {"words", words_of(column.name)}, {"unit", column.unit}});
    if (k > 0) values += ',';
    values += short_list(sample.values.col(static_cast<Eigen::Index>(k)), rows);
  }
  Json resolved = Json::array();  // the columns with corrected values, in this order
  std::string corrected = "[";
  for (Eigen::Index k = 0; k < sample.corrected.cols(); ++k) {
    const std::string& name = sample.columns[static_cast<std::size_t>(k)].name;
    if (!sample.corrected.col(k).array().isFinite().any()) continue;
    if (!resolved.empty()) corrected += ',';
    resolved.push_back(name);
    corrected += short_list(sample.corrected.col(k), rows);
  }
  const Json head = {{"name", one.name},
                     {"resolved", resolved},
                     {"count", sample.grains.size()},
                     {"sizeName", size_name(sample)},
                     {"columns", columns},
                     {"grains", grains}};
  std::string text = in_page(head);
  text.pop_back();
  if (!resolved.empty()) {
    text += ",\"across\":" + short_list(sample.voxels_across, rows) +
            ",\"corrected\":" + corrected + "]";
  }
  return text + ",\"size\":" + short_list(sample.sizes, rows) +
         ",\"mass\":" + short_list(sample.masses, rows) + ",\"values\":" + values +
         "],\"thumbs\":" + thumbnails(one, rows, most_thumbnails / samples, execution) + "}";
}

Json needed_of(const SampleStatistics& s) {
  Json list = Json::array();
  const auto add = [&](const std::string& name, const Estimate& e) {
    if (!(e.lower < e.upper)) return;  // the same of all grains, or no repetitions
    list.push_back({{"name", name}, {"value", e.value}, {"lower", e.lower}, {"upper", e.upper}});
  };
  add("D10 by mass", s.size_by_mass.d10);
  add("D50 by mass", s.size_by_mass.d50);
  add("D60 by mass", s.size_by_mass.d60);
  for (const ColumnStatistics& column : s.columns) {
    if (column.count > 0) add("mean of " + words_of(column.column.name), column.by_number.mean);
  }
  return list;
}

Json levels_of(const DetailLevels& levels) {
  Json rows = Json::array();
  for (const DescriptorLevels& row : levels.rows) {
    Json median = Json::array();
    Json most = Json::array();
    for (const LevelError& error : row.levels) {
      median.push_back(error.median);
      most.push_back(error.percent_90);
    }
    rows.push_back({{"name", row.name},
                    {"words", words_of(row.name)},
                    {"unit", row.unit},
                    {"median", median},
                    {"percent_90", most}});
  }
  return {{"nodes", levels.nodes}, {"mark", levels.mark_percent}, {"rows", rows}};
}

std::string data_of(const SampleReport& report, const Execution& execution) {
  std::string text = "{\"samples\":[";
  for (const ReportedSample& one : report.samples) {
    if (&one != &report.samples.front()) text += ',';
    text += sample_data(one, report.samples.size(), execution);
  }
  text += "],\"needed\":" + in_page(needed_of(report.samples.front().statistics));
  text += ",\"leastAcross\":" + format_number(least_trusted_across, 3);
  text += ",\"nodesOfFace\":" + format_number(resolved_nodes(1.0, 1.0), 3);
  return text + ",\"levels\":" + (report.levels ? in_page(levels_of(*report.levels)) : "null") +
         "}";
}

Rows size_table(const SampleReport& report) {
  Rows rows = {{"size"}};
  const auto add = [&](const std::string& label, Estimate SizeEstimates::*member) {
    std::vector<std::string> row = {label};
    for (const ReportedSample& one : report.samples) {
      row.push_back(with_interval(one.statistics.size_by_mass.*member));
      row.push_back(with_interval(one.statistics.size_by_number.*member));
    }
    rows.push_back(std::move(row));
  };
  for (const ReportedSample& one : report.samples) {
    const std::string of = report.samples.size() > 1 ? one.name + ", " : "";
    rows[0].push_back(of + "by mass");
    rows[0].push_back(of + "by number");
  }
  add("D10", &SizeEstimates::d10);
  add("D30", &SizeEstimates::d30);
  add("D50", &SizeEstimates::d50);
  add("D60", &SizeEstimates::d60);
  add("D90", &SizeEstimates::d90);
  add("Cu = D60 / D10", &SizeEstimates::uniformity);
  add("Cc = D30^2 / (D10 D60)", &SizeEstimates::curvature);
  return rows;
}

Rows statistics_table(const ReportedSample& one, ColumnFilter is_shown) {
  Rows rows = {{"descriptor", "grains", "mean by number", "std. dev. (n - 1)", "10 %", "median",
                "90 %", "mean by mass", "correlation with size"}};
  for (const ColumnStatistics& c : one.statistics.columns) {
    if (c.count == 0 || !is_shown(c.column.name)) continue;
    const auto value = [](const Estimate& e) { return format_number(e.value, 4); };
    rows.push_back(
        {heading_in_words(c.column), std::to_string(c.count), with_interval(c.by_number.mean),
         value(c.by_number.deviation), value(c.by_number.percent_10), value(c.by_number.median),
         value(c.by_number.percent_90), value(c.by_mass.mean), with_interval(c.size_correlation)});
  }
  return rows;
}

Rows comparison_table(const SampleReport& report, ColumnFilter is_shown) {
  Rows rows = {{"descriptor", "K-S by number", "p", "Wasserstein / deviation", "p", "K-S by mass",
                "p", "Wasserstein / deviation", "p"}};
  for (const ColumnComparison& row : report.comparison) {
    if (row.column.name != "size" && !is_shown(row.column.name)) continue;
    std::vector<std::string> cells = {heading_in_words(row.column)};
    for (const SampleDistance& d : {row.by_number, row.by_mass}) {
      for (const double value :
           {d.kolmogorov, d.kolmogorov_p, row.in_deviations(d), d.wasserstein_p}) {
        cells.push_back(format_number(value, 3));
      }
    }
    rows.push_back(std::move(cells));
  }
  return rows;
}

/// Adds a table; if it is long, what a person reads first, and all of it collapsed. `table_of`
/// returns the rows of the columns that it is given a function for.
template <class TableOf>
void add_long_table(HtmlDocument& page, const TableOf& table_of) {
  const auto rows = table_of([](const std::string&) { return true; });
  if (rows.size() <= most_open_rows) {
    page.add_rows(rows);
    return;
  }
  page.add_rows(table_of(is_first_read));
  page.add_collapsed_rows("All " + std::to_string(rows.size() - 1) + " rows", rows);
}

/// An error this small is rounding.
std::string shown_error(double percent) {
  return percent < 1e-9 ? "exact" : format_number(percent, 3);
}

Rows levels_table(const DetailLevels& levels, ColumnFilter is_shown) {
  Rows rows = {{"median, 90 % of the errors"}};
  for (const double nodes : levels.nodes) rows[0].push_back("N = " + format_number(nodes, 4));
  rows[0].push_back("N for " + format_number(levels.mark_percent, 3) + " %");
  for (const DescriptorLevels& row : levels.rows) {
    if (!is_shown(row.name)) continue;
    std::vector<std::string> cells = {words_of(row.name) +
                                      (row.unit == "%" ? "" : ", " + row.unit)};
    for (const LevelError& error : row.levels) {
      cells.push_back(error.count == 0
                          ? "-"
                          : shown_error(error.median) + ", " + shown_error(error.percent_90));
    }
    cells.push_back(format_number(row.nodes_needed, 4));
    rows.push_back(std::move(cells));
  }
  return rows;
}

Rows trends_table(const ReportedSample& one) {
  Rows rows = {{"correlation with size", "grains resolved", "raw", "corrected",
                "grains from " + format_number(least_trusted_across, 3) + " voxels", "corrected"}};
  for (const VoxelTrend& trend : one.trends) {
    rows.push_back({words_of(trend.name), std::to_string(trend.count), with_interval(trend.raw),
                    with_interval(trend.corrected), std::to_string(trend.trusted_count),
                    with_interval(trend.trusted)});
  }
  return rows;
}

void add_place(HtmlDocument& page, const std::string& id) {
  page.add_html("<p id=\"" + id + "-choice\"></p>\n<div class=\"figures\" id=\"" + id +
                "\"></div>\n");
}

void add_introduction(HtmlDocument& page, const SampleReport& report) {
  page.add_html("<p>" + html_escaped(origin_sentence({})) + "<span id=\"date\"></span></p>\n");
  for (const ReportedSample& one : report.samples) {
    const std::size_t count = one.sample.grains.size();
    std::string text = one.name + (one.name.empty() ? "" : ": ");
    if (one.batch) {
      text += count_line(*one.batch);
    } else {
      text += std::to_string(count) + " grains";
      if (one.sample.failed > 0) text += ", " + std::to_string(one.sample.failed) + " failed";
    }
    text += ".";
    if (count > 0) text += " Size: " + one.sample.size_name + ".";
    if (count > most_grains / report.samples.size()) {
      text += " Figures show " + std::to_string(most_grains / report.samples.size()) +
              " of the grains, chosen evenly by size. Tables use all grains.";
    }
    page.add_paragraph(text);
    if (one.batch && !one.batch->labels.empty()) {
      page.add_paragraph(census_line(one.batch->labels, "labels") + ".");
    }
    if (one.batch && !one.batch->options.empty()) page.add_paragraph(options_line(*one.batch));
    for (const std::string& note : one.sample.notes) page.add_warning(note);
  }
  const int repetitions = report.samples.front().statistics.repetitions;
  if (repetitions > 0) {
    page.add_paragraph("In brackets: 95 % intervals from " + std::to_string(repetitions) +
                       " random samples drawn from this one (percentile bootstrap, seed " +
                       std::to_string(report.options.seed) + ").");
  }
}

/// Adds the kinds of warnings if they are fewer than the grains.
void add_kinds(HtmlDocument& page, const SampleSummary& batch) {
  if (batch.warning_kinds.size() >= batch.with_warnings) return;
  Rows rows = {{"warning", "grains", "first"}};
  for (const WarningKind& one : batch.warning_kinds) {
    rows.push_back({one.kind, std::to_string(one.grains), one.first});
  }
  page.add_rows(rows);
}

void add_messages(HtmlDocument& page, const char* column, const std::vector<GrainMessage>& messages,
                  std::size_t count) {
  if (count == 0) return;
  Rows rows = {{"grain", column}};
  for (const auto& [grain, message] : messages) rows.push_back({grain, message});
  if (rows.size() <= most_open_rows) {
    page.add_rows(rows, RowKind::Typed);
  } else {
    page.add_collapsed_rows(std::to_string(messages.size()) + " grains, each with its " + column,
                            rows, RowKind::Typed);
  }
  if (count > messages.size()) {
    page.add_paragraph("And " + std::to_string(count - messages.size()) + " more. See the table.");
  }
}

/// Adds a row of pictures of the remeshes that are farthest from their scans.
void add_farthest(HtmlDocument& page, const SampleSummary& batch, const Execution& execution) {
  std::string pictures;
  std::size_t count = 0;
  for (const GrainDistance& one : batch.farthest) {
    const auto picture = one.file.empty() ? std::nullopt : thumbnail(one.file, execution);
    if (!picture) continue;
    ++count;
    const std::string name = std::filesystem::path(one.grain).stem().string();
    pictures += "<figure>" + image_element(*picture, name) + "<figcaption>" + html_escaped(name) +
                "<br>" + format_number(one.percent, 3) + " %</figcaption></figure>\n";
  }
  if (count == 0) return;
  const std::size_t made = batch.grains - batch.failed;
  page.add_paragraph((count < made
                          ? "The " + std::to_string(count) + " of " + std::to_string(made) +
                                " remeshes that are farthest from their scans"
                          : "All remeshes, the farthest from its scan first") +
                     ", with the rms distance in % of the equivalent radius.");
  page.add_html("<div class=\"thumbs\">\n" + pictures + "</div>\n");
}

/// Adds histograms of the size and of what the remesh changed, but not of rounding.
void add_histograms(HtmlDocument& page, const SampleSummary& batch) {
  std::vector<Figure> figures;
  for (const SampleDistribution& one : batch.distributions) {
    if (one.values.empty() || !one.in_log || !is_spread(one)) continue;
    figures.push_back(
        {histogram_figure(with_unit(one), "grains", {{"", "#0a58b4", histogram_of(one.values)}}),
         capitalised(one.label) + " of " + std::to_string(one.values.size()) +
             " grains, half of them below " + format_number(quantile(one.values, 0.5), 4) + "."});
  }
  page.add_figures(figures);
}

void add_batches(HtmlDocument& page, const SampleReport& report, const Execution& execution) {
  for (const ReportedSample& one : report.samples) {
    if (!one.batch) continue;
    const SampleSummary& batch = *one.batch;
    const std::string of = report.samples.size() > 1 ? " of " + one.name : "";
    if (batch.failed > 0) page.add_heading("Failures" + of);
    add_messages(page, "error", batch.failures, batch.failed);
    if (batch.with_warnings > 0) page.add_heading("Warnings" + of);
    add_kinds(page, batch);
    add_messages(page, "warnings", batch.warned, batch.with_warnings);
    page.add_heading("Remeshes" + of);
    add_farthest(page, batch, execution);
    page.add_rows(quantity_table(batch));
    add_histograms(page, batch);
  }
}

void add_statistics(HtmlDocument& page, const SampleReport& report) {
  page.add_heading("Size");
  page.add_rows(size_table(report));
  add_place(page, "curves");
  if (!report.comparison.empty()) {
    page.add_heading("Distances between the samples");
    page.add_paragraph(
        "K-S: largest difference of the fractions below a value (Kolmogorov and Smirnov). "
        "Wasserstein: "
        "area between the two fractions, over the first sample's standard deviation. p: fraction "
        "of "
        "random partitions of all grains that are as far apart. If p < 0.05, the samples differ by "
        "more than chance.");
    add_long_table(page, [&](ColumnFilter is_shown) { return comparison_table(report, is_shown); });
  }
  page.add_heading("Form");
  add_place(page, "forms");
  page.add_heading("Descriptors");
  add_place(page, "distributions");
  for (const ReportedSample& one : report.samples) {
    if (report.samples.size() > 1) page.add_paragraph(one.name + ":");
    add_long_table(page, [&](ColumnFilter is_shown) { return statistics_table(one, is_shown); });
  }
  page.add_paragraph(
      "Correlation: rank correlation (Spearman), with the interval of Bonett and Wright (2000). "
      "Reports as .csv or .json have intervals for all columns.");
}

void add_voxels(HtmlDocument& page, const SampleReport& report) {
  if (std::all_of(report.samples.begin(), report.samples.end(),
                  [](const ReportedSample& one) { return one.trends.empty(); })) {
    return;
  }
  page.add_heading("Voxels");
  page.add_paragraph(
      "Few voxels across a grain hide its edges and its roughness, so that a trend with size may "
      "be a trend of the voxels. It is one of the grains if it stays when the values are "
      "corrected, and when the grains with few voxels are left out.");
  add_place(page, "voxels");
  for (const ReportedSample& one : report.samples) {
    if (report.samples.size() > 1) page.add_paragraph(one.name + ":");
    if (!one.trends.empty()) page.add_rows(trends_table(one));
  }
}

void add_levels(HtmlDocument& page, const DetailLevels& levels) {
  page.add_heading("Errors of the remeshes against the number of nodes");
  page.add_paragraph(
      "Distances and contact errors are in % of the equivalent radius, errors of descriptors in "
      "% of the scan's value, all without sign. Contact error: distance of two remeshes at first "
      "contact, minus the distance of two scans, over random pairs of poses. The table has its "
      "mean and its standard deviation over the pairs (scatter), the distance of the places of "
      "contact, and the angle of the contacts' normals in degrees.");
  add_place(page, "levels");
  add_long_table(page, [&](ColumnFilter is_shown) { return levels_table(levels, is_shown); });
}

}  // namespace

std::string sample_html(const SampleReport& report, const Execution& execution) {
  const ReportedSample& first = report.samples.front();
  std::string title = "Sample " + first.name;
  if (report.samples.size() > 1) {
    title = "Samples " + first.name + " and " + report.samples.back().name;
  } else if (first.name.empty()) {
    const std::size_t count = first.batch ? first.batch->grains : first.sample.grains.size();
    title = "A sample of " + format_count(count, "grain");
  }
  HtmlDocument page(title);
  page.add_html(page_style);
  add_introduction(page, report);
  add_batches(page, report, execution);
  if (first.sample.grains.empty()) return page.text();
  add_statistics(page, report);
  add_voxels(page, report);
  if (report.levels) add_levels(page, *report.levels);
  page.add_heading("Grains");
  page.add_html("<p id=\"thumb-choice\"></p>\n<div class=\"thumbs\" id=\"thumbs\"></div>\n");
  page.add_heading("Number of grains needed");
  page.add_html(
      "<p><label>Wanted 95 % interval: value &plusmn; <input id=\"wanted\" type=\"number\" "
      "value=\"2\" min=\"0.01\" step=\"any\"> %</label></p>\n<details><summary>Grains needed for "
      "each statistic</summary>\n<div class=\"wide\"><table><thead><tr><th>statistic</th>"
      "<th>value</th><th>interval now, &plusmn; %</th><th>grains needed</th></tr></thead>"
      "<tbody id=\"needed\"></tbody></table></div></details>\n");
  page.add_html("<script type=\"application/json\" id=\"data\">" + data_of(report, execution) +
                "</script>\n<script>" + sample_page_script + "</script>\n");
  return page.text();
}

}  // namespace wscvt
