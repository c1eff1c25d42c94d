// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/node_refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/distances.h"

namespace wscvt {

namespace {

constexpr std::size_t block_size = 32;
constexpr double pi = 3.14159265358979323846;
/// Samples of the original: enough for a triangle to follow it, and not more than fit in memory.
constexpr std::size_t samples_per_triangle = 32;
constexpr std::size_t smallest_sample_count = 50000;
constexpr std::size_t largest_sample_count = 8000000;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A plane that passes the origin at less than this share of its triangle's distance is too steep:
/// far above rounding, so that what passes stays star-shaped.
constexpr double smallest_plane_cosine = 1e-3;

/// Smallest share of the error of the triangles concerned that an edge flip has to save.
constexpr double smallest_flip_gain = 1e-3;

/// A distance of so many times the rms distance counts twice its square. That keeps single places
/// from being given up for the mean.
constexpr double outlier_ratio = 3.0;

/// What a node's own distance to the original counts, in samples of a triangle. Without it a node
/// with few samples about it may come to stick out.
constexpr double node_share = 0.03;

/// A node is taken elsewhere when that saves this many times what it costs.
constexpr double relocation_margin = 1.1;

/// One triangle: its plane, and what the guards ask about it.
struct Facet {
  Vector3 corner = Vector3::Zero();
  Vector3 normal = Vector3::Zero();  ///< unit, outward
  bool star_shaped = false;
  double largest_cosine = 1.0;  ///< of its smallest angle

  Facet() = default;
  Facet(const Vector3& a, const Vector3& b, const Vector3& c) : corner(a) {
    const Vector3 ab = b - a;
    const Vector3 bc = c - b;
    const Vector3 ca = a - c;
    normal = ab.cross(bc);
    const double doubled_area = normal.norm();
    if (!(doubled_area > 0.0)) return;
    normal /= doubled_area;
    const double distance =
        std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
    star_shaped = normal.dot(a) > smallest_plane_cosine * distance;
    const double ab_length = ab.norm();
    const double bc_length = bc.norm();
    const double ca_length = ca.norm();
    largest_cosine =
        std::max({-ca.dot(ab) / (ca_length * ab_length), -ab.dot(bc) / (ab_length * bc_length),
                  -bc.dot(ca) / (bc_length * ca_length)});
  }

  double residual(const Vector3& sample) const { return normal.dot(sample - corner); }
};

using SampleList = std::vector<std::int32_t>;

/// Points spread evenly over the original, without those that lie behind its outermost sheet.
std::vector<Vector3> visible_samples(const MeshSurface& original, std::size_t triangles,
                                     const Execution& execution) {
  const std::size_t wanted = std::clamp(samples_per_triangle * triangles, smallest_sample_count,
                                        std::max(largest_sample_count, 4 * triangles));
  std::vector<Vector3> samples = area_uniform_samples(original.mesh(), wanted);
  std::vector<Vector3> directions(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) directions[i] = samples[i].normalized();
  const std::vector<double> radii = original.radii(directions, execution);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].norm() > (1.0 - 1e-9) * radii[i]) samples[kept++] = samples[i];
  }
  samples.resize(kept);
  return samples;
}

/// The triangles about one node, counter-clockwise: ring[j], ring[j + 1] and the node make the
/// j-th. They cover the same directions wherever the node goes.
struct Fan {
  std::vector<std::int32_t> ring;
  Vector3 position = Vector3::Zero();  ///< of the node
  std::vector<Facet> facets;
  std::vector<SampleList> lists;  ///< samples of each triangle; may be longer than the ring
  std::vector<double> errors;
  double node_error = 0.0;
  double error = 0.0;

  void resize() {
    facets.resize(ring.size());
    errors.resize(ring.size());
    if (lists.size() < ring.size()) lists.resize(ring.size());
  }
};

/// Room to work in, so that trying places needs no allocation.
struct Workspace {
  Fan fan;
  Fan trial;
  std::vector<Vector3> spokes;
  std::vector<std::int32_t> triangles;
};

class Refinement {
 public:
  Refinement(std::vector<Vector3> positions, SphereTriangulation triangulation,
             const MeshSurface& original, const RefinementOptions& options,
             const Execution& execution)
      : positions_(std::move(positions)),
        triangulation_(std::move(triangulation)),
        original_(original),
        samples_(visible_samples(original, triangulation_.triangles().size(), execution)),
        node_weight_(node_share * static_cast<double>(samples_.size()) /
                     static_cast<double>(triangulation_.triangles().size())),
        cosine_limit_(std::cos(options.smallest_angle * pi / 180.0)),
        execution_(execution) {
    distribute_samples();
  }

  /// What the moves, flips and relocations lower.
  double error() const {
    return std::accumulate(errors_.begin(), errors_.end(), 0.0) +
           std::accumulate(node_errors_.begin(), node_errors_.end(), 0.0);
  }

  /// Measures the rms distance, which also is what the errors are weighed by from here on.
  double measure();

  void mend_angles();
  int move_nodes();
  int flip_edges();
  int relocate_nodes();

  std::vector<Vector3> take_positions() { return std::move(positions_); }
  SphereTriangulation take_triangulation() { return std::move(triangulation_); }

 private:
  struct Collapse {
    std::int32_t half_edge = -1;  ///< from the node that goes to the node its triangles go to
    double cost = infinity;
  };
  struct Split {
    std::int32_t half_edge = -1;
    double gain = 0.0;
  };

  Facet facet(const Triangle& t) const {
    return {positions_[t[0]], positions_[t[1]], positions_[t[2]]};
  }
  double penalty(double residual) const {
    const double square = residual * residual;
    return square + outlier_weight_ * square * square;
  }
  /// Half the penalty's derivative / residual.
  double penalty_weight(double residual) const {
    return 1.0 + 2.0 * outlier_weight_ * residual * residual;
  }
  double error_of(const Facet& f, const SampleList& list) const {
    double sum = 0.0;
    for (const std::int32_t s : list) sum += penalty(f.residual(samples_[s]));
    return sum;
  }
  /// How far a node is from the original's tangent plane above or below it, and that plane's
  /// normal.
  double node_residual(const Vector3& position, Vector3& normal) const {
    const Vector3 direction = position.normalized();
    RadialJet jet;
    original_.evaluate(&direction, 1, Derivatives::First, &jet);
    normal = surface_normal(jet, direction);
    return normal.dot(direction) * (jet.radius - position.norm());
  }
  double node_error(const Vector3& position) const {
    Vector3 normal;
    return node_weight_ * penalty(node_residual(position, normal));
  }
  bool acceptable(const Facet& f, double cosine_limit) const {
    return f.star_shaped && f.largest_cosine <= cosine_limit;
  }
  void distribute_samples();
  std::int32_t locate(const Vector3& sample, std::int32_t start) const;
  std::vector<std::vector<std::int32_t>> colour_nodes() const;
  std::int32_t corner_left_of(std::int32_t half_edge) const {
    return triangulation_.origin(SphereTriangulation::previous(half_edge));
  }
  void ring_of(std::int32_t node, std::vector<std::int32_t>& ring,
               std::vector<std::int32_t>* triangles) const;
  bool place(const Fan& from, const Vector3& position, double cosine_limit, Fan& to,
             std::vector<Vector3>& spokes) const;
  bool improve(Workspace& work, double cosine_limit) const;
  double load_fan(std::int32_t node, Workspace& work) const;
  void store_fan(std::int32_t node, const Workspace& work);
  bool move_node(std::int32_t node, Workspace& work);
  bool mend_node(std::int32_t node, Workspace& work);
  template <class Move>
  int for_each_node(const Move& move);
  bool evaluate_flip(std::int32_t half_edge, double& gain) const;
  bool flip_mends(std::int32_t half_edge) const;
  void flip(std::int32_t half_edge);
  Collapse cheapest_collapse(std::int32_t node, Workspace& work) const;
  double collapse(std::size_t towards, const Workspace& work, double cosine_limit, double bound,
                  std::vector<Triangle>* triangles, std::vector<SampleList>* lists) const;
  bool split(std::int32_t half_edge, Workspace& work) const;
  void relocate(const Collapse& from, const Split& to, Workspace& work);

  std::vector<Vector3> positions_;
  SphereTriangulation triangulation_;
  const MeshSurface& original_;
  std::vector<Vector3> samples_;
  double node_weight_;
  double cosine_limit_;
  const Execution& execution_;
  std::vector<SampleList> lists_;  ///< samples in each triangle, seen from the origin
  std::vector<double> errors_;     ///< sum of the penalties in each triangle
  std::vector<double> node_errors_;
  double outlier_weight_ = 0.0;  ///< 1 / length^2
};

std::int32_t Refinement::locate(const Vector3& sample, std::int32_t start) const {
  const std::vector<Triangle>& triangles = triangulation_.triangles();
  const auto side = [&](std::int32_t t, std::int32_t k) {
    return positions_[triangles[t][k]].cross(positions_[triangles[t][(k + 1) % 3]]).dot(sample);
  };
  std::int32_t t = start;
  // The walk ends on a Delaunay triangulation; on others it might go round in circles.
  for (std::size_t step = 0; step < 2 * triangles.size(); ++step) {
    double worst = 0.0;
    std::int32_t leave = -1;
    for (std::int32_t k = 0; k < 3; ++k) {
      const double inside = side(t, k);
      if (inside < worst) {
        worst = inside;
        leave = 3 * t + k;
      }
    }
    if (leave < 0) return t;
    t = triangulation_.opposite()[leave] / 3;
  }
  for (t = 0; t < static_cast<std::int32_t>(triangles.size()); ++t) {
    if (side(t, 0) >= 0.0 && side(t, 1) >= 0.0 && side(t, 2) >= 0.0) return t;
  }
  return start;
}

void Refinement::distribute_samples() {
  constexpr std::size_t block = 1024;
  std::vector<std::int32_t> place_of(samples_.size());
  execution_.parallel_for(samples_.size(), block, [&](std::size_t begin, std::size_t end) {
    std::int32_t t = 0;
    for (std::size_t s = begin; s < end; ++s) {
      t = locate(samples_[s], t);
      place_of[s] = t;
    }
  });
  lists_.assign(triangulation_.triangles().size(), {});
  for (std::size_t s = 0; s < place_of.size(); ++s) {
    lists_[place_of[s]].push_back(static_cast<std::int32_t>(s));
  }
}

double Refinement::measure() {
  const auto update = [&] {
    errors_.resize(lists_.size());
    execution_.parallel_for(lists_.size(), block_size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        errors_[t] = error_of(facet(triangulation_.triangles()[t]), lists_[t]);
      }
    });
  };
  outlier_weight_ = 0.0;
  update();
  const double squares =
      std::accumulate(errors_.begin(), errors_.end(), 0.0) / static_cast<double>(samples_.size());
  if (squares > 0.0) outlier_weight_ = 1.0 / (outlier_ratio * outlier_ratio * squares);
  update();
  node_errors_.resize(positions_.size());
  execution_.parallel_for(positions_.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) node_errors_[i] = node_error(positions_[i]);
  });
  return std::sqrt(squares);
}

void Refinement::ring_of(std::int32_t node, std::vector<std::int32_t>& ring,
                         std::vector<std::int32_t>* triangles) const {
  ring.clear();
  if (triangles != nullptr) triangles->clear();
  const std::int32_t first = triangulation_.first_half_edge()[node];
  std::int32_t h = first;
  do {
    ring.push_back(triangulation_.origin(SphereTriangulation::next(h)));
    if (triangles != nullptr) triangles->push_back(h / 3);
    h = triangulation_.opposite()[SphereTriangulation::previous(h)];
  } while (h != first);
}

/// The fan with its node at `position`, samples dealt out anew; false when a triangle would break a
/// promise.
bool Refinement::place(const Fan& from, const Vector3& position, double cosine_limit, Fan& to,
                       std::vector<Vector3>& spokes) const {
  const std::size_t count = from.ring.size();
  to.ring = from.ring;
  to.position = position;
  to.resize();
  spokes.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    const Vector3& a = positions_[from.ring[j]];
    to.facets[j] = Facet(position, a, positions_[from.ring[j + 1 == count ? 0 : j + 1]]);
    if (!acceptable(to.facets[j], cosine_limit)) return false;
    spokes[j] = position.cross(a);
    to.lists[j].clear();
  }
  for (std::size_t j = 0; j < count; ++j) {
    for (const std::int32_t s : from.lists[j]) {
      const Vector3& sample = samples_[s];
      // Most samples stay in their triangle; the others are found by going round the node.
      std::size_t k = j;
      for (std::size_t turn = 0; turn < count; ++turn) {
        const std::size_t after = k + 1 == count ? 0 : k + 1;
        if (spokes[k].dot(sample) < 0.0) {
          k = k == 0 ? count - 1 : k - 1;
        } else if (spokes[after].dot(sample) > 0.0) {
          k = after;
        } else {
          break;
        }
      }
      to.lists[k].push_back(s);
    }
  }
  to.node_error = node_error(position);
  to.error = to.node_error;
  for (std::size_t j = 0; j < count; ++j) {
    to.errors[j] = error_of(to.facets[j], to.lists[j]);
    to.error += to.errors[j];
  }
  return true;
}

/// One Gauss-Newton step of work.fan's node, shortened until it lowers the error.
bool Refinement::improve(Workspace& work, double cosine_limit) const {
  Fan& fan = work.fan;
  const std::size_t count = fan.ring.size();
  Matrix3 matrix = Matrix3::Zero();
  Vector3 gradient = Vector3::Zero();
  double shortest = infinity;
  for (std::size_t j = 0; j < count; ++j) {
    const Vector3& a = positions_[fan.ring[j]];
    const Vector3& b = positions_[fan.ring[j + 1 == count ? 0 : j + 1]];
    shortest = std::min(shortest, (a - fan.position).norm());
    // When the node moves by one along the normal, the plane moves under a sample by the node's
    // barycentric coordinate at the sample's foot.
    const Vector3 edge = b - a;
    const Vector3 doubled_area = (a - fan.position).cross(b - fan.position);
    const Vector3 coordinate_gradient = doubled_area.cross(edge) / doubled_area.squaredNorm();
    const Facet& f = fan.facets[j];
    double squares = 0.0;
    double products = 0.0;
    for (const std::int32_t s : fan.lists[j]) {
      const double coordinate = coordinate_gradient.dot(samples_[s] - a);
      const double residual = f.residual(samples_[s]);
      const double weight = penalty_weight(residual);
      squares += weight * coordinate * coordinate;
      products += weight * coordinate * residual;
    }
    matrix += squares * f.normal * f.normal.transpose();
    gradient += products * f.normal;
  }
  Vector3 normal;
  const double residual = node_residual(fan.position, normal);
  const double weight = node_weight_ * penalty_weight(residual);
  matrix += weight * normal * normal.transpose();
  gradient += weight * residual * normal;
  // Where the surface is flat the samples do not say where in the plane the node should stand.
  matrix.diagonal().array() += 1e-3 * matrix.trace() + std::numeric_limits<double>::min();
  Vector3 step = matrix.ldlt().solve(gradient);
  const double length = step.norm();
  if (!(length > 1e-7 * shortest)) return false;
  if (length > 0.5 * shortest) step *= 0.5 * shortest / length;
  for (int attempt = 0; attempt < 3; ++attempt, step *= 0.4) {
    if (place(fan, fan.position + step, cosine_limit, work.trial, work.spokes) &&
        work.trial.error < fan.error) {
      std::swap(work.fan, work.trial);
      return true;
    }
  }
  return false;
}

/// Puts a node's fan as it is into work.fan and returns the largest cosine in it.
double Refinement::load_fan(std::int32_t node, Workspace& work) const {
  Fan& fan = work.fan;
  ring_of(node, fan.ring, &work.triangles);
  fan.position = positions_[node];
  fan.resize();
  fan.error = node_errors_[node];
  double largest_cosine = -1.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const std::int32_t t = work.triangles[j];
    fan.facets[j] = Facet(fan.position, positions_[fan.ring[j]],
                          positions_[fan.ring[j + 1 == count ? 0 : j + 1]]);
    largest_cosine = std::max(largest_cosine, fan.facets[j].largest_cosine);
    fan.lists[j] = lists_[t];
    fan.error += errors_[t];
  }
  return largest_cosine;
}

void Refinement::store_fan(std::int32_t node, const Workspace& work) {
  const Fan& fan = work.fan;
  positions_[node] = fan.position;
  node_errors_[node] = fan.node_error;
  for (std::size_t j = 0; j < fan.ring.size(); ++j) {
    lists_[work.triangles[j]] = fan.lists[j];
    errors_[work.triangles[j]] = fan.errors[j];
  }
}

bool Refinement::move_node(std::int32_t node, Workspace& work) {
  const double cosine_limit = std::max(cosine_limit_, load_fan(node, work));
  if (!improve(work, cosine_limit)) return false;
  store_fan(node, work);
  return true;
}

/// Takes a node with a smaller angle about it than allowed towards the middle of its neighbours.
bool Refinement::mend_node(std::int32_t node, Workspace& work) {
  const double largest_cosine = load_fan(node, work);
  if (largest_cosine <= cosine_limit_) return false;
  Vector3 middle = Vector3::Zero();
  for (const std::int32_t other : work.fan.ring) middle += positions_[other];
  middle /= static_cast<double>(work.fan.ring.size());
  const double wanted = std::max(cosine_limit_, largest_cosine - 1e-6);
  for (const double share : {0.25, 0.5, 1.0}) {
    const Vector3 position = work.fan.position + share * (middle - work.fan.position);
    if (place(work.fan, position, wanted, work.trial, work.spokes)) {
      std::swap(work.fan, work.trial);
      store_fan(node, work);
      return true;
    }
  }
  return false;
}

std::vector<std::vector<std::int32_t>> Refinement::colour_nodes() const {
  const std::size_t count = positions_.size();
  std::vector<int> colour(count, -1);
  std::vector<std::vector<std::int32_t>> classes;
  std::vector<std::int32_t> ring;
  std::vector<char> taken;
  for (std::size_t i = 0; i < count; ++i) {
    ring_of(static_cast<std::int32_t>(i), ring, nullptr);
    taken.assign(classes.size() + 1, 0);
    for (const std::int32_t other : ring) {
      if (colour[other] >= 0) taken[colour[other]] = 1;
    }
    const auto free =
        static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (free == classes.size()) classes.emplace_back();
    colour[i] = static_cast<int>(free);
    classes[free].push_back(static_cast<std::int32_t>(i));
  }
  return classes;
}

template <class Move>
int Refinement::for_each_node(const Move& move) {
  int moved = 0;
  for (const std::vector<std::int32_t>& nodes : colour_nodes()) {
    // Nodes of one colour share no triangle, so they move at the same time.
    moved += execution_.parallel_sum(nodes.size(), block_size, 0,
                                     [&](std::size_t begin, std::size_t end) {
                                       Workspace work;
                                       int part = 0;
                                       for (std::size_t i = begin; i < end; ++i) {
                                         part += move(nodes[i], work) ? 1 : 0;
                                       }
                                       return part;
                                     });
  }
  return moved;
}

int Refinement::move_nodes() {
  return for_each_node([&](std::int32_t node, Workspace& work) { return move_node(node, work); });
}

/// Flips edges and moves nodes where an angle is smaller than allowed, whatever that does to the
/// distance: where a scan folds, the outermost sheet has cliffs that the start follows badly.
void Refinement::mend_angles() {
  constexpr int passes = 10;
  for (int pass = 0; pass < passes; ++pass) {
    int changes = 0;
    const auto count = static_cast<std::int32_t>(triangulation_.triangles().size());
    for (std::int32_t t = 0; t < count; ++t) {
      for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
        if (facet(triangulation_.triangles()[t]).largest_cosine <= cosine_limit_) break;
        if (!flip_mends(h)) continue;
        flip(h);
        ++changes;
        break;
      }
    }
    changes +=
        for_each_node([&](std::int32_t node, Workspace& work) { return mend_node(node, work); });
    if (changes == 0) return;
  }
}

bool Refinement::evaluate_flip(std::int32_t half_edge, double& gain) const {
  const std::int32_t other = triangulation_.opposite()[half_edge];
  const std::int32_t t0 = half_edge / 3;
  const std::int32_t t1 = other / 3;
  const double old_error = errors_[t0] + errors_[t1];
  if (!(old_error > 0.0)) return false;
  const Vector3& a = positions_[triangulation_.origin(half_edge)];
  const Vector3& b = positions_[triangulation_.origin(other)];
  const Vector3& c = positions_[corner_left_of(half_edge)];
  const Vector3& d = positions_[corner_left_of(other)];
  const Facet cad(c, a, d);
  const Facet dbc(d, b, c);
  const double cosine_limit =
      std::max({cosine_limit_, Facet(a, b, c).largest_cosine, Facet(b, a, d).largest_cosine});
  if (!acceptable(cad, cosine_limit) || !acceptable(dbc, cosine_limit)) return false;
  const Vector3 divide = d.cross(c);
  double error = 0.0;
  for (const std::int32_t t : {t0, t1}) {
    for (const std::int32_t s : lists_[t]) {
      error += penalty((divide.dot(samples_[s]) > 0.0 ? cad : dbc).residual(samples_[s]));
    }
  }
  gain = old_error - error;
  return gain > smallest_flip_gain * old_error;
}

/// Whether the smallest angle beside an edge grows when it is flipped.
bool Refinement::flip_mends(std::int32_t half_edge) const {
  const std::int32_t other = triangulation_.opposite()[half_edge];
  const Vector3& a = positions_[triangulation_.origin(half_edge)];
  const Vector3& b = positions_[triangulation_.origin(other)];
  const Vector3& c = positions_[corner_left_of(half_edge)];
  const Vector3& d = positions_[corner_left_of(other)];
  const double largest_cosine =
      std::max(Facet(a, b, c).largest_cosine, Facet(b, a, d).largest_cosine) - 1e-6;
  return acceptable(Facet(c, a, d), largest_cosine) && acceptable(Facet(d, b, c), largest_cosine);
}

void Refinement::flip(std::int32_t half_edge) {
  const std::int32_t t0 = half_edge / 3;
  const std::int32_t t1 = triangulation_.opposite()[half_edge] / 3;
  const Vector3& c = positions_[corner_left_of(half_edge)];
  const Vector3& d = positions_[corner_left_of(triangulation_.opposite()[half_edge])];
  const Vector3 divide = d.cross(c);
  SampleList first;
  SampleList second;
  for (const std::int32_t t : {t0, t1}) {
    for (const std::int32_t s : lists_[t]) {
      (divide.dot(samples_[s]) > 0.0 ? first : second).push_back(s);
    }
  }
  triangulation_.flip(half_edge);
  lists_[t0].swap(first);
  lists_[t1].swap(second);
  for (const std::int32_t t : {t0, t1}) {
    errors_[t] = error_of(facet(triangulation_.triangles()[t]), lists_[t]);
  }
}

int Refinement::flip_edges() {
  constexpr std::size_t block = 512;
  const auto count = static_cast<std::int32_t>(triangulation_.opposite().size());
  std::vector<double> gains(count, 0.0);
  execution_.parallel_for(gains.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto h = static_cast<std::int32_t>(i);
      double gain = 0.0;
      if (h < triangulation_.opposite()[h] && evaluate_flip(h, gain)) {
        gains[i] = gain;
      }
    }
  });
  std::vector<std::int32_t> candidates;
  for (std::int32_t h = 0; h < count; ++h) {
    if (gains[h] > 0.0) candidates.push_back(h);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](std::int32_t h, std::int32_t g) { return gains[h] > gains[g]; });
  int flips = 0;
  for (const std::int32_t h : candidates) {
    double gain = 0.0;
    // Flips beside this one may have changed its triangles.
    if (!evaluate_flip(h, gain)) continue;
    flip(h);
    ++flips;
  }
  return flips;
}

/// Error of the triangles that take the place of a node's fan when all are joined to its neighbour
/// `towards` (an index into the ring, which stands in work.fan); infinite when that breaks a
/// promise or exceeds `bound`.
double Refinement::collapse(std::size_t towards, const Workspace& work, double cosine_limit,
                            double bound, std::vector<Triangle>* triangles,
                            std::vector<SampleList>* lists) const {
  const std::vector<std::int32_t>& ring = work.fan.ring;
  const std::size_t count = ring.size();
  const auto corner = [&](std::size_t k) { return ring[(towards + k) % count]; };
  const Vector3& apex = positions_[corner(0)];
  std::vector<Facet> facets;
  std::vector<Vector3> spokes;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    facets.emplace_back(apex, positions_[corner(k)], positions_[corner(k + 1)]);
    if (!acceptable(facets.back(), cosine_limit)) return infinity;
    spokes.push_back(apex.cross(positions_[corner(k + 1)]));
    if (triangles != nullptr) triangles->push_back({corner(0), corner(k), corner(k + 1)});
  }
  if (lists != nullptr) lists->resize(lists->size() + facets.size());
  double error = 0.0;
  for (const std::int32_t t : work.triangles) {
    for (const std::int32_t s : lists_[t]) {
      std::size_t k = 0;
      while (k + 1 < facets.size() && spokes[k].dot(samples_[s]) > 0.0) ++k;
      error += penalty(facets[k].residual(samples_[s]));
      if (lists != nullptr) (*lists)[lists->size() - facets.size() + k].push_back(s);
    }
    if (error > bound) return infinity;
  }
  return error;
}

Refinement::Collapse Refinement::cheapest_collapse(std::int32_t node, Workspace& work) const {
  Collapse best;
  ring_of(node, work.fan.ring, &work.triangles);
  if (work.fan.ring.size() < 4) return best;
  double old_error = node_errors_[node];
  double cosine_limit = cosine_limit_;
  for (const std::int32_t t : work.triangles) {
    old_error += errors_[t];
    cosine_limit = std::max(cosine_limit, facet(triangulation_.triangles()[t]).largest_cosine);
  }
  std::int32_t h = triangulation_.first_half_edge()[node];
  for (std::size_t towards = 0; towards < work.fan.ring.size(); ++towards) {
    const double error =
        collapse(towards, work, cosine_limit, best.cost + old_error, nullptr, nullptr);
    if (error - old_error < best.cost) {
      best.cost = error - old_error;
      best.half_edge = h;
    }
    h = triangulation_.opposite()[SphereTriangulation::previous(h)];
  }
  return best;
}

/// Puts into work.fan the fan of a node to be inserted on an edge, at the place that suits it best;
/// false when there is none.
bool Refinement::split(std::int32_t half_edge, Workspace& work) const {
  const std::int32_t other = triangulation_.opposite()[half_edge];
  const std::int32_t a = triangulation_.origin(half_edge);
  const std::int32_t b = triangulation_.origin(other);
  Fan& start = work.trial;
  start.ring = {b, corner_left_of(half_edge), a, corner_left_of(other)};
  start.resize();
  for (std::size_t j = 0; j < 4; ++j) start.lists[j].clear();
  start.lists[0] = lists_[half_edge / 3];
  start.lists[2] = lists_[other / 3];
  const double cosine_limit =
      std::max({cosine_limit_, facet(triangulation_.triangles()[half_edge / 3]).largest_cosine,
                facet(triangulation_.triangles()[other / 3]).largest_cosine});
  if (!place(start, 0.5 * (positions_[a] + positions_[b]), cosine_limit, work.fan, work.spokes)) {
    return false;
  }
  for (int step = 0; step < 3 && improve(work, cosine_limit); ++step) {
  }
  return true;
}

void Refinement::relocate(const Collapse& from, const Split& to, Workspace& work) {
  const std::int32_t node = triangulation_.origin(from.half_edge);
  const std::int32_t other = triangulation_.opposite()[to.half_edge];
  std::vector<Triangle> corners;
  std::vector<SampleList> lists;
  ring_of(node, work.fan.ring, &work.triangles);
  std::vector<std::int32_t> slots = work.triangles;
  slots.push_back(to.half_edge / 3);
  slots.push_back(other / 3);
  const std::int32_t neighbour = triangulation_.origin(SphereTriangulation::next(from.half_edge));
  const auto towards = static_cast<std::size_t>(
      std::find(work.fan.ring.begin(), work.fan.ring.end(), neighbour) - work.fan.ring.begin());
  // Both were tried on these very triangles, with a limit that may be a rounding above a cosine's
  // largest value; the limit here lets everything pass.
  constexpr double no_cosine_limit = 2.0;
  if (!(collapse(towards, work, no_cosine_limit, infinity, &corners, &lists) < infinity) ||
      !split(to.half_edge, work)) {
    throw Error(ErrorCode::NumericalFailure,
                "The refinement cannot take a node elsewhere where its trial could; refine with "
                "fewer rounds.");
  }
  positions_[node] = work.fan.position;
  node_errors_[node] = work.fan.node_error;
  for (std::size_t j = 0; j < 4; ++j) {
    corners.push_back({node, work.fan.ring[j], work.fan.ring[(j + 1) % 4]});
    lists.push_back(work.fan.lists[j]);
  }
  triangulation_.replace(slots, corners);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    lists_[slots[i]].swap(lists[i]);
    errors_[slots[i]] = error_of(facet(corners[i]), lists_[slots[i]]);
  }
}

int Refinement::relocate_nodes() {
  std::vector<Collapse> collapses(positions_.size());
  execution_.parallel_for(positions_.size(), block_size, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t i = begin; i < end; ++i) {
      collapses[i] = cheapest_collapse(static_cast<std::int32_t>(i), work);
    }
  });
  std::sort(collapses.begin(), collapses.end(), [](const Collapse& x, const Collapse& y) {
    return x.cost != y.cost ? x.cost < y.cost : x.half_edge < y.half_edge;
  });
  const double cheapest = collapses.front().cost;
  std::vector<Split> splits(triangulation_.opposite().size());
  execution_.parallel_for(splits.size(), block_size, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t i = begin; i < end; ++i) {
      const auto h = static_cast<std::int32_t>(i);
      const std::int32_t other = triangulation_.opposite()[h];
      const double error = errors_[h / 3] + errors_[other / 3];
      if (h > other || !(error > relocation_margin * cheapest) || !split(h, work)) continue;
      splits[i] = {h, error - work.fan.error};
    }
  });
  std::sort(splits.begin(), splits.end(), [](const Split& x, const Split& y) {
    return x.gain != y.gain ? x.gain > y.gain : x.half_edge < y.half_edge;
  });

  std::vector<char> touched(triangulation_.triangles().size(), 0);
  Workspace work;
  int relocations = 0;
  std::size_t next_split = 0;
  for (const Collapse& from : collapses) {
    if (!(from.cost < infinity)) break;
    ring_of(triangulation_.origin(from.half_edge), work.fan.ring, &work.triangles);
    const auto is_touched = [&](std::int32_t t) { return touched[t] != 0; };
    if (std::any_of(work.triangles.begin(), work.triangles.end(), is_touched)) continue;
    for (const std::int32_t t : work.triangles) touched[t] = 1;
    while (next_split < splits.size() && splits[next_split].half_edge >= 0 &&
           (is_touched(splits[next_split].half_edge / 3) ||
            is_touched(triangulation_.opposite()[splits[next_split].half_edge] / 3))) {
      ++next_split;
    }
    if (next_split == splits.size() || splits[next_split].half_edge < 0 ||
        !(splits[next_split].gain > relocation_margin * from.cost)) {
      break;
    }
    const Split to = splits[next_split++];
    touched[to.half_edge / 3] = 1;
    touched[triangulation_.opposite()[to.half_edge] / 3] = 1;
    relocate(from, to, work);
    ++relocations;
  }
  return relocations;
}

}  // namespace

void check_refinement_options(const RefinementOptions& options) {
  if (options.rounds < 0 || options.rounds > 1000) {
    throw Error(ErrorCode::InvalidInput, "The number of refinement rounds is " +
                                             std::to_string(options.rounds) +
                                             "; give 0 (none) to 1000.");
  }
  if (!(options.smallest_angle >= 0.0 && options.smallest_angle <= 40.0)) {
    throw Error(ErrorCode::InvalidInput, "The smallest angle the refinement may make is " +
                                             format_number(options.smallest_angle) +
                                             " degrees; give 0 to 40.");
  }
  if (!(options.tolerance >= 0.0 && options.tolerance < 1.0)) {
    throw Error(ErrorCode::InvalidInput, "The tolerance of the refinement is " +
                                             format_number(options.tolerance) +
                                             "; give a share of at least 0 and less than 1.");
  }
}

RefinedNodes refine_nodes(std::vector<Vector3> positions, SphereTriangulation triangulation,
                          const MeshSurface& original, const RefinementOptions& options,
                          const Execution& execution) {
  check_refinement_options(options);
  RefinementReport report;
  if (options.rounds == 0) return {std::move(positions), std::move(triangulation), report};
  Refinement refinement(std::move(positions), std::move(triangulation), original, options,
                        execution);
  report.start_distance = refinement.measure();
  for (int round = 0; round < options.rounds && !report.converged; ++round) {
    // A round takes seconds on many nodes; a cancel should not have to wait for its end.
    const auto reached = [&](double share_of_round) {
      execution.report((round + share_of_round) / options.rounds, "Refining the nodes");
    };
    reached(0.0);
    refinement.mend_angles();
    reached(0.1);
    const double before = refinement.error();
    RefinementStep step;
    step.moves = refinement.move_nodes();
    reached(0.5);
    step.flips = refinement.flip_edges();
    reached(0.6);
    // The first rounds lower the distance by so much that relocations would be misjudged.
    if (round >= 2) step.relocations = refinement.relocate_nodes();
    const double share = std::sqrt(refinement.error() / before);
    report.converged = !(share < 1.0 - options.tolerance);
    step.distance = refinement.measure();
    report.history.push_back(step);
  }
  return {refinement.take_positions(), refinement.take_triangulation(), std::move(report)};
}

}  // namespace wscvt
