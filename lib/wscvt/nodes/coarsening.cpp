// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/coarsening.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "wscvt/surface/edit_mesh.h"
#include "wscvt/surface/star_shape.h"

namespace wscvt {

namespace {

/// Merges below this many squares of the mean cell are cheap; a sweep of them halves the vertices.
constexpr double cheap_merge = 0.8;
/// Limit for a sweep near its end, in squares of the wanted cells.
constexpr double last_merge = 0.15;
/// Above this degree, a merge costs `degree_price` more per square of the excess degree.
constexpr int high_degree = 7;
constexpr double degree_price = 0.05;
/// Largest degree after a merge.
constexpr int most_degree = 12;
/// How much area facing against the surface a merge may add, in cells.
constexpr double turned_allowance = 1e-3;
/// Faces with an edge whose square is above this fraction of a cell keep their angles.
constexpr double large_face = 0.1;
/// Square of the sine of 2 degrees: the smallest angle of a large face.
constexpr double least_squared_sine = 0.0012;
/// The heap is rebuilt, after flips, each time this fraction of the vertices is left.
constexpr double heap_share = 0.85;
/// How much more than its mass a cluster over a rim counts for the place of a merged one, so that
/// it stays on the rim. Without it, rims of thin plates become saws of teeth one edge long (rms of
/// 19 thin bodies .59 instead of .38 % in the mean). A tenth or ten times of it change 1 %.
constexpr double rim_hold = 1000.0;

}  // namespace

Coarsening::Coarsening(EditMesh scan, const std::vector<double>& density)
    : mesh_(std::move(scan)), alive_(static_cast<int>(mesh_.points.size())) {
  const std::size_t count = mesh_.points.size();
  areas_.assign(count, 0.0);
  vectors_.assign(count, Vector3::Zero());
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Vector3 third = mesh_.normal(t) / 6.0;
    const double length = third.norm();
    area_ += 3.0 * length;
    for (const std::int32_t v : mesh_.triangles[t]) {
      areas_[v] += length;
      vectors_[v] += third;
    }
  }
  if (!density.empty()) masses_ = areas_;
  for (std::size_t v = 0; v < density.size(); ++v) masses_[v] *= density[v] * density[v];
}

Vector3 Coarsening::merged(std::int32_t v, std::int32_t w) const {
  const auto hold = [&](std::int32_t i) {
    return mass(i) * (1.0 + rim_hold * rim_share(vectors_[i].norm() / (areas_[i] + 1e-300)));
  };
  const double of_v = hold(v);
  const double of_w = hold(w);
  return (of_v * mesh_.points[v] + of_w * mesh_.points[w]) / (of_v + of_w + 1e-300);
}

double Coarsening::cost(std::int32_t v, std::int32_t w) const {
  const double of_v = mass(v);
  const double of_w = mass(w);
  const double ward =
      of_v * of_w / (of_v + of_w + 1e-300) * (mesh_.points[v] - mesh_.points[w]).squaredNorm();
  const int above = mesh_.degrees[v] + mesh_.degrees[w] - 4 - high_degree;
  return above > 0 ? ward * (1.0 + degree_price * above * above) : ward;
}

bool Coarsening::common_neighbours_allow(std::int32_t v, std::int32_t w) {
  // One of the two is rarely a hub, so its list is short.
  if (mesh_.degrees[v] > mesh_.degrees[w]) std::swap(v, w);
  ring_.clear();
  mesh_.around(v, [&](std::int32_t h) { ring_.push_back(mesh_.target(h)); });
  int common = 0;
  bool three = false;
  mesh_.around(w, [&](std::int32_t h) {
    const std::int32_t y = mesh_.target(h);
    if (std::find(ring_.begin(), ring_.end(), y) == ring_.end()) return;
    ++common;
    three = three || mesh_.degrees[y] <= 3;
  });
  return common == 2 && !three;
}

struct Coarsening::FanShape {
  double turned = 0.0;  ///< area that faces against its vectors
  double least_squared_sine = 1.0;

  /// Adds a face with corners p, a, b, the others relative to p.
  void add(const Vector3& a, const Vector3& b, const Vector3& vectors, double large) {
    const Vector3 normal = a.cross(b);
    const double squared_normal = normal.squaredNorm();
    const double along = normal.dot(vectors);
    const double squared_vectors = vectors.squaredNorm();
    constexpr double least = least_agreement * least_agreement;
    if (along < 0.0 || along * along < least * squared_normal * squared_vectors) {
      turned += least_agreement * std::sqrt(squared_normal);
      if (squared_vectors > 0.0) turned -= along / std::sqrt(squared_vectors);
    }
    const double l0 = a.squaredNorm();
    const double l1 = b.squaredNorm();
    const double l2 = (a - b).squaredNorm();
    if (std::max({l0, l1, l2}) > large) {
      least_squared_sine =
          std::min(least_squared_sine, squared_normal * std::min({l0, l1, l2}) / (l0 * l1 * l2));
    }
  }
};

/// Returns the shape of the faces about two neighbours, as they are or if they were merged.
Coarsening::FanShape Coarsening::shape_of(std::int32_t v, std::int32_t w, bool are_merged,
                                          double large) const {
  const Vector3 point = merged(v, w);
  const Vector3 vector = vectors_[v] + vectors_[w];
  FanShape shape;
  for (const auto& [i, j] : {std::pair(v, w), std::pair(w, v)}) {
    const Vector3& centre = are_merged ? point : mesh_.points[i];
    const Vector3& about = are_merged ? vector : vectors_[i];
    mesh_.around(i, [&, i = i, j = j](std::int32_t h) {
      const std::int32_t a = mesh_.target(h);
      const std::int32_t b = mesh_.apex(h);
      // The two faces between them disappear, or are already added about the first.
      if ((are_merged || i == w) && (a == j || b == j)) return;
      shape.add(mesh_.points[a] - centre, mesh_.points[b] - centre,
                vectors_[a] + vectors_[b] + about, large);
    });
  }
  return shape;
}

bool Coarsening::possible(std::int32_t v, std::int32_t w) {
  // The degrees add, less the two ends and the two common neighbours' double edges.
  if (alive_ <= 4) return false;
  if (!ignores_shapes_ && mesh_.degrees[v] + mesh_.degrees[w] - 4 > most_degree) return false;
  if (!common_neighbours_allow(v, w)) return false;
  if (ignores_shapes_) return true;
  const double mass = this->mass(v) + this->mass(w);
  const double area = areas_[v] + areas_[w];
  const double density = mass > 0.0 && area > 0.0 ? std::sqrt(mass / area) : 1.0;
  const double cell = area_ / alive_ / density;
  const FanShape after = shape_of(v, w, true, large_face * cell);
  if (after.turned <= turned_allowance * cell && after.least_squared_sine >= least_squared_sine) {
    return true;
  }
  const FanShape before = shape_of(v, w, false, large_face * cell);
  return after.turned <= before.turned + turned_allowance * cell &&
         after.least_squared_sine >=
             std::min(before.least_squared_sine, least_squared_sine) - 1e-12;
}

void Coarsening::merge(std::int32_t v, std::int32_t w) {
  mesh_.points[w] = merged(v, w);
  areas_[w] += areas_[v];
  if (!masses_.empty()) masses_[w] += masses_[v];
  vectors_[w] += vectors_[v];
  std::int32_t edge = mesh_.first[v];
  while (mesh_.target(edge) != w) edge = mesh_.opposite[previous_half_edge(edge)];
  for (const std::int32_t t : mesh_.collapse(edge)) mesh_.triangles[t][0] = -1;
  mesh_.first[v] = -1 - w;
  --alive_;
}

Coarsening::Merge Coarsening::cheapest_after(std::int32_t v, double cost, std::int32_t last) const {
  Merge best = {1e300, v, -1, 0};
  mesh_.around(v, [&](std::int32_t h) {
    const std::int32_t w = mesh_.target(h);
    const double price = this->cost(v, w);
    if (price < cost || (price == cost && w <= last)) return;
    if (price > best.cost || (price == best.cost && w >= best.w)) return;
    best = {price, v, w, 0};
  });
  return best;
}

int Coarsening::sweep(int least) {
  const int before = alive_;
  const double cell = area_ / alive_;
  const double wanted = area_ / std::max(least, 1);
  const double limit = std::min(cheap_merge * cell * cell, last_merge * wanted * wanted);
  const auto count = static_cast<std::int32_t>(mesh_.points.size());
  for (std::int32_t v = 0; v < count && alive_ > least; ++v) {
    if (is_merged(v)) continue;
    Merge next = cheapest_after(v, -1.0, -1);
    while (next.cost < limit && !possible(v, next.w)) next = cheapest_after(v, next.cost, next.w);
    if (next.cost < limit) merge(v, next.w);
  }
  compact();
  flip_to_delaunay(mesh_, vectors_);
  return before - alive_;
}

/// Merges in the order of their costs. Outdated merges are skipped.
class Coarsening::Queue {
 public:
  explicit Queue(Coarsening& owner) : owner_(owner), times_(owner.mesh_.points.size(), 0) {
    for (std::size_t v = 0; v < times_.size(); ++v) push(static_cast<std::int32_t>(v));
  }

  /// Enters the cheapest merge at a vertex, and replaces its earlier one. Whether it is possible is
  /// only asked when its turn comes, because most are replaced before.
  void push(std::int32_t v) {
    ++times_[v];
    push_after(v, -1.0, -1);
  }

  void push_after(std::int32_t v, double cost, std::int32_t last) {
    Merge next = owner_.cheapest_after(v, cost, last);
    next.time = times_[v];
    if (next.w >= 0) queue_.push(next);
  }

  /// Makes the cheapest merge; returns false if there is none.
  bool merge_one() {
    while (!queue_.empty()) {
      const Merge next = queue_.top();
      queue_.pop();
      if (owner_.is_merged(next.v) || next.time != times_[next.v]) continue;
      if (owner_.is_merged(next.w)) {
        push(next.v);
        continue;
      }
      if (!owner_.possible(next.v, next.w)) {
        push_after(next.v, next.cost, next.w);
        continue;
      }
      owner_.merge(next.v, next.w);
      push(next.w);
      owner_.mesh_.around(next.w, [&](std::int32_t h) { push(owner_.mesh_.target(h)); });
      return true;
    }
    return false;
  }

 private:
  struct Later {
    bool operator()(const Merge& a, const Merge& b) const {
      return a.cost > b.cost || (a.cost == b.cost && a.v > b.v);
    }
  };
  Coarsening& owner_;
  std::vector<std::int32_t> times_;
  std::priority_queue<Merge, std::vector<Merge>, Later> queue_;
};

bool Coarsening::reduce(int count, const Execution& execution) {
  const int start = alive_;
  for (int before = -1; alive_ > count && alive_ != before;) {
    execution.report(static_cast<double>(start - alive_) / (start - count), "Coarsening the scan");
    before = alive_;
    const int stop = std::max(count, static_cast<int>(alive_ * heap_share));
    Queue queue(*this);
    while (alive_ > stop && queue.merge_one()) {
    }
    compact();
    flip_to_delaunay(mesh_, vectors_);
  }
  return alive_ <= count;
}

/// Moves the triangles that are not free together. Links are renumbered, which is faster than to
/// find them again. Half-edges of a later triangle wait as -1 - the number of their opposite.
void Coarsening::renumber_faces() {
  std::vector<std::int32_t>& opposite = mesh_.opposite;
  std::int32_t kept = 0;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const Triangle corners = mesh_.triangles[t];
    if (corners[0] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto old = static_cast<std::int32_t>(3 * t + k);
      const std::int32_t now = 3 * kept + static_cast<std::int32_t>(k);
      const std::int32_t other = opposite[old];
      if (other < 0) {
        opposite[-1 - other] = now;
        opposite[now] = -1 - other;
      } else {
        opposite[other] = -1 - now;
      }
      // Triangles to come have larger numbers, so this one is not met again.
      if (mesh_.first[corners[k]] == old) mesh_.first[corners[k]] = now;
    }
    mesh_.triangles[kept++] = corners;
  }
  opposite.resize(3 * static_cast<std::size_t>(kept));
  mesh_.triangles.resize(kept);
}

void Coarsening::compact() {
  renumber_faces();
  // The half-edges of the old vertices give way to the numbers of the new ones.
  std::vector<std::int32_t> map = std::exchange(mesh_.first, {});
  mesh_.first.reserve(alive_);
  for (std::size_t v = 0; v < map.size(); ++v) {
    if (map[v] < 0) continue;
    const std::size_t next = mesh_.first.size();
    mesh_.points[next] = mesh_.points[v];
    mesh_.degrees[next] = mesh_.degrees[v];
    areas_[next] = areas_[v];
    if (!masses_.empty()) masses_[next] = masses_[v];
    vectors_[next] = vectors_[v];
    mesh_.first.push_back(map[v]);
    map[v] = static_cast<std::int32_t>(next);
  }
  for (std::int32_t& number : map) {
    while (number < 0) number = map[-1 - number];
  }
  const std::size_t count = mesh_.first.size();
  mesh_.points.resize(count);
  mesh_.degrees.resize(count);
  areas_.resize(count);
  if (!masses_.empty()) masses_.resize(count);
  vectors_.resize(count);
  for (Triangle& t : mesh_.triangles) {
    for (std::int32_t& v : t) v = map[v];
  }
  if (clusters_.empty()) {
    clusters_ = std::move(map);
  } else {
    for (std::int32_t& cluster : clusters_) cluster = map[cluster];
  }
}

std::vector<std::int32_t> Coarsening::forget() {
  // One array after another, because each is there twice for a moment.
  mesh_.degrees.shrink_to_fit();
  mesh_.first.shrink_to_fit();
  areas_.shrink_to_fit();
  masses_.shrink_to_fit();
  mesh_.opposite.shrink_to_fit();
  mesh_.triangles.shrink_to_fit();
  mesh_.points.shrink_to_fit();
  vectors_.shrink_to_fit();
  return std::exchange(clusters_, {});
}

}  // namespace wscvt
