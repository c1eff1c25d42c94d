// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/mesh_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

using test::bad_edges;
using test::box;
using test::joined;
using test::sphere;
using test::torus;
using test::transformed;
using test::unwelded;

CheckedMesh check(const IndexedMesh& mesh, int threads = 1) {
  return check_mesh(mesh, MeshCheckOptions(), Execution(threads));
}

IndexedMesh moved(const IndexedMesh& mesh, double scale, const Vector3& offset) {
  return transformed(mesh, scale * Eigen::Matrix3d::Identity(), offset);
}

/// The sentence of the refusal; empty when the mesh was taken.
std::string refusal(const IndexedMesh& mesh, const MeshCheckOptions& options = MeshCheckOptions()) {
  try {
    check_mesh(mesh, options, Execution(1));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    return error.what();
  }
  return "";
}

void expect_mentions(const std::string& sentence, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(sentence.find(part), std::string::npos) << "\"" << part << "\" in: " << sentence;
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
  EXPECT_EQ(report.dropped_volume_share, 0.0);
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
  EXPECT_EQ(checked.report.duplicate_faces, 2U);
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
  const double dropped = 0.008 + check(moved(sphere(1), 0.1, {0, 0, 0})).report.volume;
  EXPECT_NEAR(checked.report.dropped_volume_share, dropped / (whole + dropped), 1e-12);
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
  for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(1e6, 2e6, -3e6)}) {
    const IndexedMesh flat{{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}},
                           {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
    expect_mentions(refusal(moved(flat, 1.0, offset)), {"no volume", "flat"});
  }
}

TEST(MeshCheck, RefusesPositionsThatAreNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {std::nan(""), infinity, -infinity}) {
    IndexedMesh mesh = sphere(2);
    mesh.points[77].y() = value;
    expect_mentions(refusal(mesh), {"Vertex 77", "finite", "remove"});
  }
}

TEST(MeshCheck, RefusesIndicesOutOfRange) {
  for (const std::int32_t v : {-1, 8}) {
    IndexedMesh mesh = box(1, 1, 1);
    mesh.triangles[5][1] = v;
    expect_mentions(refusal(mesh), {"Face 5", std::to_string(v), "has 8"});
  }
}

TEST(MeshCheck, RefusesHoles) {
  IndexedMesh mesh = sphere(2);
  mesh.triangles.pop_back();
  expect_mentions(refusal(mesh), {"3 boundary edges", "Close Holes"});
  mesh.triangles.resize(mesh.triangles.size() / 2);
  expect_mentions(refusal(mesh), {"boundary edges", "Close Holes"});
}

TEST(MeshCheck, RefusesNonManifoldEdges) {
  // Two boxes that share one edge.
  const IndexedMesh mesh = joined(box(2, 2, 2), moved(box(2, 2, 2), 1.0, {2, 2, 0}));
  expect_mentions(refusal(mesh), {"1 non-manifold edge,", "Repair"});
  // A fin on a closed body.
  IndexedMesh fin = box(2, 2, 2);
  fin.points.emplace_back(0, 0, 5);
  fin.triangles.push_back({0, 1, 8});
  expect_mentions(refusal(fin), {"1 non-manifold edge,"});
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

TEST(MeshCheck, RefusesPartsOfComparableVolume) {
  const IndexedMesh halves = joined(sphere(2), moved(sphere(2), 1.0, {5, 0, 0}));
  expect_mentions(refusal(halves), {"2 separate parts", "50 %", "Remove Isolated"});

  // The limit is the caller's: a crumb of one part in nine.
  const IndexedMesh uneven = joined(sphere(2), moved(sphere(2), 0.5, {5, 0, 0}));
  MeshCheckOptions options;
  options.dropped_volume_limit = 0.112;
  EXPECT_EQ(refusal(uneven, options), "");
  options.dropped_volume_limit = 0.110;
  expect_mentions(refusal(uneven, options), {"2 separate parts"});
}

TEST(MeshCheck, RefusesALimitOutOfRange) {
  for (const double limit : {0.0, 1.0, -0.5, std::nan("")}) {
    MeshCheckOptions options;
    options.dropped_volume_limit = limit;
    expect_mentions(refusal(box(1, 1, 1), options), {"between 0 and 1"});
  }
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

}  // namespace
}  // namespace wscvt
