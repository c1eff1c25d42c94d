// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/offset_surface.h"

#include <cmath>

#include "toolbox/map/mapped_surface.h"
#include "toolbox/map/sphere_map.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

constexpr double smallest_along = 0.2;  ///< from here on r(u) is the component along u
constexpr int coarse_degree = 24;       ///< of the series to be smoothed
constexpr int coarse_rows = 72;
constexpr int check_frequency = 16;
/// Smallest solid angle of a mapped triangle / its solid angle on the sphere.
constexpr double smallest_part = 0.1;
/// Above it the series is an ellipsoid, whose directions are one to one.
constexpr double most_smoothing = 8.0;
constexpr double least_smoothing = 1e-4;

/// Returns the series of x, y and z of a surface, times `scale`.
OffsetSeries coordinate_series(const HarmonicGrid& grid, const std::vector<Vector3>& points,
                               double scale) {
  OffsetSeries series;
  std::vector<double> values(points.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      values[k] = scale * points[k][axis];
    }
    series[axis] = grid.coefficients(values);
  }
  return series;
}

/// Returns t above the limit. Below it, a positive function joins smoothly, with a slope of at most
/// 1, so that radii of two surfaces differ by no more than their points.
double radius_along(double along) {
  return along > smallest_along ? along
                                : smallest_along * portable::exp(along / smallest_along - 1.0);
}

OffsetSeries smoothed(OffsetSeries series, double smoothing) {
  for (std::vector<double>& coordinate : series) {
    for (std::size_t l = 0; l * l < coordinate.size(); ++l) {
      const auto order = static_cast<double>(l * (l + 1));
      // Degree 1, an ellipsoid, stays.
      const double factor = portable::exp(-smoothing * std::abs(order - 2.0));
      for (std::size_t k = l * l; k < (l + 1) * (l + 1); ++k) coordinate[k] *= factor;
    }
  }
  return series;
}

std::vector<Vector3> directions_of(const OffsetSeries& series, const std::vector<Vector3>& places) {
  std::vector<Vector3> directions = offset_values(series, places);
  for (Vector3& direction : directions) direction.normalize();
  return directions;
}

/// Whether no triangle of the sphere is turned over or collapsed.
bool is_one_to_one(const OffsetSeries& series, const IndexedMesh& sphere) {
  const std::vector<Vector3> to = directions_of(series, sphere.points);
  const auto volume = [](const std::vector<Vector3>& p, const Triangle& t) {
    return p[t[0]].dot(p[t[1]].cross(p[t[2]]));
  };
  for (const Triangle& t : sphere.triangles) {
    if (!(volume(to, t) > smallest_part * volume(sphere.points, t))) return false;
  }
  return true;
}

/// Returns the least smoothing for a star-shaped surface, to 5 %; the largest if none is enough.
double smoothing_of(const OffsetSeries& series) {
  const IndexedMesh sphere = subdivided_sphere(check_frequency);
  double low = least_smoothing, high = most_smoothing;
  if (is_one_to_one(smoothed(series, low), sphere)) return low;
  while (high > 1.05 * low) {
    const double middle = std::sqrt(low * high);
    (is_one_to_one(smoothed(series, middle), sphere) ? high : low) = middle;
  }
  return high;
}

}  // namespace

double rms_offset(const OffsetSeries& offset) {
  double sum = 0.0;
  for (const std::vector<double>& series : offset) {
    for (const double coefficient : series) sum += coefficient * coefficient;
  }
  return std::sqrt(sum / (4.0 * pi));
}

RadiiAndOffsets split_points(const std::vector<Vector3>& points,
                             const std::vector<Vector3>& directions) {
  RadiiAndOffsets parts;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double radius = radius_along(points[k].dot(directions[k]));
    const Vector3 offset = points[k] - radius * directions[k];
    parts.radii.push_back(radius);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      parts.offsets[axis].push_back(offset[axis]);
    }
  }
  return parts;
}

std::vector<Vector3> offset_values(const OffsetSeries& offset,
                                   const std::vector<Vector3>& directions) {
  std::vector<Vector3> offsets(directions.size());
  std::vector<double> values(directions.size());
  for (int axis = 0; axis < 3; ++axis) {
    HarmonicSeries(offset[axis]).sum(directions.data(), directions.size(), values.data());
    for (std::size_t k = 0; k < offsets.size(); ++k) offsets[k][axis] = values[k];
  }
  return offsets;
}

std::vector<Vector3> surface_points(const std::vector<double>& radial, const OffsetSeries& offset,
                                    const std::vector<Vector3>& directions) {
  std::vector<double> radii(directions.size());
  HarmonicSeries(radial).sum(directions.data(), directions.size(), radii.data());
  std::vector<Vector3> points = directions;
  for (std::size_t k = 0; k < points.size(); ++k) points[k] *= radii[k];
  if (!has_offset(offset)) return points;
  const std::vector<Vector3> offsets = offset_values(offset, directions);
  for (std::size_t k = 0; k < points.size(); ++k) points[k] += offsets[k];
  return points;
}

HarmonicMap harmonic_map_of(const std::vector<double>& radial, const OffsetSeries& offset,
                            double scale) {
  int degree = 0;
  while (harmonic_count(degree) < radial.size()) ++degree;
  // r(u) u has a degree one above r.
  const HarmonicGrid grid(degree + 1, degree + 2);
  const std::vector<Vector3> points = surface_points(radial, offset, grid.directions());
  return HarmonicMap(coordinate_series(grid, points, scale));
}

OffsetSeries mirrored_offset(const OffsetSeries& offset, const Vector3& signs) {
  OffsetSeries image = offset;
  if (!has_offset(offset)) return image;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image[axis] = mirrored(offset[axis], signs);
    for (double& coefficient : image[axis]) coefficient *= signs[axis];
  }
  return image;
}

MappedSurface spread_over_directions(const IndexedMesh& mesh, const Execution& execution) {
  std::vector<Vector3> places = map_to_sphere(mesh, execution);
  const HarmonicGrid grid(coarse_degree, coarse_rows);
  OffsetSeries series;
  {
    const MappedSurface surface(mesh, places, execution);
    const std::vector<Vector3> points = surface.positions(grid.directions(), execution);
    series = coordinate_series(grid, points, 1.0);
  }
  for (double smoothing = smoothing_of(series);; smoothing *= 1.5) {
    try {
      return {mesh, directions_of(smoothed(series, smoothing), places), execution};
    } catch (const Error& error) {
      // A triangle is turned over between the tested points.
      if (error.code() != ErrorCode::InvalidInput) throw;
      if (smoothing > most_smoothing) {
        refuse(
            "The overhangs of the grain are too deep to grow grains from it. Leave it out of "
            "the sample.");
      }
    }
  }
}

}  // namespace wscvt
