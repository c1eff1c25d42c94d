// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/triangle_hash.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

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

/// Whether a triangle lies strictly on one side of the plane of another.
bool on_one_side(const std::array<Vector3, 3>& x, const std::array<Vector3, 3>& y) {
  const Vector3 n = doubled_area_normal(x[0], x[1], x[2]);
  const double a = n.dot(y[0] - x[0]);
  const double b = n.dot(y[1] - x[0]);
  const double c = n.dot(y[2] - x[0]);
  return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

/// Whether the triangles about a vertex lie side by side, seen along the sum of their normals; then
/// no two of them intersect. If all face this way, the ring only turns forwards. It goes round once
/// if it crosses a line from behind to before only once.
bool is_embedded(const EditMesh& mesh, std::int32_t v) {
  Vector3 sum = Vector3::Zero();
  mesh.around(v, [&](std::int32_t h) { sum += mesh.normal(face_of(h)); });
  const Vector3 across = sum.unitOrthogonal();
  const Vector3& centre = mesh.points[v];
  bool forwards = true;
  int rounds = 0;
  mesh.around(v, [&](std::int32_t h) {
    forwards = forwards && mesh.normal(face_of(h)).dot(sum) > 0.0;
    if (across.dot(mesh.points[mesh.target(h)] - centre) < 0.0 &&
        across.dot(mesh.points[mesh.apex(h)] - centre) >= 0.0) {
      ++rounds;
    }
  });
  return forwards && rounds == 1;
}

/// Returns the only corner that two triangles share; -1 for none, -2 for more.
std::int32_t only_shared(const Triangle& a, const Triangle& b) {
  std::int32_t shared = -1;
  for (const std::int32_t v : a) {
    if (v != b[0] && v != b[1] && v != b[2]) continue;
    shared = shared == -1 ? v : -2;
  }
  return shared;
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
void TriangleHash::visit_cells(const Box& box, const Visit& visit) const {
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
  for (int k = 0; k < 3; ++k) {
    low[k] = static_cast<std::int64_t>(std::floor(box.min()[k] / cell_));
    high[k] = static_cast<std::int64_t>(std::floor(box.max()[k] / cell_));
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
  boxes_.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) enter(mesh, static_cast<std::int32_t>(t));
}

void TriangleHash::enter(const EditMesh& mesh, std::int32_t t) {
  boxes_[t] = box_of(corners_of(mesh, t));
  visit_cells(boxes_[t], [&](std::size_t at) {
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
  const Box box = box_of(corners);
  visit_cells(box, [&](std::size_t at) {
    for (std::int32_t e = heads_[at]; e >= 0 && !found; e = entries_[e].next) {
      const std::int32_t t = entries_[e].triangle;
      if (part(box, boxes_[t])) continue;
      const Triangle& other = mesh.triangles[t];
      if (moved >= 0 && std::find(other.begin(), other.end(), moved) != other.end()) continue;
      if (std::find(but.begin(), but.end(), t) != but.end()) continue;
      found = triangles_cross(ids, corners, other, corners_of(mesh, t));
    }
    return !found;
  });
  return found;
}

void TriangleHash::find_pairs_of(const EditMesh& mesh, const std::vector<char>& embedded,
                                 std::int32_t t, std::vector<TrianglePair>& found) const {
  const auto first = static_cast<std::ptrdiff_t>(found.size());
  const Triangle& corners = mesh.triangles[t];
  const std::array<Vector3, 3> x = corners_of(mesh, t);
  visit_cells(boxes_[t], [&](std::size_t at) {
    for (std::int32_t e = heads_[at]; e >= 0; e = entries_[e].next) {
      const std::int32_t u = entries_[e].triangle;
      if (u <= t || part(boxes_[t], boxes_[u])) continue;
      const std::int32_t shared = only_shared(corners, mesh.triangles[u]);
      if (shared == -2 || (shared >= 0 && embedded[shared] != 0)) continue;
      if (triangles_cross(corners, x, mesh.triangles[u], corners_of(mesh, u))) {
        found.emplace_back(t, u);
      }
    }
    return true;
  });
  std::sort(found.begin() + first, found.end());
  found.erase(std::unique(found.begin() + first, found.end()), found.end());
}

std::vector<TrianglePair> TriangleHash::pairs(const EditMesh& mesh,
                                              const Execution& execution) const {
  constexpr std::size_t block = 1024;
  std::vector<char> embedded(mesh.points.size());
  execution.parallel_for_each(embedded.size(), block, [&](std::size_t v) {
    embedded[v] = is_embedded(mesh, static_cast<std::int32_t>(v)) ? 1 : 0;
  });
  std::vector<std::vector<TrianglePair>> parts((mesh.triangles.size() + block - 1) / block);
  execution.parallel_for(mesh.triangles.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      find_pairs_of(mesh, embedded, static_cast<std::int32_t>(t), parts[begin / block]);
    }
  });
  std::vector<TrianglePair> all;
  for (const auto& found : parts) all.insert(all.end(), found.begin(), found.end());
  return all;
}

}  // namespace wscvt
