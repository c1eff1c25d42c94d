// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "wscvt/base/option.h"
#include "wscvt/tessellation/tessellation_options.h"

namespace wscvt {

// Number of nodes, by the error of the mesh.

/// Error measure of a remesh, in % of the scan's value.
enum class ErrorMeasure {
  Volume,      ///< of the volume
  Area,        ///< of the area
  Sphericity,  ///< of Wadell's sphericity
  Inertia,     ///< inertia_error_percent
  Distance,    ///< two-sided rms distance, in % of the equivalent radius
};

template <>
struct EnumerationTable<ErrorMeasure> {
  static constexpr std::string_view key = "error-measure";
  static constexpr std::string_view subject = "error measure";
  static constexpr Enumerator<ErrorMeasure> rows[] = {
      {ErrorMeasure::Volume, "volume", "volume", "volume, in % of the scan's"},
      {ErrorMeasure::Area, "area", "area", "area, in % of the scan's"},
      {ErrorMeasure::Sphericity, "sphericity", "sphericity",
       "sphericity of Wadell, in % of the scan's"},
      {ErrorMeasure::Inertia, "inertia", "inertia", "inertia tensor, in % of the scan's"},
      {ErrorMeasure::Distance, "distance", "RMS distance",
       "two-sided rms distance, in % of the equivalent radius"},
  };
};

/// Search for an N near the smallest with at most this error (see smallest_node_count).
struct ErrorTarget {
  ErrorMeasure measure = ErrorMeasure::Distance;
  double percent = 0.0;            ///< 0 to 100; 0: no search, N is RemeshOptions::node_count
  int largest_node_count = 20000;  ///< largest N of the search; 4 to 1000000
};

inline constexpr NumberOption<double> error_target_option = {
    "max-error", "allowed error in %",
    0.0,         100.0,
    Ends::Both,  "search for few nodes with at most this error; 0: no search"};
/// One number of nodes that was tried.
struct NodeCountTrial {
  int node_count = 0;
  double error = 0.0;  ///< >= 0, any unit
};

/// Report of a search.
struct NodeCountSearch {
  bool met = false;  ///< a tried count has at most the allowed error
  int node_count =
      0;  ///< smallest count found with at most the allowed error; else the largest count allowed
  std::vector<NodeCountTrial> trials;  ///< in the order made
};

}  // namespace wscvt
