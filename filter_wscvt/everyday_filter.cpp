// SPDX-License-Identifier: GPL-3.0-or-later
#include "everyday_filter.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "remesh_filter.h"

namespace wscvt::filter {

namespace {

const std::vector<std::string> everyday_names = {"NodeCount",      "Method",    "Weighting",
                                                 "EdgeRatio",      "Distances", "Quality",
                                                 "ColorByQuality", "ReportFile"};

}  // namespace

std::string everyday_name() { return "Remeshing: Grain to a Number of Nodes"; }

std::string everyday_help() {
  return "Turns the scan of a grain into a closed mesh of <b>exactly the number of nodes asked "
         "for</b> and of even triangles, as a new layer. Set the number; the other defaults suit "
         "most grains. For contact laws that sum over nodes by area, or use the deepest node, see "
         "Node placement in the filter with all parameters: Weighted Spherical Centroidal Voronoi";
}

ParameterList everyday_parameters() {
  const ParameterList all = remesh_parameters();
  ParameterList parameters;
  for (const std::string& name : everyday_names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const FilterParameter& parameter) {
      return parameter.name == name;
    });
    if (found == all.end()) throw std::logic_error("The remesher has no parameter " + name);
    parameters.push_back(*found);
  }
  return parameters;
}

ParameterList with_advanced_flags(ParameterList parameters) {
  for (FilterParameter& parameter : parameters) {
    parameter.advanced = std::find(everyday_names.begin(), everyday_names.end(), parameter.name) ==
                         everyday_names.end();
  }
  return parameters;
}

}  // namespace wscvt::filter
