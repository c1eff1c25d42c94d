// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/fit_guards.h"

#include <algorithm>
#include <utility>

#include "wscvt/surface/delaunay_flips.h"

namespace wscvt {

namespace {

/// Longest step, in the shorter of the mean edge about a node and the mesh's mean edge.
constexpr double longest_fit_step = 0.35;
/// Smallest cosine of a triangle's turn by one step: 72 degrees.
constexpr double most_step_turn = 0.3;
/// Triangles with fewer samples are judged by the samples about their corners.
constexpr std::size_t enough_samples = 4;
constexpr std::size_t enough_to_agree = 3;
constexpr std::size_t guarded_block = 1024;

class GuardedMove {
 public:
  GuardedMove(FitState& state, std::vector<Vector3> step, const Execution& execution)
      : state_(state),
        execution_(execution),
        mesh_(state.mesh),
        step_(std::move(step)),
        old_(mesh_.points),
        shares_(mesh_.points.size(), 1.0),
        marked_(mesh_.points.size(), 0),
        old_normals_(mesh_.triangles.size()),
        normals_(mesh_.triangles.size()),
        outward_(mesh_.triangles.size()),
        old_sharpness_(mesh_.triangles.size()) {
    const std::vector<Vector3>& about = state_.about;
    const auto look = [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        old_sharpness_[t] = mesh_.sharpness(t);
        old_normals_[t] = state_.unit_normal(t);
        outward_[t] = outward_of(t, about);
      }
    };
    execution_.parallel_for(mesh_.triangles.size(), guarded_block, look);
  }

  void run() {
    for (std::size_t i = 0; i < step_.size(); ++i) {
      const double most =
          longest_fit_step * std::min(state_.edge, state_.ring_edge(static_cast<std::int32_t>(i)));
      const double length = step_[i].norm();
      if (length > most) step_[i] *= most / length;
      mesh_.points[i] = old_[i] + step_[i];
    }
    constexpr int most_tries = 16;
    constexpr int tries_of_pairs = 11;
    constexpr int halvings = 8;
    constexpr int shortenings = 6;
    for (int attempt = 0; attempt < most_tries; ++attempt) {
      std::fill(marked_.begin(), marked_.end(), 0);
      bool spoilt = mark_spoilt();
      spoilt = mark_folded() || spoilt;
      if (spoilt) {
        shorten(attempt < halvings ? 0.5 : 0.0);
        continue;
      }
      if (attempt >= tries_of_pairs) break;
      if (!state_.round.checks_pairs) {
        state_.build_hash();
        return;
      }
      if (!mark_meeting()) {
        if (none_meet_) return;
        break;
      }
      shorten(attempt < shortenings ? 0.4 : 0.0);
    }
    take_back_meeting();
  }

 private:
  Vector3 outward_of(std::size_t t, const std::vector<Vector3>& about) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vector3 sum =
        state_.of[t].size() >= enough_samples
            ? state_.sample_normals[t]
            : Vector3(about[a].normalized() + about[b].normalized() + about[c].normalized());
    const double length = sum.norm();
    return length > 0.0 ? Vector3(sum / length) : sum;
  }

  void mark(std::size_t t) {
    for (const std::int32_t v : mesh_.triangles[t]) marked_[v] = 1;
  }
  /// Marks the nodes that have a step left; returns whether there are any.
  bool mark_free(std::size_t t) {
    bool any = false;
    for (const std::int32_t v : mesh_.triangles[t]) {
      if (shares_[v] == 0.0) continue;
      marked_[v] = 1;
      any = true;
    }
    return any;
  }

  void shorten(double factor) {
    for (std::size_t i = 0; i < marked_.size(); ++i) {
      if (marked_[i] == 0) continue;
      shares_[i] *= factor;
      mesh_.points[i] = shares_[i] == 0.0 ? old_[i] : Vector3(old_[i] + shares_[i] * step_[i]);
    }
  }

  bool is_spoilt(std::size_t t) const {
    const Vector3& normal = normals_[t];
    const double after = normal.dot(outward_[t]);
    const double before = old_normals_[t].dot(outward_[t]);
    return normal.dot(old_normals_[t]) < most_step_turn ||
           mesh_.sharpness(t) > std::max(state_.round.sharpness_limit, old_sharpness_[t]) + 1e-9 ||
           (after < least_agreement && after < before);
  }

  bool mark_spoilt() {
    std::vector<char> spoilt(mesh_.triangles.size());
    execution_.parallel_for(spoilt.size(), guarded_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        normals_[t] = state_.unit_normal(t);
        spoilt[t] = is_spoilt(t) ? 1 : 0;
      }
    });
    bool any = false;
    for (std::size_t t = 0; t < spoilt.size(); ++t) {
      if (spoilt[t] == 0) continue;
      mark(t);
      any = true;
    }
    return any;
  }

  bool mark_folded() {
    const auto agrees = [&](std::size_t t) {
      return state_.of[t].size() >= enough_to_agree &&
             normals_[t].dot(outward_[t]) > face_agreement;
    };
    bool any = false;
    for (std::size_t h = 0; h < mesh_.opposite.size(); ++h) {
      const std::size_t t = h / 3;
      const std::size_t u = face_of(mesh_.opposite[h]);
      if (u < t) continue;
      const double cosine = normals_[t].dot(normals_[u]);
      if (cosine >= folded || cosine >= old_normals_[t].dot(old_normals_[u]) - 1e-9) continue;
      if (agrees(t) && agrees(u)) continue;
      any = mark_free(t) || any;
      any = mark_free(u) || any;
    }
    return any;
  }

  /// Marks triangles that intersect now and did not before.
  bool mark_meeting() {
    state_.build_hash();
    bool any = false;
    none_meet_ = true;
    for (const auto& [t, u] : state_.hash.pairs(mesh_, execution_)) {
      none_meet_ = false;
      state_.had_pairs = true;
      const auto at = [&](std::int32_t f) {
        const auto& [a, b, c] = mesh_.triangles[f];
        return std::array<Vector3, 3>{old_[a], old_[b], old_[c]};
      };
      if (triangles_cross(mesh_.triangles[t], at(t), mesh_.triangles[u], at(u))) continue;
      any = mark_free(t) || any;
      any = mark_free(u) || any;
    }
    return any;
  }

  /// Moves triangles that still intersect back to their old positions.
  void take_back_meeting() {
    constexpr int most_rounds = 40;
    for (int round = 0; round < most_rounds; ++round) {
      state_.build_hash();
      bool any = false;
      for (const auto& [t, u] : state_.hash.pairs(mesh_, execution_)) {
        for (const std::int32_t f : {t, u}) {
          for (const std::int32_t v : mesh_.triangles[f]) {
            if (shares_[v] == 0.0) continue;
            shares_[v] = 0.0;
            mesh_.points[v] = old_[v];
            any = true;
          }
        }
      }
      if (!any) return;
    }
  }

  FitState& state_;
  const Execution& execution_;
  EditMesh& mesh_;
  std::vector<Vector3> step_;
  std::vector<Vector3> old_;
  std::vector<double> shares_;
  std::vector<char> marked_;
  std::vector<Vector3> old_normals_;
  std::vector<Vector3> normals_;  ///< at the nodes' current positions; unit
  std::vector<Vector3> outward_;  ///< the scan's direction at each triangle; unit or zero
  std::vector<double> old_sharpness_;
  bool none_meet_ = false;  ///< at the last check, if no node has moved since
};

}  // namespace

void move_nodes(FitState& state, std::vector<Vector3> step, const Execution& execution) {
  GuardedMove(state, std::move(step), execution).run();
}

}  // namespace wscvt
