// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "log_text.h"
#include "parameters.h"
#include "wscvt/base/execution.h"
#include "wscvt/measures/detailed_descriptors.h"
#include "wscvt/measures/distances.h"
#include "wscvt/scan/mesh_check.h"

namespace wscvt::filter {

/// The menu text. Saved scripts refer to it: it never changes.
std::string descriptor_name();

std::string descriptor_help();

ParameterList descriptor_parameters();

struct DescriptorSettings {
  std::string reference_layer;  ///< label; empty: none
  DetailedOptions options;
  std::string report_file;  ///< empty: none
};

/// Throws Error(InvalidInput) for values that do not fit and file names with other extensions.
DescriptorSettings read_descriptor_settings(const ParameterValues& values);

/// A layer as the document shows it: its transform applied.
struct NamedMesh {
  std::string name;
  IndexedMesh mesh;
};

struct MeasuredMesh {
  std::string name;
  CheckedMesh checked;
  DetailedDescriptors descriptors;
};

struct DescriptorResult {
  MeasuredMesh mesh;
  std::optional<MeasuredMesh> reference;
  std::optional<MeshDistances> distances;  ///< between the two; length
};

/// Throws Error as check_mesh and describe_shape_in_detail do, with the layer's name in the
/// sentence; Error(Cancelled) without it.
DescriptorResult measure_grains(NamedMesh mesh, std::optional<NamedMesh> reference,
                                const DetailedOptions& options, const Execution& execution);

/// As log_lines of the remesher.
std::vector<LogLine> descriptor_lines(const DescriptorResult& result, double seconds);

/// Writes the report in the format of the file's extension; nothing for an empty name. Throws
/// Error(InputOutput) when the file cannot be written, Error(InvalidInput) for an extension other
/// than .html, .json or .csv, and for an HTML report when there is no QApplication to draw with.
void write_report(const DescriptorResult& result, const std::string& path);

}  // namespace wscvt::filter
