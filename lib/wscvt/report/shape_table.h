// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "wscvt/base/option.h"
#include "wscvt/clump/first_contact.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// The meshes of a grain whose shape is measured.
enum class Described { Both, Scan, Remesh, None };

template <>
struct EnumerationTable<Described> {
  static constexpr std::string_view key = "describe";
  static constexpr std::string_view subject = "table of shapes";
  static constexpr Enumerator<Described> rows[] = {
      {Described::Both, "both", "scan and remesh", "all descriptors of scan and remesh"},
      {Described::Scan, "scan", "scan", "all descriptors of the scan"},
      {Described::Remesh, "remesh", "remesh", "all descriptors of the remesh"},
      {Described::None, "none", "none", "no table of shapes, which saves time"},
  };
};

inline bool describes_scan(Described what) {
  return what == Described::Both || what == Described::Scan;
}
inline bool describes_remesh(Described what) {
  return what == Described::Both || what == Described::Remesh;
}

/// The measures of a table of shapes, which decide its columns.
struct ShapeMeasures {
  Described described = Described::Both;
  bool contacts = false;  ///< first contact of the remesh against the scan's, see ScanContacts
};

/// The measures of a grain, those that were taken.
struct GrainShape {
  std::optional<DetailedDescriptors> scan;
  std::optional<DetailedDescriptors> remesh;
  std::optional<ContactError> contacts;
};

// The table of shapes of a sample: CSV after RFC 4180 with a row per grain, which read_grain_table
// takes. Its columns are "grain", "status" and "error" as in the sample's table; "file", the
// remesh's file name; "nodes"; "rms_distance [length]" from scan to remesh; if contacts are
// measured, "contact_error_mean [%]" and "contact_error_scatter [%]" of the equivalent radius, see
// ContactError. Then for "scan." and "remesh.", whichever are described, the keys of
// list_descriptors, the principal frame (centroid, principal moments at unit density, unit
// quaternion) and the quality of the mesh.

/// Whether a file begins as a table of shapes does. False if it cannot be read.
bool is_shape_table(const std::string& path);

/// The first record.
std::string shape_header(const ShapeMeasures& measures);

/// Describes the result's meshes. A scan is measured only if the result holds its repaired scan.
/// Throws Error as describe_shape_in_detail does.
GrainShape describe_result(const RemeshResult& result, Described what, const Execution& execution);

/// The record of a grain that was remeshed to the file.
std::string shape_row(const std::string& grain, const std::string& file, const RemeshResult& result,
                      const GrainShape& shape);

/// The record of a grain without a remesh, or without descriptors.
std::string failed_shape_row(const std::string& grain, const std::string& error,
                             const ShapeMeasures& measures);

}  // namespace wscvt
