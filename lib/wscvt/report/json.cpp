// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/json.h"

#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

struct Columns {
  std::vector<std::string> names;
  std::vector<std::string> fields;

  void add(const std::string& name, std::string field) {
    names.push_back(name);
    fields.push_back(std::move(field));
  }
};

bool holds_sentences(const Json& list, const std::string& name) {
  // The items of an empty list have no type, but the columns must not depend on the values.
  if (list.empty()) return name == "warnings";
  return list.front().is_string();
}

std::string joined(const Json& sentences) {
  std::string text;
  for (const Json& sentence : sentences) {
    if (!text.empty()) text += sentence_separator;
    text += sentence.get<std::string>();
  }
  return text;
}

std::string field_of(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return format_exact(value.get<double>());
  return value.dump();  // whole numbers, true and false
}

void flatten(const Json& value, const std::string& path, Columns& columns) {
  if (value.is_object()) {
    for (const auto& [name, member] : value.items()) {
      std::string deeper = path;
      if (!deeper.empty()) deeper += '.';
      deeper += name;
      flatten(member, deeper, columns);
    }
  } else if (!value.is_array()) {
    columns.add(path, field_of(value));
  } else if (holds_sentences(value, path)) {
    columns.add(path, joined(value));
  }
}

}  // namespace

Json told(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json json_of(const Vector3& vector) {
  return {{"x", vector.x()}, {"y", vector.y()}, {"z", vector.z()}};
}

Json json_of(const Statistics& statistics) {
  return {{"mean", statistics.mean},
          {"standard_deviation", statistics.standard_deviation},
          {"minimum", statistics.minimum},
          {"maximum", statistics.maximum}};
}

Json json_of(const MeshQuality& quality) {
  return {{"edge_length", json_of(quality.edge_length)},
          {"edge_variation", quality.edge_variation},
          {"edge_ratio", json_of(quality.edge_ratio)},
          {"smallest_angle_degrees", quality.smallest_angle},
          {"mean_smallest_angle_degrees", quality.mean_smallest_angle},
          {"valence_six_fraction", quality.valence_six_fraction}};
}

Json json_of(const OneSidedDistance& distance) {
  return {{"maximum", distance.maximum},
          {"root_mean_square", distance.root_mean_square},
          {"mean", distance.mean}};
}

Json json_of(const MassProperties& mass) {
  const Eigen::Matrix3d& tensor = mass.inertia_tensor;
  const Vector3& moments = mass.principal_moments;
  const Eigen::Quaterniond& axes = mass.principal_axes;
  return {{"volume", mass.volume},
          {"centroid", json_of(mass.centroid)},
          {"inertia_tensor",
           {{"xx", tensor(0, 0)},
            {"yy", tensor(1, 1)},
            {"zz", tensor(2, 2)},
            {"xy", tensor(0, 1)},
            {"xz", tensor(0, 2)},
            {"yz", tensor(1, 2)}}},
          {"principal_moments",
           {{"least", moments[0]}, {"middle", moments[1]}, {"greatest", moments[2]}}},
          {"principal_axes", {{"w", axes.w()}, {"x", axes.x()}, {"y", axes.y()}, {"z", axes.z()}}}};
}

Json json_of(const std::vector<DescriptorValue>& values) {
  Json table = Json::object();
  for (const DescriptorValue& row : values) table[row.key] = row.value;
  return table;
}

Json json_of(const std::vector<DescriptorComparison>& comparison, const ComparisonNames& names) {
  Json table = Json::object();
  for (const DescriptorComparison& row : comparison) {
    table[row.key] = {{names.reference, row.reference},
                      {names.value, row.value},
                      {"error_percent", row.error_percent}};
  }
  return table;
}

std::string json_document(const Json& report) {
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string csv_of(const Json& report) {
  Columns columns;
  flatten(report, "", columns);
  return csv_record(columns.names) + csv_record(columns.fields);
}

}  // namespace wscvt
