// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/sphere_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "toolbox/map/kernel_insertion.h"
#include "toolbox/map/map_energy.h"
#include "toolbox/map/mesh_collapse.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/orientation.h"
#include "wscvt/sphere/solid_angle.h"

namespace wscvt {

namespace {

constexpr std::size_t map_block = 8192;
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
  SphereMapReport& report() { return report_; }

 private:
  void insert() {
    const MeshCollapse::Undone undone = mesh_.undo();
    const std::int32_t v = undone.vertex;
    std::optional<Insertion> place = find_place(v, undone.neighbour);
    for (int attempt = 0; !place && attempt < 8; ++attempt) {
      widen(v, undone.neighbour);
      place = find_place(v, undone.neighbour);
      if (place) ++report_.mended_kernels;
    }
    if (!place) {
      throw Error(ErrorCode::NumericalFailure,
                  "The scan cannot be mapped to the sphere: no room is left for vertex " +
                      std::to_string(v) +
                      " beside its neighbours. Remove needle-shaped faces around it, e.g. by "
                      "remeshing the scan there.");
    }
    directions_[v] = place->direction;
    if (place->clipped) ++report_.clipped_kernels;
    order_.push_back(v);
    load_fan(v);
    fan_.improve(directions_[v]);
    fan_.improve(directions_[v]);
    if (mesh_.vertex_count() > fine_vertices) return;
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      const std::int32_t u = target_of(mesh_.triangles(), h);
      if (mesh_.valence(u) > largest_inserted_valence) return;
      load_fan(u);
      fan_.improve(directions_[u]);
    });
  }

  std::optional<Insertion> find_place(std::int32_t v, std::int32_t neighbour) {
    ring_.clear();
    distances_.clear();
    std::size_t apex = 0;
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      const std::int32_t u = target_of(mesh_.triangles(), h);
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
    mesh_.visit_outgoing(v,
                         [&](std::int32_t h) { moved.push_back(target_of(mesh_.triangles(), h)); });
    for (int sweep = 0; sweep < 10; ++sweep) {
      for (const std::int32_t u : moved) {
        // The vertex is at its neighbour's position, so triangles with both have no image.
        const auto place = [&](std::int32_t x) { return directions_[x == v ? neighbour : x]; };
        fan_.clear();
        mesh_.visit_outgoing(u, [&](std::int32_t h) {
          const std::int32_t q = target_of(mesh_.triangles(), h);
          const std::int32_t r = target_of(mesh_.triangles(), next_half_edge(h));
          const std::int32_t a = q == v ? neighbour : q;
          const std::int32_t b = r == v ? neighbour : r;
          if (a == b || a == u || b == u) return;
          fan_.add(place(q), place(r), equilateral, equilateral, equilateral, area * area);
        });
        if (u == neighbour) {
          // Its own triangles and the vertex's triangles.
          mesh_.visit_outgoing(v, [&](std::int32_t h) {
            const std::int32_t q = target_of(mesh_.triangles(), h);
            const std::int32_t r = target_of(mesh_.triangles(), next_half_edge(h));
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
    ++report_.levels;
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
        mesh_.visit_outgoing(v,
                             [&](std::int32_t h) { awake_[target_of(mesh_.triangles(), h)] = 1; });
      }
      ++report_.sweeps;
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
  SphereMapReport report_;
  double area_unit_ = 1.0;
  std::vector<ReferenceTriangle> references_;
  std::vector<char> awake_;
  VertexFan fan_;
  std::vector<Vector3> ring_;
  std::vector<double> distances_;
};

/// Checks the exact signs of all triangles and the sum of their solid angles.
void verify(const std::vector<Triangle>& triangles, const std::vector<Vector3>& directions,
            const Execution& execution) {
  struct Sums {
    std::size_t turned = 0;
    double solid_angle = 0.0;
    Sums& operator+=(const Sums& other) {
      turned += other.turned;
      solid_angle += other.solid_angle;
      return *this;
    }
  };
  const Sums sums = execution.parallel_sum(triangles.size(), map_block, Sums{},
                                           [&](std::size_t begin, std::size_t end) {
                                             Sums part;
                                             for (std::size_t f = begin; f < end; ++f) {
                                               const Triangle& t = triangles[f];
                                               const Vector3& a = directions[t[0]];
                                               const Vector3& b = directions[t[1]];
                                               const Vector3& c = directions[t[2]];
                                               if (!counter_clockwise(a, b, c)) ++part.turned;
                                               part.solid_angle += solid_angle(a, b, c);
                                             }
                                             return part;
                                           });
  // If all triangles are counter-clockwise, they cover the sphere a whole number of times.
  if (sums.turned > 0 || !(std::abs(sums.solid_angle / (4.0 * pi) - 1.0) < 1e-3)) {
    throw Error(ErrorCode::NumericalFailure,
                "The map to the sphere has " + std::to_string(sums.turned) +
                    " inverted triangles and covers the sphere " +
                    format_number(sums.solid_angle / (4.0 * pi)) +
                    " times. Remove needle-shaped faces, e.g. by remeshing the scan.");
  }
}

struct Distortion {
  double area = 0.0;
  double angle_sum = 0.0;
  double energy_sum = 0.0;
  double largest_angle = 1.0;
  double smallest_ratio = std::numeric_limits<double>::infinity();
  double largest_ratio = 0.0;

  Distortion& operator+=(const Distortion& other) {
    area += other.area;
    angle_sum += other.angle_sum;
    energy_sum += other.energy_sum;
    largest_angle = std::max(largest_angle, other.largest_angle);
    smallest_ratio = std::min(smallest_ratio, other.smallest_ratio);
    largest_ratio = std::max(largest_ratio, other.largest_ratio);
    return *this;
  }
};

/// `points` in the unit that gives their surface the area 4 pi.
void measure_distortion(const std::vector<Vector3>& points, const std::vector<Triangle>& triangles,
                        const std::vector<Vector3>& directions, const Execution& execution,
                        SphereMapReport& report) {
  const Distortion sum = execution.parallel_sum(
      triangles.size(), map_block, Distortion{}, [&](std::size_t begin, std::size_t end) {
        Distortion part;
        for (std::size_t f = begin; f < end; ++f) {
          const Triangle& t = triangles[f];
          const Vector3 ab = points[t[1]] - points[t[0]];
          const Vector3 ac = points[t[2]] - points[t[0]];
          const double area = 0.5 * ab.cross(ac).norm();
          const double ab_square = ab.squaredNorm();
          const double ac_square = ac.squaredNorm();
          // For a triangle without area, only rounding errors remain.
          if (!(area > 1e-12 * std::max(ab_square, ac_square))) continue;
          const Vector3& p = directions[t[0]];
          const Vector3 pq = directions[t[1]] - p;
          const Vector3 pr = directions[t[2]] - p;
          const double image = 0.5 * pq.cross(pr).norm();
          const double product = ab.dot(ac);
          // Dirichlet energy: (1/2) sum of cot l^2, cotangents from edge products over 2 area.
          const double dirichlet =
              0.25 / area *
              (product * (pr - pq).squaredNorm() + (ab_square - product) * pr.squaredNorm() +
               (ac_square - product) * pq.squaredNorm());
          const double ratio = image / area;
          const double angle = dirichlet / (2.0 * image);
          part.area += area;
          part.angle_sum += area * angle;
          part.energy_sum += dirichlet * (1.0 + 1.0 / (ratio * ratio));
          part.largest_angle = std::max(part.largest_angle, angle);
          part.smallest_ratio = std::min(part.smallest_ratio, ratio);
          part.largest_ratio = std::max(part.largest_ratio, ratio);
        }
        return part;
      });
  if (!(sum.area > 0.0)) return;
  report.mean_angle_distortion = sum.angle_sum / sum.area;
  report.largest_angle_distortion = sum.largest_angle;
  report.smallest_area_ratio = sum.smallest_ratio;
  report.largest_area_ratio = sum.largest_ratio;
  report.energy = sum.energy_sum / (4.0 * sum.area);
}

}  // namespace

SphereMap map_to_sphere(const IndexedMesh& mesh, const Execution& execution) {
  MeshCollapse collapse(mesh, execution);
  collapse.collapse_to(4, execution.part(0.0, 0.4));
  Embedding embedding(collapse);
  embedding.run(execution.part(0.4, 1.0));
  SphereMap result;
  result.directions = std::move(embedding.directions());
  result.report = embedding.report();
  result.report.vertices = mesh.points.size();
  result.report.triangles = mesh.triangles.size();
  verify(mesh.triangles, result.directions, execution);
  measure_distortion(collapse.points(), mesh.triangles, result.directions, execution,
                     result.report);
  execution.report(1.0, "Mapping the scan to the sphere");
  return result;
}

}  // namespace wscvt
