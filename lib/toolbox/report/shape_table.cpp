// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/shape_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "toolbox/sample/distribution.h"
#include "toolbox/sample/grain_table.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/voxel_resolution.h"

namespace wscvt {

namespace {

struct ShapeValue {
  GrainColumn column;
  double value;
};

void append_frame(const std::string& mesh, const ShapeDescriptors& basic,
                  std::vector<ShapeValue>& values) {
  const MassProperties mass = mass_properties(basic);
  const auto vector = [&](const std::string& name, const char* const(&parts)[3],
                          const std::string& unit, const Vector3& at) {
    for (int k = 0; k < 3; ++k) values.push_back({{mesh + name + parts[k], unit}, at[k]});
  };
  vector("centroid_", {"x", "y", "z"}, "length", mass.centroid);
  vector("principal_moment_", {"least", "middle", "greatest"}, "length^5", mass.principal_moments);
  const Eigen::Quaterniond& q = mass.principal_axes;
  const std::pair<const char*, double> parts[] = {
      {"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}};
  for (const auto& [name, part] : parts) {
    values.push_back({{mesh + "principal_axes_" + name, ""}, part});
  }
}

void append_mesh(const std::string& mesh, const DetailedDescriptors& descriptors,
                 const MeshQuality& quality, std::vector<ShapeValue>& values) {
  for (DescriptorValue& one : list_descriptors(descriptors)) {
    values.push_back({{mesh + one.key, std::move(one.unit)}, one.value});
  }
  append_frame(mesh, descriptors.basic, values);
  values.push_back({{mesh + "edge_length_mean", "length"}, quality.edge_length.mean});
  values.push_back({{mesh + "edge_length_variation", ""}, quality.edge_variation});
  values.push_back({{mesh + "edge_ratio_mean", ""}, quality.edge_ratio.mean});
  values.push_back({{mesh + "smallest_angle", "degrees"}, quality.smallest_angle});
}

void append_touches(const std::string& suffix, const TouchErrors& errors,
                    std::vector<ShapeValue>& values) {
  const std::tuple<const char*, const char*, ContactSpread> rows[] = {
      {"gap", "%", errors.gap}, {"place", "%", errors.place}, {"normal", "degrees", errors.normal}};
  for (const auto& [name, unit, spread] : rows) {
    const std::string start = "contact_" + std::string(name);
    values.push_back({{start + "_median" + suffix, unit}, spread.median});
    values.push_back({{start + "_90" + suffix, unit}, spread.percent_90});
  }
}

void append_resolution(const Resolution& resolution, std::vector<ShapeValue>& values) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  const bool is_known = !resolution.rows.empty();
  const auto add = [&](const std::string& name, const std::string& unit, double value) {
    values.push_back({{"resolution." + name, unit}, is_known ? value : missing});
  };
  add("voxel_size", "length", resolution.voxel_size);
  add("voxels_across", "", resolution.voxels_across);
  const std::vector<DescriptorValue> names = list_descriptors(DetailedDescriptors());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const ResolvedValue row = is_known ? resolution.rows[k] : ResolvedValue();
    add(names[k].key + ".corrected", names[k].unit, row.corrected);
    add(names[k].key + ".low", names[k].unit, row.low);
    add(names[k].key + ".high", names[k].unit, row.high);
  }
}

/// Visits the numbers of a row, in the order of the columns.
std::vector<ShapeValue> values_of(const RemeshResult& result, const GrainShape& shape) {
  std::vector<ShapeValue> values = {{{"nodes", ""}, static_cast<double>(result.mesh.points.size())},
                                    {{"rms_distance", "length"}, result.rms_distance}};
  if (shape.contacts) {
    values.push_back({{"contact_error_mean", "%"}, shape.contacts->distance.mean});
    values.push_back({{"contact_error_scatter", "%"}, shape.contacts->distance.scatter});
    append_touches("", shape.contacts->two_sided, values);
    append_touches("_one_sided", shape.contacts->one_sided, values);
  }
  if (shape.scan) {
    append_mesh("scan.", *shape.scan, result.scan_quality, values);
    const MeshCheckReport& input = result.input;
    values.push_back({{"scan.vertices", ""}, static_cast<double>(input.vertices)});
    values.push_back({{"scan.genus", ""}, static_cast<double>(input.genus)});
    values.push_back({{"scan.repaired_area_fraction", ""},
                      input.flap_area_fraction + input.filled_area_fraction});
    values.push_back({{"scan.voxel_steps", ""}, input.has_voxel_steps ? 1.0 : 0.0});
  }
  if (shape.resolution) append_resolution(*shape.resolution, values);
  if (shape.remesh) append_mesh("remesh.", *shape.remesh, result.quality, values);
  return values;
}

std::vector<std::string> columns_of(const ShapeMeasures& measures) {
  GrainShape shape;
  if (describes_scan(measures.described)) shape.scan.emplace();
  if (describes_remesh(measures.described)) shape.remesh.emplace();
  if (measures.contacts) shape.contacts.emplace();
  if (measures.resolution && shape.scan) shape.resolution.emplace();
  std::vector<std::string> names = {"grain", "status", "error", "file"};
  for (const ShapeValue& one : values_of(RemeshResult(), shape)) {
    names.push_back(heading_of(one.column));
  }
  return names;
}

/// Returns a value of a column; NaN if there is no such column.
double value_of(const GrainTable& table, std::size_t grain, const std::string& column) {
  const std::optional<std::size_t> found = table.find(column);
  return found ? table.values(static_cast<Eigen::Index>(grain), static_cast<Eigen::Index>(*found))
               : std::nan("");
}

/// Returns the finite values, sorted.
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

std::string shape_header(const ShapeMeasures& measures) { return csv_record(columns_of(measures)); }

GrainShape describe_result(const RemeshResult& result, Described what, const Execution& execution) {
  GrainShape shape;
  const DetailedOptions options;
  if (describes_scan(what)) {
    shape.scan = describe_shape_in_detail(result.repaired_scan, options, execution.part(0.0, 0.8));
  }
  if (describes_remesh(what)) {
    shape.remesh = describe_shape_in_detail(result.mesh, options, execution.part(0.8, 1.0));
  }
  return shape;
}

std::string shape_row(const std::string& grain, const std::string& file, const RemeshResult& result,
                      const GrainShape& shape) {
  std::vector<std::string> fields = {grain, "done", "", file};
  for (const ShapeValue& one : values_of(result, shape)) fields.push_back(format_exact(one.value));
  return csv_record(fields);
}

std::string failed_shape_row(const std::string& grain, const std::string& error,
                             const ShapeMeasures& measures) {
  std::vector<std::string> fields(columns_of(measures).size());
  fields[0] = grain;
  fields[1] = "failed";
  fields[2] = error;
  return csv_record(fields);
}

std::vector<std::string> voxel_lines(const GrainTable& shapes) {
  const auto value = [&](std::size_t grain, const std::string& column) {
    return value_of(shapes, grain, column);
  };
  const std::size_t all = shapes.grains.size();
  std::vector<double> across;
  std::vector<double> enough;
  std::size_t too_many = 0;
  for (std::size_t k = 0; k < all; ++k) {
    across.push_back(value(k, "resolution.voxels_across"));
    enough.push_back(resolved_nodes(value(k, "scan.area"), value(k, "resolution.voxel_size")));
    if (value(k, "nodes") > enough.back()) ++too_many;
  }
  across = ascending(std::move(across));
  if (across.empty()) return {};
  std::vector<std::string> errors;
  std::vector<std::string> missing;
  constexpr std::pair<const char*, const char*> told[] = {{"area", "area"},
                                                          {"sphericity_wadell", "sphericity"},
                                                          {"convexity", "convexity"},
                                                          {"roundness_wadell", "roundness"},
                                                          {"sq", "roughness Sq"}};
  for (const auto& [key, name] : told) {
    if (!shapes.find(std::string("resolution.") + key + ".corrected")) continue;
    std::vector<double> one;
    for (std::size_t k = 0; k < all; ++k) {
      one.push_back(
          relative_error_percent(value(k, std::string("scan.") + key),
                                 value(k, std::string("resolution.") + key + ".corrected")));
    }
    one = ascending(std::move(one));
    if (!one.empty()) errors.push_back(name + (" " + error_text(quantile(one, 0.5))));
    if (one.size() < across.size()) {
      missing.push_back(name + (" of " + of_grains(across.size() - one.size(), across.size())));
    }
  }
  std::vector<std::string> lines = {
      "Voxels across a grain: " + format_number(quantile(across, 0.1), 3) + ", " +
      format_number(quantile(across, 0.5), 3) + ", " + format_number(quantile(across, 0.9), 3) +
      " (10, 50, 90 %). Errors of the scans by the voxels, about, median: " +
      (errors.empty() ? "none is known" : listed(errors)) + "." +
      (missing.empty() ? "" : " Not resolved: " + listed(missing) + ".")};
  if (too_many > 0) {
    lines.push_back("The voxels of " + of_grains(too_many, across.size()) +
                    " resolve fewer nodes than were asked for: " +
                    std::to_string(std::lround(quantile(ascending(std::move(enough)), 0.5))) +
                    " are enough for the median grain.");
  }
  return lines;
}

}  // namespace wscvt
