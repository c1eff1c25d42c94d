// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_options.h"

#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

void require(bool fits, const std::string& what, const std::string& value,
             const std::string& range) {
  if (!fits) {
    throw Error(ErrorCode::InvalidInput, what + " is " + value + "; give " + range + ".");
  }
}

template <class Enumeration>
void require_enumerator(Enumeration value, Enumeration last, const std::string& what) {
  const int number = static_cast<int>(value);
  require(number >= 0 && number <= static_cast<int>(last), what, "number " + std::to_string(number),
          "a number from 0 to " + std::to_string(static_cast<int>(last)));
}

void check_target(const ErrorTarget& target, Sampling sampling) {
  require_enumerator(target.measure, ErrorMeasure::Distance, "The measure of the error target");
  require(target.percent >= 0.0 && std::isfinite(target.percent), "The error target",
          format_number(target.percent), "a positive number of per cent, or 0 for none");
  require(target.largest_node_count >= 4 && target.largest_node_count <= maximum_node_count,
          "The largest number of nodes to try", std::to_string(target.largest_node_count),
          "a whole number from 4 to " + std::to_string(maximum_node_count));
  if (target.percent > 0.0 && !takes_any_count(sampling)) {
    throw Error(ErrorCode::InvalidInput,
                "An error target needs a sampling with any number of nodes; take the weighted one "
                "or the Fibonacci lattice, or set the target to 0.");
  }
}

}  // namespace

void check_options(const RemeshOptions& options) {
  require(options.node_count >= 4 && options.node_count <= maximum_node_count,
          "The number of nodes", std::to_string(options.node_count),
          "a whole number from 4 to " + std::to_string(maximum_node_count));
  check_surface_options(options.surface);
  check_weighting_options(options.weighting);
  require_enumerator(options.seeding.sampling, Sampling::Icosahedron, "The sampling");
  require_enumerator(options.weighting.kind, Weighting::ErrorAdaptive, "The weighting");
  require_enumerator(options.weighting.curvature_source, CurvatureSource::QuadricFit,
                     "The curvature source");
  require_enumerator(options.placement.kind, NodePlacement::LeastSquares,
                     "The placement of the nodes");
  require_enumerator(options.seeding.start, SeedStart::Random, "The start of the seeds");
  check_multilevel_options(options.levels);
  check_relaxation_options(options.relaxation);
  check_target(options.target, options.seeding.sampling);
  check_distance_options(options.measures.distance_sampling);
  check_placement_options(options.placement);
  require_enumerator(options.relaxation.metric, RelaxationMetric::Surface,
                     "The metric of the relaxation");
}

}  // namespace wscvt
