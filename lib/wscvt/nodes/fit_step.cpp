// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "wscvt/nodes/fit_steps.h"
#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/star_shape.h"

namespace wscvt {

namespace {

/// A sample belongs to a node if its corner has at least this weight.
constexpr double own_weight = 0.2;
/// Weight of the distance of a node from the plane of its nearest sample. Without it and the leash,
/// the largest distance grows by a tenth.
constexpr double own_plane = 0.05;
/// A node farther than this from all its samples, in mean edges, is pulled to the nearest sample.
constexpr double leash = 0.2;
/// A node at a rim that lies farther out than the dial's reach is pulled back with this weight. The
/// planes of a wedge's sheets meet beyond its rounded rim: without it, rms of 19 thin bodies is 6 %
/// larger in the mean. A third or three times the weight costs 2 %.
constexpr double rim_support = 0.3;
/// Added to a triangle's longest / shortest edge less one, so that springs stay finite.
constexpr double softest_triangle = 0.1;
/// With 2 more, rms stays the same and the fit takes 3 % longer.
constexpr int gradient_steps = 8;
/// The steps end if the squared residual is this much smaller.
constexpr double gradient_end = 1e-4;
/// The ring term's diagonal: 1 and a sixth, for a sixth each of six neighbours' sixths.
constexpr double ring_diagonal = 1.17;
constexpr std::size_t equation_block = 1024;
constexpr std::size_t system_block = 512;

/// A symmetric matrix, row by row from the diagonal on.
using Symmetric = Eigen::Matrix<double, 6, 1>;
void add_square(Symmetric& to, double weight, const Vector3& v) {
  const Vector3 w = weight * v;
  to[0] += w[0] * v[0];
  to[1] += w[0] * v[1];
  to[2] += w[0] * v[2];
  to[3] += w[1] * v[1];
  to[4] += w[1] * v[2];
  to[5] += w[2] * v[2];
}
Matrix3 whole(const Symmetric& s) {
  Matrix3 result;
  result << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  return result;
}

/// Contribution of a triangle to the normal equations.
struct FaceSystem {
  std::array<Symmetric, 3> own;  ///< of each corner with itself
  std::array<Matrix3, 3> pair;   ///< of corner k with corner k + 1
  std::array<Vector3, 3> pull;

  FaceSystem() {
    own.fill(Symmetric::Zero());
    pair.fill(Matrix3::Zero());
    pull.fill(Vector3::Zero());
  }
  /// Adds the square of (residual + gradient . step), times a weight.
  void add(double weight, double residual, const std::array<Vector3, 3>& gradient) {
    for (std::size_t k = 0; k < 3; ++k) {
      add_square(own[k], weight, gradient[k]);
      pair[k] += weight * gradient[k] * gradient[following(k)].transpose();
      pull[k] -= weight * residual * gradient[k];
    }
  }
};

/// The nearest of a triangle's samples to one of its corners, and how far out they reach along the
/// normal of a corner's star that bends over a rim.
struct NearestSample {
  double squared_distance = 1e300;
  std::int32_t sample = -1;
  double outmost = -1e300;

  void add(std::int32_t s, const Vector3& point, const Vector3& corner, const StarShape& shape) {
    const double squared = (corner - point).squaredNorm();
    if (squared < squared_distance) {
      squared_distance = squared;
      sample = s;
    }
    if (shape.rim > 0.0) outmost = std::max(outmost, shape.normal.dot(point));
  }
  void add(const NearestSample& other) {
    if (other.squared_distance < squared_distance) {
      squared_distance = other.squared_distance;
      sample = other.sample;
    }
    outmost = std::max(outmost, other.outmost);
  }
};

class FitEquations {
 public:
  FitEquations(FitState& state, const Execution& execution)
      : state_(state),
        mesh_(state.mesh),
        execution_(execution),
        count_(state.mesh.points.size()),
        shapes_(count_),
        centres_(count_),
        normals_(mesh_.triangles.size()),
        lengths_(mesh_.triangles.size()),
        faces_(mesh_.triangles.size()),
        nearest_(3 * mesh_.triangles.size()),
        diagonal_(count_),
        right_(count_),
        inverse_(count_) {
    state_.edge = mean_edge_length(mesh_);
    state_.ring_edges.assign(count_, 0.0);
    list_neighbours();
    for (std::size_t t = 0; t < normals_.size(); ++t) {
      normals_[t] = mesh_.normal(t);
      lengths_[t] = normals_[t].norm();
    }
    for_nodes([&](std::size_t i) { look_at(i); });
    execution_.parallel_for_each(faces_.size(), system_block, [&](std::size_t t) {
      faces_[t] = FaceSystem();
      add_samples(t);
      add_angles(t);
      add_triangle_springs(t);
    });
    for_nodes([&](std::size_t i) { gather(i); });
    add_ring_forces();
  }

  std::vector<Vector3> solve() const {
    std::vector<Vector3> step(count_, Vector3::Zero());
    std::vector<Vector3> r = right_;
    std::vector<Vector3> z(count_);
    std::vector<Vector3> p(count_);
    std::vector<Vector3> q(count_);
    std::vector<Vector3> bent(count_);
    double rz = sum_nodes([&](std::size_t i) {
      p[i] = inverse_[i] * r[i];
      return p[i].dot(r[i]);
    });
    const double end = gradient_end * rz;
    for (int it = 0; it < gradient_steps && rz > end; ++it) {
      for_nodes([&](std::size_t i) { multiply(i, p, q, bent); });
      const double pq = sum_nodes([&](std::size_t i) {
        q[i] += state_.ring() * ring_transposed(i, bent);
        return p[i].dot(q[i]);
      });
      const double along = rz / pq;
      const double next = sum_nodes([&](std::size_t i) {
        step[i] += along * p[i];
        r[i] -= along * q[i];
        z[i] = inverse_[i] * r[i];
        return r[i].dot(z[i]);
      });
      const double turn = next / rz;
      rz = next;
      for_nodes([&](std::size_t i) { p[i] = z[i] + turn * p[i]; });
    }
    return step;
  }

 private:
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    execution_.parallel_for_each(count_, equation_block, visit);
  }
  template <class Value>
  double sum_nodes(const Value& value) const {
    return execution_.parallel_sum_of(count_, equation_block, 0.0,
                                      [&](std::size_t i, double& sum) { sum += value(i); });
  }

  void list_neighbours() {
    starts_.assign(count_ + 1, 0);
    for (std::size_t i = 0; i < count_; ++i) starts_[i + 1] = starts_[i] + mesh_.degrees[i];
    half_edges_.resize(starts_.back());
    neighbours_.resize(starts_.back());
    blocks_.resize(starts_.back());
    ring_shares_.resize(starts_.back());
    ring_sums_.assign(count_, 0.0);
    for (std::size_t i = 0; i < count_; ++i) {
      std::int32_t at = starts_[i];
      mesh_.around(static_cast<std::int32_t>(i), [&](std::int32_t h) {
        half_edges_[at] = h;
        neighbours_[at++] = mesh_.target(h);
        ring_sums_[i] += state_.ring_weight(static_cast<std::int32_t>(i), mesh_.target(h));
      });
    }
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
        const std::int32_t j = neighbours_[at];
        ring_shares_[at] = state_.ring_weight(static_cast<std::int32_t>(i), j) / ring_sums_[j];
      }
    }
  }

  /// Computes the normal of a node's star, the middle of its ring and its mean edge.
  void look_at(std::size_t i) {
    Vector3 centre = Vector3::Zero();
    double edges = 0.0;
    for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
      centre += state_.ring_weight(static_cast<std::int32_t>(i), neighbours_[at]) *
                mesh_.points[neighbours_[at]];
      edges += (mesh_.points[neighbours_[at]] - mesh_.points[i]).norm();
    }
    centres_[i] = centre / ring_sums_[i];
    state_.ring_edges[i] = edges / static_cast<double>(mesh_.degrees[i]);
    shapes_[i] = star_shape([&](const auto& visit) {
      for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
        visit(normals_[face_of(half_edges_[at])], lengths_[face_of(half_edges_[at])]);
      }
    });
  }

  /// Adds a triangle's samples: their distance from its plane. Beyond its edges, it is the distance
  /// along the mean of both normals, which pulls tips and rims out. With that mean for all samples,
  /// rows beside the rim of a plate drift away from it (rms .72 instead of .37 % at ratio 1.4).
  void add_samples(std::size_t t) {
    if (state_.of[t].empty()) return;
    const auto& [a, b, c] = mesh_.triangles[t];
    const std::array<Vector3, 3> x = corners_of(mesh_, t);
    const std::array<const StarShape*, 3> shapes = {&shapes_[a], &shapes_[b], &shapes_[c]};
    const Vector3 normal = normals_[t] / (lengths_[t] + 1e-300);
    FaceSystem& face = faces_[t];
    std::array<Symmetric, 3> pairs;  // of corner k with corner k + 1
    pairs.fill(Symmetric::Zero());
    std::array<Vector3, 3> flat;  // factors of the normal, by corner: own, pair and pull
    flat.fill(Vector3::Zero());
    const double share = state_.share();
    std::array<NearestSample, 3> nearest;
    for (const std::int32_t s : state_.of[t]) {
      const FitSample& sample = state_.samples[s];
      const TrianglePlace& place = sample.place;
      const Vector3& w = place.weights;
      const Vector3 r = w[0] * x[0] + w[1] * x[1] + w[2] * x[2] - sample.point;
      const double weight = share * state_.weight(place.squared_distance);
      const double agreement = sample.normal.dot(normal);
      for (int k = 0; k < 3; ++k) {
        if (w[k] > own_weight) nearest[k].add(s, sample.point, x[k], *shapes[k]);
      }
      if (place.region == 0 || agreement < 0.0) {
        const Vector3 part = weight * w;
        flat[0] += w.cwiseProduct(part);
        flat[1] += Vector3(w[1], w[2], w[0]).cwiseProduct(part);
        flat[2] -= weight * normal.dot(r) * w;
        continue;
      }
      // The sum of both unit normals has the squared length 2 + 2 agreement.
      const Vector3 u = normal + sample.normal;
      Symmetric metric = Symmetric::Zero();
      add_square(metric, weight / (2.0 + 2.0 * agreement), u);
      const Vector3 pull = weight / (2.0 + 2.0 * agreement) * u.dot(r) * u;
      for (int k = 0; k < 3; ++k) {
        const Symmetric part = w[k] * metric;
        face.own[k] += w[k] * part;
        pairs[k] += w[(k + 1) % 3] * part;
        face.pull[k] -= w[k] * pull;
      }
    }
    for (int k = 0; k < 3; ++k) {
      add_square(face.own[k], flat[0][k], normal);
      add_square(pairs[k], flat[1][k], normal);
      face.pair[k] = whole(pairs[k]);
      face.pull[k] += flat[2][k] * normal;
    }
    std::copy(nearest.begin(), nearest.end(),
              nearest_.begin() + static_cast<std::ptrdiff_t>(3 * t));
  }

  /// Adds the price of a sharp triangle.
  void add_angles(std::size_t t) {
    if (state_.round.price <= 0.0) return;
    const auto& [a, b, c] = mesh_.triangles[t];
    std::array<Vector3, 3> gradient;
    const double excess =
        state_.excess(mesh_.points[a], mesh_.points[b], mesh_.points[c], &gradient);
    if (excess > 0.0) faces_[t].add(state_.round.price, excess, gradient);
  }

  /// Adds the difference of a triangle's longest and shortest edge.
  void add_triangle_springs(std::size_t t) {
    if (state_.dial.triangle_springs <= 0.0) return;
    const Triangle& corners = mesh_.triangles[t];
    std::array<Vector3, 3> edges;  // opposite to each corner
    std::array<double, 3> lengths{};
    for (std::size_t k = 0; k < 3; ++k) {
      edges[k] = mesh_.points[corners[preceding(k)]] - mesh_.points[corners[following(k)]];
      lengths[k] = edges[k].norm() + 1e-300;
      edges[k] /= lengths[k];
    }
    const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
    const auto shortest = static_cast<std::size_t>(least - lengths.begin());
    const auto longest = static_cast<std::size_t>(most - lengths.begin());
    if (longest == shortest) return;
    const double weight = state_.dial.triangle_springs * state_.spring() /
                          (lengths[longest] / lengths[shortest] - 1.0 + softest_triangle);
    std::array<Vector3, 3> gradient;
    gradient.fill(Vector3::Zero());
    gradient[preceding(longest)] += edges[longest];
    gradient[following(longest)] -= edges[longest];
    gradient[preceding(shortest)] -= edges[shortest];
    gradient[following(shortest)] += edges[shortest];
    faces_[t].add(weight, lengths[longest] - lengths[shortest], gradient);
  }

  void gather(std::size_t i) {
    Matrix3& own = diagonal_[i];
    own = state_.dial.damping * Matrix3::Identity();
    Symmetric faces = Symmetric::Zero();
    Vector3& pull = right_[i];
    pull.setZero();
    for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
      const std::int32_t h = half_edges_[at];
      const std::int32_t g = mesh_.opposite[h];
      const FaceSystem& face = faces_[face_of(h)];
      faces += face.own[corner_of(h)];
      pull += face.pull[corner_of(h)];
      blocks_[at] = face.pair[corner_of(h)] + faces_[face_of(g)].pair[corner_of(g)].transpose();
      add_spring(i, at);
    }
    own += whole(faces);
    add_nearest(i);
    const Vector3& normal = shapes_[i].normal;
    inverse_[i] =
        (own + ring_diagonal * state_.ring() * (Matrix3::Identity() - normal * normal.transpose()))
            .inverse();
  }

  void add_spring(std::size_t i, std::int32_t at) {
    const std::int32_t j = neighbours_[at];
    const Vector3 edge = mesh_.points[i] - mesh_.points[j];
    const double length = edge.norm();
    if (length < 1e-300) return;
    const Vector3 u = edge / length;
    const double wanted =
        0.5 * state_.edge *
        (state_.node_spacing(static_cast<std::int32_t>(i)) + state_.node_spacing(j));
    const double local = state_.dial.local_share;
    const double rest =
        (1.0 - local) * wanted + local * 0.5 * (state_.ring_edges[i] + state_.ring_edges[j]);
    const double weight = state_.dial.plain_springs * state_.spring();
    const Matrix3 along = weight * u * u.transpose();
    diagonal_[i] += along;
    blocks_[at] -= along;
    right_[i] -= weight * (length - rest) * u;
  }

  /// Adds the distance of a node from the plane of its nearest sample, and from the sample itself
  /// if that is far; at a rim, also how far it lies beyond its samples.
  void add_nearest(std::size_t i) {
    NearestSample nearest;
    for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
      nearest.add(nearest_[half_edges_[at]]);
    }
    if (nearest.sample < 0) return;
    add_rim_support(i, nearest.outmost);
    const FitSample& sample = state_.samples[nearest.sample];
    const Vector3 from = mesh_.points[i] - sample.point;
    const double off = sample.normal.dot(from);
    const double weight = own_plane * state_.weight(off * off);
    diagonal_[i] += weight * sample.normal * sample.normal.transpose();
    right_[i] -= weight * off * sample.normal;
    const double distance = std::sqrt(nearest.squared_distance);
    if (distance <= leash * state_.edge) return;
    const Vector3 u = from / distance;
    diagonal_[i] += u * u.transpose();
    right_[i] -= (distance - leash * state_.edge) * u;
  }

  void add_rim_support(std::size_t i, double outmost) {
    const auto& [normal, rim, along] = shapes_[i];
    const double beyond =
        normal.dot(mesh_.points[i]) - outmost - state_.dial.rim_reach * state_.edge;
    if (rim == 0.0 || beyond <= 0.0) return;
    const double weight = rim_support * rim;
    diagonal_[i] += weight * normal * normal.transpose();
    right_[i] -= weight * beyond * normal;
  }

  void add_ring_forces() {
    std::vector<Vector3> bent(count_);
    for_nodes(
        [&](std::size_t i) { bent[i] = shapes_[i].tangential(mesh_.points[i] - centres_[i]); });
    for_nodes([&](std::size_t i) { right_[i] -= state_.ring() * ring_transposed(i, bent); });
  }

  /// Returns the transpose of "a node less the mean of its ring".
  Vector3 ring_transposed(std::size_t i, const std::vector<Vector3>& values) const {
    Vector3 result = values[i];
    for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
      result -= ring_shares_[at] * values[neighbours_[at]];
    }
    return result;
  }

  void multiply(std::size_t i, const std::vector<Vector3>& p, std::vector<Vector3>& q,
                std::vector<Vector3>& bent) const {
    Vector3 product = diagonal_[i] * p[i];
    Vector3 ring = Vector3::Zero();
    for (std::int32_t at = starts_[i]; at < starts_[i + 1]; ++at) {
      const Vector3& other = p[neighbours_[at]];
      product += blocks_[at] * other;
      ring += state_.ring_weight(static_cast<std::int32_t>(i), neighbours_[at]) * other;
    }
    q[i] = product;
    bent[i] = shapes_[i].tangential(p[i] - ring / ring_sums_[i]);
  }

  FitState& state_;
  const EditMesh& mesh_;
  const Execution& execution_;
  std::size_t count_;
  std::vector<StarShape> shapes_;    ///< of each node's star
  std::vector<Vector3> centres_;     ///< of each ring
  std::vector<double> ring_sums_;    ///< of the ring's weights
  std::vector<double> ring_shares_;  ///< of each node in its neighbours' rings
  std::vector<Vector3> normals_;     ///< of the triangles, twice their area long
  std::vector<double> lengths_;      ///< of the normals
  std::vector<FaceSystem> faces_;
  std::vector<NearestSample> nearest_;  ///< to half-edge h's origin in its triangle
  std::vector<std::int32_t> starts_;
  std::vector<std::int32_t> half_edges_;
  std::vector<std::int32_t> neighbours_;
  std::vector<Matrix3> blocks_;
  std::vector<Matrix3> diagonal_;
  std::vector<Vector3> right_;
  std::vector<Matrix3> inverse_;
};

}  // namespace

std::vector<Vector3> fit_step(FitState& state, const Execution& execution) {
  return FitEquations(state, execution).solve();
}

namespace {

/// Longest step, in the shorter of the mean edge about a node and the mesh's mean edge.
constexpr double longest_fit_step = 0.35;
/// Smallest cosine of a triangle's turn by one step: 72 degrees.
constexpr double most_step_turn = 0.3;
/// Triangles with fewer samples are judged by the samples about their corners.
constexpr std::size_t enough_samples = 4;
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
        marked_(mesh_.points.size(), 1),
        old_normals_(state.unit_normals()) {
    outward_.reserve(old_normals_.size());
    for (std::size_t t = 0; t < old_normals_.size(); ++t) outward_.push_back(outward_of(t));
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
      if (mark_spoilt()) {
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
  Vector3 outward_of(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    const std::vector<Vector3>& about = state_.about;
    const Vector3 sum =
        state_.of[t].size() >= enough_samples
            ? state_.sample_normals[t]
            : Vector3(about[a].normalized() + about[b].normalized() + about[c].normalized());
    const double length = sum.norm();
    return length > 0.0 ? Vector3(sum / length) : sum;
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

  std::array<Vector3, 3> old_corners(std::size_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {old_[a], old_[b], old_[c]};
  }

  bool is_spoilt(std::size_t t) const {
    const Vector3 normal = state_.unit_normal(t);
    if (normal.dot(old_normals_[t]) < most_step_turn) return true;
    const double after = normal.dot(outward_[t]);
    if (after < least_agreement && after < old_normals_[t].dot(outward_[t])) return true;
    const double sharpness = mesh_.sharpness(t);
    if (sharpness <= state_.round.sharpness_limit + 1e-9) return false;
    const auto [a, b, c] = old_corners(t);
    return sharpness > largest_corner_cosine(a, b, c) + 1e-9;
  }

  /// Marks the corners of spoilt triangles, and no others. Only triangles with a marked corner have
  /// changed since the last look.
  bool mark_spoilt() {
    std::vector<char> spoilt(mesh_.triangles.size());
    execution_.parallel_for_each(spoilt.size(), guarded_block, [&](std::size_t t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const bool changed = (marked_[a] | marked_[b] | marked_[c]) != 0;
      spoilt[t] = changed && is_spoilt(t) ? 1 : 0;
    });
    std::fill(marked_.begin(), marked_.end(), 0);
    bool any = false;
    for (std::size_t t = 0; t < spoilt.size(); ++t) {
      if (spoilt[t] == 0) continue;
      for (const std::int32_t v : mesh_.triangles[t]) marked_[v] = 1;
      any = true;
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
      if (triangles_cross(mesh_.triangles[t], old_corners(t), mesh_.triangles[u], old_corners(u))) {
        continue;
      }
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
  std::vector<char> marked_;  ///< nodes to move back
  std::vector<Vector3> old_normals_;
  std::vector<Vector3> outward_;  ///< the scan's direction at each triangle; unit or zero
  bool none_meet_ = false;        ///< at the last check, if no node has moved since
};

}  // namespace

void move_nodes(FitState& state, std::vector<Vector3> step, const Execution& execution) {
  GuardedMove(state, std::move(step), execution).run();
}

}  // namespace wscvt
