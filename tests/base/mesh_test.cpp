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
