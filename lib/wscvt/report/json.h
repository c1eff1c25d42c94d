// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/remesh/remesh_options.h"

// Reports as trees of values; the report files are written from them. This header is not public:
// public headers need no JSON library.
namespace wscvt {

/// Members keep the order in which they were added. Numbers that are not finite become null.
using Json = nlohmann::ordered_json;

/// Between the sentences of a list in a field of a table.
constexpr std::string_view sentence_separator = " | ";

/// Returns a text, or null if it is empty.
Json told(const std::string& text);

Json json_of(const Vector3& vector);
Json json_of(const Statistics& statistics);
Json json_of(const MeshQuality& quality);
Json json_of(const OneSidedDistance& distance);
Json json_of(const MassProperties& mass);

/// Options with their command-line names and values, for the functions that visit options.
/// Integers stay integers.
class OptionsJson {
 public:
  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) {
    options_[std::string(option.key)] = value;
  }
  void operator()(const bool& value, const FlagOption& option) {
    options_[std::string(option.key)] = value;
  }
  /// The usual treatment is no option of the program.
  void operator()(const HandleAction& value) {
    if (value == HandleAction::Cut) {
      options_[std::string(EnumerationTable<HandleAction>::key)] = nullptr;
    } else {
      operator()<HandleAction>(value);
    }
  }
  template <class Enumeration>
  void operator()(const Enumeration& value) {
    options_[std::string(EnumerationTable<Enumeration>::key)] = key_of(value);
  }
  Json take() { return std::move(options_); }

 private:
  Json options_ = Json::object();
};

/// Every option with the name and value of the command line, see as_given. Options of the other
/// method, and HandleAction::Cut, are null.
Json json_of(const RemeshOptions& options);

/// Returns the value of each descriptor under its key.
Json json_of(const std::vector<DescriptorValue>& values);

/// Returns both values of each descriptor, named as in `names`, and error_percent, under its key.
Json json_of(const std::vector<DescriptorComparison>& comparison, const ComparisonNames& names);

/// Explains the descriptors' keys: a list of key, label and unit.
template <class Row>
Json json_names_of(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) {
    list.push_back({{"key", row.key}, {"label", row.label}, {"unit", row.unit}});
  }
  return list;
}

/// Writes a document: UTF-8, two-space indent, a final line end. Replaces bytes that are not UTF-8.
std::string json_document(const Json& report);

/// Returns a report as CSV (RFC 4180) with a header and a row. Every member outside of lists is a
/// column, named by its path, joined with dots. null is an empty field. A list of sentences is one
/// field; other lists are omitted. Numbers read back to the same bits.
std::string csv_of(const Json& report);

}  // namespace wscvt
