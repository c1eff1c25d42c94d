// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/feret_diameters.h"
#include "wscvt/measures/form_axes.h"
#include "wscvt/measures/inscribed_sphere.h"
#include "wscvt/measures/printed_sdq.h"
#include "wscvt/measures/roughness.h"
#include "wscvt/measures/roundness.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

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
