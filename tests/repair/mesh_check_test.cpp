// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/mesh_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <regex>
#include <set>
#include <string>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "support/voxel_body.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/new_surface.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/repair/stray_vertex.h"
#include "wscvt/repair/weld.h"

namespace wscvt {
namespace {

using test::bad_edges;
using test::box;
using test::holds;
using test::joined;
using test::moved;
using test::sphere;
using test::torus;
using test::transformed;
using test::unwelded;

CheckedMesh check(const IndexedMesh& mesh, int threads = 1) {
  return check_mesh(mesh, MeshCheckOptions(), Execution(threads));
}

/// The limit that a refusal says to raise it above.
double advised_limit(const std::string& sentence) {
  const std::string before = "--max-repaired-area to ";
  const std::size_t place = sentence.find(before);
  EXPECT_NE(place, std::string::npos) << sentence;
  return place == std::string::npos ? 0.0 : std::stod(sentence.substr(place + before.size()));
}

/// The sentence of the refusal; empty when the mesh was taken.
std::string refusal(const IndexedMesh& mesh, const MeshCheckOptions& options = MeshCheckOptions()) {
  return test::refusal(ErrorCode::InvalidInput, [&] { check_mesh(mesh, options, Execution(1)); });
}

void expect_mentions(const std::string& sentence, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_TRUE(holds(sentence, part));
  }
}

TEST(MeshCheck, LeavesACleanMeshAsItIs) {
  const IndexedMesh mesh = sphere(3);
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.mesh.triangles, mesh.triangles);
  EXPECT_EQ(checked.mesh.points, mesh.points);
  const MeshCheckReport& report = checked.report;
  EXPECT_EQ(report.input_vertices, mesh.points.size());
  EXPECT_EQ(report.input_faces, mesh.triangles.size());
  EXPECT_EQ(report.vertices, mesh.points.size());
  EXPECT_EQ(report.faces, mesh.triangles.size());
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.welded_vertices + report.unreferenced_vertices + report.degenerate_faces +
                report.sliver_faces + report.duplicate_faces + report.reoriented_faces +
                report.split_vertices + report.dropped_faces,
            0U);
  EXPECT_EQ(report.dropped_volume_fraction, 0.0);
  EXPECT_EQ(report.genus, 0);
}

TEST(MeshCheck, MeasuresABoxExactly) {
  // One part in 1e14 of a sum of a dozen terms near the grain; a million units away the coordinates
  // themselves carry 1e-10.
  const struct {
    double scale;
    Vector3 offset;
    double tolerance;
  } cases[] = {{1.0, {0, 0, 0}, 1e-14},
               {1e-6, {0, 0, 0}, 1e-14},
               {1e6, {0, 0, 0}, 1e-14},
               {1.0, {1e6, -2e6, 3e6}, 5e-9}};
  for (const auto& c : cases) {
    const IndexedMesh mesh = moved(box(1.0, 2.0, 3.0), c.scale, c.offset);
    const MeshCheckReport report = check(mesh).report;
    const double volume = 6.0 * std::pow(c.scale, 3);
    EXPECT_NEAR(report.volume, volume, c.tolerance * volume);
    EXPECT_NEAR(report.area, 22.0 * c.scale * c.scale, c.tolerance * 22.0 * c.scale * c.scale);
    EXPECT_LT((report.centroid - c.offset).norm(), c.tolerance * c.scale);
    EXPECT_NEAR(report.equivalent_radius, std::cbrt(volume * 3.0 / (4.0 * test::pi)),
                c.tolerance * c.scale);
  }
}

TEST(MeshCheck, WeldsASoup) {
  const IndexedMesh mesh = sphere(2);
  const CheckedMesh checked = check(unwelded(mesh));
  EXPECT_EQ(checked.report.welded_vertices, 3 * mesh.triangles.size() - mesh.points.size());
  EXPECT_EQ(checked.report.vertices, mesh.points.size());
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
}

TEST(MeshCheck, WeldsMinusZeroToZero) {
  IndexedMesh soup = unwelded(moved(box(2, 2, 2), 1.0, {1, 1, 1}));
  for (std::size_t i = 0; i < soup.points.size(); i += 2) {
    for (int k = 0; k < 3; ++k) {
      if (soup.points[i][k] == 0.0) soup.points[i][k] = -0.0;
    }
  }
  EXPECT_EQ(check(soup).report.vertices, 8U);
}

TEST(MeshCheck, WeldsWithinATolerance) {
  // Every corner of the soup a little off, as the poles of published asteroids are.
  const IndexedMesh mesh = sphere(3);
  IndexedMesh soup = unwelded(mesh);
  std::mt19937_64 engine(test::announced(5));
  std::uniform_real_distribution<double> off(-1e-13, 1e-13);
  for (Vector3& p : soup.points) p += Vector3(off(engine), off(engine), off(engine));
  const CheckedMesh checked = check(soup);
  EXPECT_EQ(checked.report.vertices, mesh.points.size());
  EXPECT_EQ(checked.report.welded_vertices, soup.points.size() - mesh.points.size());
  EXPECT_NEAR(checked.report.weld_tolerance, 1e-12 * std::sqrt(12.0), 2e-13);  // of the box
  EXPECT_EQ(checked.report.genus, 0);

  // Exact copies only, if told so; then no two faces hang together.
  MeshCheckOptions options;
  options.weld_tolerance = 0.0;
  EXPECT_NE(refusal(soup, options), "");
  EXPECT_EQ(refusal(unwelded(mesh), options), "");

  // Wider, if told so.
  for (Vector3& p : soup.points) p += 1e9 * Vector3(off(engine), off(engine), off(engine));
  EXPECT_NE(refusal(soup), "");
  options.weld_tolerance = 1e-4;
  EXPECT_EQ(check_mesh(soup, options, Execution(2)).report.vertices, mesh.points.size());
}

TEST(MeshCheck, MeasuresTheToleranceOnTheFaces) {
  // A vertex of no face a long way off would weld the whole grain.
  IndexedMesh mesh = sphere(3);
  mesh.points.emplace_back(1e13, -1e13, 0);
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.welded_vertices, 0U);
  EXPECT_EQ(checked.report.unreferenced_vertices, 1U);
  EXPECT_LT(checked.report.weld_tolerance, 1e-11);
}

TEST(MeshCheck, DropsWhatHasNoFace) {
  IndexedMesh mesh = box(1, 1, 1);
  mesh.points.insert(mesh.points.begin(), Vector3(9, 9, 9));
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) ++v;
  }
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.unreferenced_vertices, 1U);
  EXPECT_EQ(checked.mesh.points, box(1, 1, 1).points);
  EXPECT_EQ(checked.mesh.triangles, box(1, 1, 1).triangles);
}

TEST(MeshCheck, DropsFacesWithEqualCorners) {
  IndexedMesh mesh = box(1, 1, 1);
  mesh.triangles.push_back({3, 3, 5});
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.degenerate_faces, 1U);
  EXPECT_EQ(checked.report.faces, 12U);
}

TEST(MeshCheck, KeepsSliversThatCloseTheSurface) {
  // A vertex in the middle of the edge 0-1, joined up on one side only: the other side is closed by
  // a face whose three corners lie on a line.
  IndexedMesh mesh = box(2, 2, 2);
  mesh.points.emplace_back(0, -1, -1);
  for (Triangle& t : mesh.triangles) {
    if (t == Triangle{0, 3, 1}) t = {0, 3, 8};
  }
  mesh.triangles.push_back({8, 3, 1});
  mesh.triangles.push_back({0, 8, 1});
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.sliver_faces, 1U);
  EXPECT_EQ(checked.report.faces, 14U);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_NEAR(checked.report.volume, 8.0, 1e-13);
}

TEST(MeshCheck, DropsDoubledFaces) {
  IndexedMesh mesh = box(1, 1, 1);
  mesh.triangles.push_back(mesh.triangles[4]);
  mesh.triangles.push_back({mesh.triangles[7][1], mesh.triangles[7][0], mesh.triangles[7][2]});
  CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.duplicate_faces, 2U);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);

  // Every face twice, as exported for display from both sides.
  mesh = box(1, 1, 1);
  for (std::size_t f = 0; f < 12; ++f) {
    const Triangle t = mesh.triangles[f];
    mesh.triangles.push_back({t[0], t[2], t[1]});
  }
  checked = check(mesh);
  EXPECT_EQ(checked.report.duplicate_faces, 12U);
  EXPECT_NEAR(checked.report.duplicate_area_fraction, 1.0, 1e-14);
  EXPECT_EQ(checked.report.faces, 12U);
  EXPECT_NEAR(checked.report.volume, 1.0, 1e-14);
}

TEST(MeshCheck, DropsAFoldedFlapWhole) {
  // Two faces on the same corners stand on an edge that the surface closes without them.
  IndexedMesh mesh = box(1, 1, 1);
  mesh.points.emplace_back(0, 0, 9);
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({1, 0, 8});
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.duplicate_faces, 0U);
  EXPECT_EQ(checked.report.back_to_back_faces, 2U);
  EXPECT_NEAR(checked.report.back_to_back_area_fraction, std::hypot(0.5, 9.5) / 6.0, 1e-14);
  EXPECT_EQ(checked.report.faces, 12U);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
}

TEST(MeshCheck, TurnsFacesOutward) {
  IndexedMesh inside_out = sphere(2);
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  CheckedMesh checked = check(inside_out);
  EXPECT_EQ(checked.report.reoriented_faces, inside_out.triangles.size());
  EXPECT_GT(checked.report.volume, 0.0);

  IndexedMesh mixed = sphere(2);
  std::size_t turned = 0;
  for (std::size_t f = 0; f < mixed.triangles.size(); f += 3, ++turned) {
    std::swap(mixed.triangles[f][1], mixed.triangles[f][2]);
  }
  checked = check(mixed);
  EXPECT_EQ(checked.report.reoriented_faces, turned);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_EQ(checked.report.volume, check(sphere(2)).report.volume);
}

TEST(MeshCheck, CountsHandles) {
  const MeshCheckReport report = check(torus(3.0, 1.0, 40)).report;
  EXPECT_EQ(report.genus, 1);
  // Chords of 40 segments: the volume of 2 pi^2 R r^2 less about pi^2 / 3 (2 / 40)^2 4, one
  // percent.
  EXPECT_NEAR(report.volume, 6.0 * test::pi * test::pi, 0.015 * 6.0 * test::pi * test::pi);
}

TEST(MeshCheck, KeepsTheMainBodyAndSaysWhatItDropped) {
  // A crumb, a pore (facing inward) and an open scrap.
  IndexedMesh crumb = moved(box(1, 1, 1), 0.2, {5, 0, 0});
  IndexedMesh pore = moved(sphere(1), 0.1, {0.2, 0, 0});
  for (Triangle& t : pore.triangles) std::swap(t[0], t[1]);
  const IndexedMesh scrap{{{3, 0, 0}, {4, 0, 0}, {3, 1, 0}}, {{0, 1, 2}}};
  const IndexedMesh body = sphere(3);
  const CheckedMesh checked = check(joined(joined(crumb, joined(pore, body)), scrap));
  EXPECT_EQ(checked.report.components, 4U);
  EXPECT_EQ(checked.report.dropped_faces, 12U + 80U + 1U);
  EXPECT_EQ(checked.mesh.points, body.points);
  EXPECT_EQ(checked.mesh.triangles, body.triangles);
  const double whole = check(body).report.volume;
  EXPECT_NEAR(checked.report.dropped_volume_fraction, 0.008 / (whole + 0.008), 1e-12);
  EXPECT_EQ(checked.report.inner_components, 1U);
  const double hollow = check(moved(sphere(1), 0.1, {0, 0, 0})).report.volume;
  EXPECT_NEAR(checked.report.inner_volume_fraction, hollow / whole, 1e-12);
}

TEST(MeshCheck, SplitsAVertexWhereTheSurfaceTouchesItself) {
  // The torus is pinched: one vertex of the outer rim becomes one of the opposite side, so that two
  // fans meet in it.
  IndexedMesh mesh = torus(3.0, 1.0, 12);
  const std::int32_t here = 0;
  const std::int32_t there = 6 * 12 + 6;
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) v = v == there ? here : v;
  }
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.split_vertices, 1U);
  EXPECT_EQ(checked.report.unreferenced_vertices, 1U);
  EXPECT_EQ(checked.report.vertices, 144U);
  EXPECT_EQ(checked.report.genus, 1);
  EXPECT_NO_THROW(to_mesh(checked.mesh));  // OpenMesh refuses such vertices
}

TEST(MeshCheck, TakesPartsThatTouchInAVertexApart) {
  // The crumb shares a vertex with the body: still two components.
  const IndexedMesh mesh = joined(box(2, 2, 2), moved(box(2, 2, 2), 0.25, {1.25, 1.25, 1.25}));
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.welded_vertices, 1U);
  EXPECT_EQ(checked.report.components, 2U);
  EXPECT_EQ(checked.report.split_vertices, 0U);
  EXPECT_EQ(checked.report.vertices, 8U);
}

TEST(MeshCheck, GivesTheSameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = unwelded(test::lumpy(5));
  const CheckedMesh one = check(mesh, 1);
  const CheckedMesh two = check(mesh, 2);
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.report.volume, two.report.volume);
  EXPECT_EQ(one.report.area, two.report.area);
  EXPECT_EQ(one.report.centroid, two.report.centroid);
}

TEST(MeshCheck, DoesNotDependOnTheOrderOfVerticesAndFaces) {
  const MeshCheckReport plain = check(test::lumpy(3)).report;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const CheckedMesh shuffled = check(test::shuffled(test::lumpy(3), seed));
    EXPECT_EQ(bad_edges(shuffled.mesh), 0U);
    // Sums of 1280 terms in another order.
    EXPECT_NEAR(shuffled.report.volume, plain.volume, 1e-12);
    EXPECT_NEAR(shuffled.report.area, plain.area, 1e-12);
    EXPECT_LT((shuffled.report.centroid - plain.centroid).norm(), 1e-12);
  }
}

TEST(MeshCheck, RefusesWhatEnclosesNothing) {
  expect_mentions(refusal({}), {"empty"});
  expect_mentions(refusal({{{0, 0, 0}, {1, 0, 0}}, {}}), {"2 vertices", "no faces"});
  expect_mentions(refusal({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}), {"1 face", "one place"});

  // Flat, near and far: a square of four vertices, covered on both sides along either diagonal.
  const IndexedMesh flat{{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}},
                         {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  expect_mentions(refusal(flat), {"no volume", "flat"});
  // Where single precision comes in steps of a quarter it may have been its rounding.
  const Vector3 far(1e6, 2e6, -3e6);
  expect_mentions(refusal(moved(flat, 1.0, far)), {"no volume", "single precision"});
}

TEST(MeshCheck, DropsFacesWithoutAFinitePositionAndClosesTheHole) {
  const double infinity = std::numeric_limits<double>::infinity();
  const IndexedMesh whole = sphere(3);
  for (const double value : {std::nan(""), infinity, -infinity}) {
    IndexedMesh mesh = whole;
    mesh.points[77].y() = value;
    const CheckedMesh checked = check(mesh);
    EXPECT_EQ(checked.report.lost_faces, 6U);
    EXPECT_EQ(checked.report.filled_holes, 1U);
    EXPECT_EQ(checked.report.filling_faces, 4U);  // of a hexagon
    EXPECT_EQ(bad_edges(checked.mesh), 0U);
    EXPECT_EQ(checked.report.vertices, whole.points.size() - 1);
    for (Vector3& point : mesh.points) point.x() = value;
    expect_mentions(refusal(mesh), {"All faces", "vertex 0", "finite"});
  }
}

TEST(MeshCheck, RefusesIndicesOutOfRange) {
  for (const std::int32_t v : {-1, 8}) {
    IndexedMesh mesh = box(1, 1, 1);
    mesh.triangles[5][1] = v;
    expect_mentions(refusal(mesh), {"Face 5", std::to_string(v), "has 8"});
  }
}

TEST(MeshCheck, FillsSmallHoles) {
  IndexedMesh mesh = sphere(3);
  const double whole = check(mesh).report.area;
  mesh.triangles.pop_back();
  mesh.triangles.erase(mesh.triangles.begin() + 100, mesh.triangles.begin() + 104);
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(checked.report.filled_holes, 2U);
  EXPECT_EQ(checked.report.filling_faces, 5U);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_EQ(checked.report.genus, 0);
  EXPECT_EQ(checked.report.reoriented_faces, 0U);
  EXPECT_NEAR(checked.report.area, whole, 1e-3 * whole);
  EXPECT_NEAR(checked.report.filled_area_fraction, 5.0 / 1280.0, 1e-3);
}

TEST(MeshCheck, RefusesLargeHolesUntilToldToFillThem) {
  // Half a sphere: the hole is a disc of half its area.
  IndexedMesh mesh = sphere(4);
  const auto lower = [&](const Triangle& t) {
    return mesh.points[t[0]].z() + mesh.points[t[1]].z() + mesh.points[t[2]].z() < 0.0;
  };
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), lower),
                       mesh.triangles.end());
  const std::string sentence = refusal(mesh);
  expect_mentions(sentence, {"boundary edges around", "(limit 5 %)", "Raise --max-repaired-area"});
  MeshCheckOptions options;
  const double advised = advised_limit(sentence);
  EXPECT_LT(advised, 36.0);
  // Just below the area, the sentence tells the two apart, and advises the same.
  options.repaired_area_limit_percent = advised - 0.1;
  for (const double step : {0.01, 0.001, 1e-4}) {
    while (!refusal(mesh, options).empty()) options.repaired_area_limit_percent += step;
    options.repaired_area_limit_percent -= step;
    const std::string close = refusal(mesh, options);
    EXPECT_EQ(advised_limit(close), advised) << close;
    const std::string value = "would change ";
    const std::string limit = "(limit ";
    EXPECT_GT(std::stod(close.substr(close.find(value) + value.size())),
              std::stod(close.substr(close.find(limit) + limit.size())))
        << close;
  }
  options.repaired_area_limit_percent = advised;
  const CheckedMesh checked = check_mesh(mesh, options, Execution(1));
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_EQ(checked.report.genus, 0);
  EXPECT_NEAR(checked.report.filled_area_fraction, 1.0 / 3.0, 0.02);
  // The rim runs up and down about the equator by half a row of faces, 0.04.
  EXPECT_NEAR(checked.report.volume, 2.0 * test::pi / 3.0, 0.04 * test::pi);
}

TEST(MeshCheck, NamesTheDistanceThatClosesASeam) {
  // Two halves with corners of their own, too far apart to be merged unasked.
  const IndexedMesh ball = sphere(4);
  IndexedMesh halves[2];
  for (const Triangle& t : ball.triangles) {
    const bool upper = ball.points[t[0]].z() + ball.points[t[1]].z() + ball.points[t[2]].z() > 0;
    halves[upper ? 1 : 0].triangles.push_back(t);
  }
  halves[0].points = halves[1].points = ball.points;
  for (Vector3& p : halves[1].points) p += Vector3::Constant(1e-5);
  const IndexedMesh open = joined(halves[0], halves[1]);
  for (const double limit : {5.0, 100.0}) {
    MeshCheckOptions options;
    options.repaired_area_limit_percent = limit;
    const std::string sentence = refusal(open, options);
    expect_mentions(sentence, {"Merge Close Vertices", "--shrink-wrap"});
    std::smatch named;
    ASSERT_TRUE(std::regex_search(sentence, named, std::regex("distance of ([0-9.e-]+[0-9])")))
        << sentence;
    IndexedMesh merged = open;
    const Weld weld =
        find_equal_points(merged.points, box_of_faces(merged), std::stod(named[1]), Execution(1));
    for (Triangle& t : merged.triangles) {
      for (std::int32_t& v : t) v = weld.first[static_cast<std::size_t>(v)];
    }
    EXPECT_NEAR(check(merged).report.volume, check(ball).report.volume, 1e-3);
  }
}

/// A ball without its cap above a height.
IndexedMesh without_cap(double height) {
  IndexedMesh mesh = sphere(4);
  const auto in_cap = [&](const Triangle& t) {
    return mesh.points[t[0]].z() + mesh.points[t[1]].z() + mesh.points[t[2]].z() > 3.0 * height;
  };
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), in_cap),
                       mesh.triangles.end());
  return mesh;
}

/// The opening of the shrink-wrap that a refusal names; 0 if it names none.
double opening_for(const IndexedMesh& mesh, const MeshCheckOptions& options = {}) {
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { check_mesh(mesh, options, Execution(1)); });
  std::smatch named;
  return std::regex_search(sentence, named, std::regex("--shrink-wrap ([0-9.]+)"))
             ? std::stod(named[1])
             : 0.0;
}

TEST(MeshCheck, NamesAnOpeningThatClosesTheHoles) {
  // A hole .49 wide; the box's diagonal is 3.4.
  MeshCheckOptions options;
  options.repaired_area_limit_percent = 1.0;
  const IndexedMesh small = without_cap(0.97);
  const double percent = opening_for(small, options);
  EXPECT_GT(percent, 0.0);
  EXPECT_LE(percent, coarsest_opening_percent);
  const IndexedMesh closed = shrink_wrap_of(small, {percent}, Execution(1));
  const MeshCheckReport report = check(closed).report;
  EXPECT_EQ(report.genus, 0);
  // Of a hole that is not closed the wrap takes both sides, which is next to no volume.
  EXPECT_NEAR(report.volume, 4.0 * test::pi / 3.0, 0.2 * 4.0 * test::pi / 3.0);
  // Too wide for a wrap.
  EXPECT_EQ(opening_for(without_cap(0.5)), 0.0);
  // The widest hole counts, wherever it stands.
  IndexedMesh two = small;
  two.triangles.erase(two.triangles.begin() + 9);
  EXPECT_EQ(opening_for(two, options), percent);
  std::reverse(two.points.begin(), two.points.end());
  for (Triangle& t : two.triangles) {
    for (std::int32_t& v : t) v = static_cast<std::int32_t>(two.points.size()) - 1 - v;
  }
  std::reverse(two.triangles.begin(), two.triangles.end());
  EXPECT_EQ(opening_for(two, options), percent);
}

TEST(MeshCheck, CountsTheFacesTurnedOfAnOpenScan) {
  IndexedMesh open = sphere(2);
  open.triangles.pop_back();
  for (std::size_t f = 0; f < open.triangles.size(); ++f) {
    if (f % 5 != 0) std::swap(open.triangles[f][0], open.triangles[f][1]);
  }
  const std::size_t outward = (open.triangles.size() + 4) / 5;
  EXPECT_EQ(check(open).report.reoriented_faces, open.triangles.size() - outward);
  for (Triangle& t : open.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(check(open).report.reoriented_faces, outward);
}

TEST(MeshCheck, TellsWeldedVerticesFromThoseWithoutAFace) {
  IndexedMesh soup = test::unwelded(sphere(1));
  const std::size_t corners = soup.points.size();
  soup.points.insert(soup.points.end(), 2, Vector3(0.1, 0.2, 0.3));
  soup.points.emplace_back(0.3, 0.2, 0.1);
  const MeshCheckReport report = check(soup).report;
  EXPECT_EQ(report.welded_vertices, corners - sphere(1).points.size() + 1);
  EXPECT_EQ(report.unreferenced_vertices, 2U);
}

TEST(MeshCheck, ClosesAnySurfaceWithFacesMissing) {
  // Rims of all shapes, that touch themselves and each other, and crumbs of a few faces between.
  const std::uint64_t first = test::announced(20261121);
  for (std::uint64_t seed = first; seed < first + 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    IndexedMesh mesh = seed % 2 == 0 ? sphere(2) : test::lumpy(2);
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), engine);
    mesh.triangles.resize(mesh.triangles.size() - 1 - engine() % 160);
    for (Triangle& t : mesh.triangles) {
      if (seed % 3 == 0 && engine() % 2 == 0) std::swap(t[0], t[1]);
    }
    MeshCheckOptions options;
    options.repaired_area_limit_percent = 100.0;
    options.dropped_volume_limit = 0.999;
    const CheckedMesh checked = check_mesh(mesh, options, Execution(1));
    EXPECT_EQ(bad_edges(checked.mesh), 0U);
    EXPECT_GE(checked.report.filled_holes, 1U);
    EXPECT_EQ(checked.report.faces,
              mesh.triangles.size() - checked.report.dropped_faces + checked.report.filling_faces);
    EXPECT_NO_THROW(to_mesh(checked.mesh));
    // A second look finds nothing to fill.
    EXPECT_EQ(check(checked.mesh).report.filled_holes, 0U);
  }
}

/// Surface of a set of unit cubes, two faces a square, all outward; corners are shared.
IndexedMesh cubes(const std::set<std::array<int, 3>>& solid) {
  IndexedMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> number;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, added] =
        number.try_emplace(at, static_cast<std::int32_t>(mesh.points.size()));
    if (added) mesh.points.emplace_back(at[0], at[1], at[2]);
    return place->second;
  };
  for (const std::array<int, 3>& cube : solid) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> next = cube;
        next[axis] += side == 1 ? 1 : -1;
        if (solid.count(next) > 0) continue;
        std::array<std::int32_t, 4> corner{};
        for (std::size_t i = 0; i < 4; ++i) {
          std::array<int, 3> at = cube;
          at[axis] += side;
          at[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
          at[(axis + 2) % 3] += i >= 2 ? 1 : 0;
          corner[i] = vertex(at);
        }
        if (side == 0) std::swap(corner[1], corner[3]);
        mesh.triangles.push_back({corner[0], corner[1], corner[2]});
        mesh.triangles.push_back({corner[0], corner[2], corner[3]});
      }
    }
  }
  return mesh;
}

TEST(MeshCheck, TakesCubesApartThatTouchInAnEdge) {
  // A small one beside a large one.
  const IndexedMesh beside = joined(box(2, 2, 2), moved(box(2, 2, 2), 1.0, {2, 2, 0}));
  expect_mentions(refusal(beside), {"2 separate bodies", "50 %", "Split in Connected Components"});

  // Two that touch in an edge and are joined by three above: one body, which touches itself. The
  // edge runs to the joint, so both sheets keep its ends.
  const CheckedMesh checked = check(cubes({{0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}));
  EXPECT_EQ(checked.report.non_manifold_edges, 1U);
  EXPECT_EQ(checked.report.flap_faces, 0U);
  EXPECT_EQ(checked.report.components, 1U);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_NEAR(checked.report.volume, 5.0, 1e-14);
  EXPECT_NO_THROW(to_mesh(checked.mesh));
}

TEST(MeshCheck, FindsTheOuterVolumeOfAnySetOfCubes) {
  // Edges and vertices shared by many, pores, and bodies inside pores; the answer by flooding.
  const std::uint64_t first = test::announced(7);
  for (std::uint64_t seed = first; seed < first + 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    constexpr int size = 5;
    using Cube = std::array<int, 3>;
    std::set<Cube> solid;
    for (int x = 0; x < size; ++x) {
      for (int y = 0; y < size; ++y) {
        for (int z = 0; z < size; ++z) {
          if (engine() % 100 < 30 + 20 * (seed % 3)) solid.insert({x, y, z});
        }
      }
    }
    // All of `from` that `start` reaches through faces, and through edges as well if asked to.
    const auto flood = [](std::set<Cube>& from, const Cube& start, bool through_edges) {
      std::set<Cube> reached = {start};
      std::vector<Cube> stack = {start};
      from.erase(start);
      while (!stack.empty()) {
        const Cube at = stack.back();
        stack.pop_back();
        for (int dx = -1; dx <= 1; ++dx) {
          for (int dy = -1; dy <= 1; ++dy) {
            for (int dz = -1; dz <= 1; ++dz) {
              const int steps = std::abs(dx) + std::abs(dy) + std::abs(dz);
              if (steps > (through_edges ? 2 : 1)) continue;
              const Cube next = {at[0] + dx, at[1] + dy, at[2] + dz};
              if (from.erase(next) == 0) continue;
              reached.insert(next);
              stack.push_back(next);
            }
          }
        }
      }
      return reached;
    };
    // Cubes that touch in an edge are two bodies, so what is around them passes between. The
    // volume inside the outer surface of a body: all that cannot be reached from outside.
    std::size_t largest = 0;
    for (std::set<Cube> rest = solid; !rest.empty();) {
      const std::set<Cube> body = flood(rest, *rest.begin(), false);
      std::set<Cube> around;
      for (int x = -1; x <= size; ++x) {
        for (int y = -1; y <= size; ++y) {
          for (int z = -1; z <= size; ++z) {
            if (body.count({x, y, z}) == 0) around.insert({x, y, z});
          }
        }
      }
      const std::size_t all = around.size();
      const std::size_t outside = flood(around, {-1, -1, -1}, true).size();
      largest = std::max(largest, body.size() + all - outside);
    }
    IndexedMesh mesh = cubes(solid);
    if (seed % 2 == 0) mesh = test::shuffled(unwelded(mesh), seed);
    MeshCheckOptions options;
    options.dropped_volume_limit = 0.999;
    const CheckedMesh checked = check_mesh(mesh, options, Execution(1));
    EXPECT_NEAR(checked.report.volume, static_cast<double>(largest), 1e-12 * 125.0);
    EXPECT_EQ(bad_edges(checked.mesh), 0U);
    EXPECT_EQ(checked.report.flap_faces + checked.report.filled_holes, 0U);
    EXPECT_NO_THROW(to_mesh(checked.mesh));
    // What was taken apart stays apart.
    EXPECT_NEAR(check(checked.mesh).report.volume, checked.report.volume, 1e-10);
  }
}

TEST(MeshCheck, DropsFlapsAndWalls) {
  // A fin on a closed body.
  IndexedMesh fin = box(2, 2, 2);
  fin.points.emplace_back(0, 0, 1.2);
  fin.triangles.push_back({4, 5, 8});
  CheckedMesh checked = check(fin);
  EXPECT_EQ(checked.report.non_manifold_edges, 1U);
  EXPECT_EQ(checked.report.flap_faces, 1U);
  EXPECT_NEAR(checked.report.flap_area_fraction, std::hypot(1.0, 0.2) / 24.0, 1e-14);
  EXPECT_EQ(checked.report.faces, 12U);
  EXPECT_NEAR(checked.report.volume, 8.0, 1e-14);

  // Two boxes on each other, the square between them still there: three faces on each of its edges.
  // The upper one is small, as a flaw of a scan; two grains would be refused.
  IndexedMesh wall = joined(box(1, 1, 6), moved(box(1, 1, 6), 1.0, {0, 0, 6}));
  wall.triangles.erase(wall.triangles.begin() + 2,
                       wall.triangles.begin() + 4);  // one of its copies
  expect_mentions(refusal(wall), {"2 bodies with common walls", "50 %", "wscvt extract MESH OUT"});
  for (Vector3& p : wall.points) p.z() = p.z() > 6.0 ? 3.25 : p.z();
  checked = check(wall);
  EXPECT_EQ(checked.report.welded_vertices, 4U);
  EXPECT_EQ(checked.report.flap_faces, 2U);
  EXPECT_EQ(checked.report.faces, 20U);
  EXPECT_NEAR(checked.report.volume, 6.25, 1e-13);

  // A fin above the limit is not dropped on the quiet, but when told to.
  fin.points.back() = {0, 0, 20};
  const std::string sentence = refusal(fin);
  expect_mentions(sentence, {"1 non-manifold edge,", "Raise --max-repaired-area"});
  MeshCheckOptions options;
  options.repaired_area_limit_percent = 100.0;
  checked = check_mesh(fin, options, Execution(1));
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_NEAR(checked.report.volume, 8.0, 1e-14);
}

TEST(MeshCheck, MergesCornersAlongSeams) {
  const std::uint64_t seed = test::announced(3);
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  const IndexedMesh body = sphere(3);
  IndexedMesh soup = unwelded(body);
  for (Vector3& p : soup.points) p += Vector3(noise(engine), noise(engine), noise(engine));
  const CheckedMesh checked = check(soup);
  EXPECT_EQ(checked.mesh.points.size(), body.points.size());
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_GT(checked.report.merged_corners, 1000U);
  EXPECT_LE(checked.report.merged_distance, 2e-7 * std::sqrt(3.0));
  EXPECT_NEAR(checked.report.volume, check(body).report.volume, 1e-5);
  // Wider seams are not: what to do is said.
  for (Vector3& p : soup.points) p += 1e3 * Vector3(noise(engine), noise(engine), noise(engine));
  expect_mentions(refusal(soup), {"1280 parts without a common edge", "Merge Close Vertices"});
  // Followed, it works. 4e-4 is above the noise of corners and below all edges.
  MeshCheckOptions merging;
  merging.weld_tolerance = 4e-4 / std::sqrt(12.0);
  EXPECT_NEAR(check_mesh(soup, merging, Execution(1)).report.volume, check(body).report.volume,
              1e-2);
}

TEST(MeshCheck, KeepsAHoleBesideAClosedSeam) {
  IndexedMesh body = sphere(3);
  for (std::size_t f = 0; f < body.triangles.size(); ++f) {
    const Triangle& t = body.triangles[f];
    const double z = body.points[static_cast<std::size_t>(t[0])].z() +
                     body.points[static_cast<std::size_t>(t[1])].z() +
                     body.points[static_cast<std::size_t>(t[2])].z();
    if (z < 0.0) continue;
    for (std::int32_t& v : body.triangles[f]) {
      const Vector3 p = body.points[static_cast<std::size_t>(v)] + Vector3(0, 0, 1e-9);
      v = static_cast<std::int32_t>(body.points.size());
      body.points.push_back(p);
    }
  }
  body.triangles.pop_back();
  const CheckedMesh checked = check(body);
  EXPECT_EQ(checked.report.filled_holes, 1U);
  EXPECT_EQ(checked.report.filling_faces, 1U);
}

TEST(MeshCheck, NamesAStrayVertex) {
  for (const double far : {30.0, 100.0, 1e5, 1e9, 1e30, 1e200}) {
    SCOPED_TRACE(far);
    IndexedMesh body = sphere(3);
    body.points[300] *= far;
    const std::string sentence = refusal(body);
    EXPECT_EQ(sentence == "", far == 30.0) << sentence;
    if (far > 30.0) expect_mentions(sentence, {"Vertex 300, counted from 0, lies at (", "Correct"});
    // The square of the farthest distance is no number.
    EXPECT_FALSE(holds(sentence, "inf"));
    EXPECT_EQ(sentence.find(" from its nearest neighbour") != std::string::npos,
              far > 30.0 && far < 1e200)
        << sentence;
  }
  IndexedMesh body = sphere(3);
  body.points[300] *= 20.0;
  MeshCheckOptions lenient;
  const MeshCheckReport report = check_mesh(body, lenient, Execution(1)).report;
  EXPECT_EQ(report.stray_vertex, 300U);
  EXPECT_NEAR(report.stray_distance, 19.0, 0.1);
  EXPECT_EQ(check(sphere(3)).report.stray_distance, 0.0);
  // Nearer ones too, whether the faces are welded or not, and the number of them.
  for (const double far : {0.3, 1.5, 3.0, 6.0}) {
    for (const bool welded : {true, false}) {
      IndexedMesh ball = sphere(5);
      for (const std::size_t v : {1000U, 2000U}) ball.points[v] *= far;
      ball.points[2000] *= 1.01;
      const MeshCheckReport near = check(welded ? ball : unwelded(ball)).report;
      EXPECT_EQ(find_stray_vertex(ball).count, 2U) << far;
      EXPECT_GT(near.stray_distance, 0.0) << far;
      EXPECT_EQ(near.stray_place, ball.points[far < 1.0 ? 1000 : 2000]) << far;
    }
  }
  // The tips of cones are none.
  IndexedMesh cone = test::bicone(32);
  for (Vector3& p : cone.points) p = p.cwiseProduct(Vector3(0.5, 0.5, 2.4));
  EXPECT_EQ(check(cone).report.stray_distance, 0.0);
  // Slender bodies have none.
  EXPECT_EQ(check(box(1000, 1, 1)).report.stray_distance, 0.0);
}

TEST(MeshCheck, TurnsAPatchBetweenNonManifoldEdges) {
  // The cubes that touch themselves in an edge, with all faces of one listed inside out.
  IndexedMesh mesh = cubes({{0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}});
  const double volume = check(mesh).report.volume;
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 3) {
    std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
  }
  const CheckedMesh checked = check(mesh);
  EXPECT_EQ(bad_edges(checked.mesh), 0U);
  EXPECT_NEAR(checked.report.volume, volume, 1e-13);
}

TEST(MeshCheck, TakesTheOuterSurfaceOfHollowBodies) {
  // Shells of 5 % of the radius, facing inward as a pore does, and outward as a nested body does.
  const IndexedMesh outer = sphere(3);
  const double volume = check(outer).report.volume;
  for (const bool inward : {true, false}) {
    IndexedMesh inner = moved(sphere(3), 0.95, {0.01, 0, 0});
    if (inward) {
      for (Triangle& t : inner.triangles) std::swap(t[0], t[1]);
    }
    const CheckedMesh checked = check(joined(inner, outer));
    EXPECT_EQ(checked.mesh.points, outer.points);
    EXPECT_EQ(checked.mesh.triangles, outer.triangles);
    EXPECT_EQ(checked.report.volume, volume);
    EXPECT_EQ(checked.report.inner_components, 1U);
    EXPECT_NEAR(checked.report.inner_volume_fraction, std::pow(0.95, 3), 1e-12);
    EXPECT_EQ(checked.report.dropped_volume_fraction, 0.0);
  }
}

// Whatever vertex comes first: one that is inside the other surface or one that is not.
TEST(MeshCheck, RefusesSurfacesThatCross) {
  const IndexedMesh whole = sphere(3);
  const IndexedMesh other = moved(sphere(3), 0.8, {0.9, 0.1, 0});
  std::vector<std::size_t> order(other.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const double sign : {1.0, -1.0}) {
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return sign * other.points[a].x() < sign * other.points[b].x();
    });
    std::vector<std::int32_t> place(order.size());
    IndexedMesh sorted;
    for (const std::size_t old : order) {
      place[old] = static_cast<std::int32_t>(sorted.points.size());
      sorted.points.push_back(other.points[old]);
    }
    for (const Triangle& t : other.triangles) {
      sorted.triangles.push_back({place[static_cast<std::size_t>(t[0])],
                                  place[static_cast<std::size_t>(t[1])],
                                  place[static_cast<std::size_t>(t[2])]});
    }
    std::sort(
        sorted.triangles.begin(), sorted.triangles.end(), [](const Triangle& a, const Triangle& b) {
          return *std::min_element(a.begin(), a.end()) < *std::min_element(b.begin(), b.end());
        });
    expect_mentions(refusal(joined(whole, sorted)),
                    {"2 closed surfaces that cross", "--shrink-wrap 1"});
  }
}

TEST(MeshCheck, RefusesSizesItCannotComputeWith) {
  for (const double scale : {1e-100, 1e-70, 1e70, 1e100, 1e300}) {
    expect_mentions(refusal(moved(sphere(1), scale, {0, 0, 0})), {"across", "Scale it"});
  }
  for (const double scale : {1e-50, 1e50}) {
    EXPECT_EQ(refusal(moved(sphere(1), scale, {0, 0, 0})), "");
  }
}

TEST(MeshCheck, RefusesAKleinBottle) {
  // The torus grid, closed with a reflection in one direction.
  const int n = 12;
  IndexedMesh mesh = torus(3.0, 1.0, n);
  mesh.triangles.clear();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto vertex = [&](int row, int column) {
        return row < n ? row * n + column % n : (2 * n - column) % n;
      };
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  expect_mentions(refusal(mesh), {"not orientable"});
}

// A shrink-wrap of all would join them.
TEST(MeshCheck, LeadsFromOpenPartsToTheirRemeshes) {
  const IndexedMesh bowl = without_cap(0.5);
  for (const IndexedMesh& parts : {joined(bowl, moved(bowl, 1.0, {5, 0.5, 0})),
                                   joined(bowl, moved(bowl, 0.9, {0.5, 0.3, 0.2})),
                                   joined(sphere(2), moved(bowl, 1.0, {1.5, 0.3, 0.2}))}) {
    MeshCheckOptions options;
    options.repaired_area_limit_percent = 1.0;
    const std::string told = refusal(parts, options);
    expect_mentions(told, {"2 separate bodies", "open", "--parts"});
    EXPECT_FALSE(holds(told, "shrink-wrap"));
  }
}

TEST(MeshCheck, RefusesPartsOfComparableVolume) {
  const IndexedMesh halves = joined(sphere(2), moved(sphere(2), 1.0, {5, 0, 0}));
  expect_mentions(refusal(halves), {"2 separate bodies", "50 %", "Split in Connected Components"});

  // The limit is the caller's: a crumb of one part in nine.
  const IndexedMesh uneven = joined(sphere(2), moved(sphere(2), 0.5, {5, 0, 0}));
  MeshCheckOptions options;
  options.dropped_volume_limit = 0.112;
  EXPECT_EQ(refusal(uneven, options), "");
  options.dropped_volume_limit = 0.110;
  expect_mentions(refusal(uneven, options), {"2 separate bodies"});
}

TEST(MeshCheck, RefusesALimitOutOfRange) {
  for (const double limit : {0.0, 1.0, -0.5, std::nan("")}) {
    MeshCheckOptions options;
    options.dropped_volume_limit = limit;
    expect_mentions(refusal(box(1, 1, 1), options), {"volume to drop", "above 0 and below 1"});
  }
}

TEST(MeshCheck, RefusesOtherOptionsOutOfRange) {
  for (const double limit : {-0.01, 1.01, std::nan("")}) {
    MeshCheckOptions options;
    options.repaired_area_limit_percent = 100.0 * limit;
    expect_mentions(refusal(box(1, 1, 1), options), {"repaired area", "0 to 100"});
    options = MeshCheckOptions();
    options.weld_tolerance = limit;
    expect_mentions(refusal(box(1, 1, 1), options), {"tolerance of welding", "0 to 0.01"});
  }
}

MeshCheckReport measured(const IndexedMesh& mesh, int threads = 1) {
  MeshCheckReport report;
  report.input_vertices = 7;
  report.welded_vertices = 5;
  report.components = 3;
  measure_closed(mesh, Execution(threads), report);
  return report;
}

TEST(MeasureClosed, FillsInTheMeasuresAndLeavesTheRest) {
  const Vector3 place(3e5, -2e5, 1e5);
  const MeshCheckReport report = measured(moved(box(1.0, 2.0, 3.0), 1.0, place));
  // In map coordinates; about the origin the volume would have nine digits.
  EXPECT_NEAR(report.volume, 6.0, 1e-12);
  EXPECT_NEAR(report.area, 22.0, 1e-12);
  EXPECT_LT((report.centroid - place).norm(), 1e-9);
  EXPECT_NEAR(4.0 * test::pi / 3.0 * std::pow(report.equivalent_radius, 3), 6.0, 1e-12);
  EXPECT_EQ(report.vertices, 8U);
  EXPECT_EQ(report.faces, 12U);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.sliver_faces, 0U);
  EXPECT_EQ(report.input_vertices, 7U);
  EXPECT_EQ(report.input_faces, 0U);
  EXPECT_EQ(report.welded_vertices, 5U);
  EXPECT_EQ(report.components, 3U);
}

TEST(MeasureClosed, OverwritesWhatWasMeasuredBefore) {
  MeshCheckReport report = measured(torus(2.0, 0.5, 12));
  EXPECT_EQ(report.genus, 1);
  IndexedMesh mesh = box(1.0, 1.0, 1.0);
  // A vertex on an edge: the face between it and the edge has no area.
  mesh.points.emplace_back(0.0, -0.5, -0.5);
  mesh.triangles[1] = {0, 3, 8};
  mesh.triangles.push_back({8, 3, 1});
  mesh.triangles.push_back({0, 8, 1});
  measure_closed(mesh, Execution(1), report);
  EXPECT_EQ(bad_edges(mesh), 0U);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.sliver_faces, 1U);
  EXPECT_EQ(report.vertices, 9U);
  EXPECT_EQ(report.faces, 14U);
  EXPECT_NEAR(report.volume, 1.0, 1e-15);
  EXPECT_NEAR(report.area, 6.0, 1e-14);
  EXPECT_LT(report.centroid.norm(), 1e-15);
}

TEST(MeasureClosed, RefusesWhatHasNoVolumeInside) {
  IndexedMesh inward = box(1.0, 1.0, 1.0);
  for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
  for (const IndexedMesh& mesh : {inward, box(1.0, 1.0, 0.0), box(1.0, 1.0, 1e-9)}) {
    try {
      measured(mesh);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
      expect_mentions(error.what(), {"encloses no volume", "Load the closed surface of a grain"});
    }
  }
  EXPECT_NEAR(measured(box(1.0, 1.0, 1e-7)).volume, 1e-7, 1e-20);
}

TEST(MeasureClosed, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = moved(test::lumpy(5), 1.3, Vector3(1.0, 2.0, 3.0));
  const MeshCheckReport one = measured(mesh, 1);
  const MeshCheckReport two = measured(mesh, 2);
  EXPECT_EQ(one.volume, two.volume);
  EXPECT_EQ(one.area, two.area);
  EXPECT_EQ(one.centroid, two.centroid);
}

TEST(MeshCheck, StopsWhenToldTo) {
  const Execution execution(1, [](double, const std::string&) { return false; });
  try {
    check_mesh(box(1, 1, 1), MeshCheckOptions(), execution);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

// Photogrammetry in a map's metres, saved as floats: steps of half a metre for a grain of 0.4.
TEST(MeshCheck, SaysThatSinglePrecisionFarFromTheOriginLeftNoVolume) {
  IndexedMesh mesh = test::transformed(test::lumpy(3), 0.2 * Eigen::Matrix3d::Identity(),
                                       Vector3(431250.0, 5412340.0, 212.0));
  for (Vector3& point : mesh.points) point = point.cast<float>().cast<double>();
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { check_mesh(mesh, {}, Execution(1)); });
  EXPECT_TRUE(holds(sentence, "single precision"));
  EXPECT_FALSE(holds(sentence, "flat"));
}

}  // namespace

namespace {

TEST(VoxelSteps, AreFoundWhateverTheSizeOfAVoxelAndItsPlace) {
  const IndexedMesh body = test::voxel_ellipsoid({7.3, 5.1, 4.2}, {8.1, 7.7, 8.4}, 17);
  EXPECT_TRUE(has_voxel_steps(body));
  IndexedMesh mesh = body;
  for (Vector3& p : mesh.points) {
    const Vector3 placed = p.cwiseProduct(Vector3(0.0123, 0.0123, 0.031)) + Vector3(10, -31, 4);
    p = placed.cast<float>().cast<double>();  // as STL keeps it
  }
  EXPECT_TRUE(has_voxel_steps(mesh));
  EXPECT_TRUE(check_mesh(mesh, {}, Execution(1)).report.has_voxel_steps);
  // The smallest of them.
  EXPECT_TRUE(has_voxel_steps(test::voxel_ellipsoid({3.0, 3.0, 3.0}, {4.5, 4.5, 4.5}, 9)));
}

TEST(VoxelSteps, AreNotFoundWhereOneFaceIsSlantedNorInPartsWithFewPlanes) {
  IndexedMesh mesh = test::voxel_ellipsoid({7.3, 5.1, 4.2}, {8.1, 7.7, 8.4}, 17);
  mesh.points.back().y() += 0.01;
  EXPECT_FALSE(has_voxel_steps(mesh));
  EXPECT_FALSE(has_voxel_steps(test::lumpy(3)));
  EXPECT_FALSE(has_voxel_steps(test::box(3, 2, 1)));
  // A box of many voxels, and a stair, which is as thick everywhere.
  EXPECT_FALSE(has_voxel_steps(test::voxel_body(12, [](int, int, int) { return true; })));
  EXPECT_FALSE(has_voxel_steps(test::voxel_body(12, [](int x, int y, int) { return y <= x; })));
}

}  // namespace
}  // namespace wscvt
