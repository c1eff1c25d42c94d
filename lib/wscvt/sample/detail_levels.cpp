// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/sample/detail_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/sample/distribution.h"

namespace wscvt {

namespace {

Eigen::ArrayXd column(const GrainTable& table, const std::string& name) {
  return table.values.col(static_cast<Eigen::Index>(table.index_of(name))).array();
}

LevelError level_error(const Eigen::ArrayXd& percent) {
  const Distribution errors(percent.abs().matrix());
  return {errors.quantile(0.5), errors.quantile(0.9), errors.size()};
}

/// Where the line between two points on logarithmic axes meets the mark.
double meeting(double nodes, double error, double next_nodes, double next_error, double mark) {
  if (!(next_error > 0.0)) return next_nodes;
  const double part = std::log(error / mark) / std::log(error / next_error);
  return std::ceil(nodes * std::pow(next_nodes / nodes, part));
}

double nodes_needed(const std::vector<double>& nodes, const std::vector<LevelError>& levels,
                    double mark) {
  // A comparison with NaN, of a descriptor that no grain has, is false.
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
  result.rows.push_back({"rms_distance", {}, 0.0});
  for (const DescriptorValue& one : list_descriptors(DetailedDescriptors())) {
    if (one.on_ratio_scale) result.rows.push_back({one.key, {}, 0.0});
  }
  for (DescriptorLevels& row : result.rows) {
    for (const auto& [nodes, table] : levels) {
      if (&row == &result.rows.front()) {
        const Eigen::ArrayXd radius = 0.5 * column(*table, "scan.equivalent_diameter");
        row.levels.push_back(level_error(100.0 * column(*table, "rms_distance") / radius));
        continue;
      }
      const Eigen::ArrayXd scan = column(*table, "scan." + row.name);
      row.levels.push_back(
          level_error(100.0 * (column(*table, "remesh." + row.name) / scan - 1.0)));
    }
    row.nodes_needed = nodes_needed(result.nodes, row.levels, mark_percent);
  }
  return result;
}

}  // namespace wscvt
