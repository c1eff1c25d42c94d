// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/handles.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/sorting.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/scan_advice.h"

namespace wscvt {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr const char* handle_stage = "Cutting handles";

/// About so many vertices are visited at most to choose places for a search of the whole mesh, and
/// again in these searches, but in at least a few of them.
constexpr std::size_t most_visited = 500'000;
constexpr std::size_t fewest_searched = 8;
/// Steps of fairing, each half way to the mean of the neighbours. After five steps the caps are
/// most of an edge apart; more steps would thin the stumps.
constexpr int fairing_steps = 5;

/// A closed path along half-edges.
struct Loop {
  double length = infinity;
  std::vector<std::int32_t> half_edges;
};

/// The tree of shortest paths from a root, and the cotree of the remaining edges.
class TreeCotree {
 public:
  TreeCotree(const IndexedMesh& mesh, const HalfEdges& links)
      : mesh_(mesh),
        links_(links),
        distances_(mesh.points.size(), infinity),
        parents_(mesh.points.size(), -1) {}

  /// Returns loops through the root's tree that do not separate the surface, of length at most 2
  /// `reach` before the common path is removed. They are independent; without a bound there are two
  /// per handle. Calls `rest` between the steps; each step takes tenths of a second on a scan of a
  /// million vertices.
  template <class Rest>
  std::vector<Loop> loops(std::int32_t root, double reach, const Rest& rest) {
    grow_tree(root, reach);
    rest();
    std::vector<std::pair<double, std::int32_t>> candidates;
    boost::disjoint_sets_with_storage<> joined(mesh_.triangles.size());
    const auto join = [&](std::int32_t a, std::int32_t b) {
      const std::size_t of_a = joined.find_set(index(a));
      const std::size_t of_b = joined.find_set(index(b));
      if (of_a != of_b) joined.link(of_a, of_b);
      return of_a != of_b;
    };
    for (std::int32_t h = 0; h < static_cast<std::int32_t>(links_.opposite.size()); ++h) {
      const std::int32_t other = links_.opposite[h];
      if (other < h) continue;
      const std::int32_t from = origin(h);
      const std::int32_t to = origin(other);
      if (parents_[to] == h || parents_[from] == other) continue;  // in the tree
      if (distances_[from] < infinity && distances_[to] < infinity) {
        candidates.emplace_back(distances_[from] + distances_[to] + edge_length(h), h);
      } else {
        join(h / 3, other / 3);
      }
    }
    rest();
    // Longest first, so faces are joined across edges that would make long loops. If an edge's
    // faces are already joined, the edge closes a loop. The path between the two faces crosses the
    // loop once, so the loop does not separate the surface.
    std::sort(candidates.begin(), candidates.end(), std::greater<>());
    rest();
    std::vector<Loop> result;
    for (const auto& [length, h] : candidates) {
      if (!join(h / 3, links_.opposite[h] / 3)) result.push_back(loop_through(h));
    }
    return result;
  }

  /// Returns a length below which `loops` finds no loop; infinite if it finds none. Looks only at
  /// vertices within reach, as if all faces beyond them were one.
  double least_length(std::int32_t root, double reach) {
    grow_tree(root, reach);
    std::vector<std::pair<double, std::int32_t>> candidates;
    std::vector<std::int32_t> faces = {-1};  // -1: all that are beyond
    for (const std::int32_t v : reached_) {
      visit_outgoing(links_.opposite, links_.first[v], [&](std::int32_t h) {
        const std::int32_t to = target(h);
        if (is_within(h / 3) && corner_of(h / 3) == v) faces.push_back(h / 3);
        if (to < v || !(distances_[to] < infinity)) return;
        if (parents_[to] == h || parents_[v] == links_.opposite[h]) return;
        candidates.emplace_back(distances_[v] + distances_[to] + edge_length(h), h);
      });
    }
    std::sort(faces.begin(), faces.end());
    std::sort(candidates.begin(), candidates.end(), std::greater<>());
    boost::disjoint_sets_with_storage<> joined(faces.size());
    const auto place = [&](std::int32_t face) {
      if (!is_within(face)) return std::size_t{0};
      return index(std::lower_bound(faces.begin(), faces.end(), face) - faces.begin());
    };
    double least = infinity;
    for (const auto& [length, h] : candidates) {
      const std::size_t a = joined.find_set(place(h / 3));
      const std::size_t b = joined.find_set(place(links_.opposite[h] / 3));
      if (a != b) {
        joined.link(a, b);
      } else {
        least = std::min(least, loop_through(h).length);
      }
    }
    return least;
  }

 private:
  std::int32_t origin(std::int32_t h) const { return origin_of(mesh_.triangles, h); }
  std::int32_t target(std::int32_t h) const { return target_of(mesh_.triangles, h); }
  double edge_length(std::int32_t h) const {
    return (mesh_.points[target(h)] - mesh_.points[origin(h)]).norm();
  }

  /// Whether all corners of a face are within reach.
  bool is_within(std::int32_t face) const {
    const Triangle& t = mesh_.triangles[face];
    return std::all_of(t.begin(), t.end(), [&](auto v) { return distances_[v] < infinity; });
  }
  std::int32_t corner_of(std::int32_t face) const {
    const Triangle& t = mesh_.triangles[face];
    return *std::min_element(t.begin(), t.end());
  }

  void grow_tree(std::int32_t root, double reach) {
    for (const std::int32_t v : reached_) {
      distances_[v] = infinity;
      parents_[v] = -1;
    }
    reached_.assign(1, root);
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distances_[root] = 0.0;
    queue.emplace(0.0, root);
    while (!queue.empty()) {
      // Not a structured binding: Clang 14 lets no lambda capture one.
      const double distance = queue.top().first;
      const std::int32_t v = queue.top().second;
      queue.pop();
      if (distance > distances_[v]) continue;
      visit_outgoing(links_.opposite, links_.first[v], [&](std::int32_t h) {
        const std::int32_t w = target(h);
        const double longer = distance + edge_length(h);
        if (longer < distances_[w] && longer <= reach) {
          if (parents_[w] < 0) reached_.push_back(w);
          distances_[w] = longer;
          parents_[w] = h;
          queue.emplace(longer, w);
        }
      });
    }
  }

  /// The loop goes from the tree's last common vertex to the edge, over it and back.
  Loop loop_through(std::int32_t h) const {
    const auto way_to = [&](std::int32_t v) {
      std::vector<std::int32_t> way;
      for (; parents_[v] >= 0; v = origin(parents_[v])) way.push_back(parents_[v]);
      return way;
    };
    std::vector<std::int32_t> there = way_to(origin(h));
    std::vector<std::int32_t> back = way_to(target(h));
    while (!there.empty() && !back.empty() && there.back() == back.back()) {
      there.pop_back();
      back.pop_back();
    }
    Loop loop;
    loop.half_edges.assign(there.rbegin(), there.rend());
    loop.half_edges.push_back(h);
    for (const std::int32_t edge : back) loop.half_edges.push_back(links_.opposite[edge]);
    loop.length = 0.0;
    for (const std::int32_t edge : loop.half_edges) loop.length += edge_length(edge);
    return loop;
  }

  const IndexedMesh& mesh_;
  const HalfEdges& links_;
  std::vector<double> distances_;
  std::vector<std::int32_t> parents_;  ///< half-edge that leads to each vertex, -1 at the root
  std::vector<std::int32_t> reached_;  ///< vertices
};

/// Returns the first of the shortest loops.
const Loop* shortest_of(const std::vector<Loop>& loops) {
  const auto shortest = std::min_element(
      loops.begin(), loops.end(), [](const Loop& a, const Loop& b) { return a.length < b.length; });
  return shortest == loops.end() ? nullptr : &*shortest;
}

/// Returns the shortest loop that does not separate the surface. A loop that crosses none of the
/// independent loops separates, so that the shortest passes one of their vertices.
Loop short_loop(const IndexedMesh& mesh, const HalfEdges& links, const Execution& execution) {
  TreeCotree tree(mesh, links);
  const auto rest = [&] { execution.report(0.0, handle_stage); };
  const std::vector<Loop> found = tree.loops(0, infinity, rest);
  const Loop* const first = shortest_of(found);
  if (first == nullptr) return {};
  std::vector<std::int32_t> all;
  for (const Loop& loop : found) {
    for (const std::int32_t h : loop.half_edges) all.push_back(origin_of(mesh.triangles, h));
  }
  sort_unique(all);
  const std::size_t most = std::max(fewest_searched, most_visited / mesh.points.size());
  Loop best = *first;
  std::vector<std::pair<double, std::int32_t>> bounds;
  // Short loops are sought first, because they need few vertices.
  for (std::size_t part = 32; part > 0 && 2 * part * best.length > first->length; part /= 2) {
    const double length = first->length / static_cast<double>(part);
    // About as many vertices are within half a loop as the square of its edges.
    const std::size_t edges = first->half_edges.size() / part;
    const std::size_t stride = 1 + all.size() * edges * edges / most_visited;
    bounds.resize((all.size() + stride - 1) / stride);
    constexpr std::size_t block = 256;
    execution.parallel_for(bounds.size(), block, [&](std::size_t begin, std::size_t end) {
      TreeCotree near(mesh, links);
      for (std::size_t i = begin; i < end; ++i) {
        const std::int32_t root = all[i * stride];
        bounds[i] = {near.least_length(root, 0.5 * length), root};
      }
    });
    std::sort(bounds.begin(), bounds.end());
    for (std::size_t i = 0; i < std::min(bounds.size(), most); ++i) {
      const auto& [least, root] = bounds[i];
      if (!(least < best.length)) break;
      const std::vector<Loop> loops = tree.loops(root, 0.5 * length, rest);
      const Loop* const shortest = shortest_of(loops);
      if (shortest != nullptr && shortest->length < best.length) best = *shortest;
    }
  }
  return best;
}

/// Cuts along the loop and caps both sides. Returns the vertices of the rings and caps.
std::vector<std::int32_t> cut_and_cap(IndexedMesh& mesh, const HalfEdges& links, const Loop& loop) {
  const std::size_t count = loop.half_edges.size();
  const auto first_copy = static_cast<std::int32_t>(mesh.points.size());
  std::vector<std::int32_t> right;
  std::vector<std::int32_t> left;
  Vector3 middle = Vector3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    right.push_back(origin_of(mesh.triangles, loop.half_edges[i]));
    left.push_back(first_copy + static_cast<std::int32_t>(i));
    mesh.points.emplace_back(mesh.points[right.back()]);
    middle += mesh.points[right.back()] / static_cast<double>(count);
  }
  // The faces to the left of the loop get the copies. Collect all corners (half-edges) before the
  // first change.
  std::vector<std::pair<std::int32_t, std::int32_t>> changes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t coming = loop.half_edges[(i + count - 1) % count];
    std::int32_t h = loop.half_edges[i];
    do {
      changes.emplace_back(h, left[i]);
      h = links.opposite[previous_half_edge(h)];
    } while (h != links.opposite[coming]);
  }
  for (const auto& [h, copy] : changes) mesh.triangles[h / 3][h % 3] = copy;
  std::vector<std::int32_t> moved = right;
  moved.insert(moved.end(), left.begin(), left.end());
  if (count == 3) {
    mesh.triangles.push_back({right[0], right[1], right[2]});
    mesh.triangles.push_back({left[1], left[0], left[2]});
    return moved;
  }
  const auto right_middle = static_cast<std::int32_t>(mesh.points.size());
  const std::int32_t left_middle = right_middle + 1;
  mesh.points.push_back(middle);
  mesh.points.push_back(middle);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    mesh.triangles.push_back({right[i], right[next], right_middle});
    mesh.triangles.push_back({left[next], left[i], left_middle});
  }
  moved.push_back(right_middle);
  moved.push_back(left_middle);
  return moved;
}

/// Moves the vertices towards the means of their neighbours. Vertices of a ring have neighbours
/// only on their own side, so the two sides separate: the stumps of a bridge draw back, the plug of
/// a tunnel becomes thick.
void fair(IndexedMesh& mesh, const HalfEdges& links, const std::vector<std::int32_t>& moved) {
  std::vector<Vector3> places(moved.size());
  for (int step = 0; step < fairing_steps; ++step) {
    for (std::size_t i = 0; i < moved.size(); ++i) {
      Vector3 sum = Vector3::Zero();
      double count = 0.0;
      visit_outgoing(links.opposite, links.first[moved[i]], [&](std::int32_t h) {
        sum += mesh.points[target_of(mesh.triangles, h)];
        count += 1.0;
      });
      places[i] = 0.5 * (mesh.points[moved[i]] + sum / count);
    }
    for (std::size_t i = 0; i < moved.size(); ++i) mesh.points[moved[i]] = places[i];
  }
}

HalfEdges linked(const IndexedMesh& mesh) {
  HalfEdges links = link_half_edges(mesh.triangles, mesh.points.size());
  const bool closed =
      !mesh.triangles.empty() &&
      std::find(links.opposite.begin(), links.opposite.end(), -1) == links.opposite.end() &&
      std::find(links.first.begin(), links.first.end(), -1) == links.first.end();
  if (!closed) {
    refuse("The mesh is not closed, so its handles cannot be counted. Run check_mesh on it first.");
  }
  return links;
}

}  // namespace

std::size_t genus_of(const IndexedMesh& mesh) {
  // V - E + F = 2 - 2 g with E = 3 F / 2.
  return (mesh.triangles.size() + 4 - 2 * mesh.points.size()) / 4;
}

HandleFreeMesh remove_handles(IndexedMesh mesh, const HandleOptions& options,
                              const Execution& execution) {
  require_in_range(options.length_limit, max_handle_loop_option);
  HalfEdges links = linked(mesh);
  HandleFreeMesh result;
  const std::size_t genus = genus_of(mesh);
  if (genus > most_handles_cut) {
    refuse("The scan has " + std::to_string(genus) + " handles, more than the limit of " +
           std::to_string(most_handles_cut) + ": it is porous. Close the pores first (" +
           where_meshlab_closes() + "). " + wrap_advice());
  }
  const double volume = volume_of(mesh, Execution(1));
  const double radius = equivalent_radius(std::abs(volume));
  for (std::size_t left = genus; left > 0; --left) {
    execution.report(static_cast<double>(genus - left) / static_cast<double>(genus), handle_stage);
    const Loop loop = short_loop(mesh, links, execution);
    CutHandle handle;
    handle.length = loop.length;
    handle.edges = static_cast<int>(loop.half_edges.size());
    for (const std::int32_t h : loop.half_edges) {
      handle.place += mesh.points[origin_of(mesh.triangles, h)] / handle.edges;
    }
    if (!(loop.length <= options.length_limit * radius)) {
      // Too long for a scanner flaw. This handle is real, and so are handles with longer loops.
      result.report.kept = static_cast<int>(left);
      result.report.next = handle;
      break;
    }
    const std::vector<std::int32_t> moved = cut_and_cap(mesh, links, loop);
    links = linked(mesh);
    fair(mesh, links, moved);
    result.report.cut.push_back(handle);
  }
  if (!result.report.cut.empty())
    result.report.volume_change = volume_of(mesh, Execution(1)) / volume - 1.0;
  result.mesh = std::move(mesh);
  execution.report(1.0, handle_stage);
  return result;
}

HandleReport cut_handles(CheckedMesh& scan, const HandleOptions& options,
                         const Execution& execution) {
  HandleFreeMesh free = remove_handles(std::move(scan.mesh), options, execution);
  scan.mesh = std::move(free.mesh);
  const int genus = scan.report.genus;
  measure_closed(scan.mesh, execution, scan.report);
  scan.report.genus = genus;
  return std::move(free.report);
}

}  // namespace wscvt
