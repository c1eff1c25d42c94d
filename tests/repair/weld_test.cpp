// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/weld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/seeds.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {
namespace {

TEST(Weld, FindsWhatABruteSearchFinds) {
  // Clusters around points on a lattice whose spacing is that of the grid inside, so that many lie
  // on the sides and corners of its cells; tolerances from none to one that merges clusters.
  std::mt19937_64 engine(test::announced(11));
  for (const double tolerance : {0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.01}) {
    for (int round = 0; round < 20; ++round) {
      SCOPED_TRACE(tolerance);
      std::vector<Vector3> points;
      std::uniform_real_distribution<double> off(-2.0, 2.0);
      for (int i = 0; i < 400; ++i) {
        Vector3 p;
        for (int k = 0; k < 3; ++k) {
          const double lattice = round % 2 == 0 ? 64.0 * tolerance : 0.05;
          p[k] = std::min(1.0, lattice * static_cast<double>(engine() % 20) +
                                   (round % 3 == 0 ? 0.0 : 0.6 * tolerance * off(engine)));
        }
        points.push_back(p);
      }
      points.emplace_back(0, 0, 0);
      points.emplace_back(-0.0, 0, -0.0);
      points.emplace_back(1, 1, 1);
      Box box;
      for (const Vector3& p : points) box.extend(p);
      const Weld weld = find_equal_points(points, box, tolerance, Execution(2));
      std::size_t welded = 0;
      std::vector<std::int32_t> kept;
      for (std::size_t i = 0; i < points.size(); ++i) {
        auto expected = static_cast<std::int32_t>(i);
        for (const std::int32_t other : kept) {
          if ((points[static_cast<std::size_t>(other)] - points[i]).cwiseAbs().maxCoeff() <=
              tolerance) {
            expected = other;
            break;
          }
        }
        if (expected == static_cast<std::int32_t>(i)) {
          kept.push_back(expected);
        } else {
          ++welded;
        }
        if (!weld.first.empty()) {
          ASSERT_EQ(weld.first[i], expected) << i;
        }
      }
      EXPECT_EQ(weld.welded, welded);
      EXPECT_GT(welded, 0U);  // the two zeros at least
    }
  }
}

TEST(Weld, BoxHoldsEveryCornerOfEveryFaceAndNothingElse) {
  // One of the corners of one face alone is the farthest, in turn along each axis and either way:
  // the first and the last face, faces at the ends of the blocks, and each of the three corners. A
  // point that no face has is farther still.
  IndexedMesh mesh;
  constexpr std::size_t face_count = 40000;  // three blocks
  for (std::size_t f = 0; f < face_count; ++f) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (int k = 0; k < 3; ++k) mesh.points.emplace_back(0.25 * k, 1.0 - 0.5 * k, 0.125 * k);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.points.emplace_back(1e9, -1e9, 1e9);
  for (const std::size_t face :
       {std::size_t{0}, std::size_t{16383}, std::size_t{16384}, face_count - 1}) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        for (const double place : {-7.5, 8.5}) {
          Vector3& point = mesh.points[3 * face + corner];
          const Vector3 kept = point;
          point[axis] = place;
          const Box box = box_of_faces(mesh);
          EXPECT_EQ(place < 0.0 ? box.min()[axis] : box.max()[axis], place)
              << face << " " << corner;
          for (Eigen::Index other = 0; other < 3; ++other) {
            if (other == axis) continue;
            EXPECT_GE(box.min()[other], 0.0);
            EXPECT_LE(box.max()[other], 1.0);
          }
          point = kept;
        }
      }
    }
  }
}

TEST(Weld, LeavesPointsOutsideOfTheBoxAlone) {
  const std::vector<Vector3> points = {
      {0, 0, 0}, {1e300, 0, 0}, {1e300, 0, 0}, {1, 1, 1}, {0, 0, 0}};
  const Weld weld =
      find_equal_points(points, {Vector3(0, 0, 0), Vector3(1, 1, 1)}, 1e-12, Execution(1));
  EXPECT_EQ(weld.first, (std::vector<std::int32_t>{0, 1, 2, 3, 0}));
}

TEST(Weld, LeavesAloneWhatIsNoNumber) {
  // Points of no face, which may be anywhere.
  const double nothing = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Vector3> points = {{0, 0, 0},        {nothing, 0, 0},  {nothing, 0, 0},
                                       {0, infinity, 0}, {0, infinity, 0}, {1, 1, 1},
                                       {0, 0, 0},        {0, 0, nothing}};
  const Box box{Vector3(0, 0, 0), Vector3(1, 1, 1)};
  for (const double tolerance : {0.0, 1e-12, 0.01}) {
    const Weld weld = find_equal_points(points, box, tolerance, Execution(1));
    EXPECT_EQ(weld.welded, 1U);
    EXPECT_EQ(weld.first, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 0, 7}));
  }
}

}  // namespace
}  // namespace wscvt
