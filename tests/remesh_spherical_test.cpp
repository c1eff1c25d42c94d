// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grains/bent_grain.h"
#include "grains/handled_body.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/nodes/self_intersections.h"
#include "wscvt/remesh.h"
#include "wscvt/report/remesh_warnings.h"
#include "wscvt/report/report.h"
#include "wscvt/scan/mesh_check.h"
#include "wscvt/scan/mesh_io.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

IndexedMesh body(const std::string& name) {
  return test::bent_grain_mesh(test::bent_grain(name), 2500);
}

RemeshOptions options_of(int nodes, NodePlacement placement = NodePlacement::Scan) {
  RemeshOptions options;
  options.node_count = nodes;
  options.weighting.kind = Weighting::Area;
  options.placement.kind = placement;
  return options;
}

/// Exactly so many nodes, closed, outward, of genus 0: nothing to mend.
void expect_valid(const RemeshResult& result, std::size_t nodes, const std::string& what) {
  ASSERT_EQ(result.mesh.points.size(), nodes) << what;
  ASSERT_EQ(result.mesh.triangles.size(), 2 * nodes - 4) << what;
  const MeshCheckReport report = check_mesh(result.mesh, MeshCheckOptions(), Execution(1)).report;
  EXPECT_EQ(report.vertices, nodes) << what;
  EXPECT_EQ(report.faces, 2 * nodes - 4) << what;
  EXPECT_EQ(report.genus, 0) << what;
  EXPECT_EQ(report.reoriented_faces, 0U) << what;
  EXPECT_EQ(result.space.self_intersections, self_intersections(result.mesh).size()) << what;
}

bool says(const std::vector<std::string>& lines, const std::string& what) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(what) != std::string::npos; });
}

TEST(RemeshSpherical, AutoDecidesByTheFlanks) {
  const RemeshResult gentle = remesh(test::lumpy(4), options_of(100), Execution(1));
  EXPECT_EQ(gentle.parametrization, Parametrization::Radial);
  EXPECT_LE(gentle.steep_share, steep_share_limit);
  EXPECT_TRUE(says(report_lines(gentle), "radial; "));
  const RemeshResult hook = remesh(body("hook"), options_of(300), Execution(1));
  EXPECT_EQ(hook.parametrization, Parametrization::Spherical);
  EXPECT_GT(hook.steep_share, steep_share_limit);
  EXPECT_TRUE(says(report_lines(hook), "spherical; "));
  // What is asked for is taken.
  RemeshOptions spherical = options_of(100);
  spherical.surface.parametrization = Parametrization::Spherical;
  EXPECT_EQ(remesh(test::lumpy(4), spherical, Execution(1)).parametrization,
            Parametrization::Spherical);
}

TEST(RemeshSpherical, BentBodiesKeepTheirShape) {
  for (const char* name : {"hook", "C-shape", "mushroom", "crescent"}) {
    const RemeshResult result =
        remesh(body(name), options_of(400, NodePlacement::LeastSquares), Execution(1));
    expect_valid(result, 400, name);
    EXPECT_EQ(result.space.self_intersections, 0U) << name;
    // Rounding of sums over 800 triangles, and of the way to grain units and back.
    EXPECT_NEAR(result.remesh.volume / result.original.volume, 1.0, 1e-11) << name;
    EXPECT_NEAR(result.remesh.area / result.original.area, 1.0, 0.03) << name;
    EXPECT_LT(result.quality.edge_ratio.mean, 1.2) << name;
  }
}

TEST(RemeshSpherical, ContactNodesKeepTheMeshWhole) {
  for (const char* name : {"hook", "mushroom"}) {
    const RemeshResult fitted =
        remesh(body(name), options_of(400, NodePlacement::LeastSquares), Execution(2));
    const RemeshResult contact =
        remesh(body(name), options_of(400, NodePlacement::Contact), Execution(2));
    expect_valid(contact, 400, name);
    EXPECT_EQ(contact.mesh.triangles, fitted.mesh.triangles) << name;
    EXPECT_GT(contact.remesh.volume, 1.001 * fitted.remesh.volume) << name;
    EXPECT_LT(contact.remesh.volume, 1.1 * fitted.remesh.volume) << name;
    EXPECT_EQ(contact.space.self_intersections, 0U) << name;
  }
}

TEST(RemeshSpherical, AHandfulOfNodesIsValidOrRefusedWithAReason) {
  for (const char* name : {"hook", "mushroom", "crescent"}) {
    const IndexedMesh scan = test::bent_grain_mesh(test::bent_grain(name), 3000);
    for (const NodePlacement placement : {NodePlacement::Scan, NodePlacement::LeastSquares}) {
      for (const int nodes : {4, 5, 6, 8, 11, 15, 20}) {
        const std::string what = std::string(name) + " with " + std::to_string(nodes) + " nodes";
        try {
          const RemeshResult result = remesh(scan, options_of(nodes, placement), Execution(1));
          ASSERT_EQ(result.mesh.points.size(), static_cast<std::size_t>(nodes)) << what;
          ASSERT_EQ(result.mesh.triangles.size(), static_cast<std::size_t>(2 * nodes - 4)) << what;
          EXPECT_NO_THROW(to_mesh(result.mesh)) << what;
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ErrorCode::NumericalFailure) << what;
          EXPECT_NE(std::string(error.what()).find("nodes"), std::string::npos) << error.what();
        }
      }
    }
  }
}

TEST(RemeshSpherical, TooFewNodesAreSaidWithTheNumberThatWouldDo) {
  const IndexedMesh hook = body("hook");
  const RemeshResult few = remesh(hook, options_of(20), Execution(1));
  ASSERT_GT(few.space.enough_nodes, 20);
  EXPECT_TRUE(says(few.warnings, "too few for this shape"));
  EXPECT_TRUE(says(few.warnings, std::to_string(few.space.enough_nodes) + " would do"));
  const RemeshResult enough = remesh(hook, options_of(few.space.enough_nodes), Execution(1));
  EXPECT_EQ(enough.space.enough_nodes, 0);
  EXPECT_FALSE(says(enough.warnings, "too few"));
}

TEST(RemeshSpherical, RefusesShapesThatAreTooMuchWithAdviceThatWorks) {
  // A handful of nodes lies in a plane or inside out, some only once they are mended.
  const auto is_refused = [](const IndexedMesh& scan, RemeshOptions options) {
    try {
      remesh(scan, options, Execution(2));
      return false;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::NumericalFailure);
      const std::string what = error.what();
      const std::string said = "their mesh encloses no volume; ";
      const std::size_t place = what.find(said);
      EXPECT_NE(place, std::string::npos) << what;
      if (place == std::string::npos) return true;
      const std::string advice = what.substr(place + said.size());
      const bool names_a_number = advice.find(" would do.") != std::string::npos;
      EXPECT_TRUE(names_a_number || advice == "ask for many more.") << what;
      options.node_count = names_a_number ? std::stoi(advice) : 100 * options.node_count;
      EXPECT_NO_THROW(remesh(scan, options, Execution(2))) << what;
      return true;
    }
  };
  int refused = 0;
  for (const char* name : {"bowl", "C-shape"}) {
    IndexedMesh scan = test::bent_grain_mesh(test::bent_grain(name), 3000);
    for (Vector3& p : scan.points) p = p.cast<float>().cast<double>();  // as most files have it
    for (int nodes = 4; nodes <= 15; ++nodes) {
      refused += is_refused(scan, options_of(nodes, NodePlacement::LeastSquares));
    }
  }
  EXPECT_GE(refused, 2);
}

TEST(RemeshSpherical, RadialDistanceIsTheAreaWeightingAndSaysSo) {
  RemeshOptions options = options_of(150);
  const IndexedMesh hook = body("hook");
  const RemeshResult area = remesh(hook, options, Execution(1));
  options.weighting.kind = Weighting::RadialDistance;
  const RemeshResult distance = remesh(hook, options, Execution(1));
  EXPECT_EQ(distance.mesh.points, area.mesh.points);
  EXPECT_TRUE(says(report_lines(distance), "asked for"));
  EXPECT_FALSE(says(report_lines(area), "asked for"));
}

TEST(RemeshSpherical, WhatTheMapCannotFollowIsSaidAndReportedAsUsed) {
  RemeshOptions options = options_of(300);
  options.weighting.kind = Weighting::Curvature;
  options.relaxation.metric = RelaxationMetric::Sphere;
  const RemeshResult result = remesh(body("hook"), options, Execution(1));
  EXPECT_TRUE(says(result.warnings, "take the radial parametrization for cells on the sphere"));
  EXPECT_EQ(result.options.relaxation.metric, RelaxationMetric::Surface);
  options.relaxation.metric = RelaxationMetric::Surface;
  EXPECT_FALSE(says(remesh(body("hook"), options, Execution(1)).warnings, "cells on the sphere"));
}

TEST(RemeshSpherical, CurvatureComesFromWhereItIsAskedFor) {
  RemeshOptions options = options_of(200);
  options.surface.parametrization = Parametrization::Spherical;
  options.weighting.kind = Weighting::Curvature;
  const IndexedMesh scan = test::scaled(test::sphere(4), Vector3(3, 1, 1));
  const RemeshResult series = remesh(scan, options, Execution(1));
  EXPECT_TRUE(says(report_lines(series), "curvature from series of degree 20"));
  options.surface.degree = 4;
  const RemeshResult low = remesh(scan, options, Execution(1));
  EXPECT_TRUE(says(report_lines(low), "curvature from series of degree 4"));
  EXPECT_NE(low.mesh.points, series.mesh.points);
  options.weighting.curvature_source = CurvatureSource::QuadricFit;
  const RemeshResult quadrics = remesh(scan, options, Execution(1));
  EXPECT_TRUE(says(report_lines(quadrics), "curvature from quadrics on the scan"));
  EXPECT_NE(quadrics.mesh.points, series.mesh.points);
  options.surface.degree = 20;
  EXPECT_EQ(remesh(scan, options, Execution(1)).mesh.points, quadrics.mesh.points)
      << "quadrics have no degree";
}

TEST(RemeshSpherical, CurvatureWeightingsGatherNodesWhereItBends) {
  // A rod's caps are bent twice as much as its sides.
  const IndexedMesh scan = test::scaled(test::sphere(4), Vector3(3, 1, 1));
  for (const Weighting weighting : {Weighting::ErrorAdaptive, Weighting::Curvature}) {
    RemeshOptions options = options_of(200);
    options.surface.parametrization = Parametrization::Spherical;
    const auto at_the_tips = [&](Weighting kind) {
      options.weighting.kind = kind;
      int count = 0;
      for (const Vector3& p : remesh(scan, options, Execution(1)).mesh.points) {
        count += std::abs(p.x()) > 2.4 ? 1 : 0;
      }
      return count;
    };
    EXPECT_GT(at_the_tips(weighting), 1.3 * at_the_tips(Weighting::Area));
  }
}

TEST(RemeshSpherical, SteepCurvatureWeightsSettle) {
  RemeshOptions options = options_of(500);
  options.surface.parametrization = Parametrization::Spherical;
  options.weighting.kind = Weighting::Curvature;
  for (const double alpha : {-3.0, 1.0, 3.0}) {
    options.weighting.curvature_alpha = alpha;
    const RemeshResult result =
        remesh(read_mesh(WSCVT_MESHES_DIR "/sand_7228.ply"), options, Execution(2));
    EXPECT_NE(result.relaxation.outcome, RelaxationOutcome::IterationLimit) << alpha;
    EXPECT_LT(result.relaxation.iterations, 700) << alpha;
    // Where nodes crowd so, triangles are jammed and have to be mended.
    EXPECT_GT(result.space.mending.moves, 0) << alpha;
    EXPECT_GT(measure_quality(result.mesh).smallest_angle, 30.0) << alpha;
  }
}

TEST(RemeshSpherical, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh hook = body("hook");
  const RemeshOptions options = options_of(150, NodePlacement::LeastSquares);
  const RemeshResult one = remesh(hook, options, Execution(1));
  const RemeshResult three = remesh(hook, options, Execution(3));
  EXPECT_EQ(one.mesh.points, three.mesh.points);
  EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
}

TEST(RemeshSpherical, OtherSamplingsLieOnTheMap) {
  RemeshOptions options = options_of(100);
  options.seeding.sampling = Sampling::Fibonacci;
  expect_valid(remesh(body("crescent"), options, Execution(1)), 100, "Fibonacci");
}

TEST(RemeshSpherical, RefinementComesNearerAndKeepsThePromises) {
  RemeshOptions options = options_of(200, NodePlacement::LeastSquares);
  for (const char* name : {"hook", "crescent", "mushroom"}) {
    SCOPED_TRACE(name);
    options.placement.refinement.rounds = 0;
    const RemeshResult plain = remesh(body(name), options, Execution(2));
    options.placement.refinement.rounds = 20;
    const RemeshResult refined = remesh(body(name), options, Execution(2));
    expect_valid(refined, 200, name);
    EXPECT_EQ(refined.parametrization, Parametrization::Spherical);
    EXPECT_EQ(refined.space.self_intersections, 0U);
    EXPECT_GE(measure_quality(refined.mesh).smallest_angle, 30.0 - 1e-6);
    // To rounding, as without refinement.
    EXPECT_NEAR(refined.remesh.volume / refined.original.volume, 1.0, 1e-11);
    // A fifth nearer on smooth bodies, which the fit alone follows well.
    EXPECT_LT(rms_distance(body(name), refined.mesh, 20000, Execution(1)),
              0.9 * rms_distance(body(name), plain.mesh, 20000, Execution(1)));
  }
}

/// A cap of 69 degrees of a sphere of radius 1, as thick as told.
IndexedMesh shell(double thickness) {
  IndexedMesh mesh = test::sphere(5);
  for (Vector3& p : mesh.points) {
    const double polar = std::acos(std::clamp(p.z(), -1.0, 1.0));
    const bool outer = polar < 0.5 * test::pi;
    const double along = 1.2 * (outer ? polar : test::pi - polar) / (0.5 * test::pi);
    const double round = std::atan2(p.y(), p.x());
    p = (1.0 + (outer ? 0.5 : -0.5) * thickness) * Vector3(std::sin(along) * std::cos(round),
                                                           std::sin(along) * std::sin(round),
                                                           std::cos(along));
  }
  return mesh;
}

TEST(RemeshSpherical, TrianglesThatMendingHasPartedDoNotMakeNodesTooFew) {
  // Of 200 on the rod triangles meet until they are mended; a fifth of the volume is no quarter.
  const IndexedMesh rod = test::bent_grain_mesh(test::bent_grain("rod"), 15000);
  const RemeshResult mended = remesh(rod, options_of(200, NodePlacement::LeastSquares));
  EXPECT_LT(mended.space.volume_loss, 0.25);
  EXPECT_EQ(mended.space.self_intersections, 0U);
  EXPECT_EQ(mended.space.enough_nodes, 0);
  EXPECT_FALSE(says(mended.warnings, "too few for this shape"));
}

TEST(RemeshSpherical, MendingAfterARefinementKeepsTheShape) {
  // The refinement leaves an angle on the flake. Mended as nodes are that are yet to be fitted,
  // which presses those about it on to the scan, the distance is 1.28 % of R, and .99 % mended
  // sparingly.
  const IndexedMesh flake = test::bent_grain_mesh(test::bent_grain("flake"), 15000);
  RemeshOptions options = options_of(300, NodePlacement::LeastSquares);
  options.placement.refinement.rounds = 20;
  const RemeshResult result = remesh(flake, options);
  EXPECT_GT(result.space.mending.flips + result.space.mending.moves, 0);
  EXPECT_GE(result.quality.smallest_angle, 30.0 - 1e-3);
  EXPECT_LT(result.misfit, 0.011 * result.input.equivalent_radius);
}

TEST(RemeshSpherical, AnAngleAtTheLimitToRoundingIsNotMended) {
  // Of which the refinement leaves one on the rod. Mending it would flip ten edges.
  const IndexedMesh rod = test::bent_grain_mesh(test::bent_grain("rod"), 15000);
  RemeshOptions options = options_of(800, NodePlacement::LeastSquares);
  options.placement.refinement.rounds = 10;
  const RemeshResult result = remesh(rod, options);
  EXPECT_LT(result.quality.smallest_angle, 30.0);
  EXPECT_GE(result.quality.smallest_angle, 30.0 - 1e-3);
  EXPECT_EQ(result.space.mending.flips + result.space.mending.moves, 0);
  EXPECT_EQ(result.space.mending.left, 0);
}

TEST(RemeshSpherical, HasEvenEdgesOnBodiesWithUndercuts) {
  for (const test::BentGrain& body : test::bent_grains()) {
    SCOPED_TRACE(body.name);
    const RemeshResult result =
        remesh(test::bent_grain_mesh(body, 15000), options_of(1000, NodePlacement::LeastSquares));
    // What the prototype of the method reached, whose nodes were not fitted to the scan; thin rims
    // are allowed more. A fit alone leaves crescent, mushroom and rod at .077 to .082, the flake at
    // .094.
    const bool thin = body.name == "flake" || body.name == "bowl";
    const Statistics edges = result.quality.edge_length;
    EXPECT_LE(edges.standard_deviation / edges.mean, thin ? 0.09 : 0.075);
    EXPECT_LE(result.quality.edge_ratio.mean, thin ? 1.18 : 1.15);
    EXPECT_LT(result.space.evening.deviation_after, result.space.evening.deviation_before);
  }
}

TEST(RemeshSpherical, SeedsDoNotStayCrowdedBehindANeck) {
  // An eighth of them did, and edges deviated by 0.20 of their mean length.
  const IndexedMesh rod = test::bent_grain_mesh(test::bent_grain("rod"), 15000);
  const RemeshResult result = remesh(rod, options_of(1015, NodePlacement::LeastSquares));
  EXPECT_GT(result.space.relocated_seeds, 50);
  EXPECT_LT(result.quality.edge_length.standard_deviation / result.quality.edge_length.mean, 0.1);
  EXPECT_GE(result.quality.smallest_angle, 34.9);
  EXPECT_EQ(result.mesh.points.size(), 1015U);
  EXPECT_EQ(result.space.self_intersections, 0U);
}

TEST(RemeshSpherical, MeetingTrianglesAreRefusedWhereAskedFor) {
  // Flat triangles of 60 nodes bulge further than its sheets are apart.
  const IndexedMesh thin = shell(0.004);
  RemeshOptions options = options_of(60);
  const RemeshResult result = remesh(thin, options, Execution(1));
  ASSERT_GT(result.space.self_intersections, 0U);
  EXPECT_TRUE(says(result.warnings, "meet each other"));
  options.placement.refuse_self_intersections = true;
  const std::string sentence =
      test::refusal(ErrorCode::NumericalFailure, [&] { remesh(thin, options, Execution(1)); });
  EXPECT_NE(sentence.find("which the options refuse"), std::string::npos) << sentence;
}

TEST(RemeshSpherical, HandlesAreCutAndTold) {
  RemeshOptions options = options_of(300, NodePlacement::LeastSquares);
  for (const IndexedMesh& mesh : {test::ball_with_a_bridge(), test::ball_with_a_tunnel()}) {
    const RemeshResult result = remesh(mesh, options, Execution(1));
    expect_valid(result, 300, "a ball with a handle");
    EXPECT_EQ(result.input.genus, 1);
    ASSERT_EQ(result.handles.cut.size(), 1U);
    EXPECT_TRUE(says(result.warnings, "1 handle, which was cut"));
    EXPECT_TRUE(says(report_lines(result), "1 handle cut and closed"));
    // The volume that is kept is that of the scan without its handle.
    EXPECT_NEAR(result.remesh.volume / result.input.volume, 1.0, 1e-12);
  }
  // One radius a direction passes tunnels by.
  options.surface.parametrization = Parametrization::Radial;
  const RemeshResult closed = remesh(test::ball_with_a_tunnel(), options, Execution(1));
  EXPECT_TRUE(closed.handles.cut.empty());
  EXPECT_TRUE(says(closed.warnings, "which the remesh closes"));
}

TEST(RemeshSpherical, ARingIsRefusedWithAdviceThatWorks) {
  const IndexedMesh ring = test::torus(1.0, 0.4, 24);
  RemeshOptions options = options_of(300);
  try {
    remesh(ring, options, Execution(1));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_NE(std::string(error.what()).find("raise the limit"), std::string::npos) << error.what();
  }
  options.handles.length_limit = 3.0;
  const RemeshResult cut = remesh(ring, options, Execution(1));
  expect_valid(cut, 300, "a ring cut open");
  EXPECT_EQ(cut.handles.cut.size(), 1U);
}

TEST(RemeshSpherical, APorousScanIsRefusedWithAdviceThatWorks) {
  const IndexedMesh drilled = test::ball_with_a_tunnel();
  RemeshOptions options = options_of(300);
  options.surface.parametrization = Parametrization::Spherical;
  options.handles.count_limit = 0;
  try {
    remesh(drilled, options, Execution(1));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_NE(std::string(error.what()).find("Take its envelope"), std::string::npos)
        << error.what();
  }
  options.envelope.opening_percent = 20.0;
  const RemeshResult wrapped = remesh(drilled, options, Execution(1));
  expect_valid(wrapped, 300, "an envelope");
  EXPECT_TRUE(says(wrapped.warnings, "taken by its envelope"));
  EXPECT_EQ(wrapped.input.input_vertices, drilled.points.size());
  EXPECT_EQ(wrapped.input.genus, 0);
}

TEST(RemeshSpherical, AFlawedScanThatIsMissedIsAdvisedItsEnvelope) {
  // Drilled through by a hole .07 wide; an envelope of 3 % closes what is narrower than .1.
  const IndexedMesh flawed = test::body_of_depth([](const Vector3& p) {
    return std::min(test::ball(p), std::hypot(p.x() - 0.5, p.y()) - 0.035);
  });
  RemeshOptions options = options_of(30);
  options.surface.parametrization = Parametrization::Spherical;
  const RemeshResult missed = remesh(flawed, options, Execution(1));
  ASSERT_TRUE(misses_the_scan(missed));
  ASSERT_EQ(missed.handles.cut.size(), 1U);
  EXPECT_TRUE(says(missed.warnings, "3 % of the bounding box is a start"));
  options.envelope.opening_percent = 3.0;  // the advice
  EXPECT_TRUE(remesh(flawed, options, Execution(1)).handles.cut.empty());
  // Where nothing is amiss there is nothing to advise.
  options = options_of(600, NodePlacement::LeastSquares);
  options.surface.parametrization = Parametrization::Spherical;
  const RemeshResult close = remesh(flawed, options, Execution(1));
  ASSERT_FALSE(misses_the_scan(close));
  EXPECT_EQ(close.handles.cut.size(), 1U);
  EXPECT_FALSE(says(close.warnings, "--envelope"));
}

TEST(RemeshSpherical, CoefficientsOfAMapGiveTheBodyAgain) {
  RemeshOptions options = options_of(400);
  options.measures.coefficients = true;
  const RemeshResult hook = remesh(body("hook"), options, Execution(1));
  ASSERT_EQ(hook.parametrization, Parametrization::Spherical);
  ASSERT_EQ(hook.map_coefficients[0].size(), 441U);  // degree 20
  EXPECT_EQ(hook.map_degree, 20);
  const RemeshResult again = remesh(HarmonicMap(hook.map_coefficients), options, Execution(1));
  expect_valid(again, 400, "a hook from its coefficients");
  EXPECT_EQ(again.parametrization, Parametrization::Spherical);
  // The series is an approximation: rms .7 to 2.5 % at degree 20 on such bodies.
  EXPECT_NEAR(again.input.volume / hook.input.volume, 1.0, 0.05);
  EXPECT_TRUE(remesh(body("hook"), options_of(50), Execution(1)).map_coefficients[0].empty());
}

TEST(RemeshSpherical, AMissedScanIsSaidWithTheChangesThatHelpMost) {
  RemeshOptions options = options_of(80, NodePlacement::LeastSquares);
  const RemeshResult few = remesh(body("mushroom"), options);
  ASSERT_TRUE(misses_the_scan(few));
  ASSERT_EQ(few.space.enough_nodes, 0);
  EXPECT_TRUE(says(few.warnings, "misses the scan: rms distance"));
  // Followed, each gives what it promises, in the order in which they are tried.
  ASSERT_EQ(few.tried.size(), 3U);
  const auto expect_promised = [](const RemeshOptions& followed, const TriedChange& promised) {
    const RemeshResult result = remesh(body("mushroom"), followed);
    EXPECT_DOUBLE_EQ(result.misfit / result.input.equivalent_radius, promised.misfit);
    EXPECT_DOUBLE_EQ(result.remesh.area / result.original.area - 1.0, promised.area_off);
  };
  RemeshOptions adaptive = options;
  adaptive.weighting.kind = Weighting::ErrorAdaptive;
  EXPECT_EQ(few.tried[0].change, "error-adaptive weighting");
  expect_promised(adaptive, few.tried[0]);
  adaptive.placement.refinement.rounds = 20;
  EXPECT_EQ(few.tried[1].change,
            "error-adaptive weighting and 20 rounds of refinement, whose triangles are less even");
  expect_promised(adaptive, few.tried[1]);
  RemeshOptions twice = options;
  twice.node_count = 160;
  EXPECT_EQ(few.tried[2].change, "160 nodes");
  expect_promised(twice, few.tried[2]);
  EXPECT_LT(few.tried[2].misfit, few.misfit / few.input.equivalent_radius);
  EXPECT_TRUE(says(few.warnings, "With 160 nodes: rms distance"));
  // The weighting asked for is taken up again after another was tried.
  options.weighting.kind = twice.weighting.kind = Weighting::Curvature;
  const RemeshResult curved = remesh(body("mushroom"), options);
  ASSERT_EQ(curved.tried.size(), 3U);
  expect_promised(twice, curved.tried[2]);
  // Where even triangles as many as before do, nothing else is tried.
  IndexedMesh flat = test::sphere(5);
  for (Vector3& p : flat.points) p = Vector3(3.0 * p.x(), p.y(), 0.3 * p.z());
  const RemeshResult blunted = remesh(flat, options_of(300, NodePlacement::LeastSquares));
  EXPECT_EQ(blunted.tried.size(), 1U);
  EXPECT_TRUE(says(blunted.warnings, "With error-adaptive weighting: rms distance"));
  // Where the nodes are too few for the shape, how many would do is said instead.
  const RemeshResult too_few = remesh(body("hook"), options_of(60, NodePlacement::LeastSquares));
  EXPECT_NE(too_few.space.enough_nodes, 0);
  EXPECT_TRUE(too_few.tried.empty());
  // As published on a body of fine detail: the scan itself helps.
  RemeshOptions published = options_of(800);
  published.method = Method::AsPublished;
  published.surface.degree = 4;
  const IndexedMesh box = test::subdivided(test::box(1.0, 1.0, 1.0), 5);
  const RemeshResult blunt = remesh(box, published);
  EXPECT_TRUE(says(blunt.warnings, "With nodes fitted to the scan by least squares"));
  const RemeshResult enough = remesh(box, options_of(800, NodePlacement::LeastSquares));
  EXPECT_FALSE(misses_the_scan(enough));
  EXPECT_TRUE(enough.tried.empty());
  EXPECT_FALSE(says(enough.warnings, "misses the scan"));
  published.measures.advice = false;
  EXPECT_TRUE(remesh(box, published).tried.empty());
}

}  // namespace
}  // namespace wscvt
