// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/turning_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/coded_bytes.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

template <class Whole>
std::vector<Whole> numbers(const nlohmann::json& text) {
  const std::string bytes = test::decoded(text.get<std::string>());
  std::vector<Whole> values;
  for (std::size_t at = 0; at + sizeof(Whole) <= bytes.size(); at += sizeof(Whole)) {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < sizeof(Whole); ++k) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
    }
    values.push_back(static_cast<Whole>(value));
  }
  return values;
}

nlohmann::json data_of(const std::string& html) {
  const std::string begin = "id=\"views\">";
  const std::size_t from = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

/// An egg without symmetry, far from the origin.
IndexedMesh egg(int times) {
  IndexedMesh mesh = test::sphere(times);
  for (Vector3& p : mesh.points) {
    p = Vector3(12.0 + 2.0 * p.x() + 0.3 * p.y() * p.z(), -7.0 + p.y(),
                3.0 + (1.3 + 0.2 * p.x()) * p.z());
  }
  return mesh;
}

TEST(TurningView, HasTheMeshTheDistancesAndTheViewOfThePictures) {
  const IndexedMesh mesh = egg(3);
  const MeshView view = view_of({&mesh}, 100);
  double radius = 0.0;
  for (const Vector3& p : mesh.points) radius = std::max(radius, (p - view.centre).norm());
  std::vector<Vector3> asked;
  const auto heights = [&](const std::vector<Vector3>& points) {
    asked = points;
    std::vector<double> values;
    for (const Vector3& p : points) values.push_back(p.z() - 3.0);
    return values;
  };
  const nlohmann::json data =
      data_of(turning_views({{mesh, true, {}, 0.0}, {mesh, false, heights, 0.5}}, view));
  const Vector3 axes[3] = {view.right, view.up, view.right.cross(view.up)};
  for (int k = 0; k < 3; ++k) {
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(data["turn"][3 * k + row].get<double>(), axes[row][k], 1e-5);
    }
  }
  ASSERT_EQ(data["views"].size(), 2U);
  ASSERT_EQ(data["meshes"].size(), 1U);
  for (std::size_t which = 0; which < 2; ++which) {
    const nlohmann::json& one = data["views"][which];
    EXPECT_EQ(one["place"], which);
    EXPECT_EQ(one["mesh"], 0);  // written once
    const nlohmann::json& shape = data["meshes"].at(0);
    const auto points = numbers<std::int16_t>(shape["points"]);
    const auto faces = numbers<std::uint32_t>(shape["faces"]);
    ASSERT_EQ(points.size(), 3 * mesh.points.size());
    ASSERT_EQ(faces.size(), 3 * mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      for (int k = 0; k < 3; ++k) {
        // Half a step of 16 bits.
        EXPECT_NEAR(radius * points[3 * v + k] / 32767.0, (mesh.points[v] - view.centre)[k],
                    radius / 65000.0);
      }
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(faces[3 * f + k], static_cast<std::uint32_t>(mesh.triangles[f][k]));
      }
    }
  }
  EXPECT_TRUE(data["views"][0]["edges"].get<bool>());
  EXPECT_FALSE(data["views"][1].contains("edges"));
  EXPECT_FALSE(data["views"][0].contains("distances"));

  const int parts = data["views"][1]["parts"];
  const auto each = static_cast<std::size_t>((parts + 1) * (parts + 2) / 2);
  EXPECT_GT(parts, 1);
  const auto distances = numbers<std::int8_t>(data["views"][1]["distances"]);
  ASSERT_EQ(distances.size(), each * mesh.triangles.size());
  ASSERT_EQ(asked.size(), distances.size());
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const double share = std::clamp((asked[k].z() - 3.0) / 0.5, -1.0, 1.0);
    EXPECT_NEAR(distances[k] / 127.0, share, 0.51 / 127.0);
  }
  // The three corners are where turning_view.js puts them: first, after the first row, last.
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const std::size_t first = f * each;
    const std::size_t places[3] = {first, first + static_cast<std::size_t>(parts),
                                   first + each - 1};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((asked[places[k]] - mesh.points[mesh.triangles[f][k]]).norm(), 1e-12);
    }
  }
}

TEST(TurningView, DrawsALargeMeshCoarserAndKeepsThePageSmall) {
  const IndexedMesh mesh = egg(7);
  ASSERT_GT(mesh.points.size(), 160000U);
  const MeshView view = view_of({&mesh}, 100);
  const std::string html = turning_views({{mesh, true, {}, 0.0}}, view);
  const nlohmann::json data = data_of(html);
  const nlohmann::json& one = data["views"][0];
  const auto points = numbers<std::int16_t>(data["meshes"][0]["points"]);
  const auto faces = numbers<std::uint32_t>(data["meshes"][0]["faces"]);
  EXPECT_GT(points.size() / 3, 30000U);
  EXPECT_LT(points.size() / 3, 90000U);
  EXPECT_FALSE(one.contains("edges"));
  EXPECT_LT(*std::max_element(faces.begin(), faces.end()), points.size() / 3);
  EXPECT_LT(html.size(), 4000000U);
  // Still the egg: each corner is near its ellipsoid-like surface, seen from the centre.
  double farthest = 0.0;
  for (std::size_t v = 0; v < points.size(); v += 3) {
    farthest = std::max(farthest, std::hypot(points[v], points[v + 1], points[v + 2]) / 32767.0);
  }
  EXPECT_NEAR(farthest, 1.0, 0.02);
}

}  // namespace
}  // namespace wscvt
