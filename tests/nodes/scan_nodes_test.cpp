// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/scan_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "grains/ct_grain.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/mesh_distance.h"
#include "wscvt/surface/curvature.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

/// Equivalent radius 1, about the centroid.
IndexedMesh normalized(IndexedMesh mesh) {
  const MeshSums sums = mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1));
  const Vector3 centroid = sums.centroid();
  const double radius = std::cbrt(3.0 * sums.volume() / (4.0 * pi));
  for (Vector3& p : mesh.points) p = (p - centroid) / radius;
  return mesh;
}

const IndexedMesh& sand() {
  static const IndexedMesh mesh = normalized(test::ct_mesh_of_about(test::sand_grain(1), 3000));
  return mesh;
}

ScanNodes place(const IndexedMesh& scan, int count, const ScanNodesOptions& options = {},
                int threads = 1) {
  return ScanRemesher(scan, options, count, Execution(threads)).place(count, Execution(threads));
}

double area_of(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1)).area();
}

/// Root mean square distance of the scan's vertices from a mesh.
double rms_from(const IndexedMesh& scan, const IndexedMesh& mesh) {
  const MeshDistance boxes(mesh, Execution(1), "boxes");
  double sum = 0.0;
  for (const double d : boxes.distances(scan.points, Execution(1))) sum += d * d;
  return std::sqrt(sum / static_cast<double>(scan.points.size()));
}

double ratio_of(const IndexedMesh& mesh) {
  return mean_edge_ratio(EditMesh(mesh.points, mesh.triangles, Execution(1)));
}

double smallest_angle(const IndexedMesh& mesh) {
  double sharpest = -1.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sharpest =
        std::max(sharpest, largest_corner_cosine(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return std::acos(std::min(sharpest, 1.0)) * 180.0 / pi;
}

void expect_sound(const ScanNodes& nodes, int count, std::size_t genus) {
  EXPECT_EQ(nodes.mesh.points.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(nodes.mesh.triangles.size(), 2 * nodes.mesh.points.size() - 4 + 4 * genus);
  EXPECT_EQ(test::bad_edges(nodes.mesh), 0u);
  EXPECT_EQ(nodes.report.genus, genus);
  for (const Vector3& p : nodes.mesh.points) EXPECT_TRUE(p.allFinite());
}

TEST(ScanNodes, AreExactlyAsManyAsAskedForHoweverFew) {
  for (const int count : {4, 5, 7, 12, 50, 301}) {
    SCOPED_TRACE(count);
    const ScanNodes nodes = place(sand(), count);
    expect_sound(nodes, count, 0);
    // The offset is Newton's, of which the volume's rounding is left.
    EXPECT_NEAR(volume_of(nodes.mesh, Execution(1)), volume_of(sand(), Execution(1)), 1e-11);
    EXPECT_EQ(nodes.report.self_intersections, 0u);
  }
}

TEST(ScanNodes, AreEvenAndNearerToTheScanThanNodesThatLieOnIt) {
  ScanNodesOptions on_scan;
  on_scan.fitted = false;
  const ScanNodes evened = place(sand(), 400, on_scan);
  const ScanNodes fitted = place(sand(), 400);
  expect_sound(evened, 400, 0);
  expect_sound(fitted, 400, 0);
  // 1.1 to 1.12 is what hexagonal cells on a closed surface come to.
  EXPECT_LT(ratio_of(evened.mesh), 1.13);
  EXPECT_LT(ratio_of(fitted.mesh), 1.13);
  EXPECT_NEAR(fitted.report.mean_edge_ratio, ratio_of(fitted.mesh), 1e-12);
  EXPECT_GE(smallest_angle(fitted.mesh), 30.0);
  EXPECT_LT(rms_from(sand(), fitted.mesh), 0.75 * rms_from(sand(), evened.mesh));
  const MeshDistance scan(sand(), Execution(1), "boxes");
  for (const Vector3& p : evened.mesh.points) EXPECT_LT(scan.distance(p), 1e-9);
}

TEST(ScanNodes, AreCloserAtALargerEdgeRatioAndKeepTheirAngles) {
  ScanNodesOptions options;
  double last = 1.0;
  for (const double ratio : {1.1, 1.25, 1.5}) {
    SCOPED_TRACE(ratio);
    options.edge_ratio = ratio;
    const ScanNodes nodes = place(sand(), 300, options);
    expect_sound(nodes, 300, 0);
    EXPECT_NEAR(ratio_of(nodes.mesh), ratio, 0.03);
    EXPECT_GE(smallest_angle(nodes.mesh), 29.9);
    EXPECT_TRUE(self_intersections(nodes.mesh).empty());
    const double rms = rms_from(sand(), nodes.mesh);
    EXPECT_LT(rms, 0.95 * last);
    last = rms;
  }
}

TEST(ScanNodes, FindTheEdgesOfACube) {
  const IndexedMesh cube = normalized(test::transformed(
      test::box(1.0, 1.1, 1.2), test::random_rotation(3), Vector3(0.3, 0.1, 0.2)));
  ScanNodesOptions on_scan;
  on_scan.fitted = false;
  const ScanNodes fitted = place(cube, 400);
  expect_sound(fitted, 400, 0);
  const IndexedMesh dense = test::subdivided(cube, 5);
  // Nodes beside the edges, which coarsening without rims leaves, are 1.6 % off; evenness costs the
  // fit half a per cent.
  EXPECT_LT(rms_from(dense, place(cube, 400, on_scan).mesh), 0.003);
  EXPECT_LT(rms_from(dense, fitted.mesh), 0.008);
}

TEST(ScanNodes, KeepBothSheetsOfAThinPlate) {
  const IndexedMesh plate = normalized(test::transformed(
      test::subdivided(test::box(3.0, 2.8, 0.15), 4), test::random_rotation(5), Vector3::Zero()));
  const ScanNodes nodes = place(plate, 500);
  expect_sound(nodes, 500, 0);
  EXPECT_NEAR(area_of(nodes.mesh), area_of(plate), 0.01 * area_of(plate));
  EXPECT_TRUE(self_intersections(nodes.mesh).empty());
  EXPECT_NEAR(volume_of(nodes.mesh, Execution(1)), volume_of(plate, Execution(1)), 1e-11);
}

TEST(ScanNodes, KeepTheHoleOfATorus) {
  const IndexedMesh ring = normalized(test::torus(1.0, 0.4, 40));
  const ScanNodes nodes = place(ring, 300);
  expect_sound(nodes, 300, 1);
  EXPECT_LT(ratio_of(nodes.mesh), 1.14);
  EXPECT_TRUE(self_intersections(nodes.mesh).empty());
}

TEST(ScanNodes, MoveWithTheScan) {
  const Eigen::Matrix3d turn = test::random_rotation(11);
  const IndexedMesh turned = test::transformed(sand(), turn, Vector3::Zero());
  const ScanNodes a = place(sand(), 300);
  const ScanNodes b = place(turned, 300);
  // Rounding decides between flips that gain alike, which scatters the result by some per cent.
  EXPECT_NEAR(rms_from(sand(), a.mesh), rms_from(turned, b.mesh), 0.1 * rms_from(sand(), a.mesh));
  EXPECT_NEAR(ratio_of(a.mesh), ratio_of(b.mesh), 0.01);
}

TEST(ScanNodes, AreTheSameBytesOnAnyNumberOfThreadsAndForAnyMostNodes) {
  ScanNodesOptions options;
  options.weighting = CellWeighting::Curvature;
  const ScanNodes one = place(sand(), 250, options, 1);
  for (const int threads : {2, 3}) {
    const ScanNodes other =
        ScanRemesher(sand(), options, 900, Execution(threads)).place(250, Execution(threads));
    EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
    ASSERT_EQ(one.mesh.points.size(), other.mesh.points.size());
    for (std::size_t i = 0; i < one.mesh.points.size(); ++i) {
      EXPECT_EQ(one.mesh.points[i], other.mesh.points[i]);
    }
    EXPECT_EQ(one.cell_areas, other.cell_areas);
  }
}

TEST(ScanNodes, AreMoreOnACoarseScanThanItHasVertices) {
  const IndexedMesh coarse = normalized(test::scaled(test::sphere(1), Vector3(1.3, 1.0, 0.8)));
  ASSERT_LT(coarse.points.size(), 60u);
  const ScanNodes nodes = place(coarse, 500);
  expect_sound(nodes, 500, 0);
  EXPECT_GT(nodes.report.split_vertices, 1000u);
  EXPECT_LT(rms_from(test::subdivided(coarse, 3), nodes.mesh), 0.005);
}

TEST(ScanNodes, StandFacesOfNoArea) {
  IndexedMesh scan = sand();
  EditMesh edited(scan.points, scan.triangles, Execution(1));
  // A vertex on the end of an edge makes two faces without an area, and two as they were.
  const auto v = static_cast<std::int32_t>(edited.points.size());
  edited.points.push_back(edited.points[edited.origin(30)]);
  edited.first.push_back(-1);
  edited.degrees.push_back(0);
  const auto free = static_cast<std::int32_t>(edited.triangles.size());
  edited.triangles.resize(edited.triangles.size() + 2);
  edited.opposite.resize(edited.opposite.size() + 6);
  edited.put_on_edge(v, 30, {free, free + 1});
  const ScanNodes nodes = place({edited.points, edited.triangles}, 300);
  expect_sound(nodes, 300, 0);
  EXPECT_GE(smallest_angle(nodes.mesh), 30.0);
}

TEST(ScanNodes, HaveCellsThatAddUpToTheirMesh) {
  const ScanNodes nodes = place(sand(), 200);
  double sum = 0.0;
  for (const double area : nodes.cell_areas) sum += area;
  EXPECT_NEAR(sum, area_of(nodes.mesh), 1e-9);
}

TEST(ScanNodes, AreMoreWhereTheSurfaceBendsByTheLawOfTheWeighting) {
  const IndexedMesh body = normalized(test::scaled(test::sphere(4), Vector3(2.0, 1.0, 0.9)));
  ScanNodesOptions options;
  options.weighting = CellWeighting::Curvature;
  const auto near_tips = [&](const ScanNodes& nodes) {
    double longest = 0.0;
    for (const Vector3& p : body.points) longest = std::max(longest, std::abs(p.x()));
    return std::count_if(nodes.mesh.points.begin(), nodes.mesh.points.end(),
                         [&](const Vector3& p) { return std::abs(p.x()) > 0.85 * longest; });
  };
  const auto even = near_tips(place(body, 300));
  const auto curved = near_tips(place(body, 300, options));
  EXPECT_GT(curved, 1.3 * static_cast<double>(even));
  options.curvature_alpha = -1.0;
  EXPECT_LT(near_tips(place(body, 300, options)), even);
}

/// ln of the largest curvature at every vertex of a smooth surface.
std::vector<double> log_curvatures(const IndexedMesh& surface) {
  std::vector<double> logs;
  for (const PrincipalCurvatures& k : quadric_fit_curvatures(surface, 2, Execution(2))) {
    logs.push_back(std::log(std::max(std::abs(k.maximum), std::abs(k.minimum))));
  }
  return logs;
}

/// Slope of ln density of nodes against ln curvature of the surface where they are.
double slope_of_law(const IndexedMesh& surface, const std::vector<double>& logs,
                    const ScanNodes& nodes) {
  double x_sum = 0.0;
  double y_sum = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < nodes.mesh.points.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t v = 1; v < surface.points.size(); ++v) {
      if ((surface.points[v] - nodes.mesh.points[i]).squaredNorm() <
          (surface.points[nearest] - nodes.mesh.points[i]).squaredNorm()) {
        nearest = v;
      }
    }
    const double x = logs[nearest];
    const double y = -std::log(nodes.cell_areas[i]);
    x_sum += x;
    y_sum += y;
    xx += x * x;
    xy += x * y;
  }
  const auto count = static_cast<double>(nodes.mesh.points.size());
  return (xy - x_sum * y_sum / count) / (xx - x_sum * x_sum / count);
}

TEST(ScanNodes, KeepTheLawBetweenDensityAndCurvature) {
  // Smooth lumps, as a series of low degree has them; the scan itself tells their curvature.
  const IndexedMesh body = normalized(test::scaled(test::lumpy(4), Vector3(1.3, 1.0, 0.8)));
  const std::vector<double> logs = log_curvatures(body);
  const std::vector<double> areas = vertex_areas(body);
  double area = 0.0;
  double mean = 0.0;
  double square = 0.0;
  for (std::size_t v = 0; v < logs.size(); ++v) {
    area += areas[v];
    mean += areas[v] * logs[v];
    square += areas[v] * logs[v] * logs[v];
  }
  mean /= area;
  const double deviation = std::sqrt(square / area - mean * mean);
  ScanNodesOptions options;
  const auto slope = [&](CellWeighting weighting, bool fitted) {
    options.weighting = weighting;
    options.fitted = fitted;
    return slope_of_law(body, logs, place(body, 400, options));
  };
  // Eqs. 11 to 14: a cell is 1 + (3.118 / pi) x of the mean one, x three deviations to 1.
  const double of_paper = 3.118 / pi / (3.0 * deviation);
  EXPECT_NEAR(slope(CellWeighting::Curvature, false), of_paper, 0.12 * of_paper);
  EXPECT_NEAR(slope(CellWeighting::Area, false), 0.0, 0.05);
  // The fit draws nodes to ridges, also those of equal cells: by .25 here.
  EXPECT_NEAR(slope(CellWeighting::Curvature, true), of_paper + 0.15, 0.1 * of_paper);
}

TEST(ScanNodes, AreRefusedOutOfRange) {
  ScanNodesOptions options;
  options.edge_ratio = 1.07;
  EXPECT_ERROR(ScanRemesher(sand(), options, 100, Execution(1)), InvalidInput);
  options.edge_ratio = 1.61;
  EXPECT_ERROR(ScanRemesher(sand(), options, 100, Execution(1)), InvalidInput);
  options.edge_ratio = 1.6;
  options.curvature_alpha = -3.1;
  EXPECT_ERROR(ScanRemesher(sand(), options, 100, Execution(1)), InvalidInput);
  EXPECT_ERROR(place(sand(), 3), InvalidInput);
}

/// The first number in a sentence after some words.
int number_after(const std::string& sentence, const std::string& words) {
  const std::size_t at = sentence.find(words);
  return at == std::string::npos ? 0 : std::atoi(sentence.c_str() + at + words.size());
}

TEST(ScanNodes, TooFewForAHandleAreRefusedWithANumberThatIsEnough) {
  const IndexedMesh ring = normalized(test::torus(1.0, 0.4, 20));
  for (const int count : {4, 6}) {
    SCOPED_TRACE(count);
    std::string sentence;
    try {
      place(ring, count);
    } catch (const Error& error) {
      sentence = error.what();
    }
    // Seven, of Moebius's torus (1861) and Csaszar's polyhedron (1949).
    EXPECT_EQ(number_after(sentence, "needs at least "), 7) << sentence;
    const int enough = number_after(sentence, "not " + std::to_string(count) + ". ");
    ASSERT_GE(enough, 7) << sentence;
    EXPECT_TRUE(self_intersections(place(ring, enough).mesh).empty());
  }
}

TEST(ScanNodes, TooFewToKeepTrianglesApartNameANumberThatIsEnough) {
  const IndexedMesh ring = normalized(test::torus(1.0, 0.02, 60));
  int count = 60;
  ScanNodes few = place(ring, count);
  while (few.report.self_intersections == 0 && count > 20) few = place(ring, --count);
  SCOPED_TRACE(count);
  ASSERT_GT(few.report.self_intersections, 0u);
  expect_sound(few, count, 1);
  EXPECT_EQ(few.report.scan_self_intersections, 0u);
  const int enough = ScanRemesher(ring, {}, count, Execution(1)).enough_above(count, Execution(1));
  ASSERT_GT(enough, count);
  ASSERT_LE(enough, 3 * count);
  EXPECT_TRUE(self_intersections(place(ring, enough).mesh).empty());
}

TEST(ScanNodes, AreStoppedInEveryStage) {
  for (const std::string stage :
       {"Coarsening the scan", "Equalizing edge lengths", "Fitting the nodes"}) {
    SCOPED_TRACE(stage);
    test::expect_to_be_stopped(
        [&](const Execution& execution) {
          ScanRemesher(sand(), {}, 100, execution).place(100, execution);
        },
        stage, 2);
  }
}

}  // namespace
}  // namespace wscvt
