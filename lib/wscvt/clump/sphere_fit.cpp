// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/clump/sphere_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wscvt {

namespace {

constexpr double far_away = 1e6;  ///< of a sphere that there is not, in equivalent radii
constexpr std::size_t rough_step = 8;
constexpr double no_limit = std::numeric_limits<double>::infinity();

}  // namespace

SphereFit::SphereFit(const std::vector<Vector3>& on_surface, const std::vector<Vector3>& inside,
                     const std::vector<Vector3>& outside, const Limits& limits)
    : limits_(limits), surface_count_(on_surface.size()) {
  const auto append = [&](const std::vector<Vector3>& points, std::size_t first, double lowest,
                          double highest) {
    for (std::size_t i = first; i < points.size(); i += rough_step) {
      x_.push_back(points[i].x());
      y_.push_back(points[i].y());
      z_.push_back(points[i].z());
      lowest_.push_back(lowest);
      highest_.push_back(highest);
    }
  };
  // One of each so many samples first: they lie beside each other, and the rough energy is theirs.
  for (std::size_t first = 0; first < rough_step; ++first) {
    append(on_surface, first, -no_limit, no_limit);
    append(inside, first, 0.0, no_limit);
    append(outside, first, -no_limit, 0.0);
    if (first == 0) rough_count_ = x_.size();
  }
  nearest_.resize(x_.size());
  first_.assign(x_.size(), far_away);
  second_.assign(x_.size(), far_away);
  energy_ = far_away * far_away;
}

void SphereFit::distances_to(const Sphere& sphere, std::vector<double>& distances) const {
  const double x = sphere.centre.x();
  const double y = sphere.centre.y();
  const double z = sphere.centre.z();
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double dx = x_[i] - x;
    const double dy = y_[i] - y;
    const double dz = z_[i] - z;
    distances[i] = std::sqrt(dx * dx + dy * dy + dz * dz) - sphere.radius;
  }
}

double SphereFit::energy_with(const Sphere& sphere, std::size_t samples) const {
  const double x = sphere.centre.x();
  const double y = sphere.centre.y();
  const double z = sphere.centre.z();
  return sum_of_costs(samples, [&](std::size_t i) {
    const double dx = x_[i] - x;
    const double dy = y_[i] - y;
    const double dz = z_[i] - z;
    const double distance = std::sqrt(dx * dx + dy * dy + dz * dz) - sphere.radius;
    return std::min(distance, first_[i]);
  });
}

double SphereFit::rough_energy_with(const Sphere& sphere) const {
  const double share = static_cast<double>(x_.size()) / static_cast<double>(rough_count_);
  return share * energy_with(sphere, rough_count_);
}

double SphereFit::energy_with(const Sphere& sphere) const { return energy_with(sphere, x_.size()); }

void SphereFit::add_up() {
  energy_ = sum_of_costs(x_.size(), [this](std::size_t i) { return first_[i]; });
}

void SphereFit::find_nearest(std::size_t i) {
  Nearest nearest;
  double first = far_away;
  double second = far_away;
  for (std::size_t k = 0; k < spheres_.size(); ++k) {
    const double distance = distances_[k][i];
    if (distance < first) {
      second = first;
      nearest.second = nearest.first;
      first = distance;
      nearest.first = static_cast<std::int32_t>(k);
    } else if (distance < second) {
      second = distance;
      nearest.second = static_cast<std::int32_t>(k);
    }
  }
  nearest_[i] = nearest;
  first_[i] = first;
  second_[i] = second;
}

void SphereFit::take(std::size_t k, const Sphere& sphere) {
  const auto own = static_cast<std::int32_t>(k);
  spheres_[k] = sphere;
  distances_to(sphere, distances_[k]);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double distance = distances_[k][i];
    if (distance >= second_[i] && nearest_[i].first != own && nearest_[i].second != own) continue;
    wake(nearest_[i].first);
    if (nearest_[i].first == own || nearest_[i].second == own) {
      find_nearest(i);
    } else if (distance < first_[i]) {
      second_[i] = first_[i];
      nearest_[i].second = nearest_[i].first;
      first_[i] = distance;
      nearest_[i].first = own;
    } else {
      second_[i] = distance;
      nearest_[i].second = own;
    }
    wake(nearest_[i].first);
  }
  add_up();
}

void SphereFit::set_inner_weight(double weight) {
  inner_weight_ = weight;
  steps_.assign(spheres_.size(), Steps());
  add_up();
}

void SphereFit::add(const Sphere& sphere) {
  spheres_.push_back(sphere);
  steps_.emplace_back();
  distances_.emplace_back(x_.size());
  take(spheres_.size() - 1, sphere);
}

std::size_t SphereFit::least_needed() const {
  std::vector<double> rises(spheres_.size(), 0.0);
  for (std::size_t i = 0; i < x_.size(); ++i) {
    rises[static_cast<std::size_t>(nearest_[i].first)] += cost(i, second_[i]) - cost(i, first_[i]);
  }
  return static_cast<std::size_t>(std::min_element(rises.begin(), rises.end()) - rises.begin());
}

void SphereFit::remove(std::size_t k) {
  spheres_.erase(spheres_.begin() + static_cast<std::ptrdiff_t>(k));
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(k));
  distances_.erase(distances_.begin() + static_cast<std::ptrdiff_t>(k));
  for (std::size_t i = 0; i < x_.size(); ++i) find_nearest(i);
  for (Steps& steps : steps_) steps = Steps();
  add_up();
}

/// Changes the sphere if that lowers the energy.
bool SphereFit::try_sphere(std::size_t k, const Sphere& sphere) {
  const auto own = static_cast<std::int32_t>(k);
  const std::vector<double>& before = distances_[k];
  // No distance changes by more, so that most samples keep their nearest sphere unseen.
  const double most_change =
      (sphere.centre - spheres_[k].centre).norm() + std::abs(sphere.radius - spheres_[k].radius);
  double change = 0.0;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (before[i] - most_change > first_[i]) continue;
    const double others = nearest_[i].first == own ? second_[i] : first_[i];
    const double own_distance = sphere.distance(Vector3(x_[i], y_[i], z_[i]));
    change += cost(i, std::min(others, own_distance)) - cost(i, first_[i]);
  }
  constexpr double least_gain = 1e-7;
  if (!(change / static_cast<double>(surface_count_) < -least_gain * energy_)) return false;
  take(k, sphere);
  return true;
}

/// A Gauss-Newton step of the samples that are nearest to the sphere. `radius_follows`: the radius
/// is the centre's depth and no unknown of its own. False where too few samples tell of it.
bool SphereFit::gauss_newton(std::size_t k, bool radius_follows, Sphere& moved) const {
  const auto own = static_cast<std::int32_t>(k);
  const Sphere& sphere = spheres_[k];
  Vector3 slope = Vector3::Zero();
  if (radius_follows) {
    slope = (sphere.centre - limits_.surface->nearest_point(sphere.centre)).normalized();
  }
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double count = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (nearest_[i].first != own) continue;
    const double residual = std::clamp(first_[i], lowest_[i], highest_[i]);
    if (residual != first_[i]) continue;
    const Vector3 from = Vector3(x_[i], y_[i], z_[i]) - sphere.centre;
    Eigen::Vector4d row;
    row.head<3>() = -from.normalized() - slope;
    row[3] = radius_follows ? 0.0 : -1.0;
    const double counts = weight(residual);
    matrix += counts * row * row.transpose();
    right -= counts * residual * row;
    count += 1.0;
    weights += counts;
  }
  if (count < 4.0) return false;
  matrix.diagonal().array() += steps_[k].damping * weights;
  const Eigen::Vector4d step = matrix.ldlt().solve(right);
  moved.centre = sphere.centre + step.head<3>();
  moved.radius = sphere.radius + step[3];
  return step.allFinite();
}

void SphereFit::improve_freely(std::size_t k) {
  constexpr int attempts = 3;
  constexpr double least_damping = 1e-4;
  constexpr double most_damping = 1e4;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Sphere moved;
    if (!gauss_newton(k, false, moved)) break;
    moved.radius = std::max(moved.radius, limits_.smallest_radius);
    if (try_sphere(k, moved)) {
      steps_[k].damping = std::max(least_damping, 0.3 * steps_[k].damping);
      return;
    }
    steps_[k].damping = std::min(most_damping, 5.0 * steps_[k].damping);
  }
  steps_[k].rests = true;
}

/// Where the radius is the depth of the centre it has kinks on the medial axis, where centres come
/// to lie: beside Gauss-Newton steps along the axes are tried.
void SphereFit::improve_inside(std::size_t k) {
  constexpr double longest = 0.9;  // over the radius: a centre that moves less stays inside
  const auto try_move = [&](Vector3 move) {
    const Sphere before = spheres_[k];
    if (move.norm() > longest * before.radius) move *= longest * before.radius / move.norm();
    const Vector3 centre = before.centre + move;
    const double radius = limits_.surface->distance(centre);
    return radius >= limits_.smallest_radius && try_sphere(k, {centre, radius});
  };
  Sphere moved;
  if (gauss_newton(k, true, moved)) try_move(moved.centre - spheres_[k].centre);
  const double length = steps_[k].length * spheres_[k].radius;
  bool stepped = false;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      if (!try_move(sign * length * Vector3::Unit(axis))) continue;
      stepped = true;
      break;
    }
  }
  constexpr double least_length = 1e-4;
  steps_[k].length =
      std::clamp(stepped ? 1.5 * steps_[k].length : 0.5 * steps_[k].length, least_length, 0.5);
  steps_[k].rests = !stepped && steps_[k].length == least_length;
}

void SphereFit::sweep() {
  for (std::size_t k = 0; k < spheres_.size(); ++k) {
    if (steps_[k].rests) continue;
    if (limits_.surface != nullptr) {
      improve_inside(k);
    } else {
      improve_freely(k);
    }
  }
}

}  // namespace wscvt
