// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/clump/medial_spheres.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/distances.h"
#include "wscvt/surface/mesh_place.h"

namespace wscvt {

namespace {

/// The points of samples, as the search for the nearest of them takes them.
struct Points {
  explicit Points(const std::vector<SurfaceSample>& samples) {
    for (const SurfaceSample& sample : samples) {
      x.push_back(sample.point.x());
      y.push_back(sample.point.y());
      z.push_back(sample.point.z());
    }
  }

  /// The smallest square of a distance, then its place: two loops, of which the compiler takes the
  /// first several points at a time.
  std::size_t nearest(const Vector3& to, std::vector<double>& squares) const {
    squares.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double dx = x[i] - to.x();
      const double dy = y[i] - to.y();
      const double dz = z[i] - to.z();
      squares[i] = dx * dx + dy * dy + dz * dz;
    }
    return static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) -
                                    squares.begin());
  }

  std::vector<double> x, y, z;
};

Sphere shrunk(const SurfaceSample& sample, const Points& points, double largest,
              std::vector<double>& squares) {
  constexpr int most_steps = 30;
  constexpr double tolerance = 1e-6;
  double radius = largest;
  for (int step = 0; step < most_steps; ++step) {
    const Vector3 centre = sample.point - radius * sample.normal;
    const std::size_t i = points.nearest(centre, squares);
    // The sample itself is nearest, or a point as near.
    if (std::sqrt(squares[i]) >= radius * (1.0 - tolerance)) break;
    const Vector3 chord = sample.point - Vector3(points.x[i], points.y[i], points.z[i]);
    const double reach = sample.normal.dot(chord);
    if (!(reach > 0.0)) break;
    const double next = 0.5 * chord.squaredNorm() / reach;
    if (!(next < radius)) break;
    radius = next;
  }
  return {sample.point - radius * sample.normal, radius};
}

}  // namespace

std::vector<SurfaceSample> surface_samples(const IndexedMesh& mesh, std::size_t count) {
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  for (const MeshPlace& place : area_uniform_places(mesh, count)) {
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(place.triangle)];
    const Vector3 normal = doubled_area_normal(mesh.points[a], mesh.points[b], mesh.points[c]);
    samples.push_back({point_at(mesh, place), normal.normalized()});
  }
  return samples;
}

std::vector<Sphere> medial_spheres(const std::vector<SurfaceSample>& samples, std::size_t step,
                                   double largest, const Execution& execution) {
  constexpr std::size_t block = 32;
  const Points points(samples);
  std::vector<Sphere> spheres((samples.size() + step - 1) / step);
  execution.parallel_for(spheres.size(), block, [&](std::size_t begin, std::size_t end) {
    std::vector<double> squares;
    for (std::size_t i = begin; i < end; ++i) {
      spheres[i] = shrunk(samples[i * step], points, largest, squares);
    }
  });
  return spheres;
}

}  // namespace wscvt
