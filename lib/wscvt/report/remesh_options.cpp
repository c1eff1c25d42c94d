// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_options.h"

#include "wscvt/base/error.h"
#include "wscvt/tessellation/seeding.h"

namespace wscvt {

namespace {

/// Every option by itself, also of stages that this remesh does not reach.
struct CheckOption {
  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) const {
    require_in_range(value, option);
  }
  void operator()(const bool& /*value*/, const FlagOption& /*option*/) const {}
  template <class Enumeration>
  void operator()(const Enumeration& value) const {
    require_valid(value);
  }
};

}  // namespace

RemeshOptions with_method(RemeshOptions options) {
  if (options.method != Method::AsPublished) return options;
  constexpr int published_degree = 20;
  options.surface.parametrization = Parametrization::Radial;
  if (options.surface.degree == automatic_degree) options.surface.degree = published_degree;
  options.relaxation.metric = RelaxationMetric::Sphere;
  options.placement.kind = NodePlacement::Series;
  options.placement.refinement.rounds = 0;
  return options;
}

void check_options(const RemeshOptions& options) {
  CheckOption check;
  for_each_option(options, check);
  check_relaxation_options(options.relaxation);
  check_placement_options(options.placement);
  check_envelope_options(options.envelope);
  if (options.target.percent > 0.0 && !takes_any_count(options.seeding.sampling)) {
    throw Error(ErrorCode::InvalidInput,
                "An error target needs a sampling with any number of nodes; take the weighted one "
                "or the Fibonacci lattice, or set the target to 0.");
  }
}

}  // namespace wscvt
