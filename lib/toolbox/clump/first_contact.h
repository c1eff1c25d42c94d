// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "toolbox/clump/sphere.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptors.h"

namespace wscvt {

/// Converts a grain's coordinates to its principal axes about the centroid, in equivalent radii.
struct UnitFrame {
  Vector3 centroid;
  Eigen::Matrix3d axes;  ///< columns: the principal axes
  double radius;

  explicit UnitFrame(const ShapeDescriptors& grain)
      : centroid(grain.centroid),
        axes(grain.principal_axes.toRotationMatrix()),
        radius(equivalent_radius(grain.volume)) {}

  Vector3 to_unit(const Vector3& p) const { return axes.transpose() * (p - centroid) / radius; }
  Vector3 to_scan(const Vector3& p) const { return centroid + radius * (axes * p); }
  IndexedMesh to_unit(IndexedMesh mesh) const {
    for (Vector3& p : mesh.points) p = to_unit(p);
    return mesh;
  }
};

/// Error of first contact over pairs of poses, in % of the equivalent radius: the centroids'
/// distance at which two equal bodies touch, less this distance for the scans. Below 0 the bodies
/// come nearer than the scans can: they hide overlap.
struct ContactError {
  double mean = 0.0;
  double scatter = 0.0;  ///< standard deviation about the mean
};

/// Errors without sign over pairs of poses.
struct ContactSpread {
  double median = 0.0;
  double percent_90 = 0.0;  ///< 90 % of the contacts have a smaller error
};

/// Errors of first contacts against the scans': in % of the equivalent radius, and degrees.
struct TouchErrors {
  ContactSpread gap;     ///< of the centroids' distance; %
  ContactSpread place;   ///< distance of the places of contact; %
  ContactSpread normal;  ///< angle between the normals; degrees
};

/// First contact of two bodies that approach each other along z.
struct FirstTouch {
  double distance = 0.0;             ///< of the origins
  Vector3 place = Vector3::Zero();   ///< from the lower origin
  Vector3 normal = Vector3::Zero();  ///< unit, upwards: mean of the two surfaces' own
  bool touches = false;              ///< false if they pass each other, as bodies with a hole may
};

/// Returns the errors over the pairs in which both touch.
TouchErrors touch_errors(const std::vector<FirstTouch>& touches,
                         const std::vector<FirstTouch>& scan);

/// Heights above a plane through the origin, and depths below it, of a body of equivalent radius 1
/// about the origin, in random but fixed directions. If two bodies approach each other along a line
/// through both origins, they touch at the largest sum of height and depth.
class ContactHeights {
 public:
  static constexpr int poses = 32;
  static constexpr int pixels = 256;

  /// Measures heights within `reach` of the origin; bodies that are compared need the same reach.
  ContactHeights(const IndexedMesh& mesh, double reach, const Execution& execution);
  ContactHeights(const std::vector<Sphere>& spheres, double reach, const Execution& execution);

  /// Returns the distances of the origins at first contact, for each pose against each other pose;
  /// below -1e20 if the bodies pass each other, as bodies with a hole may.
  std::vector<double> distances(const Execution& execution) const;

  /// Returns the contacts of this body, below, with another one of the same reach, above; in the
  /// same order. Slopes are differences over two pixels, a 64th of the reach.
  std::vector<FirstTouch> touches(const ContactHeights& other, const Execution& execution) const;

 private:
  struct Map {
    std::vector<float> top;
    std::vector<float> bottom;
  };
  template <class Draw>
  void draw_poses(const Execution& execution, const Draw& draw);
  /// Returns below and above of a pair.
  std::pair<std::size_t, std::size_t> poses_of(std::size_t pair) const;
  double reach_ = 0.0;
  std::vector<Map> maps_;
};

/// Returns the error of distances against the scan's, over the pairs in which both touch.
ContactError contact_error(const std::vector<double>& distances, const std::vector<double>& scan);

/// First contact of two copies of a scan, the reference for remeshes, over 992 random but fixed
/// pairs of poses.
class ScanContacts {
 public:
  /// The scan is closed and outward, in any unit; `shape` has its descriptors.
  ScanContacts(const IndexedMesh& scan, const ShapeDescriptors& shape, const Execution& execution);

  /// Errors of a remesh.
  struct Errors {
    ContactError distance;  ///< two remeshes
    TouchErrors two_sided;  ///< two remeshes
    TouchErrors one_sided;  ///< the remesh below, the scan above
  };
  /// Returns the errors of a remesh in the scan's coordinates. If scan and remesh are moved, turned
  /// or scaled together, the errors stay the same, but for rounding.
  Errors errors_of(const IndexedMesh& remesh, const Execution& execution) const;

 private:
  UnitFrame frame_;
  double reach_ = 0.0;
  std::optional<ContactHeights> heights_;
  std::vector<FirstTouch> touches_;
};

}  // namespace wscvt
