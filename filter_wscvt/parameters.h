// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "wscvt/remesh.h"

namespace wscvt::filter {

/// The filter's menu text. Saved scripts refer to it: it never changes.
std::string filter_name();

/// What the filter does, when it refuses and whose method it is, as the HTML a host shows.
std::string filter_help();

/// What a parameter holds.
enum class ParameterKind {
  Integer,  ///< a whole number
  Real,     ///< a decimal number
  Choice,   ///< an index into `choices`
  Flag,     ///< 0 or 1
};

/// One parameter of the filter, free of any host's types.
struct FilterParameter {
  std::string name;  ///< saved in scripts: never changes
  ParameterKind kind = ParameterKind::Integer;
  double default_value = 0.0;
  double minimum = 0.0;              ///< smallest value accepted
  double maximum = 0.0;              ///< largest value accepted
  std::vector<std::string> choices;  ///< of a Choice, in the order of their index
  std::string label;
  std::string tooltip;
};

/// The parameters in the order in which a dialog shows them.
std::vector<FilterParameter> filter_parameters();

/// What the result's vertex quality holds.
enum class VertexQuality {
  RadialDistance,  ///< from the centroid, length
  Curvature,       ///< largest absolute principal curvature, 1/length
  CellArea,        ///< surface area of the node's power cell, length^2
};

/// Everything the user chose.
struct FilterSettings {
  RemeshOptions options;
  bool new_layer = true;
  VertexQuality quality = VertexQuality::RadialDistance;
  bool colour_by_quality = false;
};

/// Parameter values by name; enumerations as index, flags as 0 or 1.
using ParameterValues = std::map<std::string, double>;

/// Reads the settings; a name that is missing takes its default. Scripts check nothing, so every
/// value is checked here. Throws Error(InvalidInput) for a value that is not finite, out of range
/// or, except for a Real, not whole.
FilterSettings read_settings(const ParameterValues& values);

/// The decimal number a user typed, given the float a host made of it: 0.1, not 0.100000001.
double typed_value(float value);

/// Short name of a weighting for labels: Constant, WSCVT-D, WSCVT-C, Area.
std::string weighting_name(Weighting weighting);

/// Values of the chosen quality, one a vertex of the result.
const std::vector<double>& quality_values(const RemeshResult& result, VertexQuality quality);

}  // namespace wscvt::filter
