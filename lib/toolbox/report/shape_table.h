// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toolbox/clump/first_contact.h"
#include "toolbox/sample/grain_table.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/voxel_resolution.h"
#include "wscvt/remesh/remesh_result.h"

namespace wscvt {

/// The meshes of a grain whose shape is measured.
enum class Described { Both, Scan, Remesh, None, Contacts };

template <>
struct EnumerationTable<Described> {
  static constexpr std::string_view key = "describe";
  static constexpr std::string_view subject = "described meshes";
  static constexpr Enumerator<Described> rows[] = {
      {Described::Both, "both", "scan and remesh", "all descriptors of scan and remesh"},
      {Described::Scan, "scan", "scan", "all descriptors of the scan"},
      {Described::Remesh, "remesh", "remesh", "all descriptors of the remesh"},
      {Described::None, "none", "none", "no table of shapes; saves time"},
      {Described::Contacts, "contacts", "first contact",
       "as both, and the error of first contact: two remeshes against two scans, over random pairs "
       "of poses"},
  };
};

inline bool describes_scan(Described what) {
  return what == Described::Both || what == Described::Scan || what == Described::Contacts;
}
inline bool describes_remesh(Described what) {
  return what == Described::Both || what == Described::Remesh || what == Described::Contacts;
}

/// The measures of a table of shapes, which decide its columns.
struct ShapeMeasures {
  Described described = Described::Both;
  bool contacts = false;  ///< first contact of the remesh against the scan's, see ScanContacts
  /// What the voxels did to the scan's descriptors; only if scans are described.
  bool resolution = false;
};

/// The measures of a grain, empty if not requested.
struct GrainShape {
  std::optional<DetailedDescriptors> scan;
  std::optional<DetailedDescriptors> remesh;
  std::optional<ScanContacts::Errors> contacts;
  std::optional<Resolution> resolution;  ///< of the scan; without rows if its voxels are not known
};

// The table of shapes of a sample: CSV (RFC 4180) with one row per grain, for read_grain_table. Its
// columns are "grain", "status" and "error" as in the sample's table; "file", the remesh's file
// name; "nodes"; "rms_distance [length]" two-sided; if contacts are measured,
// "contact_error_mean [%]" and "contact_error_scatter [%]" of the equivalent radius, see
// ContactError, and for two remeshes and, with the suffix "_one_sided", for the remesh against the
// scan "contact_gap_median [%]", "contact_place_median [%]", "contact_normal_median [degrees]" and
// the same with "_90", see TouchErrors. Then, with the prefix "scan." or "remesh." for each
// described mesh: the keys of list_descriptors, the principal frame (centroid, principal moments at
// unit density, unit quaternion) and the quality of the mesh. If the size of the scans' voxels is
// known, also "resolution.voxel_size [length]", "resolution.voxels_across", and for each descriptor
// KEY of the scan "resolution.KEY.corrected", ".low" and ".high", empty if it is not resolved.

/// Returns the first record.
std::string shape_header(const ShapeMeasures& measures);

/// Describes the result's meshes. The scan is measured only if the result contains the repaired
/// scan. Throws the errors of describe_shape_in_detail.
GrainShape describe_result(const RemeshResult& result, Described what, const Execution& execution);

/// Returns the record of a grain whose remesh is in `file`.
std::string shape_row(const std::string& grain, const std::string& file, const RemeshResult& result,
                      const GrainShape& shape);

/// Returns the record of a grain without a remesh or without descriptors.
std::string failed_shape_row(const std::string& grain, const std::string& error,
                             const ShapeMeasures& measures);

/// Returns sentences for a log about the voxels of a sample, from its table of shapes with the
/// columns of the resolution: how many voxels across the grains are, what the voxels did to the
/// main descriptors, and whether there are more nodes than the voxels resolve. Empty if the size of
/// no grain's voxels is known.
std::vector<std::string> voxel_lines(const GrainTable& shapes);

}  // namespace wscvt
