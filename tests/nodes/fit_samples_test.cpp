// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/fit_bodies.h"
#include "wscvt/measures/mesh_distance.h"
#include "wscvt/nodes/fit_state.h"

namespace wscvt {
namespace {

/// Area of a mesh's faces from `begin` to `end`.
double area_of_faces(const IndexedMesh& mesh, std::size_t begin, std::size_t end) {
  double area = 0.0;
  for (std::size_t t = begin; t < end; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    area += 0.5 * doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c]).norm();
  }
  return area;
}

TEST(FitSamples, LieOnTheScanOneInEachShareOfItsArea) {
  const IndexedMesh body = test::scaled(test::lumpy(3), Vector3(2.0, 1.0, 0.7));
  constexpr std::size_t count = 3000;
  const std::vector<FitSample> samples = draw_fit_samples(body, {}, count, 1e9);
  ASSERT_EQ(samples.size(), count);
  const MeshDistance boxes(body, Execution(1), "boxes");
  const double area = area_of_faces(body, 0, body.triangles.size());
  std::size_t face = 0;
  double up_to = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const FitSample& sample = samples[i];
    ASSERT_LT(boxes.distance(sample.point), 1e-12);
    ASSERT_NEAR(sample.normal.norm(), 1.0, 1e-12);
    ASSERT_EQ(sample.spacing, 1.0);
    // The share [i, i + 1) of the area is that of a face or some, one of which holds the sample.
    const double share = area / static_cast<double>(count);
    while (face + 1 < body.triangles.size() &&
           up_to + area_of_faces(body, face, face + 1) < static_cast<double>(i) * share) {
      up_to += area_of_faces(body, face, face + 1);
      ++face;
    }
    double nearest = 1e300;
    double reached = up_to;
    for (std::size_t t = face; t < body.triangles.size() && nearest > 1e-20; ++t) {
      if (reached > static_cast<double>(i + 1) * share) break;
      const auto& [a, b, c] = body.triangles[t];
      nearest = std::min(nearest, MeasuredTriangle(body.points[a], body.points[b], body.points[c])
                                      .nearest(sample.point)
                                      .squared_distance);
      reached += area_of_faces(body, t, t + 1);
    }
    ASSERT_LT(nearest, 1e-20) << i;
  }
}

TEST(FitSamples, NameTheCornerThatIsNearestInTheirFace) {
  const IndexedMesh ball = test::sphere(2);
  for (const FitSample& sample : draw_fit_samples(ball, {}, 2000, 1e9)) {
    double nearest = 1e300;
    for (const Vector3& p : ball.points) nearest = std::min(nearest, (p - sample.point).norm());
    // Faces are nearly equilateral, where the largest weight is about that of the nearest corner.
    ASSERT_LT((ball.points[static_cast<std::size_t>(sample.face)] - sample.point).norm(),
              1.3 * nearest);
  }
}

TEST(FitSamples, HaveNormalsOfVerticesOnFineFacesAndTheirOwnOnCoarseOnes) {
  const IndexedMesh ball = test::sphere(2);
  const double face = area_of_faces(ball, 0, ball.triangles.size()) / 320.0;
  double fine = 0.0;
  double coarse = 0.0;
  for (const FitSample& sample : draw_fit_samples(ball, {}, 1000, 100.0 * face)) {
    fine = std::max(fine, (sample.normal - sample.point.normalized()).norm());
  }
  const MeshDistance boxes(ball, Execution(1), "boxes");
  for (const FitSample& sample : draw_fit_samples(ball, {}, 1000, 0.5 * face)) {
    coarse = std::max(coarse, (sample.normal - sample.point.normalized()).norm());
    // Flat over its face: a small step along the face stays on it.
    const Vector3 aside = 1e-3 * sample.normal.unitOrthogonal();
    EXPECT_LT(boxes.distance(sample.point + aside), 1e-3);
  }
  // The chord's sagitta: faces of .28 turn their normals by a tenth from corner to middle.
  EXPECT_LT(fine, 0.03);
  EXPECT_GT(coarse, 0.1);
}

TEST(FitSamples, AreSpreadEvenlyOverAFace) {
  const IndexedMesh body = test::scaled(test::tetrahedron(1.0), Vector3(1.0, 2.0, 0.6));
  std::vector<Vector3> sums(4, Vector3::Zero());
  std::vector<int> counts(4, 0);
  for (const FitSample& sample : draw_fit_samples(body, {}, 4000, 1e9)) {
    for (std::size_t t = 0; t < 4; ++t) {
      const auto& [a, b, c] = body.triangles[t];
      const TrianglePlace place =
          MeasuredTriangle(body.points[a], body.points[b], body.points[c]).nearest(sample.point);
      if (place.squared_distance > 1e-20) continue;
      sums[t] += place.weights;
      ++counts[t];
    }
  }
  for (std::size_t t = 0; t < 4; ++t) {
    EXPECT_GT(counts[t], 300);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sums[t][k] / counts[t], 1.0 / 3.0, 0.01);
  }
}

TEST(FitSamples, HaveTheNormalsOfTheScansVertices) {
  const IndexedMesh body = test::lumpy(4);
  const std::vector<Vector3> normals = vertex_normals(body.points, body.triangles);
  const std::vector<FitSample> few = draw_fit_samples(body, {}, 100, 1e9);
  const std::vector<FitSample> same = draw_fit_samples(body, normals, 100, 1e9);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].normal, same[i].normal);
    EXPECT_EQ(few[i].point, same[i].point);
  }
}

TEST(FitSamples, LeaveOutFacesOfNoArea) {
  IndexedMesh ball = test::sphere(1);
  const std::size_t sound = ball.triangles.size();
  ball.triangles.insert(ball.triangles.begin(),
                        {ball.triangles[3][0], ball.triangles[3][0], ball.triangles[3][1]});
  ball.triangles.push_back({ball.triangles[7][0], ball.triangles[7][1], ball.triangles[7][1]});
  for (const FitSample& sample : draw_fit_samples(ball, {}, 5 * sound, 1.0)) {
    ASSERT_TRUE(sample.point.allFinite());
    ASSERT_NEAR(sample.normal.norm(), 1.0, 1e-12);
  }
}

TEST(FitSamples, ComeBackOverTheRimFromTheSheetBehind) {
  const IndexedMesh lens = test::scaled(test::sphere(3), Vector3(1.0, 1.0, 0.05));
  FitState state = test::fit_state(lens, test::editable(lens));
  EditMesh& mesh = state.mesh;
  // The upper sheet rises to six times its height, so that the lower one is nearer.
  for (Vector3& p : mesh.points) p.z() *= p.z() > 0.0 ? 6.0 : 1.0;
  const auto faces_up = [&](std::size_t t) { return state.unit_normal(t).z() > 0.0; };
  int moved = 0;
  for (std::size_t h = 0; h < mesh.opposite.size(); ++h) {
    const std::size_t above = face_of(mesh.opposite[h]);
    if (faces_up(face_of(static_cast<std::int32_t>(h))) || !faces_up(above)) continue;
    for (const std::int32_t s : state.of[above]) {
      FitSample& sample = state.samples[static_cast<std::size_t>(s)];
      sample.face = static_cast<std::int32_t>(face_of(static_cast<std::int32_t>(h)));
      ++moved;
    }
  }
  ASSERT_GT(moved, 100);
  state.place_samples(Execution(1));
  test::expect_in_step(state);
  for (const FitSample& sample : state.samples) {
    const Vector3 normal = state.unit_normal(static_cast<std::size_t>(sample.face));
    ASSERT_GE(normal.dot(sample.normal), 0.0);
  }
}

}  // namespace
}  // namespace wscvt
