// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/remesh_warnings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "support/holds.h"
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
  result.scan.area = 10.0;
  result.remesh.area = 10.0;
  result.scan.volume = 4.0;
  result.remesh.volume = 4.0;
  result.quality.smallest_angle = 40.0;
  return result;
}

void place(RemeshResult& result, ScanPlacement placement) {
  std::get<OnScanOptions>(result.options.method).placement = placement;
}

OnScanReport& on_scan(RemeshResult& result) { return std::get<OnScanReport>(result.method); }

/// Makes it a result of the published method, whose report it gives.
AsPublishedReport& as_published(RemeshResult& result) {
  result.options.method = AsPublishedOptions();
  AsPublishedReport report;
  report.relaxation.outcome = RelaxationOutcome::Converged;
  report.relaxation.iterations = 7;
  report.relaxation.history = {{1e-4, 0.125, 0}};
  result.method = report;
  return std::get<AsPublishedReport>(result.method);
}

AsPublishedOptions& published_options(RemeshResult& result) {
  return std::get<AsPublishedOptions>(result.options.method);
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
    const std::vector<Sentence> warnings = remesh_warnings(result, "");
    ASSERT_EQ(warnings.size(), cases[k].parts.empty() ? 0U : 1U)
        << k << ": " << (warnings.empty() ? "" : warnings.front().text());
    for (const std::string& part : cases[k].parts) {
      EXPECT_TRUE(test::holds(warnings.front().text(), part)) << k << ": \""
                                                              << "\" in: ";
    }
  }
}

TEST(RemeshWarnings, ThereAreNoneOfACleanResult) {
  EXPECT_TRUE(remesh_warnings(clean(), "").empty());
  const auto warnings = remesh_warnings(clean(), "Far away.");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].text(), "Far away.");
}

TEST(RemeshWarnings, ThoseOfTheScanLeaveOutTheRemesh) {
  RemeshResult result = clean();
  result.options.shrink_wrap.opening_percent = 5.0;
  result.input.genus = 1;
  on_scan(result).handles.kept = 1;
  result.remesh.area = 5.0;
  const std::vector<Sentence> all = remesh_warnings(result, "");
  const std::vector<Sentence> of_scan = scan_warnings(result);
  ASSERT_EQ(of_scan.size(), 2U);
  EXPECT_TRUE(test::holds(of_scan[0].text(), "by its shrink-wrap"));
  EXPECT_TRUE(test::holds(of_scan[1].text(), "1 handle"));
  EXPECT_TRUE(std::equal(of_scan.begin(), of_scan.end(), all.begin()));
  EXPECT_EQ(all.size(), 3U);
}

TEST(RemeshWarnings, DoNotTellOfSdqWhichNobodyAskedFor) {
  RemeshResult result = clean();
  result.scan.sdq = 0.5;
  result.scan.sdq_half_clip = 0.52;
  EXPECT_TRUE(remesh_warnings(result, "").empty());
}

TEST(RemeshWarnings, NameWhatIsWrongWithTheScan) {
  const auto points = [](RemeshResult& r, double steep) {
    r.options.points = true;
    r.steep_area_fraction = steep;
  };
  // Of points that lie behind each other there are two.
  RemeshResult folded = clean();
  points(folded, 0.061);
  EXPECT_EQ(remesh_warnings(folded, "").size(), 2U);
  expect_warnings({
      {[&](RemeshResult& r) { points(r, 0.06); },
       {"read as points, its 196 faces were not used. Volume"}},
      {[&](RemeshResult& r) {
         points(r, 0.0);
         r.input.input_faces = 0;
       },
       {"read as points. Volume"}},
      {[](RemeshResult& r) { r.steep_area_fraction = 0.5; }, {}},
      {[](RemeshResult& r) { r.options.shrink_wrap.opening_percent = 5.0; },
       {"by its shrink-wrap. Volume", "gaps up to 5 %"}},
      {[&](RemeshResult& r) {
         points(r, 0.5);
         r.options.shrink_wrap.opening_percent = 5.0;
       },
       {"by its shrink-wrap, its 196 faces were not used. Volume"}},
      {[](RemeshResult& r) { as_published(r).overhang_fraction = 0.01; }, {}},
      {[](RemeshResult& r) { as_published(r).overhang_fraction = 0.011; }, {"Overhangs", "1.1 %"}},
      {[](RemeshResult& r) { r.input.components = 3; }, {"3 separate bodies"}},
      {[](RemeshResult& r) { r.input.has_voxel_steps = true; },
       {"The scan is made of the faces of voxels", "wscvt extract"}},
      {[](RemeshResult& r) {
         r.input.components = 2;
         r.input.inner_components = 1;
         r.input.inner_volume_fraction = 0.25;
       },
       {"1 surface inside", "25 % of its volume"}},
      {[](RemeshResult& r) {
         r.input.components = 3;
         r.input.inner_components = 2;
       },
       {"2 surfaces inside"}},
      {[](RemeshResult& r) {
         r.input.flap_area_fraction = 0.01;
         r.input.filled_area_fraction = 0.03;
       },
       {"repaired", "4 % of its area"}},
      {[](RemeshResult& r) {
         as_published(r);
         r.input.genus = 1;
       },
       {"1 handle (tunnels"}},
      {[](RemeshResult& r) {
         as_published(r);
         r.input.genus = 2;
       },
       {"2 handles (tunnels"}},
      {[](RemeshResult& r) {
         r.input.genus = 1;
         on_scan(r).handles.cut.resize(1);
         on_scan(r).handles.volume_change = -0.02;
       },
       {"1 handle of the scan was cut", "by 2 %. The log says where."}},
      {[](RemeshResult& r) { on_scan(r).handles.cut.resize(2); },
       {"2 handles of the scan were cut"}},
      {[](RemeshResult& r) { on_scan(r).handles.kept = 1; }, {"The grain has 1 handle (tunnels"}},
      {[](RemeshResult& r) { on_scan(r).handles.kept = 3; }, {"The grain has 3 handles"}},
  });
}

TEST(RemeshWarnings, TellASurfaceThatIsFarOffTheScan) {
  expect_warnings({
      {[](RemeshResult& r) {
         as_published(r).fit.requested_degree = 20;
         std::get<AsPublishedReport>(r.method).fit.degree = 9;
       },
       {"lowered from 20 to 9"}},
      {[](RemeshResult& r) { as_published(r).fit.residual = 0.1; }, {}},
      {[](RemeshResult& r) { as_published(r).fit.residual = 0.12; },
       {"is 6 %", "Raise --degree, or use"}},
      {[](RemeshResult& r) {
         as_published(r).fit.residual = 0.12;
         std::get<AsPublishedReport>(r.method).fit.limit = DegreeLimit::Radius;
       },
       {"away from the scan. Use --placement on-surface"}},
      {[](RemeshResult& r) {
         as_published(r).fit.residual = 1.0;
         published_options(r).placement = PublishedPlacement::Surface;
       },
       {}},
  });
}

TEST(RemeshWarnings, TellARemeshThatIsNotAccurateAndWhatHelps) {
  expect_warnings({
      {[](RemeshResult& r) { r.rms_distance = 0.02; }, {}},
      {[](RemeshResult& r) { r.rms_distance = 0.03; },
       {"rms distance 1.5 % of the equivalent radius"}},
      {[](RemeshResult& r) { r.remesh.area = 9.81; }, {}},
      {[](RemeshResult& r) { r.remesh.area = 9.5; }, {"area error -5 %. "}},
      {[](RemeshResult& r) { r.remesh.area = 10.5; }, {"area error +5 %. "}},
      {[](RemeshResult& r) {
         r.remesh.area = 9.5;
         r.input.input_vertices = 0;  // a formula
       },
       {"area error -5 %. "}},
      {[](RemeshResult& r) {
         r.rms_distance = 0.039;  // of radius 2
         r.largest_distance = 0.19;
         r.remesh.area = 10.3;
         r.remesh.volume = 1.05 * r.scan.volume;
         place(r, ScanPlacement::ContactFit);
       },
       {}},
      // A contact fit that shrinks or blows up a grain, or is far off.
      {[](RemeshResult& r) {
         r.remesh.volume = 0.93 * r.scan.volume;
         place(r, ScanPlacement::ContactFit);
       },
       {"area error +0 %, volume error -7 %. Use more nodes, or --placement fitted, which keeps"}},
      {[](RemeshResult& r) {
         r.rms_distance = 0.041;
         place(r, ScanPlacement::ContactFit);
       },
       {"rms distance 2.05 %"}},
      {[](RemeshResult& r) {
         r.largest_distance = 0.21;
         place(r, ScanPlacement::ContactFit);
       },
       {"largest 10.5 %"}},
      {[](RemeshResult& r) {
         r.remesh.area = 10.5;
         place(r, ScanPlacement::ContactFit);
       },
       {"area error +5 %"}},
      {[](RemeshResult& r) {
         r.quality.smallest_angle = 8.0;
         place(r, ScanPlacement::ContactFit);
       },
       {"8 degrees: the contact fit moves nodes", "If angles count, use --placement fitted."}},
      // What helps follows from the options.
      {[](RemeshResult& r) { r.rms_distance = 0.04; }, {"Use more nodes, or --edge-ratio 1.4: "}},
      {[](RemeshResult& r) {
         r.rms_distance = 0.04;
         std::get<OnScanOptions>(r.options.method).edge_ratio = 1.5;
       },
       {"area error +0 %. Use more nodes."}},
      {[](RemeshResult& r) {
         r.rms_distance = 0.04;
         place(r, ScanPlacement::OnSurface);
       },
       {"Use more nodes, or --placement fitted, which keeps the volume."}},
      {[](RemeshResult& r) {
         as_published(r);
         r.rms_distance = 0.04;
       },
       {"Use more nodes, or --method on-scan."}},
  });
}

TEST(RemeshWarnings, TellTrianglesThatIntersect) {
  expect_warnings({
      {[](RemeshResult& r) { on_scan(r).nodes.self_intersections = 1; },
       {"1 pair of triangles", "than 42 nodes can"}},
      {[](RemeshResult& r) { on_scan(r).nodes.self_intersections = 2; }, {"2 pairs of triangles"}},
  });
}

TEST(RemeshWarnings, TellSmallAnglesOnTheScan) {
  expect_warnings({
      {[](RemeshResult& r) { r.quality.smallest_angle = 20.5; }, {}},
      {[](RemeshResult& r) { r.quality.smallest_angle = 2.75; }, {"is 2.75 degrees: a thin"}},
      // As published such angles are a matter of course.
      {[](RemeshResult& r) {
         as_published(r);
         r.quality.smallest_angle = 2.75;
       },
       {}},
  });
}

TEST(RemeshWarnings, TellWhyARelaxationEndedAndWhatMayHelp) {
  const auto ended = [](RemeshResult& r, RelaxationOutcome outcome) {
    as_published(r).relaxation.outcome = outcome;
  };
  expect_warnings({
      {[&](RemeshResult& r) { ended(r, RelaxationOutcome::Settled); }, {"vary by 12.5 %"}},
      {[&](RemeshResult& r) { ended(r, RelaxationOutcome::Stuck); },
       {"stopped after 7 iterations", "could not be triangulated"}},
      {[&](RemeshResult& r) { ended(r, RelaxationOutcome::IterationLimit); },
       {"at its limit of 7 iterations"}},
      {[](RemeshResult& r) { as_published(r).relaxation.weight_scale = 0.5; },
       {"multiplied by 0.5", "Use more nodes"}},
      {[](RemeshResult& r) {
         as_published(r).relaxation.weight_scale = 0.5;
         published_options(r).weighting = Weighting::Curvature;
       },
       {"Lower --alpha"}},
      // Other samplings are not relaxed; some have no form with each number of nodes.
      {[&](RemeshResult& r) {
         ended(r, RelaxationOutcome::Stuck);
         published_options(r).sampling = Sampling::Icosahedron;
       },
       {}},
      {[](RemeshResult& r) {
         as_published(r);
         published_options(r).sampling = Sampling::Icosahedron;
         r.options.node_count = 50;
       },
       {"does not exist with 50 nodes. The nearest possible number, 42"}},
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
       {"No number of nodes up to 42 has an error of at most 0.5 %"}},
  });
}

}  // namespace
}  // namespace wscvt
