// SPDX-License-Identifier: GPL-3.0-or-later
#include "ct_grain.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "marching_cubes.h"
#include "wscvt/base/numbers.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/sphere/sphere_grid.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_surface.h"

namespace wscvt::test {

namespace {

/// Numbers that are the same from every standard library, which std::normal_distribution's are not.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  /// In (0, 1).
  double uniform() { return (static_cast<double>(engine_() >> 11U) + 0.5) * 0x1p-53; }

  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

RadiusFunction pointwise(const std::function<double(const Vector3&)>& radius) {
  return [radius](const std::vector<Vector3>& directions) {
    std::vector<double> radii(directions.size());
    std::transform(directions.begin(), directions.end(), radii.begin(), radius);
    return radii;
  };
}

RadiusFunction product(const RadiusFunction& a, const RadiusFunction& b) {
  return [a, b](const std::vector<Vector3>& directions) {
    std::vector<double> radii = a(directions);
    const std::vector<double> factors = b(directions);
    std::transform(radii.begin(), radii.end(), factors.begin(), radii.begin(), std::multiplies<>());
    return radii;
  };
}

RadiusFunction ellipsoid(const Vector3& axes) {
  return pointwise([axes](const Vector3& u) { return 1.0 / u.cwiseQuotient(axes).norm(); });
}

/// Planes about the ellipsoid `axes`, their cone functions joined by the norm of index `sharpness`.
RadiusFunction polyhedron(const Vector3& axes, int faces, double sharpness, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Vector3> planes;
  for (const Vector3& u : fibonacci_lattice(faces)) {
    const Vector3 shift(random.normal(), random.normal(), random.normal());
    const double distance = 1.0 + 0.12 * (2.0 * random.uniform() - 1.0);
    planes.emplace_back((u + 0.25 * shift).normalized() / distance);
  }
  return pointwise([=](const Vector3& u) {
    const Vector3 x = u.cwiseQuotient(axes);
    double sum = 0.0;
    for (const Vector3& plane : planes) sum += std::pow(std::max(0.0, x.dot(plane)), sharpness);
    return std::pow(sum, -1.0 / sharpness);
  });
}

RadiusFunction sand_polyhedron(std::uint64_t seed) {
  return polyhedron(Vector3(1.0, 0.75, 0.6), 16, 24.0, seed);
}

RadiusFunction crushed_polyhedron(std::uint64_t seed) {
  return polyhedron(Vector3(1.0, 0.85, 0.7), 13, 80.0, seed);
}

/// 1 + harmonics of degree first to last, of amplitude falling with degree^-decay, and rms `rms`.
RadiusFunction roughness(int first, int last, double decay, double rms, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<double> coefficients(harmonic_count(last), 0.0);
  double square = 0.0;
  for (int l = first; l <= last; ++l) {
    for (int m = -l; m <= l; ++m) {
      double& a = coefficients[harmonic_index(l, m)];
      a = random.normal() * std::pow(l, -decay) / std::sqrt(2.0 * l + 1.0);
      square += a * a;
    }
  }
  for (double& a : coefficients) a *= rms * std::sqrt(4.0 * pi / square);
  coefficients[0] = std::sqrt(4.0 * pi);
  return [surface = HarmonicSurface(coefficients)](const std::vector<Vector3>& directions) {
    return surface.radii(directions, Execution(1));
  };
}

Grain scaled_grain(const std::string& name, const RadiusFunction& radii) {
  const SphereQuadrature quadrature = gauss_legendre_sphere(120);
  const std::vector<double> r = radii(quadrature.directions);
  double cubes = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) cubes += quadrature.weights[i] * r[i] * r[i] * r[i];
  const double scale = std::cbrt(4.0 * pi / cubes);
  Grain grain;
  grain.name = name;
  grain.radii = [radii, scale](const std::vector<Vector3>& directions) {
    std::vector<double> scaled = radii(directions);
    for (double& radius : scaled) radius *= scale;
    return scaled;
  };
  return grain;
}

/// Share of every voxel inside the grain.
VoxelGrid occupancy(const Grain& grain, const CtOptions& options) {
  // A table of radii, a fraction of a degree apart, serves the millions of points.
  constexpr int rows = 240;
  const std::vector<Vector3> directions = SphereGrid::directions(rows);
  const std::vector<double> radii = grain.radii(directions);
  const SphereGrid table(rows, 4, radii);
  Vector3 low = Vector3::Zero();
  Vector3 high = Vector3::Zero();
  for (std::size_t i = 0; i < radii.size(); ++i) {
    low = low.cwiseMin(radii[i] * directions[i]);
    high = high.cwiseMax(radii[i] * directions[i]);
  }
  const double h = options.voxel;
  VoxelGrid grid;
  grid.spacing = h;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    grid.origin[axis] = low[axis] - (3.5 + options.offset[k]) * h;
    grid.size[k] = static_cast<int>(std::ceil((high[axis] - grid.origin[axis]) / h)) + 4;
  }
  const auto inside_by = [&](const std::vector<Vector3>& points) {
    std::vector<Vector3> u(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = points[i].norm();
      u[i] = distance > 0.0 ? Vector3(points[i] / distance) : Vector3(Vector3::UnitZ());
    }
    std::vector<double> result(points.size());
    table.interpolate(u.data(), u.size(), result.data());
    for (std::size_t i = 0; i < points.size(); ++i) result[i] -= points[i].norm();
    return result;
  };
  std::vector<Vector3> nodes;
  for (int z = 0; z < grid.size[2]; ++z) {
    for (int y = 0; y < grid.size[1]; ++y) {
      for (int x = 0; x < grid.size[0]; ++x) nodes.emplace_back(grid.origin + h * Vector3(x, y, z));
    }
  }
  grid.values = inside_by(nodes);
  const int n = options.supersampling;
  std::vector<Vector3> offsets;
  for (int i = 0; i < n * n * n; ++i) {
    const int row = i / n;
    const int layer = row / n;
    const Vector3 cell(i % n, row % n, layer);
    offsets.emplace_back(h * ((cell + Vector3::Constant(0.5)) / n - Vector3::Constant(0.5)));
  }
  std::vector<Vector3> points(offsets.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double& value = grid.values[i];
    // Steeper than four to one against the sphere a grain is not: elsewhere the voxel is uniform.
    if (std::abs(value) > 4.0 * h) {
      value = value > 0.0 ? 1.0 : 0.0;
      continue;
    }
    for (std::size_t j = 0; j < offsets.size(); ++j) points[j] = nodes[i] + offsets[j];
    const std::vector<double> depth = inside_by(points);
    const auto inside = std::count_if(depth.begin(), depth.end(), [](double d) { return d > 0.0; });
    value = static_cast<double>(inside) / static_cast<double>(offsets.size());
  }
  return grid;
}

}  // namespace

Grain ellipsoid_grain() { return scaled_grain("ellipsoid", ellipsoid(Vector3(1.0, 0.7, 0.5))); }

Grain superellipsoid_grain() {
  const Vector3 axes(1.0, 0.8, 0.65);
  return scaled_grain("superellipsoid", pointwise([axes](const Vector3& u) {
                        const double sum = u.cwiseQuotient(axes).array().abs().pow(5.0).sum();
                        return std::pow(sum, -0.2);
                      }));
}

Grain sand_grain(std::uint64_t seed) {
  return scaled_grain("sand",
                      product(sand_polyhedron(seed), roughness(2, 15, 1.2, 0.045, seed + 1)));
}

Grain textured_sand_grain(std::uint64_t seed) {
  return scaled_grain("textured sand",
                      product(sand_polyhedron(seed), roughness(2, 60, 1.0, 0.047, seed + 1)));
}

Grain rough_grain(std::uint64_t seed) {
  return scaled_grain(
      "rough", product(ellipsoid(Vector3(2.0, 1.0, 1.0)), roughness(3, 30, 0.6, 0.045, seed)));
}

Grain angular_grain(std::uint64_t seed) {
  return scaled_grain("angular",
                      product(crushed_polyhedron(seed), roughness(4, 25, 1.0, 0.008, seed + 1)));
}

Grain textured_angular_grain(std::uint64_t seed) {
  return scaled_grain("textured angular",
                      product(crushed_polyhedron(seed), roughness(4, 60, 1.0, 0.022, seed + 1)));
}

std::vector<Grain> reference_grains() {
  return {ellipsoid_grain(), superellipsoid_grain(), sand_grain(5), rough_grain(23)};
}

IndexedMesh ct_mesh(const Grain& grain, const CtOptions& options) {
  VoxelGrid grid = occupancy(grain, options);
  blur(grid, options.blur);
  RandomNumbers random(options.seed);
  for (double& value : grid.values) value += options.noise * random.normal();
  blur(grid, options.smoothing);
  return check_mesh(marching_cubes(grid, 0.5), MeshCheckOptions(), Execution(1)).mesh;
}

IndexedMesh ct_mesh_of_about(const Grain& grain, int vertices) {
  CtOptions options;
  options.voxel *= std::sqrt(7000.0 / vertices);
  const IndexedMesh first = ct_mesh(grain, options);
  options.voxel *= std::sqrt(static_cast<double>(first.points.size()) / vertices);
  return ct_mesh(grain, options);
}

IndexedMesh exact_mesh(const Grain& grain, const IndexedMesh& sphere) {
  IndexedMesh mesh = sphere;
  const std::vector<double> radii = grain.radii(sphere.points);
  for (std::size_t i = 0; i < radii.size(); ++i) mesh.points[i] *= radii[i];
  return mesh;
}

}  // namespace wscvt::test
