// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/distances.h"
#include "wscvt/surface/mapped_surface.h"
#include "wscvt/surface/mesh_surface.h"

namespace wscvt {

/// A node of a mesh that is being refined.
struct RefinementNode {
  Vector3 position = Vector3::Zero();   ///< about the origin; length
  Vector3 direction = Vector3::Zero();  ///< where it lies over the sphere; any length but zero
  MeshPlace place;                      ///< near it on the scan, of a mapped one
};

/// Points of the scan, of which one array each is meant; they have the same order.
struct RefinementSamples {
  std::vector<Vector3> points;
  std::vector<Vector3> directions;       ///< over the sphere; empty where the points serve
  std::vector<Eigen::Vector3f> normals;  ///< of the scan there, outward; unit, or zero

  std::size_t size() const { return points.size(); }
  const Vector3& direction(std::size_t s) const {
    return directions.empty() ? points[s] : directions[s];
  }
};

/// The scan that a mesh is refined towards, and the sphere over which both lie: nodes and samples
/// have directions, and a triangle owns the samples in whose direction it lies. May be asked from
/// several threads at once.
class RefinementTarget {
 public:
  virtual ~RefinementTarget() = default;

  /// Points spread evenly by area over the scan, about 32 for each of `triangles`, but 50,000 at
  /// least and no more than fit in memory.
  virtual RefinementSamples samples(std::size_t triangles, const Execution& execution) const = 0;

  /// A node at `position`, moved there from `from`.
  virtual RefinementNode node_at(const Vector3& position, const RefinementNode& from) const = 0;

  /// How far a node is from the scan's tangent plane above or below it (> 0: above the node), and
  /// that plane's normal; length.
  virtual double residual(const RefinementNode& node, Vector3& normal) const = 0;
};

/// A scan that is star-shaped about the origin, or taken by its outermost sheet: directions are
/// those of the points themselves. Samples that lie behind the outermost sheet are left out: a
/// star-shaped mesh cannot follow two sheets in one direction, and those behind would draw it
/// between the two. samples() throws Error(NumericalFailure) when a ray meets no face.
class RadialTarget : public RefinementTarget {
 public:
  /// `scan` must outlive it.
  explicit RadialTarget(const MeshSurface& scan) : scan_(scan) {}

  RefinementSamples samples(std::size_t triangles, const Execution& execution) const override;
  RefinementNode node_at(const Vector3& position, const RefinementNode& from) const override;
  double residual(const RefinementNode& node, Vector3& normal) const override;

 private:
  const MeshSurface& scan_;
};

/// A scan that is mapped to the sphere: a point's direction is that of the place nearest to it on
/// its sheet of the scan, so folds and overhangs are followed.
class MappedTarget : public RefinementTarget {
 public:
  /// `to_scan` is the distance to the scan where `surface` is an early level of its collapse, by
  /// which samples are put on to it, and null where `surface` is the scan. Both must outlive it.
  MappedTarget(const MappedSurface& surface, const MeshDistance* to_scan)
      : surface_(surface), to_scan_(to_scan) {}

  RefinementSamples samples(std::size_t triangles, const Execution& execution) const override;
  RefinementNode node_at(const Vector3& position, const RefinementNode& from) const override;
  double residual(const RefinementNode& node, Vector3& normal) const override;

 private:
  const MappedSurface& surface_;
  const MeshDistance* to_scan_;
};

}  // namespace wscvt
