// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/triangle_hash.h"

#include <algorithm>
#include <cmath>

namespace wscvt {

namespace {

std::array<Vector3, 3> corners_of(const EditMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

bool segment_pierces(const Vector3& p, const Vector3& q, const std::array<Vector3, 3>& x) {
  const Vector3 n = doubled_area_normal(x[0], x[1], x[2]);
  const double dp = n.dot(p - x[0]);
  const double dq = n.dot(q - x[0]);
  if (dp * dq > 0.0 || dp == dq) return false;
  const Vector3 at = p + dp / (dp - dq) * (q - p);
  for (std::size_t k = 0; k < 3; ++k) {
    if (n.dot((x[following(k)] - x[k]).cross(at - x[k])) < 0.0) return false;
  }
  return true;
}

/// Whether a triangle lies on one side of the plane of another, or touches it from there.
bool on_one_side(const std::array<Vector3, 3>& x, const std::array<Vector3, 3>& y) {
  const Vector3 n = doubled_area_normal(x[0], x[1], x[2]);
  const double a = n.dot(y[0] - x[0]);
  const double b = n.dot(y[1] - x[0]);
  const double c = n.dot(y[2] - x[0]);
  return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

bool boxes_part(const std::array<Vector3, 3>& x, const std::array<Vector3, 3>& y) {
  for (int k = 0; k < 3; ++k) {
    const double low = std::min({y[0][k], y[1][k], y[2][k]});
    const double high = std::max({y[0][k], y[1][k], y[2][k]});
    if (low > x[0][k] && low > x[1][k] && low > x[2][k]) return true;
    if (high < x[0][k] && high < x[1][k] && high < x[2][k]) return true;
  }
  return false;
}

}  // namespace

bool triangles_cross(const Triangle& a, const std::array<Vector3, 3>& x, const Triangle& b,
                     const std::array<Vector3, 3>& y) {
  int shared = 0;
  std::size_t in_a = 0;
  std::size_t in_b = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a[i] != b[j]) continue;
      ++shared;
      in_a = i;
      in_b = j;
    }
  }
  if (shared >= 2) return false;
  if (shared == 1) {
    return segment_pierces(x[following(in_a)], x[preceding(in_a)], y) ||
           segment_pierces(y[following(in_b)], y[preceding(in_b)], x);
  }
  if (on_one_side(x, y) || on_one_side(y, x)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (segment_pierces(x[k], x[following(k)], y) || segment_pierces(y[k], y[following(k)], x)) {
      return true;
    }
  }
  return false;
}

std::size_t TriangleHash::bucket(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const std::uint64_t key = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
                            static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL ^
                            static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL;
  return static_cast<std::size_t>(key ^ (key >> 32)) & mask_;
}

template <class Visit>
void TriangleHash::visit_cells(const std::array<Vector3, 3>& corners, const Visit& visit) const {
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
  for (int k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
    low[k] = static_cast<std::int64_t>(std::floor(least / cell_));
    high[k] = static_cast<std::int64_t>(std::floor(most / cell_));
  }
  for (std::int64_t z = low[2]; z <= high[2]; ++z) {
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      for (std::int64_t x = low[0]; x <= high[0]; ++x) {
        if (!visit(bucket(x, y, z))) return;
      }
    }
  }
}

void TriangleHash::build(const EditMesh& mesh, double cell) {
  cell_ = cell;
  std::size_t size = 1;
  while (size < 2 * mesh.triangles.size()) size *= 2;
  mask_ = size - 1;
  heads_.assign(size, -1);
  entries_.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) enter(mesh, static_cast<std::int32_t>(t));
}

void TriangleHash::enter(const EditMesh& mesh, std::int32_t t) {
  visit_cells(corners_of(mesh, t), [&](std::size_t at) {
    const std::int32_t head = heads_[at];
    if (head >= 0 && entries_[head].triangle == t) return true;
    heads_[at] = static_cast<std::int32_t>(entries_.size());
    entries_.push_back({t, head});
    return true;
  });
}

bool TriangleHash::meets(const EditMesh& mesh, const Triangle& ids,
                         const std::array<Vector3, 3>& corners,
                         const std::vector<std::int32_t>& but, std::int32_t moved) const {
  bool found = false;
  visit_cells(corners, [&](std::size_t at) {
    for (std::int32_t e = heads_[at]; e >= 0 && !found; e = entries_[e].next) {
      const std::int32_t t = entries_[e].triangle;
      const Triangle& other = mesh.triangles[t];
      if (moved >= 0 && std::find(other.begin(), other.end(), moved) != other.end()) continue;
      if (std::find(but.begin(), but.end(), t) != but.end()) continue;
      const std::array<Vector3, 3> y = corners_of(mesh, t);
      found = !boxes_part(corners, y) && triangles_cross(ids, corners, other, y);
    }
    return !found;
  });
  return found;
}

std::vector<std::int32_t> TriangleHash::meeting(const EditMesh& mesh, std::int32_t t) const {
  std::vector<std::int32_t> result;
  const std::array<Vector3, 3> x = corners_of(mesh, t);
  visit_cells(x, [&](std::size_t at) {
    for (std::int32_t e = heads_[at]; e >= 0; e = entries_[e].next) {
      const std::int32_t u = entries_[e].triangle;
      if (u <= t) continue;
      const std::array<Vector3, 3> y = corners_of(mesh, u);
      if (!boxes_part(x, y) && triangles_cross(mesh.triangles[t], x, mesh.triangles[u], y)) {
        result.push_back(u);
      }
    }
    return true;
  });
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace wscvt
