// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/remesh_warnings.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/test_shapes.h"

namespace wscvt {
namespace {

/// A result that there is nothing to say of.
RemeshResult clean() {
  RemeshResult result;
  result.mesh = test::sphere(1);
  result.options.node_count = static_cast<int>(result.mesh.points.size());
  result.input.input_vertices = 100;
  result.input.input_faces = 196;
  result.input.components = 1;
  result.input.equivalent_radius = 2.0;
  result.original.area = 10.0;
  result.remesh.area = 10.0;
  result.relaxation.outcome = RelaxationOutcome::Converged;
  result.relaxation.iterations = 7;
  result.relaxation.history = {{1e-4, 0.125, 0}};
  result.quality.smallest_angle = 40.0;
  return result;
}

/// A result with one fault more, and what is said of it.
struct Case {
  std::function<void(RemeshResult&)> change;
  std::vector<std::string> parts;  ///< of the one warning; none: there is no warning
};

void expect_warnings(const std::vector<Case>& cases) {
  for (std::size_t k = 0; k < cases.size(); ++k) {
    RemeshResult result = clean();
    cases[k].change(result);
    const std::vector<std::string> warnings = remesh_warnings(result, RemeshOptions());
    ASSERT_EQ(warnings.size(), cases[k].parts.empty() ? 0U : 1U)
        << k << ": " << (warnings.empty() ? "" : warnings.front());
    for (const std::string& part : cases[k].parts) {
      EXPECT_NE(warnings.front().find(part), std::string::npos)
          << k << ": \"" << part << "\" in: " << warnings.front();
    }
  }
}

TEST(RemeshWarnings, ThereAreNoneOfACleanResult) {
  EXPECT_TRUE(remesh_warnings(clean(), clean().options).empty());
  const auto warnings = remesh_warnings(clean(), clean().options, "Far away.");
  EXPECT_EQ(warnings, std::vector<std::string>{"Far away."});
}

TEST(RemeshWarnings, NameWhatIsWrongWithTheScan) {
  const auto points = [](RemeshResult& r, double steep) {
    r.options.points = true;
    r.steep_share = steep;
  };
  // Of points that lie behind each other there are two.
  RemeshResult folded = clean();
  points(folded, 0.061);
  EXPECT_EQ(remesh_warnings(folded, RemeshOptions()).size(), 2U);
  expect_warnings({
      {[&](RemeshResult& r) { points(r, 0.06); },
       {"taken as points, its 196 faces were not used: volume"}},
      {[&](RemeshResult& r) {
         points(r, 0.0);
         r.input.input_faces = 0;
       },
       {"taken as points: volume"}},
      {[](RemeshResult& r) { r.steep_share = 0.5; }, {}},
      {[](RemeshResult& r) { r.options.envelope.opening_percent = 5.0; },
       {"by its envelope: volume", "narrower than 5 %"}},
      {[&](RemeshResult& r) {
         points(r, 0.5);
         r.options.envelope.opening_percent = 5.0;
       },
       {"by its envelope, its 196 faces were not used: volume"}},
      {[](RemeshResult& r) { r.folded_share = 0.01; }, {}},
      {[](RemeshResult& r) { r.folded_share = 0.011; }, {"folds over itself", "1.1 %"}},
      {[](RemeshResult& r) {
         r.folded_share = 0.5;
         r.parametrization = Parametrization::Spherical;
       },
       {}},
      {[](RemeshResult& r) { r.input.components = 3; }, {"3 separate bodies"}},
      {[](RemeshResult& r) {
         r.input.components = 2;
         r.input.inner_components = 1;
         r.input.inner_volume_share = 0.25;
       },
       {"1 surface inside", "25 % of its volume"}},
      {[](RemeshResult& r) {
         r.input.components = 3;
         r.input.inner_components = 2;
       },
       {"2 surfaces inside"}},
      {[](RemeshResult& r) {
         r.input.flap_area_share = 0.01;
         r.input.filled_area_share = 0.03;
       },
       {"mended", "4 % of its area"}},
      {[](RemeshResult& r) { r.input.genus = 1; }, {"1 hole through it"}},
      {[](RemeshResult& r) { r.input.genus = 2; }, {"2 holes through it"}},
      {[](RemeshResult& r) {
         r.input.genus = 1;
         r.handles.cut.resize(1);
         r.handles.volume_change = -0.02;
       },
       {"1 handle, which was cut", "by 2 %. The log says where."}},
      {[](RemeshResult& r) { r.handles.cut.resize(2); }, {"2 handles, which were cut"}},
  });
}

TEST(RemeshWarnings, AdviseAnEnvelopeWhereHandlesSpoilTheRemesh) {
  RemeshResult result = clean();
  result.handles.cut.resize(1);
  const auto is_advised = [&] {
    return remesh_warnings(result, RemeshOptions()).front().find("its envelope has none") !=
           std::string::npos;
  };
  EXPECT_FALSE(is_advised());
  result.space.self_intersections = 1;
  EXPECT_TRUE(is_advised());
  result.space.self_intersections = 0;
  result.misfit = 0.03;  // of a radius of 2
  EXPECT_TRUE(is_advised());
}

TEST(RemeshWarnings, TellASeriesThatMissesTheScan) {
  const auto series = [](RemeshResult& r, double residual) {
    r.options.placement.kind = NodePlacement::Series;
    r.fit.residual = residual;
  };
  expect_warnings({
      {[](RemeshResult& r) {
         r.fit.requested_degree = 20;
         r.fit.degree = 9;
       },
       {"lowered from 20 to 9"}},
      {[](RemeshResult& r) { r.fit.degree = 9; }, {}},  // an automatic one
      {[](RemeshResult& r) { r.fit.residual = 1.0; }, {}},
      {[&](RemeshResult& r) { series(r, 0.1); }, {}},
      {[&](RemeshResult& r) { series(r, 0.12); },
       {"by 6 %", "Raise the harmonic degree, or place"}},
      {[&](RemeshResult& r) {
         series(r, 0.12);
         r.fit.limit = DegreeLimit::Highest;
       },
       {"(rms). Place the nodes"}},
  });
}

TEST(RemeshWarnings, TellARemeshThatMissesTheScanAndTheBestTwoOfTheChangesTried) {
  expect_warnings({
      {[](RemeshResult& r) { r.misfit = 0.02; }, {}},
      {[](RemeshResult& r) { r.misfit = 0.03; }, {"rms distance 1.5 % of the equivalent radius"}},
      {[](RemeshResult& r) { r.remesh.area = 9.81; }, {}},
      {[](RemeshResult& r) { r.remesh.area = 9.5; }, {"area -5 %."}},
      {[](RemeshResult& r) { r.remesh.area = 10.5; }, {"area +5 %."}},
      {[](RemeshResult& r) {
         r.remesh.area = 9.5;
         r.input.input_vertices = 0;  // a formula
       },
       {}},
      {[](RemeshResult& r) {
         r.misfit = 1.0;
         r.options.placement.kind = NodePlacement::Contact;
       },
       {}},
      // Twice the limit of the area is worse than half of it and 1.6 times that of the distance.
      {[](RemeshResult& r) {
         r.misfit = 0.04;
         r.tried = {
             {"small steps", 0.001, -0.04}, {"more nodes", 0.016, 0.01}, {"luck", 0.03, 0.0}};
       },
       {"With more nodes: rms distance 1.6 % of the equivalent radius, area +1 %."}},
      {[](RemeshResult& r) {
         r.misfit = 0.04;
         r.tried = {{"more nodes", 0.02, 0.01}, {"luck", 0.03, 0.0}};
       },
       {"None of the changes tried"}},
      {[](RemeshResult& r) {
         r.misfit = 0.04;
         r.tried = {{"luck", 0.018, 0.0}, {"more nodes", 0.016, 0.01}, {"care", 0.012, -0.01}};
       },
       {"area +0 %. With care: rms distance 1.2 % of the equivalent radius, area -1 %. With more "
        "nodes: rms distance 1.6 % of the equivalent radius, area +1 %."}},
  });
}

TEST(RemeshWarnings, TellWhatASphericalMapCouldNotDo) {
  const auto on_map = [](RemeshResult& r, std::size_t pairs, int enough) {
    r.parametrization = Parametrization::Spherical;
    r.space.self_intersections = pairs;
    r.space.enough_nodes = enough;
    r.space.volume_loss = 0.375;
  };
  expect_warnings({
      {[&](RemeshResult& r) { on_map(r, 0, 0); }, {}},
      {[&](RemeshResult& r) { on_map(r, 1, 0); }, {"1 pair of triangles", "than 42 nodes can"}},
      {[&](RemeshResult& r) { on_map(r, 2, 0); }, {"2 pairs of triangles"}},
      {[&](RemeshResult& r) { on_map(r, 0, 84); },
       {"42 nodes are too few", "37.5 % of the volume", "; 84 would do."}},
      {[&](RemeshResult& r) { on_map(r, 0, too_many_nodes); }, {"; so are twice to sixteen times"}},
      {[&](RemeshResult& r) {
         on_map(r, 1, 84);
         r.parametrization = Parametrization::Radial;
       },
       {}},
  });
  // Another metric was asked for than the map can do with.
  RemeshResult result = clean();
  RemeshOptions asked;
  asked.relaxation.metric = RelaxationMetric::Sphere;
  EXPECT_TRUE(remesh_warnings(result, asked).empty());
  on_map(result, 0, 0);
  const std::vector<std::string> warnings = remesh_warnings(result, asked);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("The cells are those on the surface"), std::string::npos);
}

TEST(RemeshWarnings, TellAnglesSmallerThanPromisedOrUsual) {
  const auto refined = [](RemeshResult& r, int rounds, double limit, double smallest) {
    r.options.placement.refinement.rounds = rounds;
    r.options.placement.refinement.smallest_angle = limit;
    r.quality.smallest_angle = smallest;
  };
  expect_warnings({
      {[&](RemeshResult& r) { refined(r, 5, 30.0, 29.95); }, {}},
      {[&](RemeshResult& r) { refined(r, 5, 0.0, 2.75); }, {}},
      {[&](RemeshResult& r) { refined(r, 5, 30.0, 26.5); },
       {"is 26.5 degrees, below the 30 asked for:", "Another number of nodes, or of rounds"}},
      {[&](RemeshResult& r) { refined(r, 0, 30.0, 20.5); }, {}},
      {[&](RemeshResult& r) { refined(r, 0, 30.0, 2.75); }, {"is 2.75 degrees: at a thin"}},
      // What is not relaxed on the surface has such angles as a matter of course.
      {[&](RemeshResult& r) {
         refined(r, 0, 30.0, 2.75);
         r.options.seeding.sampling = Sampling::Fibonacci;
       },
       {}},
      {[&](RemeshResult& r) {
         refined(r, 0, 30.0, 2.75);
         r.options.relaxation.metric = RelaxationMetric::Sphere;
       },
       {}},
  });
}

TEST(RemeshWarnings, TellWhyARelaxationEndedAndWhatMayHelp) {
  const auto ended = [](RemeshResult& r, RelaxationOutcome outcome, RelaxationMetric metric) {
    r.relaxation.outcome = outcome;
    r.options.relaxation.metric = metric;
  };
  const RelaxationMetric sphere = RelaxationMetric::Sphere;
  expect_warnings({
      {[&](RemeshResult& r) { ended(r, RelaxationOutcome::Settled, sphere); },
       {"spread by 12.5 %"}},
      {[&](RemeshResult& r) { ended(r, RelaxationOutcome::Settled, RelaxationMetric::Surface); },
       {}},
      {[&](RemeshResult& r) { ended(r, RelaxationOutcome::Stuck, sphere); },
       {"stopped after 7 iterations", "torn"}},
      {[&](RemeshResult& r) {
         ended(r, RelaxationOutcome::IterationLimit, sphere);
         r.options.relaxation.maximum_iterations = 7;
       },
       {"at its limit of 7 iterations"}},
      {[&](RemeshResult& r) {
         ended(r, RelaxationOutcome::IterationLimit, sphere);
         r.options.relaxation.maximum_iterations = 8;
       },
       {"triangles had met", "within 7 iterations"}},
      {[](RemeshResult& r) { r.relaxation.weight_scale = 0.5; },
       {"scaled by 0.5", "ask for more nodes"}},
      {[](RemeshResult& r) {
         r.relaxation.weight_scale = 0.5;
         r.options.weighting.kind = Weighting::Curvature;
       },
       {"lower the strength alpha"}},
      // Other samplings are not relaxed; some have no form with each number of nodes.
      {[&](RemeshResult& r) {
         ended(r, RelaxationOutcome::Stuck, sphere);
         r.options.seeding.sampling = Sampling::Icosahedron;
       },
       {}},
      {[](RemeshResult& r) {
         r.options.seeding.sampling = Sampling::Icosahedron;
         r.options.node_count = 50;
       },
       {"no form with 50 nodes; the nearest, with 42"}},
  });
}

TEST(RemeshWarnings, TellASearchThatMetNoTarget) {
  expect_warnings({
      {[](RemeshResult& r) {
         r.search = NodeCountSearch{true, 42, {}};
       },
       {}},
      {[](RemeshResult& r) {
         r.options.target.percent = 0.5;
         r.search = NodeCountSearch{false, 42, {}};
       },
       {"No number of nodes up to 42 meets the error target of 0.5 %"}},
  });
}

}  // namespace
}  // namespace wscvt
