// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/study/contact_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include "support/test_shapes.h"
#include "toolbox/exchange/simulation_options.h"
#include "wscvt/repair/mesh_check.h"

namespace wscvt::study {

namespace {

constexpr double grid_spacing = 0.04;
/// Cells of a grid about the box of the scan, see distance_grid.
constexpr int grid_margin = 4;
/// True overlap at which forces are compared.
constexpr double overlap = 0.01;

/// The distance at a point, linear in each cell, and its gradient there.
struct FieldValue {
  double distance = 0.0;
  Vector3 gradient = Vector3::Zero();
};

/// Beyond the grid a lower bound of the distance, and no gradient.
FieldValue field_at(const DistanceGrid& grid, const Vector3& point) {
  const Vector3 place = (point - grid.origin) / grid.spacing;
  std::array<std::size_t, 3> cell{};
  Vector3 part;
  double outside = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto last = static_cast<double>(grid.counts[k] - 1);
    const double within = std::clamp(place[axis], 0.0, last);
    outside += (place[axis] - within) * (place[axis] - within);
    cell[k] = std::min(static_cast<std::size_t>(within), grid.counts[k] - 2);
    part[axis] = within - static_cast<double>(cell[k]);
  }
  // The surface lies as far within the grid as its margin.
  if (outside > 0.0) return {(std::sqrt(outside) + grid_margin) * grid.spacing, Vector3::Zero()};
  const auto corner = [&](std::size_t i, std::size_t j, std::size_t k) {
    return grid
        .values[((cell[0] + i) * grid.counts[1] + cell[1] + j) * grid.counts[2] + cell[2] + k];
  };
  FieldValue value;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t k = 0; k < 2; ++k) {
        const double wx = i == 1 ? part[0] : 1.0 - part[0];
        const double wy = j == 1 ? part[1] : 1.0 - part[1];
        const double wz = k == 1 ? part[2] : 1.0 - part[2];
        const double distance = corner(i, j, k);
        value.distance += wx * wy * wz * distance;
        value.gradient += distance / grid.spacing *
                          Vector3((i == 1 ? 1.0 : -1.0) * wy * wz, (j == 1 ? 1.0 : -1.0) * wx * wz,
                                  (k == 1 ? 1.0 : -1.0) * wx * wy);
      }
    }
  }
  return value;
}

MeanAndScatter mean_and_scatter(const std::vector<double>& values, double unit) {
  MeanAndScatter result;
  for (const double value : values) result.mean += value / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.scatter = unit * std::sqrt(squares / static_cast<double>(values.size()));
  result.mean *= unit;
  return result;
}

/// Of a sum of forces by that of the true ones; the scatter of the single quotients about it.
MeanAndScatter quotient(const std::vector<double>& forces, const std::vector<double>& true_forces) {
  MeanAndScatter result;
  double sum = 0.0;
  double true_sum = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    sum += forces[i];
    true_sum += true_forces[i];
  }
  result.mean = sum / true_sum;
  double squares = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double off = forces[i] / true_forces[i] - result.mean;
    squares += off * off;
  }
  result.scatter = std::sqrt(squares / static_cast<double>(forces.size()));
  return result;
}

double reach_along(const std::vector<Vector3>& points, const Vector3& direction) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vector3& p : points) reach = std::max(reach, p.dot(direction));
  return reach;
}

}  // namespace

IndexedMesh unit_scan(const IndexedMesh& scan, const Execution& execution) {
  IndexedMesh used = check_mesh(scan, MeshCheckOptions(), execution).mesh;
  FrameOptions options;
  options.frame = Frame::Principal;
  options.size = 2.0;
  const SimulationFrame frame = simulation_frame(describe_shape(used, execution), options);
  return in_frame(std::move(used), frame);
}

/// The nodes that may touch nearer and nearer the other's surface: each is looked at again when it
/// could have come as far as its distance, which changes no faster than the grains near each other,
/// and the first whose turn comes on the surface is the first to touch.
ContactGrain::Touch ContactGrain::first_touch(const std::vector<Vector3>& nodes,
                                              const Eigen::Matrix3d& turn,
                                              const Vector3& direction) const {
  constexpr double on_the_surface = 1e-6;
  // Of a field that is linear in cells the gradient may be a little steeper than 1.
  constexpr double steepest = 1.01;
  using Turn = std::pair<double, std::size_t>;  // way come, node
  std::vector<Turn> turns;
  const double start = 2.0 * reach_ + 0.01;
  const Vector3 way = turn * direction;
  const auto distance_after = [&](double come, std::size_t i) {
    return field_at(field_, turn * nodes[i] - (start - come) * way).distance;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].dot(direction) > 0.0) turns.emplace_back(distance_after(0.0, i) / steepest, i);
  }
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> queue(std::greater<>(),
                                                                     std::move(turns));
  while (!queue.empty() && queue.top().first < start) {
    const auto [come, i] = queue.top();
    queue.pop();
    const double distance = distance_after(come, i);
    if (distance < on_the_surface) return {start - come, i};
    queue.emplace(come + distance / steepest, i);
  }
  return {};
}

void ContactGrain::forces(const NodeTable& nodes, const Contact& contact, double& deepest,
                          double& area_sum) const {
  deepest = 0.0;
  Vector3 sum = Vector3::Zero();
  const Vector3 centre = (contact.distance - overlap) * (contact.turn * contact.direction);
  for (std::size_t i = 0; i < nodes.mesh.points.size(); ++i) {
    const FieldValue value = field_at(field_, contact.turn * nodes.mesh.points[i] - centre);
    if (value.distance >= 0.0) continue;
    deepest = std::max(deepest, -value.distance);
    sum -= nodes.areas[i] * value.distance * value.gradient;
  }
  area_sum = sum.norm();
}

ContactGrain::ContactGrain(const IndexedMesh& scan, std::size_t contacts,
                           const Execution& execution, std::uint64_t series)
    : field_(distance_grid(scan, GridOptions{grid_spacing}, execution)) {
  const NodeTable surface = node_table(test::subdivided(scan, 1));
  for (const Vector3& p : surface.mesh.points) reach_ = std::max(reach_, p.norm());
  contacts_.resize(contacts);
  execution.parallel_for(contacts, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Contact& contact = contacts_[i];
      const std::uint64_t seed = 1000000 * series + 2 * i + 1;
      contact.turn = test::random_rotation(seed);
      contact.direction = test::random_rotation(seed + 1).col(0);
      contact.distance = touching_distance(surface.mesh.points, contact.turn, contact.direction);
      contact.back = touching_distance(surface.mesh.points, contact.turn.transpose(),
                                       -(contact.turn * contact.direction));
      contact.plane = reach_along(surface.mesh.points, contact.direction);
      forces(surface, contact, contact.deepest, contact.area_sum);
    }
  });
}

std::vector<Vector3> ContactGrain::fitted_to_contacts(std::vector<Vector3> nodes,
                                                      const Execution& execution) const {
  constexpr int steps = 30;
  constexpr double step_share = 0.6;
  constexpr double damping = 0.05;
  constexpr double longest_step = 0.05;
  /// Grazing contacts say next to nothing of where a node should be.
  constexpr double smallest_slope = 0.2;
  std::vector<Vector3> best;
  double least = std::numeric_limits<double>::infinity();
  std::vector<Touch> touches(contacts_.size());
  for (int step = 0; step <= steps; ++step) {
    execution.parallel_for(contacts_.size(), 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        touches[c] = first_touch(nodes, contacts_[c].turn, contacts_[c].direction);
      }
    });
    std::vector<Eigen::Matrix3d> matrices(nodes.size(), Eigen::Matrix3d::Zero());
    std::vector<Vector3> right_sides(nodes.size(), Vector3::Zero());
    std::vector<double> counts(nodes.size(), 0.0);
    double sum = 0.0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Contact& contact = contacts_[c];
      const auto& [distance, node] = touches[c];
      const Vector3 way = contact.turn * contact.direction;
      const Vector3 gradient =
          field_at(field_, contact.turn * nodes[node] - distance * way).gradient;
      // The node stays on the other's surface: gradient . (turn move - way change) = 0.
      const double slope = gradient.dot(way);
      const double kept = std::copysign(std::max(std::abs(slope), smallest_slope), slope);
      const Vector3 change = contact.turn.transpose() * gradient / kept;
      const double error = distance - contact.distance;
      matrices[node] += change * change.transpose();
      right_sides[node] -= error * change;
      counts[node] += 1.0;
      sum += error * error;
    }
    if (sum < least) {
      least = sum;
      best = nodes;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (counts[i] == 0.0) continue;
      const Eigen::Matrix3d damped =
          matrices[i] + damping * (counts[i] + 3.0) * Eigen::Matrix3d::Identity();
      Vector3 move = damped.ldlt().solve(right_sides[i]);
      if (move.norm() > longest_step) move *= longest_step / move.norm();
      nodes[i] += step_share * move;
    }
  }
  return best;
}

ContactErrors ContactGrain::errors(const NodeTable& nodes, const Execution& execution) const {
  const std::size_t count = contacts_.size();
  std::vector<double> grain(count), both(count), plane(count), deepest(count), area(count);
  execution.parallel_for(count, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Contact& contact = contacts_[i];
      const double there = touching_distance(nodes.mesh.points, contact.turn, contact.direction);
      const double back = touching_distance(nodes.mesh.points, contact.turn.transpose(),
                                            -(contact.turn * contact.direction));
      grain[i] = there - contact.distance;
      both[i] = std::max(there, back) - std::max(contact.distance, contact.back);
      plane[i] = reach_along(nodes.mesh.points, contact.direction) - contact.plane;
      forces(nodes, contact, deepest[i], area[i]);
    }
  });
  std::vector<double> true_deepest, true_area;
  double missed = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    true_deepest.push_back(contacts_[i].deepest);
    true_area.push_back(contacts_[i].area_sum);
    if (deepest[i] == 0.0) missed += 100.0 / static_cast<double>(count);
  }
  return {mean_and_scatter(grain, 100.0), mean_and_scatter(both, 100.0),
          mean_and_scatter(plane, 100.0), quotient(deepest, true_deepest),
          quotient(area, true_area),      missed};
}

namespace {

RemeshOptions published(Weighting weighting, Sampling sampling = Sampling::Weighted) {
  AsPublishedOptions method;
  method.weighting = weighting;
  method.sampling = sampling;
  method.placement = PublishedPlacement::Surface;
  RemeshOptions options;
  options.method = method;
  return options;
}

RemeshOptions on_scan(CellWeighting weighting, ScanPlacement placement,
                      double edge_ratio = default_edge_ratio) {
  OnScanOptions method;
  method.weighting = weighting;
  method.placement = placement;
  method.edge_ratio = edge_ratio;
  RemeshOptions options;
  options.method = method;
  return options;
}

}  // namespace

std::vector<ContactSampling> contact_samplings() {
  const auto contact = [](double ball_radius) {
    RemeshOptions options = on_scan(CellWeighting::Area, ScanPlacement::ContactFit, 1.4);
    std::get<OnScanOptions>(options.method).contact_radius = ball_radius;
    return options;
  };
  return {{"WSCVT-D", published(Weighting::RadialDistance)},
          {"WSCVT-C", published(Weighting::Curvature)},
          {"constant", published(Weighting::Constant)},
          {"Fibonacci", published(Weighting::Constant, Sampling::Fibonacci)},
          {"on the scan", on_scan(CellWeighting::Area, ScanPlacement::OnSurface)},
          {"fitted", on_scan(CellWeighting::Area, ScanPlacement::Fitted)},
          {"fitted, close", on_scan(CellWeighting::Area, ScanPlacement::Fitted, 1.4)},
          {"contact 0.4", contact(0.4)},
          {"contact 1.3", contact(1.3)},
          {"contact 5", contact(5.0)}};
}

}  // namespace wscvt::study
