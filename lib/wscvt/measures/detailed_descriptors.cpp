// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/pi.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/form_axes.h"
#include "wscvt/measures/inscribed_sphere.h"
#include "wscvt/measures/orientation_tensor.h"
#include "wscvt/measures/roughness.h"
#include "wscvt/measures/roundness.h"
#include "wscvt/scan/folded_solid_angle.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/harmonic_fit.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

namespace {

void check_options(const DetailedOptions& options) {
  require_in_range(options.roundness_degree, roundness_degree_option);
  require_in_range(options.roughness_degree, roughness_degree_option);
  require_in_range(options.polar_nodes, polar_nodes_option);
  const int largest = std::max(options.roundness_degree, options.roughness_degree);
  if (options.polar_nodes <= largest) {
    throw Error(ErrorCode::InvalidInput, "The number of polar nodes is " +
                                             std::to_string(options.polar_nodes) +
                                             "; give more than the degrees, of which one is " +
                                             std::to_string(largest) + ".");
  }
}

/// What is read off r(u), in units of `unit`.
void describe_radius(const IndexedMesh& mesh, const DetailedOptions& options, double unit,
                     const Execution& execution, DetailedDescriptors& result) {
  const MeshSurface surface(mesh, result.basic.centroid, unit, result.folded_share, execution);
  const HarmonicFit fit = fit_harmonics(surface, options.roundness_degree, execution);
  result.roundness_degree = fit.report.degree;
  result.roundness = wadell_roundness(fit.surface, result.inscribed_sphere.radius / unit,
                                      options.polar_nodes, execution);
  result.roughness =
      radial_roughness(surface, options.roughness_degree, options.polar_nodes, execution);
  result.roughness.sa *= unit;
  result.roughness.sq *= unit;
  result.printed_sdq = printed_sdq(surface, options.polar_nodes, execution);
  result.has_radius = true;
}

}  // namespace

DetailedDescriptors describe_shape_in_detail(const IndexedMesh& mesh,
                                             const DetailedOptions& options,
                                             const Execution& execution) {
  check_options(options);
  DetailedDescriptors result;
  execution.report(0.0, "Measuring the shape");
  result.basic = describe_shape(mesh, execution);
  result.equivalent_diameter = std::cbrt(6.0 * result.basic.volume / pi);
  const Vector3 axes = 2.0 * result.basic.inertia_semi_axes;
  result.inertia_axes = {axes[0], axes[1], axes[2]};
  result.inertia_ratios = form_ratios(result.inertia_axes);
  result.orientation = orientation_tensor(mesh, execution);

  execution.report(0.1, "Measuring the convex hull");
  const IndexedMesh hull = convex_hull(mesh.points, execution);
  result.convexity = std::min(1.0, result.basic.volume / describe_shape(hull, execution).volume);
  execution.report(0.2, "Turning the bounding box");
  result.box_axes = oriented_box_axes(hull.points, execution);
  result.box_ratios = form_ratios(result.box_axes);
  result.inscribed_sphere = largest_inscribed_sphere(mesh, execution.part(0.3, 0.8));

  execution.report(0.8, "Measuring roundness and roughness");
  result.folded_share = folded_solid_angle(mesh, result.basic.centroid, execution);
  if (result.folded_share <= largest_measured_fold) {
    describe_radius(mesh, options, 0.5 * result.equivalent_diameter, execution, result);
  }
  execution.report(1.0, "Measuring the shape");
  return result;
}

}  // namespace wscvt
