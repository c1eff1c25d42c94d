// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/equalization.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "wscvt/base/numbers.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/star_shape.h"
#include "wscvt/surface/triangle_place.h"

namespace wscvt {

namespace {

/// Fraction of the previous step that is repeated.
constexpr double momentum = 0.95;
/// Longest step, in mean edges.
constexpr double longest_evening_step = 0.3;
/// How far nodes at a rim are pushed out, in mean edges. Without it, rims of thin bodies are up to
/// ten times as far off; .35 or .7 change nothing in the mean of 19.
constexpr double rim_push = 0.5;
/// The push is complete for a node that stands out from its ring by this much of its edges. In the
/// creases of rough grains nodes lie below their rings, and a push would tangle them.
constexpr double complete_height = 0.3;
/// Smaller cells count as this fraction of the mean, because obtuse triangles reduce the area.
constexpr double least_cell = 0.3;
/// Smallest barycentric weight of a circumcentre; farther out the cell would turn over.
constexpr double least_circumcentre_weight = -0.5;
/// Smallest cosine of a face's turn by a step, 72 degrees; no corner falls below 10 degrees.
constexpr double most_turn = 0.3;
constexpr double sharpest_corner = 0.985;
constexpr std::size_t evened_block = 512;
constexpr std::size_t cell_block = 1024;
/// Edges are flipped before each of the first steps, then before every fourth: steps get short.
constexpr int first_flips = 8;
constexpr int steps_a_flip = 4;
/// Number of smoothings of the surface's normals, against which faces are checked.
constexpr int normal_rounds = 3;

/// The part of a Voronoi cell in one triangle, at one corner.
struct CellPart {
  double mass = 0.0;                 ///< area, or area times density squared
  Vector3 moment = Vector3::Zero();  ///< of the mass about the corner
};

/// Point of a triangle with barycentric weights, and interpolated values.
struct WeightedPoint {
  Vector3 position;
  double density;  ///< of mass
};

Vector3 circumcentre_weights(const Vector3& a, const Vector3& b, const Vector3& c) {
  const std::array<double, 3> l = {(b - c).squaredNorm(), (c - a).squaredNorm(),
                                   (a - b).squaredNorm()};
  Vector3 w;
  for (int k = 0; k < 3; ++k) w[k] = l[k] * (l[(k + 1) % 3] + l[(k + 2) % 3] - l[k]);
  const double sum = w.sum();
  if (!(sum > 1e-300)) return Vector3::Constant(1.0 / 3.0);
  w *= 1.0 / sum;
  if (w.minCoeff() >= least_circumcentre_weight) return w;
  w = w.cwiseMax(least_circumcentre_weight);
  return w / w.sum();
}

void add_part(CellPart& part, const Vector3& corner, double corner_density, const WeightedPoint& p,
              const WeightedPoint& q, const Vector3& normal) {
  const Vector3 to_p = p.position - corner;
  const Vector3 to_q = q.position - corner;
  const double area = 0.5 * to_p.cross(to_q).dot(normal);
  const double sum = corner_density + p.density + q.density;
  part.mass += area / 3.0 * sum;
  // The centroid of a linear density, about the corner.
  part.moment += area / 12.0 * ((sum + p.density) * to_p + (sum + q.density) * to_q);
}

std::array<CellPart, 3> cell_parts(const std::array<Vector3, 3>& x,
                                   const std::array<double, 3>& density, const Vector3& normal) {
  const Vector3 w = circumcentre_weights(x[0], x[1], x[2]);
  const WeightedPoint centre = {
      w[0] * x[0] + w[1] * x[1] + w[2] * x[2],
      std::max(w[0] * density[0] + w[1] * density[1] + w[2] * density[2], 0.0)};
  std::array<CellPart, 3> parts;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const int previous = (k + 2) % 3;
    const WeightedPoint p = {0.5 * (x[k] + x[next]), 0.5 * (density[k] + density[next])};
    const WeightedPoint q = {0.5 * (x[k] + x[previous]), 0.5 * (density[k] + density[previous])};
    add_part(parts[k], x[k], density[k], p, centre, normal);
    add_part(parts[k], x[k], density[k], centre, q, normal);
  }
  return parts;
}

/// cell_parts for a density of 1. The triangle of an edge and the circumcentre has the triangle's
/// area times the circumcentre's opposite weight, half of it for each end.
void even_cell_parts(const std::array<const Vector3*, 3>& x, double doubled_area, CellPart* parts) {
  const Vector3 w = circumcentre_weights(*x[0], *x[1], *x[2]);
  const Vector3 centre = w[0] * *x[0] + w[1] * *x[1] + w[2] * *x[2];
  const double quarter = 0.25 * doubled_area;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = following(k);
    const std::size_t j = preceding(k);
    const double area_j = quarter * w[static_cast<Eigen::Index>(i)];  // of the edge from k to j
    const double area_i = quarter * w[static_cast<Eigen::Index>(j)];
    const Vector3 to_centre = centre - *x[k];
    parts[k].mass = area_i + area_j;
    parts[k].moment = (parts[k].mass / 3.0) * to_centre + (area_i / 6.0) * (*x[i] - *x[k]) +
                      (area_j / 6.0) * (*x[j] - *x[k]);
  }
}

/// Outward vectors at the surface's vertices: mean normals, smoothed over their rings, so that a
/// single rough face has little effect.
std::vector<Vector3> smoothed_vectors(const EditMesh& mesh, const Execution& execution) {
  std::vector<Vector3> vectors(mesh.points.size(), Vector3::Zero());
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 normal = mesh.normal(t);
    const double length = normal.norm();
    for (const std::int32_t v : mesh.triangles[t]) {
      vectors[v] += normal;
      areas[v] += length;
    }
  }
  for (std::size_t v = 0; v < vectors.size(); ++v) vectors[v] /= areas[v] + 1e-300;
  for (int round = 0; round < normal_rounds; ++round) {
    const std::vector<Vector3> old = vectors;
    execution.parallel_for_each(vectors.size(), 4096, [&](std::size_t v) {
      Vector3 sum = 2.0 * old[v];
      mesh.around(static_cast<std::int32_t>(v),
                  [&](std::int32_t h) { sum += old[mesh.target(h)]; });
      vectors[v] = sum / (2.0 + mesh.degrees[v]);
    });
  }
  return vectors;
}

class Evening {
 public:
  Evening(EditMesh& nodes, std::vector<std::int32_t>& places, const EqualizationSurface& surface,
          const EqualizationSteps& steps, const Execution& execution)
      : nodes_(nodes),
        places_(places),
        surface_(surface),
        settings_(steps),
        execution_(execution),
        surface_vectors_(smoothed_vectors(surface.mesh, execution)),
        count_(nodes.points.size()),
        previous_(nodes.points),
        outward_(count_),
        mass_density_(count_, 1.0),
        steps_(count_),
        pushes_(count_),
        shares_(count_),
        parts_(3 * nodes.triangles.size()),
        normals_(nodes.triangles.size()),
        lengths_(nodes.triangles.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      nodes_.points[i] = put_on_surface(nodes_.points[i], places_[i]);
    }
    previous_ = nodes_.points;
    read_surface();
    edge_ = mean_edge_length(nodes_);
  }

  EqualizationReport run() {
    EqualizationReport report;
    for (int step = 0; step < settings_.count; ++step) {
      execution_.report(static_cast<double>(step) / settings_.count, "Equalizing edge lengths");
      const bool flips = step < first_flips || step % steps_a_flip == 0;
      if (flips) report.flips += flip_to_delaunay(nodes_, outward_);
      plan(step > 0 ? momentum : 0.0);
      move();
      read_surface();
      if (flips) edge_ = mean_edge_length(nodes_);
      ++report.steps;
    }
    constexpr int last_flips = 5;
    for (int pass = 0; pass < last_flips; ++pass) {
      const int flips = flip_to_delaunay(nodes_, outward_);
      report.flips += flips;
      if (flips == 0) break;
    }
    return report;
  }

 private:
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    execution_.parallel_for_each(count_, evened_block, visit);
  }

  Vector3 put_on_surface(const Vector3& point, std::int32_t& place) const {
    const TrianglePlace nearest = walk_to_nearest(point, surface_.mesh, place);
    const auto& [a, b, c] = surface_.mesh.triangles[place];
    return nearest.point(surface_.mesh.points[a], surface_.mesh.points[b], surface_.mesh.points[c]);
  }

  /// Reads outward vectors and densities at the nodes.
  void read_surface() {
    for_nodes([&](std::size_t i) {
      const auto& [a, b, c] = surface_.mesh.triangles[places_[i]];
      outward_[i] = surface_vectors_[a] + surface_vectors_[b] + surface_vectors_[c];
      if (surface_.density.empty()) return;
      const Vector3 w = nearest_in_triangle(nodes_.points[i], surface_.mesh, places_[i]).weights;
      const double density =
          w[0] * surface_.density[a] + w[1] * surface_.density[b] + w[2] * surface_.density[c];
      mass_density_[i] = density * density;
    });
  }

  void measure_cells() {
    execution_.parallel_for_each(normals_.size(), cell_block, [&](std::size_t t) {
      const Vector3 normal = nodes_.normal(t);
      normals_[t] = normal;
      lengths_[t] = normal.norm();
      const auto& [a, b, c] = nodes_.triangles[t];
      if (surface_.density.empty()) {
        even_cell_parts({&nodes_.points[a], &nodes_.points[b], &nodes_.points[c]}, lengths_[t],
                        &parts_[3 * t]);
        return;
      }
      const std::array<CellPart, 3> parts = cell_parts(
          {nodes_.points[a], nodes_.points[b], nodes_.points[c]},
          {mass_density_[a], mass_density_[b], mass_density_[c]}, normal / (lengths_[t] + 1e-300));
      std::copy(parts.begin(), parts.end(), parts_.begin() + static_cast<std::ptrdiff_t>(3 * t));
    });
  }

  /// Computes the step and the push of every node.
  void plan(double share_of_last) {
    measure_cells();
    double area = 0.0;
    for (const double length : lengths_) area += 0.5 * length;
    const double mean = area / static_cast<double>(count_);
    for_nodes([&](std::size_t i) { plan_node(i, mean, share_of_last); });
  }

  void plan_node(std::size_t i, double mean, double share_of_last) {
    CellPart cell;
    nodes_.around(static_cast<std::int32_t>(i), [&](std::int32_t h) {
      cell.mass += parts_[h].mass;
      cell.moment += parts_[h].moment;
    });
    const StarShape shape = star_shape([&](const auto& visit) {
      nodes_.around(static_cast<std::int32_t>(i),
                    [&](std::int32_t h) { visit(normals_[face_of(h)], lengths_[face_of(h)]); });
    });
    const double density = std::sqrt(mass_density_[i]);
    // A cell of the wanted density has the mass mean * density.
    Vector3 step =
        settings_.over_relaxation * cell.moment / std::max(cell.mass, least_cell * mean * density) +
        share_of_last * (nodes_.points[i] - previous_[i]);
    step = shape.tangential(step);
    const double edge = edge_ / std::sqrt(std::max(density, 1e-3));
    const double length = step.norm();
    if (length > longest_evening_step * edge) step *= longest_evening_step * edge / length;
    steps_[i] = step;
    pushes_[i].setZero();
    if (shape.rim > 0.0) {
      const double height = height_above_ring(i, shape.normal) / complete_height;
      pushes_[i] = rim_push * edge * shape.rim * smooth_step(height) * shape.normal;
    }
    shares_[i] = 1.0;
  }

  /// Returns how far a node stands out from its ring, in the lengths of its edges.
  double height_above_ring(std::size_t i, const Vector3& normal) const {
    Vector3 ring = Vector3::Zero();
    double spokes = 0.0;
    nodes_.around(static_cast<std::int32_t>(i), [&](std::int32_t h) {
      const Vector3 spoke = nodes_.points[i] - nodes_.points[nodes_.target(h)];
      ring += spoke;
      spokes += spoke.norm();
    });
    return normal.dot(ring) / (spokes + 1e-300);
  }

  /// Whether a face is far from every limit of `spoils`, which most are, judged without roots.
  bool is_fine_by_far(std::size_t t, const Vector3& normal, const Vector3& outward) const {
    constexpr double blunt = 1.0 - sharpest_corner * sharpest_corner;
    const auto& [a, b, c] = nodes_.triangles[t];
    const double squared = normal.squaredNorm();
    const double up = normal.dot(outward);
    const double with = normal.dot(normals_[t]);
    const double l0 = (nodes_.points[b] - nodes_.points[c]).squaredNorm();
    const double l1 = (nodes_.points[c] - nodes_.points[a]).squaredNorm();
    const double l2 = (nodes_.points[a] - nodes_.points[b]).squaredNorm();
    return up > 0.0 && with > 0.0 &&
           up * up > least_agreement * least_agreement * squared * outward.squaredNorm() &&
           with * with > most_turn * most_turn * squared * normals_[t].squaredNorm() &&
           squared * std::min({l0, l1, l2}) > blunt * l0 * l1 * l2;
  }

  bool spoils(std::size_t t, const std::vector<Vector3>& old) const {
    const auto& [a, b, c] = nodes_.triangles[t];
    const Vector3 outward = outward_[a] + outward_[b] + outward_[c];
    Vector3 normal = nodes_.normal(t);
    if (is_fine_by_far(t, normal, outward)) return false;
    normal /= normal.norm() + 1e-300;
    const Vector3 old_normal = normals_[t] / (lengths_[t] + 1e-300);
    const double before = cosine_to(old_normal, outward);
    const double after = cosine_to(normal, outward);
    if (after < least_agreement && after < before - 1e-9) return true;
    if (before > least_agreement && normal.dot(old_normal) < most_turn) return true;
    const double sharpness = nodes_.sharpness(t);
    return sharpness > sharpest_corner && sharpness > largest_corner_cosine(old[a], old[b], old[c]);
  }

  /// Moves the nodes. Halves the steps at faces that they would spoil, and finally drops them.
  void move() {
    constexpr int most_tries = 6;
    constexpr int halvings = 4;
    const std::vector<Vector3> old = nodes_.points;
    const std::vector<std::int32_t> old_places = places_;
    const auto place = [&](std::size_t i) {
      places_[i] = old_places[i];
      nodes_.points[i] =
          shares_[i] == 0.0
              ? old[i]
              : put_on_surface(old[i] + shares_[i] * (steps_[i] + pushes_[i]), places_[i]);
    };
    for_nodes(place);
    std::vector<char> marked(count_);
    std::vector<char> spoilt(normals_.size());
    for (int attempt = 0; attempt < most_tries; ++attempt) {
      execution_.parallel_for_each(spoilt.size(), cell_block,
                                   [&](std::size_t t) { spoilt[t] = spoils(t, old) ? 1 : 0; });
      std::fill(marked.begin(), marked.end(), 0);
      bool any = false;
      for (std::size_t t = 0; t < spoilt.size(); ++t) {
        if (spoilt[t] == 0) continue;
        any = true;
        for (const std::int32_t v : nodes_.triangles[t]) marked[v] = 1;
      }
      if (!any) break;
      for (std::size_t i = 0; i < count_; ++i) {
        if (marked[i] == 0) continue;
        shares_[i] = attempt < halvings ? 0.5 * shares_[i] : 0.0;
        place(i);
      }
    }
    previous_ = old;
    for (std::size_t i = 0; i < count_; ++i) {
      if (shares_[i] < 1.0) previous_[i] = nodes_.points[i];  // no momentum into a wall
    }
  }

  EditMesh& nodes_;
  std::vector<std::int32_t>& places_;
  const EqualizationSurface& surface_;
  const EqualizationSteps settings_;
  const Execution& execution_;
  std::vector<Vector3> surface_vectors_;
  std::size_t count_;
  double edge_ = 0.0;
  std::vector<Vector3> previous_;
  std::vector<Vector3> outward_;
  std::vector<double> mass_density_;  ///< square of the wanted density of nodes
  std::vector<Vector3> steps_;
  std::vector<Vector3> pushes_;
  std::vector<double> shares_;
  std::vector<CellPart> parts_;  ///< of half-edge h's origin in its triangle
  std::vector<Vector3> normals_;
  std::vector<double> lengths_;  ///< of the normals
};

}  // namespace

EqualizationReport even_nodes(EditMesh& nodes, std::vector<std::int32_t>& places,
                              const EqualizationSurface& surface, const EqualizationSteps& steps,
                              const Execution& execution) {
  return Evening(nodes, places, surface, steps, execution).run();
}

std::vector<double> voronoi_areas(const EditMesh& nodes) {
  std::vector<double> areas(nodes.points.size(), 0.0);
  for (std::size_t t = 0; t < nodes.triangles.size(); ++t) {
    const auto& [a, b, c] = nodes.triangles[t];
    std::array<CellPart, 3> parts;
    even_cell_parts({&nodes.points[a], &nodes.points[b], &nodes.points[c]}, nodes.normal(t).norm(),
                    parts.data());
    for (int k = 0; k < 3; ++k) areas[nodes.triangles[t][k]] += parts[k].mass;
  }
  return areas;
}

}  // namespace wscvt
