// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "toolbox/clump/clump_fit.h"
#include "toolbox/clump/clump_options.h"
#include "toolbox/clump/first_contact.h"
#include "toolbox/clump/sphere.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/repair/scan_options.h"

namespace wscvt {

/// Errors of mass properties against the grain's.
struct MassError {
  double volume_percent = 0.0;    ///< 100 (volume / the grain's - 1)
  double centroid_percent = 0.0;  ///< distance of the centroids, in % of the equivalent radius
  double inertia_percent = 0.0;   ///< see inertia_error_percent
};

/// Mass properties at unit density that an engine may use for the grain, and their error.
struct SphereMass {
  MassProperties mass;
  MassError error;
};

/// A clump and its errors, in the scan's units and coordinates.
struct ClumpResult {
  std::vector<Sphere> spheres;
  double equivalent_radius = 0.0;  ///< of the grain
  double rms_distance = 0.0;       ///< from scan to clump, see union_distance; length
  double largest_distance = 0.0;   ///< from scan to clump; length
  /// Volume of the intersection of grain and clump / volume of their union, from 60,000 points of a
  /// grid.
  double intersection_over_union = 0.0;
  std::vector<ClumpStage> stages;  ///< error for each number of spheres
  ContactError contact;            ///< first contact of two such clumps
  SphereMass united;               ///< of the union of the spheres
  SphereMass summed;               ///< of the sum of the spheres; overlaps count repeatedly
  MeshCheckReport input;           ///< repairs of the scan, and its measures
  ShapeDescriptors scan;  ///< of the repaired scan: the mass properties that a clump should have
  IndexedMesh repaired_scan;
  IndexedMesh surface;  ///< of the union, see sphere_union_mesh
  ClumpOptions options;
  std::vector<Sentence> warnings;  ///< sentences for the user
};

/// Makes a clump of a scan, which is repaired as in remesh(). Choose K by its error of first
/// contact, which is measured over 992 random but fixed pairs of poses.
///
/// Invariant: a scan that is moved, turned or scaled gives the same clump, moved, turned or scaled,
/// but for rounding. The result does not depend on the number of threads. Throws Error as
/// check_clump_options, repair_scan and fit_spheres do.
ClumpResult make_clump(IndexedMesh scan, const ClumpOptions& options, const Execution& execution);

}  // namespace wscvt
