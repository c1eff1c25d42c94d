// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/distances.h"
#include "wscvt/nodes/scan_nodes.h"
#include "wscvt/surface/edit_mesh.h"

namespace wscvt {
namespace {

/// A flake without symmetry: sharp rim, uneven outline, bent, thickest off its middle. `thin`:
/// half its thickness over its radius.
IndexedMesh flake(double thin, double bend, int rows = 90) {
  constexpr int around = 240;
  IndexedMesh mesh;
  mesh.points.emplace_back(0.0, 0.0, -thin);
  for (int j = 1; j < rows; ++j) {
    const double w = pi * (static_cast<double>(j) / rows - 0.5);
    for (int i = 0; i < around; ++i) {
      const double a = 2.0 * pi * i / around;
      const double out = 1.0 + 0.12 * std::cos(2.0 * a + 0.3) + 0.07 * std::cos(3.0 * a + 1.0) +
                         0.04 * std::cos(5.0 * a + 2.0);
      const double r = out * std::pow(std::cos(w), 0.8);
      mesh.points.emplace_back(r * std::cos(a), r * std::sin(a),
                               thin * std::copysign(std::pow(std::abs(std::sin(w)), 0.8), w));
    }
  }
  mesh.points.emplace_back(0.0, 0.0, thin);
  const auto top = static_cast<std::int32_t>(mesh.points.size() - 1);
  const auto at = [&](int row, int i) { return 1 + (row - 1) * around + i % around; };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i + 1), at(1, i)});
    for (int j = 1; j + 1 < rows; ++j) {
      mesh.triangles.push_back({at(j, i), at(j, i + 1), at(j + 1, i + 1)});
      mesh.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j + 1, i)});
    }
    mesh.triangles.push_back({top, at(rows - 1, i), at(rows - 1, i + 1)});
  }
  for (Vector3& p : mesh.points) {
    p.z() *= 1.0 + 0.4 * p.x() + 0.2 * std::sin(2.0 * p.y() + 1.0);
    p.z() += bend * (p.x() * p.x() - 0.4 * p.x() * p.y() + 0.3 * std::pow(p.y(), 3.0));
  }
  return mesh;
}

/// Scales a body to an equivalent radius of 1.
IndexedMesh of_radius_one(IndexedMesh body) {
  const double radius = equivalent_radius(volume_of(body, Execution(1)));
  for (Vector3& p : body.points) p /= radius;
  return body;
}

/// What is seen of a rim: edges whose faces turn by more than 90 degrees.
struct Rim {
  int edges = 0;
  int ends = 0;     ///< nodes at which the rim ends or branches
  int slits = 0;    ///< nodes whose two neighbours on the rim are within .6 mean edges
  int notches = 0;  ///< nodes at which it turns by more than 75 degrees
};

Rim rim_of(const IndexedMesh& mesh) {
  const EditMesh links(mesh.points, mesh.triangles, Execution(1));
  const double edge = mean_edge_length(links);
  std::vector<std::vector<std::int32_t>> along(mesh.points.size());
  Rim rim;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(links.opposite.size()); ++h) {
    if (links.opposite[h] < h) continue;
    const Vector3 one = links.normal(face_of(h)).normalized();
    const Vector3 other = links.normal(face_of(links.opposite[h])).normalized();
    if (one.dot(other) >= 0.0) continue;
    ++rim.edges;
    along[links.origin(h)].push_back(links.target(h));
    along[links.target(h)].push_back(links.origin(h));
  }
  for (std::size_t v = 0; v < along.size(); ++v) {
    if (along[v].size() == 1 || along[v].size() > 2) ++rim.ends;
    if (along[v].size() != 2) continue;
    const Vector3 a = mesh.points[along[v][0]] - mesh.points[v];
    const Vector3 b = mesh.points[along[v][1]] - mesh.points[v];
    if ((a - b).norm() < 0.6 * edge) {
      ++rim.slits;
    } else if (-a.normalized().dot(b.normalized()) < std::cos(75.0 * pi / 180.0)) {
      ++rim.notches;
    }
  }
  return rim;
}

double two_sided(const IndexedMesh& a, const IndexedMesh& b) {
  return measure_distances(a, b, 20000, Execution(1)).root_mean_square;
}

/// A washer without symmetry: flat sheets, straight walls, uneven outlines, a hole off its middle.
IndexedMesh washer(double thickness) {
  constexpr int around = 200;
  constexpr int sheet = 16;  // rows
  constexpr int wall = 6;
  constexpr int rows = 2 * (sheet + wall);
  IndexedMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double a = 2.0 * pi * i / around;
    const double outer = 1.0 + 0.05 * std::cos(2.0 * a + 0.3) + 0.03 * std::cos(3.0 * a + 1.0);
    const double inner = 0.5 + 0.04 * std::cos(a) + 0.02 * std::cos(2.0 * a + 2.0);
    for (int j = 0; j < rows; ++j) {
      // Along the lower sheet outwards, up the outer wall, back along the upper sheet.
      const double in = static_cast<double>(j % (sheet + wall));
      const double along = std::min(in / sheet, 1.0);
      const double up = std::max(0.0, (in - sheet) / wall);
      const bool back = j >= sheet + wall;
      const double r = back ? outer + along * (inner - outer) : inner + along * (outer - inner);
      const double z = thickness * (back ? 0.5 - up : up - 0.5);
      mesh.points.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  }
  const auto at = [&](int i, int j) { return i % around * rows + j % rows; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < rows; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  if (volume_of(mesh, Execution(1)) < 0.0) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

/// A plate of 30:1 whose sheets bend to a blunt rim: a superellipsoid of exponent 4.
IndexedMesh blunt_plate() {
  IndexedMesh mesh = test::sphere(5);
  for (Vector3& p : mesh.points) {
    const double flat = (p.x() * p.x() + p.y() * p.y()) / (15.0 * 15.0);
    const double up = p.z() / 0.5;
    p *= std::pow(flat * flat + up * up * up * up, -0.25);
  }
  return mesh;
}

TEST(Rims, OfABluntPlateGainBySmallTriangles) {
  // If samples pull along the mean of their own normal and the triangle's, rows leave the rim, and
  // the closer mesh is farther from the plate: .7 % instead of .6.
  const IndexedMesh body = of_radius_one(blunt_plate());
  ScanNodesOptions close;
  close.edge_ratio = 1.4;
  const ScanNodes even = ScanRemesher(body, {}, 1000, Execution(1)).place(1000, Execution(1));
  const ScanNodes nodes = ScanRemesher(body, close, 1000, Execution(1)).place(1000, Execution(1));
  EXPECT_EQ(nodes.report.self_intersections, 0u);
  EXPECT_LT(two_sided(nodes.mesh, body), 0.8 * two_sided(even.mesh, body));
  EXPECT_LT(two_sided(nodes.mesh, body), 0.0045);
}

TEST(Rims, OfThinFlakesAreOneRowWithoutSlitsAndNotches) {
  for (const auto& [thin, bend] : {std::pair(0.015, 0.0), std::pair(0.03, 0.1)}) {
    SCOPED_TRACE(thin);
    const IndexedMesh body = of_radius_one(flake(thin, bend));
    for (const int count : {500, 1000}) {
      SCOPED_TRACE(count);
      const ScanNodes nodes =
          ScanRemesher(body, {}, count, Execution(1)).place(count, Execution(1));
      EXPECT_EQ(nodes.report.self_intersections, 0u);
      const Rim rim = rim_of(nodes.mesh);
      EXPECT_GT(rim.edges, 40);
      EXPECT_LE(rim.ends, 2);
      EXPECT_EQ(rim.slits, 0);
      EXPECT_LE(rim.notches, 1);
      // Saws of teeth on the same bodies are 1 to 3 % off.
      EXPECT_LT(two_sided(nodes.mesh, body), count == 500 ? 0.01 : 0.005);
    }
  }
}

TEST(Rims, RidgesOfAWasherKeepTheirRows) {
  // Stiff springs, at any price for even edges, tear the rows from the ridges and leave chamfers:
  // .3 to .4 %.
  for (const double thickness : {0.15, 0.25}) {
    SCOPED_TRACE(thickness);
    const IndexedMesh body = of_radius_one(washer(thickness));
    const ScanNodes nodes = ScanRemesher(body, {}, 1000, Execution(1)).place(1000, Execution(1));
    EXPECT_EQ(nodes.report.self_intersections, 0u);
    EXPECT_EQ(nodes.report.genus, 1u);
    EXPECT_LT(two_sided(nodes.mesh, body), 0.0025);
  }
}

}  // namespace
}  // namespace wscvt
