// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/nodes/fit_steps.h"

namespace wscvt {

namespace {

/// Weight of a flip's fall of squared distance against squared changes of lengths.
constexpr double error_worth = 3.0;
/// Price of small angles, in squared edges times the springs' stiffness, and the margin above the
/// least angle at which it begins, in degrees.
constexpr double angle_price = 0.5;
constexpr double angle_margin = 5.0;
constexpr double angle_unit = 20.0;
/// A new edge is sharp below this cosine.
constexpr double sharp_new_edge = -0.2;

double square(double x) { return x * x; }

/// An edge ab, which would become cd.
struct FlipCandidate : EdgeSides {
  explicit FlipCandidate(const EdgeSides& sides) : EdgeSides(sides) {}

  Vector3 pa, pb, pc, pd;
  double sharpness_t, sharpness_u;  ///< of the triangles cad and cdb
  Vector3 normal_t, normal_u;       ///< unit, of the new triangles
  bool sharp = false;
};

class FitFlips {
 public:
  explicit FitFlips(FitState& state)
      : state_(state),
        mesh_(state.mesh),
        fine_sharpness_(portable::cos((state.round.least_angle + angle_margin) * pi / 180.0)),
        sharpness_(mesh_.triangles.size()),
        normals_(mesh_.triangles.size()),
        squares_(mesh_.triangles.size()) {
    for (std::size_t t = 0; t < squares_.size(); ++t) measure(t);
  }

  int run() {
    int flipped = 0;
    const auto faces = static_cast<std::int32_t>(mesh_.triangles.size());
    for (std::int32_t t = 0; t < faces; ++t) {
      for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (static_cast<std::int32_t>(face_of(mesh_.opposite[h])) < t) continue;
        if (!try_flip(h)) continue;
        ++flipped;
        break;
      }
    }
    return flipped;
  }

 private:
  bool try_flip(std::int32_t h) {
    FlipCandidate f(mesh_.sides(h));
    if (!look_at(f)) return false;
    const double cost = cost_of(f) + 1e-9 * state_.edge * state_.edge;
    const double most = squares_[f.t] + squares_[f.u] - cost / (error_worth * state_.share());
    if (most <= 0.0 || mesh_.joined(f.c, f.d) || !look_at_normals(f)) return false;
    if (!deal_samples(f, most) || !keeps_shape(f)) return false;
    const std::vector<std::int32_t> both = {f.t, f.u};
    if (state_.hash.meets(mesh_, {f.c, f.a, f.d}, {f.pc, f.pa, f.pd}, both) ||
        state_.hash.meets(mesh_, {f.c, f.d, f.b}, {f.pc, f.pd, f.pb}, both)) {
      return false;
    }
    flip(f);
    return true;
  }

  /// Measures a triangle for the flips of its edges.
  void measure(std::size_t t) {
    sharpness_[t] = mesh_.sharpness(t);
    normals_[t] = state_.unit_normal(t);
    squares_[t] = 0.0;
    for (const std::int32_t s : state_.of[t]) {
      squares_[t] += state_.samples[s].place.squared_distance;
    }
  }

  /// Reads the four nodes' angles; false if no flip is possible or angles forbid it.
  bool look_at(FlipCandidate& f) const {
    if (mesh_.degrees[f.a] <= 4 || mesh_.degrees[f.b] <= 4 || f.c == f.d) return false;
    f.pa = mesh_.points[f.a];
    f.pb = mesh_.points[f.b];
    f.pc = mesh_.points[f.c];
    f.pd = mesh_.points[f.d];
    f.sharpness_t = largest_corner_cosine(f.pc, f.pa, f.pd);
    f.sharpness_u = largest_corner_cosine(f.pc, f.pd, f.pb);
    return std::max(f.sharpness_t, f.sharpness_u) <=
           std::max({state_.round.sharpness_limit, sharpness_[f.t], sharpness_[f.u]});
  }

  /// Computes the new normals; false if a new triangle has no area.
  bool look_at_normals(FlipCandidate& f) const {
    f.normal_t = doubled_area_normal(f.pc, f.pa, f.pd);
    f.normal_u = doubled_area_normal(f.pc, f.pd, f.pb);
    const double area_t = f.normal_t.norm();
    const double area_u = f.normal_u.norm();
    if (area_t < 1e-300 || area_u < 1e-300) return false;
    f.normal_t /= area_t;
    f.normal_u /= area_u;
    const Vector3 mean = normals_[f.t] + normals_[f.u];
    const double bend = f.normal_t.dot(f.normal_u);
    f.sharp = f.normal_t.dot(mean) <= 0.0 || f.normal_u.dot(mean) <= 0.0 ||
              (bend < sharp_new_edge && bend < normals_[f.t].dot(normals_[f.u]));
    return true;
  }

  double rest_length(const FlipCandidate& f) const {
    if (state_.ring_edges.empty()) return state_.edge;
    double ring = 0.0;
    double spacing = 0.0;
    for (const std::int32_t v : {f.a, f.b, f.c, f.d}) {
      ring += 0.25 * state_.ring_edges[v];
      spacing += 0.25 * state_.node_spacing(v);
    }
    return (1.0 - state_.dial.local_share) * state_.edge * spacing + state_.dial.local_share * ring;
  }

  double small_angle(double sharpness) const {
    if (sharpness <= fine_sharpness_) return 0.0;
    const double angle = portable::acos(std::clamp(sharpness, -1.0, 1.0)) * 180.0 / pi;
    return square(std::max(0.0, state_.round.least_angle + angle_margin - angle) / angle_unit);
  }

  /// Cost of the flip in springs, degrees and angles.
  double cost_of(const FlipCandidate& f) const {
    const double rest = rest_length(f);
    const auto off = [&](std::int32_t v, int change) {
      return square(mesh_.degrees[v] + change - 6) - square(mesh_.degrees[v] - 6);
    };
    const double squared_edge = state_.edge * state_.edge;
    double cost = state_.spring() *
                  (square((f.pc - f.pd).norm() - rest) - square((f.pa - f.pb).norm() - rest));
    cost += state_.round.valence * squared_edge *
            (off(f.a, -1) + off(f.b, -1) + off(f.c, 1) + off(f.d, 1));
    if (state_.round.price > 0.0) {
      const auto excess = [&](double sharpness) {
        return square(std::max(0.0, sharpness - state_.round.goal_cosine) /
                      (1.0 - state_.round.goal_cosine));
      };
      cost += state_.round.price * (excess(f.sharpness_t) + excess(f.sharpness_u) -
                                    excess(sharpness_[f.t]) - excess(sharpness_[f.u]));
    }
    cost += angle_price * state_.spring() * squared_edge *
            (small_angle(f.sharpness_t) + small_angle(f.sharpness_u) -
             small_angle(sharpness_[f.t]) - small_angle(sharpness_[f.u]));
    return cost;
  }

  /// Assigns the samples to the new triangles; false once their errors reach `most`.
  bool deal_samples(const FlipCandidate& f, double most) {
    const MeasuredTriangle shape_t(f.pc, f.pa, f.pd);
    const MeasuredTriangle shape_u(f.pc, f.pd, f.pb);
    double after = 0.0;
    of_t_.clear();
    of_u_.clear();
    normals_t_.setZero();
    normals_u_.setZero();
    for (const std::int32_t from : {f.t, f.u}) {
      for (const std::int32_t s : state_.of[from]) {
        const FitSample& sample = state_.samples[s];
        const double to_t = shape_t.nearest(sample.point).squared_distance;
        const double to_u = shape_u.nearest(sample.point).squared_distance;
        after += std::min(to_t, to_u);
        if (after >= most) return false;
        if (to_t <= to_u) {
          of_t_.push_back(s);
          normals_t_ += sample.normal;
        } else {
          of_u_.push_back(s);
          normals_u_ += sample.normal;
        }
      }
    }
    return true;
  }

  bool keeps_shape(const FlipCandidate& f) const {
    constexpr std::size_t enough = 3;
    const bool agree = of_t_.size() >= enough && of_u_.size() >= enough &&
                       normals_t_.dot(f.normal_t) >= face_agreement * normals_t_.norm() &&
                       normals_u_.dot(f.normal_u) >= face_agreement * normals_u_.norm();
    if (agree) return true;
    if (f.sharp) return false;
    const auto beyond = [&](std::int32_t h) -> const Vector3& {
      return normals_[face_of(mesh_.opposite[h])];
    };
    const Vector3& cb = beyond(next_half_edge(f.h));
    const Vector3& ca = beyond(previous_half_edge(f.h));
    const Vector3& ad = beyond(next_half_edge(f.g));
    const Vector3& db = beyond(previous_half_edge(f.g));
    const Vector3& t = normals_[f.t];
    const Vector3& u = normals_[f.u];
    const double after = std::min({f.normal_t.dot(f.normal_u), f.normal_t.dot(ca),
                                   f.normal_t.dot(ad), f.normal_u.dot(cb), f.normal_u.dot(db)});
    const double before = std::min({t.dot(u), t.dot(cb), t.dot(ca), u.dot(ad), u.dot(db)});
    return after >= folded || after >= before - 1e-9;
  }

  void flip(const FlipCandidate& f) {
    mesh_.flip(f.h);  // t becomes cad, u becomes dbc
    state_.of[f.t] = of_t_;
    state_.of[f.u] = of_u_;
    state_.sample_normals[f.t] = normals_t_;
    state_.sample_normals[f.u] = normals_u_;
    for (const std::int32_t t : {f.t, f.u}) {
      for (const std::int32_t s : state_.of[t]) {
        state_.samples[s].face = t;
        state_.samples[s].place = nearest_in_triangle(state_.samples[s].point, mesh_, t);
      }
      measure(t);
      state_.hash.enter(mesh_, t);
    }
  }

  FitState& state_;
  EditMesh& mesh_;
  double fine_sharpness_;          ///< sharper triangles have a price
  std::vector<double> sharpness_;  ///< of each triangle
  std::vector<Vector3> normals_;   ///< unit
  std::vector<double> squares_;    ///< sum of its samples' squared distances
  std::vector<std::int32_t> of_t_;
  std::vector<std::int32_t> of_u_;
  Vector3 normals_t_ = Vector3::Zero();
  Vector3 normals_u_ = Vector3::Zero();
};

}  // namespace

int flip_for_fit(FitState& state) { return FitFlips(state).run(); }

}  // namespace wscvt
