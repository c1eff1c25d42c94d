// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/tetrahedra/tetrahedra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "toolbox/exchange/tetrahedra_files.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

using test::holds;

class Tetrahedra : public test::FileFolder {
 protected:
  void SetUp() override {
    try {
      require_tetrahedra();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    FileFolder::SetUp();
  }
};

double volume(const TetrahedralMesh& mesh, const Tetrahedron& t) {
  const std::vector<Vector3>& p = mesh.surface.points;
  return six_volumes(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]], p[t[3]] - p[t[0]]) / 6.0;
}

/// Fails unless the tetrahedra fill the surface, which is as it was.
void expect_filled(const IndexedMesh& surface, const TetrahedralMesh& mesh) {
  ASSERT_GE(mesh.surface.points.size(), surface.points.size());
  EXPECT_EQ(mesh.surface.triangles, surface.triangles);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    EXPECT_EQ(mesh.surface.points[i], surface.points[i]) << "to the bit";
  }
  const double whole = volume_of(surface, Execution(1));
  double sum = 0.0;
  std::multiset<std::set<std::int32_t>> faces;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    EXPECT_GT(volume(mesh, t), 0.0);
    sum += volume(mesh, t);
    for (std::size_t k = 0; k < 4; ++k) {
      std::set<std::int32_t> face(t.begin(), t.end());
      face.erase(t[k]);
      faces.insert(face);
    }
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-10);
  std::size_t open = 0;
  for (const auto& face : faces) open += faces.count(face) == 1 ? 1U : 0U;
  EXPECT_EQ(open, surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles) EXPECT_EQ(faces.count({a, b, c}), 1U);
}

TEST_F(Tetrahedra, FillASurfaceAndKeepIt) {
  const IndexedMesh grain = test::moved(test::lumpy(3), 1.0, Vector3(700.0, -20.0, 3.0));
  const TetrahedralMesh mesh = tetrahedra_in(grain, 0.0, Execution(1));
  expect_filled(grain, mesh);
  EXPECT_GT(mesh.smallest_dihedral, 10.0);
  EXPECT_LT(mesh.largest_dihedral, 170.0);
}

TEST_F(Tetrahedra, OfRemeshesHaveNoFlatOnes) {
  for (const char* name : {"sand_5658.ply", "angular_6000.ply", "elongated_rough_8000.ply"}) {
    SCOPED_TRACE(name);
    RemeshOptions options;
    options.node_count = 300;
    const IndexedMesh grain =
        remesh(read_mesh(std::string(WSCVT_MESHES_DIR) + "/" + name), options, Execution(1)).mesh;
    const TetrahedralMesh mesh = tetrahedra_in(grain, 0.0, Execution(1));
    expect_filled(grain, mesh);
    // The study has the angles of a hundred remeshes.
    EXPECT_GT(mesh.smallest_dihedral, 12.0);
  }
}

// A node moves along an edge until .3 of it are left. With a single fill 6 of the 16 bodies have an
// angle below 12 degrees, the smallest 2.8; with further ones none.
TEST_F(Tetrahedra, BesideShortEdgesAreSeldomFlat) {
  int flat = 0;
  for (std::size_t t = 0; t < 320; t += 20) {
    SCOPED_TRACE(t);
    IndexedMesh grain = test::lumpy(2);
    const auto& [a, b, c] = grain.triangles[t];
    grain.points[a] += 0.7 * (grain.points[b] - grain.points[a]);
    const TetrahedralMesh mesh = tetrahedra_in(grain, 0.0, Execution(1));
    expect_filled(grain, mesh);
    flat += mesh.smallest_dihedral < least_dihedral ? 1 : 0;
  }
  EXPECT_LE(flat, 1) << "another version of Gmsh may leave one";
}

TEST_F(Tetrahedra, FollowTheWantedEdgeInAnyUnit) {
  const IndexedMesh ball = test::sphere(2);
  const TetrahedralMesh usual = tetrahedra_in(ball, 0.0, Execution(1));
  const TetrahedralMesh fine = tetrahedra_in(ball, 0.12, Execution(1));
  EXPECT_GT(fine.tetrahedra.size(), 3 * usual.tetrahedra.size());
  expect_filled(ball, fine);
  const IndexedMesh tiny = test::moved(ball, 1e-5, Vector3(0.0, 0.0, 0.0));
  const TetrahedralMesh small = tetrahedra_in(tiny, 0.12e-5, Execution(1));
  expect_filled(tiny, small);
  // Rounding of the unit may turn a tie; the number is the same but for that.
  EXPECT_NEAR(
      static_cast<double>(small.tetrahedra.size()) / static_cast<double>(fine.tetrahedra.size()),
      1.0, 0.02);
  EXPECT_NEAR(small.mean_edge / fine.mean_edge, 1e-5, 1e-7);
}

/// Smallest and largest dihedral angle of the tetrahedra of a body, in degrees; all bodies if it is
/// negative. Between the planes through an edge and each of the two other corners.
std::array<double, 2> dihedral_angles(const TetrahedralMesh& mesh, int body = -1) {
  const std::vector<Vector3>& p = mesh.surface.points;
  std::array<double, 2> found = {180.0, 0.0};
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k) {
    if (body >= 0 && mesh.bodies[k] != body) continue;
    std::array<int, 4> order = {0, 1, 2, 3};
    do {
      const auto corner = [&](std::size_t i) { return p[mesh.tetrahedra[k][order[i]]]; };
      const Vector3 edge = (corner(1) - corner(0)).normalized();
      const auto across = [&](std::size_t i) {
        const Vector3 to = corner(i) - corner(0);
        return Vector3(to - to.dot(edge) * edge).normalized();
      };
      const double angle = std::acos(std::clamp(across(2).dot(across(3)), -1.0, 1.0)) * 180.0 / pi;
      found = {std::min(found[0], angle), std::max(found[1], angle)};
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return found;
}

double mean_length(const std::set<std::set<std::int32_t>>& edges, const std::vector<Vector3>& p) {
  double sum = 0.0;
  for (const auto& edge : edges) sum += (p[*edge.begin()] - p[*edge.rbegin()]).norm();
  return sum / static_cast<double>(edges.size());
}

TEST_F(Tetrahedra, AreMeasuredAsByHand) {
  for (const IndexedMesh& grain : {test::lumpy(1), test::lumpy(2), test::sphere(1)}) {
    const TetrahedralMesh mesh = tetrahedra_in(grain, 0.0, Execution(1));
    std::set<std::set<std::int32_t>> edges;
    std::set<std::set<std::int32_t>> outer;
    for (const Tetrahedron& t : mesh.tetrahedra) {
      for (const std::int32_t a : t) {
        for (const std::int32_t b : t) {
          if (a != b) edges.insert({a, b});
        }
      }
    }
    for (const auto& [a, b, c] : grain.triangles) outer.insert({{a, b}, {b, c}, {c, a}});
    const auto [smallest, largest] = dihedral_angles(mesh);
    EXPECT_NEAR(mesh.smallest_dihedral, smallest, 1e-6);
    EXPECT_NEAR(mesh.largest_dihedral, largest, 1e-6);
    EXPECT_NEAR(mesh.mean_edge, mean_length(edges, mesh.surface.points), 1e-12);
    EXPECT_EQ(tetrahedra_line(mesh), "Tetrahedra: " + std::to_string(mesh.tetrahedra.size()) +
                                         " of " + std::to_string(mesh.surface.points.size()) +
                                         " points, dihedral angles " + format_number(smallest, 3) +
                                         " to " + format_number(largest, 4) +
                                         " degrees, mean edge " + format_number(mesh.mean_edge, 3));
    // Unless it is given, the wanted edge is the mean one of the surface.
    const TetrahedralMesh same =
        tetrahedra_in(grain, mean_length(outer, grain.points), Execution(1));
    EXPECT_EQ(same.tetrahedra.size(), mesh.tetrahedra.size());
  }
}

TEST_F(Tetrahedra, LineNamesTheBodyWithTheSmallestAngle) {
  const IndexedMesh plate = test::moved(test::box(1.0, 1.0, 0.05), 1.0, Vector3(3.0, 0.0, 0.0));
  for (const bool is_first : {false, true}) {
    std::vector<IndexedMesh> bodies = {test::sphere(2), plate};
    if (is_first) std::swap(bodies[0], bodies[1]);
    const TetrahedralMesh mesh = tetrahedra_in(bodies, "grain", {"3", "7"}, 0.4, Execution(1));
    const int flattest = dihedral_angles(mesh, 0)[0] < dihedral_angles(mesh, 1)[0] ? 0 : 1;
    EXPECT_EQ(flattest, is_first ? 0 : 1);
    const std::string name = flattest == 0 ? "(grain 3)" : "(grain 7)";
    EXPECT_TRUE(holds(tetrahedra_line(mesh), name));
    const int below = static_cast<int>(dihedral_angles(mesh, 0)[0] < 12.0) +
                      static_cast<int>(dihedral_angles(mesh, 1)[0] < 12.0);
    EXPECT_TRUE(
        holds(tetrahedra_line(mesh), "below 12 in " + std::to_string(below) + " of 2 grains"));
  }
}

TEST_F(Tetrahedra, AreTheSameEachTimeAndInThreads) {
  const IndexedMesh grain = test::lumpy(2);
  const TetrahedralMesh first = tetrahedra_in(grain, 0.0, Execution(1));
  std::vector<TetrahedralMesh> again(3);
  std::vector<std::thread> threads;
  for (TetrahedralMesh& one : again) {
    threads.emplace_back([&] { one = tetrahedra_in(grain, 0.0, Execution(1)); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const TetrahedralMesh& one : again) {
    EXPECT_EQ(one.tetrahedra, first.tetrahedra);
    EXPECT_EQ(one.surface.points, first.surface.points);
  }
}

TEST_F(Tetrahedra, AreRefusedWhereThereAreNone) {
  const IndexedMesh grain = test::lumpy(1);
  EXPECT_ERROR(tetrahedra_in(grain, -1.0), InvalidInput);
  IndexedMesh inward = grain;
  for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
  EXPECT_ERROR(tetrahedra_in(inward, 0.0), InvalidInput);
  // About 1.4 in radius; 8.5 tetrahedra per edge cubed.
  EXPECT_ERROR(tetrahedra_in(grain, 0.005), InvalidInput);
  // Two balls that intersect.
  const IndexedMesh crossed =
      test::joined(test::sphere(2), test::moved(test::sphere(2), 1.0, Vector3(0.7, 0.1, 0.2)));
  const std::size_t pairs = self_intersections(crossed, Execution(1)).size();
  ASSERT_GT(pairs, 10U);
  try {
    tetrahedra_in(crossed, 0.0);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::NumericalFailure);
    EXPECT_EQ(std::string(error.what()).rfind(std::to_string(pairs) + " pairs of triangles", 0), 0U)
        << error.what();
  }
  // After a failure the next one works.
  expect_filled(grain, tetrahedra_in(grain, 0.0));
}

/// Two halves of a cube that share the triangles of their wall.
std::vector<IndexedMesh> halves() {
  std::vector<IndexedMesh> bodies(2);
  for (const bool is_upper : {false, true}) {
    IndexedMesh& box = bodies[is_upper ? 1 : 0];
    const double low = is_upper ? 1.0 : 0.0;
    for (int k = 0; k < 8; ++k) {
      box.points.emplace_back(k & 1, k >> 1 & 1, low + (k >> 2));
    }
    box.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 7, 3}, {2, 6, 7}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  }
  return bodies;
}

TEST_F(Tetrahedra, OfSeveralBodiesShareTheirWall) {
  const std::vector<IndexedMesh> bodies = halves();
  const TetrahedralMesh mesh = tetrahedra_in(bodies, "grain", {"3", "7"}, 0.4, Execution(1));
  // The faces of single tetrahedra are the outer surface; each face of the wall has two, one of
  // each body.
  std::map<std::set<std::int32_t>, std::vector<std::int32_t>> at_face;
  std::array<double, 2> volumes{};
  for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k) {
    volumes.at(mesh.bodies[k]) += volume(mesh, mesh.tetrahedra[k]);
    for (const std::int32_t left_out : mesh.tetrahedra[k]) {
      std::set<std::int32_t> face(mesh.tetrahedra[k].begin(), mesh.tetrahedra[k].end());
      face.erase(left_out);
      at_face[face].push_back(mesh.bodies[k]);
    }
  }
  EXPECT_NEAR(volumes[0], 1.0, 1e-12);
  EXPECT_NEAR(volumes[1], 1.0, 1e-12);
  std::size_t on_wall = 0;
  for (std::size_t t = 0; t < mesh.surface.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.surface.triangles[t];
    const bool is_wall = mesh.sides[t][1] >= 0;
    on_wall += is_wall ? 1U : 0U;
    EXPECT_EQ(at_face.at({a, b, c}), is_wall ? std::vector<std::int32_t>({0, 1})
                                             : std::vector<std::int32_t>({mesh.sides[t][0]}));
  }
  EXPECT_EQ(on_wall, 2U);
  EXPECT_EQ(mesh.surface.triangles.size(), 22U);
  for (const char* name : {"b.vtu", "b.msh", "b.inp"}) write_tetrahedra(path(name), mesh);
  EXPECT_TRUE(holds(content("b.vtu"), "Name=\"grain\""));
  const std::string msh = content("b.msh");
  for (const char* name : {"\"surface_3\"", "\"surface_7\"", "\"wall_3_7\"", "\"grain_7\""}) {
    EXPECT_TRUE(holds(msh, name));
  }
  const std::string inp = content("b.inp");
  EXPECT_TRUE(holds(inp, "ELSET=grain_7"));
  EXPECT_TRUE(holds(inp, "*SURFACE, NAME=wall_3_7"));
  IndexedMesh inward = bodies[1];
  for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
  const std::string said = test::refusal(ErrorCode::InvalidInput, [&] {
    tetrahedra_in({bodies[0], inward}, "grain", {"3", "7"}, 0.4, Execution(1));
  });
  EXPECT_TRUE(holds(said, "The grain 7"));
}

TEST_F(Tetrahedra, AreWrittenForVtkGmshAndAbaqus) {
  const IndexedMesh grain = test::lumpy(2);
  const TetrahedralMesh mesh = tetrahedra_in(grain, 0.3, Execution(1));
  ASSERT_GT(mesh.surface.points.size(), grain.points.size());
  for (const char* name : {"a.vtu", "a.msh", "a.inp"}) write_tetrahedra(path(name), mesh);
  const std::string vtu = content("a.vtu");
  EXPECT_TRUE(holds(vtu, "NumberOfCells=\"" + std::to_string(mesh.tetrahedra.size()) + "\""));
  const IndexedMesh read = read_mesh(path("a.msh"));
  EXPECT_EQ(read.triangles.size(), grain.triangles.size()) << "the surface of the tetrahedra";
  EXPECT_NEAR(volume_of(read, Execution(1)) / volume_of(grain, Execution(1)), 1.0, 1e-12);

  // The rows "element, face" name each triangle of the surface once.
  const std::string inp = content("a.inp");
  const std::size_t at = inp.find("*SURFACE, NAME=surface, TYPE=ELEMENT\n");
  ASSERT_NE(at, std::string::npos);
  EXPECT_TRUE(holds(inp, "*ELEMENT, TYPE=C3D4, ELSET=grain\n1, "));
  EXPECT_TRUE(holds(inp, "GENERATE\n1, " + std::to_string(grain.points.size()) + ", 1\n"));
  std::istringstream rows(inp.substr(inp.find('\n', at) + 1));
  // Nodes of the faces S1 to S4, from the manuals of Abaqus and CalculiX.
  const std::vector<std::vector<std::size_t>> corners = {
      {0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  std::multiset<std::set<std::int32_t>> named;
  for (std::string row; std::getline(rows, row);) {
    const Tetrahedron& t = mesh.tetrahedra.at(std::stoul(row) - 1);
    std::set<std::int32_t> face;
    for (const std::size_t k : corners.at(std::stoul(row.substr(row.find('S') + 1)) - 1)) {
      face.insert(t[k]);
    }
    named.insert(face);
  }
  EXPECT_EQ(named.size(), grain.triangles.size());
  for (const auto& [a, b, c] : grain.triangles) EXPECT_EQ(named.count({a, b, c}), 1U);
  EXPECT_ERROR(write_tetrahedra(path("a.ply"), mesh), InvalidInput);
}

}  // namespace
}  // namespace wscvt
