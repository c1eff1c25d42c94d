// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/clump/clump_options.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/remesh/remesh_options.h"

// Reports as trees of values, from which their files are written. Not one of the library's public
// headers: those need no JSON library.
namespace wscvt {

/// Members keep the order in which they were added. Numbers that are not finite become null.
using Json = nlohmann::ordered_json;

/// A text, or null for one that is empty.
Json told(const std::string& text);

Json json_of(const Vector3& vector);
Json json_of(const Statistics& statistics);
Json json_of(const MeshQuality& quality);
Json json_of(const OneSidedDistance& distance);
Json json_of(const MassProperties& mass);

/// Every option under the name and with the value that one types for the program.
Json json_of(const RemeshOptions& options);
Json json_of(const ClumpOptions& options);

/// The value of each descriptor under its key.
Json json_of(const std::vector<DescriptorValue>& values);

/// The two values of each descriptor, named as in `names`, and their error_percent, under its key.
Json json_of(const std::vector<DescriptorComparison>& comparison, const ComparisonNames& names);

/// What the descriptors' keys stand for: a list of key, label and unit.
template <class Row>
Json json_names_of(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) {
    list.push_back({{"key", row.key}, {"label", row.label}, {"unit", row.unit}});
  }
  return list;
}

/// A document: UTF-8, indented by two, a line end at its end. Bytes that are not UTF-8 are
/// replaced.
std::string json_document(const Json& report);

/// A report as CSV after RFC 4180, a header and a row. Every member that is not in a list is a
/// column, named by the path to it, joined with dots; null is an empty field. A list of sentences
/// is one field, other lists are left out. Numbers read back to the same bits.
std::string csv_of(const Json& report);

}  // namespace wscvt
