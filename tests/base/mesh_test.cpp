// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/mesh.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"

namespace wscvt {
namespace {

TEST(Mesh, ComesBackFromHalfEdgesAsItWas) {
  for (const IndexedMesh& mesh : {test::lumpy(3), test::torus(3, 1, 10), test::tetrahedron(1)}) {
    const Mesh half_edges = to_mesh(mesh);
    EXPECT_EQ(half_edges.n_vertices(), mesh.points.size());
    EXPECT_EQ(half_edges.n_faces(), mesh.triangles.size());
    EXPECT_EQ(half_edges.n_edges(), 3 * mesh.triangles.size() / 2);
    const IndexedMesh back = to_indexed(half_edges);
    EXPECT_EQ(back.points, mesh.points);
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      Triangle t = back.triangles[f];
      while (t[0] != mesh.triangles[f][0]) std::rotate(t.begin(), t.begin() + 1, t.end());
      EXPECT_EQ(t, mesh.triangles[f]);
    }
  }
}

TEST(Mesh, OfNothingIsEmpty) {
  EXPECT_EQ(to_mesh({}).n_vertices(), 0U);
  EXPECT_TRUE(to_indexed(Mesh()).points.empty());
}

TEST(Mesh, AttributesAreProperties) {
  const IndexedMesh flat = test::tetrahedron(1);
  MeshAttributes attributes;
  attributes.of_vertices = {{"red", ScalarType::Uint8, {1, 2, 3, 4}},
                            {"green", ScalarType::Uint8, {5, 6, 7, 8}},
                            {"blue", ScalarType::Uint8, {9, 10, 11, 255}},
                            {"quality", ScalarType::Float64, {0.25, 1e9, -3, 4}},
                            {"single", ScalarType::Float32, {0.5, 1, 2, 3}}};
  attributes.of_faces = {{"label", ScalarType::Int32, {-4, 3, 2, 1}}};
  Mesh mesh = to_mesh(flat, attributes);
  EXPECT_EQ(mesh.color(Mesh::VertexHandle(3)), Mesh::Color(4, 8, 255));
  const auto expect_same = [](const std::vector<MeshAttribute>& one,
                              const std::vector<MeshAttribute>& two) {
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].name, two[k].name);
      EXPECT_EQ(one[k].type, two[k].type);
      EXPECT_EQ(one[k].values, two[k].values);
    }
  };
  expect_same(attributes_of(mesh).of_vertices, attributes.of_vertices);
  expect_same(attributes_of(mesh).of_faces, attributes.of_faces);
  attributes.of_faces[0].values.pop_back();
  EXPECT_ERROR(to_mesh(flat, attributes), InvalidInput);

  attributes.of_faces[0].values = {6.9999, 1, 2, 3};
  attributes.of_vertices[0].values[1] = 199.9999;
  EXPECT_EQ(to_mesh(flat, attributes).color(Mesh::VertexHandle(1))[0], 200);
  EXPECT_EQ(attributes_of(to_mesh(flat, attributes)).of_faces[0].values[0], 7.0);

  // Without a deleted vertex, which all faces but one have, the others get new numbers.
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  mesh.delete_vertex(Mesh::VertexHandle(0), false);
  const IndexedMesh left = to_indexed(mesh);
  ASSERT_EQ(left.points.size(), 3U);
  ASSERT_EQ(left.triangles.size(), 1U);
  for (const std::int32_t v : left.triangles[0]) EXPECT_LT(v, 3);
  EXPECT_EQ(attributes_of(mesh).of_vertices[3].values, (std::vector<double>{1e9, -3, 4}));
  EXPECT_EQ(attributes_of(mesh).of_faces[0].values.size(), 1U);
}

TEST(Mesh, RefusesFacesThatDoNotFit) {
  IndexedMesh out_of_range = test::tetrahedron(1);
  out_of_range.triangles[2][0] = 4;
  EXPECT_ERROR(to_mesh(out_of_range), InvalidInput);
  out_of_range.triangles[2][0] = -1;
  EXPECT_ERROR(to_mesh(out_of_range), InvalidInput);
  IndexedMesh twisted = test::tetrahedron(1);
  std::swap(twisted.triangles[0][0], twisted.triangles[0][1]);
  EXPECT_ERROR(to_mesh(twisted), InvalidInput);
}

}  // namespace
}  // namespace wscvt
