// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/coordinates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt {
namespace {

using test::holds;

IndexedMesh rounded(IndexedMesh mesh, const Vector3& offset, double step) {
  for (Vector3& p : mesh.points) {
    p += offset;
    for (int axis = 0; axis < 3; ++axis) {
      // Volatile: optimised, GCC 12 leaves the rounding to single precision out.
      volatile const auto single = static_cast<float>(p[axis]);
      p[axis] = step > 0.0 ? std::round(p[axis] / step) * step : static_cast<double>(single);
    }
  }
  return mesh;
}

TEST(Coordinates, SinglePrecisionFarAwayIsNoticed) {
  const IndexedMesh mesh = test::lumpy(5);  // edges of about 0.05
  EXPECT_EQ(precision_warning(mesh), "");
  EXPECT_EQ(precision_warning(rounded(mesh, Vector3::Zero(), 0.0)), "");
  EXPECT_EQ(precision_warning(rounded(mesh, Vector3(1000, 0, 0), 0.0)), "");
  const std::string far = precision_warning(rounded(mesh, Vector3(0, -1e6, 0), 0.0));
  EXPECT_TRUE(holds(far, "The scan is so far from the origin"));
  EXPECT_TRUE(holds(far, "at one point"));
  // The advice: moved first, or kept in double.
  IndexedMesh in_double = mesh;
  for (Vector3& p : in_double.points) p += Vector3(0, -1e6, 0);
  EXPECT_EQ(precision_warning(in_double), "");
}

TEST(Coordinates, TheStepOfSinglePrecisionIsTold) {
  const IndexedMesh mesh = test::lumpy(5);
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += (mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]).norm();
    }
  }
  const double edge = sum / static_cast<double>(3 * mesh.triangles.size());
  // Floats from 2^16 to 2^17 are 2^-7 apart.
  const std::string far = precision_warning(rounded(mesh, Vector3(0, 0, 1e5), 0.0));
  std::smatch steps;
  ASSERT_TRUE(std::regex_search(far, steps, std::regex("have steps of ([0-9.]+) %"))) << far;
  EXPECT_NEAR(std::stod(steps[1]), 100.0 / 128.0 / edge, 1.0);
}

TEST(Coordinates, OfVerticesWithoutAFaceDoNotCount) {
  IndexedMesh mesh = rounded(test::lumpy(4), Vector3::Zero(), 0.0);
  mesh.points.emplace_back(1e9, 0, 0);
  EXPECT_EQ(precision_warning(mesh), "");
}

TEST(Coordinates, TooFewDecimalsAreNoticed) {
  const IndexedMesh mesh = test::lumpy(5);
  EXPECT_EQ(precision_warning(rounded(mesh, Vector3::Zero(), 1e-4)), "");
  // The step itself is told, not one that would be too coarse already.
  const IndexedMesh fine = test::lumpy(7);
  for (const auto& [step, told] : {std::pair(0.1, "steps of 0.1,"), {0.01, "steps of 0.01,"}}) {
    const std::string coarse = precision_warning(rounded(fine, Vector3::Zero(), step));
    EXPECT_TRUE(holds(coarse, told));
    EXPECT_TRUE(holds(coarse, "more digits"));
  }
}

TEST(Coordinates, LatticesAreNotSuspected) {
  // A body of unit cubes: coarse coordinates, no face lost.
  EXPECT_EQ(precision_warning(test::box(1, 1, 1)), "");
  EXPECT_EQ(precision_warning(IndexedMesh()), "");
}

TEST(Coordinates, AHugeOneHasNoStep) {
  // Its edges have a step beside which the products of the other coordinates are too small for a
  // number.
  IndexedMesh mesh = test::lumpy(3);
  mesh.triangles.push_back({0, 0, 1});  // a lost face
  for (const double huge : {1e300, -1e305}) {
    mesh.points[2].x() = huge;
    for (std::size_t k = 3; k < mesh.points.size(); ++k) mesh.points[k] *= 1e-14;
    EXPECT_EQ(precision_warning(mesh), "");
  }
}

TEST(Coordinates, EveryPointCountsForTheSize) {
  for (const double far : {1e61, -1e61}) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::vector<Vector3> points(4, Vector3(1.0, 2.0, 3.0));
      points[i].y() = far;
      EXPECT_ERROR(check_scan_size(points), InvalidInput);
    }
  }
}

TEST(Coordinates, SizeIsThatOfTheBoxWhereverItIs) {
  const auto box_at = [](double size, const Vector3& place) {
    return test::transformed(test::box(size, 0.5 * size, 0.0), Eigen::Matrix3d::Identity(), place)
        .points;
  };
  for (const double size : {1e-59, 1.0, 1e59}) {
    EXPECT_NO_THROW(check_scan_size(box_at(size, Vector3::Zero()))) << size;
    EXPECT_NO_THROW(check_scan_size(box_at(size, Vector3(3 * size, 0, 0)))) << size;
  }
  for (const double size : {1e-61, 1e61}) {
    SCOPED_TRACE(size);
    EXPECT_ERROR(check_scan_size(box_at(size, Vector3::Zero())), InvalidInput);
    EXPECT_ERROR(check_scan_size(box_at(size, Vector3(0, 0, -2 * size))), InvalidInput);
    // The longest side decides, whichever it is.
    EXPECT_ERROR(check_scan_size(Vector3(0, 0, size)), InvalidInput);
    EXPECT_NO_THROW(check_scan_size(Vector3(0, 1, 1e-61)));
  }
  // Left to those who say more of it.
  using Points = std::vector<Vector3>;
  EXPECT_NO_THROW(check_scan_size(Points()));
  EXPECT_NO_THROW(check_scan_size(Points{{1e70, 0, 0}, {1e70, 0, 0}}));
  EXPECT_NO_THROW(check_scan_size(Points{{1e70, 0, 0}, {0, std::nan(""), 0}}));
}

}  // namespace
}  // namespace wscvt
