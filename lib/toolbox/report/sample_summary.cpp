// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/sample_summary.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "toolbox/report/sample_table.h"
#include "toolbox/sample/csv_reader.h"
#include "toolbox/sample/distribution.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

/// A number of a grain: a column of the table, or the quotient of two.
struct Source {
  const char* key;
  const char* label;
  const char* unit;
  const char* column;
  const char* divisor = nullptr;  ///< null: none
  /// The scans' shape has a page's own figures.
  bool in_log = true;
};
constexpr Source sources[] = {
    {"equivalent_radius", "equivalent radius", "length", "input.equivalent_radius"},
    {"volume", "volume", "length^3", "descriptors.volume.scan", nullptr, false},
    {"aspect_ratio", "aspect ratio S / L", "", "descriptors.aspect_ratio_inertia.scan", nullptr,
     false},
    {"elongation", "elongation I / L", "", "descriptors.axis_i_inertia.scan",
     "descriptors.axis_l_inertia.scan", false},
    {"flatness", "flatness S / I", "", "descriptors.axis_s_inertia.scan",
     "descriptors.axis_i_inertia.scan", false},
    {"sphericity", "sphericity (Wadell)", "", "descriptors.sphericity_wadell.scan", nullptr, false},
    {"volume_error", "error of the volume", "%", "descriptors.volume.error_percent"},
    {"area_error", "error of the area", "%", "descriptors.area.error_percent"},
    {"sphericity_error", "error of the sphericity", "%",
     "descriptors.sphericity_wadell.error_percent"},
    {"rms_distance", "rms distance / equivalent radius", "%",
     "rms_distance.percent_of_equivalent_radius"},
    {"edge_ratio", "mean of longest / shortest edge", "", "quality.remesh.edge_ratio.mean"},
    {"smallest_angle", "smallest angle", "degrees", "quality.remesh.smallest_angle_degrees"},
};

double number_of(const std::string& field) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(field.data(), field.data() + field.size(), value);
  return value;
}

double mean_of(const std::vector<double>& values) { return Distribution(values).mean(); }
double deviation_of(const std::vector<double>& values) { return Distribution(values).deviation(); }

double first_of(const std::vector<double>& values) { return quantile(values, 0.0); }
double last_of(const std::vector<double>& values) { return quantile(values, 1.0); }

/// Formats a number of a row. An error this small is rounding.
std::string shown(const SampleDistribution& one, double value, int digits) {
  const bool is_rounding = one.unit == "%" && std::abs(value) < 1e-9;
  return is_rounding ? "exact" : format_number(value, digits);
}

/// Returns "Warnings: a.ply, b.ply and 7 more", at most 80 characters unless one name is longer.
/// The table has the warnings themselves. Empty without warnings.
std::string warned_line(const SampleSummary& summary) {
  constexpr std::size_t longest = 80;
  std::string line;
  std::size_t named = 0;
  for (const auto& [grain, warnings] : summary.warned) {
    const std::size_t left = summary.with_warnings - named - 1;
    const std::string rest = left == 0 ? "" : " and " + std::to_string(left) + " more";
    const std::string longer = (named == 0 ? "Warnings: " : line + ", ") + grain;
    if (named > 0 && longer.size() + rest.size() > longest) break;
    line = longer;
    ++named;
  }
  if (named == summary.with_warnings) return line;
  return line + " and " + std::to_string(summary.with_warnings - named) + " more";
}

/// Returns what the warnings of one kind have in common: the begin of the text up to a colon or its
/// end, with "N" for numbers and "..." for what is quoted.
std::string kind_of(const std::string& warning) {
  std::string kind;
  std::size_t k = 0;
  while (k < warning.size() && warning[k] != ':' && warning[k] != '.') {
    if (warning[k] == '"') {
      kind += "\"...\"";
      k = std::min(warning.find('"', k + 1), warning.size() - 1) + 1;
    } else if (warning[k] >= '0' && warning[k] <= '9') {
      kind += 'N';
      k = std::min(warning.find_first_not_of("0123456789.", k), warning.size());
      if (warning[k - 1] == '.') break;  // of the sentence
    } else {
      kind += warning[k++];
    }
  }
  return kind;
}

/// Counts a grain with each kind of its warnings.
void count_kinds(const std::string& grain, const std::string& warnings, SampleSummary& summary) {
  std::set<std::string> counted;
  for (std::size_t begin = 0; begin < warnings.size();) {
    const std::size_t end = std::min(warnings.find(sentence_separator, begin), warnings.size());
    const std::string kind = kind_of(warnings.substr(begin, end - begin));
    begin = end + sentence_separator.size();
    if (!counted.insert(kind).second) continue;
    std::vector<WarningKind>& kinds = summary.warning_kinds;
    const auto found = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const WarningKind& one) { return one.kind == kind; });
    if (found != kinds.end()) {
      ++found->grains;
    } else {
      kinds.push_back({kind, 1, grain});
    }
  }
}

constexpr const char* option_prefix = "options.";
constexpr const char* several = "several";

/// Reads the options of a row into those of the rows before.
void read_options(const std::vector<std::string>& fields,
                  const std::vector<std::pair<std::string, std::size_t>>& places,
                  SampleSummary& summary) {
  const bool is_first = summary.options.empty();
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::string& value = fields[places[k].second];
    if (is_first) {
      summary.options.emplace_back(places[k].first, value);
    } else if (summary.options[k].second != value) {
      summary.options[k].second = several;
    }
  }
}

bool is_farther(const GrainDistance& a, const GrainDistance& b) { return a.percent > b.percent; }

/// Keeps the farthest grains. Of equal ones it keeps the first.
void keep_farthest(SampleSummary& summary, GrainDistance one) {
  std::vector<GrainDistance>& all = summary.farthest;
  if (all.size() == most_grains_shown && !is_farther(one, all.back())) return;
  all.insert(std::upper_bound(all.begin(), all.end(), one, is_farther), std::move(one));
  if (all.size() > most_grains_shown) all.pop_back();
}

}  // namespace

bool is_batch_table(const std::string& path) {
  const std::string expected = sample_header();
  std::string begin(expected.size(), '\0');
  std::ifstream stream(path, std::ios::binary);
  return stream.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == expected;
}

SampleSummary summarise_table(const std::string& path) {
  InputFile stream(path);
  CsvReader reader(stream);
  std::vector<std::string> fields;
  if (!reader.next(fields)) refuse("\"" + path + "\" is empty. Give a table that batch wrote.");
  const std::vector<std::string> header = fields;
  const auto place_of = [&](const char* name) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      refuse("\"" + path + "\" has no column " + name +
             ", so it is not a table of a sample. Give a table that batch wrote.");
    }
    return static_cast<std::size_t>(found - header.begin());
  };
  const std::size_t grain = place_of("grain");
  const std::size_t status = place_of("status");
  const std::size_t error = place_of("error");
  const std::size_t warnings = place_of("warnings");
  SampleSummary summary;
  std::vector<std::pair<std::size_t, std::optional<std::size_t>>> places;
  for (const Source& source : sources) {
    places.emplace_back(place_of(source.column), std::nullopt);
    if (source.divisor != nullptr) places.back().second = place_of(source.divisor);
    summary.distributions.push_back({source.key, source.label, source.unit, source.in_log, {}});
  }
  std::vector<std::pair<std::string, std::size_t>> options;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (fields[k].rfind(option_prefix, 0) != 0) continue;
    options.emplace_back(fields[k].substr(std::string_view(option_prefix).size()), k);
  }
  const std::size_t distance = place_of("rms_distance.percent_of_equivalent_radius");
  while (reader.next(fields)) {
    if (fields.size() != header.size()) {
      refuse("\"" + path + "\" has " + std::to_string(fields.size()) + " fields in row " +
             std::to_string(summary.grains + 1) + " and " + std::to_string(header.size()) +
             " columns. Create it again.");
    }
    ++summary.grains;
    if (fields[status] != "done") {
      ++summary.failed;
      if (summary.failures.size() < most_failures_named) {
        summary.failures.push_back({fields[grain], fields[error]});
      }
      continue;
    }
    if (!fields[warnings].empty()) {
      ++summary.with_warnings;
      count_kinds(fields[grain], fields[warnings], summary);
      if (summary.warned.size() < most_failures_named) {
        summary.warned.push_back({fields[grain], fields[warnings]});
      }
    }
    read_options(fields, options, summary);
    const double percent = number_of(fields[distance]);
    if (std::isfinite(percent)) keep_farthest(summary, {fields[grain], percent, ""});
    for (std::size_t k = 0; k < places.size(); ++k) {
      const auto& [column, divisor] = places[k];
      const double value =
          number_of(fields[column]) / (divisor ? number_of(fields[*divisor]) : 1.0);
      if (std::isfinite(value)) summary.distributions[k].values.push_back(value);
    }
  }
  if (reader.is_cut()) {
    refuse("\"" + path + "\" ends within a row. Run its batch command again to complete it.");
  }
  for (SampleDistribution& one : summary.distributions) {
    std::sort(one.values.begin(), one.values.end());
  }
  return summary;
}

Histogram histogram_of(const std::vector<double>& values) {
  // Square-root rule, with bins wide enough to be visible.
  const auto bins = static_cast<std::size_t>(
      std::clamp(std::sqrt(static_cast<double>(values.size())), 8.0, 60.0));
  Histogram histogram{first_of(values), last_of(values), std::vector<std::size_t>(bins, 0)};
  const double size = std::max(std::abs(histogram.lower), std::abs(histogram.upper));
  if (!(histogram.upper - histogram.lower > 1e-9 * size)) {
    // All values are equal except for rounding: use a bin around them.
    const double half = std::max(size * 0.01, 1e-300);
    histogram.lower -= half;
    histogram.upper += half;
  }
  const double width = (histogram.upper - histogram.lower) / static_cast<double>(bins);
  for (const double value : values) {
    const double bin = std::floor((value - histogram.lower) / width);
    ++histogram
          .counts[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1)))];
  }
  return histogram;
}

std::string census_line(CensusStates states, const std::string& noun) {
  const char* made = states["taken"] > 0 ? "taken" : "written";
  std::string text = (noun == "bodies" ? format_count(states["all"], "body", noun)
                                       : format_count(states["all"], "label")) +
                     ": " + std::to_string(states[made]) + " " + made;
  if (states["pieces"] > 0) text += " (" + std::to_string(states["pieces"]) + " in pieces)";
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + what;
  };
  add(states["at the border"], " at the border");
  add(states["too small"], " too small");
  add(states["open"], " open and only listed");
  add(states["failed"], " failed");
  add(states["pores"], states["pores"] == 1 ? " pore in them" : " pores in them");
  return text;
}

std::string summary_json(const SampleSummary& summary) {
  Json distributions = Json::object();
  for (const SampleDistribution& one : summary.distributions) {
    distributions[one.key] = {{"label", one.label},
                              {"unit", one.unit},
                              {"count", one.values.size()},
                              {"mean", mean_of(one.values)},
                              {"standard_deviation", deviation_of(one.values)},
                              {"minimum", first_of(one.values)},
                              {"percent_10", quantile(one.values, 0.1)},
                              {"median", quantile(one.values, 0.5)},
                              {"percent_90", quantile(one.values, 0.9)},
                              {"maximum", last_of(one.values)}};
  }
  Json failures = Json::array();
  for (const auto& [grain, error] : summary.failures) {
    failures.push_back({{"grain", grain}, {"error", error}});
  }
  Json kinds = Json::array();
  for (const WarningKind& one : summary.warning_kinds) {
    kinds.push_back({{"kind", one.kind}, {"grains", one.grains}, {"first", one.first}});
  }
  Json warned = Json::array();
  for (const GrainMessage& one : summary.warned) warned.push_back(one.grain);
  Json json = {{"format", "wscvt-sample"},
               {"version", 1},
               {"made_by", made_by()},
               {"grains", summary.grains},
               {"remeshed", summary.grains - summary.failed},
               {"with_warnings", summary.with_warnings},
               {"warning_kinds", kinds},
               {"grains_with_warnings", warned},
               {"failed", summary.failed},
               {"distributions", distributions},
               {"failures", failures}};
  if (!summary.labels.empty()) json["labels"] = summary.labels;
  return json_document(json);
}

std::string count_line(const SampleSummary& summary) {
  return format_count(summary.grains, "grain") + ": " +
         std::to_string(summary.grains - summary.failed) + " remeshed, " +
         std::to_string(summary.with_warnings) + " of them with warnings, " +
         std::to_string(summary.failed) + " failed";
}

std::string options_line(const SampleSummary& summary) {
  std::string line;
  for (const auto& [name, value] : summary.options) {
    if (value.empty()) continue;
    line += (line.empty() ? "Options: " : ", ") + name + " " + value;
  }
  return line + ".";
}

std::vector<std::vector<std::string>> quantity_table(const SampleSummary& summary) {
  std::vector<std::vector<std::string>> rows = {
      {"Quantity", "mean", "std. dev. (n - 1)", "smallest", "10 %", "50 %", "90 %", "largest"}};
  for (const SampleDistribution& one : summary.distributions) {
    if (one.values.empty()) continue;
    rows.push_back({with_unit(one), shown(one, mean_of(one.values), 4),
                    shown(one, deviation_of(one.values), 4)});
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      rows.back().push_back(shown(one, quantile(one.values, share), 4));
    }
  }
  return rows;
}

std::string with_unit(const SampleDistribution& one) {
  return one.unit.empty() ? one.label : one.label + ", " + one.unit;
}

bool is_spread(const SampleDistribution& one) {
  return shown(one, first_of(one.values), 4) != shown(one, last_of(one.values), 4);
}

std::vector<std::string> summary_lines(const SampleSummary& summary) {
  std::vector<std::string> lines = {count_line(summary)};
  if (summary.with_warnings > 0) lines.push_back(warned_line(summary));
  // What a person reads first, in 80 columns. The page has all quantities and columns.
  std::vector<std::vector<std::string>> rows = {{"Quantity", "mean", "10 %", "50 %", "90 %"}};
  for (const SampleDistribution& one : summary.distributions) {
    if (one.values.empty() || !one.in_log) continue;
    rows.push_back({with_unit(one), shown(one, mean_of(one.values), 3)});
    for (const double share : {0.1, 0.5, 0.9}) {
      rows.back().push_back(shown(one, quantile(one.values, share), 3));
    }
  }
  if (rows.size() == 1) return lines;
  for (std::string& line : aligned_lines(rows)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace wscvt
