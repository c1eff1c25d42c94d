// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <queue>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/mesh_distance.h"

namespace wscvt {

namespace {

constexpr double tolerance = 1e-3;
constexpr std::size_t maximum_evaluations = 50000;
constexpr std::size_t cells_at_once = 16;  ///< refined together, on any number of threads
constexpr double diagonal = 1.7320508075688773;

struct Cell {
  Vector3 centre = Vector3::Zero();
  double half_edge = 0.0;
  double depth = 0.0;    ///< of the centre: distance to the surface, negative outside
  double bound = 0.0;    ///< no point of the cell is deeper inside
  std::size_t face = 0;  ///< near the centre

  bool operator<(const Cell& other) const { return bound < other.bound; }
};

/// A bound for the depth of all places x, from some points q of the surface with weights w of sum
/// 1. The nearest q is not farther than their root mean square, so depth^2 <= sum of w |x - q|^2 =
/// |x - m|^2 + V, with m their mean and V their variance. If a sphere touches the points on all
/// sides, m is its centre, and the bound grows only with the square of the distance from it.
struct TouchingPoints {
  Vector3 mean = Vector3::Zero();
  double variance = 0.0;

  /// Returns a bound for the depth of all points of a cube.
  double bound(const Vector3& centre, double half_edge) const {
    const Vector3 farthest = (centre - mean).cwiseAbs() + Vector3::Constant(half_edge);
    return std::sqrt(farthest.squaredNorm() + variance);
  }
};

/// Returns the points that a sphere nearly touches, weighted so that the bound near its centre is
/// small: by Frank and Wolfe (1956), with steps towards the point that lowers it most.
TouchingPoints touching_points(const MeshDistance& boxes, const InscribedSphere& sphere) {
  constexpr double nearly = 1.0 + 2e-3;
  constexpr double balance = 20.0;  // of the mean against larger distances
  constexpr int steps = 200;
  constexpr std::size_t enough_points = 256;  // a ball is touched everywhere
  std::vector<Vector3> points;
  for (const std::size_t face : boxes.faces_within(sphere.centre, nearly * sphere.radius)) {
    points.push_back(boxes.nearest_point_of(face, sphere.centre));
  }
  Vector3 mean = points.front() - sphere.centre;
  double square = mean.squaredNorm();  // mean of the squares
  for (int step = 0; step < steps; ++step) {
    Vector3 best = mean;
    double least = square + 2.0 * balance * mean.squaredNorm();
    const double here = least;
    for (std::size_t i = 0; i < points.size(); i += points.size() / enough_points + 1) {
      const Vector3 p = points[i] - sphere.centre;
      const double value = p.squaredNorm() + 2.0 * balance * mean.dot(p);
      if (!(value < least)) continue;
      least = value;
      best = p;
    }
    const double curvature = 2.0 * balance * (best - mean).squaredNorm();
    if (!(here - least > 1e-7 * sphere.radius * sphere.radius) || !(curvature > 0.0)) break;
    const double part = std::min(1.0, (here - least) / curvature);
    square += part * (best.squaredNorm() - square);
    mean += part * (best - mean);
  }
  return {sphere.centre + mean, std::max(0.0, square - mean.squaredNorm())};
}

/// Finds nearest points for places near each other, from the few faces that can be nearest there.
class NearbyFaces {
 public:
  NearbyFaces(const MeshDistance& boxes, std::size_t face) : boxes_(boxes), face_(face) {}

  /// The next places must be within a few `step` of `place`.
  Vector3 nearest_point(const Vector3& place, double step) {
    constexpr double steps = 4.0;
    constexpr double far = 8.0;
    constexpr double few = 0.01;  // slack / distance that keeps the faces few
    const double moved = (place - about_).norm();
    if (faces_.empty() || moved > slack_ || slack_ > far * steps * step) {
      const double distance = std::sqrt(boxes_.squared_distance(place, face_, 0.0));
      about_ = place;
      slack_ = steps * step;
      if (slack_ > few * distance) {
        faces_.clear();
        return boxes_.nearest_point_of(face_, place);
      }
      faces_ = boxes_.faces_within(place, (1.0 + 1e-12) * (distance + 2.0 * slack_));
    }
    Vector3 nearest = boxes_.nearest_point_of(faces_.front(), place);
    for (const std::size_t face : faces_) {
      const Vector3 point = boxes_.nearest_point_of(face, place);
      if ((point - place).squaredNorm() < (nearest - place).squaredNorm()) nearest = point;
    }
    return nearest;
  }

 private:
  const MeshDistance& boxes_;
  std::size_t face_;
  Vector3 about_ = Vector3::Zero();
  double slack_ = 0.0;  ///< the faces are valid for places within this distance
  std::vector<std::size_t> faces_;
};

/// Climbs away from the nearest surface point with shrinking steps. `face` is near the centre.
void climb(const MeshDistance& surface, std::size_t face, InscribedSphere& sphere,
           double first_step) {
  NearbyFaces faces(surface, face);
  double step = std::min(first_step, 0.5 * sphere.radius);
  Vector3 touched = faces.nearest_point(sphere.centre, step);
  while (step > 1e-7 * sphere.radius) {
    for (int attempt = 0; attempt < 4; ++attempt) {
      const Vector3 away = sphere.centre - touched;
      // It is inside the sphere, so inside the body.
      const Vector3 candidate = sphere.centre + step * away.normalized();
      const Vector3 nearest = faces.nearest_point(candidate, step);
      const double reached = (candidate - nearest).norm();
      if (reached <= sphere.radius) break;
      sphere.centre = candidate;
      sphere.radius = reached;
      touched = nearest;
    }
    step *= 0.7;
  }
}

/// The branch-and-bound search.
class SphereSearch {
 public:
  SphereSearch(const MeshDistance& surface, const Eigen::AlignedBox3d& box) : surface_(surface) {
    Cell root;
    root.centre = 0.5 * (box.min() + box.max());
    root.half_edge = 0.5 * box.sizes().maxCoeff();
    root.bound = diagonal * 2.0 * root.half_edge;
    measure(root, false, 0.0);
    keep(root);
  }

  bool is_done() const {
    return open_.empty() || open_.top().bound <= most() || evaluations_ >= maximum_evaluations;
  }
  double share_done() const {
    return static_cast<double>(evaluations_) / static_cast<double>(maximum_evaluations);
  }

  /// Splits the most promising cells into eight.
  void refine(const Execution& execution) {
    std::vector<Cell> children;
    for (std::size_t k = 0; k < cells_at_once && !open_.empty(); ++k) {
      const Cell parent = open_.top();
      open_.pop();
      if (is_settled(parent)) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                           (corner & 4) != 0 ? 1.0 : -1.0);
        Cell child = parent;  // keeps the parent's depth and bound until measured
        child.half_edge = 0.5 * parent.half_edge;
        child.centre = parent.centre + child.half_edge * sign;
        children.push_back(child);
      }
    }
    const double enough = most();
    execution.parallel_for_each(children.size(), 8,
                                [&](std::size_t i) { measure(children[i], true, enough); });
    evaluations_ += children.size();
    for (const Cell& child : children) keep(child);
  }

  InscribedSphere result() const {
    InscribedSphere sphere = best_;
    sphere.upper_bound = std::max(best_.radius, settled_);
    if (!open_.empty()) sphere.upper_bound = std::max(sphere.upper_bound, open_.top().bound);
    return sphere;
  }

 private:
  /// Cells whose bound is not above this are finished.
  double most() const { return (1.0 + tolerance) * best_.radius; }

  bool is_settled(const Cell& cell) {
    if (cell.bound > most()) return false;
    settled_ = std::max(settled_, cell.bound);
    return true;
  }

  /// Computes depth and bound, if the bound is above `enough`.
  void measure(Cell& cell, bool has_parent, double enough) const {
    for (const TouchingPoints& points : touching_) {
      cell.bound = std::min(cell.bound, points.bound(cell.centre, cell.half_edge));
    }
    if (has_parent && cell.bound <= enough) return;
    // The centre is on the side of its parent's centre if it is nearer to it than the surface.
    const double reach = diagonal * cell.half_edge;
    const bool decided = has_parent && std::abs(cell.depth) > reach;
    const bool inside = decided ? cell.depth > 0.0 : surface_.contains(cell.centre);
    // Does not stop so early that the result could count as the deepest place.
    const double near = inside ? std::clamp(enough - reach, 0.0, best_.radius) : 0.0;
    const double distance =
        std::sqrt(surface_.squared_distance(cell.centre, cell.face, near * near));
    cell.depth = inside ? distance : -distance;
    // Depth changes no faster than the point moves.
    cell.bound = std::min(cell.bound, cell.depth + reach);
    if (!inside) return;
    const TouchingPoints nearest{surface_.nearest_point_of(cell.face, cell.centre), 0.0};
    cell.bound = std::min(cell.bound, nearest.bound(cell.centre, cell.half_edge));
  }

  void keep(const Cell& cell) {
    if (cell.depth > best_.radius) {
      best_.centre = cell.centre;
      best_.radius = cell.depth;
      climb(surface_, cell.face, best_, cell.half_edge);
      touching_.push_back(touching_points(surface_, best_));
    }
    if (!is_settled(cell)) open_.push(cell);
  }

  const MeshDistance& surface_;
  InscribedSphere best_;
  std::vector<TouchingPoints> touching_;
  std::priority_queue<Cell> open_;
  double settled_ = 0.0;  ///< the largest bound of the finished cells
  std::size_t evaluations_ = 1;
};

}  // namespace

InscribedSphere largest_inscribed_sphere(const IndexedMesh& mesh, const Execution& execution) {
  constexpr const char* stage = "Fitting the inscribed sphere";
  execution.report(0.0, stage);
  if (!has_area(mesh)) {
    refuse(
        "The mesh has no faces with an area, so no sphere fits into it. Give a closed mesh that "
        "encloses a volume.");
  }
  const MeshDistance surface(mesh, execution);
  const Eigen::AlignedBox3d box = box_of_faces(mesh);
  SphereSearch search(surface, box);
  while (!search.is_done()) {
    search.refine(execution);
    execution.report(search.share_done(), stage);
  }
  InscribedSphere sphere = search.result();
  if (!(sphere.radius > 0.0)) {
    refuse(
        "No point was found inside the mesh, so no sphere fits into it. Give a closed mesh that "
        "encloses a volume.");
  }
  return sphere;
}

}  // namespace wscvt
