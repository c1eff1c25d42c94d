// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "toolbox/map/mapped_surface.h"
#include "toolbox/map/scan_harmonics.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/remesh.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt {
namespace {

using test::holds;

MappedSurface mapped_body(const IndexedMesh& mesh) {
  return MappedSurface(mesh, map_to_sphere(mesh, Execution(1)), Execution(1));
}

/// Over the vertices, at equal directions.
double rms_distance(const MappedSurface& surface, const HarmonicMap& map) {
  const std::vector<Vector3> there = map.positions(surface.directions(), Execution(1));
  double squares = 0.0;
  for (std::size_t i = 0; i < there.size(); ++i) {
    squares += (there[i] - surface.mesh().points[i]).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(there.size()));
}

TEST(HarmonicMap, AnEllipsoidIsOfDegreeOne) {
  // Under the affine map of the sphere x, y and z are harmonics of degree 1.
  const IndexedMesh ball = test::sphere(5);
  const Vector3 axes(1.0, 0.6, 0.3);
  const Vector3 shift(4.0, 5.0, 6.0);
  const IndexedMesh mesh = test::transformed(ball, axes.asDiagonal().toDenseMatrix(), shift);
  const HarmonicMap map =
      fit_harmonic_map(MappedSurface(mesh, ball.points, Execution(1)), 6, Execution(1));
  EXPECT_EQ(map.degree(), 6);
  const double unit = std::sqrt(4.0 * test::pi / 3.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>& a = map.coefficients()[k];
    std::vector<double> expected(a.size(), 0.0);
    const auto axis = static_cast<Eigen::Index>(k);
    expected[0] = shift[axis] * std::sqrt(4.0 * test::pi);
    if (k == 0) expected[harmonic_index(1, 1)] = -axes[axis] * unit;
    if (k == 1) expected[harmonic_index(1, -1)] = -axes[axis] * unit;
    if (k == 2) expected[harmonic_index(1, 0)] = axes[axis] * unit;
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], expected[i], 2e-3) << k << " " << i;
  }
}

TEST(HarmonicMap, ComesCloserToBentGrainsWithTheDegree) {
  for (const char* name : {"hook", "C-shape", "mushroom"}) {
    const IndexedMesh mesh = test::bent_grain_mesh(test::bent_grain(name), 5000);
    const auto report = check_mesh(mesh, {}, Execution(1)).report;
    const MappedSurface surface = mapped_body(mesh);
    double before = 1.0;
    for (const int degree : {5, 10, 20}) {
      const HarmonicMap map = fit_harmonic_map(surface, degree, Execution(1));
      EXPECT_EQ(map.degree(), degree) << name;
      const double distance = rms_distance(surface, map) / report.equivalent_radius;
      EXPECT_LT(distance, before) << name;
      before = distance;
      if (degree == 20) {
        const double volume = volume_of(mesh_of_surface(map, 40, Execution(1)), Execution(1));
        EXPECT_NEAR(volume, report.volume, 0.03 * report.volume) << name;
        EXPECT_LT(before, 0.05) << name;
      }
    }
  }
}

TEST(HarmonicMap, DependsOnTheSurfaceAndNotOnItsTriangles) {
  // Half of the sphere in triangles four times smaller: vertices would count four times there.
  const IndexedMesh ball = test::sphere(3);
  IndexedMesh uneven = ball;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto is_fine = [&](const Triangle& t) {
    return ball.points[t[0]].z() + ball.points[t[1]].z() + ball.points[t[2]].z() > 0.0;
  };
  uneven.triangles.clear();
  for (const Triangle& t : ball.triangles) {
    if (!is_fine(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
      const auto next = static_cast<std::int32_t>(uneven.points.size());
      if (middles.emplace(edge, next).second) {
        uneven.points.emplace_back(0.5 * (ball.points[edge.first] + ball.points[edge.second]));
      }
    }
  }
  for (const Triangle& t : ball.triangles) {
    std::vector<std::int32_t> ring;
    std::size_t halved = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      ring.push_back(t[k]);
      const auto middle = middles.find(std::minmax(t[k], t[(k + 1) % 3]));
      if (middle == middles.end()) continue;
      ring.push_back(middle->second);
      ++halved;
    }
    if (halved == 3) {
      uneven.triangles.push_back({ring[1], ring[3], ring[5]});
      for (std::size_t k = 0; k < 3; ++k) {
        uneven.triangles.push_back({ring[2 * k], ring[2 * k + 1], ring[(2 * k + 5) % 6]});
      }
      continue;
    }
    // A fan about a middle, where there is one.
    std::size_t first = 0;
    while (halved > 0 && ring[first] < 642) ++first;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      const std::size_t size = ring.size();
      uneven.triangles.push_back(
          {ring[first % size], ring[(first + k) % size], ring[(first + k + 1) % size]});
    }
  }
  ASSERT_EQ(test::bad_edges(uneven), 0U);
  std::vector<Vector3> directions = uneven.points;
  for (Vector3& u : directions) u.normalize();
  // x, y and z of a bent body over the same directions.
  const auto bend = [](IndexedMesh mesh) {
    for (Vector3& p : mesh.points) p = Vector3(p.x() + 0.5 * p.z() * p.z(), p.y(), 2.0 * p.z());
    return mesh;
  };
  const MappedSurface plain(bend(ball), ball.points, Execution(1));
  const MappedSurface other(bend(uneven), directions, Execution(1));
  // A degree that leaves a residual for the weights to deal out.
  const HarmonicMap a = fit_harmonic_map(plain, 1, Execution(1));
  const HarmonicMap b = fit_harmonic_map(other, 1, Execution(1));
  EXPECT_GT(rms_distance(plain, a), 0.1);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(a.coefficients()[k][i], b.coefficients()[k][i], 0.01);
    }
  }
}

TEST(HarmonicMap, SameBytesOnAnyNumberOfThreads) {
  const MappedSurface surface = mapped_body(test::lumpy(4));
  const HarmonicMap one = fit_harmonic_map(surface, 10, Execution(1));
  const HarmonicMap two = fit_harmonic_map(surface, 10, Execution(2));
  EXPECT_EQ(one.coefficients(), two.coefficients());
}

TEST(HarmonicMap, RefusesWhatItCannotUse) {
  const auto refusal = [](const auto& action) {
    return test::refusal(ErrorCode::InvalidInput, action);
  };
  const std::vector<double> one{1.0};
  EXPECT_TRUE(holds(refusal([&] {
                      HarmonicMap({one, one, {1.0, 0.0, 0.0, 0.0}});
                    }),
                    "same degree"));
  EXPECT_TRUE(holds(refusal([&] { HarmonicMap({one, {std::nan("")}, one}); }), "for y"));
  EXPECT_NE(refusal([&] { HarmonicMap({}); }), "");
  const IndexedMesh ball = test::sphere(2);
  const MappedSurface surface(ball, ball.points, Execution(1));
  EXPECT_TRUE(holds(refusal([&] { fit_harmonic_map(surface, 61, Execution(1)); }), "0 to 60"));
  EXPECT_TRUE(holds(refusal([&] { fit_harmonic_map(surface, -1, Execution(1)); }), "0 to 60"));
  IndexedMesh point = ball;
  for (Vector3& p : point.points) p = Vector3::UnitX();
  const MappedSurface flat(point, ball.points, Execution(1));
  EXPECT_TRUE(holds(refusal([&] { fit_harmonic_map(flat, 3, Execution(1)); }), "no area"));
}

}  // namespace

namespace {

IndexedMesh body(const std::string& name) {
  return test::bent_grain_mesh(test::bent_grain(name), 2500);
}

TEST(ScanHarmonics, GiveTheBodyAgain) {
  RemeshOptions options;
  options.node_count = 400;
  options.measures.series = scan_harmonics;
  const RemeshResult hook = remesh(body("hook"), options, Execution(1));
  EXPECT_TRUE(hook.coefficients.radius.empty());
  ASSERT_EQ(hook.coefficients.map[0].size(), 441U);  // degree 20
  const RemeshResult again = remesh(HarmonicMap(hook.coefficients.map), options, Execution(1));
  EXPECT_EQ(again.mesh.points.size(), 400U);
  EXPECT_EQ(again.input.genus, 0);
  // The series is an approximation: rms .7 to 2.5 % at degree 20 on such bodies.
  EXPECT_NEAR(again.input.volume / hook.input.volume, 1.0, 0.05);
}

TEST(ScanHarmonics, OfAMapAreWrittenAsJsonOnly) {
  RemeshOptions options;
  options.node_count = 100;
  EXPECT_TRUE(holds(test::refusal(ErrorCode::InvalidInput,
                                  [&] {
                                    write_coefficients(::testing::TempDir() + "none.json",
                                                       remesh(body("hook"), options, Execution(1)));
                                  }),
                    "no coefficients"));
  options.measures.series = scan_harmonics;
  options.degree = 8;
  const RemeshResult hook = remesh(body("hook"), options, Execution(1));
  const std::string path = ::testing::TempDir() + "hook.json";
  write_coefficients(path, hook);
  EXPECT_EQ(std::get<HarmonicMap>(read_coefficients(path)).coefficients(), hook.coefficients.map);
  EXPECT_TRUE(
      holds(test::refusal(ErrorCode::InvalidInput,
                          [&] { write_coefficients(::testing::TempDir() + "hook.sh", hook); }),
            "Write them to a .json file"));
}

TEST(ScanHarmonics, AreOfTheRadiusWhereRaysSeeAll) {
  // Nor do rays see all of a body with small overhangs, 4 % of all directions.
  const SeriesCoefficients aggregate = scan_harmonics(body("aggregate"), 8, Execution(1));
  EXPECT_TRUE(aggregate.radius.empty());
  EXPECT_EQ(aggregate.map[2].size(), 81U);
  const SeriesCoefficients gentle = scan_harmonics(test::lumpy(4), 8, Execution(1));
  EXPECT_EQ(gentle.radius.size(), 81U);
  EXPECT_TRUE(gentle.map[0].empty());
}

}  // namespace
}  // namespace wscvt
