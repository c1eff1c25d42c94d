// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/mesh_collapse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// A vertex with more neighbours waits until some of them are removed. This never blocks, because a
/// planar triangulation always has vertices with at most five neighbours.
constexpr std::int32_t largest_collapsed_valence = 16;
/// A vertex of higher valence is a hub. A hub's ring is not walked to find one neighbour.
constexpr std::int32_t hub_valence = 24;
/// Number of collapses between two progress reports, and of vertices and faces in the preparation.
constexpr std::size_t collapses_a_report = 4096;
constexpr std::size_t preparation_interval = 65536;
constexpr std::size_t choice_block = 4096;
/// Down to this many vertices, vertices are removed in rounds, then one by one.
constexpr std::size_t fewest_for_rounds = 100000;
constexpr const char* collapse_stage = "Collapsing the scan";

/// Returns the number of faces that are reached from the first.
std::size_t faces_reached(const HalfEdges& links) {
  std::vector<char> met(links.opposite.size() / 3, 0);
  std::vector<std::int32_t> stack{0};
  met[0] = 1;
  std::size_t reached = 0;
  while (!stack.empty()) {
    const std::int32_t t = stack.back();
    stack.pop_back();
    ++reached;
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t beyond = links.opposite[3 * t + k] / 3;
      if (met[beyond] == 0) {
        met[beyond] = 1;
        stack.push_back(beyond);
      }
    }
  }
  return reached;
}

/// Checks that a mesh is one sphere. Returns its half-edges.
HalfEdges linked_sphere(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::string advice =
      " Run check_mesh on it first, and close the holes and handles that it reports.";
  if (vertices < 4 || mesh.triangles.size() < 4) {
    refuse("The mesh has " + std::to_string(vertices) + " vertices and " +
           std::to_string(mesh.triangles.size()) +
           " faces. A map to the sphere needs a closed surface with at least four of each.");
  }
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 3;
  if (mesh.triangles.size() > limit) {
    refuse("The mesh has " + std::to_string(mesh.triangles.size()) + " faces, more than the " +
           std::to_string(limit) + " that can be numbered. Reduce the scan first.");
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!mesh.points[i].allFinite()) {
      refuse("Vertex " + std::to_string(i) + " is not at a finite position." + advice);
    }
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] < 0 || static_cast<std::size_t>(t[k]) >= vertices || t[k] == t[(k + 1) % 3]) {
        refuse("Face " + std::to_string(f) + " has the corners " + std::to_string(t[0]) + ", " +
               std::to_string(t[1]) + ", " + std::to_string(t[2]) +
               ", which are not three of the mesh's " + std::to_string(vertices) + " vertices." +
               advice);
      }
    }
  }
  HalfEdges links = link_half_edges(mesh.triangles, vertices);
  for (std::size_t h = 0; h < links.opposite.size(); ++h) {
    const std::int32_t other = links.opposite[h];
    if (other < 0 || links.opposite[other] != static_cast<std::int32_t>(h)) {
      const Triangle& t = mesh.triangles[h / 3];
      refuse("The mesh is not closed: the edge from vertex " + std::to_string(t[h % 3]) + " to " +
             std::to_string(t[(h % 3 + 1) % 3]) +
             " is not shared by two faces with opposite directions along it." + advice);
    }
  }
  execution.report(0.0, collapse_stage);
  // One round about each vertex must visit all its corners, and all faces must be reached from the
  // first.
  std::size_t corners = 0;
  for (std::size_t v = 0; v < vertices; ++v) {
    if (links.first[v] < 0) {
      refuse("Vertex " + std::to_string(v) + " is a corner of no face." + advice);
    }
    visit_outgoing(links.opposite, links.first[v], [&](std::int32_t) { ++corners; });
  }
  if (corners != links.opposite.size()) {
    refuse("The mesh touches itself in a vertex." + advice);
  }
  execution.report(0.0, collapse_stage);
  const std::size_t reached = faces_reached(links);
  if (reached != mesh.triangles.size()) {
    refuse("The mesh has several parts. The first has " + std::to_string(reached) + " of " +
           std::to_string(mesh.triangles.size()) + " faces." + advice);
  }
  // Euler: V - E + F = 2 - 2 g with E = 3 F / 2.
  if (mesh.triangles.size() + 4 != 2 * vertices) {
    const std::size_t genus = (mesh.triangles.size() + 4 - 2 * vertices) / 4;
    refuse("The mesh has " + format_count(genus, "handle") +
           ". Only a surface without handles can be mapped to the sphere. Cut and cap them first, "
           "or smooth or fill the scan where it touches itself.");
  }
  return links;
}

/// Weighted sum of squared distances from planes n . x + d = 0 (Garland and Heckbert 1997).
struct Quadric {
  std::array<double, 10> c{};

  void add(const Vector3& n, double d, double weight) {
    const double x = weight * n.x(), y = weight * n.y(), z = weight * n.z();
    c[0] += x * n.x();
    c[1] += x * n.y();
    c[2] += x * n.z();
    c[3] += x * d;
    c[4] += y * n.y();
    c[5] += y * n.z();
    c[6] += y * d;
    c[7] += z * n.z();
    c[8] += z * d;
    c[9] += weight * d * d;
  }

  void add(const Quadric& other) {
    for (std::size_t i = 0; i < c.size(); ++i) c[i] += other.c[i];
  }

  double at(const Vector3& p) const {
    return p.x() * (c[0] * p.x() + 2.0 * (c[1] * p.y() + c[2] * p.z() + c[3])) +
           p.y() * (c[4] * p.y() + 2.0 * (c[5] * p.z() + c[6])) +
           p.z() * (c[7] * p.z() + 2.0 * c[8]) + c[9];
  }
};

/// Returns positions about their mean in the unit that makes the area 4 pi. If the area is 0 or far
/// too small for the extent, the extent gives the unit, to prevent overflow.
std::vector<Vector3> normalised(const IndexedMesh& mesh) {
  constexpr double largest_extent = 1e6;
  Vector3 low = mesh.points[0];
  Vector3 high = mesh.points[0];
  for (const Vector3& p : mesh.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vector3 middle = 0.5 * low + 0.5 * high;
  const double extent = (0.5 * high - 0.5 * low).maxCoeff();
  std::vector<Vector3> points(mesh.points.size());
  Vector3 mean = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = mesh.points[i] - middle;
    if (extent > 0.0) points[i] /= extent;
    mean += points[i] / static_cast<double>(points.size());
  }
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    area += triangle_area(points[t[0]], points[t[1]], points[t[2]]);
  }
  const double scale =
      std::min(largest_extent, area > 0.0 ? std::sqrt(4.0 * pi / area) : largest_extent);
  for (Vector3& p : points) p = (p - mean) * scale;
  return points;
}

}  // namespace

MeshCollapse::MeshCollapse(const IndexedMesh& mesh, const Execution& execution) {
  HalfEdges links = linked_sphere(mesh, execution);
  execution.report(0.0, collapse_stage);
  triangles_ = mesh.triangles;
  opposite_ = std::move(links.opposite);
  first_ = std::move(links.first);
  points_ = normalised(mesh);
  valences_.assign(points_.size(), 0);
  for (const Triangle& t : triangles_) {
    for (const std::int32_t v : t) ++valences_[v];
  }
  alive_ = points_.size();
}

void MeshCollapse::collapse(std::int32_t h) {
  const std::int32_t g = opposite_[h];
  const std::int32_t v = origin(h);
  const std::int32_t w = target(h);
  const std::int32_t left = target(next_half_edge(h));
  const std::int32_t right = target(next_half_edge(g));
  // Every corner of v becomes w, except in the two removed triangles. These two keep their corners
  // and links, which are all that `undo` needs.
  visit_outgoing(v, [&](std::int32_t outgoing) {
    if (outgoing / 3 != h / 3 && outgoing / 3 != g / 3) {
      triangles_[outgoing / 3][outgoing % 3] = w;
    }
  });
  const std::int32_t left_to_w = opposite_[next_half_edge(h)];
  const std::int32_t w_to_left = opposite_[previous_half_edge(h)];
  const std::int32_t right_to_w = opposite_[next_half_edge(g)];
  const std::int32_t w_to_right = opposite_[previous_half_edge(g)];
  opposite_[left_to_w] = w_to_left;
  opposite_[w_to_left] = left_to_w;
  opposite_[right_to_w] = w_to_right;
  opposite_[w_to_right] = right_to_w;
  first_[w] = w_to_left;
  first_[left] = left_to_w;
  first_[right] = right_to_w;
  first_[v] = -1;
  valences_[w] += valences_[v] - 4;
  --valences_[left];
  --valences_[right];
  --alive_;
  log_.push_back(h);
}

MeshCollapse::Undone MeshCollapse::undo() {
  const std::int32_t h = log_.back();
  log_.pop_back();
  const std::int32_t g = opposite_[h];
  const std::int32_t v = origin(h);
  const std::int32_t w = target(h);
  const std::int32_t left = target(next_half_edge(h));
  const std::int32_t right = target(next_half_edge(g));
  const std::int32_t left_to_w = opposite_[next_half_edge(h)];
  const std::int32_t w_to_left = opposite_[previous_half_edge(h)];
  const std::int32_t right_to_w = opposite_[next_half_edge(g)];
  const std::int32_t w_to_right = opposite_[previous_half_edge(g)];
  // The corners of w from the left triangle counter-clockwise to the right triangle belonged to v.
  std::int32_t corners = 0;
  for (std::int32_t outgoing = w_to_left;; outgoing = opposite_[previous_half_edge(outgoing)]) {
    triangles_[outgoing / 3][outgoing % 3] = v;
    ++corners;
    if (previous_half_edge(outgoing) == right_to_w) break;
  }
  opposite_[left_to_w] = next_half_edge(h);
  opposite_[w_to_left] = previous_half_edge(h);
  opposite_[right_to_w] = next_half_edge(g);
  opposite_[w_to_right] = previous_half_edge(g);
  first_[v] = h;
  first_[w] = next_half_edge(h);
  first_[left] = previous_half_edge(h);
  first_[right] = previous_half_edge(g);
  valences_[v] = corners + 2;
  valences_[w] -= valences_[v] - 4;
  ++valences_[left];
  ++valences_[right];
  ++alive_;
  present_.push_back(h / 3);
  present_.push_back(g / 3);
  return {v, w};
}

/// The cost of every vertex, and the order of removal.
class MeshCollapse::Queue {
 public:
  Queue(MeshCollapse& mesh, const Execution& execution) : mesh_(mesh) {
    const std::size_t count = mesh.points_.size();
    quadrics_.resize(count);
    // A small weight, because vertices without area must have a divisor.
    areas_.assign(count, 1e-14);
    choices_.resize(count);
    states_.assign(count, stale);
    hubs_.assign(count, 0);
    const std::vector<char> absent = mesh.absent_triangles();
    for (std::size_t f = 0; f < mesh.triangles_.size(); ++f) {
      if (f % preparation_interval == 0) execution.report(0.0, collapse_stage);
      const Triangle& t = mesh.triangles_[f];
      if (absent[f] != 0) continue;
      const Vector3& a = mesh.points_[t[0]];
      Vector3 normal = doubled_area_normal(a, mesh.points_[t[1]], mesh.points_[t[2]]);
      const double doubled = normal.norm();
      if (!(doubled > 0.0)) continue;
      normal /= doubled;
      const double weight = doubled / 6.0;  // a third of the area to each corner
      for (const std::int32_t v : t) {
        quadrics_[v].add(normal, -normal.dot(a), weight);
        areas_[v] += weight;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto v = static_cast<std::int32_t>(i);
      if (mesh.has_vertex(v) && mesh.valences_[i] > hub_valence) make_hub(v);
    }
  }

  /// Collapses non-neighbouring vertices of the cheaper half, in the order of their indices, down
  /// to at most `aim` vertices. Returns the number of collapses.
  std::size_t collapse_round(std::size_t aim, const Execution& execution) {
    choose_stale(execution);
    std::vector<float> costs;
    costs.reserve(mesh_.alive_);
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      if (may_go(static_cast<std::int32_t>(i))) costs.push_back(choices_[i].cost);
    }
    if (costs.empty()) return 0;
    const float limit = upper_median(costs);
    const std::size_t before = mesh_.alive_;
    for (std::size_t i = 0; i < choices_.size() && mesh_.alive_ > aim; ++i) {
      const auto v = static_cast<std::int32_t>(i);
      // A neighbour of a vertex removed in this round is stale.
      if (!may_go(v) || (states_[i] & stale) != 0 || !(choices_[i].cost <= limit)) continue;
      if (choices_[i].half_edge < 0 || !may_collapse(choices_[i].half_edge)) continue;
      carry_out(choices_[i].half_edge);
    }
    return before - mesh_.alive_;
  }

  /// Prepares collapse_next.
  void fill(const Execution& execution) {
    choose_stale(execution);
    for (std::size_t i = 0; i < choices_.size(); ++i) {
      const auto v = static_cast<std::int32_t>(i);
      if (!may_go(v)) continue;
      entries_.push_back({choices_[i].cost, v});
      states_[i] |= waiting;
    }
    std::make_heap(entries_.begin(), entries_.end(), dearer);
  }

  /// Collapses the cheapest vertex.
  void collapse_next() {
    for (;;) {
      if (entries_.empty()) {
        throw Error(ErrorCode::NumericalFailure,
                    "The scan could not be simplified below " + std::to_string(mesh_.alive_) +
                        " vertices. Its faces do not form one closed surface without handles.");
      }
      const Entry entry = pop();
      const std::int32_t v = entry.vertex;
      if (!may_go(v)) continue;
      // Collapses farther away may break the link condition even if the ring did not change.
      if ((states_[v] & stale) != 0 || choices_[v].half_edge < 0 ||
          !may_collapse(choices_[v].half_edge)) {
        update(v, workspace_);
        const Choice& choice = choices_[v];
        if (choice.half_edge < 0) continue;
        // If the vertex is nearly as cheap as the next, it is removed now: returning it to the heap
        // costs more.
        if (!entries_.empty() && choice.cost > entries_.front().cost * 1.0001F) {
          push({choice.cost, v});
          continue;
        }
      }
      carry_out(choices_[v].half_edge);
      // A neighbour with a valence that is now low enough joins with the present cost. Its own cost
      // is computed at its turn.
      for (const std::int32_t u : workspace_.ring) {
        if ((states_[u] & waiting) == 0 && mesh_.valences_[u] <= largest_collapsed_valence) {
          push({entry.cost, u});
        }
      }
      return;
    }
  }

 private:
  /// The cheapest half-edge along which a vertex may be collapsed, or -1.
  struct Choice {
    float cost = 0.0F;
    std::int32_t half_edge = -1;
  };
  struct Entry {
    float cost;
    std::int32_t vertex;
  };
  /// In a tie the lower index is first, so that the order does not depend on the heap.
  static bool dearer(const Entry& a, const Entry& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.vertex > b.vertex;
  }
  static constexpr unsigned char waiting = 1;  ///< bits of a vertex's state: in the heap
  static constexpr unsigned char stale = 2;    ///< its choice is out of date

  /// The neighbours of one vertex, and data for its collapse onto any of them. At most
  /// `largest_collapsed_valence` long, because searches are linear.
  struct Workspace {
    std::vector<std::int32_t> ring;
    std::vector<std::int32_t> outgoing;
    std::vector<Vector3> corners;
    std::vector<Vector3> normals;    ///< of the triangles about the vertex, times twice their areas
    std::vector<double> lengths;     ///< of the normals
    std::vector<double> squares;     ///< squared lengths of the ring's edges
    std::vector<double> costs;       ///< of the collapse onto each, without the shapes
    std::vector<std::size_t> order;  ///< of the ring, by these costs
  };

  bool may_go(std::int32_t v) const {
    return mesh_.has_vertex(v) && mesh_.valences_[v] <= largest_collapsed_valence;
  }

  void push(const Entry& entry) {
    states_[entry.vertex] |= waiting;
    entries_.push_back(entry);
    std::push_heap(entries_.begin(), entries_.end(), dearer);
  }

  Entry pop() {
    std::pop_heap(entries_.begin(), entries_.end(), dearer);
    const Entry entry = entries_.back();
    entries_.pop_back();
    states_[entry.vertex] &= static_cast<unsigned char>(~waiting);
    return entry;
  }

  static std::uint64_t pair_of(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    return (static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(high);
  }

  /// Makes a vertex a hub for good. A table stores which hubs are neighbours, because a walk round
  /// a hub would make the time quadratic in the fan's size.
  void make_hub(std::int32_t v) {
    hubs_[v] = 1;
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      const std::int32_t u = mesh_.target(h);
      if (hubs_[u] != 0) hub_edges_.insert(pair_of(u, v));
    });
  }

  bool are_neighbours(std::int32_t u, std::int32_t w) const {
    if (hubs_[u] != 0) {
      if (hubs_[w] != 0) return hub_edges_.count(pair_of(u, w)) > 0;
      std::swap(u, w);
    }
    bool found = false;
    mesh_.visit_outgoing(u, [&](std::int32_t h) { found = found || mesh_.target(h) == w; });
    return found;
  }

  void load_ring(std::int32_t v, Workspace& work) const {
    work.ring.clear();
    work.outgoing.clear();
    mesh_.visit_outgoing(v, [&](std::int32_t h) {
      work.ring.push_back(mesh_.target(h));
      work.outgoing.push_back(h);
    });
  }

  /// Whether the link condition is met: the vertex of the loaded ring and its neighbour w share
  /// only the two neighbours opposite to their edge.
  bool link_condition(std::int32_t w, const Workspace& work) const {
    int common = 0;
    if (hubs_[w] == 0) {
      mesh_.visit_outgoing(w, [&](std::int32_t h) {
        const std::int32_t u = mesh_.target(h);
        for (const std::int32_t x : work.ring) common += x == u;
      });
    } else {
      for (const std::int32_t u : work.ring) {
        if (u != w && are_neighbours(u, w)) ++common;
      }
    }
    return common == 2;
  }

  bool may_collapse(std::int32_t half_edge) {
    load_ring(mesh_.origin(half_edge), workspace_);
    return link_condition(mesh_.target(half_edge), workspace_);
  }

  /// Computes all stale choices again.
  void choose_stale(const Execution& execution) {
    execution.parallel_for(choices_.size(), choice_block, [&](std::size_t begin, std::size_t end) {
      Workspace work;
      for (std::size_t i = begin; i < end; ++i) {
        const auto v = static_cast<std::int32_t>(i);
        if ((states_[i] & stale) != 0 && may_go(v)) update(v, work);
      }
    });
  }

  /// Writes only data of v.
  void update(std::int32_t v, Workspace& work) {
    states_[v] &= static_cast<unsigned char>(~stale);
    choices_[v] = choose(v, work);
  }

  Choice choose(std::int32_t v, Workspace& work) const {
    load_ring(v, work);
    const std::vector<Vector3>& points = mesh_.points_;
    const std::size_t count = work.ring.size();
    work.corners.resize(count);
    for (std::size_t i = 0; i < count; ++i) work.corners[i] = points[work.ring[i]];
    const Vector3& p = points[v];
    work.normals.resize(count);
    work.lengths.resize(count);
    work.squares.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3& a = work.corners[i];
      const Vector3& b = work.corners[i + 1 < count ? i + 1 : 0];
      work.normals[i] = doubled_area_normal(p, a, b);
      work.lengths[i] = work.normals[i].norm();
      work.squares[i] = (a - b).squaredNorm();
    }
    work.costs.resize(count);
    work.order.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t w = work.ring[i];
      const Vector3& q = work.corners[i];
      const double both = areas_[v] + areas_[w];
      const double distance =
          std::sqrt(std::max(0.0, (quadrics_[v].at(q) + quadrics_[w].at(q)) / both));
      double cost =
          0.25 * std::sqrt(areas_[v] * (1.0 + areas_[v] / both)) + 0.1 * (q - p).norm() + distance;
      const std::int32_t valence = mesh_.valences_[v] + mesh_.valences_[w] - 4;
      if (valence > 9) cost *= 1.0 + 0.15 * (valence - 9) * (valence - 9);
      work.costs[i] = cost;
      // Insertion sort in ascending order; there are about six entries.
      std::size_t place = i;
      for (; place > 0 && work.costs[work.order[place - 1]] > cost; --place) {
        work.order[place] = work.order[place - 1];
      }
      work.order[place] = i;
    }
    // Shapes and links are most of the work, so they are computed cheapest first and only if the
    // other costs leave room. This saves 7 % for a million vertices to 1,000 nodes. In a tie the
    // first of the ring is used.
    std::size_t best = count;
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : work.order) {
      if (work.costs[i] > lowest) break;
      const double room = lowest / work.costs[i];
      const double cost = work.costs[i] * std::sqrt(worst_shape(i, work, 1.0001 * room * room));
      if (!(cost < lowest || (cost == lowest && i < best))) continue;
      if (!link_condition(work.ring[i], work)) continue;
      lowest = cost;
      best = i;
    }
    return {static_cast<float>(lowest), best < count ? work.outgoing[best] : -1};
  }

  /// Returns the worst shape of the triangles after a collapse of the loaded vertex to its
  /// neighbour i: the largest sum of squared edges over area, scaled to 1 for an equilateral
  /// triangle. At least 100 if a triangle turns by more than 78 degrees. May return any value above
  /// `enough` if the shape is above it.
  static double worst_shape(std::size_t i, const Workspace& work, double enough) {
    const std::size_t count = work.ring.size();
    const Vector3& q = work.corners[i];
    double worst = 1.0;
    for (std::size_t step = 1; step + 1 < count && !(worst > enough); ++step) {
      const std::size_t j = i + step < count ? i + step : i + step - count;
      const std::size_t k = j + 1 < count ? j + 1 : 0;
      const Vector3 a = work.corners[j] - q;
      const Vector3 b = work.corners[k] - q;
      const Vector3 normal = a.cross(b);
      const double doubled = normal.norm();
      const double edges = work.squares[j] + a.squaredNorm() + b.squaredNorm();
      double shape = std::min(1e4, edges / (2.0 * std::sqrt(3.0) * doubled + 1e-300));
      if (normal.dot(work.normals[j]) < 0.2 * doubled * work.lengths[j]) {
        shape = std::max(shape, 100.0);
      }
      worst = std::max(worst, shape);
    }
    return worst;
  }

  /// Leaves the ring of the removed vertex in the workspace.
  void carry_out(std::int32_t half_edge) {
    const std::int32_t v = mesh_.origin(half_edge);
    const std::int32_t w = mesh_.target(half_edge);
    quadrics_[w].add(quadrics_[v]);
    areas_[w] += areas_[v];
    load_ring(v, workspace_);
    mesh_.collapse(half_edge);
    if (hubs_[w] != 0) {
      for (const std::int32_t u : workspace_.ring) {
        if (u != w && hubs_[u] != 0) hub_edges_.insert(pair_of(u, w));
      }
    } else if (mesh_.valences_[w] > hub_valence) {
      make_hub(w);
    }
    for (const std::int32_t u : workspace_.ring) states_[u] |= stale;
  }

  MeshCollapse& mesh_;
  std::vector<Quadric> quadrics_;
  std::vector<double> areas_;  ///< of the surface that each vertex represents
  std::vector<Choice> choices_;
  std::vector<unsigned char> states_;
  std::vector<char> hubs_;      ///< apart from the states, because other threads read it
  std::vector<Entry> entries_;  ///< a heap, cheapest first
  std::unordered_set<std::uint64_t> hub_edges_;
  Workspace workspace_;
};

void MeshCollapse::collapse_to(std::size_t vertices, const Execution& execution) {
  const std::size_t aim = std::max<std::size_t>(vertices, 4);
  if (alive_ > aim) {
    Queue queue(*this, execution);
    const std::size_t start = alive_;
    log_.reserve(log_.size() + alive_ - aim);
    const auto report = [&] {
      execution.report(static_cast<double>(start - alive_) / static_cast<double>(start - aim),
                       collapse_stage);
    };
    // One by one, cheapest first, the vertices of a dense scan are accessed all over the memory.
    // Rounds take half of the time, on two threads a quarter. The queue still decides about every
    // second vertex.
    const std::size_t rounds_to = std::max(2 * aim, fewest_for_rounds);
    while (alive_ > rounds_to) {
      report();
      if (queue.collapse_round(rounds_to, execution) == 0) break;
    }
    queue.fill(execution);
    while (alive_ > aim) {
      queue.collapse_next();
      if (alive_ % collapses_a_report == 0) report();
    }
  }
  const std::vector<char> absent = absent_triangles();
  present_.clear();
  present_.reserve(triangles_.size());
  for (std::size_t t = 0; t < absent.size(); ++t) {
    if (absent[t] == 0) present_.push_back(static_cast<std::int32_t>(t));
  }
}

std::vector<char> MeshCollapse::absent_triangles() const {
  std::vector<char> absent(triangles_.size(), 0);
  for (const std::int32_t h : log_) absent[h / 3] = absent[opposite_[h] / 3] = 1;
  return absent;
}

}  // namespace wscvt
