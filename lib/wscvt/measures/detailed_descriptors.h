// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/form_axes.h"
#include "wscvt/measures/inscribed_sphere.h"
#include "wscvt/measures/orientation_tensor.h"
#include "wscvt/measures/roughness.h"
#include "wscvt/measures/roundness.h"
#include "wscvt/measures/shape_descriptors.h"
#include "wscvt/surface/surface_options.h"

namespace wscvt {

/// What describe_shape_in_detail reads the radius by.
struct DetailedOptions {
  /// Degree of the harmonic series whose curvature roundness reads, 1 to 60.
  int roundness_degree = 15;
  /// Degree of the low-degree shape that roughness is measured from, 0 to 60.
  int roughness_degree = 8;
  /// Gauss-Legendre nodes in cos(theta) of the rays cast, times twice as many azimuths; 16 to 1024,
  /// above both degrees.
  int polar_nodes = 128;
};

inline constexpr NumberOption<int> roundness_degree_option = {
    "roundness-degree",
    "degree for roundness",
    1,
    fit_degree_option.maximum,
    Ends::Both,
    "of the series whose corners roundness reads"};
inline constexpr NumberOption<int> roughness_degree_option = {
    "roughness-degree",
    "degree for roughness",
    0,
    fit_degree_option.maximum,
    Ends::Both,
    "of the smooth shape that roughness is measured from"};
inline constexpr NumberOption<int> polar_nodes_option = {"polar-nodes", "number of polar nodes", 16,
                                                         1024};

/// Share of the solid angle in sheets beyond the first, seen from the volume centroid, above which
/// a body has no radius to be measured by. A crescent, of which 23 % lie behind, would have a
/// roundness of 0.98, the outermost layer's.
inline constexpr double largest_measured_fold = 0.01 * usual_fold_limit_percent;

/// Every shape descriptor of a closed, outward mesh. Formula and source stand here or in the file
/// that computes it: shape_descriptors.h, form_axes.h, inscribed_sphere.h, orientation_tensor.h,
/// roundness.h, roughness.h. lib/README.md has them all in one table.
struct DetailedDescriptors {
  ShapeDescriptors basic;
  /// Of the sphere of equal volume, (6 V / pi)^(1/3): the nominal diameter of Wadell (1932);
  /// length.
  double equivalent_diameter = 0.0;
  /// Full axes of the inertia ellipsoid, twice ShapeDescriptors::inertia_semi_axes.
  FormAxes inertia_axes;
  FormRatios inertia_ratios;  ///< their ratios; sources at FormRatios
  FormAxes box_axes;          ///< edges of the smallest oriented box; source at oriented_box_axes
  FormRatios box_ratios;
  /// V / volume of the convex hull, in (0, 1]; no unit. As in SHAPE (Angelidakis, Nadimi
  /// and Utili 2021; see form_axes.h). Hull by convex_hull.
  double convexity = 0.0;
  InscribedSphere inscribed_sphere;
  OrientationTensor orientation;
  double folded_share = 0.0;  ///< of 4 pi, seen from the volume centroid
  /// Whether those below exist: false when the volume centroid lies outside the body, and where the
  /// surface folds by more than largest_measured_fold. Where it folds by less they see its
  /// outermost layer.
  bool has_radius = false;
  Roundness roundness;       ///< of the fitted series of degree roundness_degree
  int roundness_degree = 0;  ///< as fitted
  Roughness roughness;
  double printed_sdq = 0.0;  ///< the paper's eq. 17, in the mesh's own pose; no unit (roughness.h)
};

/// Measures a closed outward mesh as checked by check_mesh; takes of the order of a second for
/// 100,000 faces. Throws Error(InvalidInput) when the volume is not positive or an option is out of
/// range, Error(NumericalFailure) when a ray from the volume centroid meets no face or no series
/// can be fitted to r(u) (see fit_harmonics), Error(Cancelled).
DetailedDescriptors describe_shape_in_detail(const IndexedMesh& mesh,
                                             const DetailedOptions& options,
                                             const Execution& execution);

}  // namespace wscvt
