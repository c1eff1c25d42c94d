// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/repair_steps.h"

namespace wscvt {

namespace {

/// A patch's faces on an edge with more than two faces.
struct Share {
  std::int32_t edge;
  std::array<int, 2> own = {0, 0};  // number of its faces that run forward, backward along the edge
};

/// A part of the surface connected through edges with two faces.
struct Patch {
  double area = 0.0;
  std::size_t faces = 0;
  std::size_t turned_faces = 0;  // turned to agree with the first face
  std::size_t boundary_edges = 0;
  std::vector<Share> shares;  // on the edges with more than two faces
  bool turned = false;        // as a whole
  bool dropped = false;
};

/// A face on an edge with more than two faces.
struct Side {
  std::int32_t half_edge;
  std::int32_t patch;
  bool forward;  // runs from the edge's lower to its higher vertex, if its patch is not turned
};

struct Edge {
  std::vector<Side> sides;
  std::array<int, 2> faces = {0, 0};  // number of remaining faces that run forward, backward
};

/// Returns the imbalance of an edge: the difference of its faces in the two directions. An edge
/// without faces is balanced; an edge with one face is a boundary edge.
int imbalance(int forward, int backward) { return std::abs(forward - backward); }

class Sheets {
 public:
  Sheets(IndexedMesh& mesh, const std::vector<std::int32_t>& rings) : mesh_(mesh), rings_(rings) {}

  ManifoldRepair run() {
    find_patches();
    find_edges();
    ManifoldRepair result;
    result.edges = edges_.size();
    std::vector<std::size_t> order(patches_.size());  // smallest first
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return patches_[a].area < patches_[b].area;
    });
    order.pop_back();  // the largest is the body
    // Every change leaves fewer unbalanced edges, so the loop ends.
    for (bool changed = true; changed;) {
      changed = false;
      for (const std::size_t p : order) {
        Patch& patch = patches_[p];
        if (patch.dropped) continue;
        if (gain_of_turning(patch) > 0) {
          turn(patch);
          changed = true;
        }
        if (gain_of_dropping(patch) > 0) {
          drop(patch);
          result.dropped_area += patch.area;
          result.dropped_faces += patch.faces;
          changed = true;
        }
      }
    }
    result.added_vertices = cut_edges();
    drop_faces();
    return result;
  }

 private:
  bool is_single(std::size_t h) const {  // shares its edge with at most one other
    return index(rings_[index(rings_[h])]) == h;
  }

  void find_patches() {
    const std::vector<Triangle>& triangles = mesh_.triangles;
    patch_of_.assign(triangles.size(), -1);
    turned_.assign(triangles.size(), 0);
    std::vector<std::int32_t> stack;
    for (std::size_t start = 0; start < triangles.size(); ++start) {
      if (patch_of_[start] >= 0) continue;
      Patch patch;
      const auto number = static_cast<std::int32_t>(patches_.size());
      patch_of_[start] = number;
      stack.push_back(static_cast<std::int32_t>(start));
      while (!stack.empty()) {
        const std::size_t f = index(stack.back());
        stack.pop_back();
        ++patch.faces;
        patch.turned_faces += static_cast<std::size_t>(turned_[f]);
        patch.area += triangle_area(mesh_, triangles[f]);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t h = 3 * f + k;
          const std::int32_t other = rings_[h];
          if (index(other) == h) ++patch.boundary_edges;
          if (index(other) == h || !is_single(h)) continue;
          const std::size_t g = face_of(other);
          if (patch_of_[g] >= 0) continue;
          patch_of_[g] = number;
          const bool same_way = triangles[f][k] == triangles[g][corner_of(other)];
          turned_[g] = static_cast<char>(same_way != (turned_[f] != 0));
          stack.push_back(static_cast<std::int32_t>(g));
        }
      }
      patches_.push_back(std::move(patch));
    }
    // Most faces of a patch have the right orientation.
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Patch& patch = patches_[index(patch_of_[f])];
      if (2 * patch.turned_faces > patch.faces) turned_[f] = static_cast<char>(1 - turned_[f]);
    }
  }

  void find_edges() {
    std::vector<char> seen(rings_.size(), 0);
    for (std::size_t h = 0; h < rings_.size(); ++h) {
      if (seen[h] || is_single(h)) continue;
      const auto number = static_cast<std::int32_t>(edges_.size());
      Edge edge;
      for (std::size_t g = h; !seen[g]; g = index(rings_[g])) {
        seen[g] = 1;
        const Triangle& t = mesh_.triangles[g / 3];
        const bool listed_forward = t[g % 3] < t[following(g % 3)];
        const Side side{static_cast<std::int32_t>(g), patch_of_[g / 3],
                        listed_forward != (turned_[g / 3] != 0)};
        std::vector<Share>& shares = patches_[index(side.patch)].shares;
        if (shares.empty() || shares.back().edge != number) shares.push_back({number});
        ++shares.back().own[side.forward ? 0 : 1];
        ++edge.faces[side.forward ? 0 : 1];
        edge.sides.push_back(side);
      }
      edges_.push_back(std::move(edge));
    }
  }

  int gain_of_turning(const Patch& patch) const {
    int gain = 0;
    for (const Share& share : patch.shares) {
      const std::array<int, 2>& all = edges_[index(share.edge)].faces;
      const int change = share.own[1] - share.own[0];
      gain += imbalance(all[0], all[1]) - imbalance(all[0] + change, all[1] - change);
    }
    return gain;
  }

  void turn(Patch& patch) {
    patch.turned = !patch.turned;
    for (Share& share : patch.shares) {
      std::array<int, 2>& all = edges_[index(share.edge)].faces;
      all[0] += share.own[1] - share.own[0];
      all[1] += share.own[0] - share.own[1];
      std::swap(share.own[0], share.own[1]);
    }
  }

  int gain_of_dropping(const Patch& patch) const {
    auto gain = static_cast<int>(patch.boundary_edges);
    for (const Share& share : patch.shares) {
      const std::array<int, 2>& all = edges_[index(share.edge)].faces;
      gain += imbalance(all[0], all[1]) - imbalance(all[0] - share.own[0], all[1] - share.own[1]);
    }
    return gain;
  }

  void drop(Patch& patch) {
    patch.dropped = true;
    for (const Share& share : patch.shares) {
      std::array<int, 2>& all = edges_[index(share.edge)].faces;
      for (std::size_t way = 0; way < 2; ++way) all[way] -= share.own[way];
    }
  }

  /// Returns pairs of indices into `sides`. A single side is paired with itself.
  std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const std::vector<Side>& sides,
                                                            const Vector3& low,
                                                            const Vector3& high) const {
    // Along the edge from its lower to its higher vertex, angles grow as a right-handed screw
    // turns. A forward face faces growing angles, so the body lies before it, and behind a backward
    // face: between a backward face and the next forward face.
    const Vector3 axis = (high - low).normalized();
    const Vector3 x = axis.unitOrthogonal();
    const Vector3 y = axis.cross(x);
    struct Turn {
      double angle;
      std::size_t place;
      bool forward;
    };
    std::vector<Turn> turns;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const std::int32_t h = sides[i].half_edge;
      const Triangle& t = mesh_.triangles[face_of(h)];
      const Vector3 d = mesh_.points[index(t[preceding(corner_of(h))])] - low;
      turns.push_back({portable::atan2(d.dot(y), d.dot(x)), i,
                       sides[i].forward != patches_[index(sides[i].patch)].turned});
    }
    std::stable_sort(turns.begin(), turns.end(),
                     [](const Turn& a, const Turn& b) { return a.angle < b.angle; });
    // Pairs are like brackets on a circle: backward opens, forward closes. Two rounds find the
    // partners of brackets that open before the first angle.
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<std::size_t> open;
    std::vector<char> done(turns.size(), 0);
    for (std::size_t step = 0; step < 2 * turns.size(); ++step) {
      const std::size_t i = step % turns.size();
      if (done[i]) continue;
      if (turns[i].forward) {
        if (open.empty()) continue;
        done[open.back()] = done[i] = 1;
        pairs.emplace_back(turns[open.back()].place, turns[i].place);
        open.pop_back();
      } else if (step < turns.size()) {
        open.push_back(i);
      }
    }
    for (std::size_t i = 0; i < turns.size(); ++i) {
      if (!done[i]) pairs.emplace_back(turns[i].place, turns[i].place);
    }
    return pairs;
  }

  /// Does steps 2 and 3. Returns the number of added vertices.
  std::size_t cut_edges() {
    std::size_t added = 0;
    // New indices of half-edges whose face was cut before. They are on their old side of the edge.
    std::unordered_map<std::int32_t, std::int32_t> moved;
    const auto slot_of = [&](std::int32_t h) {
      for (auto at = moved.find(h); at != moved.end(); at = moved.find(h)) h = at->second;
      return h;
    };
    for (const Edge& edge : edges_) {
      std::vector<Side> sides;
      for (const Side& side : edge.sides) {
        if (!patches_[index(side.patch)].dropped) sides.push_back(side);
      }
      if (sides.size() < 3) continue;
      const Triangle& t = mesh_.triangles[face_of(slot_of(sides[0].half_edge))];
      const std::size_t k = corner_of(slot_of(sides[0].half_edge));
      const std::int32_t low = std::min(t[k], t[following(k)]);
      const std::int32_t high = std::max(t[k], t[following(k)]);
      const auto pairs = pairs_of(sides, mesh_.points[index(low)], mesh_.points[index(high)]);
      for (std::size_t j = 1; j < pairs.size(); ++j) {
        const double share = static_cast<double>(j) / static_cast<double>(pairs.size());
        const auto middle = static_cast<std::int32_t>(mesh_.points.size());
        mesh_.points.push_back(
            Vector3((1.0 - share) * mesh_.points[index(low)] + share * mesh_.points[index(high)]));
        ++added;
        cut_face(slot_of(sides[pairs[j].first].half_edge), middle, moved);
        if (pairs[j].second != pairs[j].first) {
          cut_face(slot_of(sides[pairs[j].second].half_edge), middle, moved);
        }
      }
    }
    return added;
  }

  /// Cuts the face of half-edge h in two at the vertex `middle` on h. The first piece keeps the
  /// face's index. The second piece, at the end, gets the side that follows h.
  void cut_face(std::int32_t h, std::int32_t middle,
                std::unordered_map<std::int32_t, std::int32_t>& moved) {
    const std::size_t f = face_of(h);
    const std::size_t k = corner_of(h);
    Triangle piece = mesh_.triangles[f];
    piece[k] = middle;
    mesh_.triangles[f][following(k)] = middle;
    const auto place = static_cast<std::int32_t>(3 * mesh_.triangles.size());
    moved.emplace(static_cast<std::int32_t>(3 * f + following(k)),
                  place + static_cast<std::int32_t>(following(k)));
    mesh_.triangles.push_back(piece);
    patch_of_.push_back(patch_of_[f]);
    turned_.push_back(turned_[f]);
  }

  void drop_faces() {
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      if (!patches_[index(patch_of_[f])].dropped) mesh_.triangles[kept++] = mesh_.triangles[f];
    }
    mesh_.triangles.resize(kept);
  }

  IndexedMesh& mesh_;
  const std::vector<std::int32_t>& rings_;
  std::vector<Patch> patches_;
  std::vector<Edge> edges_;             // edges with more than two faces
  std::vector<std::int32_t> patch_of_;  // of every face
  std::vector<char> turned_;            // for every face: turned within its patch
};

}  // namespace

ManifoldRepair separate_sheets(IndexedMesh& mesh, const std::vector<std::int32_t>& rings) {
  return Sheets(mesh, rings).run();
}

}  // namespace wscvt
