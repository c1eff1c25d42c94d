// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/distance_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/distances.h"

namespace wscvt {
namespace {

using test::holds;

/// Calls `visit(point, value)` for every point.
template <class Visit>
void for_each_point(const DistanceGrid& grid, const Visit& visit) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < grid.counts[0]; ++i) {
    for (std::size_t j = 0; j < grid.counts[1]; ++j) {
      for (std::size_t k = 0; k < grid.counts[2]; ++k) {
        const Vector3 step(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        visit(Vector3(grid.origin + grid.spacing * step), grid.values[next++]);
      }
    }
  }
}

double number_at(const std::string& bytes, std::size_t place) {
  double number = 0.0;
  std::memcpy(&number, &bytes[place], sizeof number);
  return number;
}

TEST(DistanceGrid, OfABoxIsItsClosedForm) {
  const Vector3 half(0.5, 1.0, 1.5);
  const DistanceGrid grid = distance_grid(test::box(1, 2, 3), {0.17}, Execution(2));
  int inside = 0;
  for_each_point(grid, [&](const Vector3& p, double value) {
    const Vector3 beyond = p.cwiseAbs() - half;
    const double exact = beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
    EXPECT_NEAR(value, exact, 1e-12) << p.transpose();
    if (value < 0.0) ++inside;
  });
  EXPECT_EQ(inside, 5 * 11 * 17);  // the multiples of 0.17 below half the edges
  // Four cells beyond the box on every side, and not five.
  for (int k = 0; k < 3; ++k) {
    const double last =
        grid.origin[k] + 0.17 * static_cast<double>(grid.counts[static_cast<std::size_t>(k)] - 1);
    EXPECT_LE(grid.origin[k], -half[k] - 4 * 0.17 + 1e-9);
    EXPECT_GT(grid.origin[k], -half[k] - 5 * 0.17 - 1e-9);
    EXPECT_GE(last, half[k] + 4 * 0.17 - 1e-9);
    EXPECT_LT(last, half[k] + 5 * 0.17 + 1e-9);
  }
}

TEST(DistanceGrid, ReachesFourCellsBeyondEveryPoint) {
  // A tetrahedron of which each point in turn is the last, and the outermost on some side.
  const std::array<Vector3, 4> corners = {Vector3(-1.3, 0.1, 0.0), Vector3(1.7, -0.2, 0.1),
                                          Vector3(0.2, 2.1, -0.9), Vector3(0.1, -1.2, 1.1)};
  IndexedMesh mesh;
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  for (std::size_t first = 0; first < 4; ++first) {
    mesh.points.clear();
    for (std::size_t k = 0; k < 4; ++k) mesh.points.push_back(corners[(first + k) % 4]);
    if (first % 2 == 1) std::swap(mesh.points[0], mesh.points[1]);  // or it is inside out
    const DistanceGrid grid = distance_grid(mesh, {0.4}, Execution(1));
    for (int k = 0; k < 3; ++k) {
      const double last =
          grid.origin[k] + 0.4 * static_cast<double>(grid.counts[static_cast<std::size_t>(k)] - 1);
      for (const Vector3& p : mesh.points) {
        EXPECT_LE(grid.origin[k], p[k] - 4 * 0.4 + 1e-9);
        EXPECT_GE(last, p[k] + 4 * 0.4 - 1e-9);
      }
    }
  }
}

// A torus is no star: rays and rows cross it several times.
TEST(DistanceGrid, SignIsThatOfEveryPointAlone) {
  const IndexedMesh torus = test::torus(1.0, 0.3, 48);
  const MeshDistance surface(torus);
  const DistanceGrid grid = distance_grid(torus, {0.06}, Execution(2));
  std::size_t inside = 0;
  for_each_point(grid, [&](const Vector3& p, double value) {
    EXPECT_EQ(value < 0.0, surface.contains(p)) << p.transpose();
    if (value < 0.0) ++inside;
  });
  EXPECT_GT(inside, 1000U);
}

TEST(DistanceGrid, SpacingFollowsTheSizeUnlessGiven) {
  const IndexedMesh sphere = test::sphere(4);
  EXPECT_NEAR(distance_grid(sphere, {}, Execution(2)).spacing, 2.0 / 50.0, 1e-3);
  EXPECT_EQ(distance_grid(sphere, {0.2}, Execution(2)).spacing, 0.2);
}

TEST(DistanceGrid, SameBytesOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::lumpy(3);
  EXPECT_EQ(distance_grid(mesh, {0.1}, Execution(1)).values,
            distance_grid(mesh, {0.1}, Execution(3)).values);
}

TEST(DistanceGrid, StopsWhenAskedTo) {
  // While the tree of 20,480 faces is made, and once a row of points.
  const IndexedMesh mesh = test::lumpy(5);
  GridOptions options;
  options.spacing = 0.25;
  const auto run = [&](const Execution& execution) { distance_grid(mesh, options, execution); };
  test::expect_to_be_stopped(run, "Measuring distances", 3);
  test::expect_to_be_stopped(run, "Measuring the grid of distances", 100);
}

TEST(DistanceGrid, NumPyFileHoldsEveryNumber) {
  const DistanceGrid grid = distance_grid(test::box(1, 2, 3), {0.4}, Execution(1));
  const std::string bytes = grid_npy(grid);
  ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\1\0", 8));
  const std::size_t header =
      static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + header) % 64, 0U);
  EXPECT_EQ(bytes[10 + header - 1], '\n');
  const std::string shape = "(" + std::to_string(grid.counts[0]) + ", " +
                            std::to_string(grid.counts[1]) + ", " + std::to_string(grid.counts[2]) +
                            ")";
  EXPECT_TRUE(holds(bytes.substr(10, header), "'descr': '<f8'"));
  EXPECT_TRUE(holds(bytes.substr(10, header), "'shape': " + shape));
  ASSERT_EQ(bytes.size(), 10 + header + 8 * grid.values.size());
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    EXPECT_EQ(number_at(bytes, 10 + header + 8 * i), grid.values[i]);
  }
}

TEST(DistanceGrid, ImageDataRunsAlongXFirst) {
  const DistanceGrid grid = distance_grid(test::box(1, 2, 3), {0.4}, Execution(1));
  const std::string bytes = grid_vti(grid);
  const auto nx = grid.counts[0];
  const auto ny = grid.counts[1];
  const auto nz = grid.counts[2];
  const auto extent = [&](const char* name) {
    return std::string(name) + "=\"0 " + std::to_string(nx - 1) + " 0 " + std::to_string(ny - 1) +
           " 0 " + std::to_string(nz - 1) + "\"";
  };
  EXPECT_TRUE(holds(bytes, extent("WholeExtent")));
  EXPECT_TRUE(holds(bytes, "<Piece " + extent("Extent")));
  EXPECT_TRUE(holds(bytes, "Origin=\"" + format_exact(grid.origin.x()) + " " +
                               format_exact(grid.origin.y()) + " " + format_exact(grid.origin.z()) +
                               "\""));
  const std::string step = format_exact(grid.spacing);
  EXPECT_TRUE(holds(bytes, "Spacing=\"" + step + " " + step + " " + step + "\""));
  const std::size_t begin = bytes.find("\n_") + 2;
  std::uint64_t length = 0;
  std::memcpy(&length, &bytes[begin], sizeof length);
  EXPECT_EQ(length, 8 * grid.values.size());
  EXPECT_EQ(number_at(bytes, begin + 8), grid.values[0]);
  EXPECT_EQ(number_at(bytes, begin + 8 + 8 * 1), grid.values[ny * nz]);
  EXPECT_EQ(number_at(bytes, begin + 8 + 8 * nx), grid.values[nz]);
  EXPECT_EQ(number_at(bytes, begin + 8 + 8 * nx * ny), grid.values[1]);
}

TEST(DistanceGrid, NetdemTableIsPositiveInside) {
  const DistanceGrid grid = distance_grid(test::box(1, 2, 3), {0.25}, Execution(1));
  const auto table = nlohmann::json::parse(grid_netdem(grid));
  EXPECT_EQ(table.at("dim"), nlohmann::json(grid.counts));
  EXPECT_EQ(table.at("spacing").get<double>(), 0.25);
  EXPECT_EQ(table.at("corner"),
            nlohmann::json({grid.origin.x(), grid.origin.y(), grid.origin.z()}));
  const auto& values = table.at("signed_distance_table");
  ASSERT_EQ(values.size(), grid.counts[0]);
  ASSERT_EQ(values[0].size(), grid.counts[1]);
  ASSERT_EQ(values[0][0].size(), grid.counts[2]);
  EXPECT_NEAR(values[grid.counts[0] / 2][grid.counts[1] / 2][grid.counts[2] / 2].get<double>(), 0.5,
              1e-12);
  EXPECT_LT(values[0][0][0].get<double>(), 0.0);
}

TEST(DistanceGrid, DefaultSpacingIsAFiftiethOrWhatTwentyMillionPointsTake) {
  // The box of a body that is nearly a cube has 50 to 60 cells a side.
  const double diameter = std::cbrt(6.0 * 2.0 * 2.1 * 2.3 / 3.14159265358979);
  const DistanceGrid usual = distance_grid(test::box(2.0, 2.1, 2.3), {}, Execution());
  EXPECT_NEAR(usual.spacing, diameter / 50.0, 1e-12);
  // A plate and a needle, of which a fiftieth would take 10^9 points.
  for (const Vector3& size :
       {Vector3(3e5, 2e5, 1.0), Vector3(1.0, 1.1, 2e7), Vector3(1e9, 1.0, 2.0)}) {
    const IndexedMesh body = test::box(size.x(), size.y(), size.z());
    const double fiftieth = std::cbrt(6.0 * size.prod() / 3.14159265358979) / 50.0;
    EXPECT_THROW(check_grid(body, {fiftieth}), Error);
    const double spacing = grid_spacing(body, {}, Execution());
    EXPECT_GT(spacing, fiftieth);
    EXPECT_NO_THROW(check_grid(body, {spacing}));
    // Not much more than is needed.
    EXPECT_THROW(check_grid(body, {0.9 * spacing}), Error);
  }
}

TEST(DistanceGrid, TheRefusalOfASpacingNamesTheOptionAndOneThatIsTaken) {
  const IndexedMesh box = test::box(1, 2, 3);
  try {
    check_grid(box, {0.005});
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
    const std::string sentence = error.what();
    EXPECT_TRUE(
        holds(sentence, "(--sdf-spacing) of 0.005 needs a grid of 52"));  // 209 x 409 x 609 points
    const std::size_t place = sentence.find(". Give ") + 7;
    const double advised = std::stod(sentence.substr(place));
    EXPECT_GT(advised, 0.005);
    EXPECT_NO_THROW(check_grid(box, {advised})) << sentence;
  }
  EXPECT_NO_THROW(check_grid(box, {}));
}

TEST(DistanceGrid, RefusesWhatHasNoInsideOrNoEnd) {
  EXPECT_ERROR(distance_grid(IndexedMesh(), {}, Execution(1)), InvalidInput);
  EXPECT_ERROR(distance_grid(test::box(1, 2, 3), {1e-4}, Execution(1)), InvalidInput);
  EXPECT_ERROR(distance_grid(test::box(1, 2, 3), {-0.1}, Execution(1)), InvalidInput);
  IndexedMesh inward = test::box(1, 2, 3);
  for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
  EXPECT_ERROR(distance_grid(inward, {}, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
