// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "grains/marching_cubes.h"
#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "toolbox/job/extract_job.h"
#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

IndexedMesh ball(double radius, const Vector3& centre) {
  return test::moved(test::sphere(2), radius, centre);
}

IndexedMesh inside_out(IndexedMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

double signed_volume(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, mesh.points[0], Execution(1)).volume();
}

TEST(Bodies, AreTheShellsWithTheirPoresInTheOrderOfTheFile) {
  const double unit = signed_volume(ball(1.0, Vector3::Zero()));
  // A crumb; a large body with two pores, in one of which a grain with a pore lies; one beside it.
  // Which way the faces look says nothing.
  std::vector<IndexedMesh> shells = {ball(0.1, {9, -9, 0}),
                                     inside_out(ball(10.0, {1, 2, 3})),
                                     inside_out(ball(4.0, {5, 2, 3})),
                                     ball(2.0, {-5, 2, 3}),
                                     ball(3.0, {5, 2, 3}),
                                     ball(1.0, {5.5, 2, 3}),
                                     ball(5.0, {30, 2, 3})};
  IndexedMesh mesh;
  for (const IndexedMesh& shell : shells) mesh = test::joined(mesh, shell);
  for (const bool as_stl : {false, true}) {
    const std::vector<MeshBody> bodies =
        split_bodies(as_stl ? test::unwelded(mesh) : mesh, {}, Execution(2)).list;
    ASSERT_EQ(bodies.size(), 4U);
    const std::vector<double> radii = {0.1, 10.0, 3.0, 5.0};
    const std::vector<std::size_t> pores = {0, 2, 1, 0};
    const std::vector<double> pore_volumes = {0.0, 64.0 + 8.0, 1.0, 0.0};
    for (std::size_t k = 0; k < 4; ++k) {
      const double volume = unit * std::pow(radii[k], 3);
      EXPECT_NEAR(bodies[k].volume / volume, 1.0, 1e-12) << k;
      EXPECT_EQ(bodies[k].pores, pores[k]) << k;
      EXPECT_NEAR(bodies[k].pore_volume, unit * pore_volumes[k], 1e-12 * volume) << k;
      EXPECT_EQ(bodies[k].boundary_edges, 0U);
      // Pores are turned inward, so that their volume counts against the body's.
      EXPECT_NEAR(signed_volume(bodies[k].mesh), volume - unit * pore_volumes[k], 1e-11 * volume);
      EXPECT_EQ(bodies[k].mesh.points.size(), (1 + pores[k]) * shells[0].points.size());
    }
  }
}

// Whatever their order and their faces', the same bodies come out.
TEST(Bodies, AreFoundInAFileWhoseFacesAreInAnyOrder) {
  IndexedMesh mesh = test::joined(ball(3.0, {0, 0, 0}), ball(1.0, {0.5, -0.25, 0.125}));
  mesh = test::joined(mesh, ball(2.0, {4.9, 0, 0}));
  mesh = test::shuffled(mesh, test::announced(3));
  const std::vector<MeshBody> bodies = split_bodies(mesh, {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].pores + bodies[1].pores, 1U);
  EXPECT_EQ(bodies[bodies[0].volume > bodies[1].volume ? 0 : 1].pores, 1U);
}

TEST(Bodies, ThatCutThroughEachOtherOrAreOpenLieSideBySide) {
  // The smaller one's box is within the larger's.
  const IndexedMesh cutting = test::joined(ball(10.0, {0, 0, 0}), ball(2.0, {6.0, 6.0, 0}));
  EXPECT_EQ(split_bodies(cutting, {}, Execution(1)).list.size(), 2U);
  IndexedMesh open = ball(1.0, {0, 0, 0});
  open.triangles.pop_back();
  const std::vector<MeshBody> bodies =
      split_bodies(test::joined(ball(10.0, {0, 0, 0}), open), {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].pores, 0U);
  EXPECT_EQ(bodies[1].boundary_edges, 3U);
  EXPECT_EQ(bodies[1].volume, 0.0);
}

class BodiesOfAFile : public test::FileFolder {
 protected:
  std::vector<std::string> warnings_of(const IndexedMesh& mesh) const {
    write_mesh(mesh, path("a.ply"));
    return BodyGrains(path("a.ply"), 0.0, Execution(1)).warnings();
  }
};

TEST_F(BodiesOfAFile, NameOneSpikeAndCountTheBodiesThatHaveOne) {
  IndexedMesh mesh = ball(1.0, {0, 0, 0});
  for (const double x : {4.0, 8.0, 12.0}) mesh = test::joined(mesh, ball(1.0, {x, 0, 0}));
  EXPECT_TRUE(warnings_of(mesh).empty());
  const std::size_t a_ball = mesh.points.size() / 4;
  // The highest vertex of the second and of the third ball, at eight radii.
  std::size_t highest = 0;
  for (std::size_t v = 0; v < a_ball; ++v) {
    if (mesh.points[v].z() > mesh.points[highest].z()) highest = v;
  }
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
    mesh.points[k * a_ball + highest].z() = 8.0;
    const std::vector<std::string> warnings = warnings_of(mesh);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].rfind("A vertex of body 2 lies at (", 0), 0U) << warnings[0];
    EXPECT_EQ(warnings[0].find("1 other body has such a vertex.") != std::string::npos, k == 2)
        << warnings[0];
  }
}

// Where one vertex lies so far away that all others seem to be in one place, it is named.
TEST(Bodies, AreNotMadeWithAVertexFarAway) {
  for (const double far : {1e5, 1e8, 1e30, 1e70, 1e200}) {
    SCOPED_TRACE(far);
    IndexedMesh mesh = test::joined(ball(1.0, {0.1, 0.2, 0.3}), ball(1.5, {4, 0, 0}));
    mesh.points[30].x() = far;
    std::string refusal;
    try {
      EXPECT_EQ(split_bodies(mesh, {}, Execution(1)).list.size(), 2U);
    } catch (const Error& error) {
      refusal = error.what();
    }
    EXPECT_EQ(refusal.rfind("Vertex 30, counted from 0, lies at (", 0),
              far > 1e5 ? 0U : refusal.npos)
        << refusal;
  }
}

TEST(Bodies, ThatTouchInAVertexAreTwo) {
  const IndexedMesh box = test::box(1.0, 2.0, 3.0);
  Vector3 corner = box.points[0];
  for (const Vector3& p : box.points) {
    if (p.sum() > corner.sum()) corner = p;
  }
  const IndexedMesh other = test::transformed(test::box(2.0, 1.0, 1.0), Eigen::Matrix3d::Identity(),
                                              corner - test::box(2.0, 1.0, 1.0).points[0]);
  EXPECT_EQ(split_bodies(test::joined(box, other), {}, Execution(1)).list.size(), 2U);
}

// Surfaces of labels on a grid of unit cubes, as programs export them.
enum class Walls {
  OwnVertices,     // a closed surface each
  SharedVertices,  // a closed surface each; common corners are one vertex (VTK's discrete contours)
  Soup,            // as an STL file
  Once,            // the common wall once, in the direction of either (Avizo, DREAM.3D)
  OnceNamed,       // so, with the labels of both sides
};

using Labels = std::map<std::array<int, 3>, int>;

/// Appends the square between two cubes, outward from the first.
void add_square(const std::array<int, 3>& cube, int axis, int sign,
                std::map<std::array<int, 3>, std::int32_t>& vertices, IndexedMesh& mesh) {
  std::array<std::int32_t, 4> corners{};
  for (int k = 0; k < 4; ++k) {
    std::array<int, 3> corner = cube;
    corner[axis] += sign > 0 ? 1 : 0;
    corner[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
    corner[(axis + 2) % 3] += k >= 2 ? 1 : 0;
    const auto [known, is_new] =
        vertices.emplace(corner, static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) mesh.points.emplace_back(corner[0], corner[1], corner[2]);
    corners[k] = known->second;
  }
  if (sign < 0) std::swap(corners[1], corners[3]);
  // The same diagonal from both sides.
  mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  mesh.triangles.push_back({corners[0], corners[2], corners[3]});
}

struct Exported {
  IndexedMesh mesh;
  std::vector<NamedFaces> names;
};

Exported exported(const Labels& labels, Walls walls, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::map<int, std::map<std::array<int, 3>, std::int32_t>> vertices;
  Exported result;
  NamedFaces names;
  std::vector<std::int32_t> others;
  std::set<int> known;
  for (const auto& [cube, label] : labels) known.insert(label);
  for (const int label : known) {
    names.names.push_back("grain_" + std::to_string(label));
    for (const auto& [cube, own] : labels) {
      if (own != label) continue;
      for (int side = 0; side < 6; ++side) {
        std::array<int, 3> next = cube;
        next[side / 2] += side % 2 == 0 ? 1 : -1;
        const auto found = labels.find(next);
        const int other = found == labels.end() ? 0 : found->second;
        if (other == label) continue;
        const bool is_once = walls == Walls::Once || walls == Walls::OnceNamed;
        if (is_once && other > 0 && other < label) continue;
        auto& own_vertices = vertices[walls == Walls::OwnVertices ? label : 0];
        const std::size_t before = result.mesh.triangles.size();
        add_square(cube, side / 2, side % 2 == 0 ? 1 : -1, own_vertices, result.mesh);
        if (is_once && other > 0 && engine() % 2 == 0) {
          for (std::size_t f = before; f < before + 2; ++f) {
            std::swap(result.mesh.triangles[f][1], result.mesh.triangles[f][2]);
          }
        }
        names.of_face.resize(result.mesh.triangles.size(),
                             static_cast<std::int32_t>(names.names.size()) - 1);
        const auto place =
            static_cast<std::int32_t>(std::distance(known.begin(), known.find(other)));
        others.resize(result.mesh.triangles.size(), other == 0 ? -1 : place);
      }
    }
  }
  if (walls == Walls::Soup) result.mesh = test::unwelded(result.mesh);
  if (walls == Walls::OwnVertices) result.names = {names};
  if (walls == Walls::OnceNamed) {
    NamedFaces sides{names.names, {}};
    for (std::size_t f = 0; f < others.size(); ++f) {
      sides.of_face.insert(sides.of_face.end(), {names.of_face[f], others[f]});
      if (engine() % 2 == 0) std::swap(sides.of_face[2 * f], sides.of_face[2 * f + 1]);
    }
    result.names = {sides};
  }
  return result;
}

Labels filled(const std::array<int, 3>& low, const std::array<int, 3>& high, int label,
              Labels labels = {}) {
  for (int x = low[0]; x < high[0]; ++x) {
    for (int y = low[1]; y < high[1]; ++y) {
      for (int z = low[2]; z < high[2]; ++z) labels[{x, y, z}] = label;
    }
  }
  return labels;
}

/// Two that touch in a wall; three that meet in a line; one inside another; contact in an edge, and
/// in a point; four of which one touches itself in an edge.
std::map<std::string, Labels> touching_labels() {
  std::map<std::string, Labels> all;
  all["wall"] = filled({3, 1, 0}, {5, 4, 3}, 2, filled({0, 0, 0}, {3, 4, 5}, 1));
  all["line"] = filled({0, 2, 0}, {4, 4, 3}, 3,
                       filled({2, 0, 0}, {5, 2, 3}, 2, filled({0, 0, 0}, {2, 2, 3}, 1)));
  all["inside"] = filled({1, 1, 1}, {3, 3, 2}, 2, filled({0, 0, 0}, {4, 4, 4}, 1));
  all["two inside"] = filled({2, 1, 1}, {3, 3, 2}, 3,
                             filled({1, 1, 1}, {2, 3, 2}, 2, filled({0, 0, 0}, {5, 4, 4}, 1)));
  all["edge"] = filled({2, 2, 0}, {4, 5, 4}, 2, filled({0, 0, 0}, {2, 2, 3}, 1));
  all["point"] = filled({2, 2, 3}, {4, 5, 4}, 2, filled({0, 0, 0}, {2, 2, 3}, 1));
  all["itself"] = filled({1, 1, 0}, {2, 2, 1}, 1, filled({0, 0, 0}, {1, 1, 1}, 1));
  all["itself"] = filled({0, 0, 1}, {2, 2, 2}, 1, all["itself"]);
  all["itself"] = filled({2, 0, 0}, {4, 2, 2}, 2, all["itself"]);
  return all;
}

std::vector<double> volumes_of(const std::vector<MeshBody>& bodies) {
  std::vector<double> volumes;
  for (const MeshBody& body : bodies) volumes.push_back(std::abs(signed_volume(body.mesh)));
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

std::vector<double> sizes_of(const Labels& labels) {
  std::map<int, double> sizes;
  for (const auto& [cube, label] : labels) sizes[label] += 1.0;
  std::vector<double> volumes;
  for (const auto& [label, size] : sizes) volumes.push_back(size);
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

TEST(Bodies, AreTheLabelsOfSurfacesThatTouch) {
  const std::uint64_t seed = test::announced(11);
  for (const auto& [kind, labels] : touching_labels()) {
    for (const Walls walls :
         {Walls::OwnVertices, Walls::SharedVertices, Walls::Soup, Walls::Once, Walls::OnceNamed}) {
      SCOPED_TRACE(kind + ", " + std::to_string(static_cast<int>(walls)));
      // A wall that is there once about a body inside another is that of a pore.
      if (walls == Walls::Once && kind == "inside") continue;
      for (const bool mixed : {false, true}) {
        Exported file = exported(labels, walls, seed);
        if (mixed && walls == Walls::OnceNamed) continue;
        if (mixed) file = {test::shuffled(file.mesh, seed), {}};
        const MeshBodies bodies = split_bodies(file.mesh, file.names, Execution(2));
        const std::vector<double> volumes = volumes_of(bodies.list);
        const std::vector<double> sizes = sizes_of(labels);
        ASSERT_EQ(volumes.size(), sizes.size());
        for (std::size_t k = 0; k < sizes.size(); ++k) EXPECT_NEAR(volumes[k], sizes[k], 1e-12);
        for (const MeshBody& body : bodies.list) EXPECT_TRUE(body.is_closed());
        if (mixed || (walls != Walls::OwnVertices && walls != Walls::OnceNamed)) continue;
        std::map<std::string, double> by_name;
        for (const auto& [cube, label] : labels) by_name["grain_" + std::to_string(label)] += 1.0;
        for (const MeshBody& body : bodies.list) {
          EXPECT_NEAR(std::abs(signed_volume(body.mesh)), by_name[body.name], 1e-12) << body.name;
          by_name.erase(body.name);
        }
        EXPECT_TRUE(by_name.empty());
      }
    }
  }
}

// What both sides of a wall are says which of two nested surfaces are bodies.
TEST(Bodies, OfBothSidesOfWallsHavePoresAndBodiesInThem) {
  IndexedMesh mesh = test::joined(ball(3.0, {0, 0, 0}), ball(1.0, {1.5, 0, 0}));
  mesh = test::joined(mesh, inside_out(ball(1.0, {-1.5, 0, 0})));
  mesh = test::joined(mesh, ball(0.5, {-1.5, 0, 0}));
  const auto faces = static_cast<std::size_t>(ball(1.0, {0, 0, 0}).triangles.size());
  // A host, a body that fills a pore of it, and one alone in another.
  NamedFaces sides{{"host", "filling", "alone"}, {}};
  for (const auto& [one, other] : {std::pair(-1, 0), {1, 0}, {0, -1}, {-1, 2}}) {
    for (std::size_t f = 0; f < faces; ++f) {
      sides.of_face.insert(sides.of_face.end(), {one, other});
    }
  }
  const MeshBodies bodies = split_bodies(mesh, {sides}, Execution(1));
  EXPECT_TRUE(bodies.warnings.empty());
  ASSERT_EQ(bodies.list.size(), 3U);
  const double unit = signed_volume(ball(1.0, {0, 0, 0}));
  EXPECT_EQ(bodies.list[0].name, "host");
  EXPECT_EQ(bodies.list[0].pores, 2U);
  EXPECT_NEAR(bodies.list[0].volume, 27.0 * unit, 1e-9);
  EXPECT_EQ(bodies.list[1].name, "filling");
  EXPECT_NEAR(bodies.list[1].volume, unit, 1e-9);
  EXPECT_EQ(bodies.list[2].name, "alone");
  EXPECT_NEAR(bodies.list[2].volume, 0.125 * unit, 1e-9);
  // Names of the surfaces beside them make no body of a pore.
  NamedFaces surfaces{{"a", "b", "c", "d"}, {}};
  for (std::int32_t k = 0; k < 4; ++k) {
    surfaces.of_face.insert(surfaces.of_face.end(), faces, k);
  }
  EXPECT_EQ(split_bodies(mesh, {surfaces, sides}, Execution(1)).list.size(), 3U);
  // Numbers of another meaning leave surfaces open, and are not used.
  for (std::size_t k = 0; k < sides.of_face.size(); ++k) {
    sides.of_face[k] = static_cast<std::int32_t>((k / 2 + k % 2) % 3);
  }
  EXPECT_EQ(split_bodies(mesh, {sides}, Execution(1)).list.size(), 2U);
}

// Reduced one by one, they share some corners of their wall, and overlap a little.
TEST(Bodies, ThatOverlapInPartAreToldApart) {
  IndexedMesh first = test::box(2, 2, 2);
  IndexedMesh second = test::moved(test::box(2, 2, 2), 1.0, {2, 0, 0});
  for (Vector3& p : second.points) {
    if (p.x() < 1.5 && p.y() > 0.0) p.x() -= 0.25;
  }
  const MeshBodies bodies = split_bodies(test::joined(first, second), {}, Execution(1));
  ASSERT_EQ(bodies.list.size(), 2U);
  EXPECT_NEAR(bodies.list[0].volume, 8.0, 1e-12);
  EXPECT_NEAR(bodies.list[1].volume, 8.5, 1e-12);
}

TEST(Bodies, AreToldThoughTheirSquaresAreCutAlongDifferentDiagonals) {
  const IndexedMesh first = test::box(2, 2, 2);
  const IndexedMesh second =
      test::moved(test::scaled(test::box(2, 2, 2), Vector3(1, -1, 1)), 1.0, {2, 0, 0});
  const IndexedMesh both = test::unwelded(test::joined(first, second));
  const std::vector<MeshBody> bodies = split_bodies(both, {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_NEAR(bodies[0].volume, 8.0, 1e-12);
  EXPECT_NEAR(bodies[1].volume, 8.0, 1e-12);
}

/// A move of a vertex that depends only on its place, as smoothing makes it.
Vector3 wobble(const Vector3& p) {
  return {std::sin(7 * p.x() + 3 * p.y() + p.z()), std::sin(2 * p.x() - 5 * p.y() + 4 * p.z()),
          std::sin(p.x() + 4 * p.y() - 6 * p.z())};
}

// The contour of each label, as VTK's discrete marching cubes makes them: the faces of
// walls lie on each other, or cross where walls were smoothed, because each label cuts them alone.
TEST(Bodies, AreTheContoursOfLabelsWithTheirNamesAndWithout) {
  std::mt19937_64 engine(test::announced(2));
  std::uniform_real_distribution<double> place(0.0, 16.0);
  constexpr int cells = 5;
  std::vector<Vector3> centres;
  for (int k = 0; k < cells; ++k) centres.emplace_back(place(engine), place(engine), place(engine));
  std::array<test::VoxelGrid, cells> grids;
  for (test::VoxelGrid& grid : grids) grid.size = {17, 17, 17};
  for (int i = 0; i < 17 * 17 * 17; ++i) {
    const Vector3 voxel(i % 17, i / 17 % 17, i / (17 * 17));
    const auto nearest =
        std::min_element(centres.begin(), centres.end(), [&](const Vector3& a, const Vector3& b) {
          return (a - voxel).norm() < (b - voxel).norm();
        });
    const auto label = static_cast<std::size_t>(nearest - centres.begin());
    const bool is_inside = (voxel - Vector3::Constant(8)).norm() < 7.0;
    for (std::size_t k = 0; k < cells; ++k) {
      grids[k].values.push_back(is_inside && k == label ? 1.0 : 0.0);
    }
  }
  std::vector<IndexedMesh> contours;
  for (const test::VoxelGrid& grid : grids) {
    contours.push_back(test::marching_cubes(grid, 0.5));
    if (contours.back().triangles.empty()) contours.pop_back();
  }
  ASSERT_GE(contours.size(), 4U);
  for (const double smoothing : {0.0, 1e-7, 0.05, 0.2}) {
    const double unit = smoothing == 1e-7 ? 1e-6 : 1.0;  // metres, in single precision
    Exported file;
    NamedFaces names;
    std::vector<double> expected;
    for (IndexedMesh contour : contours) {
      for (Vector3& p : contour.points) p = unit * (p + smoothing * wobble(p));
      expected.push_back(signed_volume(contour));
      file.mesh = test::joined(file.mesh, contour);
      names.names.push_back(std::to_string(expected.size()));
      names.of_face.resize(file.mesh.triangles.size(),
                           static_cast<std::int32_t>(names.names.size()) - 1);
    }
    std::sort(expected.begin(), expected.end());
    file.mesh = test::unwelded(file.mesh);
    for (const auto& [given, looks_in] :
         {std::pair(std::vector<NamedFaces>{names}, false), {{}, false}, {{}, true}}) {
      if (smoothing == 0.2 && given.empty()) {  // walls cross so much that nothing tells
        EXPECT_ERROR(split_bodies(file.mesh, {}, Execution(1)), InvalidInput);
        continue;
      }
      const std::vector<MeshBody> bodies =
          split_bodies(looks_in ? inside_out(file.mesh) : file.mesh, given, Execution(1)).list;
      const std::vector<double> found = volumes_of(bodies);
      ASSERT_EQ(found.size(), expected.size()) << smoothing << given.size() << looks_in;
      for (std::size_t k = 0; k < found.size(); ++k) {
        // Without names, what two have in common may count in either.
        EXPECT_NEAR(found[k] / expected[k], 1.0, given.empty() ? 0.002 : 1e-9)
            << smoothing << given.size() << looks_in;
      }
    }
  }
}

// A wall that is there once has the name of one side only; the other side is not torn open.
TEST(Bodies, KeepWallsThatHaveTheNameOfOneSide) {
  const Exported once = exported(touching_labels()["wall"], Walls::Once, test::announced(4));
  NamedFaces names{{"a", "b"}, {}};
  const Exported apart = exported(filled({0, 0, 0}, {3, 4, 5}, 1), Walls::Once, 1);
  // The faces of label 1 come first.
  names.of_face.assign(once.mesh.triangles.size(), 1);
  std::fill_n(names.of_face.begin(), apart.mesh.triangles.size(), 0);
  const std::vector<MeshBody> bodies = split_bodies(once.mesh, {names}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_TRUE(bodies[0].is_closed() && bodies[1].is_closed());
}

// Each label's surface was made by itself: the wall of the pore and the grain in it are not alike.
TEST(Bodies, FillPoresWithTrianglesOfTheirOwn) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.2, Vector3::UnitZ()).toRotationMatrix();
  for (const auto& [size, shift] : {std::pair(0.97, 0.0), {1.0, 0.0}, {1.03, 0.0}, {1.0, 0.3}}) {
    const IndexedMesh grain = test::moved(test::transformed(test::sphere(3), turn, Vector3::Zero()),
                                          size, {shift, 0.0, 0.0});
    for (const bool with_two : {false, true}) {
      IndexedMesh mesh = test::joined(ball(3.0, {0, 0, 0}), inside_out(test::sphere(3)));
      mesh = test::joined(mesh, grain);
      // A pore stays one, whichever way its faces look.
      if (with_two) mesh = test::joined(mesh, ball(0.5, {2, 0, 0}));
      const std::vector<MeshBody> bodies = split_bodies(mesh, {}, Execution(1)).list;
      ASSERT_EQ(bodies.size(), 2U) << size;
      EXPECT_EQ(bodies[0].pores, with_two ? 2U : 1U);
      EXPECT_EQ(bodies[1].pores, 0U);
      EXPECT_NEAR(bodies[1].volume, signed_volume(grain), 1e-9);
    }
  }
}

// At an end of the common edge, three faces at a corner make two squares of the same vertices.
TEST(Bodies, WithNamesInOthersAreInclusionsIfTheyLookOutward) {
  const IndexedMesh host = test::box(11.0, 9.0, 10.0);
  for (const bool inward : {false, true}) {
    for (const bool named : {false, true}) {
      SCOPED_TRACE(::testing::Message() << inward << named);
      IndexedMesh inner = test::box(4.0, 3.0, 2.0);
      if (inward) inner = inside_out(inner);
      NamedFaces names;
      names.names = {"host", "inclusion"};
      names.of_face.assign(host.triangles.size(), 0);
      names.of_face.resize(host.triangles.size() + inner.triangles.size(), named ? 1 : 0);
      const MeshBodies bodies = split_bodies(test::joined(host, inner), {names}, Execution(1));
      const bool is_body = named && !inward;
      ASSERT_EQ(bodies.list.size(), is_body ? 2U : 1U);
      EXPECT_EQ(bodies.list[0].pores, 1U);
      EXPECT_NEAR(bodies.list[0].pore_volume, 24.0, 1e-9);
      EXPECT_EQ(bodies.warnings.size(), is_body ? 1U : 0U);
      if (!is_body) continue;
      EXPECT_EQ(bodies.list[0].name, "host");
      EXPECT_EQ(bodies.list[1].name, "inclusion");
      EXPECT_NEAR(bodies.list[1].volume, 24.0, 1e-9);
      EXPECT_EQ(bodies.list[1].pores, 0U);
    }
  }
}

TEST(Bodies, KeepTheirCornersWhereTheyTouchInAnEdge) {
  // However their squares are cut.
  for (int way = 0; way < 64; ++way) {
    const auto turned = [](int signs) {
      const auto sign = [&](int k) { return (signs >> k) % 2 == 0 ? 1.0 : -1.0; };
      return test::scaled(test::box(1, 1, 1), Vector3(sign(0), sign(1), sign(2)));
    };
    const IndexedMesh both =
        test::joined(turned(way % 8), test::moved(turned(way / 8), 1.0, {1, 1, 0}));
    const MeshBodies bodies = split_bodies(test::unwelded(both), {}, Execution(1));
    ASSERT_EQ(bodies.list.size(), 2U) << way;
    EXPECT_TRUE(bodies.warnings.empty()) << way;
    for (const MeshBody& body : bodies.list) EXPECT_NEAR(body.volume, 1.0, 1e-12) << way;
  }
}

TEST(Bodies, WhoseFacesLieOnEachOtherAreToldApartIfTheyLookOutward) {
  // One copy of the wall has a vertex in its middle, and the faces have no common vertices.
  const IndexedMesh first = test::box(2, 2, 2);
  IndexedMesh second = test::moved(test::box(2, 2, 2), 1.0, {2, 0, 0});
  for (std::size_t f = 0; f < second.triangles.size(); ++f) {
    const Triangle t = second.triangles[f];
    const auto is_left = [&](std::int32_t v) {
      return second.points[static_cast<std::size_t>(v)].x() < 1.5;
    };
    if (!is_left(t[0]) || !is_left(t[1]) || !is_left(t[2])) continue;
    const auto middle = static_cast<std::int32_t>(second.points.size());
    second.points.emplace_back((second.points[static_cast<std::size_t>(t[0])] +
                                second.points[static_cast<std::size_t>(t[1])] +
                                second.points[static_cast<std::size_t>(t[2])]) /
                               3.0);
    second.triangles[f] = {t[0], t[1], middle};
    second.triangles.push_back({t[1], t[2], middle});
    second.triangles.push_back({t[2], t[0], middle});
    if (second.points.size() == 10) break;
  }
  const IndexedMesh both = test::unwelded(test::joined(first, second));
  const std::vector<double> volumes = volumes_of(split_bodies(both, {}, Execution(1)).list);
  ASSERT_EQ(volumes.size(), 2U);
  for (const double volume : volumes) EXPECT_NEAR(volume, 8.0, 1e-12);
  // If the faces do not look outward, nothing tells to which body each belongs.
  const IndexedMesh mixed = test::unwelded(test::joined(inside_out(first), second));
  EXPECT_ERROR(split_bodies(mixed, {}, Execution(1)), InvalidInput);
}

TEST(Bodies, AreNamedByTheCoarsestNamesThatTellThemApart) {
  const IndexedMesh one = ball(1.0, {0, 0, 0});
  const IndexedMesh mesh = test::joined(one, ball(1.0, {5, 0, 0}));
  const auto faces = static_cast<std::int32_t>(one.triangles.size());
  NamedFaces objects{{"scan"}, std::vector<std::int32_t>(2 * faces, 0)};
  NamedFaces groups{{"a", "b"}, std::vector<std::int32_t>(faces, 0)};
  groups.of_face.resize(2 * faces, 1);
  const std::vector<MeshBody> bodies = split_bodies(mesh, {objects, groups}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].name + bodies[1].name, "ab");
  // Groups that are parts of one surface are no bodies.
  NamedFaces patches{{"top", "bottom"}, std::vector<std::int32_t>(faces / 2, 0)};
  patches.of_face.resize(faces, 1);
  const std::vector<MeshBody> whole = split_bodies(one, {patches}, Execution(1)).list;
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].name, "");
  EXPECT_TRUE(whole[0].is_closed());
}

TEST(Bodies, ThatOverlapAreTold) {
  const auto overlaps = [](const IndexedMesh& mesh) {
    const MeshBodies bodies = split_bodies(mesh, {}, Execution(1));
    return std::count_if(
        bodies.warnings.begin(), bodies.warnings.end(),
        [](const std::string& text) { return text.rfind("Bodies 1 and 2 overlap.", 0) == 0; });
  };
  const IndexedMesh one = ball(1.0, {0, 0, 0});
  EXPECT_EQ(overlaps(test::joined(one, ball(1.0, {1.2, 0, 0}))), 1);
  EXPECT_EQ(overlaps(test::joined(one, ball(1.0, {1e-6, 0, 0}))), 1) << "nearly a copy";
  const IndexedMesh row =
      test::joined(test::joined(one, ball(1.0, {1.2, 0, 0})), ball(1.0, {2.4, 0, 0}));
  const std::vector<std::string> told = split_bodies(row, {}, Execution(1)).warnings;
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].rfind("Bodies 1 and 2 overlap, and 1 other pair.", 0), 0U) << told[0];
  // Beside each other, in a pore, and walls that cross a little.
  EXPECT_EQ(overlaps(test::joined(one, ball(1.0, {2.0, 0, 0}))), 0);
  EXPECT_EQ(overlaps(test::joined(one, ball(1.0, {1.99, 0, 0}))), 0);
  const IndexedMesh shell = test::joined(ball(3.0, {0, 0, 0}), inside_out(ball(2.0, {0, 0, 0})));
  EXPECT_EQ(overlaps(test::joined(shell, one)), 0);
}

TEST(Bodies, AreTakenOnce) {
  const IndexedMesh one = ball(1.0, {0, 0, 0});
  const MeshBodies bodies = split_bodies(test::joined(one, one), {}, Execution(1));
  EXPECT_EQ(bodies.list.size(), 1U);
  ASSERT_EQ(bodies.warnings.size(), 1U);
  EXPECT_TRUE(test::holds(bodies.warnings[0], "more than once"));
}

TEST(Bodies, LoseFacesThatHangOnThem) {
  IndexedMesh mesh = ball(1.0, {0, 0, 0});
  const Triangle t = mesh.triangles[7];
  mesh.points.push_back(1.1 * mesh.points[static_cast<std::size_t>(t[0])]);
  mesh.triangles.push_back({t[0], t[1], static_cast<std::int32_t>(mesh.points.size()) - 1});
  const MeshBodies bodies = split_bodies(mesh, {}, Execution(1));
  ASSERT_EQ(bodies.list.size(), 1U);
  EXPECT_TRUE(bodies.list[0].is_closed());
  ASSERT_EQ(bodies.warnings.size(), 1U);
  EXPECT_EQ(bodies.warnings[0].rfind("1 face hangs", 0), 0U) << bodies.warnings[0];
  // Two, and some of the body's size, which are a body themselves.
  mesh.triangles.push_back({t[1], t[2], static_cast<std::int32_t>(mesh.points.size()) - 1});
  EXPECT_EQ(split_bodies(mesh, {}, Execution(1)).warnings[0].rfind("2 faces hang", 0), 0U);
  mesh.points.back() *= 4.0;
  const MeshBodies two = split_bodies(mesh, {}, Execution(1));
  ASSERT_EQ(two.list.size(), 2U);
  EXPECT_EQ(two.list[0].boundary_edges, 0U);
  EXPECT_EQ(two.list[1].boundary_edges, 4U);
  EXPECT_TRUE(two.warnings.empty());
}

TEST(Bodies, AreClosedAlongSeams) {
  const std::uint64_t seed = test::announced(5);
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
  IndexedMesh mesh = test::unwelded(test::joined(ball(1.0, {0, 0, 0}), ball(2.0, {5, 0, 0})));
  for (Vector3& p : mesh.points) p += Vector3(noise(engine), noise(engine), noise(engine));
  const MeshBodies bodies = split_bodies(mesh, {}, Execution(1));
  ASSERT_EQ(bodies.list.size(), 2U);
  EXPECT_TRUE(bodies.list[0].is_closed() && bodies.list[1].is_closed());
  EXPECT_NEAR(bodies.list[1].volume / bodies.list[0].volume, 8.0, 1e-5);
  ASSERT_EQ(bodies.warnings.size(), 1U);
  // No two corners are farther apart than the noise is.
  const std::string before = "lay up to ";
  const std::string& told = bodies.warnings[0];
  const double distance = std::stod(told.substr(told.find(before) + before.size()));
  EXPECT_GT(distance, 1e-8);
  EXPECT_LT(distance, 4e-7);
}

// A void between bodies whose common walls are there once looks like a body.
TEST(Bodies, ThatMayBeVoidsAreTold) {
  Labels labels = filled({0, 0, 0}, {5, 3, 3}, 1);
  for (auto& [cube, label] : labels) label = cube[0] < 2 ? 1 : 2;
  labels.erase({1, 1, 1});
  labels.erase({2, 1, 1});
  const Exported file = exported(labels, Walls::Once, test::announced(6));
  const MeshBodies bodies = split_bodies(file.mesh, {}, Execution(1));
  EXPECT_EQ(volumes_of(bodies.list), (std::vector<double>{2.0, 17.0, 26.0}));
  ASSERT_EQ(bodies.warnings.size(), 1U);
  EXPECT_EQ(bodies.warnings[0].rfind("All faces of 1 body look into it", 0), 0U)
      << bodies.warnings[0];
}

// What fills a pore of two bodies counts with both in the pore's volume.
TEST(Bodies, OfWhichTwoFillAPoreTogetherLeaveOnePore) {
  const Labels two = filled({0, 0, 0}, {1, 2, 2}, 1, filled({1, 0, 0}, {4, 2, 2}, 2));
  const Exported inner = exported(two, Walls::Once, test::announced(7));
  const IndexedMesh host = test::box(20.0, 22.0, 24.0);
  const std::vector<MeshBody> bodies =
      split_bodies(test::joined(host, inner.mesh), {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_EQ(bodies[0].pores, 1U);
  EXPECT_NEAR(bodies[0].pore_volume, 16.0, 1e-9);
  EXPECT_NEAR(bodies[0].volume, 20.0 * 22.0 * 24.0, 1e-9);
  EXPECT_NEAR(bodies[1].volume + bodies[2].volume, 16.0, 1e-12);
}

TEST(Bodies, AreToldHoweverSmallTheyAreBesideAnother) {
  Labels labels = filled({0, 0, 0}, {8, 8, 8}, 1);
  labels[{8, 3, 2}] = 2;
  const Exported file = exported(labels, Walls::Once, test::announced(8));
  EXPECT_EQ(volumes_of(split_bodies(file.mesh, {}, Execution(1)).list),
            (std::vector<double>{1.0, 512.0}));
}

TEST(Bodies, StandInTheOrderOfTheFileWhicheverWayTheyWereFound) {
  // The faces of the first have no common vertices.
  const IndexedMesh mesh =
      test::joined(test::unwelded(test::sphere(0)), test::moved(test::sphere(3), 1.0, {5, 0, 0}));
  const std::vector<MeshBody> bodies = split_bodies(mesh, {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].mesh.triangles.size(), 20U);
  EXPECT_EQ(bodies[1].mesh.triangles.size(), 1280U);
}

TEST(Bodies, KeepTheirNamesWhereFacesAreNotUsable) {
  IndexedMesh mesh =
      test::joined(test::box(1, 1, 1), test::moved(test::box(1, 1, 2), 1, {5, 0, 0}));
  NamedFaces names{{"one", "two"}, std::vector<std::int32_t>(12, 0)};
  names.of_face.resize(24, 1);
  // Faces without a place and without an area, at the beginning.
  const auto nowhere = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(std::nan(""), 0.0, 0.0);
  mesh.triangles.insert(mesh.triangles.begin(), {{0, 1, nowhere}, {1, 1, 2}});
  names.of_face.insert(names.of_face.begin(), {1, 1});
  const std::vector<MeshBody> bodies = split_bodies(mesh, {names}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].name, "one");
  EXPECT_EQ(bodies[1].name, "two");
  for (const MeshBody& body : bodies) EXPECT_EQ(body.mesh.triangles.size(), 12U);
}

TEST(Bodies, FillPoresWithTheirOwnFaces) {
  const IndexedMesh grain = ball(1.0, {0.3, 0.2, 0.1});
  const IndexedMesh host = test::joined(ball(3.0, {0, 0, 0}), inside_out(grain));
  const std::vector<MeshBody> bodies =
      split_bodies(test::joined(host, grain), {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_EQ(bodies[0].pores, 1U);
  EXPECT_EQ(bodies[1].pores, 0U);
  EXPECT_GT(signed_volume(bodies[1].mesh), 0.0);
}

// A surface inside another has some faces of it.
TEST(Bodies, HaveAPoreThatTouchesTheirSurfaceFromWithin) {
  const IndexedMesh host = exported(filled({0, 0, 0}, {4, 5, 6}, 1), Walls::OwnVertices, 1).mesh;
  for (const std::array<int, 3>& low :
       {std::array<int, 3>{0, 1, 2}, {3, 1, 2}, {1, 0, 2}, {1, 4, 2}, {1, 2, 0}, {1, 2, 5}}) {
    const std::array<int, 3> high = {low[0] + 1, low[1] + 1, low[2] + 1};
    const IndexedMesh inner = exported(filled(low, high, 1), Walls::OwnVertices, 1).mesh;
    const std::vector<MeshBody> bodies =
        split_bodies(test::joined(host, inner), {}, Execution(1)).list;
    ASSERT_EQ(bodies.size(), 1U) << low[0] << low[1] << low[2];
    EXPECT_EQ(bodies[0].pores, 1U);
  }
}

TEST(Bodies, HaveAPoreThatAnotherPoreCuts) {
  IndexedMesh mesh = test::joined(ball(3.0, {0, 0, 0}), inside_out(ball(1.0, {0, 0, 0})));
  mesh = test::joined(mesh, inside_out(ball(0.4, {0.8, 0, 0})));
  const std::vector<MeshBody> bodies = split_bodies(mesh, {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(bodies[0].pores, 2U);
}

TEST(Bodies, WithoutAnInsideAreOpen) {
  // The projective plane of six corners has no sides.
  IndexedMesh plane;
  plane.points = {{0, 0, 3},    {1, 0, 0},         {0.2, 1, 0.1},
                  {-1, 0.7, 0}, {-0.8, -0.9, 0.2}, {0.4, -1, 0}};
  plane.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                     {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  const std::vector<MeshBody> bodies =
      split_bodies(test::joined(ball(1.0, {9, 0, 0}), plane), {}, Execution(1)).list;
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_TRUE(bodies[0].is_closed());
  EXPECT_FALSE(bodies[1].is_closed());
}

TEST(Bodies, AreNotMadeOfNothing) {
  EXPECT_ERROR(split_bodies({}, {}, Execution(1)), InvalidInput);
  IndexedMesh flat = test::box(1.0, 2.0, 3.0);
  for (Vector3& p : flat.points) p = Vector3(1, 2, 3);
  EXPECT_ERROR(split_bodies(flat, {}, Execution(1)), InvalidInput);
}

}  // namespace
}  // namespace wscvt
