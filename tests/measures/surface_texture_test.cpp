// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/surface_texture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "grains/ct_grain.h"
#include "grains/marching_cubes.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "support/voxel_body.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

using test::holds;

double area_of(const IndexedMesh& mesh) {
  return mesh_sums(mesh.points, mesh.triangles, Vector3::Zero(), Execution(1)).area();
}

/// Moves each vertex half-way to the mean of its neighbours.
IndexedMesh smoothed(IndexedMesh mesh, int passes) {
  std::vector<std::set<std::int32_t>> neighbours(mesh.points.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours[static_cast<std::size_t>(t[k])].insert({t[(k + 1) % 3], t[(k + 2) % 3]});
    }
  }
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<Vector3> before = mesh.points;
    for (std::size_t v = 0; v < before.size(); ++v) {
      Vector3 mean = Vector3::Zero();
      for (const std::int32_t n : neighbours[v]) mean += before[static_cast<std::size_t>(n)];
      mesh.points[v] =
          0.5 *
          (before[v] + mean / static_cast<double>(std::max<std::size_t>(1, neighbours[v].size())));
    }
  }
  return mesh;
}

/// Moves each coordinate by a random number of this standard deviation.
IndexedMesh noisy(IndexedMesh mesh, double deviation) {
  std::mt19937 random(7);
  std::normal_distribution<double> move(0.0, deviation);
  for (Vector3& point : mesh.points) {
    for (double& coordinate : point) coordinate += move(random);
  }
  return mesh;
}

IndexedMesh turned(const IndexedMesh& mesh) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  return test::transformed(mesh, turn, Vector3(3, -4, 5));
}

/// Marching cubes on the mask of an ellipsoid: the surface of most programs for labels.
IndexedMesh mask_surface(const Vector3& half_axes) {
  test::VoxelGrid grid;
  const int count = 2 * static_cast<int>(half_axes.maxCoeff()) + 6;
  grid.size = {count, count, count};
  for (int z = 0; z < count; ++z) {
    for (int y = 0; y < count; ++y) {
      for (int x = 0; x < count; ++x) {
        const Vector3 place = Vector3(x, y, z) - Vector3::Constant(0.5 * count + 0.1);
        grid.values.push_back(place.cwiseQuotient(half_axes).norm() < 1.0 ? 1.0 : 0.0);
      }
    }
  }
  return test::marching_cubes(grid, 0.5);
}

Texture kind_of(const IndexedMesh& mesh) { return surface_texture(mesh).kind; }

TEST(SurfaceTexture, NamesStepsOfVoxelsAtEachResolutionAndInEachPose) {
  for (const double radius : {8.0, 16.0, 30.0}) {
    const Vector3 half_axes = radius * Vector3(1.0, 0.8, 0.6);
    const int count = 2 * static_cast<int>(radius) + 4;
    const IndexedMesh faces =
        test::voxel_ellipsoid(half_axes, Vector3::Constant(0.5 * count + 0.1), count);
    for (const IndexedMesh& mesh : {faces, smoothed(faces, 1), mask_surface(half_axes)}) {
      SCOPED_TRACE(std::to_string(radius) + ", " + std::to_string(mesh.triangles.size()));
      EXPECT_EQ(kind_of(mesh), Texture::Steps);
      EXPECT_EQ(kind_of(turned(mesh)), Texture::Steps);
      if (radius < 10.0) continue;  // few steps, which long voxels make fewer
      EXPECT_EQ(kind_of(test::scaled(mesh, Vector3(1e-3, 1e-3, 2.5e-3))), Texture::Steps);
    }
    // Their area is then right to some percent.
    EXPECT_EQ(kind_of(smoothed(faces, 5)), Texture::None);
  }
}

// Of some voxels across, few edges bend inward, but all faces have one of a few directions.
TEST(SurfaceTexture, NamesStepsOfFewVoxels) {
  for (const Vector3& half_axes : {Vector3(6.5, 4.1, 3.0), Vector3(6.0, 5.0, 2.4)}) {
    const IndexedMesh mesh = mask_surface(half_axes);
    SCOPED_TRACE(mesh.triangles.size());
    EXPECT_EQ(kind_of(mesh), Texture::Steps);
    EXPECT_EQ(kind_of(turned(mesh)), Texture::Steps);
    EXPECT_EQ(kind_of(smoothed(mesh, 5)), Texture::None);
  }
}

TEST(SurfaceTexture, NamesNoiseAndHowMuchAreaItMakesAtLeast) {
  for (const test::Grain& grain : test::reference_grains()) {
    SCOPED_TRACE(grain.name);
    const IndexedMesh scan = test::ct_mesh(grain, {});
    for (const double deviation : {0.01, 0.02}) {
      const IndexedMesh mesh = noisy(scan, deviation);
      const SurfaceTexture texture = surface_texture(mesh);
      const double excess = area_of(mesh) / area_of(scan) - 1.0;
      EXPECT_EQ(texture.kind, Texture::Noise);
      // Eight averages leave some of the noise; the grain's own roughness adds a percent or two.
      EXPECT_GT(texture.excess, 0.6 * excess);
      EXPECT_LT(texture.excess, 1.1 * excess + 0.02);
    }
  }
}

// Fewer faces have less area of the same noise, and much noise folds them.
TEST(SurfaceTexture, NamesNoiseOfTheRadiusOnFewAndOnManyFaces) {
  for (const int times : {4, 5}) {
    for (const double deviation : {0.01, 0.015, 0.02}) {
      IndexedMesh mesh = test::lumpy(times);
      std::mt19937 random(7);
      std::normal_distribution<double> move(0.0, deviation);
      for (Vector3& point : mesh.points) point *= 1.0 + move(random);
      EXPECT_EQ(kind_of(mesh), Texture::Noise) << times << ", " << deviation;
    }
    EXPECT_EQ(kind_of(test::lumpy(times)), Texture::None);
  }
}

TEST(SurfaceTexture, IsNotNamedOfScansOfCoarseMeshesAndOfParts) {
  const auto expect_none = [](const IndexedMesh& mesh, const std::string& name) {
    EXPECT_EQ(kind_of(mesh), Texture::None) << name << ": " << surface_texture(mesh).excess;
  };
  for (const char* file : {"sand_7228", "sand_5658", "angular_6000", "elongated_rough_8000"}) {
    expect_none(read_mesh(std::string(WSCVT_MESHES_DIR) + "/" + file + ".ply"), file);
  }
  std::vector<test::Grain> grains = test::reference_grains();
  grains.push_back(test::textured_sand_grain(3));
  grains.push_back(test::textured_angular_grain(5));
  for (const test::Grain& grain : grains) {
    for (const int vertices : {300, 1000, 4000}) {
      expect_none(test::ct_mesh_of_about(grain, vertices),
                  grain.name + " " + std::to_string(vertices));
    }
    for (const int times : {2, 3, 4, 5}) {
      expect_none(test::exact_mesh(grain, test::sphere(times)), grain.name);
    }
  }
  for (const int times : {0, 2, 5}) {
    expect_none(test::subdivided(test::box(3, 2, 1), times), "box");
    expect_none(turned(test::subdivided(test::tetrahedron(1.0), times)), "tetrahedron");
  }
  expect_none(test::bicone(64), "bicone");
  // Of so few faces noise cannot be told from the shape.
  for (const double deviation : {0.1, 0.2}) {
    for (const int times : {1, 2}) expect_none(noisy(test::sphere(times), deviation), "few faces");
  }
  expect_none(test::torus(1.0, 0.3, 32), "torus");
  expect_none(test::overhanging_rim(10), "rim");
  // A cube of voxels, and a stair of a few steps.
  expect_none(test::voxel_body(20, [](int, int, int) { return true; }), "cube of voxels");
  expect_none(test::voxel_body(24, [](int x, int y, int) { return y / 6 <= x / 6; }), "stair");
}

TEST(SurfaceTexture, IsToldWithTheValuesThatAreFalse) {
  const auto told = [](const IndexedMesh& mesh) {
    std::string all;
    for (const Sentence& sentence :
         remarks(measure_grain({"body", mesh}, {}, DetailedOptions(), Execution(1)))) {
      all += sentence.text() + "\n";
    }
    return all;
  };
  const std::string steps = told(mask_surface({12, 10, 8}));
  EXPECT_TRUE(holds(steps, "'body' has the steps of voxels"));
  EXPECT_TRUE(holds(steps, "Area, sphericity, convexity"));
  const std::string noise = told(noisy(test::sphere(4), 0.02));
  EXPECT_TRUE(holds(noise, "'body' is noisy"));
  EXPECT_TRUE(holds(noise, "Area, sphericity, convexity"));
  EXPECT_EQ(told(test::sphere(4)), "");
  SurfaceTexture texture;
  texture.kind = Texture::Noise;
  texture.excess = 0.25;
  const std::string sentence = texture_sentence(texture, "it");
  EXPECT_TRUE(holds(sentence, "at least 25 % too large"));
}

}  // namespace
}  // namespace wscvt
