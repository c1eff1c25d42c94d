// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/refinement_flips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace wscvt {

namespace {

/// Smallest share of the error of the triangles concerned that an edge flip has to save. Less is
/// rounding, or the sampling's choice between two diagonals of a flat quadrangle, and would be
/// taken back a round later.
constexpr double smallest_flip_gain = 1e-3;

/// What a flip saves of the error of its two triangles; 0 when it is not allowed or not worth it.
///
/// No link condition is asked for. Both new triangles turn counter-clockwise about the origin, so
/// the two corners c and d see each other through the quadrangle on the sphere of directions. An
/// edge between them that was there already would be the same great arc, and lie outside the
/// quadrangle: on a triangulation without overlaps there is none.
double flip_gain(const RefinementState& state, std::int32_t half_edge) {
  const std::int32_t t0 = half_edge / 3;
  const std::int32_t t1 = state.triangulation.opposite()[half_edge] / 3;
  const double old_error = state.errors[t0] + state.errors[t1];
  if (!(old_error > 0.0)) return 0.0;
  const FlipFacets flip = flip_facets(state, half_edge);
  if (!flip.acceptable(std::max(state.cosine_limit, flip.largest_cosine()))) return 0.0;
  double error = state.angle_penalty(flip.origin) + state.angle_penalty(flip.end);
  for (const std::int32_t t : {t0, t1}) {
    for (const std::int32_t s : state.lists[t]) {
      const RefinementFacet& facet =
          flip.divide.dot(state.samples.direction(s)) > 0.0 ? flip.origin : flip.end;
      error += state.penalty(facet.residual(state.samples.points[s]));
    }
  }
  const double gain = old_error - error;
  const bool pays = gain > smallest_flip_gain * old_error;
  return pays && flip_may_turn(state, half_edge, flip) ? gain : 0.0;
}

}  // namespace

FlipFacets flip_facets(const RefinementState& state, std::int32_t half_edge) {
  const std::int32_t other = state.triangulation.opposite()[half_edge];
  const RefinementNode& a = state.nodes[state.triangulation.origin(half_edge)];
  const RefinementNode& b = state.nodes[state.triangulation.origin(other)];
  const RefinementNode& c = state.nodes[state.corner_left_of(half_edge)];
  const RefinementNode& d = state.nodes[state.corner_left_of(other)];
  return {{a, b, c}, {b, a, d}, {c, a, d}, {d, b, c}, d.direction.cross(c.direction)};
}

bool flip_may_turn(const RefinementState& state, std::int32_t half_edge, const FlipFacets& flip) {
  const std::vector<std::int32_t>& opposite = state.triangulation.opposite();
  const std::int32_t other = opposite[half_edge];
  std::vector<std::int32_t> beside;
  const auto across = [&](std::int32_t h) {
    beside.push_back(opposite[h] / 3);
    return state.normal(beside.back());
  };
  const Vector3 bc = across(SphereTriangulation::next(half_edge));
  const Vector3 ca = across(SphereTriangulation::previous(half_edge));
  const Vector3 ad = across(SphereTriangulation::next(other));
  const Vector3 db = across(SphereTriangulation::previous(other));
  const auto worst = [](const Vector3& first, const Vector3& next, const Vector3& last,
                        const Vector3& second, const Vector3& its, const Vector3& its_too) {
    return std::min({first.dot(second), first.dot(next), first.dot(last), second.dot(its),
                     second.dot(its_too)});
  };
  const double before = worst(flip.left.normal, bc, ca, flip.right.normal, ad, db);
  const double after = worst(flip.origin.normal, ca, ad, flip.end.normal, db, bc);
  return state.may_turn(after, before, beside, std::vector<std::int32_t>{half_edge / 3, other / 3});
}

void flip_edge(RefinementState& state, std::int32_t half_edge) {
  const std::int32_t t0 = half_edge / 3;
  const std::int32_t t1 = state.triangulation.opposite()[half_edge] / 3;
  const Vector3 divide = flip_facets(state, half_edge).divide;
  SampleList origin;
  SampleList end;
  for (const std::int32_t t : {t0, t1}) {
    for (const std::int32_t s : state.lists[t]) {
      (divide.dot(state.samples.direction(s)) > 0.0 ? origin : end).push_back(s);
    }
  }
  state.triangulation.flip(half_edge);
  state.lists[t0].swap(origin);
  state.lists[t1].swap(end);
  for (const std::int32_t t : {t0, t1}) {
    state.errors[t] = state.error_of(state.facet(t), state.lists[t]);
  }
}

int flip_edges(RefinementState& state, const Execution& execution) {
  constexpr std::size_t block = 512;
  const std::vector<std::int32_t>& opposite = state.triangulation.opposite();
  const auto count = static_cast<std::int32_t>(opposite.size());
  std::vector<double> gains(opposite.size(), 0.0);
  execution.parallel_for(gains.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto h = static_cast<std::int32_t>(i);
      if (h < opposite[h]) gains[i] = flip_gain(state, h);
    }
  });
  std::vector<std::int32_t> candidates;
  for (std::int32_t h = 0; h < count; ++h) {
    if (gains[h] > 0.0) candidates.push_back(h);
  }
  // Stable, so that equal gains keep the order of the half-edges on every platform.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](std::int32_t h, std::int32_t g) { return gains[h] > gains[g]; });
  int flips = 0;
  for (const std::int32_t h : candidates) {
    // Flips beside this one may have changed its triangles.
    if (!(flip_gain(state, h) > 0.0)) continue;
    flip_edge(state, h);
    ++flips;
  }
  return flips;
}

}  // namespace wscvt
