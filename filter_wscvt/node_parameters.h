// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "parameters.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

// Parameters of the filters that make a mesh of N nodes.

FilterParameter node_count_parameter();
FilterParameter method_parameter();
FilterParameter weighting_parameter();
FilterParameter curvature_alpha_parameter();
FilterParameter placement_parameter();
FilterParameter edge_ratio_parameter();
FilterParameter colour_by_quality_parameter();

/// Reads all of the above except the last. Throws Error, with the method's name, for a value that
/// only the other method has. `on_surface`: whether the default placement of the method on the scan
/// is on the surface.
RemeshOptions read_node_options(const CheckedValues& values, bool on_surface);

/// Values of the result's vertex quality.
enum class VertexQuality {
  RadialDistance,    ///< from the centroid, length
  Curvature,         ///< largest absolute principal curvature, 1/length
  CellArea,          ///< surface area of the node's cell, length^2
  OriginalDistance,  ///< from the scan to the node, positive outside; length
};

}  // namespace wscvt::filter

template <>
struct wscvt::EnumerationTable<wscvt::filter::VertexQuality> {
  using Quality = wscvt::filter::VertexQuality;
  static constexpr std::string_view key = "quality";
  static constexpr std::string_view subject = "vertex quality";
  static constexpr Enumerator<Quality> rows[] = {
      {Quality::RadialDistance, "radial-distance", "radial distance",
       "from the centroid, in units of the mesh"},
      {Quality::Curvature, "curvature", "curvature",
       "the largest absolute principal curvature, 1/unit"},
      {Quality::CellArea, "cell-area", "cell area", "surface area of the node's cell, unit^2"},
      {Quality::OriginalDistance, "scan-distance", "distance to the scan",
       "from its surface to each node, positive outside, in units of the mesh"},
  };
};

namespace wscvt::filter {

/// Requests the results that a vertex quality needs.
void request_quality(RemeshOptions& options, VertexQuality quality);

/// Returns the chosen quality, one value per vertex of the result. Distances to the scan below 1e-9
/// of the equivalent radius are 0: the node is on the scan. The host's coordinates have single
/// precision, 1e-7 of their size, and what is smaller by a hundred is rounding.
std::vector<double> quality_values(const RemeshResult& result, VertexQuality quality);

/// Short name of the node distribution, for labels: Constant, WSCVT-D, Fibonacci lattice, ...
std::string nodes_name(const RemeshOptions& options);

/// All values of nodes_name.
std::vector<std::string> all_nodes_names();

/// Settings of a filter for its mesh of N nodes.
struct ResultSettings {
  VertexQuality quality = VertexQuality::RadialDistance;
  bool colour_by_quality = false;
  std::string report_file;  ///< empty: none
};

}  // namespace wscvt::filter
