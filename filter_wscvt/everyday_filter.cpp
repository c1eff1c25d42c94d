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
  // MeshLab's search finds a filter by the words of its name and of this text.
  return "Remeshes the scan of a sand or rock grain (a particle) for DEM to <b>exactly the number "
         "of nodes asked for</b>, with even triangles (isotropic CVT, WSCVT) and the same volume. "
         "Use it to simplify, decimate or resample. Set the number of nodes. The other defaults "
         "suit most grains. More parameters: Weighted Spherical Centroidal Voronoi";
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
