// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "wscvt/nodes/fit_steps.h"

namespace wscvt {

namespace {

/// Fraction of the nodes that may move in a round.
constexpr double relocated_share = 0.06;
/// The gain of a new position must be this many times the cost of removing the node.
constexpr double relocation_gain = 1.1;
/// Springs count less than in a step, because they relax afterwards.
constexpr double relocation_springs = 0.3;
/// Candidates tried for each node that may move.
constexpr std::size_t candidates_a_move = 6;
/// Number of removals looked at first, to know how much a new node must gain at least.
constexpr std::size_t first_removals = 16;
/// Spokes about a new node, in mean edges about it; shorter, because there is one more node.
constexpr double crowded_rest = 0.75;
constexpr int most_relocated_degree = 9;
constexpr std::size_t candidate_block = 16;
/// Smallest cosine to the scan of faces after a merge.
constexpr double merged_agreement = 0.3;
/// Smallest cosine between neighbouring faces after a merge, 143 degrees.
constexpr double most_folded = -0.8;

struct Removal {
  double cost = 1e300;
  std::int32_t v = -1;
  std::int32_t into = -1;

  bool operator<(const Removal& other) const {
    return std::tie(cost, v) < std::tie(other.cost, other.v);
  }
};

/// A new node on the edge opposite to node `c` of triangle `t`.
struct Insertion {
  double gain;
  std::int32_t t;
  std::int32_t c;
  Vector3 at = Vector3::Zero();

  bool operator<(const Insertion& other) const {
    return std::tie(other.gain, t, c) < std::tie(gain, other.t, other.c);
  }
};

class Relocations {
 public:
  Relocations(FitState& state, const Execution& execution)
      : state_(state),
        execution_(execution),
        mesh_(state.mesh),
        most_(std::max<std::size_t>(
            1,
            static_cast<std::size_t>(relocated_share * static_cast<double>(mesh_.points.size())))),
        spring_(relocation_springs * state.spring()),
        face_errors_(mesh_.triangles.size()),
        locked_(mesh_.points.size(), 0) {
    for (std::size_t t = 0; t < face_errors_.size(); ++t) {
      double errors = 0.0;
      for (const std::int32_t s : state_.of[t]) {
        errors += state_.error(state_.samples[s].place.squared_distance);
      }
      const double excess = state_.excess(t);
      face_errors_[t] = state_.share() * errors + state_.round.price * excess * excess;
    }
  }

  int run() {
    const std::vector<std::int32_t> candidates = removal_candidates();
    const std::vector<Removal> first_ones =
        cheapest_removals(candidates, std::min(candidates.size(), first_removals), 1e300);
    if (first_ones.empty()) return 0;
    const std::vector<Insertion> insertions =
        find_insertions(relocation_gain * std::max(0.0, first_ones.front().cost));
    if (insertions.empty()) return 0;
    removals_ = cheapest_removals(
        candidates, std::min(candidates.size(), candidates_a_move * insertions.size() + 20),
        insertions.front().gain / relocation_gain);
    if (removals_.empty()) return 0;
    int done = 0;
    std::size_t first = 0;
    for (const Insertion& insertion : insertions) {
      if (done >= static_cast<int>(most_)) break;
      const EdgeSides quad = quad_of(insertion);
      if (quad.h < 0 || is_locked(quad)) continue;
      while (first < removals_.size() && removals_[first].v < 0) ++first;
      const std::size_t at = cheapest_away_from(quad, first);
      if (at == removals_.size() ||
          insertion.gain <= relocation_gain * std::max(removals_[at].cost, 0.0)) {
        break;
      }
      const Removal removal = removals_[at];
      if (!may_remove(removal)) {
        removals_[at].v = -1;
        continue;
      }
      if (!may_insert(insertion, quad)) continue;
      removals_[at].v = -1;
      relocate(removal, insertion, quad);
      ++done;
    }
    return done;
  }

 private:
  /// Returns the edge of an insertion; without half-edges if `c` is no corner of `t` any more.
  EdgeSides quad_of(const Insertion& insertion) const {
    const Triangle& corners = mesh_.triangles[insertion.t];
    const auto k = static_cast<std::int32_t>(
        std::find(corners.begin(), corners.end(), insertion.c) - corners.begin());
    return k == 3 ? EdgeSides() : mesh_.sides(next_half_edge(3 * insertion.t + k));
  }

  bool is_locked(const EdgeSides& quad) const {
    return locked_[quad.a] != 0 || locked_[quad.b] != 0 || locked_[quad.c] != 0 ||
           locked_[quad.d] != 0;
  }

  double rest_between(std::int32_t v, std::int32_t w) const {
    return 0.5 * (state_.ring_edge(v) + state_.ring_edge(w));
  }
  double spring_energy(std::int32_t v, std::int32_t w) const {
    const double off = (mesh_.points[v] - mesh_.points[w]).norm() - rest_between(v, w);
    return off * off;
  }

  /// Returns the nodes that may be cheapest to remove, the cheapest first.
  std::vector<std::int32_t> removal_candidates() const {
    std::vector<std::pair<double, std::int32_t>> candidates;
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const auto v = static_cast<std::int32_t>(i);
      if (mesh_.degrees[v] < 4) continue;
      double errors = 0.0;
      mesh_.around(v, [&](std::int32_t h) { errors += face_errors_[face_of(h)]; });
      const double edge = state_.ring_edge(v);
      candidates.emplace_back(errors + 2.0 * spring_ * edge * edge, v);
    }
    const std::size_t kept = std::min(candidates.size(), candidates_a_move * most_ + 20);
    std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(kept),
                      candidates.end());
    std::vector<std::int32_t> nodes;
    nodes.reserve(kept);
    for (std::size_t i = 0; i < kept; ++i) nodes.push_back(candidates[i].second);
    return nodes;
  }

  /// Returns the removals of the first `kept` candidates that cost less than `most`, ascending.
  std::vector<Removal> cheapest_removals(const std::vector<std::int32_t>& candidates,
                                         std::size_t kept, double most) const {
    std::vector<Removal> removals(kept);
    execution_.parallel_for_each(kept, candidate_block, [&](std::size_t i) {
      removals[i] = cheapest_removal(candidates[i], most);
    });
    removals.erase(std::remove_if(removals.begin(), removals.end(),
                                  [](const Removal& removal) { return removal.into < 0; }),
                   removals.end());
    std::sort(removals.begin(), removals.end());
    return removals;
  }

  Removal cheapest_removal(std::int32_t v, double most) const {
    const NodeRing ring = ring_of(mesh_, v);
    const std::vector<std::int32_t> pool = state_.pool(ring.triangles);
    Removal best;
    best.cost = most;
    best.v = v;
    double before = 0.0;
    for (const std::int32_t t : ring.triangles) before += face_errors_[t];
    for (const std::int32_t y : ring.nodes) before += spring_ * spring_energy(v, y);
    for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
      if (!may_merge(ring, i)) continue;
      const double cost = cost_of_merge(ring, i, pool, before, best.cost);
      if (cost >= best.cost) continue;
      best.cost = cost;
      best.into = ring.nodes[i];
    }
    return best;
  }

  /// Whether a node may be merged into node i of its ring, by degrees and common neighbours.
  bool may_merge(const NodeRing& ring, std::size_t i) const {
    const std::size_t count = ring.nodes.size();
    const std::int32_t u = ring.nodes[i];
    if (mesh_.degrees[ring.nodes[(i + 1) % count]] <= 4 ||
        mesh_.degrees[ring.nodes[(i + count - 1) % count]] <= 4 ||
        mesh_.degrees[u] + static_cast<int>(count) - 4 > most_relocated_degree) {
      return false;
    }
    int common = 0;
    mesh_.around(u, [&](std::int32_t h) {
      if (std::find(ring.nodes.begin(), ring.nodes.end(), mesh_.target(h)) != ring.nodes.end()) {
        ++common;
      }
    });
    return common == 2;
  }

  /// Returns the cost in errors, angles and springs of merging a ring's node into node i; 1e300 if
  /// the shape forbids it or the cost exceeds `most`.
  double cost_of_merge(const NodeRing& ring, std::size_t i, const std::vector<std::int32_t>& pool,
                       double before, double most) const {
    constexpr double never = 1e300;
    const std::size_t count = ring.nodes.size();
    const std::size_t faces = count - 2;
    const std::int32_t u = ring.nodes[i];
    const Vector3& centre = mesh_.points[u];
    const auto corner = [&](std::size_t j) { return ring.nodes[(i + 1 + j) % count]; };
    double cost = -before;
    std::vector<Vector3> normals(faces);
    std::vector<MeasuredTriangle> triangles;
    triangles.reserve(faces);
    for (std::size_t j = 0; j < faces; ++j) {
      const Vector3& x = mesh_.points[corner(j)];
      const Vector3& y = mesh_.points[corner(j + 1)];
      if (largest_corner_cosine(centre, x, y) > state_.round.early_sharpness) return never;
      normals[j] = unit_normal_of(centre, x, y);
      const Vector3 outward =
          state_.about[u] + state_.about[corner(j)] + state_.about[corner(j + 1)];
      if (normals[j].dot(outward) < merged_agreement * outward.norm()) return never;
      const double excess = state_.excess(centre, x, y);
      cost += state_.round.price * excess * excess;
      if (j > 0) cost += spring_ * spring_energy(u, corner(j));
      triangles.emplace_back(centre, x, y);
    }
    std::vector<Vector3> sums(faces, Vector3::Zero());
    std::vector<int> counts(faces, 0);
    for (const std::int32_t s : pool) {
      double nearest = 1e300;
      std::size_t in = 0;
      for (std::size_t j = 0; j < faces; ++j) {
        const double squared = triangles[j].nearest(state_.samples[s].point).squared_distance;
        if (squared >= nearest) continue;
        nearest = squared;
        in = j;
      }
      cost += state_.share() * state_.error(nearest);
      if (cost > most) return never;
      sums[in] += state_.samples[s].normal;
      ++counts[in];
    }
    for (std::size_t j = 0; j < faces; ++j) {
      if (counts[j] >= 3 && normals[j].dot(sums[j]) < face_agreement * sums[j].norm()) return never;
    }
    return cost;
  }

  /// Returns new nodes that gain more than `least`, the best first.
  std::vector<Insertion> find_insertions(double least) const {
    std::vector<Insertion> insertions;
    for (std::size_t h = 0; h < mesh_.opposite.size(); ++h) {
      const std::size_t t = h / 3;
      const std::size_t u = face_of(mesh_.opposite[h]);
      if (u < t) continue;
      const double errors = face_errors_[t] + face_errors_[u];
      insertions.push_back(
          {errors, static_cast<std::int32_t>(t), mesh_.apex(static_cast<std::int32_t>(h))});
    }
    const std::size_t kept = std::min(insertions.size(), candidates_a_move * most_);
    std::partial_sort(insertions.begin(), insertions.begin() + static_cast<std::ptrdiff_t>(kept),
                      insertions.end());
    insertions.resize(kept);
    execution_.parallel_for_each(kept, candidate_block,
                                 [&](std::size_t i) { try_insertion(insertions[i], least); });
    std::sort(insertions.begin(), insertions.end());
    while (!insertions.empty() && insertions.back().gain <= 0.0) insertions.pop_back();
    return insertions;
  }

  /// Finds the position of a new node and its gain.
  void try_insertion(Insertion& insertion, double least) const {
    constexpr int steps = 3;
    const EdgeSides quad = quad_of(insertion);
    const double before =
        face_errors_[quad.t] + face_errors_[quad.u] + spring_ * spring_energy(quad.a, quad.b);
    insertion.gain = -1.0;
    if (before <= least) return;
    FitFan fan;
    fan.nodes = {quad.c, quad.a, quad.d, quad.b};
    double edges = 0.0;
    for (const std::int32_t v : fan.nodes) {
      fan.ring.push_back(mesh_.points[v]);
      edges += 0.25 * state_.ring_edge(v);
    }
    fan.samples = state_.pool({quad.t, quad.u});
    fan.places.assign(fan.samples.size(), -1);
    fan.rest = crowded_rest * edges;
    fan.spring = spring_;
    Vector3 at = 0.5 * (mesh_.points[quad.a] + mesh_.points[quad.b]);
    double best = 1e300;
    double last = 1e300;
    for (int step = 0; step <= steps; ++step) {
      FanEquations equations;
      const double energy = fan_energy(state_, fan, at, step < steps ? &equations : nullptr);
      if (energy < best) {
        best = energy;
        insertion.at = at;
      }
      if (step == steps || energy > 1.5 * last) break;
      last = energy;
      at += equations.step(0.4 * fan.rest);
    }
    insertion.gain = fan_is_fine(state_, fan, insertion.at) ? before - best : -1.0;
  }

  /// Returns the first removal from `first` on with node and ring outside a quad and not locked.
  std::size_t cheapest_away_from(const EdgeSides& quad, std::size_t first) {
    const auto in_quad = [&](std::int32_t v) {
      return v == quad.a || v == quad.b || v == quad.c || v == quad.d;
    };
    for (std::size_t j = first; j < removals_.size(); ++j) {
      const std::int32_t v = removals_[j].v;
      if (v < 0) continue;
      bool locked = locked_[v] != 0;
      bool near = in_quad(v);
      mesh_.around(v, [&](std::int32_t h) {
        locked = locked || locked_[mesh_.target(h)] != 0;
        near = near || in_quad(mesh_.target(h));
      });
      if (locked) {
        removals_[j].v = -1;
      } else if (!near) {
        return j;
      }
    }
    return removals_.size();
  }

  /// Whether the faces after a removal are not folded and do not intersect other triangles.
  bool may_remove(const Removal& removal) const {
    const NodeRing ring = ring_of(mesh_, removal.v);
    const std::size_t count = ring.nodes.size();
    const auto at = static_cast<std::size_t>(
        std::find(ring.nodes.begin(), ring.nodes.end(), removal.into) - ring.nodes.begin());
    const Vector3& centre = mesh_.points[removal.into];
    std::vector<Vector3> open;
    std::vector<std::int32_t> beyond;
    for (std::size_t i = 1; i < count; ++i) {
      open.push_back(mesh_.points[ring.nodes[(at + i) % count]]);
      beyond.push_back(ring.beyond[(at + i) % count]);
    }
    const double turn =
        std::min({sharpest_turn(state_, centre, open, beyond, false),
                  unit_normal_of(centre, open[0], open[1]).dot(state_.unit_normal(ring.beyond[at])),
                  unit_normal_of(centre, open[count - 3], open[count - 2])
                      .dot(state_.unit_normal(ring.beyond[(at + count - 1) % count]))});
    if (turn < most_folded) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int32_t y = ring.nodes[i];
      const std::int32_t z = ring.nodes[(i + 1) % count];
      if (y == removal.into || z == removal.into) continue;
      if (state_.hash.meets(mesh_, {removal.into, y, z}, {centre, mesh_.points[y], mesh_.points[z]},
                            ring.triangles)) {
        return false;
      }
    }
    return true;
  }

  bool may_insert(const Insertion& insertion, const EdgeSides& quad) const {
    const std::array<std::int32_t, 4> nodes = {quad.c, quad.a, quad.d, quad.b};
    std::vector<Vector3> ring;
    for (const std::int32_t v : nodes) ring.push_back(mesh_.points[v]);
    const auto beyond = [&](std::int32_t h) {
      return static_cast<std::int32_t>(face_of(mesh_.opposite[h]));
    };
    const double turn =
        sharpest_turn(state_, insertion.at, ring,
                      {beyond(previous_half_edge(quad.h)), beyond(next_half_edge(quad.g)),
                       beyond(previous_half_edge(quad.g)), beyond(next_half_edge(quad.h))},
                      true);
    if (turn < most_folded) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t next = (i + 1) % 4;
      if (state_.hash.meets(mesh_, {-1, nodes[i], nodes[next]}, {insertion.at, ring[i], ring[next]},
                            {quad.t, quad.u})) {
        return false;
      }
    }
    return true;
  }

  void relocate(const Removal& removal, const Insertion& insertion, const EdgeSides& quad) {
    const NodeRing ring = ring_of(mesh_, removal.v);
    for (const std::int32_t y : ring.nodes) locked_[y] = 1;
    for (const std::int32_t v : {removal.v, quad.a, quad.b, quad.c, quad.d}) locked_[v] = 1;
    std::vector<std::int32_t> samples = state_.pool(ring.triangles);
    for (const std::int32_t t : ring.triangles) {
      state_.of[t].clear();
      state_.sample_normals[t].setZero();
    }
    std::int32_t edge = mesh_.first[removal.v];
    while (mesh_.target(edge) != removal.into) edge = mesh_.opposite[previous_half_edge(edge)];
    const std::array<std::int32_t, 2> free = mesh_.collapse(edge);
    std::vector<std::int32_t> kept;
    for (const std::int32_t t : ring.triangles) {
      if (t != free[0] && t != free[1]) kept.push_back(t);
    }
    state_.deal(samples, kept);
    samples = state_.pool({quad.t, quad.u});
    mesh_.points[removal.v] = insertion.at;
    mesh_.put_on_edge(removal.v, quad.h, free);
    state_.deal(samples, {quad.t, free[0], quad.u, free[1]});
    for (const std::int32_t t : kept) state_.hash.enter(mesh_, t);
    for (const std::int32_t t : {quad.t, free[0], quad.u, free[1]}) state_.hash.enter(mesh_, t);
    state_.about[removal.v] = 0.5 * (state_.about[quad.a] + state_.about[quad.b]);
    if (!state_.ring_edges.empty()) {
      state_.ring_edges[removal.v] = crowded_rest * rest_between(quad.a, quad.b);
    }
    if (!state_.spacing.empty()) {
      state_.spacing[removal.v] = 0.5 * (state_.spacing[quad.a] + state_.spacing[quad.b]);
    }
  }

  FitState& state_;
  const Execution& execution_;
  EditMesh& mesh_;
  std::size_t most_;
  double spring_;
  std::vector<double> face_errors_;
  std::vector<char> locked_;
  std::vector<Removal> removals_;
};

}  // namespace

int relocate_nodes(FitState& state, const Execution& execution) {
  return Relocations(state, execution).run();
}

}  // namespace wscvt
