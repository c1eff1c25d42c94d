// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <regex>
#include <string>

#include "grains/ct_grain.h"
#include "grains/marching_cubes.h"
#include "support/distance_bodies.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh/remesh_warnings.h"
#include "wscvt/repair/new_surface.h"
#include "wscvt/report/report.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {
namespace {

using test::holds;

const IndexedMesh& sand() {
  static const IndexedMesh mesh = read_mesh(std::string(WSCVT_MESHES_DIR) + "/sand_5658.ply");
  return mesh;
}

/// As published; the method on the scan has tests of its own.
RemeshOptions options_of(int nodes, Weighting weighting) {
  AsPublishedOptions published;
  published.weighting = weighting;
  RemeshOptions options;
  options.node_count = nodes;
  options.method = published;
  return options;
}

AsPublishedOptions& published(RemeshOptions& options) {
  return std::get<AsPublishedOptions>(options.method);
}

const AsPublishedReport& published_report(const RemeshResult& result) {
  return *as_published_report(result);
}

// Closed, consistently oriented, 2-manifold, of genus 0.
void expect_closed(const RemeshResult& result, int nodes) {
  const IndexedMesh& mesh = result.mesh;
  ASSERT_EQ(mesh.points.size(), static_cast<std::size_t>(nodes));
  ASSERT_EQ(mesh.triangles.size(), static_cast<std::size_t>(2 * nodes - 4));
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  std::vector<int> triangles_at(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(++directed[std::make_pair(t[k], t[(k + 1) % 3])], 1);
      ++triangles_at[t[k]];
    }
  }
  for (const auto& [edge, count] : directed) {
    ASSERT_EQ(directed.count(std::make_pair(edge.second, edge.first)), 1U);
  }
  for (const int count : triangles_at) ASSERT_GE(count, 3);
  ASSERT_EQ(result.directions.size(), mesh.points.size());
  ASSERT_EQ(result.cell_areas.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vector3 expected = result.centre + result.radial_distances[i] * result.directions[i];
    ASSERT_NEAR((mesh.points[i] - expected).norm(), 0.0,
                1e-12 * result.radial_distances[i] + 1e-15);
  }
}

// The same, and star-shaped about the centre.
void expect_promises(const RemeshResult& result, int nodes) {
  expect_closed(result, nodes);
  for (const Triangle& t : result.mesh.triangles) {
    const Vector3 a = result.mesh.points[t[0]] - result.centre;
    const Vector3 b = result.mesh.points[t[1]] - result.centre;
    const Vector3 c = result.mesh.points[t[2]] - result.centre;
    ASSERT_GT(a.dot(b.cross(c)), 0.0);
  }
}

class EveryCountAndWeighting : public testing::TestWithParam<std::tuple<int, Weighting>> {};

TEST_P(EveryCountAndWeighting, GivesAClosedStarShapedMeshOfExactlyThatCount) {
  const auto [nodes, weighting] = GetParam();
  expect_promises(remesh(sand(), options_of(nodes, weighting), Execution(1)), nodes);
}

INSTANTIATE_TEST_SUITE_P(Remesh, EveryCountAndWeighting,
                         testing::Combine(testing::Values(4, 5, 12, 100, 1000, 7228),
                                          testing::Values(Weighting::Constant,
                                                          Weighting::RadialDistance,
                                                          Weighting::Curvature, Weighting::Area)),
                         [](const auto& test) {
                           return "N" + std::to_string(std::get<0>(test.param)) + "Weighting" +
                                  std::to_string(static_cast<int>(std::get<1>(test.param)));
                         });

TEST(Remesh, EveryPlacementKeepsThePromises) {
  for (const auto placement : {PublishedPlacement::Series, PublishedPlacement::Surface}) {
    for (const int nodes : {4, 5, 300}) {
      RemeshOptions options = options_of(nodes, Weighting::Area);
      published(options).placement = placement;
      expect_promises(remesh(sand(), options, Execution(1)), nodes);
    }
  }
}

TEST(Remesh, NodesOnTheOriginalMeshLieOnIt) {
  RemeshOptions options = options_of(200, Weighting::Area);
  published(options).placement = PublishedPlacement::Surface;
  const RemeshResult result = remesh(sand(), options, Execution(1));
  const IndexedMesh& mesh = result.mesh;
  for (const Vector3& p : mesh.points) {
    double nearest_plane = std::numeric_limits<double>::infinity();
    for (const Triangle& t : sand().triangles) {
      const Vector3& a = sand().points[t[0]];
      if ((a - p).squaredNorm() > 0.02) continue;
      const Vector3 n = (sand().points[t[1]] - a).cross(sand().points[t[2]] - a);
      if (n.norm() > 0.0)
        nearest_plane = std::min(nearest_plane, std::abs(n.normalized().dot(p - a)));
    }
    EXPECT_LT(nearest_plane, 1e-9);
  }
}

TEST(Remesh, SphereGivesSphere) {
  const IndexedMesh sphere = test::sphere(6);
  for (const Weighting weighting :
       {Weighting::Constant, Weighting::RadialDistance, Weighting::Curvature, Weighting::Area}) {
    SCOPED_TRACE(static_cast<int>(weighting));
    const RemeshResult result = remesh(sphere, options_of(500, weighting), Execution(1));
    // The scan's 40,962 vertices lie on the unit sphere, its faces up to 1e-4 below.
    for (const double r : result.radial_distances) EXPECT_NEAR(r, 1.0, 1e-4);
    EXPECT_NEAR(result.remesh.aspect_ratio, 1.0, 2e-3);
    EXPECT_LT(result.remesh.sdq, 0.1);
    EXPECT_LT(result.quality.edge_variation, 0.07);
  }
}

TEST(Remesh, RotatedScanGivesTheSameDescriptors) {
  const Eigen::AngleAxisd rotation(1.1, Vector3(0.3, -0.5, 0.8).normalized());
  IndexedMesh rotated = sand();
  for (Vector3& p : rotated.points) p = rotation * p;
  const RemeshResult a = remesh(sand(), options_of(1000, Weighting::Area), Execution(1));
  const RemeshResult b = remesh(rotated, options_of(1000, Weighting::Area), Execution(1));
  EXPECT_NEAR(b.scan.volume / a.scan.volume, 1.0, 1e-12);
  EXPECT_NEAR(b.scan.sdq / a.scan.sdq, 1.0, 1e-9);
  // The series of a rotated scan is the rotated series; only its lattice of nodes differs, so what
  // is left is a share of the discretisation error (volume 0.7 %, Sdq 1 % at N = 1000).
  // The residual is read at other points, 3,000 of them: the rms of normal noise scatters by 1.3 %
  // then, and the quotient of two by 1.8 %. Three times that.
  EXPECT_NEAR(published_report(b).fit.residual / published_report(a).fit.residual, 1.0, 0.055);
  EXPECT_NEAR(b.remesh.volume / a.remesh.volume, 1.0, 1e-3);
  EXPECT_NEAR(b.remesh.area / a.remesh.area, 1.0, 1e-3);
  EXPECT_NEAR(b.remesh.sphericity / a.remesh.sphericity, 1.0, 1e-3);
  EXPECT_NEAR(b.remesh.aspect_ratio / a.remesh.aspect_ratio, 1.0, 2e-3);
  EXPECT_NEAR(b.remesh.sdq / a.remesh.sdq, 1.0, 1e-2);
}

TEST(Remesh, FarAwayOrTinyGrainsGiveTheSameMesh) {
  const RemeshResult near = remesh(sand(), options_of(400, Weighting::Curvature), Execution(1));
  const IndexedMesh& reference = near.mesh;
  struct Placement {
    double size;
    Vector3 offset;
  };
  for (const Placement& placement :
       {Placement{1e-6, Vector3::Zero()}, Placement{1.0, Vector3(1e6, -1e6, 1e6)},
        Placement{1e9, Vector3::Zero()}}) {
    IndexedMesh moved = sand();
    for (Vector3& p : moved.points) p = placement.offset + placement.size * p;
    const RemeshResult result = remesh(moved, options_of(400, Weighting::Curvature), Execution(1));
    const IndexedMesh& mesh = result.mesh;
    EXPECT_EQ(mesh.triangles, reference.triangles);
    // Coordinates of size 1e6 carry 1e-10; the relaxation may amplify that.
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const Vector3 back = (mesh.points[i] - placement.offset) / placement.size;
      EXPECT_NEAR((back - reference.points[i]).norm(), 0.0, 1e-6);
    }
    EXPECT_NEAR(result.remesh.sdq / near.remesh.sdq, 1.0, 1e-6);
  }
}

TEST(Remesh, ShuffledVerticesAndFacesGiveTheSameTriangulation) {
  std::mt19937 generator(test::announced(17));
  std::vector<std::int32_t> order(sand().points.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), generator);
  IndexedMesh shuffled;
  shuffled.points.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) shuffled.points[order[i]] = sand().points[i];
  for (Triangle t : sand().triangles) {
    for (std::int32_t& v : t) v = order[v];
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(generator() % 3), t.end());
    shuffled.triangles.push_back(t);
  }
  std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), generator);
  const RemeshResult a = remesh(sand(), options_of(1000, Weighting::RadialDistance), Execution(1));
  const RemeshResult b =
      remesh(shuffled, options_of(1000, Weighting::RadialDistance), Execution(1));
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
}

void expect_same_bytes_on_two_threads(int nodes, Weighting weighting) {
  SCOPED_TRACE(testing::Message() << nodes << " nodes, weighting " << static_cast<int>(weighting));
  RemeshOptions options = options_of(nodes, weighting);
  published(options).placement = PublishedPlacement::Surface;
  options.measures.node_curvatures = true;
  const RemeshResult one = remesh(sand(), options, Execution(1));
  const RemeshResult two = remesh(sand(), options, Execution(2));
  EXPECT_EQ(one.mesh.points, two.mesh.points);
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.directions, two.directions);
  EXPECT_EQ(one.cell_areas, two.cell_areas);
  EXPECT_EQ(one.coefficients.radius, two.coefficients.radius);
  EXPECT_EQ(one.curvatures, two.curvatures);
  // Every number of the checks, the fit, the relaxation, the quality and the descriptors, to the
  // last bit.
  EXPECT_EQ(report_json(one), report_json(two));
}

TEST(Remesh, SameBytesOnAnyNumberOfThreads) {
  // Enough seeds and triangles for several blocks in every loop that runs in parallel.
  expect_same_bytes_on_two_threads(6000, Weighting::RadialDistance);
  for (const auto& weighting : enumerators<Weighting>()) {
    expect_same_bytes_on_two_threads(300, weighting.value);
  }
}

TEST(Remesh, HandsBackTheScanItUsedWhereAsked) {
  const IndexedMesh scan = test::lumpy(3);
  const IndexedMesh soup = test::unwelded(scan);
  RemeshOptions options;
  options.node_count = 50;
  EXPECT_TRUE(remesh(soup, options, Execution(1)).repaired_scan.points.empty());
  options.measures.repaired_scan = true;
  const RemeshResult result = remesh(soup, options, Execution(1));
  EXPECT_EQ(result.repaired_scan.points.size(), scan.points.size());
  EXPECT_EQ(result.repaired_scan.triangles.size(), scan.triangles.size());
  // In the input's coordinates.
  EXPECT_EQ(result.repaired_scan.points[result.repaired_scan.triangles[0][0]], soup.points[0]);
  options.shrink_wrap.opening_percent = 10.0;
  const RemeshResult wrapped = remesh(scan, options, Execution(1));
  EXPECT_EQ(wrapped.repaired_scan.triangles,
            shrink_wrap_of(scan, options.shrink_wrap, Execution(1)).triangles);
}

TEST(Remesh, CellAreasAddUpToTheSurface) {
  const RemeshResult result = remesh(sand(), options_of(2000, Weighting::Area), Execution(1));
  const double total = std::accumulate(result.cell_areas.begin(), result.cell_areas.end(), 0.0);
  // The nodes lie on the series, which has 1.3 % less area than this scan. A cell counts as its
  // solid angle times g at its seed, second order in h; flat fans lose as much again. h^2 = 4 pi /
  // N is 0.6 %, of which this grain's slopes make 1.2 %.
  const double area = integrate(HarmonicSurface(result.coefficients.radius), 80, Execution(1)).area;
  EXPECT_NEAR(total / area, 1.0, 0.02);
}

TEST(Remesh, CurvatureWeightingPutsMoreNodesWhereCurvatureIsHigh) {
  RemeshOptions options = options_of(1000, Weighting::Curvature);
  options.measures.node_curvatures = true;
  RemeshOptions constant = options_of(1000, Weighting::Constant);
  constant.measures.node_curvatures = true;
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + 500, values.end());
    return values[500];
  };
  const RemeshResult sharp = remesh(sand(), options, Execution(1));
  const RemeshResult even = remesh(sand(), constant, Execution(1));
  EXPECT_GT(median(sharp.curvatures), 1.1 * median(even.curvatures));
}

TEST(Remesh, CoefficientsDescribeTheFittedSurface) {
  const RemeshResult result = remesh(sand(), options_of(300, Weighting::Area), Execution(1));
  const HarmonicSurface series(result.coefficients.radius);
  for (std::size_t i = 0; i < result.directions.size(); ++i) {
    EXPECT_NEAR(series.radius(result.directions[i]), result.radial_distances[i], 1e-12);
  }
}

// Limits on the errors of the remesh against the fitted surface in %, nodes on that surface, and on
// the unevenness of its edges: what prototypes of the method reached on these grains.
struct ReferenceLimits {
  int nodes;
  double volume, area, aspect_ratio;
  double variation_radial_distance, variation_area;
};

TEST(Remesh, ReferenceGrainsStayWithinTheirLimits) {
  const std::vector<ReferenceLimits> table = {{100, 7.5, 6.6, 1.5, 0.14, 0.13},
                                              {500, 1.45, 1.8, 0.3, 0.14, 0.13},
                                              {1000, 0.75, 0.95, 0.15, 0.15, 0.13},
                                              {2000, 0.38, 0.5, 0.1, 0.16, 0.13}};
  for (const test::Grain& grain : test::reference_grains()) {
    const IndexedMesh scan = test::ct_mesh_of_about(grain, 7000);
    for (const ReferenceLimits& limits : table) {
      SCOPED_TRACE(testing::Message() << grain.name << ", N = " << limits.nodes);
      const RemeshResult printed =
          remesh(scan, options_of(limits.nodes, Weighting::RadialDistance), Execution());
      const HarmonicSurface series(printed.coefficients.radius);
      const SurfaceIntegrals exact = integrate(series, 80, Execution());
      const IndexedMesh dense = mesh_of_surface(series, 64, Execution());
      const double aspect_ratio = describe_shape(dense, Execution()).aspect_ratio;
      EXPECT_LT(std::abs(relative_error_percent(printed.remesh.volume, exact.volume)),
                limits.volume);
      EXPECT_LT(std::abs(relative_error_percent(printed.remesh.area, exact.area)), limits.area);
      EXPECT_LT(std::abs(relative_error_percent(printed.remesh.aspect_ratio, aspect_ratio)),
                limits.aspect_ratio);
      EXPECT_LT(printed.quality.edge_variation, limits.variation_radial_distance);
      EXPECT_EQ(published_report(printed).relaxation.outcome, RelaxationOutcome::Converged);
      const RemeshResult area =
          remesh(scan, options_of(limits.nodes, Weighting::Area), Execution());
      EXPECT_LT(area.quality.edge_variation, limits.variation_area);
    }
  }
}

TEST(Remesh, ACoarseScanIsFittedLikeTheSameSurfaceWithSplitFaces) {
  // A vertex fit gave the 230 points degree 9 and the split faces degree 20.
  IndexedMesh coarse;
  coarse.points = fibonacci_lattice(230);
  coarse.triangles = SphereTriangulation(coarse.points).triangles();
  for (Vector3& p : coarse.points) p = p.cwiseProduct(Vector3(1.2, 1.0, 0.8));
  const RemeshOptions options = options_of(100, Weighting::Area);
  const RemeshResult whole = remesh(coarse, options, Execution(1));
  const RemeshResult split = remesh(test::subdivided(coarse, 2), options, Execution(1));
  EXPECT_EQ(published_report(whole).fit.degree, 20);
  const std::vector<double>& a = whole.coefficients.radius;
  const std::vector<double>& b = split.coefficients.radius;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12) << k;
}

testing::AssertionResult warns_of(const RemeshResult& result, const std::string& part) {
  return test::any_holds(result.warnings, part);
}

TEST(Remesh, SaysThatAFlatBodyIsBeyondTheSeries) {
  // Forty times as wide as high: the radius climbs too steeply to the rim for twenty degrees.
  IndexedMesh disc = test::sphere(5);
  for (Vector3& p : disc.points) p = p.cwiseProduct(Vector3(40.0, 40.0, 1.0));
  const RemeshResult result = remesh(disc, options_of(200, Weighting::Constant), Execution(1));
  expect_promises(result, 200);
  EXPECT_EQ(published_report(result).fit.limit, DegreeLimit::Radius);
  EXPECT_TRUE(warns_of(result, "long, flat or sharp"));
  EXPECT_TRUE(warns_of(result, "away from the scan"));
  // Nodes on the scan follow it whatever the series does.
  RemeshOptions on_surface = options_of(200, Weighting::Constant);
  published(on_surface).placement = PublishedPlacement::Surface;
  EXPECT_FALSE(warns_of(remesh(disc, on_surface, Execution(1)), "away from the scan"));
}

TEST(Remesh, ProgressRisesAndCancels) {
  double last = 0.0;
  bool rising = true;
  const Execution watching(1, [&](double fraction, const std::string& stage) {
    rising = rising && fraction >= last && fraction <= 1.0 && !stage.empty();
    last = fraction;
    return true;
  });
  remesh(sand(), options_of(2000, Weighting::Area), watching);
  EXPECT_TRUE(rising);
  EXPECT_EQ(last, 1.0);
  int calls = 0;
  const Execution cancelling(1, [&](double, const std::string&) { return ++calls < 6; });
  try {
    remesh(sand(), options_of(2000, Weighting::Area), cancelling);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

void expect_refused(const IndexedMesh& scan, const RemeshOptions& options, ErrorCode code,
                    const std::string& part_of_the_sentence) {
  try {
    remesh(scan, options, Execution(1));
    ADD_FAILURE() << "accepted; expected: " << part_of_the_sentence;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_TRUE(holds(error.what(), part_of_the_sentence));
  }
}

TEST(Remesh, RefusesOptionsOutOfRangeWithTheRange) {
  const auto refused = [](const auto& change, const std::string& sentence) {
    RemeshOptions options;
    change(options);
    expect_refused(sand(), options, ErrorCode::InvalidInput, sentence);
  };
  refused([](RemeshOptions& o) { o.node_count = 3; }, "from 4 to");
  refused([](RemeshOptions& o) { o.node_count = node_count_option.maximum + 1; }, "from 4 to");
  refused([](RemeshOptions& o) { o.degree = -1; }, "from 0 to 60");
  refused([](RemeshOptions& o) { o.degree = 61; }, "from 0 to 60");
  refused([](RemeshOptions& o) { o.max_repaired_area_percent = 101.0; }, "from 0 to 100");
  const auto refused_on_scan = [&](const auto& change, const std::string& sentence) {
    OnScanOptions on_scan;
    change(on_scan);
    refused([&](RemeshOptions& o) { o.method = on_scan; }, sentence);
  };
  refused_on_scan([](OnScanOptions& o) { o.curvature_alpha = 4.0; }, "from -3 to 3");
  refused_on_scan([](OnScanOptions& o) { o.edge_ratio = 1.0; }, "from 1.08 to 1.6");
  refused_on_scan([](OnScanOptions& o) { o.edge_ratio = std::nan(""); }, "from 1.08 to 1.6");
  refused_on_scan([](OnScanOptions& o) { o.contact_radius = 0.0; }, "above 0");
  refused_on_scan([](OnScanOptions& o) { o.weighting = CellWeighting{17}; }, "weighting");
  refused_on_scan([](OnScanOptions& o) { o.placement = ScanPlacement{9}; }, "placement");
  refused_on_scan([](OnScanOptions& o) { o.handles.action = HandleAction{3}; }, "handles");
  refused_on_scan([](OnScanOptions& o) { o.handles.length_limit = -1.0; }, "loop");
  const auto refused_published = [&](const auto& change, const std::string& sentence) {
    refused(
        [&](RemeshOptions& o) {
          o = options_of(100, Weighting::Area);
          change(published(o));
        },
        sentence);
  };
  refused_published([](AsPublishedOptions& o) { o.max_overhang_percent = 100.0; }, "from 0 to 99");
  refused_published([](AsPublishedOptions& o) { o.curvature_alpha = -4.0; }, "from -3 to 3");
  refused_published([](AsPublishedOptions& o) { o.weighting = Weighting{17}; }, "weighting");
  refused_published([](AsPublishedOptions& o) { o.placement = PublishedPlacement{2}; },
                    "placement");
  refused_published([](AsPublishedOptions& o) { o.sampling = Sampling{-1}; }, "sampling");
  refused(
      [](RemeshOptions& o) {
        o = options_of(100, Weighting::Area);
        published(o).sampling = Sampling::Icosahedron;
        o.target.percent = 1.0;
      },
      "only for some numbers of nodes");
}

/// Seen from the centroid, the rim of the cap hides a part of itself.
IndexedMesh mushroom() {
  IndexedMesh mesh;
  mesh.points = fibonacci_lattice(4000);
  mesh.triangles = SphereTriangulation(mesh.points).triangles();
  for (Vector3& p : mesh.points) {
    // Points of the lower half are drawn up into a bowl.
    if (p.z() < 0.0) p.z() = 0.6 * -p.z();
  }
  return mesh;
}

/// A thick rod bent round 210 degrees: its ends hide each other a little.
IndexedMesh bent_rod() {
  IndexedMesh mesh;
  mesh.points = fibonacci_lattice(4000);
  mesh.triangles = SphereTriangulation(mesh.points).triangles();
  for (Vector3& p : mesh.points) {
    const double along = 105.0 * test::pi / 180.0 * p.z();
    const double radius = 1.0 + 0.4 * p.x();
    p = Vector3(radius * std::cos(along), radius * std::sin(along), 0.4 * p.y());
  }
  return mesh;
}

TEST(Remesh, RefusesAnOverhangAboveTheLimit) {
  RemeshOptions options = options_of(200, Weighting::Area);
  expect_refused(mushroom(), options, ErrorCode::NotStarShaped,
                 "Use --method on-scan. It accepts closed grains with overhangs, and with up to 50 "
                 "handles.");
  options.method = OnScanOptions();  // the advice
  expect_closed(remesh(mushroom(), options, Execution(1)), 200);
}

TEST(Remesh, AnOverhangUnderTheLimitIsRemeshedWithAWarning) {
  RemeshOptions options = options_of(200, Weighting::Area);
  published(options).max_overhang_percent = 60.0;
  const RemeshResult bowl = remesh(mushroom(), options, Execution(1));
  expect_promises(bowl, 200);
  EXPECT_GT(published_report(bowl).overhang_fraction, overhang_warning_limit);
  EXPECT_LT(published_report(bowl).overhang_fraction, 0.6);
  EXPECT_TRUE(warns_of(bowl, "Overhangs"));
  const double percent = 100.0 * published_report(bowl).overhang_fraction;
  published(options).max_overhang_percent = 1.001 * percent;
  EXPECT_NO_THROW(remesh(mushroom(), options, Execution(1)));
  published(options).max_overhang_percent = 0.999 * percent;
  expect_refused(mushroom(), options, ErrorCode::NotStarShaped, "Use --method on-scan");

  // Within the limit as it is.
  const AsPublishedOptions usual;
  published(options).max_overhang_percent = usual.max_overhang_percent;
  const RemeshResult bent = remesh(bent_rod(), options, Execution(1));
  expect_promises(bent, 200);
  EXPECT_GT(published_report(bent).overhang_fraction, overhang_warning_limit);
  EXPECT_LT(published_report(bent).overhang_fraction, 0.01 * usual.max_overhang_percent);
  EXPECT_TRUE(warns_of(bent, "Overhangs"));
  EXPECT_FALSE(warns_of(remesh(sand(), options_of(200, Weighting::Area), Execution(1)), "verhang"));
}

TEST(Remesh, ResidualOfAScanWithOverhangsIsThatOfAllItsSheets) {
  RemeshOptions options = options_of(20000, Weighting::Area);
  published(options).max_overhang_percent = 60.0;
  published(options).sampling = Sampling::Fibonacci;  // what is measured is the series
  options.measures.distances = true;
  for (const IndexedMesh& body : {mushroom(), bent_rod()}) {
    const RemeshResult result = remesh(body, options, Execution(2));
    ASSERT_GT(published_report(result).overhang_fraction, 0.0);
    // From the scan, whose hidden sheets the series cannot follow. 10,000 points scatter by 1 %,
    // and 5 % is what is promised; read by rays it is 24 % too small on the first.
    EXPECT_NEAR(
        published_report(result).fit.residual / result.distances->from_reference.root_mean_square,
        1.0, 0.05);
  }
}

TEST(Remesh, WarningsDoNotFollowTheLocale) {
  RemeshOptions options = options_of(200, Weighting::Area);
  const RemeshResult plain = remesh(bent_rod(), options, Execution(1));
  ASSERT_TRUE(warns_of(plain, " % of the sphere"));
  const test::GermanNumbers german;
  const RemeshResult result = remesh(bent_rod(), options, Execution(1));
  EXPECT_TRUE(result.warnings == plain.warnings);
}

TEST(Remesh, ASmallSecondPartIsLeftOutWithAWarning) {
  const IndexedMesh crumb =
      test::transformed(test::sphere(2), 0.2 * Eigen::Matrix3d::Identity(), Vector3(3, 0, 0));
  const RemeshResult alone = remesh(test::lumpy(4), options_of(200, Weighting::Area), Execution(1));
  const RemeshResult result =
      remesh(test::joined(test::lumpy(4), crumb), options_of(200, Weighting::Area), Execution(1));
  expect_promises(result, 200);
  EXPECT_EQ(result.input.components, 2U);
  EXPECT_TRUE(warns_of(result, "2 separate bodies"));
  EXPECT_FALSE(warns_of(alone, "parts"));
  EXPECT_EQ(result.mesh.points, alone.mesh.points);
}

TEST(Remesh, AHandleIsClosedWithAWarning) {
  // A ball with a ring through its surface, half outside.
  test::VoxelGrid grid;
  grid.size = {48, 40, 40};
  grid.spacing = 0.06;
  grid.origin = Vector3(-1.17, -1.17, -1.17);
  grid.values.resize(48 * 40 * 40);
  for (int z = 0; z < grid.size[2]; ++z) {
    for (int y = 0; y < grid.size[1]; ++y) {
      for (int x = 0; x < grid.size[0]; ++x) {
        const Vector3 p = grid.origin + grid.spacing * Vector3(x, y, z);
        const double from_ring = std::hypot(std::hypot(p.x() - 1.0, p.y()) - 0.3, p.z());
        grid.values[grid.index(x, y, z)] = std::max(1.0 - p.norm(), 0.12 - from_ring);
      }
    }
  }
  const RemeshResult result =
      remesh(test::marching_cubes(grid, 0.0), options_of(200, Weighting::Area), Execution(1));
  expect_promises(result, 200);
  EXPECT_EQ(result.input.genus, 1);
  EXPECT_TRUE(warns_of(result, "1 handle"));
  EXPECT_TRUE(warns_of(result, "Overhangs"));  // the ring hides a part of the ball
}

TEST(Remesh, AFlatLeafDoesNotCrash) {
  // Of few nodes one at the pole would weigh up to thousands of steradian, whose exponential
  // overflows: such weights are damped instead.
  for (const int nodes : {4, 12, 50}) {
    SCOPED_TRACE(nodes);
    expect_promises(remesh(Ellipsoid(Vector3(1.0, 1.0, 0.06)),
                           options_of(nodes, Weighting::RadialDistance), Execution(1)),
                    nodes);
  }
  IndexedMesh disc;
  disc.points = fibonacci_lattice(4000);
  disc.triangles = SphereTriangulation(disc.points).triangles();
  disc = test::scaled(std::move(disc), Vector3(40.0, 40.0, 1.0));
  expect_promises(remesh(disc, options_of(50, Weighting::RadialDistance), Execution(1)), 50);
}

TEST(Remesh, ANumberOfNodesThatDoesNotReachALongBodyIsRefusedWithOneThatDoes) {
  const IndexedMesh needle = test::subdivided(test::box(20.0, 0.5, 0.5), 4);
  RemeshOptions options;
  options.node_count = 12;
  std::string sentence;
  try {
    remesh(needle, options, Execution(1));
  } catch (const Error& error) {
    sentence = error.what();
  }
  ASSERT_TRUE(holds(sentence, "needs more than 12 nodes: "));
  const std::size_t at = sentence.find(". ", sentence.find("nodes: ")) + 2;
  options.node_count = std::stoi(sentence.substr(at));
  EXPECT_GT(options.node_count, 12) << sentence;
  const RemeshResult enough = remesh(needle, options, Execution(1));
  for (const double end : {-10.0, 10.0}) {
    double nearest = 100.0;
    for (const Vector3& p : enough.mesh.points) nearest = std::min(nearest, std::abs(p.x() - end));
    EXPECT_LT(nearest, 1.0) << sentence;
  }
  // A compact body can have four nodes.
  options.node_count = 4;
  EXPECT_EQ(remesh(test::sphere(3), options, Execution(1)).mesh.points.size(), 4U);
}

TEST(Remesh, ManyNodesThatLeaveOutMostOfASheetAreRefused) {
  // The sheet's thickness is lost between the nodes' triangles. Its volume is then a speck's.
  const IndexedMesh sheet = test::subdivided(test::box(20.0, 20.0, 0.001), 4);
  const double radius = equivalent_radius(volume_of(sheet, Execution(1)));
  RemeshOptions options;
  int refused = 0;
  for (const int nodes : {140, 200, 300}) {
    options.node_count = nodes;
    try {
      const RemeshResult result = remesh(sheet, options, Execution(1));
      EXPECT_LE(rms_distance(sheet, result.mesh, 1000, Execution(1)), 0.55 * radius) << nodes;
    } catch (const Error& error) {
      EXPECT_TRUE(holds(error.what(), "does not reach all of it"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Remesh, FewNodesOfAThinBodyAreRefusedWithANumberThatFollowsIt) {
  const std::vector<IndexedMesh> bodies = {
      test::subdivided(test::box(10.0, 8.0, 0.3), 3),
      test::scaled(test::sphere(4), Vector3(1.0, 1.0, 0.02)),
      test::scaled(test::sphere(4), Vector3(1.0, 0.25, 0.08)),
  };
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    for (const int nodes : {4, 5, 6}) {
      SCOPED_TRACE(::testing::Message() << "body " << k << ", " << nodes << " nodes");
      RemeshOptions options;
      options.node_count = nodes;
      std::string sentence;
      try {
        remesh(bodies[k], options, Execution(1));
      } catch (const Error& error) {
        sentence = error.what();
      }
      EXPECT_TRUE(nodes > 4 || !sentence.empty()) << "no tetrahedron follows it";
      const std::size_t at = sentence.find(" were tried and are enough.");
      if (!sentence.empty()) {
        ASSERT_NE(at, std::string::npos) << sentence;
        options.node_count = std::stoi(sentence.substr(sentence.rfind(' ', at - 1)));
      }
      const RemeshResult enough = remesh(bodies[k], options, Execution(1));
      EXPECT_LT(enough.remesh.area, 2.0 * enough.scan.area) << sentence;
      // 1,000 samples of the scan were below half a radius.
      EXPECT_LT(enough.rms_distance, 0.7 * equivalent_radius(enough.scan.volume)) << sentence;
    }
  }
}

TEST(Remesh, TooFewNodesOfAMeshWithASpikeNameItsVertex) {
  IndexedMesh spiky = test::lumpy(3);
  spiky.points[300] *= 13.0;
  RemeshOptions options;
  options.node_count = 20;
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { remesh(spiky, options, Execution(1)); });
  EXPECT_EQ(sentence.find("Vertex 300, counted from 0, lies at ("), 0U) << sentence;
  EXPECT_TRUE(holds(sentence, "So long a spike needs more than 20 nodes"));
}

TEST(Remesh, TellsOfTrianglesOfTheScanThatIntersectAtAnyNumberOfNodes) {
  IndexedMesh dented = test::lumpy(4);
  const Vector3 place = dented.points[100];
  for (Vector3& p : dented.points) {
    if ((p - place).norm() < 0.25) p *= -0.6;
  }
  const auto told = [](const IndexedMesh& scan, int nodes) {
    RemeshOptions options;
    options.node_count = nodes;
    std::string text;
    for (const Sentence& warning : remesh(scan, options, Execution(1)).warnings) {
      text += warning.text() + "\n";
    }
    return text.find("intersect") != std::string::npos;
  };
  for (const int nodes : {60, 200, 600}) {
    EXPECT_TRUE(told(dented, nodes)) << nodes;
    EXPECT_FALSE(told(test::lumpy(4), nodes)) << nodes;
  }
}

TEST(Remesh, SurfacesFromFormulasAreDiscretisedAboutTheirOrigin) {
  const Ellipsoid ellipsoid(Vector3(13.0, 9.0, 7.0));
  for (const Weighting weighting : {Weighting::RadialDistance, Weighting::Curvature}) {
    const RemeshResult result = remesh(ellipsoid, options_of(1000, weighting), Execution(1));
    expect_promises(result, 1000);
    EXPECT_EQ(result.centre, Vector3(0.0, 0.0, 0.0));
    for (std::size_t i = 0; i < result.directions.size(); ++i) {
      EXPECT_NEAR(result.radial_distances[i], ellipsoid.radius(result.directions[i]), 1e-12);
    }
    EXPECT_NEAR(result.scan.volume / (4.0 / 3.0 * pi * 13.0 * 9.0 * 7.0), 1.0, 1e-10);
    // Chords lose about 660 / N % of the volume of a round body.
    EXPECT_NEAR(relative_error_percent(result.remesh.volume, result.scan.volume), -0.66, 0.2);
    EXPECT_NEAR(result.scan.inertia_semi_axes[2], 13.0, 0.005);
  }
}

TEST(Remesh, RefusesSurfacesTooLongToBeMeasured) {
  EXPECT_ERROR(remesh(Ellipsoid(Vector3(1e6, 1.0, 1e-6)), RemeshOptions(), Execution()),
               InvalidInput);
}

TEST(Remesh, CoefficientsOfARemeshGiveTheSameSurfaceAgain) {
  const RemeshResult scan = remesh(sand(), options_of(500, Weighting::Area), Execution(1));
  const RemeshResult series = remesh(HarmonicSurface(scan.coefficients.radius),
                                     options_of(500, Weighting::Area), Execution(1));
  // The same surface and the same algorithm in units that differ by the scan's chords.
  EXPECT_NEAR(series.remesh.volume / scan.remesh.volume, 1.0, 1e-3);
  EXPECT_NEAR(series.remesh.sdq / scan.remesh.sdq, 1.0, 1e-2);
}

TEST(Remesh, SamplingsOfFigure1AreTriangulatedTheSameWay) {
  const auto nodes_of = [](Sampling sampling, int nodes, std::size_t warnings) {
    RemeshOptions options = options_of(nodes, Weighting::Area);
    published(options).sampling = sampling;
    const RemeshResult result = remesh(sand(), options, Execution(1));
    expect_promises(result, static_cast<int>(result.mesh.points.size()));
    const bool misses = warns_of(result, "not accurate:");
    EXPECT_EQ(result.warnings.size(), warnings + (misses ? 1U : 0U));
    EXPECT_EQ(published_report(result).relaxation.iterations, 0);
    return result.mesh.points.size();
  };
  EXPECT_EQ(nodes_of(Sampling::Fibonacci, 1000, 0), 1000U);
  EXPECT_EQ(nodes_of(Sampling::EqualAngle, 1000, 1), 1014U);
  EXPECT_EQ(nodes_of(Sampling::Icosahedron, 1000, 1), 1002U);
  EXPECT_EQ(nodes_of(Sampling::Icosahedron, 642, 0), 642U);
}

TEST(Remesh, PointsAreFittedWhenChosen) {
  IndexedMesh points;
  points.points = sand().points;
  RemeshOptions chosen = options_of(500, Weighting::Area);
  try {
    remesh(points, chosen, Execution(1));
    FAIL() << "points were taken for a scan";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_TRUE(holds(error.what(), "--points"));
  }
  chosen.points = true;  // the advice
  const RemeshResult cloud = remesh(points, chosen, Execution(1));
  EXPECT_TRUE(warns_of(cloud, "read as points"));
  // Faces are not used, and it is said.
  const RemeshResult of_scan = remesh(sand(), chosen, Execution(1));
  EXPECT_EQ(of_scan.mesh.points, cloud.mesh.points);
  EXPECT_TRUE(warns_of(of_scan, std::to_string(sand().triangles.size()) + " faces were not used"));
  const RemeshResult scan = remesh(sand(), options_of(500, Weighting::Area), Execution(1));
  expect_promises(cloud, 500);
  EXPECT_EQ(cloud.input.input_vertices, points.points.size());
  EXPECT_EQ(cloud.input.input_faces, 0U);
  EXPECT_NEAR(cloud.remesh.volume / scan.remesh.volume, 1.0, 2e-3);
  EXPECT_NEAR(cloud.remesh.area / scan.remesh.area, 1.0, 5e-3);
  EXPECT_FALSE(warns_of(scan, "points"));
}

/// Follows the advice of a refusal: the shrink-wrap that it names can be remeshed.
void expect_that_the_advice_works(const IndexedMesh& scan, RemeshOptions options,
                                  const std::string& sentence) {
  std::smatch advice;
  ASSERT_TRUE(std::regex_search(sentence, advice, std::regex("--shrink-wrap ([0-9.]+)")))
      << sentence;
  options.shrink_wrap.opening_percent = std::stod(advice[1]);
  const RemeshResult wrapped = remesh(scan, options, Execution(1));
  EXPECT_EQ(wrapped.mesh.points.size(), static_cast<std::size_t>(options.node_count));
}

TEST(Remesh, ARefusalNamesAShrinkWrapThatWorks) {
  RemeshOptions options;
  options.node_count = 300;
  const auto sentence_of = [&](const IndexedMesh& scan) {
    return test::refusal(ErrorCode::InvalidInput, [&] { remesh(scan, options, Execution(1)); });
  };
  options.max_repaired_area_percent = 0.5;
  IndexedMesh open = test::sphere(4);
  open.triangles.resize(open.triangles.size() - 40);
  expect_that_the_advice_works(open, options, sentence_of(open));
}

TEST(Remesh, PointsBehindOthersAreToldAndTakenByAShrinkWrap) {
  // Points of a ball, and strays inside it as scanners leave them.
  IndexedMesh cloud = {fibonacci_lattice(4000), {}};
  for (const Vector3& p : fibonacci_lattice(400)) cloud.points.push_back(0.6 * p);
  RemeshOptions options = options_of(300, Weighting::Area);
  options.points = true;
  const RemeshResult spiky = remesh(cloud, options, Execution(1));
  EXPECT_TRUE(warns_of(spiky, "Make a surface of them first")) << spiky.steep_area_fraction;
  options.shrink_wrap.opening_percent = 10.0;
  const RemeshResult wrapped = remesh(cloud, options, Execution(1));
  expect_promises(wrapped, 300);
  EXPECT_FALSE(warns_of(wrapped, "Make a surface of them first"));
  EXPECT_TRUE(warns_of(wrapped, "replaced by its shrink-wrap."));
  cloud.triangles = {{0, 1, 2}};
  const RemeshResult with_faces = remesh(cloud, options, Execution(1));
  EXPECT_EQ(with_faces.mesh.points, wrapped.mesh.points);
  EXPECT_TRUE(warns_of(with_faces, "faces were not used"));
  EXPECT_EQ(wrapped.input.input_vertices, cloud.points.size());
  // Faces as wide as the opening, .35, cut off up to .35^2 / 6 of the radius.
  EXPECT_NEAR(wrapped.input.volume / (4.0 * test::pi / 3.0), 1.0, 0.06);

  // Two on one ray have no surface at all, and are told the same, and of a wrap.
  options.shrink_wrap.opening_percent = 0.0;
  cloud = {};
  // 512 points whose mean is 0 without rounding.
  for (double x = -2.0; x <= 2.0; ++x) {
    for (double y = -3.5; y <= 3.5; ++y) {
      for (double z = -4.5; z <= 4.5; ++z) {
        if (std::abs(x) < 2.0 && std::abs(y) < 3.5 && std::abs(z) < 4.5) continue;
        cloud.points.insert(cloud.points.end(), {Vector3(x, y, z), 0.5 * Vector3(x, y, z)});
      }
    }
  }
  const std::string sentence =
      test::refusal(ErrorCode::NumericalFailure, [&] { remesh(cloud, options, Execution(1)); });
  EXPECT_TRUE(holds(sentence, "Make a surface of them first"));
  expect_that_the_advice_works(cloud, options, sentence);
}

TEST(Remesh, ProgressNeverGoesBackNorFallsSilent) {
  const IndexedMesh scan = test::lumpy(5);
  const auto progress_of = [&](RemeshOptions options) {
    std::vector<double> fractions;
    remesh(scan, options, Execution(1, [&](double fraction, const std::string&) {
             fractions.push_back(fraction);
             return true;
           }));
    EXPECT_EQ(fractions.front(), 0.0);
    EXPECT_EQ(fractions.back(), 1.0);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    return fractions.size();
  };
  const std::size_t plain = progress_of(options_of(200, Weighting::Area));
  // Each loop over the scan calls between its blocks of 1,024; 10,242 vertices have eleven.
  EXPECT_GT(plain, 100U);
  RemeshOptions with_target = options_of(100, Weighting::Area);
  with_target.target.percent = 3.0;
  EXPECT_GT(progress_of(with_target), plain);
  // Stages that take seconds at a million vertices, each with calls of its own.
  RemeshOptions with_distances = options_of(200, Weighting::Area);
  with_distances.measures.distances = true;
  // Samples of both surfaces in blocks of 256, in the place of the 20,000 that `plain` takes.
  EXPECT_GT(progress_of(with_distances), plain + 20000 / 256);
  RemeshOptions on_scan;
  on_scan.node_count = 200;
  EXPECT_GT(progress_of(on_scan), 10U);
  RemeshOptions with_points = options_of(200, Weighting::Area);
  with_points.points = true;
  EXPECT_GT(progress_of(with_points), plain);
}

TEST(Remesh, RefusesScansBeyondTheRangeOfNumbers) {
  for (const bool points : {false, true}) {
    for (const double size : {1e-130, 1e-61, 1e61, 1e80, 1e300}) {
      IndexedMesh scan = test::lumpy(3);
      for (Vector3& p : scan.points) p *= size;
      RemeshOptions options = options_of(100, Weighting::Area);
      options.points = points;
      try {
        remesh(scan, options, Execution(1));
        ADD_FAILURE() << size;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_TRUE(holds(error.what(), "Scale it"));
      }
    }
    // The advice: within the limits it comes out.
    for (const double size : {1e-59, 1e59}) {
      IndexedMesh scan = test::lumpy(3);
      for (Vector3& p : scan.points) p *= size;
      RemeshOptions options = options_of(100, Weighting::Area);
      options.points = points;
      expect_promises(remesh(scan, options, Execution(1)), 100);
    }
  }
}

TEST(Remesh, WarnsOfCoordinatesThatTheFileHasSpoilt) {
  IndexedMesh scan = test::lumpy(5);
  EXPECT_FALSE(warns_of(remesh(scan, options_of(100, Weighting::Area), Execution(1)), "precision"));
  for (Vector3& p : scan.points) {
    p += Vector3(3e4, 0, 0);
    for (int axis = 0; axis < 3; ++axis) {
      // Volatile: optimised, GCC 12 leaves the rounding to single precision out.
      volatile const auto single = static_cast<float>(p[axis]);
      p[axis] = single;
    }
  }
  EXPECT_TRUE(warns_of(remesh(scan, options_of(100, Weighting::Area), Execution(1)), "precision"));
}

TEST(Remesh, HalfEdgeMeshesGoInAndOut) {
  const RemeshResult flat = remesh(sand(), options_of(200, Weighting::Area), Execution(1));
  // Colours and numbers that say where a vertex and a face are.
  const IndexedMesh scan = sand();
  Mesh mesh = to_mesh(scan);
  mesh.request_vertex_colors();
  OpenMesh::VPropHandleT<double> height;
  OpenMesh::FPropHandleT<int> label;
  mesh.add_property(height, "height");
  mesh.add_property(label, "label");
  const auto is_above = [](const Mesh::Point& p) { return p[2] > 0.0; };
  for (const auto v : mesh.vertices()) {
    mesh.property(height, v) = mesh.point(v)[2];
    mesh.set_color(v, Mesh::Color(200, is_above(mesh.point(v)) ? 100 : 0, 50));
  }
  for (const auto f : mesh.faces()) {
    mesh.property(label, f) = is_above(mesh.calc_face_centroid(f)) ? 7 : 3;
  }
  const RemeshResult result = remesh(mesh, options_of(200, Weighting::Area), Execution(1));
  EXPECT_EQ(flat.mesh.points, result.mesh.points);
  const Mesh half_edges = to_mesh(result);
  ASSERT_EQ(half_edges.n_vertices(), 200U);
  ASSERT_TRUE(half_edges.has_vertex_colors());
  ASSERT_TRUE(half_edges.get_property_handle(height, "height"));
  ASSERT_TRUE(half_edges.get_property_handle(label, "label"));
  // Nodes lie off the scan by some per cent of its radius.
  const double near = 0.1 * result.input.equivalent_radius;
  for (const auto v : half_edges.vertices()) {
    const Mesh::Point p = half_edges.point(v);
    EXPECT_NEAR(half_edges.property(height, v), p[2], near);
    EXPECT_EQ(half_edges.color(v)[0], 200);
    if (std::abs(p[2]) > near) {
      EXPECT_EQ(half_edges.color(v)[1], is_above(p) ? 100 : 0);
    }
  }
  for (const auto f : half_edges.faces()) {
    const Mesh::Point p = half_edges.calc_face_centroid(f);
    if (std::abs(p[2]) > near) {
      EXPECT_EQ(half_edges.property(label, f), is_above(p) ? 7 : 3);
    }
  }
}

/// Fitted nodes, with their distances.
RemeshOptions fitted_options(int nodes) {
  RemeshOptions options;
  options.node_count = nodes;
  options.measures.distances = true;
  return options;
}

TEST(RemeshDistances, AreThereOnDemandOnly) {
  const RemeshResult without =
      remesh(sand(), options_of(100, Weighting::RadialDistance), Execution(1));
  EXPECT_FALSE(without.distances.has_value());
  EXPECT_TRUE(without.vertex_distances.empty());
  EXPECT_ERROR(error_percent(without, ErrorMeasure::Distance), InvalidInput);
  const RemeshResult with = remesh(sand(), fitted_options(100), Execution(1));
  ASSERT_EQ(with.vertex_distances.size(), 100U);
  // Fitted nodes are on both sides of the scan, so that the volume is exact.
  const auto [inside, outside] =
      std::minmax_element(with.vertex_distances.begin(), with.vertex_distances.end());
  EXPECT_LT(*inside, 0.0);
  EXPECT_GT(*outside, 0.0);
  EXPECT_LE(std::max(-*inside, *outside), with.distances->to_reference.maximum * (1.0 + 1e-12));
  const MeshDistance scan(sand());
  for (std::size_t v = 0; v < 100; ++v) {
    const Vector3& point = with.mesh.points[v];
    EXPECT_NEAR(std::abs(with.vertex_distances[v]), scan.distance(point), 1e-9);
    EXPECT_EQ(with.vertex_distances[v] < 0.0, scan.contains(point)) << v;
  }
}

TEST(RemeshErrorTarget, FindsTheSmallestCountThatMeetsIt) {
  RemeshOptions options = fitted_options(200);
  options.measures.distances = false;
  options.target.measure = ErrorMeasure::Distance;
  options.target.percent = 1.0;
  const RemeshResult result = remesh(sand(), options, Execution(1));
  ASSERT_TRUE(result.search.has_value());
  EXPECT_TRUE(result.search->met);
  EXPECT_EQ(static_cast<int>(result.mesh.points.size()), result.search->node_count);
  expect_closed(result, result.search->node_count);
  EXPECT_LE(error_percent(result, ErrorMeasure::Distance), 1.0);
  EXPECT_EQ(result.options.node_count, result.search->node_count);
  // With a tenth fewer nodes the target is missed: errors go with 1 / N and waver by a few per
  // cent.
  RemeshOptions fewer = options;
  fewer.target.percent = 0.0;
  fewer.measures.distances = true;
  fewer.node_count = result.search->node_count * 9 / 10;
  EXPECT_GT(error_percent(remesh(sand(), fewer, Execution(1)), ErrorMeasure::Distance), 1.0);
}

TEST(RemeshErrorTarget, EveryMeasureCanBeATarget) {
  for (const auto measure : {ErrorMeasure::Volume, ErrorMeasure::Area, ErrorMeasure::Sphericity,
                             ErrorMeasure::Inertia}) {
    SCOPED_TRACE(static_cast<int>(measure));
    RemeshOptions options = options_of(100, Weighting::RadialDistance);
    options.target.measure = measure;
    options.target.percent = 5.0;
    options.target.largest_node_count = 3000;
    const RemeshResult result = remesh(sand(), options, Execution(1));
    EXPECT_TRUE(result.search->met);
    EXPECT_LE(error_percent(result, measure), 5.0);
  }
}

TEST(RemeshErrorTarget, SaysSoWhenTheLimitIsTooLow) {
  RemeshOptions options = fitted_options(50);
  options.target.percent = 0.01;
  options.target.largest_node_count = 80;
  const RemeshResult result = remesh(sand(), options, Execution(1));
  EXPECT_FALSE(result.search->met);
  EXPECT_EQ(result.mesh.points.size(), 80U);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_TRUE(holds(result.warnings.back().text(), "has an error of at most"));
}

TEST(RemeshErrorTarget, StopsAtOnceWhereTheSeriesItselfIsFartherOff) {
  // A cube's edges are beyond a series of degree 6.
  const IndexedMesh cube = test::subdivided(test::box(1.0, 1.0, 1.0), 8);
  RemeshOptions options = options_of(200, Weighting::Area);
  options.degree = 6;
  options.target.percent = 0.5;
  try {
    remesh(cube, options, Execution(1));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    EXPECT_TRUE(holds(error.what(), "Nodes on it are not closer"));
  }
  options.method = OnScanOptions();  // the advice
  EXPECT_TRUE(remesh(cube, options, Execution(1)).search->met);
}

TEST(RemeshErrorTarget, RefusesTargetsThatMakeNoSense) {
  RemeshOptions options = fitted_options(50);
  options.target.percent = -1.0;
  EXPECT_ERROR(remesh(sand(), options, Execution(1)), InvalidInput);
  options.target.percent = 1.0;
  options.target.largest_node_count = 3;
  EXPECT_ERROR(remesh(sand(), options, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
