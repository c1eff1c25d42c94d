// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <utility>

#include "wscvt/base/option.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/voxel_resolution.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

/// Descriptors of the terminal's table. The files contain all descriptors.
bool is_main(const std::string& name) {
  constexpr const char* others[] = {"volume",           "area",          "equivalent_diameter",
                                    "aspect_ratio_box", "sdq_invariant", "sq"};
  return is_read_first(name) ||
         std::find(std::begin(others), std::end(others), name) != std::end(others);
}

/// Of levels, also the errors of the remesh itself, not of a descriptor.
bool is_main_level(const std::string& name) {
  return is_main(name) || name == "rms_distance" || name.rfind("contact_", 0) == 0;
}

using Rows = std::vector<std::vector<std::string>>;
using IsShown = std::function<bool(const std::string&)>;

std::string short_number(double value) { return format_number(value, 4); }

/// Visits a sample's sizes: the name, the statistic by mass and by number.
template <class Visitor>
void for_each_size(const SampleStatistics& s, const Visitor& visit) {
  const std::pair<const char*, Estimate SizeEstimates::*> rows[] = {
      {"D10", &SizeEstimates::d10},     {"D30", &SizeEstimates::d30},
      {"D50", &SizeEstimates::d50},     {"D60", &SizeEstimates::d60},
      {"D90", &SizeEstimates::d90},     {"Cu", &SizeEstimates::uniformity},
      {"Cc", &SizeEstimates::curvature}};
  for (const auto& [name, member] : rows) {
    visit(name, s.size_by_mass.*member, s.size_by_number.*member);
  }
}

/// Visits a descriptor's statistics: the name and the estimate.
template <class Visitor>
void for_each_estimate(const ColumnEstimates& c, const Visitor& visit) {
  visit("mean", c.mean);
  visit("standard_deviation", c.deviation);
  visit("percent_10", c.percent_10);
  visit("median", c.median);
  visit("percent_90", c.percent_90);
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

std::string of_grains(const ReportedSample& one) {
  const std::size_t count = one.sample.grains.size();
  return one.name + ": " + std::to_string(count) + " grains" +
         (one.sample.failed > 0 ? ", " + std::to_string(one.sample.failed) + " failed" : "");
}

/// Returns no lines for a heading alone.
std::vector<std::string> table_of(const Rows& rows) {
  return rows.size() > 1 ? aligned_lines(rows) : std::vector<std::string>();
}

Rows descriptor_rows(const ReportedSample& one, const IsShown& is_shown) {
  Rows rows = {{"by number", "mean", "95 % from", "to", "median", "by mass"}};
  for (const ColumnStatistics& column : one.statistics.columns) {
    if (!is_shown(column.column.name) || column.count == 0) continue;
    const Estimate& mean = column.by_number.mean;
    rows.push_back({column.column.name, short_number(mean.value), short_number(mean.lower),
                    short_number(mean.upper), short_number(column.by_number.median.value),
                    short_number(column.by_mass.mean.value)});
  }
  return rows;
}

void append_sample(const ReportedSample& one, std::vector<std::string>& lines) {
  lines.push_back(of_grains(one));
  append(lines, one.sample.notes);
  lines.push_back("Size: " + one.sample.size_name +
                  (one.sample.size_unit.empty() ? "" : ", " + one.sample.size_unit));
  lines.push_back("Mass of all grains: " + short_number(one.statistics.mass));
  Rows rows = {{"", "by mass", "95 % from", "to", "by number", "95 % from", "to"}};
  for_each_size(one.statistics, [&](const char* name, const Estimate& mass, const Estimate& count) {
    rows.push_back({name, short_number(mass.value), short_number(mass.lower),
                    short_number(mass.upper), short_number(count.value), short_number(count.lower),
                    short_number(count.upper)});
  });
  append(lines, aligned_lines(rows));
  append(lines, table_of(descriptor_rows(one, is_main)));
  rows = {{"correlation with size", "resolved", "raw", "corrected",
           "from " + short_number(least_trusted_across) + " voxels"}};
  for (const VoxelTrend& trend : one.trends) {
    if (!is_main(trend.name)) continue;
    rows.push_back({trend.name, std::to_string(trend.count), short_number(trend.raw.value),
                    short_number(trend.corrected.value), short_number(trend.trusted.value)});
  }
  append(lines, table_of(rows));
}

Rows comparison_rows(const SampleReport& report, const IsShown& is_shown) {
  Rows rows = {{"by number", "K-S distance", "p", "Wasserstein / deviation", "p"}};
  for (const ColumnComparison& row : report.comparison) {
    if (row.column.name != "size" && !is_shown(row.column.name)) continue;
    const SampleDistance& d = row.by_number;
    rows.push_back({row.column.name, short_number(d.kolmogorov), short_number(d.kolmogorov_p),
                    short_number(row.in_deviations(d)), short_number(d.wasserstein_p)});
  }
  return rows;
}

Rows level_rows(const DetailLevels& levels, const IsShown& is_shown) {
  // Four columns fit a terminal's line.
  const std::size_t shown = std::min<std::size_t>(levels.nodes.size(), 4);
  const std::size_t first = levels.nodes.size() - shown;
  Rows rows = {{"90 % of errors, %"}};
  for (std::size_t k = first; k < levels.nodes.size(); ++k) {
    rows[0].push_back("N " + short_number(levels.nodes[k]));
  }
  rows[0].push_back("N for " + short_number(levels.mark_percent) + " %");
  for (const DescriptorLevels& row : levels.rows) {
    if (row.levels.back().count == 0 || !is_shown(row.name)) continue;
    std::vector<std::string> cells = {row.name + (row.unit == "%" ? "" : ", " + row.unit)};
    for (std::size_t k = first; k < row.levels.size(); ++k) {
      // An error this small is rounding.
      const double error = row.levels[k].percent_90;
      cells.push_back(error < 1e-9 ? "exact" : short_number(error));
    }
    cells.push_back(short_number(row.nodes_needed));
    rows.push_back(std::move(cells));
  }
  return rows;
}

Json json_of(const Estimate& estimate) {
  return {{"value", estimate.value}, {"lower", estimate.lower}, {"upper", estimate.upper}};
}

Json json_of(const ColumnEstimates& estimates) {
  Json json = Json::object();
  for_each_estimate(estimates,
                    [&](const char* name, const Estimate& one) { json[name] = json_of(one); });
  return json;
}

/// Visits the distances of a descriptor of two samples.
template <class Visitor>
void for_each_distance(const SampleDistance& d, const Visitor& visit) {
  visit("kolmogorov_smirnov", d.kolmogorov);
  visit("kolmogorov_smirnov_p", d.kolmogorov_p);
  visit("wasserstein", d.wasserstein);
  visit("wasserstein_p", d.wasserstein_p);
}

Json json_of(const SampleDistance& d) {
  Json json = Json::object();
  for_each_distance(d, [&](const char* name, double value) { json[name] = value; });
  return json;
}

Json json_of(const ReportedSample& one) {
  const SampleStatistics& s = one.statistics;
  Json by_mass = Json::object();
  Json by_number = Json::object();
  for_each_size(s, [&](const char* name, const Estimate& mass, const Estimate& count) {
    by_mass[name] = json_of(mass);
    by_number[name] = json_of(count);
  });
  Json columns = Json::object();
  for (const ColumnStatistics& column : s.columns) {
    columns[column.column.name] = {{"unit", column.column.unit},
                                   {"count", column.count},
                                   {"minimum", column.smallest},
                                   {"maximum", column.largest},
                                   {"by_number", json_of(column.by_number)},
                                   {"by_mass", json_of(column.by_mass)},
                                   {"size_correlation", json_of(column.size_correlation)}};
  }
  Json trends = Json::object();
  for (const VoxelTrend& trend : one.trends) {
    trends[trend.name] = {{"grains", trend.count},
                          {"raw", json_of(trend.raw)},
                          {"corrected", json_of(trend.corrected)},
                          {"trusted_grains", trend.trusted_count},
                          {"trusted", json_of(trend.trusted)}};
  }
  return {{"name", one.name},
          {"trends_with_voxels", trends},
          {"grains", one.sample.grains.size()},
          {"failed", one.sample.failed},
          {"notes", one.sample.notes},
          {"density", one.sample.density},
          {"mass", s.mass},
          {"repetitions", s.repetitions},
          {"size", {{"by_mass", by_mass}, {"by_number", by_number}}},
          {"descriptors", columns}};
}

Json json_of(const DetailLevels& levels) {
  Json rows = Json::object();
  for (const DescriptorLevels& row : levels.rows) {
    Json errors = Json::array();
    for (std::size_t k = 0; k < row.levels.size(); ++k) {
      errors.push_back({{"nodes", levels.nodes[k]},
                        {"grains", row.levels[k].count},
                        {"median_percent", row.levels[k].median},
                        {"percent_90_percent", row.levels[k].percent_90}});
    }
    rows[row.name] = {{"unit", row.unit}, {"errors", errors}, {"nodes_needed", row.nodes_needed}};
  }
  return {{"mark_percent", levels.mark_percent}, {"descriptors", rows}};
}

/// Rows of a CSV for the distances of two samples. Only Wasserstein's has a unit.
void append_comparison(const SampleReport& report, std::string& text) {
  for (const ColumnComparison& row : report.comparison) {
    for (const auto& [weighting, distance] :
         {std::pair("number", row.by_number), std::pair("mass", row.by_mass)}) {
      const char* name = weighting;
      for_each_distance(distance, [&](const std::string& statistic, double value) {
        text += csv_record({report.samples[0].name + " and " + report.samples[1].name,
                            row.column.name, statistic == "wasserstein" ? row.column.unit : "",
                            name, statistic, format_exact(value), "", ""});
      });
    }
  }
}

/// Rows of a sample's CSV for the errors at each number of nodes.
void append_levels(const std::string& sample, const DetailLevels& levels, std::string& text) {
  for (const DescriptorLevels& row : levels.rows) {
    const auto add = [&](const std::string& unit, const std::string& statistic, double value) {
      text +=
          csv_record({sample, row.name, unit, "number", statistic, format_exact(value), "", ""});
    };
    for (std::size_t k = 0; k < row.levels.size(); ++k) {
      const std::string nodes = "_n" + format_number(levels.nodes[k], 9);
      add(row.unit, "error_median" + nodes, row.levels[k].median);
      add(row.unit, "error_percent_90" + nodes, row.levels[k].percent_90);
    }
    add("", "nodes_needed", row.nodes_needed);
  }
}

/// Returns the summary of the batch that wrote a table of shapes; nothing if another program did.
std::optional<SampleSummary> batch_of(const std::string& folder, const GrainTable& shapes) {
  const std::string path = (std::filesystem::path(folder) / "grains.csv").string();
  if (!is_batch_table(path)) return {};
  SampleSummary batch = summarise_table(path);
  for (GrainDistance& one : batch.farthest) {
    const auto found = std::find(shapes.grains.begin(), shapes.grains.end(), one.grain);
    if (found == shapes.grains.end() || shapes.files.empty()) continue;
    const auto place = static_cast<std::size_t>(found - shapes.grains.begin());
    one.file = (std::filesystem::path(folder) / shapes.files[place]).string();
  }
  return batch;
}

}  // namespace

bool is_first_read(const std::string& name) {
  return is_read_first(name) || name == "rms_distance" || name == "contact_error_mean";
}

std::string size_name(const GrainSample& sample) {
  const std::string name = sample.size_name.substr(0, sample.size_name.find(':'));
  return sample.size_unit.empty() ? name : name + ", " + sample.size_unit;
}

std::string with_interval(const Estimate& estimate) {
  std::string text = format_number(estimate.value, 4);
  if (std::isfinite(estimate.lower)) {
    text +=
        " (" + format_number(estimate.lower, 4) + " to " + format_number(estimate.upper, 4) + ")";
  }
  return text;
}

void add_sample(SampleReport& report, const std::string& name, const SampleTables& sample,
                const std::vector<double>& densities, double mark_percent,
                const Execution& execution) {
  const std::size_t number = report.samples.size();
  SampleOptions options = report.options;
  if (!densities.empty()) options.density = densities[std::min(number, densities.size() - 1)];
  const std::size_t shown = finest_table(sample.tables);
  ReportedSample one;
  one.name = name;
  if (!sample.files.empty()) {
    one.folder = std::filesystem::path(sample.files[shown]).parent_path().string();
    if (one.folder.empty()) one.folder = ".";
    one.batch = batch_of(one.folder, sample.tables[shown]);
  }
  one.sample = sample_of(sample.tables[shown], options);
  one.statistics = measure_sample(one.sample, options, execution);
  one.trends = voxel_trends(one.sample);
  if (number == 0 && sample.tables.size() > 1) {
    DetailLevels levels = measure_levels(sample.tables, mark_percent);
    if (!levels.rows.empty()) report.levels = std::move(levels);
  }
  report.samples.push_back(std::move(one));
}

void compare_samples(SampleReport& report, const Execution& execution) {
  if (report.samples.size() != 2) return;
  report.comparison = compare_samples(report.samples[0].sample, report.samples[1].sample,
                                      report.options, execution);
}

std::vector<std::string> sample_lines(const SampleReport& report) {
  std::vector<std::string> lines;
  for (const ReportedSample& one : report.samples) append_sample(one, lines);
  append(lines, table_of(comparison_rows(report, is_main)));
  if (report.levels) append(lines, table_of(level_rows(*report.levels, is_main_level)));
  return lines;
}

std::vector<std::string> summary_lines(const SampleReport& report) {
  std::vector<std::string> lines;
  for (const ReportedSample& one : report.samples) {
    lines.push_back(of_grains(one));
    append(lines, one.sample.notes);
    const SizeEstimates& sizes = one.statistics.size_by_mass;
    lines.push_back(capitalised(size_name(one.sample)) + " by mass: D10 " +
                    with_interval(sizes.d10) + ", D50 " + with_interval(sizes.d50) + ", D90 " +
                    with_interval(sizes.d90));
  }
  if (!report.comparison.empty()) {
    append(lines, table_of(comparison_rows(report, is_first_read)));
  } else if (report.levels) {
    append(lines, table_of(level_rows(*report.levels, is_first_read)));
  } else {
    append(lines, table_of(descriptor_rows(report.samples.front(), is_first_read)));
  }
  return lines;
}

std::string sample_json(const SampleReport& report) {
  Json samples = Json::array();
  for (const ReportedSample& one : report.samples) samples.push_back(json_of(one));
  Json comparison = Json::object();
  for (const ColumnComparison& row : report.comparison) {
    comparison[row.column.name] = {{"unit", row.column.unit},
                                   {"deviation", row.deviation},
                                   {"by_number", json_of(row.by_number)},
                                   {"by_mass", json_of(row.by_mass)}};
  }
  const SampleOptions& options = report.options;
  return json_document({{"format", "wscvt-sample-statistics"},
                        {"version", 1},
                        {"made_by", made_by()},
                        {"options",
                         {{"size", key_of(options.size)},
                          {"of", key_of(options.of)},
                          {"seed", options.seed},
                          {"repetitions", options.repetitions}}},
                        {"samples", samples},
                        {"comparison", comparison},
                        {"levels", report.levels ? json_of(*report.levels) : Json()}});
}

std::string sample_csv(const SampleReport& report) {
  std::string text = csv_record(
      {"sample", "descriptor", "unit", "weighting", "statistic", "value", "lower", "upper"});
  for (const ReportedSample& one : report.samples) {
    const auto add = [&](const GrainColumn& column, const char* weighting, const char* statistic,
                         const Estimate& e) {
      text += csv_record({one.name, column.name, column.unit, weighting, statistic,
                          format_exact(e.value), format_exact(e.lower), format_exact(e.upper)});
    };
    for_each_size(one.statistics,
                  [&](const char* name, const Estimate& mass, const Estimate& count) {
                    const bool is_ratio = name[0] == 'C';
                    const GrainColumn size = {"size", is_ratio ? "" : one.sample.size_unit};
                    add(size, "mass", name, mass);
                    add(size, "number", name, count);
                  });
    for (const ColumnStatistics& column : one.statistics.columns) {
      for (const auto& [weighting, estimates] :
           {std::pair("number", column.by_number), std::pair("mass", column.by_mass)}) {
        const char* name = weighting;
        for_each_estimate(estimates, [&](const char* statistic, const Estimate& e) {
          add(column.column, name, statistic, e);
        });
      }
      add({column.column.name, ""}, "number", "size_correlation", column.size_correlation);
    }
    for (const VoxelTrend& trend : one.trends) {
      add({trend.name, ""}, "number", "size_correlation_resolved", trend.raw);
      add({trend.name, ""}, "number", "size_correlation_corrected", trend.corrected);
      add({trend.name, ""}, "number", "size_correlation_trusted", trend.trusted);
    }
  }
  append_comparison(report, text);
  if (report.levels) append_levels(report.samples.front().name, *report.levels, text);
  return text;
}

void write_sample_report(const std::string& path, const SampleReport& report,
                         const Execution& execution) {
  const ReportFormat format = report_format(path);
  write_file(path, format == ReportFormat::Page       ? sample_html(report, execution)
                   : format == ReportFormat::Document ? sample_json(report)
                                                      : sample_csv(report));
}

}  // namespace wscvt
