// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/space_relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grains/bent_grain.h"
#include "support/added_points.h"
#include "support/expect_error.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/measures/distances.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/sphere/orientation.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/quadric_surface.h"
#include "wscvt/surface/sphere_map.h"

namespace wscvt {
namespace {

struct Body {
  explicit Body(const IndexedMesh& mesh, const Execution& execution = Execution(1))
      : map(map_to_sphere(mesh, SphereMapOptions(), execution)),
        surface(mesh, map.directions, execution) {}
  SphereMap map;
  MappedSurface surface;
};

const Body& hook() {
  static const Body body(test::bent_grain_mesh(test::bent_grain("hook"), 3000));
  return body;
}

SpaceTessellation relaxed(const Body& body, int count, const std::vector<double>& densities = {},
                          const MultilevelOptions& levels = {}, int threads = 1) {
  const int coarsest = level_sizes(count, levels.coarsest_seeds).front();
  return relax_in_space(surviving_seeds(body.surface, body.map.collapse_order, coarsest), count,
                        body.surface, site_density(body.surface, densities), RelaxationOptions(),
                        levels, Execution(threads));
}

/// Closed with so many nodes, upright on the sphere, and on the surface.
void expect_promises(const SpaceTessellation& tessellation, const Body& body, std::size_t count) {
  ASSERT_EQ(tessellation.seeds.size(), count);
  ASSERT_EQ(tessellation.positions.size(), count);
  // The constructor checks that the triangles are a closed 2-manifold, upright on the sphere.
  EXPECT_NO_THROW(SphereTriangulation(tessellation.seeds, tessellation.triangulation.triangles()));
  const MeshDistance scan(body.surface.mesh());
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(tessellation.seeds[i].norm(), 1.0, 1e-14);
    // Barycentric coordinates of a point of size 1 round to a few 1e-16.
    ASSERT_LT(scan.distance(tessellation.positions[i]), 1e-13);
  }
}

TEST(SpaceRelaxation, EvensOutAHookThatNoRayDescribes) {
  const SpaceTessellation result = relaxed(hook(), 300);
  expect_promises(result, hook(), 300);
  const MeshQuality quality = measure_quality({result.positions, result.triangulation.triangles()});
  // The mean of centroidal tessellations is 1.10 to 1.15; the start's is above 1.3.
  EXPECT_LT(quality.edge_ratio.mean, 1.17);
  EXPECT_GT(quality.smallest_angle, 25.0);
  EXPECT_NE(result.report.outcome, RelaxationOutcome::Stuck);
  EXPECT_LT(result.report.history.back().displacement, RelaxationOptions().displacement_tolerance);
}

TEST(SpaceRelaxation, TakesAnySurfaceOverTheSphere) {
  // An ellipsoid by its radii: no mesh, no map.
  const Vector3 axes(1.0, 0.7, 0.5);
  const Ellipsoid ellipsoid(axes);
  const MultilevelOptions levels;
  const SiteDensity upper = [](const Vector3& u, const MeshPlace&) {
    return u.z() > 0.0 ? 3.0 : 1.0;
  };
  for (const SiteDensity& density : {SiteDensity(), upper}) {
    const int count = 200;
    const SpaceTessellation result =
        relax_in_space(fibonacci_lattice(level_sizes(count, levels.coarsest_seeds).front()), count,
                       ellipsoid, density, RelaxationOptions(), levels, Execution(1));
    ASSERT_EQ(result.positions.size(), 200U);
    int above = 0;
    for (const Vector3& p : result.positions) {
      EXPECT_NEAR(p.cwiseQuotient(axes).norm(), 1.0, 1e-13);
      above += p.z() > 0.0 ? 1 : 0;
    }
    // Half of them or three quarters, but for half a row of cells at the equator (13 of 26).
    EXPECT_NEAR(above, density ? 150 : 100, 13);
    const MeshQuality quality =
        measure_quality({result.positions, result.triangulation.triangles()});
    if (!density) {
      EXPECT_LT(quality.edge_ratio.mean, 1.17);
    }
    EXPECT_NE(result.report.outcome, RelaxationOutcome::Stuck);
  }
}

TEST(SpaceRelaxation, LevelsGiveExactlyTheNumberAskedFor) {
  MultilevelOptions levels;
  levels.coarsest_seeds = 30;
  for (const int count : {123, 200, 397}) {
    const SpaceTessellation result = relaxed(hook(), count, {}, levels);
    expect_promises(result, hook(), static_cast<std::size_t>(count));
    EXPECT_FALSE(result.report.coarser_levels.empty());
  }
}

TEST(SpaceRelaxation, AHandfulOfNodesStaysUpright) {
  for (int count = 4; count <= 20; ++count) {
    expect_promises(relaxed(hook(), count), hook(), static_cast<std::size_t>(count));
  }
}

TEST(SpaceRelaxation, MoreNodesThanVerticesAreFound) {
  const Body body(test::scaled(test::sphere(1), Vector3(1.0, 0.7, 0.5)));
  ASSERT_LT(body.surface.mesh().points.size(), 100U);
  expect_promises(relaxed(body, 100), body, 100);
}

TEST(SpaceRelaxation, SameBytesOnAnyNumberOfThreads) {
  const SpaceTessellation one = relaxed(hook(), 200);
  const SpaceTessellation three = relaxed(hook(), 200, {}, {}, 3);
  EXPECT_EQ(one.seeds, three.seeds);
  EXPECT_EQ(one.positions, three.positions);
  EXPECT_EQ(one.triangulation.triangles(), three.triangulation.triangles());
  EXPECT_EQ(one.cell_areas, three.cell_areas);
}

TEST(SpaceRelaxation, DensitiesShareOutTheNodes) {
  const Body body(test::sphere(4));
  const std::vector<Vector3>& points = body.surface.mesh().points;
  std::vector<double> densities;
  for (const Vector3& p : points) densities.push_back(p.z() > 0.0 ? 3.0 : 1.0);
  const SpaceTessellation result = relaxed(body, 400, densities);
  int upper = 0;
  for (const Vector3& p : result.positions) upper += p.z() > 0.0 ? 1 : 0;
  // Three quarters, but for half a row of cells at the equator (about 18 of 36).
  EXPECT_NEAR(upper, 300, 20);
}

TEST(SpaceRelaxation, ReportsTheSpreadOfTheCellsAreas) {
  const Body body(test::scaled(test::sphere(3), Vector3(1.0, 0.7, 0.5)));
  // The same density everywhere is none.
  for (const std::vector<double>& densities :
       {std::vector<double>(), std::vector<double>(body.surface.mesh().points.size(), 2.0)}) {
    const SpaceTessellation result = relaxed(body, 60, densities);
    double sum = 0.0;
    double squares = 0.0;
    for (const double area : result.cell_areas) {
      sum += area / 60.0;
      squares += area * area / 60.0;
    }
    const double spread = std::sqrt(squares / (sum * sum) - 1.0);
    EXPECT_GT(spread, 0.0);
    EXPECT_NEAR(result.report.history.back().area_spread / spread, 1.0, 1e-9);
  }
}

TEST(SpaceRelaxation, LevelsCutEdgesInTheirMiddlesOnTheSurface) {
  // Nothing is moved, so that the seeds of the coarser level come first and those in the middles of
  // its edges after them. The body is so long that the middle of an edge on the sphere is far from
  // its middle in space.
  const Body body(test::scaled(test::sphere(4), Vector3(4.0, 1.0, 0.7)));
  constexpr int coarse = 40;
  constexpr int count = 4 * coarse - 6;
  RelaxationOptions options;
  options.maximum_iterations = 0;
  MultilevelOptions levels;
  levels.coarsest_seeds = coarse;
  const std::vector<Vector3> start = fibonacci_lattice(coarse);
  const SpaceTessellation before =
      relax_in_space(start, coarse, body.surface, {}, options, levels, Execution(1));
  const SpaceTessellation after =
      relax_in_space(start, count, body.surface, {}, options, levels, Execution(1));
  ASSERT_EQ(after.seeds.size(), static_cast<std::size_t>(count));
  const SphereTriangulation& edges = before.triangulation;
  std::size_t i = coarse;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(edges.opposite().size()); ++h) {
    const std::int32_t other = edges.opposite()[h];
    if (h > other) continue;
    const double to_a = (after.positions[i] - before.positions[edges.origin(h)]).norm();
    const double to_b = (after.positions[i] - before.positions[edges.origin(other)]).norm();
    // Six bisections leave a 160th of the way along the edge on the sphere.
    EXPECT_NEAR(to_a / to_b, 1.0, 0.1) << i;
    ++i;
  }
  EXPECT_EQ(i, after.seeds.size());
}

TEST(SpaceRelaxation, SeedsThatAreMissingAreAddedWhereThereIsMostRoom) {
  // Nothing is moved, so the three seeds added stand last.
  const Body body(test::scaled(test::sphere(4), Vector3(4.0, 1.0, 0.7)));
  constexpr int coarse = 40;
  constexpr int count = 4 * coarse - 6 + 3;
  RelaxationOptions options;
  options.maximum_iterations = 0;
  MultilevelOptions levels;
  levels.coarsest_seeds = coarse;
  const SpaceTessellation result = relax_in_space(fibonacci_lattice(coarse), count, body.surface,
                                                  {}, options, levels, Execution(1));
  ASSERT_EQ(result.positions.size(), static_cast<std::size_t>(count));
  test::expect_room_about_the_last(result.positions, 3);
}

TEST(SpaceRelaxation, StepsThatWouldTurnATriangleOverAreMadeSiteBySite) {
  // Random seeds have needles, which on so long a body the first step would turn over if it were
  // made by all at once.
  const Body body(test::scaled(test::sphere(4), Vector3(4.0, 1.0, 0.7)));
  RelaxationOptions options;
  options.maximum_iterations = 1;
  MultilevelOptions one_level;
  one_level.coarsest_seeds = 600;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const SpaceTessellation result =
        relax_in_space(random_directions(600, test::announced(seed)), 600, body.surface, {},
                       options, one_level, Execution(1));
    expect_promises(result, body, 600);
    // The sites arrive at their centroids, which have moved meanwhile by two fifths of that; half
    // the step would leave three quarters.
    ASSERT_EQ(result.report.history.size(), 2U);
    EXPECT_LT(result.report.history[1].displacement, 0.5 * result.report.history[0].displacement);
  }
}

TEST(SpaceRelaxation, OfSeedsWithTheirTriangulationIsThatOfOneLevel) {
  const Body body(test::scaled(test::sphere(3), Vector3(1.0, 0.7, 0.5)));
  const std::vector<Vector3> start = fibonacci_lattice(50);
  const SphereTriangulation triangulation(start);
  const SpaceTessellation one = relax_in_space(start, 50, body.surface, {}, RelaxationOptions(),
                                               MultilevelOptions(), Execution(1));
  const SpaceTessellation other =
      relax_in_space(start, triangulation, body.surface, {}, RelaxationOptions(), Execution(1));
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.triangulation.triangles(), other.triangulation.triangles());
  EXPECT_ERROR(relax_in_space(fibonacci_lattice(49), triangulation, body.surface, {},
                              RelaxationOptions(), Execution(1)),
               InvalidInput);
}

TEST(SpaceRelaxation, RefusesNumbersThatDoNotFit) {
  const auto refusal = [](const auto& call) {
    return test::refusal(ErrorCode::InvalidInput, call);
  };
  EXPECT_NE(refusal([] {
              relaxed(hook(), 50, {1.0, 2.0});
            }).find("give one each, or none"),
            std::string::npos);
  EXPECT_NE(refusal([] {
              surviving_seeds(hook().surface, hook().map.collapse_order, 3);
            }).find("at least 4"),
            std::string::npos);
  EXPECT_NE(refusal([] {
              relax_in_space(fibonacci_lattice(20), 30, hook().surface, {}, RelaxationOptions(),
                             MultilevelOptions(), Execution(1));
            }).find("20 seeds instead of 30"),
            std::string::npos);
}

}  // namespace
}  // namespace wscvt
