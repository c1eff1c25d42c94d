// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/surface/surface_low_pass.h"

namespace wscvt {

namespace {

/// Sq / cut-off below which heights are rounding errors.
constexpr double smallest_roughness = 1e-12;

/// Edges per cut-off length that its waves need.
constexpr double edges_per_cutoff = 3.0;

/// A second filtering of the reference surface finds 0.7 to 0.9 of the form in the heights
/// (ellipsoids to 1:3:6, capsules, rounded cubes and cylinders). This factor corrects for it.
constexpr double leak_factor = 1.4;

struct Heights {
  std::vector<Vector3> reference;  ///< the surface from which they are measured
  std::vector<double> z;           ///< at each vertex; length
};

/// Returns the heights of `points` above their own low-pass.
Heights heights_above(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                      const SurfaceLowPass& filter, const Execution& execution) {
  const std::vector<Vector3> low = filter.filter(points, execution);
  const std::vector<Vector3> normals = vertex_normals(low, triangles);
  Heights heights;
  heights.reference.reserve(points.size());
  heights.z.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    heights.z.push_back((points[i] - low[i]).dot(normals[i]));
    heights.reference.emplace_back(points[i] - heights.z.back() * normals[i]);
  }
  return heights;
}

/// Means over the area of the reference surface.
struct HeightMoments {
  double sa = 0.0;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
};

HeightMoments moments_of(const Heights& heights, const std::vector<Triangle>& triangles) {
  const std::vector<double> areas = vertex_areas({heights.reference, triangles});
  double area = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    area += areas[i];
    mean += areas[i] * heights.z[i];
  }
  mean /= area;
  HeightMoments moments;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double z = heights.z[i] - mean;
    const double weight = areas[i] / area;
    moments.sa += weight * std::abs(z);
    moments.second += weight * z * z;
    moments.third += weight * z * z * z;
    moments.fourth += weight * z * z * z * z;
  }
  return moments;
}

}  // namespace

double least_cutoff(const IndexedMesh& mesh) {
  double area = 0.0;
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    const double of_face = triangle_area(a, b, c);
    area += of_face;
    sum += of_face * ((b - a).norm() + (c - b).norm() + (a - c).norm()) / 3.0;
  }
  return edges_per_cutoff * sum / area;
}

Roughness surface_roughness(const IndexedMesh& mesh, double cutoff, const Execution& execution) {
  const double least = least_cutoff(mesh);
  if (!(cutoff > 0.0) || cutoff < least) {
    refuse("The cut-off length of roughness is " + format_number(cutoff, 4) +
           ", but the edges of this mesh are so long that it must be " + format_number(least, 4) +
           " or more. Give a larger cut-off or a denser mesh.");
  }
  SurfaceLowPass filter(mesh.triangles, mesh.points.size());
  filter.set_surface(mesh.points, cutoff, execution);
  const Heights first =
      heights_above(mesh.points, mesh.triangles, filter, execution.part(0.0, 0.33));
  filter.set_surface(first.reference, cutoff, execution.part(0.33, 0.67));
  const Heights second =
      heights_above(mesh.points, mesh.triangles, filter, execution.part(0.33, 0.67));
  // The filter's change of a surface without short waves is the form that leaks.
  filter.set_surface(second.reference, cutoff, execution.part(0.67, 1.0));
  const Heights leaked =
      heights_above(second.reference, mesh.triangles, filter, execution.part(0.67, 1.0));

  const HeightMoments moments = moments_of(second, mesh.triangles);
  Roughness result;
  result.cutoff = cutoff;
  result.sa = moments.sa;
  result.sq = std::sqrt(moments.second);
  result.form_leak = leak_factor * std::sqrt(moments_of(leaked, mesh.triangles).second);
  if (result.sq > smallest_roughness * cutoff) {
    result.ssk = moments.third / (moments.second * result.sq);
    result.sku = moments.fourth / (moments.second * moments.second);
  }
  return result;
}

double printed_sdq(const RadialSurface& surface, int rings, const Execution& execution) {
  if (rings < 1) {
    refuse("The number of parallels is " + std::to_string(rings) + ". Give 1 or more.");
  }
  using Sums = Eigen::Vector2d;  // of squared slopes and of areas
  const auto count = static_cast<std::size_t>(rings);
  const double step = pi / rings;
  std::vector<double> cosines(2 * count);
  std::vector<double> sines(2 * count);
  for (std::size_t k = 0; k < 2 * count; ++k) {
    const double phi = (static_cast<double>(k) + 0.5) * step;
    cosines[k] = portable::cos(phi);
    sines[k] = portable::sin(phi);
  }
  const Sums sums =
      execution.parallel_sum(count, 4, Sums(Sums::Zero()), [&](std::size_t begin, std::size_t end) {
        Sums part = Sums::Zero();
        std::vector<Vector3> directions(2 * count);
        std::vector<RadialJet> jets(2 * count);
        for (std::size_t ring = begin; ring < end; ++ring) {
          const double theta = (static_cast<double>(ring) + 0.5) * step;
          const double sine = portable::sin(theta);
          const double cosine = portable::cos(theta);
          for (std::size_t k = 0; k < 2 * count; ++k) {
            directions[k] = {sine * cosines[k], sine * sines[k], cosine};
          }
          surface.evaluate(directions.data(), directions.size(), Derivatives::First, jets.data());
          for (std::size_t k = 0; k < 2 * count; ++k) {
            const Vector3 south(cosine * cosines[k], cosine * sines[k], -sine);
            const Vector3 east(-sines[k], cosines[k], 0.0);
            const double r_theta = jets[k].gradient.dot(south);
            const double r_phi = sine * jets[k].gradient.dot(east);
            part += Sums(r_theta * r_theta + r_phi * r_phi, sine * area_element(jets[k]));
          }
        }
        return part;
      });
  return std::sqrt(sums[0] / sums[1]);
}

}  // namespace wscvt
