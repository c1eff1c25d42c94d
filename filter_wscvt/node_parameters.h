// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "parameters.h"
#include "wscvt/remesh.h"

namespace wscvt::filter {

// The parameters of the filters that give a mesh of N nodes.

FilterParameter node_count_parameter();
FilterParameter method_parameter(Method default_method);
FilterParameter weighting_parameter();
FilterParameter curvature_alpha_parameter();
FilterParameter placement_parameter();
FilterParameter edge_ratio_parameter();
FilterParameter colour_by_quality_parameter();

/// Reads all of the above but the last. A value that only the other method has is refused, with its
/// method's name; `on_surface` says whether nodes on the scan lie on the surface by default.
RemeshOptions read_node_options(const CheckedValues& values, bool on_surface);

/// What the result's vertex quality holds.
enum class VertexQuality {
  RadialDistance,    ///< from the centroid, length
  Curvature,         ///< largest absolute principal curvature, 1/length
  CellArea,          ///< surface area of the node's cell, length^2
  OriginalDistance,  ///< from the node to the original, length
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
       "from each node to its surface, in units of the mesh"},
  };
};

namespace wscvt::filter {

/// Asks for what a vertex quality needs.
void request_quality(RemeshOptions& options, VertexQuality quality);

/// Values of the chosen quality, one a vertex of the result.
const std::vector<double>& quality_values(const RemeshResult& result, VertexQuality quality);

/// How the nodes were chosen, short, for labels: Constant, WSCVT-D, Fibonacci lattice, ...
std::string nodes_name(const RemeshOptions& options);

/// All that nodes_name gives.
std::vector<std::string> all_nodes_names();

/// What a filter does with a mesh of N nodes.
struct ResultSettings {
  VertexQuality quality = VertexQuality::RadialDistance;
  bool colour_by_quality = false;
  std::string report_file;  ///< empty: none
};

}  // namespace wscvt::filter
