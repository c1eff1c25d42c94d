// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/contact_samplings.h"

namespace wscvt::study {

namespace {

RemeshOptions options_of(Weighting weighting, NodePlacement placement) {
  RemeshOptions options;
  options.measures.advice = false;
  options.surface.parametrization = Parametrization::Radial;
  options.weighting.kind = weighting;
  options.placement.kind = placement;
  // Nodes on the scan are those of the paper, whose cells are on the sphere.
  if (placement == NodePlacement::Scan) options.relaxation.metric = RelaxationMetric::Sphere;
  return options;
}

}  // namespace

std::vector<ContactSampling> contact_samplings() {
  RemeshOptions fibonacci = options_of(Weighting::Constant, NodePlacement::Scan);
  fibonacci.seeding.sampling = Sampling::Fibonacci;
  RemeshOptions random = options_of(Weighting::Constant, NodePlacement::Scan);
  random.seeding.start = SeedStart::Random;
  random.relaxation.maximum_iterations = 0;
  RemeshOptions refined = options_of(Weighting::ErrorAdaptive, NodePlacement::LeastSquares);
  refined.placement.refinement.rounds = 60;
  const auto contact = [](double ball_radius) {
    RemeshOptions options = options_of(Weighting::ErrorAdaptive, NodePlacement::Contact);
    options.placement.contact_radius = ball_radius;
    return options;
  };
  return {{"WSCVT-D", options_of(Weighting::RadialDistance, NodePlacement::Scan)},
          {"WSCVT-C", options_of(Weighting::Curvature, NodePlacement::Scan)},
          {"constant", options_of(Weighting::Constant, NodePlacement::Scan)},
          {"Fibonacci", fibonacci},
          {"random", random},
          {"least squares", options_of(Weighting::RadialDistance, NodePlacement::LeastSquares)},
          {"refined", refined},
          {"contact 0.4", contact(0.4)},
          {"contact 1.3", contact(1.3)},
          {"contact 5", contact(5.0)}};
}

}  // namespace wscvt::study
