// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "toolbox/map/map_energy.h"
#include "toolbox/map/mesh_collapse.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/sphere_triangulation.h"

namespace wscvt {

namespace {

using Vector2 = Eigen::Vector2d;

bool is_in_kernel(const Vector3& p, const std::vector<Vector3>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!counter_clockwise(p, ring[i], ring[i + 1 < ring.size() ? i + 1 : 0])) return false;
  }
  return true;
}

/// Whether twice the area of every triangle about p exceeds `floor`, up to rounding.
bool is_well_inside(const Vector3& p, const std::vector<Vector3>& ring, double floor) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector3& a = ring[i];
    const Vector3& b = ring[i + 1 < ring.size() ? i + 1 : 0];
    if (!(p.dot(doubled_area_normal(p, a, b)) > floor)) return false;
  }
  return true;
}

/// Clips a convex polygon to value + slope . x >= 0 (Sutherland and Hodgman 1974).
void clip(std::vector<Vector2>& polygon, double value, const Vector2& slope,
          std::vector<Vector2>& scratch) {
  scratch.clear();
  for (std::size_t j = 0; j < polygon.size(); ++j) {
    const Vector2& a = polygon[j];
    const Vector2& b = polygon[j + 1 < polygon.size() ? j + 1 : 0];
    const double at_a = value + slope.dot(a);
    const double at_b = value + slope.dot(b);
    if (at_a >= 0.0) scratch.push_back(a);
    if ((at_a < 0.0) != (at_b < 0.0)) scratch.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  polygon.swap(scratch);
}

/// Returns the centroid of a convex polygon; nothing if it has no area.
std::optional<Vector2> centroid(const std::vector<Vector2>& polygon) {
  double doubled = 0.0;
  Vector2 moment = Vector2::Zero();
  for (std::size_t j = 1; j + 1 < polygon.size(); ++j) {
    const Vector2 a = polygon[j] - polygon[0];
    const Vector2 b = polygon[j + 1] - polygon[0];
    const double part = a.x() * b.y() - a.y() * b.x();
    doubled += part;
    moment += part * (a + b) / 3.0;
  }
  if (!(doubled > 0.0)) return std::nullopt;
  return moment / doubled + polygon[0];
}

/// Returns the centroid of the kernel in the gnomonic plane about the apex, where great circles are
/// lines.
std::optional<Vector3> kernel_centroid(const std::vector<Vector3>& ring, std::size_t apex,
                                       double size) {
  const Vector3& o = ring[apex];
  const Vector3 e1 = o.unitOrthogonal();
  const Vector3 e2 = o.cross(e1);
  // The plane is in units of the ring's size. The box cuts off nothing important; for rings round
  // half the sphere it ends 76 degrees from the apex.
  const double unit = std::min(size, 1.0);
  std::vector<Vector2> polygon{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
  std::vector<Vector2> scratch;
  for (std::size_t i = 0; i < ring.size() && polygon.size() >= 3; ++i) {
    const std::size_t next = i + 1 < ring.size() ? i + 1 : 0;
    // The normal of the great circle through two neighbours, from differences to keep relative
    // precision.
    const Vector3 a = ring[i] - o;
    const Vector3 b = ring[next] - o;
    const Vector3 ab = a.cross(b);
    const Vector3 normal = o.cross(b - a) + ab;
    const double value = i == apex || next == apex ? 0.0 : o.dot(ab);
    clip(polygon, value, unit * Vector2(normal.dot(e1), normal.dot(e2)), scratch);
  }
  const std::optional<Vector2> middle = centroid(polygon);
  if (!middle) return std::nullopt;
  return (o + unit * (middle->x() * e1 + middle->y() * e2)).normalized();
}

}  // namespace

std::optional<Vector3> insert_into_kernel(const std::vector<Vector3>& ring,
                                          const std::vector<double>& distances, std::size_t apex) {
  const std::size_t count = ring.size();
  if (count < 3) return std::nullopt;  // no polygon
  const Vector3& o = ring[apex];
  double size = 0.0;
  double mean_distance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    size = std::max(size, (ring[i] - o).norm());
    mean_distance += distances[i] / static_cast<double>(count);
  }
  // Beyond a radian the mean may lie on the wrong side of the sphere.
  if (size < 1.0) {
    const double floor = mean_distance > 0.0 ? 1e-6 * mean_distance : 1.0;
    Vector3 mean = Vector3::Zero();
    for (std::size_t i = 0; i < count; ++i) mean += ring[i] / (distances[i] + floor);
    mean.normalize();
    // If a triangle would be thinner than this, the kernel's centroid may be better.
    if (is_well_inside(mean, ring, 1e-4 * size * size)) return mean;
  }
  const std::optional<Vector3> centre = kernel_centroid(ring, apex, size);
  if (centre && is_in_kernel(*centre, ring)) return centre;
  // Tries points ever closer to the apex, along the middle of its angle, where the kernel is never
  // empty.
  const Vector3 forward = (ring[(apex + 1) % count] - o).normalized();
  const Vector3 backward = (ring[(apex + count - 1) % count] - o).normalized();
  Vector3 along = forward + backward;
  along -= along.dot(o) * o;
  // The middle of an angle above 180 degrees is on the other side.
  if (forward.cross(backward).dot(o) < 0.0) along = -along;
  if (along.norm() < 1e-6) along = o.cross(forward - backward);
  along.normalize();
  for (double step = 0.3 * size; step > 1e-14; step *= 0.5) {
    const Vector3 p = (o + step * along).normalized();
    if (is_in_kernel(p, ring)) return p;
  }
  return std::nullopt;
}

namespace {

constexpr std::size_t insertions_a_report = 4096;
/// Neighbours of higher valence are moved only by the sweeps, because each insertion would visit
/// their whole ring.
constexpr std::int32_t largest_inserted_valence = 32;

/// The whole map is optimised if a level has this many times the vertices of the level before.
constexpr double level_growth = 1.5;
/// Maximum number of sweeps over all vertices, at levels of up to this many vertices. Larger levels
/// have no sweeps, because sweeps change nothing there.
constexpr int coarse_sweeps = 40;
constexpr int fine_sweeps = 10;
constexpr std::size_t coarse_vertices = 4000;
constexpr std::size_t fine_vertices = 30000;
/// A level ends if four sweeps lower the energy by less than this fraction.
constexpr double level_tolerance = 2e-4;
/// A vertex is still if it moves by less than the square root of this times its edges' length.
constexpr double still = 1e-5;

/// Puts the vertices of a collapsed mesh on the sphere, one after another.
class Embedding {
 public:
  explicit Embedding(MeshCollapse& mesh)
      : mesh_(mesh), directions_(mesh.points().size(), Vector3::Zero()) {
    const Vector3 corners[4] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const auto v = static_cast<std::int32_t>(i);
      if (!mesh.has_vertex(v)) continue;
      directions_[i] = corners[order_.size()].normalized();
      order_.push_back(v);
    }
    const Triangle& first = mesh.triangles()[mesh.present_triangles()[0]];
    if (!counter_clockwise(directions_[first[0]], directions_[first[1]], directions_[first[2]])) {
      std::swap(directions_[order_[0]], directions_[order_[1]]);
    }
    set_area_unit();
  }

  void run(const Execution& execution) {
    const std::size_t total = mesh_.collapses();
    double next_level = 8.0;
    while (mesh_.collapses() > 0) {
      insert();
      const std::size_t count = mesh_.vertex_count();
      if (static_cast<double>(count) >= next_level || mesh_.collapses() == 0) {
        set_area_unit();
        const int sweeps = count <= coarse_vertices ? coarse_sweeps
                           : count <= fine_vertices ? fine_sweeps
                                                    : 0;
        optimise(sweeps, execution);
        next_level = level_growth * static_cast<double>(count);
      }
      if (count % insertions_a_report == 0) {
        execution.report(1.0 - static_cast<double>(mesh_.collapses()) / static_cast<double>(total),
                         "Mapping the scan to the sphere");
      }
    }
  }

  std::vector<Vector3>& directions() { return directions_; }

 private:
  void insert() {
    const MeshCollapse::Undone undone = mesh_.undo();
    const std::int32_t v = undone.vertex;
    std::optional<Vector3> place = find_place(v, undone.neighbour);
    for (int attempt = 0; !place && attempt < 8; ++attempt) {
      widen(v, undone.neighbour);
      place = find_place(v, undone.neighbour);
    }
    if (!place) {
      throw Error(ErrorCode::NumericalFailure,
                  "The scan cannot be mapped to the sphere: no room is left for vertex " +
                      std::to_string(v) +
                      " beside its neighbours. Remove needle-shaped faces around it, e.g. by "
                      "remeshing the scan there.");
    }
    directions_[v] = *place;
    order_.push_back(v);
    load_fan(v);
    fan_.improve(directions_[v]);
    fan_.improve(directions_[v]);
    if (mesh_.vertex_count() > fine_vertices) return;
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      const std::int32_t u = mesh_.target(h);
      if (mesh_.valence(u) > largest_inserted_valence) return;
      load_fan(u);
      fan_.improve(directions_[u]);
    });
  }

  std::optional<Vector3> find_place(std::int32_t v, std::int32_t neighbour) {
    ring_.clear();
    distances_.clear();
    std::size_t apex = 0;
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      const std::int32_t u = mesh_.target(h);
      if (u == neighbour) apex = ring_.size();
      ring_.push_back(directions_[u]);
      distances_.push_back((mesh_.points()[u] - mesh_.points()[v]).norm());
    });
    return insert_into_kernel(ring_, distances_, apex);
  }

  /// Makes room for a vertex. Moves its ring, without the vertex, towards equal triangles,
  /// independent of the surface's triangles.
  void widen(std::int32_t v, std::int32_t neighbour) {
    const double equilateral = 1.0 / std::sqrt(3.0);
    const double area = 4.0 * pi / static_cast<double>(mesh_.present_triangles().size());
    std::vector<std::int32_t> moved{neighbour};
    mesh_.visit_outgoing(v, [&](std::int32_t h) { moved.push_back(mesh_.target(h)); });
    for (int sweep = 0; sweep < 10; ++sweep) {
      for (const std::int32_t u : moved) {
        // The vertex is at its neighbour's position, so triangles with both have no image.
        const auto place = [&](std::int32_t x) { return directions_[x == v ? neighbour : x]; };
        fan_.clear();
        mesh_.visit_outgoing(u, [&](std::int32_t h) {
          const std::int32_t q = mesh_.target(h);
          const std::int32_t r = mesh_.target(next_half_edge(h));
          const std::int32_t a = q == v ? neighbour : q;
          const std::int32_t b = r == v ? neighbour : r;
          if (a == b || a == u || b == u) return;
          fan_.add(place(q), place(r), equilateral, equilateral, equilateral, area * area);
        });
        if (u == neighbour) {
          // Its own triangles and the vertex's triangles.
          mesh_.visit_outgoing(v, [&](std::int32_t h) {
            const std::int32_t q = mesh_.target(h);
            const std::int32_t r = mesh_.target(next_half_edge(h));
            if (q == neighbour || r == neighbour) return;
            fan_.add(directions_[q], directions_[r], equilateral, equilateral, equilateral,
                     area * area);
          });
        }
        fan_.improve(directions_[u]);
      }
    }
  }

  ReferenceTriangle reference_of(std::int32_t triangle) const {
    const Triangle& t = mesh_.triangles()[triangle];
    return reference_triangle(mesh_.points()[t[0]], mesh_.points()[t[1]], mesh_.points()[t[2]]);
  }

  /// Sets the unit of reference areas in which the level's surface has the area of the sphere. The
  /// surface shrinks when vertices are removed.
  void set_area_unit() {
    double area = 0.0;
    for (const std::int32_t f : mesh_.present_triangles()) {
      const Triangle& t = mesh_.triangles()[f];
      const Vector3& a = mesh_.points()[t[0]];
      area += triangle_area(a, mesh_.points()[t[1]], mesh_.points()[t[2]]);
    }
    area_unit_ = 4.0 * pi / std::max(area, 1e-9);
  }

  template <class Reference>
  void load_fan(std::int32_t v, const Reference& reference) {
    fan_.clear();
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      const std::int32_t f = h / 3;
      const std::int32_t k = h % 3;
      const Triangle& t = mesh_.triangles()[f];
      const ReferenceTriangle& r = reference(f);
      const std::int32_t k1 = (k + 1) % 3;
      const std::int32_t k2 = (k + 2) % 3;
      const double area = area_unit_ * r.area;
      fan_.add(directions_[t[k1]], directions_[t[k2]], r.cotangents[k], r.cotangents[k1],
               r.cotangents[k2], area * area);
    });
  }

  void load_fan(std::int32_t v) {
    load_fan(v, [&](std::int32_t f) { return reference_of(f); });
  }

  void optimise(int sweeps, const Execution& execution) {
    if (sweeps == 0) return;
    references_.resize(mesh_.triangles().size());
    for (const std::int32_t f : mesh_.present_triangles()) references_[f] = reference_of(f);
    const auto stored = [&](std::int32_t f) -> const ReferenceTriangle& { return references_[f]; };
    // A vertex is skipped if neither it nor a neighbour moves, because its step lowers the energy
    // only by the square of the distance.
    awake_.resize(directions_.size());
    for (const std::int32_t v : order_) awake_[v] = 1;
    double before = energy();
    for (int sweep = 1; sweep <= sweeps; ++sweep) {
      for (const std::int32_t v : order_) {
        if (awake_[v] == 0) continue;
        awake_[v] = 0;
        load_fan(v, stored);
        if (fan_.improve(directions_[v]) < still) continue;
        awake_[v] = 1;
        mesh_.visit_outgoing(v, [&](std::int32_t h) { awake_[mesh_.target(h)] = 1; });
      }
      if (sweep % 4 == 0) {
        const double after = energy();
        if (before - after < level_tolerance * after) break;
        before = after;
      }
      execution.report(
          1.0 - static_cast<double>(mesh_.collapses()) / static_cast<double>(directions_.size()),
          "Mapping the scan to the sphere");
    }
  }

  double energy() const {
    double sum = 0.0;
    for (const std::int32_t f : mesh_.present_triangles()) {
      const Triangle& t = mesh_.triangles()[f];
      const ReferenceTriangle& r = references_[f];
      const Vector3& p = directions_[t[0]];
      const Vector3 a = directions_[t[1]] - p;
      const Vector3 b = directions_[t[2]] - p;
      const double area = 0.5 * six_volumes(p, a, b);
      const double dirichlet =
          0.5 * (r.cotangents[0] * (b - a).squaredNorm() + r.cotangents[1] * b.squaredNorm() +
                 r.cotangents[2] * a.squaredNorm());
      const double ratio = area_unit_ * r.area / area;
      sum += dirichlet * (1.0 + ratio * ratio);
    }
    return sum;
  }

  MeshCollapse& mesh_;
  std::vector<Vector3> directions_;
  std::vector<std::int32_t> order_;
  double area_unit_ = 1.0;
  std::vector<ReferenceTriangle> references_;
  std::vector<char> awake_;
  VertexFan fan_;
  std::vector<Vector3> ring_;
  std::vector<double> distances_;
};

}  // namespace

std::vector<Vector3> map_to_sphere(const IndexedMesh& mesh, const Execution& execution) {
  MeshCollapse collapse(mesh, execution);
  collapse.collapse_to(4, execution.part(0.0, 0.4));
  Embedding embedding(collapse);
  embedding.run(execution.part(0.4, 1.0));
  execution.report(1.0, "Mapping the scan to the sphere");
  return std::move(embedding.directions());
}

}  // namespace wscvt
