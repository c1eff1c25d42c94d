// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/tetrahedra_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/file_folder.h"
#include "support/holds.h"
#include "support/msh_volumes.h"

namespace wscvt {
namespace {

class TetrahedraFiles : public test::FileFolder {};

/// Bodies 7 and 4 with a common wall, of one tetrahedron and of two.
TetrahedralMesh two_bodies() {
  TetrahedralMesh mesh;
  mesh.surface.points = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0.5, 0.5, 1.5}, {1, 1, -2}, {4, 3, -1}};
  for (Vector3& p : mesh.surface.points) p += Vector3(1.0, -2.0, 5.0);
  mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}, {1, 2, 5, 4}};
  mesh.bodies = {0, 1, 1};
  mesh.names = {"7", "4"};
  // Outward of the first side.
  mesh.surface.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 1},
                            {0, 2, 4}, {1, 4, 5}, {2, 5, 4}, {1, 5, 2}};
  mesh.sides = {{0, 1}, {0, -1}, {0, -1}, {0, -1}, {1, -1}, {1, -1}, {1, -1}, {1, -1}, {1, -1}};
  return mesh;
}

TEST_F(TetrahedraFiles, SurfacesOfGmshBoundTheTetrahedraOfEachBody) {
  const TetrahedralMesh mesh = two_bodies();
  std::vector<double> volumes(2, 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto point = [&](std::size_t corner) {
      return mesh.surface.points[static_cast<std::size_t>(mesh.tetrahedra[k][corner])];
    };
    const Vector3 o = point(0);
    volumes[static_cast<std::size_t>(mesh.bodies[k])] +=
        std::abs((point(1) - o).dot((point(2) - o).cross(point(3) - o))) / 6.0;
  }
  write_tetrahedra(path("two.msh"), mesh);
  const std::vector<test::MshVolume> read = test::msh_volumes(content("two.msh"));
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t body = 0; body < 2; ++body) {
    EXPECT_NEAR(read[body].filled, volumes[body], 1e-12) << body;
    EXPECT_NEAR(read[body].bounded, volumes[body], 1e-12) << body;
  }
}

TEST_F(TetrahedraFiles, CellsOfVtkHaveTheNumberOfTheirBody) {
  TetrahedralMesh mesh = two_bodies();
  write_tetrahedra(path("two.vtu"), mesh);
  const std::string vtu = content("two.vtu");
  const std::string data = vtu.substr(vtu.find("<CellData>"));
  EXPECT_TRUE(test::holds(data.substr(0, data.find("</CellData>")), "\n7\n4\n4\n"));
  mesh.names = {"a", "4"};
  write_tetrahedra(path("two.vtu"), mesh);
  EXPECT_FALSE(test::holds(content("two.vtu"), "<CellData>")) << "a name that is no number";
}

}  // namespace
}  // namespace wscvt
