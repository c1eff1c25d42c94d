// SPDX-License-Identifier: GPL-3.0-or-later
#include "bent_grain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>

#include "grains/marching_cubes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt::test {

namespace {

double crescent(const Vector3& p) {
  const Vector3 bite(p.x() - 0.55, p.y(), std::sqrt(0.5) * p.z());
  return std::min(1.0 - p.norm(), bite.norm() - 0.78);
}

double bowl(const Vector3& p) { return std::min(0.08 - std::abs(p.norm() - 0.92), 0.55 - p.z()); }

double c_shape(const Vector3& p) {
  const double angle = std::clamp(std::atan2(p.y(), p.x()), -2.4, 2.4);
  const Vector3 spine(0.7 * std::cos(angle), 0.7 * std::sin(angle), 0.0);
  return 0.3 - 0.05 * std::abs(angle) - (p - spine).norm();
}

double hook(const Vector3& p) {
  const Vector3 on_stem(0.45, 0.0, std::clamp(p.z(), -0.2, 1.2));
  // The lower half of a ring, from the stem round to the tip.
  const double angle = std::atan2(p.z() + 0.2, p.x());
  const double on_half = angle < 0.0 ? angle : angle < 0.5 * pi ? 0.0 : -pi;
  const Vector3 on_ring(0.45 * std::cos(on_half), 0.0, -0.2 + 0.45 * std::sin(on_half));
  return 0.2 - std::min((p - on_stem).norm(), (p - on_ring).norm());
}

double mushroom(const Vector3& p) {
  const double dome = 1.0 - Vector3(p.x(), p.y(), (p.z() - 0.3) / 0.7).norm();
  const double hollow = Vector3(p.x(), p.y(), p.z() + 0.05).norm() - 0.55;
  const double cap = std::min({dome, p.z() - 0.35, hollow});
  const Vector3 on_stem(0.0, 0.0, std::clamp(p.z(), -0.9, 0.6));
  return std::max(cap, 0.22 - (p - on_stem).norm());
}

/// Numbers in [0, 1) that are the same from every standard library.
double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11U) * 0x1p-53; }

Vector3 unit_vector(std::mt19937_64& engine) {
  const double z = 2.0 * uniform(engine) - 1.0;
  const double angle = 2.0 * pi * uniform(engine);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

std::function<double(const Vector3&)> aggregate() {
  std::mt19937_64 engine(5);
  std::vector<Vector3> balls{Vector3::Zero()};
  while (balls.size() < 10) {
    const Vector3 beside = balls[engine() % balls.size()];
    balls.emplace_back(beside + 0.42 * unit_vector(engine));
  }
  return [balls](const Vector3& p) {
    double depth = -9.0;
    for (const Vector3& ball : balls) depth = std::max(depth, 0.27 - (p - ball).norm());
    return depth;
  };
}

double flake(const Vector3& p) {
  const double bend = 0.35 * p.x() * p.x() + 0.2 * p.x() * p.y();
  return 0.09 - 0.09 * Vector3(p.x(), p.y() / 0.6, (p.z() - bend) / 0.09).norm();
}

double rod(const Vector3& p) {
  return 0.06 - 0.06 * Vector3(p.x(), p.y() / 0.06, p.z() / 0.06).norm();
}

/// Waves of lengths from 0.15 to 0.5 in all directions.
class Roughness {
 public:
  explicit Roughness(double rms) {
    std::mt19937_64 engine(3);
    constexpr int count = 24;
    for (int i = 0; i < count; ++i) {
      const double length = 0.15 + 0.35 * uniform(engine);
      waves_.emplace_back(2.0 * pi / length * unit_vector(engine));
      phases_.push_back(2.0 * pi * uniform(engine));
    }
    amplitude_ = rms * std::sqrt(2.0 / count);
  }

  double at(const Vector3& p) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < waves_.size(); ++i) sum += std::sin(waves_[i].dot(p) + phases_[i]);
    return amplitude_ * sum;
  }

 private:
  std::vector<Vector3> waves_;
  std::vector<double> phases_;
  double amplitude_ = 0.0;
};

IndexedMesh scan(const BentGrain& grain, double voxel) {
  constexpr double rms = 0.008;
  const Roughness roughness(rms);
  VoxelGrid grid;
  grid.spacing = voxel;
  // Off the planes of symmetry, which a real scan never meets.
  const double margin = 6.0 * voxel + 4.0 * rms;
  grid.origin = grain.low - Vector3(margin + 0.31 * voxel, margin + 0.17 * voxel, margin);
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = grain.high[axis] - grid.origin[axis] + margin;
    grid.size[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(extent / voxel)) + 1;
  }
  grid.values.reserve(grid.index(0, 0, grid.size[2]));
  for (int z = 0; z < grid.size[2]; ++z) {
    for (int y = 0; y < grid.size[1]; ++y) {
      for (int x = 0; x < grid.size[0]; ++x) {
        const Vector3 p = grid.origin + voxel * Vector3(x, y, z);
        double depth = grain.depth(p);
        // Farther from the surface the roughness changes nothing.
        if (std::abs(depth) < 10.0 * rms) depth += roughness.at(p);
        grid.values.push_back(depth > 0.0 ? 1.0 : 0.0);
      }
    }
  }
  blur(grid, 1.0);
  return check_mesh(marching_cubes(grid, 0.5), MeshCheckOptions(), Execution(1)).mesh;
}

}  // namespace

std::vector<BentGrain> bent_grains() {
  const Vector3 all = Vector3::Constant(1.05);
  return {{"crescent", -all, all, crescent},
          {"bowl", -all, Vector3(1.05, 1.05, 0.6), bowl},
          {"C-shape", Vector3(-1.05, -1.05, -0.35), Vector3(1.05, 1.05, 0.35), c_shape},
          {"hook", Vector3(-0.7, -0.25, -0.9), Vector3(0.7, 0.25, 1.45), hook},
          {"mushroom", Vector3(-1.05, -1.05, -1.15), Vector3(1.05, 1.05, 1.05), mushroom},
          {"aggregate", Vector3::Constant(-1.5), Vector3::Constant(1.5), aggregate()},
          {"flake", Vector3(-1.05, -0.65, -0.3), Vector3(1.05, 0.65, 0.65), flake},
          {"rod", Vector3(-1.05, -0.1, -0.1), Vector3(1.05, 0.1, 0.1), rod}};
}

BentGrain bent_grain(const std::string& name) {
  for (BentGrain& grain : bent_grains()) {
    if (grain.name == name) return grain;
  }
  throw std::invalid_argument("There is no bent grain of the name " + name + ".");
}

IndexedMesh bent_grain_mesh(const BentGrain& grain, int vertices) {
  // A coarse scan tells the area, and with it the size of voxel.
  const Vector3 box = grain.high - grain.low;
  double voxel = 0.03 * std::sqrt(7000.0 / vertices);
  voxel = std::min(voxel, 0.3 * box.minCoeff());
  IndexedMesh mesh = scan(grain, voxel);
  for (int attempt = 0; attempt < 4; ++attempt) {
    const double share = static_cast<double>(mesh.points.size()) / vertices;
    if (std::abs(share - 1.0) < 0.03) break;
    voxel *= std::sqrt(share);
    mesh = scan(grain, voxel);
  }
  return mesh;
}

IndexedMesh body_of_depth(const std::function<double(const Vector3&)>& depth) {
  VoxelGrid grid;
  grid.spacing = 0.04;
  grid.origin = Vector3(-1.507, -1.511, -1.513);
  grid.size = {76, 76, 76};
  for (int z = 0; z < grid.size[2]; ++z) {
    for (int y = 0; y < grid.size[1]; ++y) {
      for (int x = 0; x < grid.size[0]; ++x) {
        grid.values.push_back(depth(grid.origin + grid.spacing * Vector3(x, y, z)));
      }
    }
  }
  return check_mesh(marching_cubes(grid, 0.0), {}, Execution(1)).mesh;
}

double ball(const Vector3& p) { return 1.0 - p.norm(); }

double bridge(const Vector3& p) {
  const Vector3 q = p - Vector3(1.0, 0.0, 0.0);
  return 0.08 - std::hypot(std::hypot(q.x(), q.z()) - 0.3, q.y());
}

double drilled(const Vector3& p) {
  return std::min(ball(p), std::hypot(p.x() + 0.8, p.y()) - 0.07);
}

IndexedMesh ball_with_a_bridge() {
  return body_of_depth([](const Vector3& p) { return std::max(ball(p), bridge(p)); });
}

IndexedMesh ball_with_a_tunnel() { return body_of_depth(drilled); }

}  // namespace wscvt::test
