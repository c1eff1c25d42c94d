// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_parameters.h"

#include <cmath>
#include <string>

#include "wscvt/base/error.h"

namespace wscvt::filter {

namespace {

/// The weightings of both methods. Saved scripts store their indices, so the order never changes.
enum class AnyWeighting { Constant, RadialDistance, Curvature, Area };

/// The placements of both methods, in a fixed order too, and the default of the method.
enum class AnyPlacement { Series, Surface, Fitted, Contact, Default };

[[noreturn]] void refuse_value(const std::string& parameter, const std::string& value,
                               Method wanted) {
  refuse("Parameter " + parameter + " is " + value + ". Only the method \"" +
         capitalised(label_of(wanted)) +
         "\" has this value. Choose that method, or another value. Nothing was changed.");
}

}  // namespace

}  // namespace wscvt::filter

template <>
struct wscvt::EnumerationTable<wscvt::filter::AnyWeighting> {
  using Any = wscvt::filter::AnyWeighting;
  static constexpr Enumerator<Any> rows[] = {
      {Any::Constant, "constant", "constant (as published)", "equal solid angles"},
      {Any::RadialDistance, "wscvt-d", "WSCVT-D",
       "cells of equal area; as published smaller solid angles far from the centroid"},
      {Any::Curvature, "wscvt-c", "WSCVT-C (curvature)", "smaller cells where the surface bends"},
      {Any::Area, "area", "area (as published)", "equal surface areas"},
  };
};

template <>
struct wscvt::EnumerationTable<wscvt::filter::AnyPlacement> {
  using Any = wscvt::filter::AnyPlacement;
  static constexpr Enumerator<Any> rows[] = {
      {Any::Series, "sh-surface", "SH surface (as published)", "on the spherical-harmonic surface"},
      {Any::Surface, "on-surface", "on the surface", "exactly on the grain's surface"},
      {Any::Fitted, "fitted", "fitted (on the scan, volume exact)",
       "near the grain's surface, so that the triangles are closest to it and enclose exactly its "
       "volume"},
      {Any::Contact, "contact-fit", "contact fit (on the scan)",
       "near the grain's surface, for contact laws that use the deepest node"},
      {Any::Default, "default", "default of the method", "fitted, or the SH surface"},
  };
};

namespace wscvt::filter {

namespace {

OnScanOptions on_scan_options(const CheckedValues& values, bool on_surface) {
  OnScanOptions options;
  if (on_surface) options.placement = ScanPlacement::OnSurface;
  options.curvature_alpha = values.real("CurvatureAlpha");
  options.edge_ratio = values.real("EdgeRatio");
  switch (values.choice<AnyWeighting>("Weighting")) {
    case AnyWeighting::Constant:
      refuse_value("Weighting", "constant", Method::AsPublished);
    case AnyWeighting::Area:
      refuse_value("Weighting", "area", Method::AsPublished);
    case AnyWeighting::Curvature:
      options.weighting = CellWeighting::Curvature;
      break;
    case AnyWeighting::RadialDistance:
      break;
  }
  switch (values.choice<AnyPlacement>("Placement")) {
    case AnyPlacement::Series:
      refuse_value("Placement", "SH surface", Method::AsPublished);
    case AnyPlacement::Surface:
      options.placement = ScanPlacement::OnSurface;
      break;
    case AnyPlacement::Fitted:
      options.placement = ScanPlacement::Fitted;
      break;
    case AnyPlacement::Contact:
      options.placement = ScanPlacement::ContactFit;
      break;
    case AnyPlacement::Default:
      break;
  }
  return options;
}

AsPublishedOptions as_published_options(const CheckedValues& values) {
  AsPublishedOptions options;
  options.curvature_alpha = values.real("CurvatureAlpha");
  switch (values.choice<AnyWeighting>("Weighting")) {
    case AnyWeighting::Constant:
      options.weighting = Weighting::Constant;
      break;
    case AnyWeighting::Area:
      options.weighting = Weighting::Area;
      break;
    case AnyWeighting::Curvature:
      options.weighting = Weighting::Curvature;
      break;
    case AnyWeighting::RadialDistance:
      break;
  }
  switch (values.choice<AnyPlacement>("Placement")) {
    case AnyPlacement::Surface:
      options.placement = PublishedPlacement::Surface;
      break;
    case AnyPlacement::Fitted:
      refuse_value("Placement", "fitted", Method::OnScan);
    case AnyPlacement::Contact:
      refuse_value("Placement", "contact fit", Method::OnScan);
    case AnyPlacement::Series:
    case AnyPlacement::Default:
      break;
  }
  if (values.real("EdgeRatio") != OnScanOptions().edge_ratio) {
    refuse_value("EdgeRatio", typed_text(values.real("EdgeRatio")), Method::OnScan);
  }
  return options;
}

}  // namespace

FilterParameter node_count_parameter() {
  FilterParameter parameter = option_parameter(
      "NodeCount", RemeshOptions().node_count, node_count_option, "Number of nodes",
      "Exact number of vertices of the result. Nodes on the surface lose about 660/N % of the "
      "volume, fitted nodes 0 %.");
  parameter.required = true;
  return parameter;
}

FilterParameter method_parameter() {
  return table_parameter("Method", Method::OnScan, "Method",
                         "Where the Voronoi cells are, and which surface the nodes follow.");
}

FilterParameter weighting_parameter() {
  return table_parameter("Weighting", AnyWeighting::RadialDistance, "Weighting",
                         "Sets the size of each node's Voronoi cell. Small cells mean closely "
                         "spaced nodes.");
}

FilterParameter curvature_alpha_parameter() {
  return option_parameter("CurvatureAlpha", OnScanOptions().curvature_alpha, curvature_alpha_option,
                          "WSCVT-C strength alpha",
                          "0 ignores curvature. Larger values put more nodes at edges and corners, "
                          "negative values fewer.");
}

FilterParameter placement_parameter() {
  return table_parameter("Placement", AnyPlacement::Default, "Node placement",
                         "Where the nodes are put. Only fitted nodes enclose exactly the scan's "
                         "volume.");
}

FilterParameter edge_ratio_parameter() {
  return option_parameter("EdgeRatio", OnScanOptions().edge_ratio, edge_ratio_option,
                          "Mean edge ratio (on the scan)",
                          "Wanted mean of longest / shortest edge of a triangle. Small values give "
                          "even triangles, large values a smaller distance to the scan.");
}

FilterParameter colour_by_quality_parameter() {
  return flag_parameter(
      "ColorByQuality", false, "Color by quality",
      "Colors the vertices by quality: red lowest, green, blue highest. The distance "
      "to the scan: red outside of it, white 0, blue inside.");
}

RemeshOptions read_node_options(const CheckedValues& values, bool on_surface) {
  RemeshOptions options;
  options.node_count = values.whole("NodeCount");
  if (values.choice<Method>("Method") == Method::OnScan) {
    options.method = on_scan_options(values, on_surface);
  } else {
    options.method = as_published_options(values);
  }
  return options;
}

void request_quality(RemeshOptions& options, VertexQuality quality) {
  if (quality == VertexQuality::Curvature) options.measures.node_curvatures = true;
  if (quality == VertexQuality::OriginalDistance) options.measures.distances = true;
}

std::vector<double> quality_values(const RemeshResult& result, VertexQuality quality) {
  switch (quality) {
    case VertexQuality::Curvature:
      return result.curvatures;
    case VertexQuality::CellArea:
      return result.cell_areas;
    case VertexQuality::OriginalDistance: {
      const double least = 1e-9 * result.input.equivalent_radius;
      std::vector<double> distances = result.vertex_distances;
      for (double& distance : distances) {
        if (std::abs(distance) < least) distance = 0.0;
      }
      return distances;
    }
    case VertexQuality::RadialDistance:
      break;
  }
  return result.radial_distances;
}

std::string nodes_name(const RemeshOptions& options) {
  return std::visit([](const auto& method) { return short_label(label_of(method.weighting)); },
                    options.method);
}

std::vector<std::string> all_nodes_names() {
  std::vector<std::string> names;
  for (const auto& row : enumerators<CellWeighting>()) names.push_back(short_label(row.label));
  for (const auto& row : enumerators<Weighting>()) names.push_back(short_label(row.label));
  return names;
}

}  // namespace wscvt::filter
