// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/map/kernel_insertion.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/orientation.h"

namespace wscvt {

namespace {

using Vector2 = Eigen::Vector2d;

bool is_in_kernel(const Vector3& p, const std::vector<Vector3>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (!counter_clockwise(p, ring[i], ring[i + 1 < ring.size() ? i + 1 : 0])) return false;
  }
  return true;
}

/// Whether twice the area of every triangle about p exceeds `floor`, up to rounding.
bool is_well_inside(const Vector3& p, const std::vector<Vector3>& ring, double floor) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector3& a = ring[i];
    const Vector3& b = ring[i + 1 < ring.size() ? i + 1 : 0];
    if (!(p.dot(doubled_area_normal(p, a, b)) > floor)) return false;
  }
  return true;
}

/// Clips a convex polygon to value + slope . x >= 0 (Sutherland and Hodgman 1974).
void clip(std::vector<Vector2>& polygon, double value, const Vector2& slope,
          std::vector<Vector2>& scratch) {
  scratch.clear();
  for (std::size_t j = 0; j < polygon.size(); ++j) {
    const Vector2& a = polygon[j];
    const Vector2& b = polygon[j + 1 < polygon.size() ? j + 1 : 0];
    const double at_a = value + slope.dot(a);
    const double at_b = value + slope.dot(b);
    if (at_a >= 0.0) scratch.push_back(a);
    if ((at_a < 0.0) != (at_b < 0.0)) scratch.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  polygon.swap(scratch);
}

/// Returns the centroid of a convex polygon; nothing if it has no area.
std::optional<Vector2> centroid(const std::vector<Vector2>& polygon) {
  double doubled = 0.0;
  Vector2 moment = Vector2::Zero();
  for (std::size_t j = 1; j + 1 < polygon.size(); ++j) {
    const Vector2 a = polygon[j] - polygon[0];
    const Vector2 b = polygon[j + 1] - polygon[0];
    const double part = a.x() * b.y() - a.y() * b.x();
    doubled += part;
    moment += part * (a + b) / 3.0;
  }
  if (!(doubled > 0.0)) return std::nullopt;
  return moment / doubled + polygon[0];
}

/// Returns the centroid of the kernel in the gnomonic plane about the apex, where great circles are
/// lines.
std::optional<Vector3> kernel_centroid(const std::vector<Vector3>& ring, std::size_t apex,
                                       double size) {
  const Vector3& o = ring[apex];
  const Vector3 e1 = o.unitOrthogonal();
  const Vector3 e2 = o.cross(e1);
  // The plane is in units of the ring's size. The box cuts off nothing important; for rings round
  // half the sphere it ends 76 degrees from the apex.
  const double unit = std::min(size, 1.0);
  std::vector<Vector2> polygon{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}};
  std::vector<Vector2> scratch;
  for (std::size_t i = 0; i < ring.size() && polygon.size() >= 3; ++i) {
    const std::size_t next = i + 1 < ring.size() ? i + 1 : 0;
    // The normal of the great circle through two neighbours, from differences to keep relative
    // precision.
    const Vector3 a = ring[i] - o;
    const Vector3 b = ring[next] - o;
    const Vector3 ab = a.cross(b);
    const Vector3 normal = o.cross(b - a) + ab;
    const double value = i == apex || next == apex ? 0.0 : o.dot(ab);
    clip(polygon, value, unit * Vector2(normal.dot(e1), normal.dot(e2)), scratch);
  }
  const std::optional<Vector2> middle = centroid(polygon);
  if (!middle) return std::nullopt;
  return (o + unit * (middle->x() * e1 + middle->y() * e2)).normalized();
}

}  // namespace

std::optional<Insertion> insert_into_kernel(const std::vector<Vector3>& ring,
                                            const std::vector<double>& distances,
                                            std::size_t apex) {
  const std::size_t count = ring.size();
  if (count < 3) return std::nullopt;  // no polygon
  const Vector3& o = ring[apex];
  double size = 0.0;
  double mean_distance = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    size = std::max(size, (ring[i] - o).norm());
    mean_distance += distances[i] / static_cast<double>(count);
  }
  // Beyond a radian the mean may lie on the wrong side of the sphere.
  if (size < 1.0) {
    const double floor = mean_distance > 0.0 ? 1e-6 * mean_distance : 1.0;
    Vector3 mean = Vector3::Zero();
    for (std::size_t i = 0; i < count; ++i) mean += ring[i] / (distances[i] + floor);
    mean.normalize();
    // If a triangle would be thinner than this, the kernel's centroid may be better.
    if (is_well_inside(mean, ring, 1e-4 * size * size)) return Insertion{mean, false};
  }
  const std::optional<Vector3> centre = kernel_centroid(ring, apex, size);
  if (centre && is_in_kernel(*centre, ring)) return Insertion{*centre, true};
  // Tries points ever closer to the apex, along the middle of its angle, where the kernel is never
  // empty.
  const Vector3 forward = (ring[(apex + 1) % count] - o).normalized();
  const Vector3 backward = (ring[(apex + count - 1) % count] - o).normalized();
  Vector3 along = forward + backward;
  along -= along.dot(o) * o;
  // The middle of an angle above 180 degrees is on the other side.
  if (forward.cross(backward).dot(o) < 0.0) along = -along;
  if (along.norm() < 1e-6) along = o.cross(forward - backward);
  along.normalize();
  double step = 0.3 * size;
  while (step > 1e-14) {
    const Vector3 p = (o + step * along).normalized();
    if (is_in_kernel(p, ring)) return Insertion{p, true};
    step *= 0.5;
  }
  return std::nullopt;
}

}  // namespace wscvt
