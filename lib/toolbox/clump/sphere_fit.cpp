// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/sphere_fit.h"

#include <Eigen/Cholesky>

namespace wscvt {

namespace {

constexpr double far_away = 1e6;  ///< distance to a missing sphere, in equivalent radii
/// Bound of the rounding in a block's reach.
constexpr double slack = 1e-9;

}  // namespace

SphereFit::SphereFit(const std::vector<Vector3>& on_surface, const std::vector<Vector3>& inside,
                     const std::vector<Vector3>& outside, const Limits& limits)
    : limits_(limits), surface_count_(on_surface.size()) {
  append(on_surface, Kind::Surface);
  append(inside, Kind::Inside);
  append(outside, Kind::Outside);
  nearest_.resize(x_.size());
  first_.assign(x_.size(), far_away);
  second_.assign(x_.size(), far_away);
  for (Block& block : blocks_) update(block);
  add_up();
}

void SphereFit::append(const std::vector<Vector3>& points, Kind kind) {
  const PointBlocks parted(points);
  for (const PointBlock& part : parted.blocks()) {
    Block block;
    static_cast<PointBlock&>(block) = part;
    block.begin += x_.size();
    block.end += x_.size();
    block.kind = kind;
    blocks_.push_back(block);
  }
  for (const Vector3& p : parted.points()) {
    x_.push_back(p.x());
    y_.push_back(p.y());
    z_.push_back(p.z());
  }
}

/// Updates a block's summary of its samples.
void SphereFit::update(Block& block) {
  block.most_first = -far_away;
  block.most_second = -far_away;
  block.cost = 0.0;
  for (std::size_t i = block.begin; i < block.end; ++i) {
    block.most_first = std::max(block.most_first, first_[i]);
    block.most_second = std::max(block.most_second, second_[i]);
    block.cost += cost(block.kind, first_[i]);
  }
}

void SphereFit::add_up() {
  double sum = 0.0;
  for (const Block& block : blocks_) sum += block.cost;
  energy_ = sum / static_cast<double>(surface_count_);
}

double SphereFit::energy_with(const Sphere& sphere) const {
  double change = 0.0;
  for (const Block& block : blocks_) {
    // Inside samples cost nothing once a sphere contains them; outside samples until one does.
    const double most = block.kind == Kind::Outside ? 0.0 : block.most_first;
    if ((block.kind == Kind::Inside && most <= 0.0) || block.reach(sphere) >= most) continue;
    double sum = 0.0;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      sum += cost(block.kind, std::min(distance(i, sphere), first_[i]));
    }
    change += sum - block.cost;
  }
  return energy_ + change / static_cast<double>(surface_count_);
}

void SphereFit::find_nearest(std::size_t i) {
  Nearest nearest;
  double first = far_away;
  double second = far_away;
  for (std::size_t k = 0; k < spheres_.size(); ++k) {
    const double other = distance(i, spheres_[k]);
    if (other < first) {
      second = first;
      nearest.second = nearest.first;
      first = other;
      nearest.first = static_cast<std::int32_t>(k);
    } else if (other < second) {
      second = other;
      nearest.second = static_cast<std::int32_t>(k);
    }
  }
  nearest_[i] = nearest;
  first_[i] = first;
  second_[i] = second;
}

/// Updates the two nearest spheres of a sample after the sphere `own` moved to this distance.
void SphereFit::move_nearest(std::size_t i, std::int32_t own, double distance) {
  Nearest& nearest = nearest_[i];
  if (nearest.first == own) {
    if (distance > second_[i]) return find_nearest(i);
    first_[i] = distance;
  } else if (distance < first_[i]) {
    second_[i] = first_[i];
    nearest.second = nearest.first;
    first_[i] = distance;
    nearest.first = own;
  } else if (nearest.second == own && distance > second_[i]) {
    find_nearest(i);
  } else if (distance < second_[i]) {
    second_[i] = distance;
    nearest.second = own;
  }
}

void SphereFit::take(std::size_t k, const Sphere& sphere) {
  const auto own = static_cast<std::int32_t>(k);
  const Sphere before = spheres_[k];
  spheres_[k] = sphere;
  for (Block& block : blocks_) {
    if (std::min(block.reach(before), block.reach(sphere)) > block.most_second + slack) continue;
    bool changes = false;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const Nearest was = nearest_[i];
      const double now = distance(i, sphere);
      if (now >= second_[i] && was.first != own && was.second != own) continue;
      changes = true;
      move_nearest(i, own, now);
      wake(was.first);
      wake(nearest_[i].first);
    }
    if (changes) update(block);
  }
  add_up();
}

void SphereFit::set_inner_weight(double weight) {
  inner_weight_ = weight;
  steps_.assign(spheres_.size(), Steps());
  for (Block& block : blocks_) update(block);
  add_up();
}

void SphereFit::add(const Sphere& sphere) {
  spheres_.push_back(sphere);
  steps_.emplace_back();
  take(spheres_.size() - 1, sphere);
}

std::size_t SphereFit::least_needed() const {
  std::vector<double> rises(spheres_.size(), 0.0);
  for (const Block& block : blocks_) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      rises[nearest_[i].first] += cost(block.kind, second_[i]) - cost(block.kind, first_[i]);
    }
  }
  return static_cast<std::size_t>(std::min_element(rises.begin(), rises.end()) - rises.begin());
}

void SphereFit::remove(std::size_t k) {
  const auto own = static_cast<std::int32_t>(k);
  spheres_.erase(spheres_.begin() + static_cast<std::ptrdiff_t>(k));
  for (std::size_t i = 0; i < x_.size(); ++i) {
    Nearest& nearest = nearest_[i];
    if (nearest.first == own || nearest.second == own) {
      find_nearest(i);
      continue;
    }
    if (nearest.first > own) --nearest.first;
    if (nearest.second > own) --nearest.second;
  }
  steps_.assign(spheres_.size(), Steps());
  for (Block& block : blocks_) update(block);
  add_up();
}

/// Changes the sphere if this lowers the energy.
bool SphereFit::try_sphere(std::size_t k, const Sphere& sphere) {
  const auto own = static_cast<std::int32_t>(k);
  double change = 0.0;
  for (const Block& block : blocks_) {
    if (std::min(block.reach(spheres_[k]), block.reach(sphere)) > block.most_first + slack) {
      continue;
    }
    double sum = 0.0;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const double others = nearest_[i].first == own ? second_[i] : first_[i];
      sum += cost(block.kind, std::min(others, distance(i, sphere)));
    }
    change += sum - block.cost;
  }
  constexpr double least_gain = 1e-7;
  if (!(change / static_cast<double>(surface_count_) < -least_gain * energy_)) return false;
  take(k, sphere);
  return true;
}

/// Makes a Gauss-Newton step for the samples nearest to the sphere. `radius_follows`: the radius is
/// the centre's depth, not an unknown. False if too few samples depend on the sphere.
bool SphereFit::gauss_newton(std::size_t k, bool radius_follows, Sphere& moved) const {
  const auto own = static_cast<std::int32_t>(k);
  const Sphere& sphere = spheres_[k];
  Vector3 slope = Vector3::Zero();
  if (radius_follows) {
    const std::size_t i = limits_.depths->nearest(sphere.centre);
    slope = (sphere.centre - limits_.depths->points()[i]).normalized();
  }
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double count = 0.0;
  double weights = 0.0;
  for (const Block& block : blocks_) {
    if (block.reach(sphere) > block.most_first + slack) continue;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const double residual = first_[i];
      if (nearest_[i].first != own || (block.kind == Kind::Inside && residual < 0.0) ||
          (block.kind == Kind::Outside && residual > 0.0)) {
        continue;
      }
      const Vector3 from = Vector3(x_[i], y_[i], z_[i]) - sphere.centre;
      Eigen::Vector4d row;
      row.head<3>() = -from.normalized() - slope;
      row[3] = radius_follows ? 0.0 : -1.0;
      const double counts = residual < 0.0 ? inner_weight_ : 1.0;
      matrix += counts * row * row.transpose();
      right -= counts * residual * row;
      count += 1.0;
      weights += counts;
    }
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
    moved.radius = std::clamp(moved.radius, limits_.smallest_radius, limits_.largest_radius);
    if (try_sphere(k, moved)) {
      steps_[k].damping = std::max(least_damping, 0.3 * steps_[k].damping);
      return;
    }
    steps_[k].damping = std::min(most_damping, 5.0 * steps_[k].damping);
  }
  steps_[k].rests = true;
}

/// Centres come to lie on the medial axis, where the radius as the centre's depth has kinks. So
/// steps along the axes are tried beside Gauss-Newton steps.
void SphereFit::improve_inside(std::size_t k) {
  constexpr double longest = 0.9;  // over the radius: after smaller moves the centre stays inside
  const auto try_move = [&](Vector3 move) {
    const Sphere before = spheres_[k];
    if (move.norm() > longest * before.radius) move *= longest * before.radius / move.norm();
    const Vector3 centre = before.centre + move;
    const std::size_t nearest = limits_.depths->nearest(centre);
    const double radius = (limits_.depths->points()[nearest] - centre).norm();
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
    if (limits_.depths != nullptr) {
      improve_inside(k);
    } else {
      improve_freely(k);
    }
  }
}

}  // namespace wscvt
