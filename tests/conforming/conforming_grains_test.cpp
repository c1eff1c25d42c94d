// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/conforming/conforming_grains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/msh_volumes.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "toolbox/conforming/conforming_files.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

using test::holds;

/// Fills the inner voxels by a function of their middles; -1 is background.
template <class Grain>
GrainVoxels voxels_of(int side, const Grain& grain_at) {
  GrainVoxels voxels({side + 2, side + 2, side + 2});
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        voxels.grain[voxels.place(x + 1, y + 1, z + 1)] =
            grain_at(Vector3(x + 0.5, y + 0.5, z + 0.5));
      }
    }
  }
  return voxels;
}

bool is_in_box(const Vector3& p, const Vector3& middle, double half) {
  return (p - middle).cwiseAbs().maxCoeff() < half;
}

GrainVoxels two_balls() {
  return voxels_of(50, [](const Vector3& p) {
    const double a = (p - Vector3(15.0, 25.0, 25.0)).norm() - 12.0;
    const double b = (p - Vector3(36.0, 25.3, 24.6)).norm() - 12.0;
    return std::min(a, b) > 0.0 ? -1 : a < b ? 0 : 1;
  });
}

/// What lies between the cells of random points.
enum class Between { Nothing, NoisyGaps, WedgesOfPores };

/// Cells of random points in a ball, or in the whole volume.
GrainVoxels random_cells(unsigned seed, int side, std::size_t count, bool in_ball,
                         Between between = Between::Nothing) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  std::uniform_real_distribution<double> place(0.15 * side, 0.85 * side);
  std::vector<Vector3> middles;
  while (middles.size() < count) {
    const double x = place(random);
    const double y = place(random);
    middles.emplace_back(x, y, place(random));
  }
  return voxels_of(side, [&](const Vector3& p) {
    if (in_ball && (p - Vector3::Constant(0.5 * side)).norm() > 0.45 * side) return -1;
    const auto nearer = [&](const Vector3& a, const Vector3& b) {
      return (a - p).norm() < (b - p).norm();
    };
    std::vector<Vector3> two(2);
    std::partial_sort_copy(middles.begin(), middles.end(), two.begin(), two.end(), nearer);
    const double gap = (two[1] - p).norm() - (two[0] - p).norm();
    if (between == Between::NoisyGaps && gap < 0.5 + 0.8 * noise(random)) return -1;
    // Gaps that open from nothing to six voxels, in waves along the walls.
    if (between == Between::WedgesOfPores &&
        gap < 6.0 * std::sin(0.4 * p.x()) * std::sin(0.3 * p.y()) + 3.0 * std::sin(0.5 * p.z())) {
      return -1;
    }
    return static_cast<int>(std::min_element(middles.begin(), middles.end(), nearer) -
                            middles.begin());
  });
}

ConformingGrains conformed(GrainVoxels voxels, std::size_t grains, double edge = 3.0,
                           int threads = 1) {
  ConformingOptions options;
  options.edge_length = edge;
  return conform_grains(std::move(voxels), grains, VolumeGeometry(), options, Execution(threads));
}

/// Expects a closed mesh whose triangles about each node are one ring, and outward.
void expect_closed_manifold(const IndexedMesh& mesh) {
  std::set<std::pair<int, int>> half_edges;
  std::vector<std::map<int, int>> rings(mesh.points.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(half_edges.emplace(t[k], t[(k + 1) % 3]).second) << "an edge twice";
      rings[static_cast<std::size_t>(t[k])][t[(k + 1) % 3]] = t[(k + 2) % 3];
    }
  }
  for (const auto& [from, to] : half_edges) {
    ASSERT_EQ(half_edges.count({to, from}), 1U) << "an open edge";
  }
  for (const std::map<int, int>& ring : rings) {
    ASSERT_GE(ring.size(), 3U);
    std::size_t steps = 0;
    int at = ring.begin()->first;
    do {
      at = ring.at(at);
      ++steps;
    } while (at != ring.begin()->first && steps <= ring.size());
    ASSERT_EQ(steps, ring.size()) << "several rings about a node";
  }
  EXPECT_GT(volume_of(mesh, Execution(1)), 0.0);
}

/// Triangles as sorted points, to find the same ones in two meshes.
using Corners = std::array<std::array<double, 3>, 3>;
std::set<Corners> corners_of(const IndexedMesh& mesh) {
  std::set<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& p = mesh.points[static_cast<std::size_t>(t[k])];
      corners[k] = {p.x(), p.y(), p.z()};
    }
    std::sort(corners.begin(), corners.end());
    all.insert(corners);
  }
  return all;
}

/// Expects what holds for all bodies of these volumes.
void expect_conforming(const ConformingGrains& result, const std::vector<double>& volumes) {
  std::vector<std::set<Corners>> corners;
  const std::vector<IndexedMesh> meshes = body_meshes(result, result.grains.size());
  for (std::size_t g = 0; g < result.grains.size(); ++g) {
    SCOPED_TRACE("grain " + std::to_string(g));
    const IndexedMesh& mesh = meshes[g];
    expect_closed_manifold(mesh);
    EXPECT_EQ(mesh.points.size(), result.grains[g].nodes);
    EXPECT_EQ(mesh.triangles.size(), result.grains[g].triangles);
    // Newton steps end at 1e-13; the rest is the rounding of the sums.
    EXPECT_NEAR(volume_of(mesh, Execution(1)) / volumes[g], 1.0, 1e-11);
    corners.push_back(corners_of(mesh));
  }
  // A grain's wall is in its neighbour, to the bit.
  for (const CommonWall& wall : result.walls) {
    std::size_t common = 0;
    for (const Corners& one : corners[static_cast<std::size_t>(wall.first)]) {
      common += corners[static_cast<std::size_t>(wall.second)].count(one);
    }
    EXPECT_EQ(common, wall.triangles);
  }
}

void expect_conforming(const ConformingGrains& result) {
  std::vector<double> volumes;
  for (const ConformingGrain& grain : result.grains) volumes.push_back(grain.voxel_volume);
  expect_conforming(result, volumes);
}

TEST(ConformingGrains, TwoBallsShareADisc) {
  const ConformingGrains result = conformed(two_balls(), 2);
  expect_conforming(result);
  EXPECT_EQ(result.intersections, 0U);
  ASSERT_EQ(result.walls.size(), 1U);
  const CommonWall& wall = result.walls.front();
  // The disc has a radius of 5.8; its rim is in the steps of the voxels.
  EXPECT_NEAR(wall.area, 3.14 * 5.8 * 5.8, 0.25 * wall.area);
  // The steps at the rim turn the mean by up to 7 degrees, as they turn the faces of voxels.
  EXPECT_GT(wall.normal.dot(Vector3(21.0, 0.3, -0.4).normalized()), std::cos(0.12));
  EXPECT_NEAR(result.mean_edge, 3.0, 0.15);
  EXPECT_LT(result.edge_variation, 0.15);  // random triangulations: .3
}

/// Boxes of 30 voxels: grain 0 on the left, 1 and 2 on the right behind each other.
GrainVoxels three_boxes() {
  return voxels_of(50, [](const Vector3& p) {
    if (!is_in_box(p, Vector3::Constant(25.0), 15.0)) return -1;
    return p.x() < 25.0 ? 0 : p.y() < 25.0 ? 1 : 2;
  });
}

TEST(ConformingGrains, ThreeBoxesMeetInAStraightLine) {
  const ConformingGrains result = conformed(three_boxes(), 3);
  expect_conforming(result);
  EXPECT_EQ(result.intersections, 0U);
  ASSERT_EQ(result.walls.size(), 3U);
  std::map<std::int32_t, std::set<std::int32_t>> grains_at;
  for (const WallTriangle& t : result.triangles) {
    for (const std::int32_t corner : t.corners) {
      grains_at[corner].insert(t.inner);
      grains_at[corner].insert(t.outer);
    }
  }
  int on_line = 0;
  for (const auto& [node, grains] : grains_at) {
    if (grains != std::set<std::int32_t>{0, 1, 2}) continue;
    ++on_line;
    const Vector3& p = result.points[static_cast<std::size_t>(node)];
    // The layer of background moves the lattice by a voxel. The volumes move the line a little.
    EXPECT_NEAR(p.x(), 26.0, 0.2);
    EXPECT_NEAR(p.y(), 26.0, 0.2);
  }
  EXPECT_GE(on_line, 7);  // 30 voxels with edges of 3
}

TEST(ConformingGrains, RandomCellsWithAndWithoutBackground) {
  for (const bool in_ball : {false, true}) {
    const unsigned seed = 17;
    SCOPED_TRACE("seed " + std::to_string(seed) + (in_ball ? " in a ball" : " in a cube"));
    const ConformingGrains result = conformed(random_cells(seed, 48, 12, in_ball), 12);
    expect_conforming(result);
    EXPECT_NEAR(result.mean_edge, 3.0, 0.2);
    EXPECT_LT(result.edge_variation, 0.25);
    EXPECT_EQ(result.intersections, 0U);
  }
}

TEST(ConformingGrains, GapsOfAVoxelClose) {
  const ConformingGrains result =
      conformed(voxels_of(40,
                          [](const Vector3& p) {
                            if (!is_in_box(p, Vector3::Constant(20.0), 12.0) ||
                                std::abs(p.x() - 20.5) < 0.1) {
                              return -1;
                            }
                            return p.x() < 20.0 ? 0 : 1;
                          }),
                2);
  expect_conforming(result);
  ASSERT_EQ(result.walls.size(), 1U);
  // A rim beside the wide background stays: its voxels are no gap between grains.
  EXPECT_EQ(result.gained_voxels, 22 * 22);
  EXPECT_EQ(result.grains[0].gained, 22 * 22) << "all to one, so that the wall is flat";
  EXPECT_EQ(result.grains[0].voxels, 12 * 24 * 24 + 22 * 22);
  EXPECT_EQ(result.grains[1].gained, 0);
}

TEST(ConformingGrains, NoTrianglesIntersectInThinGaps) {
  for (const Between between : {Between::NoisyGaps, Between::WedgesOfPores}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      SCOPED_TRACE("seed " + std::to_string(seed) +
                   (between == Between::NoisyGaps ? ", noisy gaps" : ", wedges"));
      const ConformingGrains result = conformed(random_cells(seed, 48, 12, false, between), 12);
      expect_conforming(result);
      if (between == Between::NoisyGaps) {
        EXPECT_GT(result.gained_voxels, 0);
      }
      EXPECT_EQ(result.intersections, 0U);
      for (const Sentence& warning : conforming_warnings(result, std::vector<Label>(12, 1))) {
        EXPECT_FALSE(holds(warning.text(), "intersect"));
      }
    }
  }
}

// Rough walls, through which single voxels of others touch: a body all around such a contact must
// not close over it.
TEST(ConformingGrains, ContactsThatAreAllWithinAnotherGrainPinchNothing) {
  for (unsigned seed = 11; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> any(0, 99);
    GrainVoxels voxels = random_cells(seed, 28, 5, false);
    for (std::int32_t& grain : voxels.grain) {
      if (grain >= 0 && any(random) < 4) grain = any(random) % 5;
    }
    const ConformingGrains result = conformed(std::move(voxels), 5, 3.0 + seed % 3);
    for (const IndexedMesh& mesh : body_meshes(result, 5)) expect_closed_manifold(mesh);
  }
}

// Two pyramids whose tips of one voxel touch.
GrainVoxels two_pyramids() {
  return voxels_of(33, [](const Vector3& p) {
    const Vector3 q = p - Vector3::Constant(16.5);
    const double height = std::abs(q.z() - 0.5);
    const double side = std::max(std::abs(q.x()), std::abs(q.y()));
    if (height > 12.0 || side > height) return -1;
    return q.z() < 0.5 ? 0 : 1;
  });
}

TEST(ConformingGrains, AWallOfOneFaceKeepsAnAreaThatTetrahedraCanHave) {
  for (const double edge : {3.0, 6.0}) {
    SCOPED_TRACE(edge);
    const ConformingGrains result = conformed(two_pyramids(), 2, edge);
    expect_conforming(result);
    EXPECT_EQ(result.intersections, 0U);
    ASSERT_EQ(result.walls.size(), 1U);
    EXPECT_EQ(result.walls[0].triangles, 1U);
    // An even triangle with edges of .4 of the wanted ones; the restored volumes move it a little.
    const double even = 0.25 * std::sqrt(3.0) * 0.16 * edge * edge;
    EXPECT_NEAR(result.walls[0].area / even, 1.0, 0.1);
  }
}

TEST(ConformingGrains, WallsOfAFewFacesLeaveNoSlivers) {
  // Fourteen cells have such walls in most cases. With them the smallest angles are .4 to 4
  // degrees.
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const ConformingGrains result = conformed(random_cells(seed, 36, 14, false), 14, 4.0);
    EXPECT_EQ(result.intersections, 0U);
    // 11.9 is the smallest of twelve packings like these.
    EXPECT_GT(result.smallest_angle, 8.0);
  }
}

/// Balls on a lattice that is shaken: some touch at a face or two of voxels, where the free
/// surfaces are so near to each other that they have to be parted. `noise`: of the distance to a
/// surface.
GrainVoxels shaken_balls(unsigned seed, double noise) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<std::pair<Vector3, double>> balls;
  for (int k = 0; k < 27; ++k) {
    Vector3 middle(8.0 + 16.0 * (k % 3), 8.0 + 16.0 * (k / 3 % 3), 8.0 + 16.0 * (k / 9));
    for (double& x : middle) x += any(random);
    balls.emplace_back(middle, 8.0 + any(random));
  }
  return voxels_of(50, [&](const Vector3& p) {
    int best = -1;
    double least = noise > 0.0 ? noise * any(random) : 0.0;
    for (int k = 0; k < 27; ++k) {
      const auto& [middle, radius] = balls[static_cast<std::size_t>(k)];
      const double value = (p - Vector3::Constant(1.0) - middle).norm() - radius;
      if (value >= least) continue;
      least = value;
      best = k;
    }
    return best;
  });
}

TEST(ConformingGrains, PartedTrianglesLeaveSmallWallsEven) {
  for (const unsigned seed : {5U, 9U, 11U, 12U}) {
    SCOPED_TRACE(seed);
    const ConformingGrains result = conformed(shaken_balls(seed, 0.0), 27, 4.0);
    EXPECT_EQ(result.intersections, 0U);
    EXPECT_LT(result.volume_error, 1e-9);
    // Twelve packings like these have 12.7 degrees and more. With shrunken walls 6 to 9.
    EXPECT_GT(result.smallest_angle, 10.0);
  }
}

TEST(ConformingGrains, WidenedWallsLeaveNoNeedlesBesideThem) {
  for (const unsigned seed : {3U, 8U, 10U}) {
    SCOPED_TRACE(seed);
    // Thirty packings like these have 12.9 degrees and more. With nodes that stay beside widened
    // walls these have 6.8 to 9.2.
    EXPECT_GT(conformed(shaken_balls(seed, 0.0), 27, 5.0).smallest_angle, 12.0);
  }
}

TEST(ConformingGrains, PartedTrianglesShrinkNoWallToAPoint) {
  for (const unsigned seed : {8U, 11U, 15U}) {
    SCOPED_TRACE(seed);
    // Noise makes gaps so narrow that nodes of single faces have to move. Without the nodes about
    // the wall in the mean these have .01 to .3 degrees.
    EXPECT_GT(conformed(shaken_balls(seed, 0.7), 27, 6.0).smallest_angle, 5.0);
  }
}

TEST(ConformingGrains, PitsOfAVoxelLeaveNoNeedles) {
  std::mt19937 random(static_cast<unsigned>(test::announced(3)));
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::vector<Vector3> pits;
  for (int k = 0; k < 40; ++k) {
    const double x = place(random);
    const double y = place(random);
    pits.push_back(Vector3(x, y, place(random)).normalized());
  }
  // Each pit is a voxel wide and four deep.
  const ConformingGrains result = conformed(voxels_of(34,
                                                      [&](const Vector3& p) {
                                                        const Vector3 q = p - Vector3::Constant(17);
                                                        if (q.norm() > 14.0) return -1;
                                                        for (const Vector3& pit : pits) {
                                                          const double depth = q.dot(pit);
                                                          const Vector3 aside = q - depth * pit;
                                                          if (depth > 10.0 && aside.norm() < 0.75)
                                                            return -1;
                                                        }
                                                        return 0;
                                                      }),
                                            1);
  expect_conforming(result);
  EXPECT_EQ(result.intersections, 0U);
  // Twelve other sets of such pits have 18.8 degrees and more.
  EXPECT_GT(result.smallest_angle, 15.0);
}

TEST(ConformingGrains, TellsSliversAndWallsAcrossGaps) {
  // Two balls with a gap of half a voxel.
  const ConformingGrains result = conformed(voxels_of(50,
                                                      [](const Vector3& p) {
                                                        const Vector3 half(11.75, 0.0, 0.0);
                                                        const Vector3 q =
                                                            p - Vector3(25.5, 25.3, 24.6);
                                                        if ((q + half).norm() < 11.0) return 0;
                                                        return (q - half).norm() < 11.0 ? 1 : -1;
                                                      }),
                                            2);
  EXPECT_EQ(result.walls_across, result.walls.size());
  EXPECT_EQ(result.lost_walls, 0U);
  ConformingGrains flat = result;
  flat.smallest_angle = 0.4;
  flat.shortest_edge = 0.001;
  flat.flattest = 1;
  const std::vector<Sentence> warnings = conforming_warnings(flat, {3, 7});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(holds(warnings[0].text(), "0.4 degrees, at grain 7"));
  EXPECT_TRUE(holds(conforming_lines(flat)[1], "shortest 0.001"));
}

TEST(ConformingGrains, GrainsThatTouchInAnEdgeOrACornerAreApart) {
  for (const double shift : {0.0, 12.0}) {
    const ConformingGrains result =
        conformed(voxels_of(40,
                            [&](const Vector3& p) {
                              if (is_in_box(p, {14.0, 14.0, 14.0}, 6.0)) return 0;
                              return is_in_box(p, {26.0, 26.0, 14.0 + shift}, 6.0) ? 1 : -1;
                            }),
                  2);
    expect_conforming(result);
    EXPECT_TRUE(result.walls.empty());
    EXPECT_EQ(result.intersections, 0U);
  }
}

TEST(ConformingGrains, ALabelThatTouchesItselfInAnEdgeIsRepaired) {
  const ConformingGrains result =
      conformed(voxels_of(40,
                          [](const Vector3& p) {
                            if (!is_in_box(p, Vector3::Constant(20.0), 12.0)) return -1;
                            if (p.z() < 14.0) return 0;
                            if (p.z() > 26.0) return 1;
                            return (p.x() < 20.0) == (p.y() < 20.0) ? 0 : 1;
                          }),
                2);
  expect_conforming(result);
}

TEST(ConformingGrains, PiecesAreLeftOutAndPoresFilled) {
  const GrainVoxels voxels = voxels_of(40, [](const Vector3& p) {
    const double d = (p - Vector3::Constant(20.0)).norm();
    if (p.maxCoeff() < 4.0) return 0;
    return d < 3.0 || d > 14.0 ? -1 : 0;
  });
  const auto own = std::count(voxels.grain.begin(), voxels.grain.end(), 0);
  const ConformingGrains result = conformed(voxels, 1);
  expect_conforming(result);
  EXPECT_EQ(result.grains[0].pieces, 2U);
  EXPECT_EQ(result.grains[0].left_out, 64);
  EXPECT_GT(result.grains[0].pore_voxels, 80);  // a ball of radius 3 has 113
  // The share is of the label's own voxels, without the pores.
  EXPECT_DOUBLE_EQ(left_out(result), 64.0 / static_cast<double>(own));
  EXPECT_EQ(result.flattest, 0) << "the only grain, though all triangles are at its outside";
}

// A grain between others that is a voxel thick in its middle, which goes to these.
TEST(ConformingGrains, TellsWhatFallsOffAGrain) {
  const GrainVoxels voxels = voxels_of(30, [](const Vector3& p) {
    const Vector3 q = p - Vector3::Constant(15.5);
    if (q.cwiseAbs().maxCoeff() > 11.0) return -1;
    return q.x() < -3.0 || q.x() > 4.0 || std::abs(q.y()) < 0.6 ? 0 : q.y() < 0.0 ? 1 : 2;
  });
  const auto all = std::count(voxels.grain.begin(), voxels.grain.end(), 0);
  const ConformingGrains result = conformed(voxels, 3);
  expect_conforming(result);
  const ConformingGrain& grain = result.grains[0];
  EXPECT_EQ(grain.pieces, 1U);
  EXPECT_GT(grain.fallen_off, 3000);
  EXPECT_EQ(grain.left_out, grain.fallen_off);
  EXPECT_EQ(grain.voxels, all - grain.left_out + grain.gained);
  EXPECT_LT(grain.gained, -100) << "the thin part only";
  EXPECT_GT(result.grains[1].gained + result.grains[2].gained, 100);
  EXPECT_NEAR(left_out(result), static_cast<double>(grain.left_out) / (23.0 * 23.0 * 23.0), 1e-12);
  const std::vector<Sentence> warnings = conforming_warnings(result, {4, 5, 6});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(holds(warnings[0].text(), "More than 5 % fell off the grains 4: "));
}

TEST(ConformingGrains, StandInTheLatticeAlsoIfItIsLeftHandedAndItsVoxelsAreLong) {
  VolumeGeometry geometry;
  geometry.axes = test::random_rotation(6) * Vector3(-0.5, 0.8, 0.6).asDiagonal();
  geometry.corner = Vector3(30.0, -4.0, 7.0);
  ConformingOptions options;
  options.edge_length = 2.4;
  const ConformingGrains result = conform_grains(three_boxes(), 3, geometry, options, Execution(1));
  expect_conforming(result);
  EXPECT_NEAR(result.mean_edge, 2.4, 0.15);
  EXPECT_NEAR(result.grains[0].voxel_volume, 15.0 * 30.0 * 30.0 * 0.24, 1e-9);
  ASSERT_EQ(result.walls.size(), 3U);
  // Middles and area vectors of the walls, in voxels. The layer of background is one voxel wide.
  const std::array<std::array<Vector3, 2>, 3> by_hand = {
      {{Vector3(26.0, 18.5, 26.0), Vector3(15.0 * 30.0, 0.0, 0.0)},
       {Vector3(26.0, 33.5, 26.0), Vector3(15.0 * 30.0, 0.0, 0.0)},
       {Vector3(33.5, 26.0, 26.0), Vector3(0.0, 15.0 * 30.0, 0.0)}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const CommonWall& wall = result.walls[k];
    // Edges of the boxes are rounded by about a voxel.
    EXPECT_LT((wall.centre - geometry.point(by_hand[k][0])).norm(), 0.3) << k;
    // An area vector turns as the cofactors do; of the left-handed lattice it is turned round.
    const Vector3 area =
        -geometry.axes.determinant() * geometry.axes.inverse().transpose() * by_hand[k][1];
    EXPECT_GT(wall.normal.dot(area.normalized()), 0.99) << k;
    EXPECT_NEAR(wall.area / area.norm(), 1.0, 0.06) << k;
  }
  // The longest edge of a voxel counts.
  options.edge_length = 0.7;
  EXPECT_ERROR(conform_grains(three_boxes(), 3, geometry, options, Execution(1)), InvalidInput);
}

TEST(ConformingGrains, LongVoxelsMakeNoLongEdgesAndLostVolumesAreTold) {
  VolumeGeometry geometry;
  geometry.axes = Vector3(1.9, 0.9, 0.7).asDiagonal();
  const GrainVoxels voxels = random_cells(5, 24, 12, true, Between::NoisyGaps);
  ConformingOptions options;
  const ConformingGrains usual = conform_grains(voxels, 12, geometry, options, Execution(1));
  EXPECT_LT(usual.volume_error, 1e-9);
  EXPECT_TRUE(conforming_warnings(usual).empty());
  options.edge_length = 3.0 * 1.9;
  const ConformingGrains coarse = conform_grains(voxels, 12, geometry, options, Execution(1));
  ASSERT_GT(coarse.volume_error, 0.1);
  const std::vector<Sentence> warnings = conforming_warnings(coarse);
  ASSERT_FALSE(warnings.empty());
  const std::string told = "err by up to " + format_percent(coarse.volume_error) + ",";
  EXPECT_TRUE(holds(warnings[0].text(), told));
}

TEST(ConformingGrains, AreMeasuredAsByHand) {
  const ConformingGrains result = conformed(random_cells(4, 40, 9, true), 9);
  const auto length = [&](std::int32_t a, std::int32_t b) {
    return (result.points[static_cast<std::size_t>(a)] - result.points[static_cast<std::size_t>(b)])
        .norm();
  };
  double sum = 0.0;
  double squares = 0.0;
  double shortest = 1e9;
  double smallest = 180.0;
  std::set<std::int32_t> flattest;
  std::vector<std::set<std::int32_t>> neighbours(9);
  struct Wall {
    double area = 0.0;
    Vector3 moment = Vector3::Zero();
    Vector3 from_outer = Vector3::Zero();
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Wall> walls;
  for (const WallTriangle& t : result.triangles) {
    const auto& [a, b, c] = t.corners;
    const std::array<double, 3> sides = {length(b, c), length(c, a), length(a, b)};
    for (std::size_t k = 0; k < 3; ++k) {
      const double own = sides[k];
      const double next = sides[(k + 1) % 3];
      const double last = sides[(k + 2) % 3];
      sum += own;
      squares += own * own;
      shortest = std::min(shortest, own);
      const double angle =
          std::acos((next * next + last * last - own * own) / (2.0 * next * last)) * 180.0 / M_PI;
      if (angle >= smallest) continue;
      smallest = angle;
      flattest = {t.inner, t.outer};
    }
    if (t.outer < 0) continue;
    std::array<Vector3, 3> x;
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = result.points[static_cast<std::size_t>(t.corners[k])];
    const Vector3 area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
    Wall& wall = walls[{t.outer, t.inner}];
    wall.area += area.norm();
    wall.moment += area.norm() / 3.0 * (x[0] + x[1] + x[2]);
    wall.from_outer -= area;
    neighbours[static_cast<std::size_t>(t.inner)].insert(t.outer);
    neighbours[static_cast<std::size_t>(t.outer)].insert(t.inner);
  }
  const double count = 3.0 * static_cast<double>(result.triangles.size());
  EXPECT_NEAR(result.mean_edge, sum / count, 1e-12);
  EXPECT_NEAR(result.edge_variation, std::sqrt(squares * count / (sum * sum) - 1.0), 1e-9);
  EXPECT_DOUBLE_EQ(result.shortest_edge, shortest);
  EXPECT_NEAR(result.smallest_angle, smallest, 1e-9);
  EXPECT_EQ(flattest.count(result.flattest), 1U);
  for (std::size_t g = 0; g < 9; ++g) EXPECT_EQ(result.grains[g].contacts, neighbours[g].size());
  ASSERT_EQ(result.walls.size(), walls.size());
  for (const CommonWall& wall : result.walls) {
    const Wall& by_hand = walls.at({wall.first, wall.second});
    EXPECT_NEAR(wall.area, by_hand.area, 1e-9);
    EXPECT_LT((wall.centre - by_hand.moment / by_hand.area).norm(), 1e-9);
    // Each triangle counts by its area.
    EXPECT_LT((wall.normal - by_hand.from_outer.normalized()).norm(), 1e-9);
  }
}

TEST(ConformingGrains, CountEachVoxelOnce) {
  const GrainVoxels voxels = random_cells(2, 48, 12, false, Between::NoisyGaps);
  const ConformingGrains result = conformed(voxels, 12);
  std::int64_t gained = 0;
  for (std::size_t g = 0; g < 12; ++g) {
    const ConformingGrain& grain = result.grains[g];
    const auto own = std::count(voxels.grain.begin(), voxels.grain.end(), static_cast<int>(g));
    EXPECT_EQ(grain.voxels, own - grain.left_out + grain.pore_voxels + grain.gained) << g;
    EXPECT_DOUBLE_EQ(grain.voxel_volume, static_cast<double>(grain.voxels));
    EXPECT_NE(grain.gained, 0) << g;
    gained += grain.gained;
  }
  EXPECT_EQ(result.gained_voxels, gained);
}

/// The numbers of an array of a .vtu, by its name.
std::vector<Label> vtu_numbers(const std::string& vtu, const std::string& name) {
  const std::size_t begin = vtu.find('>', vtu.find("Name=\"" + name + "\"")) + 1;
  std::istringstream text(vtu.substr(begin, vtu.find('<', begin) - begin));
  std::vector<Label> numbers;
  for (std::int64_t number = 0; text >> number;) numbers.push_back(static_cast<Label>(number));
  return numbers;
}

TEST(ConformingGrains, TablesHaveTheLabelsAndNumbersOfWallsAndGrains) {
  ConformingGrains result = conformed(three_boxes(), 3);
  const std::vector<Label> labels = {4, 7, 9};
  for (std::size_t g = 0; g < 3; ++g) {
    // Numbers that no other column has.
    result.grains[g].gained = static_cast<int>(g) - 1;
    result.grains[g].voxel_volume = 1.5 + static_cast<double>(g);
    result.grains[g].pieces = 10 + g;
    result.grains[g].left_out = 20 + static_cast<int>(g);
  }
  const auto number = [](const std::string& text) { return std::stod(text); };
  auto walls = test::csv_rows(walls_csv(result, labels));
  ASSERT_EQ(walls.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const CommonWall& wall = result.walls[k];
    test::CsvRow& row = walls[k];
    EXPECT_EQ(row["first"], std::to_string(labels[static_cast<std::size_t>(wall.first)]));
    EXPECT_EQ(row["second"], std::to_string(labels[static_cast<std::size_t>(wall.second)]));
    EXPECT_EQ(number(row["area"]), wall.area);
    EXPECT_EQ(Vector3(number(row["x"]), number(row["y"]), number(row["z"])), wall.centre);
    EXPECT_EQ(Vector3(number(row["nx"]), number(row["ny"]), number(row["nz"])), wall.normal);
    EXPECT_EQ(number(row["triangles"]), static_cast<double>(wall.triangles));
  }
  auto grains = test::csv_rows(conforming_csv(result, labels, {"a", "b", "c"}));
  ASSERT_EQ(grains.size(), 3U);
  for (std::size_t g = 0; g < 3; ++g) {
    ConformingGrain& grain = result.grains[g];
    test::CsvRow& row = grains[g];
    EXPECT_EQ(row["grain"], std::to_string(labels[g]));
    EXPECT_EQ(number(row["nodes"]), static_cast<double>(grain.nodes));
    EXPECT_EQ(number(row["triangles"]), static_cast<double>(grain.triangles));
    EXPECT_EQ(number(row["voxels"]), static_cast<double>(grain.voxels));
    EXPECT_EQ(number(row["gained"]), static_cast<double>(g) - 1.0);
    EXPECT_EQ(number(row["voxel_volume"]), grain.voxel_volume);
    EXPECT_EQ(number(row["volume"]), grain.volume);
    EXPECT_EQ(row["contacts"], "2");
    EXPECT_EQ(row["pieces"], std::to_string(10 + g));
    EXPECT_EQ(row["left_out"], std::to_string(20 + g));
    EXPECT_EQ(row["file"], std::string(1, "abc"[g]));
  }
  const std::string vtu = walls_vtu(result, labels);
  const std::vector<Label> inner = vtu_numbers(vtu, "inner");
  const std::vector<Label> outer = vtu_numbers(vtu, "outer");
  ASSERT_EQ(inner.size(), result.triangles.size());
  ASSERT_EQ(outer.size(), result.triangles.size());
  for (std::size_t t = 0; t < inner.size(); ++t) {
    const WallTriangle& triangle = result.triangles[t];
    EXPECT_EQ(inner[t], labels[static_cast<std::size_t>(triangle.inner)]);
    EXPECT_EQ(outer[t], triangle.outer < 0 ? static_cast<Label>(-1)
                                           : labels[static_cast<std::size_t>(triangle.outer)]);
  }
}

TEST(ConformingGrains, SurfacesOfGmshBoundTheVolumeOfEachGrain) {
  const ConformingGrains result = conformed(random_cells(4, 40, 9, true), 9);
  const std::vector<Label> labels = {2, 3, 5, 7, 11, 13, 17, 19, 23};
  const std::vector<test::MshVolume> read = test::msh_volumes(walls_msh(result, labels));
  ASSERT_EQ(read.size(), 9U);
  for (std::size_t g = 0; g < 9; ++g) {
    EXPECT_NEAR(read[g].bounded / result.grains[g].volume, 1.0, 1e-9) << g;
  }
}

TEST(ConformingGrains, BothGrainsOfAnIntersectingTriangleAreNamed) {
  const ConformingGrains result =
      conformed(random_cells(1, 40, 14, false, Between::WedgesOfPores), 14, 8.0);
  ASSERT_GT(result.intersections, 0U);
  IndexedMesh mesh;
  mesh.points = result.points;
  for (const WallTriangle& t : result.triangles) mesh.triangles.push_back(t.corners);
  std::vector<bool> intersects(result.grains.size(), false);
  for (const auto& [a, b] : self_intersections(mesh, Execution(1))) {
    for (const std::int32_t t : {a, b}) {
      const WallTriangle& wall = result.triangles[static_cast<std::size_t>(t)];
      intersects[static_cast<std::size_t>(wall.inner)] = true;
      if (wall.outer >= 0) intersects[static_cast<std::size_t>(wall.outer)] = true;
    }
  }
  for (std::size_t g = 0; g < intersects.size(); ++g) {
    EXPECT_EQ(result.grains[g].intersects, intersects[g]) << g;
  }
}

TEST(ConformingGrains, SameBytesAtAnyNumberOfThreads) {
  const std::vector<Label> labels = {1, 2, 3, 4, 5, 6, 7, 8};
  const ConformingGrains one = conformed(random_cells(5, 40, 8, true), 8, 2.5, 1);
  const ConformingGrains two = conformed(random_cells(5, 40, 8, true), 8, 2.5, 2);
  EXPECT_EQ(walls_vtu(one, labels), walls_vtu(two, labels));
}

TEST(ConformingGrains, EachGrainHasAboutTheWantedNodes) {
  // A large and a small ball that touch, and cells that fill a volume.
  const GrainVoxels balls = voxels_of(60, [](const Vector3& p) {
    const double a = (p - Vector3(23.0, 30.0, 30.0)).norm() - 19.0;
    const double b = (p - Vector3(49.0, 30.3, 29.6)).norm() - 9.0;
    return std::min(a, b) > 0.0 ? -1 : a < b ? 0 : 1;
  });
  ConformingOptions options;
  options.nodes = 150;
  for (const bool are_balls : {true, false}) {
    const std::size_t grains = are_balls ? 2 : 8;
    const ConformingGrains result =
        conform_grains(are_balls ? balls : random_cells(3, 48, 8, false), grains, VolumeGeometry(),
                       options, Execution(1));
    expect_conforming(result);
    for (const ConformingGrain& grain : result.grains) {
      // A wall's nodes count for both grains; lines and points have no choice.
      EXPECT_NEAR(static_cast<double>(grain.nodes), 150.0, 30.0);
    }
  }
  options.edge_length = 3.0;
  EXPECT_ERROR(check_conforming_options(options), InvalidInput);
}

Fragments fragments_of(const IndexedMesh& grain, int count, int threads = 1) {
  FragmentOptions options;
  options.count = count;
  return fragment_grain(grain, options, Execution(threads));
}

TEST(ConformingGrains, FragmentsAreRemeshedWithCommonWalls) {
  // A remesh: a scan is smoothed by one before it is divided.
  const IndexedMesh grain =
      test::transformed(test::lumpy(3), test::random_rotation(5), Vector3(40.0, -7.0, 3.0));
  const double whole = volume_of(grain, Execution(1));
  for (const int count : {1, 2, 9}) {
    SCOPED_TRACE(count);
    Fragments fragments = fragments_of(grain, count);
    std::vector<double> volumes;
    for (const Fragment& one : fragments.list) volumes.push_back(one.mass.volume);
    const std::vector<CommonWall> cut = fragments.contacts;
    ConformingOptions options;
    options.nodes = 150;
    const ConformingGrains result = remesh_fragments(fragments, options, Execution(1));
    expect_conforming(result, volumes);
    EXPECT_EQ(result.intersections, 0U);
    // Long edges over short ones are rare: random triangulations have .3.
    EXPECT_LT(result.edge_variation, 0.2);
    double sum = 0.0;
    for (std::size_t k = 0; k < fragments.list.size(); ++k) {
      const Fragment& one = fragments.list[k];
      EXPECT_EQ(one.mesh.points.size(), result.grains[k].nodes);
      EXPECT_NEAR(one.mass.volume / volumes[k], 1.0, 1e-11);
      const MeshSums sums =
          mesh_sums(one.mesh.points, one.mesh.triangles, one.mesh.points[0], Execution(1));
      EXPECT_NEAR((one.surface_area + one.wall_area) / sums.area(), 1.0, 1e-11);
      EXPECT_NEAR(static_cast<double>(one.mesh.points.size()), 150.0, 25.0);
      sum += one.mass.volume;
    }
    EXPECT_NEAR(sum / whole, 1.0, 1e-11);
    // Walls stay where the cells met: the exact volumes bend them a little.
    ASSERT_EQ(fragments.contacts.size(), cut.size());
    for (std::size_t k = 0; k < cut.size(); ++k) {
      EXPECT_EQ(fragments.contacts[k].first, cut[k].first);
      EXPECT_EQ(fragments.contacts[k].second, cut[k].second);
      const double size = std::sqrt(cut[k].area);
      EXPECT_LT((fragments.contacts[k].centre - cut[k].centre).norm(), 0.1 * size + 0.02);
    }
  }
}

TEST(ConformingGrains, FragmentsThatLeaveTheGrainsSurfaceAreTold) {
  const IndexedMesh grain = test::moved(test::lumpy(3), 1e-3, Vector3(0.4, -0.7, 0.3));
  const double radius = equivalent_radius(volume_of(grain, Execution(1)));
  for (const int nodes : {12, 1000}) {
    SCOPED_TRACE(nodes);
    Fragments fragments = fragments_of(grain, 1);
    ConformingOptions options;
    options.nodes = nodes;
    const ConformingGrains result = remesh_fragments(fragments, options, Execution(1));
    const MeshDistances distances =
        measure_distances(fragments.list.front().mesh, grain, usual_distance_samples, Execution(1));
    EXPECT_NEAR(result.rms_distance * radius / distances.root_mean_square, 1.0, 0.03);
    EXPECT_NEAR(result.largest_distance * radius / distances.largest, 1.0, 0.05);
    const std::vector<Sentence> warnings = conforming_warnings(result);
    const bool is_told = std::any_of(warnings.begin(), warnings.end(), [](const Sentence& warning) {
      return test::holds(warning.text(), "do not follow the grain's surface");
    });
    EXPECT_EQ(is_told, nodes == 12);
    EXPECT_TRUE(holds(conforming_lines(result).back(), format_percent(result.rms_distance)));
  }
}

TEST(ConformingGrains, FragmentsHaveTheEdgesOfTheGrain) {
  Fragments fragments = fragments_of(test::lumpy(3), 5);
  const double edge = mean_edge_of(test::lumpy(3));
  const ConformingGrains usual = remesh_fragments(fragments, ConformingOptions(), Execution(1));
  EXPECT_NEAR(usual.mean_edge / edge, 1.0, 0.05);
  // Again, of the remesh, and by two threads.
  ConformingOptions options;
  options.edge_length = 1.5 * edge;
  Fragments other = fragments;
  const ConformingGrains wide = remesh_fragments(fragments, options, Execution(1));
  EXPECT_NEAR(wide.mean_edge / options.edge_length, 1.0, 0.05);
  const ConformingGrains threads = remesh_fragments(other, options, Execution(2));
  EXPECT_EQ(threads.points, wide.points);
  options.nodes = 100;
  EXPECT_ERROR(remesh_fragments(fragments, options, Execution(1)), InvalidInput);
}

TEST(ConformingGrains, LongEdgesOfFragmentsAreDividedInStepsThatCanBeCancelled) {
  Fragments fragments = fragments_of(test::box(1.0, 1.0, 1.0), 2);
  ConformingOptions options;
  options.edge_length = 0.2;
  int reports = 0;
  remesh_fragments(fragments, options, Execution(1, [&](double, const std::string& stage) {
                     reports += stage == "Finding the walls" ? 1 : 0;
                     return true;
                   }));
  EXPECT_GE(reports, 10);  // six steps of halves, and four rounds
}

TEST(ConformingGrains, RefusesFragmentsWithoutEnd) {
  Fragments fragments = fragments_of(test::lumpy(2), 9);
  ConformingOptions options;
  options.edge_length = 1e-4;
  const auto refused = [&] {
    return test::refusal(ErrorCode::InvalidInput,
                         [&] { remesh_fragments(fragments, options, Execution(1)); });
  };
  EXPECT_TRUE(holds(refused(), "million triangles, more than 4 million. Give a larger"));
  options.edge_length = 0.0;
  options.nodes = 1000000;
  EXPECT_TRUE(holds(refused(), "Give fewer nodes."));
  // Of a fragment's n nodes its closed mesh has twice as many triangles; those of walls are of two.
  double wanted = 0.0;
  for (const Fragment& one : fragments.list) {
    const double all = one.surface_area + one.wall_area;
    wanted += 2.0 * options.nodes * one.surface_area / all;
  }
  for (const CommonWall& wall : fragments.contacts) {
    const auto triangle = [&](std::int32_t k) {
      const Fragment& one = fragments.list[static_cast<std::size_t>(k)];
      return (one.surface_area + one.wall_area) / (2.0 * options.nodes);
    };
    wanted += wall.area / std::sqrt(triangle(wall.first) * triangle(wall.second));
  }
  EXPECT_TRUE(holds(refused(), "about " + format_number(1e-6 * wanted, 3) + " million triangles"))
      << refused() << wanted;
}

TEST(ConformingGrains, RefusesWhatItCannotRemesh) {
  const auto refused = [](std::size_t grains, double edge) {
    return test::refusal(ErrorCode::InvalidInput, [&] { conformed(two_balls(), grains, edge); });
  };
  EXPECT_TRUE(holds(refused(0, 3.0), "no grain"));
  EXPECT_TRUE(holds(refused(3, 3.0), "Grain 2 has no voxel"));
  const std::string small = test::refusal(ErrorCode::InvalidInput, [] {
    conformed(voxels_of(10,
                        [](const Vector3& p) {
                          return is_in_box(p, Vector3::Constant(5.0), 0.9) ? 0 : -1;
                        }),
              1);
  });
  EXPECT_TRUE(holds(small, "Grain 0 has only 8 voxels"));
  EXPECT_TRUE(holds(small, "--smallest"));
  // Three hollow cubes of 26 voxels: the advice counts those of the label, not the pores.
  const std::string hollow = test::refusal(ErrorCode::InvalidInput, [] {
    conformed(voxels_of(20,
                        [](const Vector3& p) {
                          for (const double at : {3.5, 9.5, 15.5}) {
                            const double away = (p - Vector3::Constant(at)).cwiseAbs().maxCoeff();
                            if (away < 1.1) return away < 0.1 ? -1 : 0;
                          }
                          return -1;
                        }),
              1);
  });
  EXPECT_TRUE(holds(hollow, "only 27 voxels")) << hollow;
  EXPECT_TRUE(holds(hollow, "--smallest 79")) << hollow;
  EXPECT_TRUE(holds(refused(2, 0.5), "below a voxel's edge"));
  EXPECT_NE(refused(2, -1.0), "");
}

// Twelve grains of 1,000 voxels, with numbers made by hand.
TEST(ConformingLines, AreThoseOfTheNumbers) {
  ConformingGrains grains;
  grains.grains.resize(12);
  std::vector<Label> labels;
  for (std::size_t g = 0; g < 12; ++g) {
    grains.grains[g].voxels = 1000;
    labels.push_back(static_cast<Label>(10 * (g + 1)));
  }
  grains.walls.resize(20);
  grains.mean_edge = 2.0;
  grains.edge_variation = 0.25;
  grains.shortest_edge = 0.3;
  grains.smallest_angle = 20.0;
  grains.flattest = 1;
  grains.gained_voxels = 600;
  grains.walls_across = 4;
  grains.lost_walls = 3;
  grains.volume_error = 2e-5;
  EXPECT_TRUE(conforming_warnings(grains, labels).empty());
  const std::vector<std::string> lines = conforming_lines(grains);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_TRUE(holds(lines[0], "12 grains with 20 common walls"));
  EXPECT_TRUE(holds(lines[1], "mean 2, standard deviation 25 % of it, shortest 0.3"));
  EXPECT_TRUE(holds(lines[2], "600 voxels, 5 % of the grains"));
  EXPECT_TRUE(holds(lines[3], "do not touch: 4. Labels that touch without a wall: 3 pairs"));
  EXPECT_EQ(lines[4], "Volumes: exact within 0.002 %");

  // Of 1,060 voxels 60 fell off: 5.7 %. Of 1,050 only 4.8.
  for (std::size_t g = 0; g < 12; ++g) grains.grains[g].fallen_off = g == 11 ? 50 : 60;
  grains.grains[2].intersects = grains.grains[4].intersects = true;
  grains.intersections = 7;
  grains.volume_error = 0.004;
  grains.smallest_angle = 2.0;
  const std::vector<Sentence> warnings = conforming_warnings(grains, labels);
  ASSERT_EQ(warnings.size(), 4U);
  EXPECT_TRUE(
      holds(warnings[0], "grains 10, 20, 30, 40, 50, 60, 70, 80, 90, 100 and 1 more: they hang"));
  EXPECT_TRUE(holds(warnings[1], "err by up to 0.4 %"));
  EXPECT_TRUE(
      holds(warnings[2], "7 pairs of triangles intersect, in thin parts of the grains 30, 50."));
  EXPECT_TRUE(holds(warnings[3], "2 degrees, at grain 20."));

  // Fragments have no labels: they count from 1, as in their table.
  for (ConformingGrain& grain : grains.grains) grain.fallen_off = 0;
  grains.is_inaccurate = true;
  grains.rms_distance = 0.02;
  grains.largest_distance = 0.07;
  const std::vector<Sentence> of_fragments = conforming_warnings(grains);
  ASSERT_EQ(of_fragments.size(), 4U);
  EXPECT_TRUE(holds(of_fragments[1], "rms 2 % of the equivalent radius, largest 7 %"));
  EXPECT_TRUE(holds(of_fragments[2], "in thin parts of the fragments 3, 5."));
  EXPECT_TRUE(holds(of_fragments[3], "at fragment 2."));
}

}  // namespace
}  // namespace wscvt
