// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_relocations.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/nodes/refinement_fan.h"

namespace wscvt {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A node is taken elsewhere when that saves this many times what it costs. Gain and cost are
/// estimates, since the nodes about both places have not followed yet: at 1 nodes would go to and
/// fro between places that are alike.
constexpr double relocation_margin = 1.1;

/// The cheapest way to do without a node.
struct Collapse {
  std::int32_t half_edge = -1;  ///< from the node that goes to the node its triangles go to
  double cost = infinity;
};

/// What a node on an edge would gain.
struct Split {
  std::int32_t half_edge = -1;
  double gain = 0.0;
};

/// What stands in the place of a fan that is joined to one of its ring.
struct JoinedFan {
  std::vector<Triangle> triangles;
  std::vector<SampleList> lists;  ///< per triangle
};

/// Error of the triangles that take the place of a node's fan when all are joined to its neighbour
/// `towards` (an index into the ring, which stands in work.fan); infinite when that breaks a
/// promise or exceeds `bound`. The triangles themselves go to `joined`, unless null.
///
/// No link condition is asked for. The fan fills a polygon on the sphere of directions, whose
/// outline the new triangles share; as all of them turn counter-clockwise about the origin, they
/// fill the same polygon once. Their new edges lie within it and are therefore no edge that was
/// there already: two great arcs between the same ends, less than half a circle each, are one. So
/// whatever passes the guard is a triangulation of the sphere.
double join_fan(const RefinementState& state, std::size_t towards, FanWorkspace& work,
                const FanLimits& limits, double bound, JoinedFan* joined) {
  const std::vector<std::int32_t>& ring = work.fan.ring;
  const std::size_t count = ring.size();
  const auto corner = [&](std::size_t k) { return ring[(towards + k) % count]; };
  const auto across = [&](std::size_t k) { return work.fan.outer[(towards + k) % count]; };
  const RefinementNode& apex = state.nodes[corner(0)];
  double turn = 1.0;
  double error = 0.0;
  std::vector<RefinementFacet>& facets = work.joined;
  // spokes[k]: plane of origin, apex and the far corner of facets[k]
  std::vector<Vector3>& spokes = work.spokes;
  facets.clear();
  spokes.clear();
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const RefinementNode& far = state.nodes[corner(k + 1)];
    const Vector3 before = k == 1 ? across(0) : facets.back().normal;
    facets.emplace_back(apex, state.nodes[corner(k)], far);
    if (!facets.back().acceptable(limits.largest_cosine)) return infinity;
    error += state.angle_penalty(facets.back());
    const Vector3& normal = facets.back().normal;
    turn = std::min({turn, normal.dot(before), normal.dot(across(k))});
    spokes.push_back(apex.direction.cross(far.direction));
    if (joined != nullptr) joined->triangles.push_back({corner(0), corner(k), corner(k + 1)});
  }
  turn = std::min(turn, facets.back().normal.dot(across(count - 1)));
  if (!state.may_turn(turn, limits.turn, work.triangles, work.fan.beside)) return infinity;
  if (joined != nullptr) joined->lists.resize(facets.size());
  for (const std::int32_t t : work.triangles) {
    for (const std::int32_t s : state.lists[t]) {
      std::size_t k = 0;
      while (k + 1 < facets.size() && spokes[k].dot(state.samples.direction(s)) > 0.0) ++k;
      error += state.penalty(facets[k].residual(state.samples.points[s]));
      if (joined != nullptr) joined->lists[k].push_back(s);
    }
    if (error > bound) return infinity;
  }
  return error;
}

Collapse cheapest_collapse(const RefinementState& state, std::int32_t node, FanWorkspace& work) {
  Collapse best;
  FanLimits limits = load_facets(state, node, work);
  // Three neighbours leave one triangle, whichever they are joined to: a node in the middle of a
  // triangle that was split there, which the moves and flips have to deal with first.
  if (work.fan.ring.size() < 4) return best;
  limits.largest_cosine = std::max(limits.largest_cosine, state.cosine_limit);
  const double old_error = work.fan.error;
  std::int32_t h = state.triangulation.first_half_edge()[node];
  for (std::size_t towards = 0; towards < work.fan.ring.size(); ++towards) {
    const double error = join_fan(state, towards, work, limits, best.cost + old_error, nullptr);
    if (error - old_error < best.cost) {
      best.cost = error - old_error;
      best.half_edge = h;
    }
    h = state.triangulation.opposite()[SphereTriangulation::previous(h)];
  }
  return best;
}

/// Puts into work.fan the fan of a node to be inserted on an edge, at the place that suits it best;
/// false when there is none.
bool split_edge(const RefinementState& state, std::int32_t half_edge, FanWorkspace& work) {
  const std::int32_t other = state.triangulation.opposite()[half_edge];
  const std::int32_t a = state.triangulation.origin(half_edge);
  const std::int32_t b = state.triangulation.origin(other);
  // The fan of a node on the edge, with the samples of both triangles in one of its halves each:
  // placing it deals them out.
  RefinementFan& start = work.trial;
  start.ring = {b, state.corner_left_of(half_edge), a, state.corner_left_of(other)};
  start.resize();
  for (std::size_t j = 0; j < 4; ++j) start.lists[j].clear();
  start.lists[0] = state.lists[half_edge / 3];
  start.lists[2] = state.lists[other / 3];
  start.node = state.nodes[a];
  const std::int32_t sides[] = {
      SphereTriangulation::next(half_edge), SphereTriangulation::previous(half_edge),
      SphereTriangulation::next(other), SphereTriangulation::previous(other)};
  const RefinementFacet left = state.facet(half_edge / 3);
  const RefinementFacet right = state.facet(other / 3);
  FanLimits limits{std::max({state.cosine_limit, left.largest_cosine, right.largest_cosine}),
                   left.normal.dot(right.normal)};
  for (std::size_t j = 0; j < 4; ++j) {
    start.beside[j] = state.triangulation.opposite()[sides[j]] / 3;
    start.outer[j] = state.normal(start.beside[j]);
    limits.turn = std::min(limits.turn, start.outer[j].dot((j < 2 ? left : right).normal));
  }
  if (!place_fan(state, start, 0.5 * (state.nodes[a].position + state.nodes[b].position), limits,
                 work.fan, work.spokes)) {
    return false;
  }
  // A middle of an edge saves nothing on a ridge; a few steps show what the node is worth there.
  for (int step = 0; step < 3 && improve_fan(state, work, limits); ++step) {
  }
  return true;
}

/// Carries out a collapse and a split that were tried before, on triangles unchanged since.
void relocate(RefinementState& state, const Collapse& from, const Split& to, FanWorkspace& work) {
  const std::int32_t node = state.triangulation.origin(from.half_edge);
  const std::int32_t other = state.triangulation.opposite()[to.half_edge];
  load_facets(state, node, work);
  std::vector<std::int32_t> slots = work.triangles;
  slots.push_back(to.half_edge / 3);
  slots.push_back(other / 3);
  const std::int32_t neighbour =
      state.triangulation.origin(SphereTriangulation::next(from.half_edge));
  const auto towards = static_cast<std::size_t>(
      std::find(work.fan.ring.begin(), work.fan.ring.end(), neighbour) - work.fan.ring.begin());
  // Both were tried on these very triangles, the fan with limits that may be a rounding above a
  // cosine's largest value; those here let everything pass.
  constexpr FanLimits no_limits{2.0, -2.0};
  JoinedFan made;
  if (!(join_fan(state, towards, work, no_limits, infinity, &made) < infinity) ||
      !split_edge(state, to.half_edge, work)) {
    throw Error(ErrorCode::NumericalFailure,
                "The refinement cannot take a node elsewhere where its trial could; refine with "
                "fewer rounds.");
  }
  state.nodes[node] = work.fan.node;
  state.node_errors[node] = work.fan.node_error;
  for (std::size_t j = 0; j < 4; ++j) {
    made.triangles.push_back({node, work.fan.ring[j], work.fan.ring[(j + 1) % 4]});
    made.lists.push_back(work.fan.lists[j]);
  }
  // The fan's triangles become two fewer, and the edge's two become four: the slots suffice.
  state.triangulation.replace(slots, made.triangles);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    state.lists[slots[i]].swap(made.lists[i]);
    state.errors[slots[i]] = state.error_of(state.facet(made.triangles[i]), state.lists[slots[i]]);
  }
}

/// What each node costs to do without, cheapest first. Ties go by half-edge, so that the order does
/// not depend on the sort.
std::vector<Collapse> sorted_collapses(const RefinementState& state, const Execution& execution) {
  std::vector<Collapse> collapses(state.nodes.size());
  execution.parallel_for(
      collapses.size(), refinement_block, [&](std::size_t begin, std::size_t end) {
        FanWorkspace work;
        for (std::size_t i = begin; i < end; ++i) {
          collapses[i] = cheapest_collapse(state, static_cast<std::int32_t>(i), work);
        }
      });
  std::sort(collapses.begin(), collapses.end(), [](const Collapse& x, const Collapse& y) {
    return x.cost != y.cost ? x.cost < y.cost : x.half_edge < y.half_edge;
  });
  return collapses;
}

/// What a node on each edge would gain, the most first; half-edge -1 where it is not worth trying.
std::vector<Split> sorted_splits(const RefinementState& state, double cheapest,
                                 const Execution& execution) {
  std::vector<Split> splits(state.triangulation.opposite().size());
  execution.parallel_for(splits.size(), refinement_block, [&](std::size_t begin, std::size_t end) {
    FanWorkspace work;
    for (std::size_t i = begin; i < end; ++i) {
      const auto h = static_cast<std::int32_t>(i);
      const std::int32_t other = state.triangulation.opposite()[h];
      if (h > other) continue;  // each edge once
      // No split gains more than the whole error of its two triangles.
      const double error = state.errors[h / 3] + state.errors[other / 3];
      if (!(error > relocation_margin * cheapest) || !split_edge(state, h, work)) continue;
      splits[i] = {h, error - work.fan.error};
    }
  });
  std::sort(splits.begin(), splits.end(), [](const Split& x, const Split& y) {
    return x.gain != y.gain ? x.gain > y.gain : x.half_edge < y.half_edge;
  });
  return splits;
}

}  // namespace

int relocate_nodes(RefinementState& state, const Execution& execution) {
  const std::vector<Collapse> collapses = sorted_collapses(state, execution);
  const std::vector<Split> splits = sorted_splits(state, collapses.front().cost, execution);

  // Gains and costs hold as long as the triangles they were computed on: one relocation a triangle,
  // and none beside another's, whose normals the guard of the turns has read.
  const std::vector<std::int32_t>& opposite = state.triangulation.opposite();
  std::vector<char> touched(state.triangulation.triangles().size(), 0);
  const auto is_touched = [&](std::int32_t t) {
    return std::any_of(opposite.begin() + 3 * t, opposite.begin() + 3 * t + 3,
                       [&](std::int32_t h) { return touched[h / 3] != 0; }) ||
           touched[t] != 0;
  };
  FanWorkspace work;
  int relocations = 0;
  std::size_t next_split = 0;
  for (const Collapse& from : collapses) {
    if (!(from.cost < infinity)) break;
    state.ring_of(state.triangulation.origin(from.half_edge), work.fan.ring, &work.triangles);
    if (std::any_of(work.triangles.begin(), work.triangles.end(), is_touched)) continue;
    for (const std::int32_t t : work.triangles) touched[t] = 1;
    while (next_split < splits.size() && splits[next_split].half_edge >= 0 &&
           (is_touched(splits[next_split].half_edge / 3) ||
            is_touched(state.triangulation.opposite()[splits[next_split].half_edge] / 3))) {
      ++next_split;
    }
    // Costs rise and gains fall from here on: the first pair that does not pay is the last.
    if (next_split == splits.size() || splits[next_split].half_edge < 0 ||
        !(splits[next_split].gain > relocation_margin * from.cost)) {
      break;
    }
    const Split to = splits[next_split++];
    touched[to.half_edge / 3] = 1;
    touched[state.triangulation.opposite()[to.half_edge] / 3] = 1;
    relocate(state, from, to, work);
    ++relocations;
  }
  return relocations;
}

}  // namespace wscvt
