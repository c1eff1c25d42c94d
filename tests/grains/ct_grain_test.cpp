// SPDX-License-Identifier: GPL-3.0-or-later
#include "grains/ct_grain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "grains/bent_grain.h"
#include "grains/marching_cubes.h"
#include "support/seeds.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/overhangs.h"

namespace wscvt {
namespace {

CheckedMesh checked(const IndexedMesh& mesh) {
  return check_mesh(mesh, MeshCheckOptions(), Execution(1));
}

double fold_about_centroid(const CheckedMesh& mesh) {
  return overhang_solid_angle(mesh.mesh, mesh.report.centroid, Execution(1));
}

TEST(MarchingCubes, CloseEveryPattern) {
  // White noise holds all 256 cells and all their neighbours, ambiguous faces included.
  test::VoxelGrid grid;
  grid.size = {40, 41, 42};
  grid.values.assign(40 * 41 * 42, 0.0);
  std::mt19937_64 engine(test::announced(1));
  double inside = 0.0;
  for (int z = 1; z < 41; ++z) {
    for (int y = 1; y < 40; ++y) {
      for (int x = 1; x < 39; ++x) {
        grid.values[grid.index(x, y, z)] = static_cast<double>(engine() >> 11U) * 0x1p-53;
        inside += grid.values[grid.index(x, y, z)] > 0.5 ? 1.0 : 0.0;
      }
    }
  }
  const IndexedMesh mesh = test::marching_cubes(grid, 0.5);
  ASSERT_GT(mesh.triangles.size(), 50000U);
  EXPECT_EQ(test::bad_edges(mesh), 0U);
  EXPECT_NO_THROW(to_mesh(mesh));
  double volume = 0.0;  // outward, and roughly that of the voxels inside
  for (const Triangle& t : mesh.triangles) {
    volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6.0;
  }
  EXPECT_GT(volume, 0.3 * inside);
  EXPECT_LT(volume, 1.0 * inside);
}

TEST(MarchingCubes, FindTheSphere) {
  test::VoxelGrid grid;
  grid.size = {40, 40, 40};
  grid.spacing = 0.06;
  grid.origin = Vector3::Constant(-1.171);
  for (int z = 0; z < 40; ++z) {
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        grid.values.push_back(-(grid.origin + grid.spacing * Vector3(x, y, z)).norm());
      }
    }
  }
  const CheckedMesh sphere = checked(test::marching_cubes(grid, -1.0));
  EXPECT_EQ(sphere.report.genus, 0);
  EXPECT_EQ(sphere.report.reoriented_faces, 0U);
  EXPECT_EQ(sphere.report.vertices, sphere.report.input_vertices);
  // Linear interpolation of the distance: chords of h^2 / 8 at most.
  for (const Vector3& p : sphere.mesh.points) EXPECT_NEAR(p.norm(), 1.0, 0.06 * 0.06 / 8.0);
}

/// The reference grains and those of the samples.
std::vector<test::Grain> grains() {
  std::vector<test::Grain> all = test::reference_grains();
  all.push_back(test::textured_sand_grain(5));
  all.push_back(test::textured_angular_grain(7));
  return all;
}

TEST(CtGrain, HasTheVolumeOfTheUnitSphere) {
  for (const test::Grain& grain : grains()) {
    SCOPED_TRACE(grain.name);
    const CheckedMesh exact = checked(test::exact_mesh(grain, test::sphere(5)));
    // Chords of 20480 faces lose 0.03 % on a sphere, a few times that on a rough grain.
    EXPECT_NEAR(exact.report.volume / (4.0 * test::pi / 3.0), 1.0, 2e-3);
  }
}

TEST(CtGrain, IsScannedToAClosedStarShapedMesh) {
  for (const test::Grain& grain : grains()) {
    SCOPED_TRACE(grain.name);
    const CheckedMesh scan = checked(test::ct_mesh_of_about(grain, 4000));
    EXPECT_NEAR(static_cast<double>(scan.report.vertices), 4000.0, 80.0);
    EXPECT_EQ(scan.report.genus, 0);
    EXPECT_EQ(scan.report.components, 1U);
    EXPECT_EQ(test::bad_edges(scan.mesh), 0U);
    EXPECT_LT(fold_about_centroid(scan), 1e-3);
    // Voxels of 0.08 round off edges and corners.
    EXPECT_NEAR(scan.report.equivalent_radius, 1.0, 0.01);
    EXPECT_NO_THROW(to_mesh(scan.mesh));
  }
}

TEST(CtGrain, DependsOnNothingButItsSeed) {
  test::CtOptions options;
  options.voxel = 0.12;
  const IndexedMesh first = test::ct_mesh(test::sand_grain(5), options);
  EXPECT_EQ(test::ct_mesh(test::sand_grain(5), options).points, first.points);
  EXPECT_NE(test::ct_mesh(test::sand_grain(6), options).points, first.points);
  options.seed = 4;
  EXPECT_NE(test::ct_mesh(test::sand_grain(5), options).points, first.points);
}

TEST(Samples, AreWhatTheirNamesSay) {
  const struct {
    const char* file;
    std::size_t vertices;
  } samples[] = {{"sand_7228.ply", 7228},
                 {"sand_5658.ply", 5658},
                 {"angular_6000.ply", 6000},
                 {"elongated_rough_8000.ply", 8000}};
  for (const auto& sample : samples) {
    SCOPED_TRACE(sample.file);
    const CheckedMesh mesh = checked(read_mesh(std::string(WSCVT_MESHES_DIR "/") + sample.file));
    EXPECT_EQ(mesh.report.input_vertices, sample.vertices);
    EXPECT_EQ(mesh.report.vertices, sample.vertices);
    EXPECT_EQ(mesh.report.faces, 2 * sample.vertices - 4);
    EXPECT_EQ(mesh.report.welded_vertices, 0U);
    EXPECT_EQ(mesh.report.reoriented_faces, 0U);
    EXPECT_EQ(mesh.report.genus, 0);
    EXPECT_LT(fold_about_centroid(mesh), 1e-3);
  }
}

}  // namespace

namespace {

TEST(BentGrains, AreClosedWithoutHandlesAndOfTheSizeAskedFor) {
  for (const test::BentGrain& grain : test::bent_grains()) {
    const IndexedMesh mesh = test::bent_grain_mesh(grain, 5000);
    EXPECT_NEAR(static_cast<double>(mesh.points.size()), 5000.0, 250.0) << grain.name;
    EXPECT_EQ(test::bad_edges(mesh), 0U) << grain.name;
    EXPECT_EQ(check_mesh(mesh, {}, Execution(1)).report.genus, 0) << grain.name;
    for (const Vector3& p : mesh.points) {
      // Roughness of rms 0.008, and the blur rounds the horns and rims.
      ASSERT_NEAR(grain.depth(p), 0.0, 0.08) << grain.name;
    }
  }
}

TEST(BentGrains, AreFarFromStarShaped) {
  // The flake and the rod are thin, not bent; of the others folds hide at least this share.
  const std::map<std::string, double> folds{{"crescent", 0.05}, {"bowl", 0.3},
                                            {"C-shape", 0.3},   {"hook", 0.3},
                                            {"mushroom", 0.01}, {"aggregate", 0.008}};
  for (const auto& [name, fold] : folds) {
    const CheckedMesh mesh =
        check_mesh(test::bent_grain_mesh(test::bent_grain(name), 5000), {}, Execution(1));
    EXPECT_GT(overhang_solid_angle(mesh.mesh, mesh.report.centroid, Execution(1)), fold) << name;
  }
}

}  // namespace
}  // namespace wscvt
