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
  double error = 0.0;
  for (const std::int32_t t : {t0, t1}) {
    for (const std::int32_t s : state.lists[t]) {
      const Vector3& sample = state.samples[s];
      const RefinementFacet& facet = flip.divide.dot(sample) > 0.0 ? flip.origin : flip.end;
      error += state.penalty(facet.residual(sample));
    }
  }
  const double gain = old_error - error;
  return gain > smallest_flip_gain * old_error ? gain : 0.0;
}

}  // namespace

FlipFacets flip_facets(const RefinementState& state, std::int32_t half_edge) {
  const std::int32_t other = state.triangulation.opposite()[half_edge];
  const Vector3& a = state.positions[state.triangulation.origin(half_edge)];
  const Vector3& b = state.positions[state.triangulation.origin(other)];
  const Vector3& c = state.positions[state.corner_left_of(half_edge)];
  const Vector3& d = state.positions[state.corner_left_of(other)];
  return {{a, b, c}, {b, a, d}, {c, a, d}, {d, b, c}, d.cross(c)};
}

void flip_edge(RefinementState& state, std::int32_t half_edge) {
  const std::int32_t t0 = half_edge / 3;
  const std::int32_t t1 = state.triangulation.opposite()[half_edge] / 3;
  const Vector3 divide = flip_facets(state, half_edge).divide;
  SampleList origin;
  SampleList end;
  for (const std::int32_t t : {t0, t1}) {
    for (const std::int32_t s : state.lists[t]) {
      (divide.dot(state.samples[s]) > 0.0 ? origin : end).push_back(s);
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
