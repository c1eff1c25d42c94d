// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/sample_grain.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "toolbox/map/mapped_surface.h"
#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/option.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/repair/handles.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/sphere/sphere_triangulation.h"
#include "wscvt/surface/mesh_surface.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {

namespace {

/// Stretching moves waves to higher degrees. Truncated at degree + 4, white grains lose sharp
/// edges.
int white_degree_of(int degree) { return degree + (3 * degree + 4) / 5; }

int checked_degree(int degree) {
  require_in_range(degree, sample_degree_option);
  return degree;
}

/// Products of two series are integrated exactly, and waves beyond the degree do not alias into the
/// low degrees.
int rows_of(int degree) { return 3 * (degree + 1) / 2 + 1; }
/// Mesh of a series: 16,002 points.
constexpr int mesh_frequency = 40;
/// Mesh on which candidates are measured: 1,002 points.
constexpr int measuring_frequency = 10;

int fine_rows_of(int degree) { return std::max(96, 4 * (degree + 1)); }

std::vector<double> logarithms(std::vector<double> values) {
  for (double& value : values) value = portable::log(value);
  return values;
}

/// Returns right-handed principal axes as columns, longest first; see principal_axes.
Eigen::Matrix3d axes_of(const HarmonicGrid& grid, const std::vector<double>& radii,
                        const RadialMoments& moments) {
  const Eigen::Matrix3d inertia =
      moments.volume *
      (moments.covariance.trace() * Eigen::Matrix3d::Identity() - moments.covariance);
  const auto moments_along = [&](const Eigen::Matrix<double, 3, 2>& axes) {
    AxisMoments sums;
    sums.volume = moments.volume;
    // For the cone under a patch, the integral of ((p - c) . a)^3 dV from the origin to the
    // surface.
    const Eigen::Array2d c = axes.transpose() * moments.centroid;
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const Eigen::Array2d p = radii[k] * (axes.transpose() * grid.directions()[k]);
      const Eigen::Array2d cubes =
          p.cube() / 6.0 - 0.6 * p.square() * c + 0.75 * p * c.square() - c.cube() / 3.0;
      sums.third += grid.weights()[k] * radii[k] * radii[k] * radii[k] * cubes.matrix();
    }
    return sums;
  };
  return principal_axes(inertia, moments_along).toRotationMatrix();
}

std::optional<SampleGrain> star_shaped_grain(const HarmonicSurface& surface,
                                             const SampleGrids& grids) {
  const HarmonicGrid& grid = grids.fine_radial();
  std::vector<double> radii(grid.directions().size());
  surface.evaluate_radii(grid.directions().data(), radii.size(), radii.data());
  for (const double radius : radii) {
    if (!(radius > 0.0)) {
      refuse("The series of the grain is not positive everywhere. Leave it out of the sample.");
    }
  }
  const RadialMoments moments = radial_moments(grid, radii);
  SampleGrain grain;
  grain.radius = equivalent_radius(moments.volume);
  const Eigen::Matrix3d axes = axes_of(grid, radii, moments);
  const LogRadii log_radii = [&](const std::vector<Vector3>& directions,
                                 std::vector<double>& values) {
    surface.evaluate_radii(directions.data(), directions.size(), values.data());
    for (double& value : values) {
      if (!(value > 0.0)) return false;
      value = portable::log(value);
    }
    return true;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 a = axes.col(axis);
    grain.deviations[axis] = std::sqrt(a.dot(moments.covariance * a)) / grain.radius;
  }
  const auto radial =
      radii_in_frame(log_radii, moments.centroid, axes * grain.radius, grids.radial().directions());
  const Eigen::Matrix3d stretch =
      axes * (grain.radius * std::sqrt(5.0) * grain.deviations).asDiagonal();
  const auto white =
      radii_in_frame(log_radii, moments.centroid, stretch, grids.white().directions());
  if (!radial || !white) return {};
  grain.radial = grids.radial().coefficients(*radial);
  grain.white = grids.white().coefficients(logarithms(*white));
  return grain;
}

/// Computes the series of r(u) and o(u) of a surface given in the directions of the grid.
void set_series(const HarmonicGrid& grid, const std::vector<Vector3>& points, bool of_logarithm,
                std::vector<double>& radial, OffsetSeries& offset) {
  RadiiAndOffsets parts = split_points(points, grid.directions());
  radial =
      grid.coefficients(of_logarithm ? logarithms(std::move(parts.radii)) : std::move(parts.radii));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    offset[axis] = grid.coefficients(std::move(parts.offsets[axis]));
  }
}

IndexedMesh without_handles(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t handles = genus_of(mesh);
  if (handles > most_handles_cut) {
    refuse("The grain has overhangs and " + std::to_string(handles) +
           " handles: it is porous. Use its shrink-wrap, or leave it out of the sample.");
  }
  const HandleFreeMesh cut = remove_handles(mesh, HandleOptions(), execution);
  if (cut.report.kept > 0) {
    refuse("The grain has overhangs and a handle with a loop of " +
           format_number(cut.report.next.length) +
           ", too long to be cut. Leave it out of the sample.");
  }
  return cut.mesh;
}

/// Reads a grain with overhangs; `standing` is scaled to radius 1.
void read_with_offsets(SampleGrain& grain, const IndexedMesh& standing, const Vector3& semi_axes,
                       const SampleGrids& grids, const Execution& execution) {
  IndexedMesh white = standing;
  for (Vector3& point : white.points) point = point.cwiseQuotient(semi_axes);
  const MappedSurface surface = spread_over_directions(white, execution);
  const HarmonicGrid& fine_white = grids.fine_white();
  set_series(fine_white, surface.positions(fine_white.directions(), execution), true, grain.white,
             grain.white_offset);
  // The directions of the grain itself are the white grain's, stretched like the grain.
  std::vector<Vector3> directions = grids.fine_radial().directions();
  for (Vector3& direction : directions) direction = direction.cwiseQuotient(semi_axes).normalized();
  std::vector<Vector3> points = surface.positions(directions, execution);
  for (Vector3& point : points) point = point.cwiseProduct(semi_axes);
  set_series(grids.fine_radial(), points, false, grain.radial, grain.radial_offset);
}

SampleGrain measured(SampleGrain grain, const SampleGrids& grids) {
  const IndexedMesh mesh{surface_points(grain.radial, grain.radial_offset, grids.sphere().points),
                         grids.sphere().triangles};
  if (has_offset(grain.radial_offset) && !self_intersections(mesh).empty()) {
    refuse("The series of degree " + std::to_string(grids.degree()) +
           " of the grain intersects itself, because walls of the grain are thin. Give a higher " +
           mention("degree") + ", or leave the grain out of the sample.");
  }
  const QuickShape quick = quick_shape(mesh, Execution(1));
  grain.sphericity = quick.shape.sphericity;
  grain.convexity = quick.convexity;
  return grain;
}

}  // namespace

QuickShape quick_shape(const IndexedMesh& mesh, const Execution& execution) {
  QuickShape quick;
  quick.shape = describe_shape(mesh, execution);
  const Vector3& axes = quick.shape.inertia_semi_axes;
  quick.form = form_ratios({axes[0], axes[1], axes[2]});
  quick.convexity = quick.shape.volume / volume_of(convex_hull(mesh.points, execution), execution);
  return quick;
}

SampleGrids::SampleGrids(int degree)
    : radial_(checked_degree(degree), rows_of(degree)),
      white_(white_degree_of(degree), rows_of(white_degree_of(degree))),
      fine_radial_(degree, fine_rows_of(degree)),
      fine_white_(white_degree_of(degree), fine_rows_of(degree)),
      sphere_(subdivided_sphere(measuring_frequency)) {}

std::optional<std::vector<double>> radii_in_frame(const LogRadii& surface, const Vector3& centre,
                                                  const Eigen::Matrix3d& axes,
                                                  const std::vector<Vector3>& directions) {
  constexpr int most_steps = 60;
  constexpr double tolerance = 1e-9;
  std::vector<double> radii(directions.size(), 0.0);
  std::vector<std::size_t> open(directions.size());
  for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
  std::vector<Vector3> rays;
  std::vector<double> values;
  for (int step = 0; step < most_steps && !open.empty(); ++step) {
    rays.clear();
    for (const std::size_t k : open) {
      const Vector3 ray = axes * directions[k];
      rays.push_back(radii[k] == 0.0 ? ray : centre + radii[k] * ray);
    }
    std::vector<Vector3> units = rays;
    for (Vector3& unit : units) unit.normalize();
    values.resize(units.size());
    if (!surface(units, values)) return {};
    std::size_t kept = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const std::size_t k = open[i];
      const double ratio = portable::exp(values[i]) / rays[i].norm();
      radii[k] = radii[k] == 0.0 ? ratio : radii[k] * ratio;
      if (!(radii[k] > 0.0 && std::isfinite(radii[k]))) return {};
      if (step == 0 || std::abs(ratio - 1.0) > tolerance) open[kept++] = k;
    }
    open.resize(kept);
  }
  if (!open.empty()) return {};
  return radii;
}

SampleGrain sample_grain(const HarmonicSurface& surface, const SampleGrids& grids,
                         const Execution& execution) {
  if (std::optional<SampleGrain> grain = star_shaped_grain(surface, grids)) {
    return measured(std::move(*grain), grids);
  }
  // It has overhangs about its centroid, so its mesh is read like a scan.
  return sample_grain(mesh_of_surface(surface, mesh_frequency, execution), grids, execution);
}

SampleGrain sample_grain(const IndexedMesh& mesh, const SampleGrids& grids,
                         const Execution& execution) {
  const ShapeDescriptors shape = describe_shape(mesh, execution);
  const double fold = overhang_solid_angle(mesh, shape.centroid, execution);
  const bool has_overhangs = 100.0 * fold > usual_overhang_limit_percent;
  if (has_overhangs && genus_of(mesh) > 0) {
    return sample_grain(without_handles(mesh, execution), grids, execution);
  }
  SampleGrain grain;
  grain.radius = equivalent_radius(shape.volume);
  const Vector3 semi_axes = shape.inertia_semi_axes.reverse() / grain.radius;
  grain.deviations = semi_axes / std::sqrt(5.0);
  const Eigen::Matrix3d turn = shape.principal_axes.toRotationMatrix().transpose();
  IndexedMesh standing = mesh;
  for (Vector3& point : standing.points) point = turn * (point - shape.centroid) / grain.radius;
  if (has_overhangs) {
    read_with_offsets(grain, standing, semi_axes, grids, execution);
    return measured(std::move(grain), grids);
  }
  const auto read = [&](const HarmonicGrid& grid) {
    const MeshSurface rays(standing, Vector3::Zero(), 1.0, fold, execution);
    return rays.radii(grid.directions(), execution);
  };
  grain.radial = grids.fine_radial().coefficients(read(grids.fine_radial()));
  for (Vector3& point : standing.points) point = point.cwiseQuotient(semi_axes);
  grain.white = grids.fine_white().coefficients(logarithms(read(grids.fine_white())));
  return measured(std::move(grain), grids);
}

}  // namespace wscvt
