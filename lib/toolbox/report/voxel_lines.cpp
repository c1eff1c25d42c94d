// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/voxel_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "toolbox/sample/distribution.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

namespace {

/// Finite values of a column, in the order of the grains; NaN if there is no such column.
class Columns {
 public:
  explicit Columns(const GrainTable& table) : table_(table) {}

  double at(std::size_t grain, const std::string& name) const {
    const std::optional<std::size_t> column = table_.find(name);
    return column
               ? table_.values(static_cast<Eigen::Index>(grain), static_cast<Eigen::Index>(*column))
               : std::nan("");
  }

 private:
  const GrainTable& table_;
};

std::vector<double> ascending(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double value) { return !std::isfinite(value); }),
               values.end());
  std::sort(values.begin(), values.end());
  return values;
}

std::string of_grains(std::size_t count, std::size_t all) {
  return std::to_string(count) + " of " + std::to_string(all) + " grains";
}

}  // namespace

std::vector<std::string> voxel_lines(const GrainTable& shapes) {
  const Columns columns(shapes);
  const std::size_t all = shapes.grains.size();
  std::vector<double> across;
  std::vector<double> enough;
  std::size_t too_many = 0;
  for (std::size_t k = 0; k < all; ++k) {
    across.push_back(columns.at(k, "resolution.voxels_across"));
    const double nodes =
        resolved_nodes(columns.at(k, "scan.area"), columns.at(k, "resolution.voxel_size"));
    enough.push_back(nodes);
    if (columns.at(k, "nodes") > nodes) ++too_many;
  }
  across = ascending(std::move(across));
  if (across.empty()) return {};
  std::string errors;
  std::string missing;
  constexpr std::pair<const char*, const char*> told[] = {{"area", "area"},
                                                          {"sphericity_wadell", "sphericity"},
                                                          {"convexity", "convexity"},
                                                          {"roundness_wadell", "roundness"}};
  for (const auto& [key, name] : told) {
    std::vector<double> one;
    for (std::size_t k = 0; k < all; ++k) {
      one.push_back(
          relative_error_percent(columns.at(k, std::string("scan.") + key),
                                 columns.at(k, std::string("resolution.") + key + ".corrected")));
    }
    one = ascending(std::move(one));
    if (!one.empty()) {
      errors += (errors.empty() ? "" : ", ") + std::string(name) + " " +
                format_error(quantile(one, 0.5)) + " %";
    }
    if (one.size() < across.size()) {
      missing += (missing.empty() ? "" : ", ") + std::string(name) + " of " +
                 of_grains(across.size() - one.size(), across.size());
    }
  }
  std::vector<std::string> lines = {
      "Voxels across a grain: " + format_number(quantile(across, 0.1), 3) + ", " +
      format_number(quantile(across, 0.5), 3) + ", " + format_number(quantile(across, 0.9), 3) +
      " (10, 50, 90 %). Errors of the scans by the voxels, about, median: " +
      (errors.empty() ? "none is known" : errors) + "." +
      (missing.empty() ? "" : " Not resolved: " + missing + ".")};
  if (too_many > 0) {
    lines.push_back("The voxels of " + of_grains(too_many, across.size()) +
                    " resolve fewer nodes than were asked for: " +
                    std::to_string(std::lround(quantile(ascending(std::move(enough)), 0.5))) +
                    " are enough for the median grain.");
  }
  return lines;
}

}  // namespace wscvt
