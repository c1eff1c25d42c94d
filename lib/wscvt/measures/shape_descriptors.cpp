// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

namespace {

constexpr std::size_t descriptor_block = 8192;

/// The clip of Sdq: smallest cosine between normal and radius.
constexpr double smallest_cosine = 0.05;

/// Moments of volume about a local origin up to the second, and the area. MeshSums has only the
/// first moment.
struct VolumeMoments {
  double volume = 0.0;
  double area = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

  VolumeMoments& operator+=(const VolumeMoments& other) {
    volume += other.volume;
    area += other.area;
    first += other.first;
    second += other.second;
    return *this;
  }
};

/// Returns the mean of the vertices. It is near the centroid, against cancellation for a grain far
/// from 0.
Vector3 local_origin(const IndexedMesh& mesh, const Execution& execution) {
  if (mesh.points.empty()) return Vector3::Zero();
  const Vector3 start = mesh.points.front();
  const Vector3 sum = execution.parallel_sum_of(
      mesh.points.size(), descriptor_block, Vector3(Vector3::Zero()),
      [&](std::size_t i, Vector3& part) { part += mesh.points[i] - start; });
  return start + sum / static_cast<double>(mesh.points.size());
}

/// Returns the corners of a face relative to a point.
std::array<Vector3, 3> corners_about(const Vector3& point, const IndexedMesh& mesh,
                                     std::size_t face) {
  const auto [a, b, c] = corners_of(mesh, face);
  return {a - point, b - point, c - point};
}

/// Sums over the tetrahedra of the faces and `origin`.
VolumeMoments volume_moments(const IndexedMesh& mesh, const Vector3& origin,
                             const Execution& execution) {
  return execution.parallel_sum_of(
      mesh.triangles.size(), descriptor_block, VolumeMoments(),
      [&](std::size_t f, VolumeMoments& part) {
        const auto [a, b, c] = corners_about(origin, mesh, f);
        const Vector3 normal = doubled_area_normal(a, b, c);
        const double determinant = a.dot(normal);  // six volumes; the normal is needed anyway
        const Vector3 sum = a + b + c;
        part.volume += determinant / 6.0;
        part.area += 0.5 * normal.norm();
        part.first += determinant / 24.0 * sum;
        part.second +=
            determinant / 120.0 *
            (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
      });
}

/// A warning is given if halving the clip changes Sdq by more than this fraction.
constexpr double told_clip_change = 0.02;

/// Integral of |grad_Omega r|^2 dOmega, with either clip, and its part from clipped faces.
struct GradientSquares {
  double whole = 0.0;
  double clipped = 0.0;
  double with_half_clip = 0.0;

  GradientSquares& operator+=(const GradientSquares& other) {
    whole += other.whole;
    clipped += other.clipped;
    with_half_clip += other.with_half_clip;
    return *this;
  }
};

/// Computes them about `centre`, face by face.
GradientSquares gradient_squares(const IndexedMesh& mesh, const Vector3& centre,
                                 const Execution& execution) {
  return execution.parallel_sum_of(mesh.triangles.size(), descriptor_block, GradientSquares(),
                                   [&](std::size_t f, GradientSquares& part) {
                                     const auto [a, b, c] = corners_about(centre, mesh, f);
                                     const Vector3 doubled_area = doubled_area_normal(a, b, c);
                                     const double area = 0.5 * doubled_area.norm();
                                     const Vector3 radius = a + b + c;
                                     const double length = radius.norm();
                                     if (!(area > 0.0) || !(length > 0.0)) return;
                                     const double cosine =
                                         doubled_area.dot(radius) / (2.0 * area * length);
                                     const auto square = [area, cosine](double clip) {
                                       const double q = std::clamp(cosine, clip, 1.0);
                                       return area * (1.0 - q * q) / q;
                                     };
                                     const double whole = square(smallest_cosine);
                                     part.whole += whole;
                                     if (cosine < smallest_cosine) part.clipped += whole;
                                     part.with_half_clip += square(0.5 * smallest_cosine);
                                   });
}

/// Sums over the tetrahedra of the faces and the centroid. A coordinate is linear in each
/// tetrahedron, with the values 0, a, b and c at its corners. The mean of its cube is then 1/20 of
/// the sum of all products of three of the values, aaa + aab + ... + ccc.
AxisMoments moments_along(const Eigen::Matrix<double, 3, 2>& axes, const IndexedMesh& mesh,
                          const Vector3& centroid, const Execution& execution) {
  return execution.parallel_sum_of(
      mesh.triangles.size(), descriptor_block, AxisMoments(),
      [&](std::size_t f, AxisMoments& part) {
        const auto [corner_a, corner_b, corner_c] = corners_about(centroid, mesh, f);
        const Eigen::Array2d a = axes.transpose() * corner_a;
        const Eigen::Array2d b = axes.transpose() * corner_b;
        const Eigen::Array2d c = axes.transpose() * corner_c;
        const double volume = six_volumes(corner_a, corner_b, corner_c) / 6.0;
        const Eigen::Array2d products = (a * a + b * b + c * c) * (a + b + c) + a * b * c;
        part.volume += volume;
        part.third += (volume / 20.0 * products).matrix();
      });
}

}  // namespace

ShapeDescriptors describe_shape(const IndexedMesh& mesh, const Execution& execution) {
  const Vector3 origin = local_origin(mesh, execution);
  const VolumeMoments moments = volume_moments(mesh, origin, execution);
  if (!(moments.volume > 0.0)) {
    refuse(
        "The mesh encloses no positive volume, so it has no shape descriptors. Give a closed mesh "
        "whose faces look outward.");
  }

  ShapeDescriptors result;
  result.volume = moments.volume;
  result.area = moments.area;
  const double side = portable::cbrt(moments.volume);
  result.sphericity = portable::cbrt(36.0 * pi) * side * side / moments.area;
  const Vector3 centroid = moments.first / moments.volume;
  result.centroid = origin + centroid;

  // A homogeneous ellipsoid with semi-axis a along x has mean x^2 = a^2 / 5.
  const Matrix3 second = moments.second / moments.volume - centroid * centroid.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(second, Eigen::EigenvaluesOnly);
  result.inertia_semi_axes = (5.0 * solver.eigenvalues().cwiseMax(0.0)).cwiseSqrt();
  result.inertia_tensor = moments.volume * (second.trace() * Matrix3::Identity() - second);
  result.principal_axes =
      principal_axes(result.inertia_tensor, [&](const Eigen::Matrix<double, 3, 2>& axes) {
        return moments_along(axes, mesh, result.centroid, execution);
      });
  result.aspect_ratio = result.inertia_semi_axes[0] / result.inertia_semi_axes[2];

  const GradientSquares squares = gradient_squares(mesh, result.centroid, execution);
  result.sdq = std::sqrt(squares.whole / moments.area);
  result.sdq_half_clip = std::sqrt(squares.with_half_clip / moments.area);
  if (squares.whole > 0.0) result.sdq_clipped_fraction = squares.clipped / squares.whole;
  return result;
}

std::string sdq_clip_sentence(const std::string& grain, const ShapeDescriptors& descriptors) {
  const double change = descriptors.sdq_half_clip / descriptors.sdq - 1.0;
  if (!(change > told_clip_change)) return {};
  return "Sdq (invariant form) of " + grain +
         " is not reliable: parts of the surface lie along rays from the centroid. " +
         format_percent(descriptors.sdq_clipped_fraction) +
         " of its square comes from faces at the smallest cosine, " +
         format_number(smallest_cosine) + ". With half that cosine Sdq is " +
         format_percent(change) + " larger. Do not compare it with other grains.";
}

double relative_error_percent(double value, double reference) {
  if (value == reference) return 0.0;
  return without_rounding(100.0 * (value / reference - 1.0), 1.0);
}

double inertia_error_percent(const ShapeDescriptors& value, const ShapeDescriptors& reference) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(reference.inertia_tensor);
  const Matrix3 difference = solver.eigenvectors().transpose() *
                             (value.inertia_tensor - reference.inertia_tensor) *
                             solver.eigenvectors();
  return 100.0 * difference.cwiseAbs().maxCoeff() / solver.eigenvalues()[2];
}

void scale(ShapeDescriptors& descriptors, double unit, const Vector3& centre) {
  descriptors.volume *= unit * unit * unit;
  descriptors.area *= unit * unit;
  descriptors.centroid = centre + unit * descriptors.centroid;
  descriptors.inertia_semi_axes *= unit;
  descriptors.inertia_tensor *= portable::pow(unit, 5);
}

MassProperties mass_properties(const ShapeDescriptors& descriptors) {
  const Eigen::Matrix3d turn = descriptors.principal_axes.toRotationMatrix();
  return {descriptors.volume, descriptors.centroid, descriptors.inertia_tensor,
          (turn.transpose() * descriptors.inertia_tensor * turn).diagonal(),
          descriptors.principal_axes};
}

namespace {

/// Below this skewness along an axis, a body counts as symmetric there. Rounding errors are
/// smaller.
constexpr double smallest_skewness = 1e-9;

/// Returns the axis or its opposite. `skewness` (no unit) is the third moment of the body's points
/// along the axis over the cube of their spread.
Vector3 with_sign(const Vector3& axis, double skewness) {
  if (std::abs(skewness) > smallest_skewness) return skewness > 0.0 ? axis : Vector3(-axis);
  Eigen::Index largest = 0;
  // Components that differ only by rounding count as equal.
  for (Eigen::Index k = 1; k < 3; ++k) {
    if (std::abs(axis[k]) > std::abs(axis[largest]) + smallest_skewness) largest = k;
  }
  return axis[largest] > 0.0 ? axis : Vector3(-axis);
}

}  // namespace

Eigen::Quaterniond principal_axes(
    const Eigen::Matrix3d& inertia_tensor,
    const std::function<AxisMoments(const Eigen::Matrix<double, 3, 2>& axes)>& moments_along) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia_tensor);
  const Vector3& moments_of_inertia = solver.eigenvalues();
  const AxisMoments moments = moments_along(solver.eigenvectors().leftCols<2>());
  Eigen::Matrix3d axes;
  for (int k = 0; k < 2; ++k) {
    // The second moment along an axis follows from the moments of inertia: integral of x_k^2 dV =
    // (I_1 + I_2 + I_3) / 2 - I_k.
    const double second = 0.5 * moments_of_inertia.sum() - moments_of_inertia[k];
    const double skewness =
        moments.third[k] * std::sqrt(moments.volume) / portable::pow(second, 1.5);
    axes.col(k) = with_sign(solver.eigenvectors().col(k), skewness);
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  Eigen::Quaterniond turn(axes);
  turn.normalize();
  if (turn.w() < 0.0) turn.coeffs() *= -1.0;
  return turn;
}

namespace {

/// Parallels of the midpoint rule for the printed Sdq.
constexpr int printed_sdq_rings = 128;

}  // namespace

DetailedDescriptors describe_shape_in_detail(const IndexedMesh& mesh,
                                             const DetailedOptions& options,
                                             const Execution& execution) {
  require_in_range(options.roundness_ball, roundness_ball_option);
  require_in_range(options.roughness_cutoff, roughness_cutoff_option);
  DetailedDescriptors result;
  execution.report(0.0, "Measuring the shape");
  result.basic = describe_shape(mesh, execution);
  result.equivalent_diameter = portable::cbrt(6.0 * result.basic.volume / pi);
  const Vector3 axes = 2.0 * result.basic.inertia_semi_axes;
  result.inertia_axes = {axes[0], axes[1], axes[2]};
  result.inertia_ratios = form_ratios(result.inertia_axes);
  result.orientation = orientation_tensor(mesh, execution);

  execution.report(0.1, "Measuring the convex hull");
  const IndexedMesh hull = convex_hull(mesh.points, execution);
  result.convexity = std::min(1.0, result.basic.volume / describe_shape(hull, execution).volume);
  execution.report(0.2, "Turning the bounding box");
  result.box_axes = oriented_box_axes(hull.points, execution.part(0.2, 0.25));
  result.box_ratios = form_ratios(result.box_axes);
  result.feret = feret_diameters(mesh, hull, execution.part(0.25, 0.3));
  result.mean_curvature_integral = mean_curvature_integral(mesh, execution);
  result.inscribed_sphere = largest_inscribed_sphere(mesh, execution.part(0.3, 0.7));

  execution.report(0.7, "Measuring roundness");
  result.roundness = wadell_roundness(mesh, result.inscribed_sphere.radius, options.roundness_ball,
                                      execution.part(0.7, 0.8));
  result.least_cutoff = least_cutoff(mesh);
  result.roughness.cutoff = options.roughness_cutoff * 0.5 * result.equivalent_diameter;
  result.has_roughness = result.roughness.cutoff >= result.least_cutoff;
  if (result.has_roughness) {
    result.roughness = surface_roughness(mesh, result.roughness.cutoff, execution.part(0.8, 0.95));
  }

  execution.report(0.95, "Measuring the printed Sdq");
  result.overhang_fraction = overhang_solid_angle(mesh, result.basic.centroid, execution);
  result.has_radius = result.overhang_fraction <= largest_measured_overhang;
  if (result.has_radius) {
    const MeshSurface surface(mesh, result.basic.centroid, 0.5 * result.equivalent_diameter,
                              result.overhang_fraction, execution);
    result.printed_sdq = printed_sdq(surface, printed_sdq_rings, execution);
  }
  execution.report(1.0, "Measuring the shape");
  return result;
}

}  // namespace wscvt
