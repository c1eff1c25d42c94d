// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/sphere_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <string>

#include "grains/bent_grain.h"
#include "support/expect_error.h"
#include "support/holds.h"
#include "support/random_triangulations.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/sphere/solid_angle.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {
namespace {

using test::holds;

std::vector<Vector3> map_of(const IndexedMesh& mesh) { return map_to_sphere(mesh, Execution(1)); }

/// How far a map is from an isometry, up to the size of the mesh.
struct Distortion {
  double energy = 0.0;               ///< of an isometry 1
  double smallest_area_ratio = 1e9;  ///< of a triangle's area on the sphere to that on the mesh
  double largest_area_ratio = 0.0;
};

/// The mean over the area of (s1^2 + s2^2) (1 + 1 / (s1 s2)^2) / 4, s1 and s2 the stretches of a
/// triangle: the singular values of the linear map from its plane to that of its image.
Distortion distortion_of(const IndexedMesh& mesh, const std::vector<Vector3>& map) {
  const auto edges = [](const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 x = (b - a).normalized();
    const Vector3 y = (b - a).cross(c - a).cross(b - a).normalized();
    Eigen::Matrix2d columns;
    columns << (b - a).dot(x), (c - a).dot(x), 0.0, (c - a).dot(y);
    return columns;
  };
  double all = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    all += 0.5 * edges(mesh.points[a], mesh.points[b], mesh.points[c]).determinant();
  }
  Distortion result;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Matrix2d from = edges(mesh.points[a], mesh.points[b], mesh.points[c]);
    const Eigen::Matrix2d stretch =
        std::sqrt(all / (4.0 * test::pi)) * edges(map[a], map[b], map[c]) * from.inverse();
    const double ratio = stretch.determinant();
    result.energy += 0.5 * from.determinant() / all * stretch.squaredNorm() *
                     (1.0 + 1.0 / (ratio * ratio)) / 4.0;
    result.smallest_area_ratio = std::min(result.smallest_area_ratio, ratio);
    result.largest_area_ratio = std::max(result.largest_area_ratio, ratio);
  }
  return result;
}

/// One to one: all triangles counter-clockwise, and the sphere covered once.
void expect_bijective(const IndexedMesh& mesh, const std::vector<Vector3>& map,
                      const std::string& what) {
  ASSERT_EQ(map.size(), mesh.points.size()) << what;
  for (const Vector3& u : map) ASSERT_NEAR(u.norm(), 1.0, 1e-15) << what;
  double angles = 0.0;
  std::size_t turned = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = map[t[0]];
    const Vector3& b = map[t[1]];
    const Vector3& c = map[t[2]];
    if (!counter_clockwise(a, b, c)) ++turned;
    angles += solid_angle(a, b, c);
  }
  EXPECT_EQ(turned, 0U) << what;
  EXPECT_NEAR(angles, 4.0 * test::pi, 1e-9) << what;
}

std::string refusal(const IndexedMesh& mesh) {
  return test::refusal(ErrorCode::InvalidInput, [&] { map_to_sphere(mesh, Execution(1)); });
}

TEST(SphereMap, CoversTheSphereOnce) {
  const IndexedMesh bodies[] = {
      test::tetrahedron(1.0),
      test::box(1, 2, 3),
      test::icosahedron(),
      test::sphere(4),
      test::lumpy(4),
      test::scaled(test::sphere(4), Vector3(1.0, 0.05, 0.05)),
      test::scaled(test::sphere(4), Vector3(1.0, 1.0, 0.01)),
      test::subdivided(test::box(1, 1, 20), 3),
  };
  for (std::size_t i = 0; i < std::size(bodies); ++i) {
    expect_bijective(bodies[i], map_of(bodies[i]), "body " + std::to_string(i));
  }
}

TEST(SphereMap, CoversTheSphereOnceWithBentGrains) {
  for (const test::BentGrain& grain : test::bent_grains()) {
    const IndexedMesh mesh = test::bent_grain_mesh(grain, 5000);
    const std::vector<Vector3> map = map_of(mesh);
    expect_bijective(mesh, map, grain.name);
    // What the optimisation is for: the rod has the most, 4.4.
    EXPECT_LT(distortion_of(mesh, map).energy, 5.0) << grain.name;
  }
}

/// More of them where the environment asks for more.
TEST(SphereMap, CoversTheSphereOnceWhateverTheTriangulation) {
  const char* count_text = std::getenv("WSCVT_RANDOM_TRIANGULATIONS");
  const int count = count_text != nullptr ? std::atoi(count_text) : 200;
  const std::uint64_t first = test::announced(1000);
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const IndexedMesh mesh = test::random_triangulation(6 + (i * 37) % 200, seed);
    ASSERT_EQ(test::bad_edges(mesh), 0U) << "seed " << seed;
    const std::string what = "seed " + std::to_string(seed);
    try {
      expect_bijective(mesh, map_of(mesh), what);
    } catch (const Error& error) {
      ADD_FAILURE() << what << ": " << error.what();
    }
  }
}

TEST(SphereMap, CopesWithAFanOfThousands) {
  const IndexedMesh fan = test::double_fan(6000);
  expect_bijective(fan, map_of(fan), "fan");
}

TEST(SphereMap, KeepsASphereNearlyAsItIs) {
  const IndexedMesh ball = test::sphere(5);
  const Distortion map = distortion_of(ball, map_of(ball));
  EXPECT_LT(map.energy, 1.02);
  EXPECT_GT(map.smallest_area_ratio, 0.7);
  EXPECT_LT(map.largest_area_ratio, 1.4);
}

TEST(SphereMap, MapsARotatedBodyAsWell) {
  const IndexedMesh body = test::scaled(test::lumpy(4), Vector3(1.0, 0.3, 0.3));
  const double energy = distortion_of(body, map_of(body)).energy;
  for (std::uint64_t k = 0; k < 3; ++k) {
    const IndexedMesh turned =
        test::transformed(body, test::random_rotation(test::announced(20 + k)), Vector3(5, 6, 7));
    const std::vector<Vector3> map = map_of(turned);
    expect_bijective(turned, map, "rotated");
    // Rounding decides between collapses of equal cost, so the two maps differ, but not in worth.
    EXPECT_NEAR(distortion_of(turned, map).energy, energy, 0.02 * energy);
  }
}

TEST(SphereMap, DoesNotDependOnTheUnitOfLength) {
  const IndexedMesh body = test::lumpy(4);
  // Powers of two change no digit.
  const std::vector<Vector3> one = map_of(body);
  const std::vector<Vector3> other = map_of(test::scaled(body, Vector3::Constant(1024.0)));
  EXPECT_EQ(one, other);
}

TEST(SphereMap, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh body = test::lumpy(5);
  const std::vector<Vector3> one = map_to_sphere(body, Execution(1));
  const std::vector<Vector3> two = map_to_sphere(body, Execution(2));
  EXPECT_EQ(one, two);
}

TEST(SphereMap, RefusesNeedlesWithAdviceThatWorks) {
  // Two cones of a thousand needles each, 160,000 times as long as wide.
  constexpr double height = 1000.0;
  const IndexedMesh needles = test::scaled(test::bicone(1000), Vector3(1.0, 1.0, height));
  try {
    map_to_sphere(needles, Execution(1));
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::NumericalFailure);
    EXPECT_TRUE(holds(error.what(), "Remove needle-shaped faces"));
  }
  // The advice: the same body by faces that are only as long as it is itself.
  IndexedMesh even = test::sphere(5);
  for (Vector3& p : even.points) {
    p /= std::hypot(p.x(), p.y()) + std::abs(p.z());
    p.z() *= height;
  }
  const std::vector<Vector3> map = map_to_sphere(even, Execution(1));
  EXPECT_EQ(map.size(), even.points.size());
}

TEST(SphereMap, StopsWhenAskedTo) {
  const IndexedMesh body = test::sphere(5);
  std::set<std::string> stages;
  double last = 0.0;
  map_to_sphere(body, Execution(1, [&](double fraction, const std::string& stage) {
                  EXPECT_GE(fraction, last);
                  last = fraction;
                  stages.insert(stage);
                  return true;
                }));
  EXPECT_EQ(last, 1.0);
  EXPECT_GE(stages.size(), 2U);
  for (const double stop : {0.0, 0.2, 0.6}) {
    try {
      map_to_sphere(
          body, Execution(1, [&](double fraction, const std::string&) { return fraction < stop; }));
      ADD_FAILURE() << "not cancelled";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::Cancelled);
    }
  }
}

TEST(SphereMap, RefusesWhatIsNoSphere) {
  EXPECT_TRUE(holds(refusal(test::torus(1.0, 0.3, 20)), "1 handle"));
  IndexedMesh open = test::sphere(1);
  const Triangle hole = open.triangles.back();
  open.triangles.pop_back();
  const std::string sentence = refusal(open);
  std::smatch edge;
  ASSERT_TRUE(std::regex_search(sentence, edge, std::regex("not closed.*vertex (\\d+) to (\\d+)")))
      << sentence;
  EXPECT_NE(edge[1], edge[2]);
  for (std::size_t k = 1; k <= 2; ++k) {
    EXPECT_EQ(std::count(hole.begin(), hole.end(), std::stoi(edge[k])), 1) << sentence;
  }
  EXPECT_TRUE(holds(refusal(test::unwelded(test::sphere(1))), "not closed"));
  // A sphere and a torus have together the Euler number of one sphere.
  EXPECT_TRUE(holds(refusal(test::joined(test::sphere(1), test::torus(1.0, 0.3, 20))), "parts"));
  IndexedMesh lonely = test::sphere(1);
  lonely.points.emplace_back(3, 3, 3);
  EXPECT_TRUE(holds(refusal(lonely), "corner of no face"));
  IndexedMesh infinite = test::sphere(1);
  infinite.points[7].x() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(holds(refusal(infinite), "Vertex 7"));
  IndexedMesh outside = test::sphere(1);
  outside.triangles[3][1] = 1000;
  EXPECT_TRUE(holds(refusal(outside), "Face 3"));
  EXPECT_FALSE(refusal(IndexedMesh{}).empty());
  // Two tetrahedra that share a vertex.
  IndexedMesh touching = test::joined(test::tetrahedron(1), test::tetrahedron(1));
  for (Triangle& t : touching.triangles) {
    for (std::int32_t& v : t) v = v == 4 ? 0 : v > 4 ? v - 1 : v;
  }
  touching.points.pop_back();
  EXPECT_TRUE(holds(refusal(touching), "touches itself"));
}

}  // namespace
}  // namespace wscvt
