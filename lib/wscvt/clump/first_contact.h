// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/clump/sphere.h"

namespace wscvt {

/// Error of first contact over pairs of poses: the distance of the centroids at which two equal
/// bodies touch, less that of the scans; in % of the equivalent radius. Below 0 the bodies come
/// nearer than the scans can: they hide overlap.
struct ContactError {
  double mean = 0.0;
  double scatter = 0.0;  ///< standard deviation about the mean
};

/// A body of equivalent radius 1 about the origin, seen from random directions, always the same
/// ones: its heights above a plane through the origin, and its depths below. Two bodies that near
/// each other along a line through both origins touch where height and depth together are largest.
class ContactHeights {
 public:
  static constexpr int poses = 32;
  static constexpr int pixels = 256;

  /// Heights within `reach` of the origin; those of bodies that are compared must have the same.
  ContactHeights(const IndexedMesh& mesh, double reach, const Execution& execution);
  ContactHeights(const std::vector<Sphere>& spheres, double reach, const Execution& execution);

  /// Distances of the origins at first contact, of each pose against each other one; below -1e20
  /// where the bodies pass each other, as those with a hole may.
  std::vector<double> distances(const Execution& execution) const;

 private:
  struct Map {
    std::vector<float> top;
    std::vector<float> bottom;
  };
  std::vector<Map> maps_;
};

/// Of distances against those of the scan, over the pairs in which both touch.
ContactError contact_error(const std::vector<double>& distances, const std::vector<double>& scan);

}  // namespace wscvt
