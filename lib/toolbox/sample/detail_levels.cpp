// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/detail_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "toolbox/sample/distribution.h"
#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/measures/descriptor_table.h"

namespace wscvt {

namespace {

Eigen::ArrayXd column(const GrainTable& table, const std::string& name) {
  return table.values.col(table.index_of(name)).array();
}

bool is_contact_error(const std::string& name) { return name.rfind("contact_", 0) == 0; }

/// Returns the error of each grain in %; empty if the table lacks a column.
std::optional<Eigen::ArrayXd> errors_of(const GrainTable& table, const std::string& name) {
  if (name == "rms_distance") {
    if (!table.find(name) || !table.find("scan.equivalent_diameter")) return {};
    return 200.0 * column(table, name) / column(table, "scan.equivalent_diameter");
  }
  if (is_contact_error(name)) {
    if (!table.find(name)) return {};
    return column(table, name);
  }
  if (!table.find("scan." + name) || !table.find("remesh." + name)) return {};
  return 100.0 * (column(table, "remesh." + name) / column(table, "scan." + name) - 1.0);
}

/// Returns the kinds of errors, in the order of a table's rows.
std::vector<std::string> error_names() {
  std::vector<std::string> names = {"rms_distance",          "contact_error_mean",
                                    "contact_error_scatter", "contact_place_median",
                                    "contact_normal_median", "contact_normal_90"};
  for (const DescriptorValue& one : list_descriptors(DetailedDescriptors())) {
    if (one.on_ratio_scale) names.push_back(one.key);
  }
  return names;
}

LevelError level_error(const Eigen::ArrayXd& percent) {
  const Distribution errors(percent.abs().matrix());
  return {errors.quantile(0.5), errors.quantile(0.9), errors.size()};
}

/// Returns the number of nodes at which the line between two points on logarithmic axes meets the
/// mark.
double meeting(double nodes, double error, double next_nodes, double next_error, double mark) {
  if (!(next_error > 0.0)) return next_nodes;
  const double part = portable::log(error / mark) / portable::log(error / next_error);
  return std::ceil(nodes * portable::pow(next_nodes / nodes, part));
}

double nodes_needed(const std::vector<double>& nodes, const std::vector<LevelError>& levels,
                    double mark) {
  // Comparisons with NaN, of a descriptor that no grain has, are false.
  std::size_t first = levels.size();
  while (first > 0 && levels[first - 1].percent_90 <= mark) --first;
  if (first == levels.size()) return std::numeric_limits<double>::quiet_NaN();
  if (first == 0) return nodes.front();
  return meeting(nodes[first - 1], levels[first - 1].percent_90, nodes[first],
                 levels[first].percent_90, mark);
}

}  // namespace

DetailLevels measure_levels(const std::vector<GrainTable>& tables, double mark_percent) {
  require_in_range(mark_percent, mark_option);
  std::vector<std::pair<double, const GrainTable*>> levels;
  for (const GrainTable& table : tables) {
    levels.emplace_back(Distribution(column(table, "nodes").matrix()).quantile(0.5), &table);
  }
  std::sort(levels.begin(), levels.end());
  DetailLevels result;
  result.mark_percent = mark_percent;
  for (const auto& [nodes, table] : levels) {
    if (!result.nodes.empty() && result.nodes.back() == nodes) {
      refuse("Two tables are of remeshes with " + std::to_string(static_cast<int>(nodes)) +
             " nodes. Give one per number of nodes.");
    }
    result.nodes.push_back(nodes);
  }
  for (const std::string& name : error_names()) {
    DescriptorLevels row{name, {}, 0.0};
    if (name.rfind("contact_normal_", 0) == 0) row.unit = "degrees";
    for (const auto& [nodes, table] : levels) {
      if (const auto errors = errors_of(*table, name)) row.levels.push_back(level_error(*errors));
    }
    if (row.levels.size() < levels.size()) continue;
    row.nodes_needed = row.unit == "%" ? nodes_needed(result.nodes, row.levels, mark_percent)
                                       : std::numeric_limits<double>::quiet_NaN();
    result.rows.push_back(std::move(row));
  }
  return result;
}

}  // namespace wscvt
