// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fragment/fragments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/fragment/cell_complex.h"
#include "toolbox/sample/given_sizes.h"
#include "wscvt/base/convex_hull.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

std::string file(const std::string& name) { return std::string(WSCVT_MESHES_DIR) + "/" + name; }

Fragments divided(const IndexedMesh& grain, int count, std::uint64_t seed = 1, int threads = 1) {
  FragmentOptions options;
  options.count = count;
  options.seed = seed;
  return fragment_grain(grain, options, Execution(threads));
}

using Corner = std::array<double, 3>;

Corner corner(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

/// A triangle by the bits of its corners, from the least on, and whether they ascend.
std::pair<std::array<Corner, 3>, bool> by_corners(const IndexedMesh& mesh, const Triangle& t) {
  std::array<Corner, 3> c = {corner(mesh.points[t[0]]), corner(mesh.points[t[1]]),
                             corner(mesh.points[t[2]])};
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  const bool ascends = c[1] < c[2];
  if (!ascends) std::swap(c[1], c[2]);
  return {c, ascends};
}

/// What a plain comparison of all triangles finds.
struct Wall {
  double area = 0.0;
  Vector3 moment = Vector3::Zero();   ///< centroid times area
  Vector3 outward = Vector3::Zero();  ///< area vector, out of the first fragment
};
struct Walls {
  std::map<std::array<std::size_t, 2>, Wall> of;
  std::vector<double> surface;
};

/// Fails unless each triangle is of one fragment, or of two with opposite turn.
Walls walls_of(const Fragments& fragments) {
  std::map<std::array<Corner, 3>, std::vector<std::tuple<std::size_t, bool, Wall>>> uses;
  for (std::size_t k = 0; k < fragments.list.size(); ++k) {
    const IndexedMesh& mesh = fragments.list[k].mesh;
    for (const Triangle& t : mesh.triangles) {
      const auto [corners, ascends] = by_corners(mesh, t);
      const Vector3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      const double area = triangle_area(a, b, c);
      uses[corners].emplace_back(
          k, ascends, Wall{area, area / 3.0 * (a + b + c), 0.5 * doubled_area_normal(a, b, c)});
    }
  }
  Walls walls;
  walls.surface.resize(fragments.list.size());
  for (const auto& [corners, use] : uses) {
    if (use.size() == 1) {
      walls.surface[std::get<0>(use[0])] += std::get<2>(use[0]).area;
      continue;
    }
    EXPECT_EQ(use.size(), 2U);
    if (use.size() != 2) continue;
    EXPECT_NE(std::get<0>(use[0]), std::get<0>(use[1]));
    EXPECT_NE(std::get<1>(use[0]), std::get<1>(use[1])) << "the neighbours turn it oppositely";
    Wall& wall = walls.of[{std::get<0>(use[0]), std::get<0>(use[1])}];
    wall.area += std::get<2>(use[0]).area;
    wall.moment += std::get<2>(use[0]).moment;
    wall.outward += std::get<2>(use[0]).outward;
  }
  return walls;
}

/// Checks all that holds for any division. The sums' tolerance is the rounding of thousands of
/// terms.
void expect_division(const IndexedMesh& grain, const Fragments& result, int count) {
  constexpr double rounding = 1e-11;
  ASSERT_EQ(result.list.size(), static_cast<std::size_t>(count));
  double volume = 0.0;
  double surface = 0.0;
  for (const Fragment& fragment : result.list) {
    EXPECT_EQ(test::bad_edges(fragment.mesh), 0U);
    EXPECT_GT(fragment.mass.volume, 0.0);
    EXPECT_GE(fragment.hull_excess_percent, -1e-7);
    EXPECT_NEAR(fragment.mass.volume, volume_of(fragment.mesh, Execution(1)),
                rounding * result.grain.volume);
    volume += fragment.mass.volume;
    surface += fragment.surface_area;
  }
  const double whole = volume_of(grain, Execution(1));
  EXPECT_NEAR(volume / whole, 1.0, rounding);
  EXPECT_NEAR(surface / result.grain.area, 1.0, rounding);
  const Walls plain = walls_of(result);
  std::vector<double> wall(result.list.size(), 0.0);
  EXPECT_EQ(plain.of.size(), result.contacts.size());
  for (const CommonWall& contact : result.contacts) {
    EXPECT_LT(contact.first, contact.second);
    const Wall& by_hand = plain.of.at({index(contact.first), index(contact.second)});
    EXPECT_NEAR(by_hand.area, contact.area, rounding * result.grain.area);
    EXPECT_LT((by_hand.moment / by_hand.area - contact.centre).norm(),
              1e-9 * (1.0 + contact.centre.norm()));
    EXPECT_LT((by_hand.outward.normalized() - contact.normal).norm(), 1e-6);
    wall[contact.first] += contact.area;
    wall[contact.second] += contact.area;
  }
  for (std::size_t k = 0; k < result.list.size(); ++k) {
    EXPECT_NEAR(result.list[k].wall_area, wall[k], rounding * result.grain.area);
    EXPECT_NEAR(result.list[k].surface_area, plain.surface[k], rounding * result.grain.area);
  }
}

TEST(Fragments, OfALumpyBodyFillIt) {
  const IndexedMesh grain =
      test::transformed(test::lumpy(4), test::random_rotation(3), Vector3(40.0, -7.0, 3.0));
  for (const int count : {1, 2, 7, 60}) {
    SCOPED_TRACE(count);
    const Fragments result = divided(grain, count);
    expect_division(grain, result, count);
    EXPECT_EQ(result.moved_pieces, 0U);
    EXPECT_EQ(result.contacts.empty(), count == 1);
  }
}

TEST(Fragments, OfRealGrainsFillThem) {
  for (const char* name : {"sand_5658.ply", "angular_6000.ply", "elongated_rough_8000.ply"}) {
    SCOPED_TRACE(name);
    const IndexedMesh grain = read_mesh(file(name));
    expect_division(grain, divided(grain, 20), 20);
  }
  const IndexedMesh grain = read_mesh(file("sand_7228.ply"));
  expect_division(grain, divided(grain, 200), 200);
}

TEST(Fragments, OfARingFillItWithHolesInWalls) {
  const IndexedMesh ring = test::transformed(test::torus(1.0, 0.45, 40), test::random_rotation(1),
                                             Vector3(1.0, 2.0, 3.0));
  for (const int count : {2, 3, 10, 100}) {
    SCOPED_TRACE(count);
    expect_division(ring, divided(ring, count, 5), count);
  }
}

TEST(Fragments, KeepTheGrainsPoints) {
  const IndexedMesh grain = test::moved(test::lumpy(3), 1.0, Vector3(0.1, 0.2, 0.3));
  const Fragments result = divided(grain, 8);
  std::map<Corner, int> there;
  for (const Fragment& fragment : result.list) {
    for (const Vector3& p : fragment.mesh.points) ++there[corner(p)];
  }
  for (const Vector3& p : grain.points) EXPECT_EQ(there.count(corner(p)), 1U);
}

TEST(Fragments, TurnWithTheGrain) {
  const Eigen::Matrix3d turn = test::random_rotation(11);
  const Vector3 shift(5.0, -2.0, 9.0);
  // Not symmetric along any principal axis, so the frame's signs follow the body.
  const IndexedMesh grain = read_mesh(file("sand_5658.ply"));
  const Fragments plain = divided(grain, 12);
  const Fragments turned = divided(test::transformed(grain, turn, shift), 12);
  ASSERT_EQ(plain.contacts.size(), turned.contacts.size());
  // Lloyd's steps carry the rounding of the frame's axes.
  for (std::size_t k = 0; k < plain.list.size(); ++k) {
    EXPECT_NEAR(plain.list[k].mass.volume, turned.list[k].mass.volume, 1e-9);
    const Vector3 centre = turn * plain.list[k].mass.centroid + shift;
    EXPECT_LT((centre - turned.list[k].mass.centroid).norm(), 1e-9);
  }
  for (std::size_t k = 0; k < plain.contacts.size(); ++k) {
    EXPECT_NEAR(plain.contacts[k].area, turned.contacts[k].area, 1e-9);
    EXPECT_LT((turn * plain.contacts[k].normal - turned.contacts[k].normal).norm(), 1e-8);
  }
}

TEST(Fragments, DoNotDependOnThreadsButOnTheSeed) {
  const IndexedMesh grain = read_mesh(file("sand_5658.ply"));
  const Fragments one = divided(grain, 30, 1, 1);
  const Fragments three = divided(grain, 30, 1, 3);
  const Fragments other = divided(grain, 30, 2, 1);
  for (std::size_t k = 0; k < one.list.size(); ++k) {
    EXPECT_EQ(one.list[k].mesh.points, three.list[k].mesh.points);
    EXPECT_EQ(one.list[k].mesh.triangles, three.list[k].mesh.triangles);
    EXPECT_NE(one.list[k].mesh.points, other.list[k].mesh.points);
  }
}

double variation_of_volumes(const Fragments& fragments) {
  const auto count = static_cast<double>(fragments.list.size());
  const double mean = fragments.grain.volume / count;
  double squares = 0.0;
  for (const Fragment& f : fragments.list) squares += std::pow(f.mass.volume - mean, 2.0);
  return std::sqrt(squares / count) / mean;
}

TEST(Fragments, AreAboutEqual) {
  // Random seeds without Lloyd's steps have about .42 (Poisson-Voronoi cells).
  EXPECT_LT(variation_of_volumes(divided(read_mesh(file("sand_5658.ply")), 50)), 0.2);
}

TEST(Fragments, HaveTheGivenVolumes) {
  const IndexedMesh grain = read_mesh(file("sand_5658.ply"));
  FragmentOptions options;
  options.count = 25;
  // Diameters 1 to 4: volumes 1 to 64.
  options.volumes = fragment_volumes(GivenSizes({1.0, 4.0}, {0.0, 100.0}), options.count);
  const double sum = std::accumulate(options.volumes.begin(), options.volumes.end(), 0.0);
  const Fragments result = fragment_grain(grain, options, Execution(1));
  expect_division(grain, result, options.count);
  ASSERT_EQ(result.moved_pieces, 0U);
  for (std::size_t k = 0; k < result.list.size(); ++k) {
    const double wanted = result.grain.volume * options.volumes[k] / sum;
    EXPECT_NEAR(result.list[k].mass.volume / wanted, 1.0, 1e-3) << k;
  }
}

// In a file in micrometres as in one in metres.
TEST(Fragments, OfGivenVolumesGrowWithTheGrain) {
  const IndexedMesh grain = test::lumpy(3);
  FragmentOptions options;
  options.count = 6;
  options.volumes = {1.0, 2.0, 3.0, 5.0, 8.0, 13.0};
  const Fragments plain = fragment_grain(grain, options, Execution(1));
  constexpr double scale = 1024.0;
  const Fragments large =
      fragment_grain(test::moved(grain, scale, Vector3::Zero()), options, Execution(1));
  for (std::size_t k = 0; k < 6; ++k) {
    const MassProperties& mass = large.list[k].mass;
    EXPECT_NEAR(mass.volume / plain.list[k].mass.volume / (scale * scale * scale), 1.0, 1e-9) << k;
    EXPECT_LT((mass.centroid / scale - plain.list[k].mass.centroid).norm(), 1e-9) << k;
  }
}

TEST(Fragments, MeasuredAgainAreTheSame) {
  Fragments again = divided(test::lumpy(2), 5);
  const Fragments once = again;
  measure_fragments(again, Execution(1));
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(again.list[k].surface_area, once.list[k].surface_area);
    EXPECT_EQ(again.list[k].wall_area, once.list[k].wall_area);
  }
}

TEST(Fragments, AreSmallerNearChosenPoints) {
  const IndexedMesh grain = test::sphere(4);
  FragmentOptions options;
  options.count = 40;
  options.near = {Vector3(0.0, 0.0, 1.0)};
  const Fragments result = fragment_grain(grain, options, Execution(1));
  expect_division(grain, result, options.count);
  // Sizes grow with the distance plus .2: from (.2) to (2.2), so volumes by far more than ten.
  double near_volume = 0.0;
  double far_volume = 0.0;
  double nearest = 9.0;
  double farthest = 0.0;
  for (const Fragment& f : result.list) {
    const double distance = (f.mass.centroid - options.near[0]).norm();
    if (distance < nearest) std::tie(nearest, near_volume) = std::tie(distance, f.mass.volume);
    if (distance > farthest) std::tie(farthest, far_volume) = std::tie(distance, f.mass.volume);
  }
  EXPECT_GT(far_volume, 10.0 * near_volume);
  // Each of several points counts.
  options.near = {Vector3(0.0, 0.0, 1.0), Vector3(0.0, 0.0, -1.0)};
  double largest = 0.0;
  std::array<double, 2> at_points{};
  std::array<double, 2> least = {9.0, 9.0};
  for (const Fragment& f : fragment_grain(grain, options, Execution(1)).list) {
    largest = std::max(largest, f.mass.volume);
    for (std::size_t k = 0; k < 2; ++k) {
      const double distance = (f.mass.centroid - options.near[k]).norm();
      if (distance < least[k]) std::tie(least[k], at_points[k]) = std::tie(distance, f.mass.volume);
    }
  }
  for (const double volume : at_points) EXPECT_GT(largest, 5.0 * volume);
}

TEST(Fragments, OfABoxHaveTheContactOfItsMiddle) {
  // Long in x, so two cells part it across; the centre of gravity of all walls is the middle.
  const IndexedMesh bar =
      test::transformed(test::box(6.0, 1.0, 1.5), test::random_rotation(4), Vector3(3, 2, 1));
  const Fragments result = divided(bar, 2);
  expect_division(bar, result, 2);
  ASSERT_EQ(result.contacts.size(), 1U);
  const CommonWall& contact = result.contacts[0];
  const Vector3 along = test::random_rotation(4).col(0);
  // Lloyd's points lie on lines .07 apart.
  EXPECT_NEAR(contact.area, 1.5, 0.02);
  EXPECT_LT((contact.centre - Vector3(3, 2, 1)).norm(), 0.15);
  EXPECT_GT(std::abs(contact.normal.dot(along)), 0.98);
  const Vector3 apart = result.list[1].mass.centroid - result.list[0].mass.centroid;
  EXPECT_GT(contact.normal.dot(apart), 0.0) << "from the first to the second";
  EXPECT_LT(result.list[0].hull_excess_percent, 1e-6) << "a half of a box is convex";
}

TEST(Fragments, OfARingHaveTheExcessOfItsHull) {
  const IndexedMesh ring = test::torus(1.0, 0.25, 30);
  const double hull = volume_of(convex_hull(ring.points, Execution(1)), Execution(1));
  EXPECT_NEAR(divided(ring, 1).list[0].hull_excess_percent,
              100.0 * (hull / volume_of(ring, Execution(1)) - 1.0), 1e-6);
}

// The middle cell of a long ring has two legs, and the smaller one moves to a neighbour.
TEST(Fragments, OfARingWhoseLegsMovedFillIt) {
  const IndexedMesh ring = test::scaled(test::torus(1.0, 0.25, 40), {1.2, 6.0, 1.2});
  const Fragments result = divided(ring, 3);
  expect_division(ring, result, 3);
  EXPECT_EQ(result.moved_pieces, 1U);
  // About half of the middle third.
  EXPECT_NEAR(result.moved_percent, 100.0 / 6.0, 5.0);
}

TEST(Fragments, TellPointsFarAwayAndRepairs) {
  const IndexedMesh grain = test::moved(test::sphere(3), 2.0, Vector3(50.0, 0.0, 0.0));
  FragmentOptions options;
  options.count = 3;
  options.near = {Vector3(56.0, 0.0, 0.0)};  // 2 radii from the surface, and then 4
  EXPECT_TRUE(fragment_grain(grain, options).warnings.empty());
  options.near.emplace_back(60.0, 0.0, 0.0);
  const std::vector<Sentence> told = fragment_grain(grain, options).warnings;
  ASSERT_EQ(told.size(), 1U);
  // The ball's volume is a few per cent below that of its sphere.
  EXPECT_TRUE(test::holds(told[0].text(), " is 4.0"));
  const IndexedMesh needle = test::box(1.0, 1.0, 20.0);  // ends 6 radii from the centroid
  options.near = {needle.points.front()};
  EXPECT_TRUE(fragment_grain(needle, options).warnings.empty());
  options.near.clear();
  const IndexedMesh two = test::joined(grain, test::sphere(1));
  EXPECT_EQ(fragment_grain(two, options).warnings.size(), 1U) << "the smaller body is left out";
}

TEST(FragmentVolumes, FollowTheCurveByMass) {
  constexpr int count = 2000;
  const std::vector<double> volumes =
      fragment_volumes(GivenSizes({1.0, 2.0, 4.0}, {0.0, 30.0, 100.0}), count);
  double all = 0.0;
  double finer = 0.0;  // than the diameter 2
  for (const double volume : volumes) {
    all += volume;
    finer += volume < 8.0 ? volume : 0.0;
  }
  EXPECT_NEAR(finer / all, 0.3, 0.002);
  // Each fragment has the middle of its part, not an end.
  EXPECT_GT(volumes.front(), 1.0);
  EXPECT_LT(volumes.back(), 64.0);
}

TEST(Fragments, AreRefusedWithAReason) {
  const IndexedMesh grain = test::lumpy(2);
  FragmentOptions options;
  options.count = 0;
  EXPECT_ERROR(fragment_grain(grain, options), InvalidInput);
  options.count = 1001;
  EXPECT_ERROR(fragment_grain(grain, options), InvalidInput);
  options.count = 3;
  options.volumes = {1.0, 2.0};
  EXPECT_ERROR(fragment_grain(grain, options), InvalidInput);
  options.volumes = {1.0, 2.0, 0.0};
  EXPECT_ERROR(fragment_grain(grain, options), InvalidInput);
  options.volumes = {1.0, 2.0, 3.0};
  options.near = {Vector3::Zero()};
  EXPECT_ERROR(fragment_grain(grain, options), InvalidInput);
  options.volumes.clear();
  options.near = {Vector3(NAN, 0.0, 0.0)};
  EXPECT_ERROR(fragment_grain(grain, options), InvalidInput);
  options.near.clear();
  IndexedMesh open = grain;
  open.triangles.resize(open.triangles.size() / 2);
  EXPECT_ERROR(fragment_grain(open, options), InvalidInput);
}

}  // namespace
}  // namespace wscvt
