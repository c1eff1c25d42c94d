// SPDX-License-Identifier: GPL-3.0-or-later
// The method on the scan as a whole: any closed grain, by one pipeline.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "grains/bent_grain.h"
#include "grains/ct_grain.h"
#include "support/expect_error.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "support/voxel_body.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/mesh_distance.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_warnings.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/report/report.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

using test::any_holds;

IndexedMesh body(const std::string& name) {
  return test::bent_grain_mesh(test::bent_grain(name), 2500);
}

RemeshOptions options_of(int nodes, const OnScanOptions& on_scan = {}) {
  RemeshOptions options;
  options.node_count = nodes;
  options.method = on_scan;
  return options;
}

OnScanOptions placed(ScanPlacement placement) {
  OnScanOptions on_scan;
  on_scan.placement = placement;
  return on_scan;
}

const OnScanReport& report_of(const RemeshResult& result) { return *on_scan_report(result); }

/// Exactly so many nodes, closed, outward, of that genus: nothing to repair; and no pair of
/// triangles that the report does not have.
void expect_valid(const RemeshResult& result, std::size_t nodes, int genus,
                  const std::string& what) {
  const std::size_t faces = 2 * nodes - 4 + 4 * static_cast<std::size_t>(genus);
  ASSERT_EQ(result.mesh.points.size(), nodes) << what;
  ASSERT_EQ(result.mesh.triangles.size(), faces) << what;
  const MeshCheckReport report = check_mesh(result.mesh, MeshCheckOptions(), Execution(1)).report;
  EXPECT_EQ(report.vertices, nodes) << what;
  EXPECT_EQ(report.faces, faces) << what;
  EXPECT_EQ(report.genus, genus) << what;
  EXPECT_EQ(report.reoriented_faces, 0U) << what;
  EXPECT_EQ(report_of(result).nodes.self_intersections, self_intersections(result.mesh).size())
      << what;
}

double rms(const RemeshResult& result) {
  return result.rms_distance / result.input.equivalent_radius;
}

TEST(OnScan, CountsTheIntersectionsOfWhatIsWritten) {
  RemeshOptions options = options_of(500);
  const auto rounded = [](IndexedMesh mesh) {
    for (Vector3& p : mesh.points) p = (4.0 * p).array().round() / 4.0;  // a mean edge is 0.2
    return mesh;
  };
  EXPECT_EQ(report_of(remesh(test::lumpy(4), options)).nodes.self_intersections, 0U);
  options.measures.written = [&](const RemeshResult& result) { return rounded(result.mesh); };
  const RemeshResult result = remesh(test::lumpy(4), options);
  const std::size_t pairs = self_intersections(rounded(result.mesh)).size();
  EXPECT_GT(pairs, 0U);
  EXPECT_EQ(report_of(result).nodes.self_intersections, pairs);
  EXPECT_TRUE(any_holds(result.warnings, std::to_string(pairs) + " pair"));
}

TEST(OnScan, GentleAndBentGrainsGoTheSameWay) {
  std::vector<std::pair<std::string, IndexedMesh>> grains = {{"lumpy", test::lumpy(4)}};
  for (const char* name : {"hook", "C-shape", "mushroom", "crescent"}) {
    grains.emplace_back(name, body(name));
  }
  for (const auto& [name, scan] : grains) {
    const RemeshResult result = remesh(scan, options_of(400), Execution(1));
    expect_valid(result, 400, 0, name);
    EXPECT_EQ(report_of(result).nodes.self_intersections, 0U) << name;
    // Rounding of sums over 800 triangles, and of the way to units of the radius and back.
    EXPECT_NEAR(result.remesh.volume / result.scan.volume, 1.0, 1e-11) << name;
    EXPECT_NEAR(result.remesh.area / result.scan.area, 1.0, 0.03) << name;
    EXPECT_LT(result.quality.edge_ratio.mean, 1.2) << name;
    EXPECT_TRUE(any_holds(report_lines(result), "on the scan: ")) << name;
  }
}

TEST(OnScan, NodesOnTheSurfaceLieOnItAndFittedOnesAreCloser) {
  const IndexedMesh scan = body("hook");
  const MeshDistance to_scan(scan, Execution(1));
  const RemeshResult on = remesh(scan, options_of(300, placed(ScanPlacement::OnSurface)));
  expect_valid(on, 300, 0, "on the surface");
  for (const double d : to_scan.distances(on.mesh.points, Execution(1))) {
    EXPECT_LT(d, 1e-9 * on.input.equivalent_radius);
  }
  const RemeshResult fitted = remesh(scan, options_of(300));
  EXPECT_LT(rms(fitted), 0.8 * rms(on));
}

TEST(OnScan, ALargerEdgeRatioIsCloserToTheScan) {
  const IndexedMesh scan = test::exact_mesh(test::angular_grain(5), test::sphere(4));
  OnScanOptions close;
  close.edge_ratio = 1.4;
  const RemeshResult even = remesh(scan, options_of(300));
  const RemeshResult closer = remesh(scan, options_of(300, close));
  expect_valid(closer, 300, 0, "close");
  EXPECT_LT(rms(closer), 0.95 * rms(even));
  EXPECT_GT(closer.quality.edge_ratio.mean, even.quality.edge_ratio.mean + 0.1);
}

TEST(OnScan, ContactFitKeepsTheMeshAndLiesFartherOut) {
  for (const char* name : {"hook", "mushroom"}) {
    const RemeshResult fitted = remesh(body(name), options_of(400), Execution(2));
    const RemeshResult contact =
        remesh(body(name), options_of(400, placed(ScanPlacement::ContactFit)), Execution(2));
    expect_valid(contact, 400, 0, name);
    EXPECT_EQ(contact.mesh.triangles, fitted.mesh.triangles) << name;
    EXPECT_GT(contact.remesh.volume, 1.001 * fitted.remesh.volume) << name;
    EXPECT_LT(contact.remesh.volume, 1.1 * fitted.remesh.volume) << name;
  }
}

TEST(OnScan, CurvatureWeightingsGatherNodesWhereItBends) {
  // The ends of a long ellipsoid.
  const IndexedMesh scan = test::scaled(test::sphere(5), Vector3(2.5, 1.0, 1.0));
  const auto at_the_ends = [&](CellWeighting weighting) {
    OnScanOptions on_scan;
    on_scan.weighting = weighting;
    const RemeshResult result = remesh(scan, options_of(400, on_scan), Execution(1));
    expect_valid(result, 400, 0, "ellipsoid");
    return std::count_if(result.mesh.points.begin(), result.mesh.points.end(),
                         [](const Vector3& p) { return std::abs(p.x()) > 2.0; });
  };
  const auto even = at_the_ends(CellWeighting::Area);
  EXPECT_GT(at_the_ends(CellWeighting::Curvature), 1.1 * static_cast<double>(even));
}

TEST(OnScan, SameBytesOnAnyNumberOfThreads) {
  for (const auto& weighting : enumerators<CellWeighting>()) {
    OnScanOptions on_scan;
    on_scan.weighting = weighting.value;
    RemeshOptions options = options_of(300, on_scan);
    options.measures.distances = true;
    options.measures.node_curvatures = true;
    const RemeshResult one = remesh(body("mushroom"), options, Execution(1));
    const RemeshResult three = remesh(body("mushroom"), options, Execution(3));
    EXPECT_EQ(one.mesh.points, three.mesh.points) << weighting.label;
    EXPECT_EQ(one.mesh.triangles, three.mesh.triangles) << weighting.label;
    EXPECT_EQ(one.cell_areas, three.cell_areas) << weighting.label;
    EXPECT_EQ(report_json(one), report_json(three)) << weighting.label;
  }
}

TEST(OnScan, NoisyHandlesAreCutAndTold) {
  for (const IndexedMesh& mesh : {test::ball_with_a_bridge(), test::ball_with_a_tunnel()}) {
    const RemeshResult result = remesh(mesh, options_of(300), Execution(1));
    expect_valid(result, 300, 0, "a ball with a handle");
    EXPECT_EQ(result.input.genus, 1);
    ASSERT_EQ(report_of(result).handles.cut.size(), 1U);
    EXPECT_TRUE(any_holds(result.warnings, "1 handle of the scan was cut"));
    EXPECT_TRUE(any_holds(report_lines(result), "1 handle cut and closed"));
    // The volume that is kept is that of the scan without its handle.
    EXPECT_NEAR(result.remesh.volume / result.input.volume, 1.0, 1e-11);
  }
}

TEST(OnScan, HandlesAreKeptOrRefusedWhereAskedFor) {
  const IndexedMesh drilled = test::ball_with_a_tunnel();
  OnScanOptions on_scan;
  on_scan.handles.action = HandleAction::Keep;
  OnScanOptions without_limit;
  without_limit.handles.length_limit = 0.0;
  for (const OnScanOptions& options : {on_scan, without_limit}) {
    const RemeshResult kept = remesh(drilled, options_of(500, options), Execution(1));
    expect_valid(kept, 500, 1, "kept");
    EXPECT_EQ(report_of(kept).handles.kept, 1);
    EXPECT_TRUE(report_of(kept).handles.cut.empty());
    EXPECT_TRUE(any_holds(kept.warnings, "has 1 handle"));
    EXPECT_TRUE(any_holds(report_lines(kept), "1 kept"));
  }
  on_scan.handles.action = HandleAction::Refuse;
  const std::string sentence = test::refusal(
      ErrorCode::InvalidInput, [&] { remesh(drilled, options_of(500, on_scan), Execution(1)); });
  EXPECT_TRUE(test::holds(sentence, "--handles cut or --handles keep"));
}

TEST(OnScan, ARingStaysARing) {
  const IndexedMesh ring = test::torus(1.0, 0.4, 24);
  const RemeshResult result = remesh(ring, options_of(400), Execution(1));
  expect_valid(result, 400, 1, "a ring");
  EXPECT_EQ(report_of(result).handles.kept, 1);
  EXPECT_NEAR(result.remesh.volume / result.scan.volume, 1.0, 1e-11);
  EXPECT_TRUE(any_holds(report_lines(result), "1 kept"));
  OnScanOptions cut_open;
  cut_open.handles.length_limit = 3.0;
  const RemeshResult cut = remesh(ring, options_of(400, cut_open), Execution(1));
  expect_valid(cut, 400, 0, "a ring cut open");
  EXPECT_EQ(report_of(cut).handles.cut.size(), 1U);
}

TEST(OnScan, TheSeriesIsFittedToTheScanAsItIsRemeshed) {
  RemeshOptions options = options_of(100);
  options.degree = 8;
  EXPECT_TRUE(remesh(test::lumpy(4), options, Execution(1)).coefficients.radius.empty());
  options.measures.series = radial_coefficients;
  const RemeshResult gentle = remesh(test::lumpy(4), options, Execution(1));
  ASSERT_EQ(gentle.coefficients.radius.size(), 81U);
  // Degree 8 leaves less than 1 % of the volume of these lumps.
  EXPECT_NEAR(integrate(HarmonicSurface(gentle.coefficients.radius), Execution(1)).volume /
                  gentle.scan.volume,
              1.0, 0.01);
  // Rays do not see all of a hook.
  EXPECT_TRUE(remesh(body("hook"), options, Execution(1)).coefficients.radius.empty());
}

TEST(OnScan, ASurfaceFromAFormulaIsSampledAndItsNodesLieOnIt) {
  const Ellipsoid ellipsoid(Vector3(13.0, 9.0, 7.0));
  const RemeshResult on =
      remesh(ellipsoid, options_of(500, placed(ScanPlacement::OnSurface)), Execution(1));
  expect_valid(on, 500, 0, "on the surface");
  for (std::size_t i = 0; i < on.directions.size(); ++i) {
    EXPECT_NEAR(on.radial_distances[i], ellipsoid.radius(on.directions[i]), 1e-12);
  }
  EXPECT_NEAR(on.scan.volume / (4.0 / 3.0 * test::pi * 13.0 * 9.0 * 7.0), 1.0, 1e-10);
  const RemeshResult fitted = remesh(ellipsoid, options_of(500), Execution(1));
  // Not that of the samples' facets, which is 5e-5 less.
  EXPECT_NEAR(fitted.remesh.volume / fitted.scan.volume, 1.0, 1e-11);
}

TEST(OnScan, CellsCoverTheRemeshAndTheRatioIsIts) {
  const Superellipsoid formula(Vector3(1.0, 0.8, 0.6), 0.7, 0.8);
  for (const ScanPlacement placement :
       {ScanPlacement::Fitted, ScanPlacement::OnSurface, ScanPlacement::ContactFit}) {
    const OnScanOptions on_scan = placed(placement);
    for (const RemeshResult& result : {remesh(formula, options_of(60, on_scan), Execution(1)),
                                       remesh(body("hook"), options_of(150, on_scan))}) {
      SCOPED_TRACE(key_of(placement));
      const double cells = std::accumulate(result.cell_areas.begin(), result.cell_areas.end(), 0.0);
      // Sums of some hundred areas, in different orders.
      EXPECT_NEAR(cells / result.remesh.area, 1.0, 1e-12);
      EXPECT_NEAR(report_of(result).nodes.mean_edge_ratio, result.quality.edge_ratio.mean, 1e-12);
    }
  }
}

TEST(OnScan, WhatIsNotAccurateIsSaidWithWhatHelps) {
  const IndexedMesh mushroom = body("mushroom");
  const RemeshResult few = remesh(mushroom, options_of(100));
  ASSERT_TRUE(is_inaccurate(few));
  EXPECT_TRUE(any_holds(few.warnings, "not accurate: rms distance"));
  EXPECT_TRUE(any_holds(few.warnings, "--edge-ratio 1.4"));
  // Followed, each of the two helps.
  OnScanOptions closer;
  closer.edge_ratio = 1.4;
  EXPECT_LT(rms(remesh(mushroom, options_of(100, closer))), 0.7 * rms(few));
  EXPECT_LT(rms(remesh(mushroom, options_of(300))), 0.7 * rms(few));
  // As published on a body of fine detail the other method helps.
  const IndexedMesh box = test::subdivided(test::box(1.0, 1.1, 1.3), 6);
  RemeshOptions published = options_of(60);
  published.method = AsPublishedOptions();
  published.degree = 4;
  EXPECT_TRUE(any_holds(remesh(box, published).warnings, "or --method on-scan"));
  EXPECT_FALSE(is_inaccurate(remesh(box, options_of(800))));
}

TEST(OnScan, AContactFitThatBlowsUpAGrainIsTold) {
  const IndexedMesh plate = test::subdivided(test::box(3.0, 2.7, 0.1), 5);
  OnScanOptions contacts;
  contacts.placement = ScanPlacement::ContactFit;
  const RemeshResult few = remesh(plate, options_of(150, contacts));
  ASSERT_GT(few.remesh.volume, 1.2 * few.scan.volume);
  EXPECT_TRUE(any_holds(few.warnings, "volume error +"));
  // Each of the two ways helps.
  EXPECT_FALSE(any_holds(remesh(plate, options_of(3000, contacts)).warnings, "volume error +"));
  EXPECT_NEAR(remesh(plate, options_of(150)).remesh.volume / few.scan.volume, 1.0, 1e-9);
}

TEST(OnScan, TheDistanceToldIsTheLargerOfBothWaysWithTheLargestBesideIt) {
  const IndexedMesh mushroom = body("mushroom");
  RemeshOptions options = options_of(200);
  const RemeshResult told = remesh(mushroom, options);
  options.measures.distances = true;
  const RemeshResult measured = remesh(mushroom, options);
  ASSERT_TRUE(measured.distances);
  EXPECT_EQ(measured.rms_distance, measured.distances->root_mean_square);
  EXPECT_EQ(measured.largest_distance, measured.distances->largest);
  // 5,000 points of each against 100,000 others: some per cent. Both have the vertices, where a
  // scan has its corners.
  EXPECT_NEAR(told.rms_distance / measured.rms_distance, 1.0, 0.05);
  EXPECT_LE(told.largest_distance, 1.05 * measured.largest_distance);
  const std::vector<double> corners =
      MeshDistance(told.mesh).distances(mushroom.points, Execution(1));
  EXPECT_GE(told.largest_distance,
            *std::max_element(corners.begin(), corners.end()) * (1.0 - 1e-9));
}

TEST(OnScan, TheLargestDistanceAloneIsInaccurateToo) {
  RemeshResult result = remesh(body("hook"), options_of(1500));
  ASSERT_FALSE(is_inaccurate(result));
  result.largest_distance = 0.051 * result.input.equivalent_radius;
  EXPECT_TRUE(is_inaccurate(result));
  EXPECT_TRUE(any_holds(remesh_warnings(result, ""), "largest 5.1 %, area error"));
}

TEST(OnScan, MoreNodesThanTheScanHasVerticesAreTold) {
  const IndexedMesh ball = test::sphere(2);  // 162
  EXPECT_TRUE(
      any_holds(remesh(ball, options_of(163)).warnings, "The scan has 162 vertices, fewer"));
  EXPECT_FALSE(any_holds(remesh(ball, options_of(162)).warnings, "no such detail"));
}

TEST(OnScan, AScanThatMeetsItselfIsToldAShrinkWrapThatWasTried) {
  // A ball whose one side is pushed through the other.
  IndexedMesh ball = test::sphere(4);
  for (Vector3& p : ball.points) {
    const double pushed = std::exp(-3.0 * (p - Vector3::UnitZ()).squaredNorm());
    p.z() -= 2.3 * pushed;
  }
  const RemeshResult result = remesh(ball, options_of(1000));
  ASSERT_GT(report_of(result).nodes.self_intersections, 0u);
  ASSERT_GT(report_of(result).nodes.scan_self_intersections, 0u);
  ASSERT_GT(result.clean_wrap_percent, 0.0);
  EXPECT_TRUE(any_holds(result.warnings, "Its shrink-wrap was tried"));
  RemeshOptions followed = options_of(1000);
  followed.shrink_wrap.opening_percent = result.clean_wrap_percent;
  EXPECT_EQ(report_of(remesh(ball, followed)).nodes.self_intersections, 0u);
}

TEST(OnScan, FewNodesOfAScanThatMeetsItselfAreNotRefusedForMore) {
  // With 750 nodes, triangles of its remesh happen not to intersect.
  IndexedMesh dented = test::lumpy(3);
  const Vector3 place = dented.points[100];
  for (Vector3& p : dented.points) {
    if ((p - place).norm() < 0.2) p *= -0.6;
  }
  const RemeshResult result = remesh(dented, options_of(150));
  EXPECT_EQ(result.mesh.points.size(), 150U);
  EXPECT_GT(report_of(result).nodes.self_intersections, 0U);
  EXPECT_TRUE(any_holds(result.warnings, "Its shrink-wrap was tried"));
}

TEST(OnScan, AsPublishedOfAPlateIsCalledAnotherBodyFirst) {
  const IndexedMesh plate = test::scaled(test::sphere(4), Vector3(1.0, 1.0, 0.02));
  RemeshOptions published = options_of(300);
  published.method = AsPublishedOptions();
  const RemeshResult result = remesh(plate, published);
  ASSERT_GT(std::abs(result.remesh.area / result.scan.area - 1.0), 0.2);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_TRUE(test::holds(result.warnings.front().text(), "another body: its area is"));
  EXPECT_FALSE(any_holds(remesh(plate, options_of(300)).warnings, "another body"));
}

// The steps' area is not the grain's, so a remesh that misses them is not inaccurate.
TEST(OnScan, AScanInVoxelStepsIsToldAsSuchAndIsNotCalledInaccurate) {
  const double radius = 12.0;
  const IndexedMesh steps =
      test::voxel_ellipsoid(Vector3::Constant(radius), Vector3(13.1, 12.7, 13.4), 27);
  const RemeshResult result = remesh(steps, options_of(300));
  EXPECT_TRUE(any_holds(result.warnings, "The scan is made of the faces of voxels"));
  EXPECT_FALSE(any_holds(result.warnings, "not accurate"));
  // The reason: a ball's steps have 1.5 times its area, the remesh is nearer to it than half way.
  const double area = 4.0 * test::pi * radius * radius;
  EXPECT_GT(result.scan.area, 1.4 * area);
  EXPECT_LT(result.remesh.area, 1.2 * area);
}

}  // namespace
}  // namespace wscvt
