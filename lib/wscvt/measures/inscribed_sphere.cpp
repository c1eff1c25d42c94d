// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/inscribed_sphere.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

namespace {

constexpr double tolerance = 1e-3;
constexpr std::size_t maximum_evaluations = 50000;
constexpr std::size_t cells_at_once = 16;  ///< refined together, whatever the number of threads
constexpr double diagonal = 1.7320508075688773;

struct Cell {
  Vector3 centre = Vector3::Zero();
  double half_edge = 0.0;
  double depth = 0.0;  ///< of the centre: distance to the surface, negative outside

  /// No point of the cell is deeper inside, since depth changes no faster than the point moves.
  double bound() const { return depth + diagonal * half_edge; }
  bool operator<(const Cell& other) const { return bound() < other.bound(); }
};

/// Climbs away from the nearest surface point with shrinking steps.
void climb(const MeshDistance& surface, InscribedSphere& sphere, double first_step) {
  double step = first_step;
  while (step > 1e-7 * sphere.radius) {
    for (int attempt = 0; attempt < 4; ++attempt) {
      const Vector3 away = sphere.centre - surface.nearest_point(sphere.centre);
      const Vector3 candidate =
          sphere.centre + std::min(step, 0.5 * sphere.radius) * away.normalized();
      // Within the sphere, so inside the body.
      const double reached = surface.distance(candidate);
      if (reached <= sphere.radius) break;
      sphere.centre = candidate;
      sphere.radius = reached;
    }
    step *= 0.7;
  }
}

}  // namespace

InscribedSphere largest_inscribed_sphere(const IndexedMesh& mesh, const Execution& execution) {
  execution.report(0.0, "Fitting the inscribed sphere");
  const MeshDistance surface(mesh, execution);
  Vector3 lower = mesh.points[mesh.triangles.front()[0]];
  Vector3 upper = lower;
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) {
      lower = lower.cwiseMin(mesh.points[v]);
      upper = upper.cwiseMax(mesh.points[v]);
    }
  }

  InscribedSphere best;
  std::priority_queue<Cell> open;
  const auto keep = [&](const Cell& cell) {
    if (cell.depth > best.radius) {
      best.centre = cell.centre;
      best.radius = cell.depth;
      climb(surface, best, cell.half_edge);
    }
    if (cell.bound() > best.radius) open.push(cell);
  };

  Cell root;
  root.centre = 0.5 * (lower + upper);
  root.half_edge = 0.5 * (upper - lower).maxCoeff();
  const double distance = surface.distance(root.centre);
  root.depth = surface.contains(root.centre) ? distance : -distance;
  keep(root);

  std::size_t evaluations = 1;
  std::vector<Cell> children;
  while (!open.empty() && open.top().bound() > (1.0 + tolerance) * best.radius &&
         evaluations < maximum_evaluations) {
    children.clear();
    for (std::size_t k = 0; k < cells_at_once && !open.empty(); ++k) {
      const Cell parent = open.top();
      open.pop();
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3 sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                           (corner & 4) != 0 ? 1.0 : -1.0);
        Cell child;
        child.half_edge = 0.5 * parent.half_edge;
        child.centre = parent.centre + child.half_edge * sign;
        child.depth = parent.depth;  // until it is measured
        children.push_back(child);
      }
    }
    execution.parallel_for(children.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Cell& child = children[i];
        // Nearer to its parent's centre than the surface is, it lies on the same side.
        const double moved = diagonal * child.half_edge;
        const bool decided = std::abs(child.depth) > moved;
        const bool inside = decided ? child.depth > 0.0 : surface.contains(child.centre);
        child.depth = (inside ? 1.0 : -1.0) * surface.distance(child.centre);
      }
    });
    evaluations += children.size();
    for (const Cell& child : children) keep(child);
    execution.report(static_cast<double>(evaluations) / static_cast<double>(maximum_evaluations),
                     "Fitting the inscribed sphere");
  }
  if (!(best.radius > 0.0)) {
    throw Error(ErrorCode::InvalidInput,
                "No point was found inside the mesh, so no sphere fits into it; give a closed mesh "
                "that encloses a volume.");
  }
  best.upper_bound = open.empty() ? best.radius : std::max(best.radius, open.top().bound());
  return best;
}

}  // namespace wscvt
