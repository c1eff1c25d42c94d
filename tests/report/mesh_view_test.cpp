// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/mesh_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(MeshView, SeesTheNearSideOfASphereAndNothingElse) {
  const IndexedMesh sphere = test::sphere(4);
  const MeshView view = view_of({&sphere}, 200);
  const SeenMesh seen = look_at(sphere, view);
  const Vector3 towards = view.right.cross(view.up);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] < 0) continue;
    ++covered;
    EXPECT_GT(seen.points[i].dot(towards), -0.05);
    EXPECT_NEAR(seen.points[i].norm(), 1.0, 0.005);
    const double y = (100.0 - (static_cast<double>(i / 200) + 0.5)) * view.half_size / 100.0;
    EXPECT_NEAR(seen.points[i].dot(view.up), y, 1e-9);
  }
  // A disc of radius 1 in a square of 2 half_size; the facets cut its rim by less than 0.5 %.
  const double share = static_cast<double>(covered) / (200.0 * 200.0);
  EXPECT_NEAR(share, test::pi / (4.0 * view.half_size * view.half_size), 0.01);
}

TEST(MeshView, HoldsMeshesWholeWithAMargin) {
  const IndexedMesh near = test::transformed(test::box(1, 2, 3), test::random_rotation(4));
  const IndexedMesh far = test::transformed(near, Eigen::Matrix3d::Identity(), {5, -7, 4});
  for (const auto& meshes :
       {std::vector<const IndexedMesh*>{&near}, std::vector<const IndexedMesh*>{&far, &near},
        std::vector<const IndexedMesh*>{&near, &far}}) {
    const MeshView view = view_of(meshes, 100);
    EXPECT_NEAR(view.right.norm(), 1.0, 1e-15);
    EXPECT_NEAR(view.up.norm(), 1.0, 1e-15);
    EXPECT_NEAR(view.right.dot(view.up), 0.0, 1e-15);
    EXPECT_EQ(view.right.z(), 0.0);  // z is up
    EXPECT_GT(view.up.z(), 0.5);
    EXPECT_GT(view.right.cross(view.up).z(), 0.0);  // from somewhat above
    double largest = 0.0;
    for (const IndexedMesh* const mesh : meshes) {
      for (const Vector3& p : mesh->points) {
        largest = std::max({largest, std::abs((p - view.centre).dot(view.right)),
                            std::abs((p - view.centre).dot(view.up))});
      }
    }
    EXPECT_NEAR(view.half_size, 1.04 * largest, 1e-12);
  }
}

TEST(MeshView, SeesWhatALineToTheViewerLeavesLast) {
  // Every pixel against every triangle: a ring before, behind and through balls, drawn in either
  // order.
  const auto ball_at = [](const Vector3& place) {
    return test::transformed(test::sphere(1), 0.4 * Eigen::Matrix3d::Identity(), place);
  };
  IndexedMesh mesh = test::transformed(
      test::joined(
          ball_at({1.0, 0.5, -1.0}),
          test::joined(test::torus(1.0, 0.4, 12),
                       test::joined(ball_at({-1.0, 0.5, 1.0}), ball_at({0.2, -1.0, 0.1})))),
      test::random_rotation(7));
  const int pixels = 60;
  const MeshView view = view_of({&mesh}, pixels);
  const Vector3 towards = view.right.cross(view.up);
  const double pixel = 2.0 * view.half_size / pixels;
  for (int order = 0; order < 2; ++order) {
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    const SeenMesh seen = look_at(mesh, view);
    std::size_t hidden = 0;
    for (int row = 0; row < pixels; ++row) {
      for (int column = 0; column < pixels; ++column) {
        const Vector3 line = view.centre + (column + 0.5 - 0.5 * pixels) * pixel * view.right +
                             (0.5 * pixels - row - 0.5) * pixel * view.up;
        std::int32_t face = -1;
        double depth = -1e9;
        double edge = 0.0;
        Vector3 point = Vector3::Zero();
        int sheets = 0;
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
          // The triangle without its depth, and how far inside each of its sides the line is.
          std::array<Vector3, 3> corners;
          std::array<Vector3, 3> flat;
          for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = mesh.points[mesh.triangles[f][k]];
            flat[k] = corners[k] - line;
            flat[k] -= flat[k].dot(towards) * towards;
          }
          double distance = 1e9;
          for (std::size_t k = 0; k < 3; ++k) {
            const Vector3 side = flat[(k + 1) % 3] - flat[k];
            distance = std::min(distance, flat[k].cross(side).dot(towards) / side.norm());
          }
          if (distance < 0.0) continue;  // beside it, or seen from behind
          ++sheets;
          const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
          const Vector3 at = line + normal.dot(corners[0] - line) / normal.dot(towards) * towards;
          if (at.dot(towards) <= depth) continue;
          depth = at.dot(towards);
          face = static_cast<std::int32_t>(f);
          edge = distance / pixel;
          point = at;
        }
        hidden += sheets > 1 ? 1 : 0;
        const std::size_t i = static_cast<std::size_t>(row) * pixels + column;
        ASSERT_EQ(seen.faces[i], face) << row << " " << column;
        EXPECT_LT((seen.points[i] - point).norm(), 1e-12);
        EXPECT_NEAR(seen.edges[i], edge, 1e-10);
      }
    }
    EXPECT_GT(hidden, 50U);
  }
}

TEST(MeshView, IsLitFromAboveTheViewerAndEdgesAreDark) {
  const IndexedMesh sphere = test::sphere(3);
  const MeshView view = view_of({&sphere}, 120);
  const SeenMesh seen = look_at(sphere, view);
  const Picture plain = draw(sphere, seen, view, false, {});
  const Picture edged = draw(sphere, seen, view, true, {});
  const Vector3 light = (view.right.cross(view.up) + 0.6 * view.up - 0.4 * view.right).normalized();
  std::size_t dark = 0;
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] < 0) {
      EXPECT_EQ(plain.pixels[i], (Colour{255, 255, 255}));
      EXPECT_EQ(edged.pixels[i], (Colour{255, 255, 255}));
      continue;
    }
    // 35 % of the grey of 200 all round, the rest from the light; the facets are 0.1 wide.
    const double lit = std::max(0.0, seen.points[i].dot(light));
    EXPECT_NEAR(plain.pixels[i][0], 70.0 + 130.0 * lit, 12.0);
    EXPECT_EQ(plain.pixels[i][0], plain.pixels[i][2]);
    const bool at_edge = seen.edges[i] < 1.1;
    dark += at_edge ? 1 : 0;
    EXPECT_NEAR(edged.pixels[i][1], (at_edge ? 0.35 : 1.0) * plain.pixels[i][1], 1.0);
  }
  EXPECT_GT(dark, 1000U);
}

TEST(MeshView, ColoursComeFromThePointsSeen) {
  const IndexedMesh box = test::box(1, 1, 1);
  const MeshView view = view_of({&box}, 100);
  const SeenMesh seen = look_at(box, view);
  const auto by_height = [](const std::vector<Vector3>& points) {
    std::vector<Colour> colours;
    for (const Vector3& p : points) {
      colours.push_back(p.z() > 0.49999 ? Colour{255, 0, 0} : Colour{0, 0, 255});
    }
    return colours;
  };
  const Picture picture = draw(box, seen, view, false, by_height);
  std::size_t red = 0;
  std::size_t blue = 0;
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] < 0) {
      EXPECT_EQ(picture.pixels[i], (Colour{255, 255, 255}));
      continue;
    }
    // Colours are those of squares of four pixels: away from the rim of the top each is its own.
    if (std::abs(seen.points[i].head<2>().cwiseAbs().maxCoeff() - 0.5) < 0.05 &&
        std::abs(seen.points[i].z() - 0.5) < 0.05) {
      continue;
    }
    (seen.points[i].z() > 0.49999 ? red : blue) += 1;
    EXPECT_EQ(picture.pixels[i][seen.points[i].z() > 0.49999 ? 2 : 0], 0);
  }
  EXPECT_GT(red, 100U);
  EXPECT_GT(blue, red);
  EXPECT_EQ(diverging_colour(0.0)[0], diverging_colour(0.0)[2]);
  EXPECT_GT(diverging_colour(1.0)[0], diverging_colour(1.0)[2]);
  EXPECT_LT(diverging_colour(-2.0)[0], diverging_colour(-2.0)[2]);
}

}  // namespace
}  // namespace wscvt
