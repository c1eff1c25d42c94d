// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/test_shapes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/nodes/coarsening.h"
#include "wscvt/nodes/fit_state.h"

/// Bodies under way through a fit, and what every step of it has to leave in order.
namespace wscvt::test {

inline EditMesh editable(const IndexedMesh& mesh) {
  return EditMesh(mesh.points, mesh.triangles, Execution(1));
}

/// Nodes that are to be fitted to a scan, with samples placed; in the first round, of evenness 1.
inline FitState fit_state(const IndexedMesh& scan, EditMesh nodes, double ratio = 1.1,
                          int samples_a_node = 30) {
  const FitDial dial = fit_dial(ratio);
  double area = 0.0;
  for (const auto& [a, b, c] : scan.triangles) {
    area += 0.5 * doubled_area_normal(scan.points[a], scan.points[b], scan.points[c]).norm();
  }
  const std::size_t count = nodes.points.size();
  std::vector<FitSample> samples =
      draw_fit_samples(scan, {}, static_cast<std::size_t>(samples_a_node) * count,
                       area / static_cast<double>(count));
  std::vector<std::int32_t> near;
  for (const FitSample& sample : samples) {
    const auto nearest = std::min_element(
        nodes.points.begin(), nodes.points.end(), [&](const Vector3& p, const Vector3& q) {
          return (p - sample.point).squaredNorm() < (q - sample.point).squaredNorm();
        });
    near.push_back(static_cast<std::int32_t>(nearest - nodes.points.begin()));
  }
  FitState state(std::move(nodes), std::move(samples), near, dial, Execution(1));
  state.round.early_sharpness = std::cos(dial.early_angle * pi / 180.0);
  state.round.sharpness_limit = state.round.early_sharpness;
  state.round.goal_cosine = std::cos(31.0 * pi / 180.0);
  state.round.least_angle = dial.least_angle;
  state.round.valence = 0.01;
  state.list_samples();
  state.build_hash();
  return state;
}

/// The nodes that Ward's clusters of a body are.
inline EditMesh clusters(const IndexedMesh& body, int count) {
  Coarsening coarsening(editable(body), {});
  EXPECT_TRUE(coarsening.reduce(count, Execution(1)));
  return coarsening.mesh();
}

/// Mean square of the distances of all samples from where they are placed.
inline double mean_square(const FitState& state) {
  double sum = 0.0;
  for (const FitSample& sample : state.samples) sum += sample.place.squared_distance;
  return sum / static_cast<double>(state.samples.size());
}

/// What changes the mesh keeps the samples, their lists and the links in step.
inline void expect_in_step(const FitState& state) {
  const EditMesh& mesh = state.mesh;
  EXPECT_EQ(bad_edges({mesh.points, mesh.triangles}), 0u);
  std::vector<int> listed(state.samples.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector3 normals = Vector3::Zero();
    for (const std::int32_t s : state.of[t]) {
      ++listed[static_cast<std::size_t>(s)];
      const FitSample& sample = state.samples[static_cast<std::size_t>(s)];
      normals += sample.normal;
      ASSERT_EQ(sample.face, static_cast<std::int32_t>(t));
      const TrianglePlace place = nearest_in_triangle(sample.point, mesh, t);
      ASSERT_NEAR(sample.place.squared_distance, place.squared_distance, 1e-12);
      ASSERT_LT((sample.place.weights - place.weights).norm(), 1e-9);
    }
    ASSERT_LT((state.sample_normals[t] - normals).norm(), 1e-9);
  }
  EXPECT_EQ(std::count(listed.begin(), listed.end(), 1),
            static_cast<std::ptrdiff_t>(listed.size()));
  std::vector<std::int32_t> degrees(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) ++degrees[static_cast<std::size_t>(v)];
  }
  EXPECT_EQ(degrees, mesh.degrees);
  for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
    const auto half_edge = static_cast<std::int32_t>(h);
    ASSERT_EQ(mesh.opposite[static_cast<std::size_t>(mesh.opposite[h])], half_edge);
    ASSERT_EQ(mesh.origin(half_edge), mesh.target(mesh.opposite[h]));
  }
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    ASSERT_EQ(mesh.origin(mesh.first[v]), static_cast<std::int32_t>(v));
  }
}

inline double smallest_angle(const EditMesh& mesh) {
  double sharpest = -1.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sharpest = std::max(sharpest, mesh.sharpness(t));
  }
  return std::acos(std::min(sharpest, 1.0)) * 180.0 / pi;
}

}  // namespace wscvt::test
