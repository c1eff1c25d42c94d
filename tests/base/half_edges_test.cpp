// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/half_edges.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <utility>

#include "support/random_triangulations.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/base/counting_sort.h"

namespace wscvt {
namespace {

/// Against a table of all directed edges.
void expect_links(const std::vector<Triangle>& triangles,
                  const std::vector<std::int32_t>& opposite) {
  const auto count = static_cast<std::int32_t>(3 * triangles.size());
  ASSERT_EQ(opposite.size(), 3 * triangles.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> edges;
  for (std::int32_t h = 0; h < count; ++h) {
    edges[{origin_of(triangles, h), target_of(triangles, h)}] = h;
  }
  for (std::int32_t h = 0; h < count; ++h) {
    const auto other = edges.find({target_of(triangles, h), origin_of(triangles, h)});
    ASSERT_EQ(opposite[h], other == edges.end() ? -1 : other->second) << h;
  }
}

TEST(HalfEdges, AreLinkedToThoseThatRunTheOtherWay) {
  std::mt19937_64 engine(test::announced(7));
  IndexedMesh open = test::lumpy(3);
  open.triangles.erase(open.triangles.begin() + 100, open.triangles.begin() + 140);
  open.points.emplace_back(0, 0, 0);  // of no triangle
  // Hubs with few neighbours beside them and many: either list may be the shorter one.
  for (const IndexedMesh& mesh :
       {test::torus(1.0, 0.3, 20), open, test::double_fan(100), test::apollonian(300, engine)}) {
    const HalfEdges links = link_half_edges(mesh.triangles, mesh.points.size());
    expect_links(mesh.triangles, links.opposite);
    ASSERT_EQ(links.first.size(), mesh.points.size());
    std::set<std::int32_t> used;
    for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.points.size()); ++v) {
      if (used.count(v) == 0) {
        EXPECT_EQ(links.first[v], -1);
      } else {
        EXPECT_EQ(origin_of(mesh.triangles, links.first[v]), v);
      }
    }
  }
}

TEST(HalfEdges, GoOnceRoundAVertexCounterClockwise) {
  const IndexedMesh mesh = test::sphere(2);
  const HalfEdges links = link_half_edges(mesh.triangles, mesh.points.size());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.points.size()); ++v) {
    std::vector<Vector3> ring;
    visit_outgoing(links.opposite, links.first[v], [&](std::int32_t h) {
      ASSERT_EQ(origin_of(mesh.triangles, h), v);
      ASSERT_EQ(next_half_edge(previous_half_edge(h)), h);
      ring.push_back(mesh.points[target_of(mesh.triangles, h)]);
    });
    ASSERT_TRUE(ring.size() == 5 || ring.size() == 6);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      EXPECT_GT(mesh.points[v].dot(ring[k].cross(ring[(k + 1) % ring.size()])), 0.0);
    }
  }
}

TEST(HalfEdges, FlipsLinkAllThatLiesBeyond) {
  std::mt19937_64 engine(test::announced(8));
  IndexedMesh mesh = test::sphere(2);
  mesh.triangles.erase(mesh.triangles.begin() + 10, mesh.triangles.begin() + 20);  // with borders
  std::vector<std::int32_t> opposite = link_half_edges(mesh.triangles, mesh.points.size()).opposite;
  int flips = 0;
  while (flips < 200) {
    const auto h = static_cast<std::int32_t>(engine() % opposite.size());
    const std::int32_t other = opposite[h];
    if (other < 0) continue;
    const std::int32_t a = origin_of(mesh.triangles, h);
    const std::int32_t b = target_of(mesh.triangles, h);
    const std::int32_t c = origin_of(mesh.triangles, previous_half_edge(h));
    const std::int32_t d = origin_of(mesh.triangles, previous_half_edge(other));
    bool joined = false;  // an edge must not come twice
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        joined = joined || std::minmax(t[k], t[(k + 1) % 3]) == std::minmax(c, d);
      }
    }
    if (joined) continue;
    flip_edge(h, mesh.triangles, opposite);
    ++flips;
    const auto t = static_cast<std::int32_t>(3 * face_of(h));
    const auto u = static_cast<std::int32_t>(3 * face_of(other));
    EXPECT_EQ(mesh.triangles[face_of(t)], (Triangle{c, a, d}));
    EXPECT_EQ(mesh.triangles[face_of(u)], (Triangle{d, b, c}));
    expect_links(mesh.triangles, opposite);
  }
}

}  // namespace

namespace {

using Sets = std::vector<std::set<std::int32_t>>;

/// The groups as sets; fails where one is not in ascending order.
Sets sets_of(const Groups& groups) {
  Sets sets(groups.starts.size() - 1);
  for (std::size_t g = 0; g < sets.size(); ++g) {
    sets[g] = {groups.begin(g), groups.end(g)};
    EXPECT_TRUE(std::equal(groups.begin(g), groups.end(g), sets[g].begin(), sets[g].end()));
  }
  return sets;
}

TEST(CountingSort, PutsEveryItemIntoItsGroups) {
  std::mt19937_64 random(test::announced(4));
  constexpr std::size_t groups = 700;
  Sets expected(groups);
  std::vector<std::vector<std::size_t>> groups_of(30000);
  for (std::size_t item = 0; item < groups_of.size(); ++item) {
    for (std::uint64_t k = random() % 4; k > 0; --k) {
      const std::size_t group = random() % groups;
      if (expected[group].insert(static_cast<std::int32_t>(item)).second) {
        groups_of[item].push_back(group);
      }
    }
  }
  const auto visit_groups = [&](std::size_t item, const auto& visit) {
    for (const std::size_t group : groups_of[item]) visit(group);
  };
  EXPECT_EQ(sets_of(counting_sort(groups_of.size(), groups, visit_groups)), expected);
}

TEST(CountingSort, LeavesGroupsEmpty) {
  const auto into_three = [](std::size_t, const auto& visit) { visit(3); };
  EXPECT_EQ(sets_of(counting_sort(0, 2, into_three)), (Sets{{}, {}}));
  EXPECT_EQ(sets_of(counting_sort(2, 5, into_three)), (Sets{{}, {}, {}, {0, 1}, {}}));
  EXPECT_EQ(counting_sort(0, 0, into_three).starts, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace wscvt
