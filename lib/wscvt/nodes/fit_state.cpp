// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/fit_state.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "wscvt/base/counting_sort.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/nodes/scan_nodes_options.h"

namespace wscvt {

namespace {

/// Degrees that the late rounds keep at the evenest. At 35 most grains end at 35.4; 39 costs .5 %
/// of rms.
constexpr double even_least_angle = 39.0;
/// Angles and even edges give way to distance at this much above the evenest ratio.
constexpr double uneven = 0.0625;
/// At the evenest, weak rings and rest lengths nearer the mesh's mean leave edges a tenth more
/// alike (.082 -> .076 of their mean) for 1 % of rms. Above, they would cost 5 %.
constexpr double even_spring = 0.045;
constexpr double even_ring = 0.03;
constexpr double even_local_share = 0.8;
constexpr double usual_spring = 0.04;
constexpr double usual_ring = 0.13;
constexpr double usual_local_share = 0.9;
/// Long edges cut a rim's curve, so its nodes reach out. Close meshes have more nodes there: at
/// ratio 1.4, this reach makes rms of 23 thin bodies 10 % larger; at the evenest, none makes it 2 %
/// larger.
constexpr double even_rim_reach = 0.03;
/// With a wanted density, so that the fit does not even it out.
constexpr double weighted_local_share = 0.5;

}  // namespace

FitDial fit_dial(double ratio, bool weighted) {
  // x: distance from the evenest ratio that costs no distance; close: position in the close range,
  // in which a fit is led several times.
  const double x = std::max(0.0, ratio - default_edge_ratio);
  const double close = std::clamp((x - 0.2) / 0.2, 0.0, 1.0);
  FitDial dial;
  dial.ratio = ratio;
  dial.samples_a_node = static_cast<int>(30.0 + 40.0 * x);
  dial.rounds = static_cast<int>(14.0 + 14.0 * std::min(1.0, x / 0.06) + 20.0 * close);
  dial.late_rounds = std::min(6, dial.rounds / 2 - 1);
  const double even_share = std::max(0.0, 1.0 - x / uneven);
  const auto blend = [](double share, double one, double other) {
    return share * one + (1.0 - share) * other;
  };
  dial.least_angle = blend(even_share, even_least_angle, 30.0);
  dial.early_angle = std::min(20.0, std::max(5.0, 0.5 * dial.least_angle));
  const bool is_even = x < 0.02;
  dial.start_evenness = std::clamp(
      portable::exp(-15.7 * (ratio - default_edge_ratio) - 25.0 * std::max(0.0, ratio - 1.505)),
      1e-6, 1.0);
  dial.lead_rounds = is_even ? dial.rounds - 3 : std::max(1.0, (0.4 + 0.3 * close) * dial.rounds);
  dial.heats = close > 0.3 ? 3 : 1;
  const int third = dial.rounds / 3;
  dial.first_steering = is_even ? third : dial.lead_rounds;
  dial.ratio_slope = 0.03 + 0.25 * x;
  dial.plain_springs = std::max(0.1, 1.0 - 11.0 * x);
  dial.triangle_springs = 0.3 * (1.0 - dial.plain_springs) / 0.9;
  const double weak = weighted ? 0.0 : even_share;
  dial.spring_stiffness = blend(weak, even_spring, usual_spring);
  dial.ring_stiffness = blend(weak, even_ring, usual_ring);
  dial.local_share =
      weighted ? weighted_local_share : blend(weak, even_local_share, usual_local_share);
  dial.rim_reach = even_share * even_rim_reach;
  dial.damping = portable::pow(10.0, -3.0 - 2.0 * std::min(0.5, x));
  dial.polishes = x > 0.06;
  return dial;
}

namespace {

/// Between these face areas, in a node's cell, a face's own normal replaces the normals of its
/// vertices.
constexpr double fine_face = 0.25;
constexpr double coarse_face = 1.0;

/// The normals of vertex_normals at the corners of a few faces of a scan.
class NormalsOfFaces {
 public:
  NormalsOfFaces(const IndexedMesh& scan, const std::vector<std::size_t>& faces)
      : number_(scan.points.size(), -1) {
    std::int32_t count = 0;
    for (const std::size_t t : faces) {
      for (const std::int32_t v : scan.triangles[t]) {
        if (number_[v] < 0) number_[v] = count++;
      }
    }
    normals_.assign(count, Vector3::Zero());
    for (std::size_t t = 0; t < scan.triangles.size(); ++t) {
      const auto& [a, b, c] = scan.triangles[t];
      if (number_[a] < 0 && number_[b] < 0 && number_[c] < 0) continue;
      const Vector3 normal = doubled_area_normal(scan, t);
      for (const std::int32_t v : {a, b, c}) {
        if (number_[v] >= 0) normals_[number_[v]] += normal;
      }
    }
    for (Vector3& normal : normals_) {
      const double length = normal.norm();
      if (length > 0.0) normal /= length;
    }
  }

  const Vector3& operator[](std::int32_t v) const { return normals_[number_[v]]; }

 private:
  std::vector<std::int32_t> number_;  ///< of each vertex among the corners; -1 for the others
  std::vector<Vector3> normals_;
};

template <class Normals>
FitSample sample_in_face(const IndexedMesh& scan, const Normals& normals, std::size_t t,
                         const Eigen::Vector2d& random, double cell) {
  const Triangle& corners = scan.triangles[t];
  const double root = std::sqrt(random.x());
  const Vector3 w(1.0 - root, root * (1.0 - random.y()), root * random.y());
  FitSample sample;
  sample.point.setZero();
  sample.normal.setZero();
  int nearest = 0;
  for (int k = 0; k < 3; ++k) {
    sample.point += w[k] * scan.points[corners[k]];
    sample.normal += w[k] * normals[corners[k]];
    if (w[k] > w[nearest]) nearest = k;
  }
  const Vector3 face_normal = doubled_area_normal(scan, t);
  const double doubled_area = face_normal.norm();
  const double share =
      smooth_step((0.5 * doubled_area / cell - fine_face) / (coarse_face - fine_face));
  const double length = sample.normal.norm();
  // If the vertices' normals cancel, the face's own is used.
  if (length < 1e-6 || share == 1.0) {
    sample.normal = face_normal / doubled_area;
  } else {
    sample.normal = (1.0 - share) / length * sample.normal + share / doubled_area * face_normal;
    sample.normal.normalize();
  }
  sample.face = corners[nearest];
  return sample;
}

}  // namespace

std::vector<FitSample> draw_fit_samples(const IndexedMesh& scan,
                                        const std::vector<Vector3>& normals, std::size_t count,
                                        double cell) {
  constexpr double golden = 0.61803398874989485;  // its multiples modulo 1 are evenly distributed
  const std::size_t faces = scan.triangles.size();
  std::vector<double> doubled_areas(faces);
  double total = 0.0;
  for (std::size_t t = 0; t < faces; ++t) {
    doubled_areas[t] = doubled_area_normal(scan, t).norm();
    total += doubled_areas[t];
  }
  std::vector<std::size_t> drawn;
  drawn.reserve(count);
  std::size_t t = 0;
  double up_to = doubled_areas.empty() ? 0.0 : doubled_areas[0];
  for (std::size_t i = 0; i < count; ++i) {
    const double jitter =
        golden * static_cast<double>(i) - std::floor(golden * static_cast<double>(i));
    const double wanted = (static_cast<double>(i) + jitter) / static_cast<double>(count) * total;
    while (t + 1 < faces && (up_to < wanted || doubled_areas[t] == 0.0))
      up_to += doubled_areas[++t];
    drawn.push_back(t);
  }
  std::vector<FitSample> samples;
  samples.reserve(count);
  const auto add_samples = [&](const auto& at_vertices) {
    for (std::size_t i = 0; i < count; ++i) {
      samples.push_back(sample_in_face(scan, at_vertices, drawn[i], plastic_point(i), cell));
    }
  };
  if (normals.empty()) {
    add_samples(NormalsOfFaces(scan, drawn));
  } else {
    add_samples(normals);
  }
  return samples;
}

namespace {

/// Squared distances above this many mean squares get no larger weight in a sample's cost.
constexpr double farthest_error = 18.0;
constexpr std::size_t placed_samples_block = 2048;
/// Added distance of a triangle that faces away from a sample by more than 60 degrees, in mean
/// edges per missing cosine: up to three mean edges.
constexpr double turned_distance = 2.0;

/// Returns the nearest triangle that faces as the sample does, from star to star of the nearest
/// nodes, from each corner of a triangle. One corner alone finds it less often.
std::int32_t facing_triangle(const EditMesh& mesh, const std::vector<Vector3>& normals,
                             const FitSample& sample, std::int32_t from, double edge) {
  constexpr int most_stars = 100;
  std::int32_t face = -1;
  double best = 1e300;
  for (std::int32_t node : mesh.triangles[from]) {
    double least = 1e300;
    std::int32_t next = -1;
    for (int star = 0; star < most_stars && next != node; ++star) {
      if (next >= 0) node = next;
      mesh.around(node, [&](std::int32_t h) {
        const std::size_t t = face_of(h);
        const double cosine = normals[t].dot(sample.normal);
        const double turned = turned_distance * edge * std::max(0.0, face_agreement - cosine);
        if (turned * turned >= least) return;
        const TrianglePlace place = nearest_in_triangle(sample.point, mesh, t);
        const double cost = place.squared_distance + turned * turned;
        if (cost >= least) return;
        least = cost;
        if (cost < best) face = static_cast<std::int32_t>(t);
        best = std::min(best, cost);
        Eigen::Index corner = 0;
        place.weights.maxCoeff(&corner);
        next = mesh.triangles[t][corner];
      });
    }
  }
  return face;
}

}  // namespace

FitState::FitState(EditMesh start, std::vector<FitSample> scan_samples,
                   const std::vector<std::int32_t>& near, const FitDial& fit_dial,
                   const Execution& execution)
    : mesh(std::move(start)), samples(std::move(scan_samples)), dial(fit_dial) {
  edge = mean_edge_length(mesh);
  const std::vector<Vector3> normals = unit_normals();
  execution.parallel_for_each(samples.size(), placed_samples_block, [&](std::size_t s) {
    std::int32_t face = static_cast<std::int32_t>(face_of(mesh.first[near[s]]));
    walk_to_nearest(samples[s].point, mesh, face);
    if (normals[face].dot(samples[s].normal) < face_agreement) {
      face = facing_triangle(mesh, normals, samples[s], face_of(mesh.first[near[s]]), edge);
      walk_to_nearest(samples[s].point, mesh, face);
    }
    samples[s].face = face;
  });
  // Neighbours in space become neighbours in memory.
  const Groups by_face =
      counting_sort(samples.size(), mesh.triangles.size(),
                    [&](std::size_t s, const auto& visit) { visit(samples[s].face); });
  std::vector<FitSample> sorted;
  sorted.reserve(samples.size());
  for (const std::int32_t s : by_face.items) sorted.push_back(samples[s]);
  samples = std::move(sorted);
  place_samples(execution);
}

double FitState::error(double squared_distance) const {
  return squared_distance *
         (1.0 + 0.5 * robust_weight * std::min(squared_distance / mean_square, farthest_error));
}

double FitState::excess(const Vector3& a, const Vector3& b, const Vector3& c,
                        std::array<Vector3, 3>* gradient) const {
  const std::array<const Vector3*, 3> x = {&a, &b, &c};
  const std::array<double, 3> l = {(b - c).squaredNorm(), (c - a).squaredNorm(),
                                   (a - b).squaredNorm()};
  const auto k = static_cast<std::size_t>(std::min_element(l.begin(), l.end()) - l.begin());
  const std::size_t i = following(k);
  const std::size_t j = preceding(k);
  Vector3 to_i = *x[i] - *x[k];
  Vector3 to_j = *x[j] - *x[k];
  const double length_i = to_i.norm() + 1e-300;
  const double length_j = to_j.norm() + 1e-300;
  to_i /= length_i;
  to_j /= length_j;
  const double cosine = to_i.dot(to_j);
  if (cosine <= round.goal_cosine) return 0.0;
  const double scale = 1.0 / (1.0 - round.goal_cosine);
  if (gradient != nullptr) {
    (*gradient)[i] = scale / length_i * (to_j - cosine * to_i);
    (*gradient)[j] = scale / length_j * (to_i - cosine * to_j);
    (*gradient)[k] = -(*gradient)[i] - (*gradient)[j];
  }
  return (cosine - round.goal_cosine) * scale;
}

double FitState::excess(std::size_t t) const {
  const auto& [a, b, c] = mesh.triangles[t];
  return excess(mesh.points[a], mesh.points[b], mesh.points[c]);
}

void FitState::place_samples(const Execution& execution) {
  const std::vector<Vector3> normals = unit_normals();
  const double sum = execution.parallel_sum(
      samples.size(), placed_samples_block, 0.0, [&](std::size_t begin, std::size_t end) {
        double part = 0.0;
        MeasuredTriangle shape = measured_triangle(mesh, samples[begin].face);
        std::int32_t measured = samples[begin].face;  // neighbours in memory share triangles
        for (std::size_t s = begin; s < end; ++s) {
          FitSample& sample = samples[s];
          const std::int32_t last = sample.face;
          if (last != measured) shape = measured_triangle(mesh, last);
          measured = last;
          sample.place = shape.nearest(sample.point);
          if (sample.place.region != 0) {
            sample.place = walk_to_nearest(sample.point, mesh, sample.face, sample.place);
          }
          // Over a rim, the walk may come to the sheet behind, which the sample would pull up.
          if (normals[sample.face].dot(sample.normal) < 0.0) {
            sample.face = facing_triangle(mesh, normals, sample, last, edge);
            sample.place = nearest_in_triangle(sample.point, mesh, sample.face);
          }
          part += sample.place.squared_distance;
        }
        return part;
      });
  mean_square = std::max(sum / static_cast<double>(samples.size()), 1e-300);
  list_samples();
}

void FitState::list_samples() {
  of.resize(mesh.triangles.size());
  std::vector<std::size_t> counts(mesh.triangles.size(), 0);
  bool even = true;
  for (const FitSample& sample : samples) {
    ++counts[sample.face];
    even = even && sample.spacing == 1.0;
  }
  for (std::size_t t = 0; t < counts.size(); ++t) of[t].resize(std::exchange(counts[t], 0));
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const std::int32_t t = samples[s].face;
    of[t][counts[t]++] = static_cast<std::int32_t>(s);
  }
  sample_normals.resize(mesh.triangles.size());
  about.assign(mesh.points.size(), Vector3::Zero());
  std::vector<double> sums(mesh.points.size(), 1e-300);
  for (std::size_t t = 0; t < of.size(); ++t) {
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    Vector3 weights = Vector3::Zero();
    for (const std::int32_t s : of[t]) {
      const FitSample& sample = samples[s];
      for (int k = 0; k < 3; ++k) normals.col(k) += sample.place.weights[k] * sample.normal;
      weights += sample.place.weights;
    }
    sample_normals[t] = normals.rowwise().sum();
    for (int k = 0; k < 3; ++k) {
      about[mesh.triangles[t][k]] += normals.col(k);
      sums[mesh.triangles[t][k]] += weights[k];
    }
  }
  for (std::size_t v = 0; v < about.size(); ++v) about[v] /= sums[v];
  if (!even) read_spacing();
}

namespace {

/// The triangle of a fan nearest to a sample, and the position in it.
struct FanPlace {
  std::size_t triangle = 0;
  TrianglePlace place;
};

/// Searches from the sample's last triangle to both sides as long as they get nearer.
FanPlace place_in_fan(const std::vector<MeasuredTriangle>& triangles, const Vector3& point,
                      std::int32_t last) {
  const std::size_t count = triangles.size();
  FanPlace best;
  best.place.squared_distance = 1e300;
  const auto look = [&](std::size_t j) {
    const TrianglePlace place = triangles[j].nearest(point);
    if (place.squared_distance >= best.place.squared_distance) return false;
    best = {j, place};
    return true;
  };
  if (last < 0) {
    for (std::size_t j = 0; j < count; ++j) look(j);
    return best;
  }
  look(last);
  if (best.place.region == 0) return best;
  const auto start = static_cast<std::size_t>(last);
  bool forwards = false;
  for (std::size_t i = 1; i < count && look((start + i) % count); ++i) forwards = true;
  if (forwards) return best;
  for (std::size_t i = 1; i < count && look((start + count - i) % count); ++i) {
  }
  return best;
}

}  // namespace

void FitState::deal(const std::vector<std::int32_t>& pool,
                    const std::vector<std::int32_t>& triangles,
                    const std::vector<std::int32_t>& places) {
  std::vector<MeasuredTriangle> shapes;
  shapes.reserve(triangles.size());
  for (const std::int32_t t : triangles) {
    of[t].clear();
    sample_normals[t].setZero();
    shapes.push_back(measured_triangle(mesh, t));
  }
  for (std::size_t i = 0; i < pool.size(); ++i) {
    FitSample& sample = samples[pool[i]];
    const FanPlace in = place_in_fan(shapes, sample.point, places.empty() ? -1 : places[i]);
    sample.place = in.place;
    sample.face = triangles[in.triangle];
    of[sample.face].push_back(pool[i]);
    sample_normals[sample.face] += sample.normal;
  }
}

std::vector<std::int32_t> FitState::pool(const std::vector<std::int32_t>& triangles) const {
  std::vector<std::int32_t> result;
  for (const std::int32_t t : triangles) result.insert(result.end(), of[t].begin(), of[t].end());
  return result;
}

void FitState::read_spacing() {
  if (spacing.empty()) spacing.assign(mesh.points.size(), 1.0);
  std::vector<double> sums(mesh.points.size(), 0.0);
  std::vector<double> weights(mesh.points.size(), 0.0);
  for (const FitSample& sample : samples) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = mesh.triangles[sample.face][k];
      sums[v] += sample.place.weights[k] * sample.spacing;
      weights[v] += sample.place.weights[k];
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (weights[v] > 0.0) spacing[v] = sums[v] / weights[v];
  }
}

std::vector<Vector3> FitState::unit_normals() const {
  std::vector<Vector3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) normals[t] = unit_normal(t);
  return normals;
}

Vector3 FitState::unit_normal(std::size_t t) const {
  const auto& [a, b, c] = mesh.triangles[t];
  return unit_normal_of(mesh.points[a], mesh.points[b], mesh.points[c]);
}

Vector3 unit_normal_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = doubled_area_normal(a, b, c);
  return normal / (normal.norm() + 1e-300);
}

NodeRing ring_of(const EditMesh& mesh, std::int32_t v) {
  NodeRing ring;
  mesh.around(v, [&](std::int32_t h) {
    ring.nodes.push_back(mesh.target(h));
    ring.triangles.push_back(static_cast<std::int32_t>(face_of(h)));
    ring.beyond.push_back(static_cast<std::int32_t>(face_of(mesh.opposite[next_half_edge(h)])));
  });
  return ring;
}

double sharpest_turn(const FitState& state, const Vector3& centre, const std::vector<Vector3>& ring,
                     const std::vector<std::int32_t>& beyond, bool closed) {
  const std::size_t count = ring.size();
  const std::size_t triangles = closed ? count : count - 1;
  std::vector<Vector3> normals;
  double least = 1.0;
  for (std::size_t j = 0; j < triangles; ++j) {
    normals.push_back(unit_normal_of(centre, ring[j], ring[(j + 1) % count]));
    least = std::min(least, normals[j].dot(state.unit_normal(beyond[j])));
    if (j > 0) least = std::min(least, normals[j].dot(normals[j - 1]));
  }
  return closed ? std::min(least, normals.back().dot(normals.front())) : least;
}

namespace {

/// Keeps the 3 by 3 system solvable for a fan with few samples.
constexpr double fan_damping = 1e-3;
/// As in the step of all nodes, samples beyond a rim pull along the triangle.
constexpr double fan_rim_pull = 2.0;
/// A node needs a sample within this fraction of a spoke.
constexpr double near_sample = 0.3;

std::vector<MeasuredTriangle> triangles_of(const FitFan& fan, const Vector3& at) {
  const std::size_t count = fan.ring.size();
  std::vector<MeasuredTriangle> triangles;
  triangles.reserve(count);
  for (std::size_t j = 0; j < count; ++j) {
    triangles.emplace_back(at, fan.ring[j], fan.ring[j + 1 == count ? 0 : j + 1]);
  }
  return triangles;
}

void add_sample(const FitState& state, const FitFan& fan, const Vector3& at,
                const FitSample& sample, const FanPlace& in, const Vector3& normal,
                FanEquations& equations) {
  const std::size_t next = (in.triangle + 1) % fan.ring.size();
  const Vector3 r = in.place.point(at, fan.ring[in.triangle], fan.ring[next]) - sample.point;
  const Vector3 u =
      sample.normal.dot(normal) < 0.0 ? normal : Vector3((sample.normal + normal).normalized());
  const double weight = state.share() * state.weight(in.place.squared_distance);
  const double off = u.dot(r);
  const double w = in.place.weights[0];
  equations.matrix += weight * w * w * u * u.transpose();
  equations.right -= weight * w * off * u;
  if (in.place.region == 0) return;
  const Vector3 beyond = r - off * u;
  const double squared = beyond.squaredNorm();
  if (squared <= 1e-20) return;
  equations.matrix += weight * fan_rim_pull * w * w / squared * beyond * beyond.transpose();
  equations.right -= weight * fan_rim_pull * w * beyond;
}

double add_triangles(const FitState& state, const FitFan& fan, const Vector3& at,
                     FanEquations* equations) {
  double energy = 0.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    std::array<Vector3, 3> gradient;
    const double excess = state.excess(at, fan.ring[j], fan.ring[(j + 1) % count], &gradient);
    const Vector3 spoke = at - fan.ring[j];
    const double length = spoke.norm() + 1e-300;
    energy += state.round.price * excess * excess +
              fan.spring * (length - fan.rest) * (length - fan.rest);
    if (equations == nullptr) continue;
    if (excess > 0.0) {
      equations->matrix += state.round.price * gradient[0] * gradient[0].transpose();
      equations->right -= state.round.price * excess * gradient[0];
    }
    const Vector3 u = spoke / length;
    equations->matrix += fan.spring * u * u.transpose();
    equations->right -= fan.spring * (length - fan.rest) * u;
  }
  return energy;
}

double add_pull(const FitState& state, const FitFan& fan, const Vector3& at,
                FanEquations* equations) {
  Vector3 centre = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
  double weights = 0.0;
  const std::size_t count = fan.ring.size();
  for (std::size_t j = 0; j < count; ++j) {
    const double weight = state.ring_weight(fan.node, fan.nodes[j]);
    weights += weight;
    centre += weight * fan.ring[j];
    normal += doubled_area_normal(at, fan.ring[j], fan.ring[(j + 1) % count]);
  }
  centre /= weights;
  normal /= normal.norm() + 1e-300;
  const Vector3 off = at - centre;
  const Vector3 flat = off - normal.dot(off) * normal;
  if (equations != nullptr) {
    equations->matrix += fan.pull * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
    equations->right -= fan.pull * flat;
  }
  return fan.pull * flat.squaredNorm();
}

}  // namespace

Vector3 FanEquations::step(double most) const {
  Vector3 result = (matrix + fan_damping * Eigen::Matrix3d::Identity()).ldlt().solve(right);
  const double length = result.norm();
  if (length > most) result *= most / length;
  return result;
}

double fan_energy(const FitState& state, FitFan& fan, const Vector3& at, FanEquations* equations) {
  const std::size_t count = fan.ring.size();
  const std::vector<MeasuredTriangle> triangles = triangles_of(fan, at);
  std::vector<Vector3> normals;
  if (equations != nullptr) {
    normals.resize(count);
    for (std::size_t j = 0; j < count; ++j) {
      normals[j] = unit_normal_of(at, fan.ring[j], fan.ring[(j + 1) % count]);
    }
  }
  double energy = 0.0;
  fan.looked_at = at;
  fan.normals.assign(count, Vector3::Zero());
  fan.counts.assign(count, 0);
  fan.nearest = 1e300;
  for (std::size_t i = 0; i < fan.samples.size(); ++i) {
    const FitSample& sample = state.samples[fan.samples[i]];
    const FanPlace in = place_in_fan(triangles, sample.point, fan.places[i]);
    fan.places[i] = static_cast<std::int32_t>(in.triangle);
    fan.normals[in.triangle] += sample.normal;
    ++fan.counts[in.triangle];
    fan.nearest = std::min(fan.nearest, (sample.point - at).squaredNorm());
    energy += state.share() * state.error(in.place.squared_distance);
    if (equations != nullptr) {
      add_sample(state, fan, at, sample, in, normals[in.triangle], *equations);
    }
  }
  energy += add_triangles(state, fan, at, equations);
  if (fan.pull > 0.0) energy += add_pull(state, fan, at, equations);
  return energy;
}

bool fan_is_fine(const FitState& state, FitFan& fan, const Vector3& at) {
  constexpr int enough = 3;
  const std::size_t count = fan.ring.size();
  if (fan.looked_at != at) fan_energy(state, fan, at);
  if (fan.nearest > near_sample * near_sample * fan.rest * fan.rest) return false;
  for (std::size_t j = 0; j < count; ++j) {
    const std::size_t next = (j + 1) % count;
    Vector3 outward = fan.normals[j];
    if (fan.counts[j] < enough) {
      if (fan.counts[j] > 0) outward /= fan.counts[j];
      outward += state.about[fan.nodes[j]] + state.about[fan.nodes[next]];
    }
    const Vector3 normal = unit_normal_of(at, fan.ring[j], fan.ring[next]);
    if (normal.dot(outward) < face_agreement * outward.norm()) return false;
    if (largest_corner_cosine(at, fan.ring[j], fan.ring[next]) > state.round.early_sharpness) {
      return false;
    }
  }
  return true;
}

double fan_sharpness(const FitFan& fan, const Vector3& at) {
  double sharpest = largest_corner_cosine(at, fan.ring.back(), fan.ring.front());
  for (std::size_t j = 1; j < fan.ring.size(); ++j) {
    sharpest = std::max(sharpest, largest_corner_cosine(at, fan.ring[j - 1], fan.ring[j]));
  }
  return sharpest;
}

FitFan fan_of(const FitState& state, std::int32_t v) {
  FitFan fan;
  static_cast<NodeRing&>(fan) = ring_of(state.mesh, v);
  fan.node = v;
  fan.centre = state.mesh.points[v];
  for (const std::int32_t y : fan.nodes) fan.ring.push_back(state.mesh.points[y]);
  for (std::size_t j = 0; j < fan.triangles.size(); ++j) {
    const std::vector<std::int32_t>& samples = state.of[fan.triangles[j]];
    fan.samples.insert(fan.samples.end(), samples.begin(), samples.end());
    fan.places.insert(fan.places.end(), samples.size(), static_cast<std::int32_t>(j));
  }
  return fan;
}

}  // namespace wscvt
