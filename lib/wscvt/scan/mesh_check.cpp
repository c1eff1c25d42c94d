// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/scan/mesh_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/sphere/solid_angle.h"

namespace wscvt {

namespace {

constexpr std::size_t block_size = 16384;

/// Below this volume / area^1.5 (0.094 for a sphere, a third of the thickness for a plate) the
/// surface is a sheet within rounding.
constexpr double flat_limit = 1e-9;

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::InvalidInput, sentence);
}

/// "1 face", "2 faces".
std::string count_of(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Half-edge 3 f + k runs from corner k of face f to corner k + 1.
std::size_t face_of(std::int32_t halfedge) { return index(halfedge) / 3; }
std::size_t corner_of(std::int32_t halfedge) { return index(halfedge) % 3; }
std::size_t following(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }
std::size_t preceding(std::size_t corner) { return corner == 0 ? 2 : corner - 1; }

/// First index in [0, count) for which `wrong` holds, or count.
template <class Predicate>
std::size_t first_wrong(std::size_t count, const Execution& execution, const Predicate& wrong) {
  std::vector<std::size_t> first((count + block_size - 1) / block_size, count);
  execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (wrong(i)) {
        first[begin / block_size] = i;
        break;
      }
    }
  });
  return first.empty() ? count : *std::min_element(first.begin(), first.end());
}

void refuse_unusable(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::size_t faces = mesh.triangles.size();
  if (vertices == 0) refuse("The mesh is empty: it has no vertices; load the scan of a grain.");
  if (faces == 0) {
    refuse("The mesh has " + std::to_string(vertices) + (vertices == 1 ? " vertex" : " vertices") +
           " but no faces, so it encloses no volume; reconstruct a closed surface from the points "
           "first, e.g. by Screened Poisson reconstruction.");
  }
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 3;
  if (faces > limit || vertices > limit) {
    refuse("The mesh has " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
           " faces, more than the " + std::to_string(limit) +
           " that can be numbered; reduce the scan first.");
  }
  const std::size_t bad_point =
      first_wrong(vertices, execution, [&](std::size_t i) { return !mesh.points[i].allFinite(); });
  if (bad_point < vertices) {
    const Vector3& p = mesh.points[bad_point];
    const auto coordinate = [](double value) {
      return std::isnan(value) ? "nan" : format_number(value);
    };
    refuse("Vertex " + std::to_string(bad_point) + " is at (" + coordinate(p.x()) + ", " +
           coordinate(p.y()) + ", " + coordinate(p.z()) +
           "), which is not a finite position; remove such vertices and close the holes first.");
  }
  const std::size_t bad_face = first_wrong(faces, execution, [&](std::size_t f) {
    const Triangle& t = mesh.triangles[f];
    return std::any_of(t.begin(), t.end(), [&](std::int32_t v) {
      return v < 0 || static_cast<std::size_t>(v) >= vertices;
    });
  });
  if (bad_face < faces) {
    const Triangle& t = mesh.triangles[bad_face];
    refuse("Face " + std::to_string(bad_face) + " names the vertices " + std::to_string(t[0]) +
           ", " + std::to_string(t[1]) + " and " + std::to_string(t[2]) + ", but the mesh has " +
           std::to_string(vertices) + "; the file or the program that made it is at fault.");
  }
}

std::uint64_t hash_of(const Vector3& point) {
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) {
    const double coordinate = point[k] + 0.0;  // -0 equals 0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  }
  return hash * 0xD6E8FEB86659FD93U;
}

/// For every vertex the first one at the same position; empty when all positions differ.
std::vector<std::int32_t> first_equal_vertices(const std::vector<Vector3>& points,
                                               const Execution& execution, std::size_t& welded) {
  const std::size_t count = points.size();
  unsigned bits = 2;
  while ((std::size_t{1} << bits) < 2 * count) ++bits;
  std::vector<std::uint32_t> slots(count);
  execution.parallel_for(count, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      slots[i] = static_cast<std::uint32_t>(hash_of(points[i]) >> (64U - bits));
    }
  });
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  std::vector<std::int32_t> table(mask + 1, -1);
  std::vector<std::int32_t> first;
  welded = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t slot = slots[i];
    while (table[slot] >= 0 && points[index(table[slot])] != points[i]) slot = (slot + 1) & mask;
    if (table[slot] < 0) {
      table[slot] = static_cast<std::int32_t>(i);
      if (!first.empty()) first[i] = static_cast<std::int32_t>(i);
      continue;
    }
    if (first.empty()) {
      first.resize(count);
      for (std::size_t j = 0; j < i; ++j) first[j] = static_cast<std::int32_t>(j);
    }
    first[i] = table[slot];
    ++welded;
  }
  return first;
}

/// Welds equal points in the faces (the points stay where they are), counts the vertices without a
/// face and drops the faces with two equal corners.
void weld(IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report) {
  const std::vector<std::int32_t> first =
      first_equal_vertices(mesh.points, execution, report.welded_vertices);
  std::vector<char> used(mesh.points.size(), 0);
  std::size_t kept = 0;
  for (const Triangle& original : mesh.triangles) {
    Triangle t = original;
    for (std::int32_t& v : t) {
      if (!first.empty()) v = first[index(v)];
      used[index(v)] = 1;
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    mesh.triangles[kept++] = t;
  }
  report.degenerate_faces = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  const auto used_count = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  report.unreferenced_vertices = mesh.points.size() - report.welded_vertices - used_count;
}

/// For every half-edge the next one on the same edge, in a ring: itself on a boundary edge, the
/// opposite one on a manifold edge, the next higher (after the last, the first) where more meet.
std::vector<std::int32_t> edge_rings(const IndexedMesh& mesh, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::vector<Triangle>& triangles = mesh.triangles;
  // Half-edges sorted by their lower vertex (counting sort), then by the higher one.
  std::vector<std::int32_t> starts(vertices + 2, 0);
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++starts[index(std::min(t[k], t[following(k)])) + 2];
  }
  for (std::size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<std::int32_t> halfedges(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& place = starts[index(std::min(t[k], t[following(k)])) + 1];
      halfedges[index(place++)] = static_cast<std::int32_t>(3 * f + k);
    }
  }
  std::vector<std::int32_t> rings(halfedges.size());
  execution.parallel_for(vertices, block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<std::pair<std::int32_t, std::int32_t>> bucket;  // higher vertex, half-edge
    for (std::size_t v = begin; v < end; ++v) {
      bucket.clear();
      for (std::int32_t i = starts[v]; i < starts[v + 1]; ++i) {
        const std::int32_t h = halfedges[index(i)];
        const Triangle& t = triangles[face_of(h)];
        bucket.emplace_back(std::max(t[corner_of(h)], t[following(corner_of(h))]), h);
      }
      std::sort(bucket.begin(), bucket.end());
      for (std::size_t first = 0; first < bucket.size();) {
        std::size_t last = first;
        while (last + 1 < bucket.size() && bucket[last + 1].first == bucket[first].first) {
          rings[index(bucket[last].second)] = bucket[last + 1].second;
          ++last;
        }
        rings[index(bucket[last].second)] = bucket[first].second;
        first = last + 1;
      }
    }
  });
  return rings;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Drops faces on the same three vertices, looking only at faces on edges where more than two meet.
/// Returns how many.
std::size_t drop_duplicates(IndexedMesh& mesh, const std::vector<std::int32_t>& rings) {
  struct Candidate {
    Triangle key;
    std::int32_t face;
    bool operator<(const Candidate& other) const {
      return key != other.key ? key < other.key : face < other.face;
    }
  };
  std::vector<Candidate> candidates;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t h = 3 * f; h < 3 * f + 3; ++h) {
      if (index(rings[index(rings[h])]) == h) continue;
      Triangle key = mesh.triangles[f];
      std::sort(key.begin(), key.end());
      candidates.push_back({key, static_cast<std::int32_t>(f)});
      break;
    }
  }
  if (candidates.empty()) return 0;
  std::sort(candidates.begin(), candidates.end());

  // Number of different faces on each edge.
  std::vector<Edge> edges;
  const auto edges_of = [](const Triangle& key) {
    return std::array<Edge, 3>{Edge{key[0], key[1]}, Edge{key[1], key[2]}, Edge{key[0], key[2]}};
  };
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0 && candidates[i].key == candidates[i - 1].key) continue;
    for (const Edge& edge : edges_of(candidates[i].key)) edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end());
  const auto needs_face = [&](const Edge& edge) {
    const auto range = std::equal_range(edges.begin(), edges.end(), edge);
    return (range.second - range.first) % 2 == 0;  // an odd number beside this face
  };
  std::vector<char> dropped(mesh.triangles.size(), 0);
  std::size_t count = 0;
  for (std::size_t first = 0; first < candidates.size();) {
    std::size_t last = first + 1;
    while (last < candidates.size() && candidates[last].key == candidates[first].key) ++last;
    if (last - first > 1) {
      const std::array<Edge, 3> sides = edges_of(candidates[first].key);
      const bool keep = std::any_of(sides.begin(), sides.end(), needs_face);
      for (std::size_t i = first + (keep ? 1 : 0); i < last; ++i) {
        dropped[index(candidates[i].face)] = 1;
        ++count;
      }
    }
    first = last;
  }
  if (count == 0) return 0;
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (!dropped[f]) mesh.triangles[kept++] = mesh.triangles[f];
  }
  mesh.triangles.resize(kept);
  return count;
}

struct Component {
  std::size_t faces = 0;
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;
  bool orientable = true;
  double volume = 0.0;  // signed; of the cone over one of its points where it is open
};

struct Components {
  std::vector<Component> list;
  std::vector<std::int32_t> of_face;
  std::vector<char> turned;  // faces to turn round so that their component is consistent
};

/// Parts connected through edges, with a consistent orientation each.
Components find_components(const IndexedMesh& mesh, const std::vector<std::int32_t>& rings) {
  const std::vector<Triangle>& triangles = mesh.triangles;
  Components result;
  result.of_face.assign(triangles.size(), -1);
  result.turned.assign(triangles.size(), 0);
  std::vector<std::int32_t> stack;
  for (std::size_t start = 0; start < triangles.size(); ++start) {
    if (result.of_face[start] >= 0) continue;
    Component component;
    const auto number = static_cast<std::int32_t>(result.list.size());
    result.of_face[start] = number;
    stack.push_back(static_cast<std::int32_t>(start));
    while (!stack.empty()) {
      const std::size_t f = index(stack.back());
      stack.pop_back();
      ++component.faces;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto h = static_cast<std::int32_t>(3 * f + k);
        const std::int32_t other = rings[index(h)];
        if (other == h) {
          ++component.boundary_edges;
          continue;
        }
        const std::size_t g = face_of(other);
        const bool manifold = rings[index(other)] == h;
        const bool same_way = triangles[f][k] == triangles[g][corner_of(other)];
        const bool turn = same_way != (result.turned[f] != 0);
        if (result.of_face[g] < 0) {
          result.of_face[g] = number;
          result.turned[g] = static_cast<char>(turn);
          stack.push_back(static_cast<std::int32_t>(g));
        } else if (manifold && turn != (result.turned[g] != 0)) {
          component.orientable = false;
        }
        if (!manifold && other < h) ++component.non_manifold_edges;  // the ring's last
      }
    }
    result.list.push_back(component);
  }

  // About a point of its own, so that a grain far from the origin keeps its digits.
  std::vector<std::int32_t> origin(result.list.size(), -1);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    const std::size_t c = index(result.of_face[f]);
    if (origin[c] < 0) origin[c] = t[0];
    const Vector3& o = mesh.points[index(origin[c])];
    const Vector3 p = mesh.points[index(t[0])] - o;
    const Vector3 q = mesh.points[index(t[1])] - o;
    const Vector3 r = mesh.points[index(t[2])] - o;
    const double six_volumes = p.dot(q.cross(r));
    result.list[c].volume += (result.turned[f] ? -six_volumes : six_volumes) / 6.0;
  }
  return result;
}

void refuse_unclosed(const Component& main, std::size_t components) {
  const std::string subject = components > 1 ? "The largest part of the mesh" : "The mesh";
  if (main.non_manifold_edges > 0) {
    refuse(subject + " has " + count_of(main.non_manifold_edges, "non-manifold edge") +
           ", shared by more than two faces, so inside and outside cannot be told apart; repair it "
           "first, e.g. Filters > Cleaning and Repairing > Repair non Manifold Edges by removing "
           "faces, then Filters > Remeshing, Simplification and Reconstruction > Close Holes.");
  }
  if (main.boundary_edges > 0) {
    refuse(subject + " has " + count_of(main.boundary_edges, "boundary edge") +
           ", so it encloses no volume; close it first, e.g. Filters > Remeshing, Simplification "
           "and Reconstruction > Close Holes.");
  }
  if (!main.orientable) {
    refuse(subject +
           " is not orientable: its faces cannot all be turned to face outward; reconstruct the "
           "surface first, e.g. by Screened Poisson reconstruction.");
  }
}

/// The component that stays: the one of largest absolute volume.
std::size_t choose_main(const Components& components, const MeshCheckOptions& options,
                        MeshCheckReport& report) {
  const std::vector<Component>& list = components.list;
  std::size_t main = 0;
  double total = 0.0;
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (std::abs(list[c].volume) > std::abs(list[main].volume)) main = c;
    total += std::abs(list[c].volume);
  }
  report.components = list.size();
  refuse_unclosed(list[main], list.size());
  if (total > 0.0) report.dropped_volume_share = 1.0 - std::abs(list[main].volume) / total;
  if (list.size() == 1) report.dropped_volume_share = 0.0;
  if (report.dropped_volume_share > options.dropped_volume_limit) {
    refuse("The mesh falls into " + std::to_string(list.size()) +
           " separate parts and the largest holds only " +
           format_percent(1.0 - report.dropped_volume_share) +
           " of their volume, so there is no main body; keep one part, e.g. Filters > Cleaning and "
           "Repairing > Remove Isolated pieces (wrt Face Num.), or split the mesh into its "
           "connected components, and remesh each on its own.");
  }
  return main;
}

/// Where more than one fan of faces of `component` meets in a vertex, gives every fan after the
/// first a copy of it.
void split_vertices(IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                    const std::vector<std::int32_t>& of_face, std::int32_t component,
                    const Execution& execution, MeshCheckReport& report) {
  const std::size_t vertices = mesh.points.size();
  const std::vector<Triangle>& triangles = mesh.triangles;
  // A corner of a face is named by the half-edge that starts there.
  std::vector<std::int32_t> first_corner(vertices, -1);
  std::vector<std::int32_t> valence(vertices, 0);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (of_face[f] != component) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = index(triangles[f][k]);
      if (valence[v]++ == 0) first_corner[v] = static_cast<std::int32_t>(3 * f + k);
    }
  }
  // Calls visit(corner) for the corners of one fan, whatever way round its faces are listed.
  const auto walk_fan = [&](std::int32_t start, const auto& visit) {
    const std::int32_t v = triangles[face_of(start)][corner_of(start)];
    std::int32_t exit = start;  // the half-edge through which the walk leaves the face
    std::int32_t corner = start;
    do {
      visit(corner);
      const std::int32_t entry = rings[index(exit)];
      const std::size_t f = face_of(entry);
      const std::size_t k = corner_of(entry);
      const bool starts_here = triangles[f][k] == v;
      const std::size_t here = starts_here ? k : following(k);
      corner = static_cast<std::int32_t>(3 * f + here);
      exit = static_cast<std::int32_t>(3 * f + (starts_here ? preceding(here) : here));
    } while (corner != start);
  };
  std::vector<std::vector<std::int32_t>> found((vertices + block_size - 1) / block_size);
  execution.parallel_for(vertices, block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (valence[v] == 0) continue;
      std::int32_t visited = 0;
      walk_fan(first_corner[v], [&](std::int32_t) { ++visited; });
      if (visited != valence[v]) found[begin / block_size].push_back(static_cast<std::int32_t>(v));
    }
  });

  std::vector<std::int32_t> touching;
  for (const auto& part : found) touching.insert(touching.end(), part.begin(), part.end());
  if (touching.empty()) return;
  std::vector<std::vector<std::int32_t>> corners(touching.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (of_face[f] != component) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::lower_bound(touching.begin(), touching.end(), triangles[f][k]);
      if (at == touching.end() || *at != triangles[f][k]) continue;
      corners[index(static_cast<std::int32_t>(at - touching.begin()))].push_back(
          static_cast<std::int32_t>(3 * f + k));
    }
  }
  for (std::size_t i = 0; i < touching.size(); ++i) {
    std::vector<char> visited(corners[i].size(), 0);
    std::vector<std::pair<std::int32_t, std::int32_t>> renamed;  // corner, new vertex
    for (std::size_t j = 0; j < corners[i].size(); ++j) {
      if (visited[j]) continue;
      std::int32_t name = touching[i];
      if (j > 0) {
        name = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.push_back(Vector3(mesh.points[index(touching[i])]));
        ++report.split_vertices;
      }
      walk_fan(corners[i][j], [&](std::int32_t corner) {
        const auto at = std::lower_bound(corners[i].begin(), corners[i].end(), corner);
        visited[static_cast<std::size_t>(at - corners[i].begin())] = 1;
        renamed.emplace_back(corner, name);
      });
    }
    for (const auto& [corner, name] : renamed)
      mesh.triangles[face_of(corner)][corner_of(corner)] = name;
  }
}

/// Keeps the faces of one component, turned outward, and the vertices they use.
void keep_component(IndexedMesh& mesh, const Components& components, std::size_t main,
                    MeshCheckReport& report) {
  const bool inside_out = components.list[main].volume < 0.0;
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    if (index(components.of_face[f]) != main) continue;
    Triangle t = mesh.triangles[f];
    if ((components.turned[f] != 0) != inside_out) {
      std::swap(t[1], t[2]);
      ++report.reoriented_faces;
    }
    for (const std::int32_t v : t) number[index(v)] = 0;
    mesh.triangles[kept++] = t;
  }
  report.dropped_faces = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  std::size_t vertices = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<std::int32_t>(vertices);
    mesh.points[vertices++] = mesh.points[v];
  }
  if (vertices == mesh.points.size()) return;
  mesh.points.resize(vertices);
  for (Triangle& t : mesh.triangles) {
    for (std::int32_t& v : t) v = number[index(v)];
  }
}

void measure(const IndexedMesh& mesh, const Execution& execution, MeshCheckReport& report) {
  using Sums = Eigen::Matrix<double, 6, 1>;  // 6 V, 2 A, 24 V (centroid - origin), slivers
  const Vector3 origin = mesh.points[index(mesh.triangles[0][0])];
  const Sums sums = execution.parallel_sum(mesh.triangles.size(), block_size, Sums(Sums::Zero()),
                                           [&](std::size_t begin, std::size_t end) {
                                             Sums part = Sums::Zero();
                                             for (std::size_t f = begin; f < end; ++f) {
                                               const Triangle& t = mesh.triangles[f];
                                               const Vector3 p = mesh.points[index(t[0])] - origin;
                                               const Vector3 q = mesh.points[index(t[1])] - origin;
                                               const Vector3 r = mesh.points[index(t[2])] - origin;
                                               const double volume = p.dot(q.cross(r));
                                               const double area = (q - p).cross(r - p).norm();
                                               part[0] += volume;
                                               part[1] += area;
                                               part.segment<3>(2) += volume * (p + q + r);
                                               if (area == 0.0) part[5] += 1.0;
                                             }
                                             return part;
                                           });
  report.volume = sums[0] / 6.0;
  report.area = sums[1] / 2.0;
  if (!(report.volume > flat_limit * std::pow(report.area, 1.5))) {
    refuse("The mesh encloses no volume: it is flat, with an area of " +
           format_number(report.area) + " and a volume of " + format_number(report.volume) +
           "; load the closed surface of a grain.");
  }
  report.centroid = origin + sums.segment<3>(2) / (4.0 * sums[0]);
  report.sliver_faces = static_cast<std::size_t>(sums[5]);
  report.vertices = mesh.points.size();
  report.faces = mesh.triangles.size();
  const auto euler =
      static_cast<std::int64_t>(report.vertices) - static_cast<std::int64_t>(report.faces / 2);
  report.genus = static_cast<int>((2 - euler) / 2);
  report.equivalent_radius = std::cbrt(3.0 * report.volume / (4.0 * 3.14159265358979323846));
}

}  // namespace

CheckedMesh check_mesh(IndexedMesh mesh, const MeshCheckOptions& options,
                       const Execution& execution) {
  if (!(options.dropped_volume_limit > 0.0 && options.dropped_volume_limit < 1.0)) {
    refuse("The largest share of volume to drop is " + format_number(options.dropped_volume_limit) +
           "; give a number between 0 and 1.");
  }
  const std::string stage = "Checking the mesh";
  CheckedMesh result;
  MeshCheckReport& report = result.report;
  report.input_vertices = mesh.points.size();
  report.input_faces = mesh.triangles.size();
  execution.report(0.0, stage);
  refuse_unusable(mesh, execution);
  weld(mesh, execution, report);
  if (mesh.triangles.empty()) {
    refuse("All " + std::to_string(report.input_faces) +
           " faces of the mesh have two corners in one place, so it encloses no volume; load the "
           "closed surface of a grain.");
  }
  execution.report(0.25, stage);
  std::vector<std::int32_t> rings = edge_rings(mesh, execution);
  report.duplicate_faces = drop_duplicates(mesh, rings);
  if (mesh.triangles.empty()) {
    refuse(
        "The faces of the mesh lie on each other in pairs, so it encloses no volume; load the "
        "closed surface of a grain.");
  }
  if (report.duplicate_faces > 0) rings = edge_rings(mesh, execution);
  execution.report(0.5, stage);
  const Components components = find_components(mesh, rings);
  const std::size_t main = choose_main(components, options, report);
  execution.report(0.75, stage);
  split_vertices(mesh, rings, components.of_face, static_cast<std::int32_t>(main), execution,
                 report);
  keep_component(mesh, components, main, report);
  measure(mesh, execution, report);
  result.mesh = std::move(mesh);
  execution.report(1.0, stage);
  return result;
}

double folded_solid_angle(const IndexedMesh& mesh, const Vector3& centre,
                          const Execution& execution) {
  std::vector<Vector3> directions(mesh.points.size());
  execution.parallel_for(directions.size(), block_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      directions[i] = (mesh.points[i] - centre).normalized();
  });
  return execution
      .parallel_sum(mesh.triangles.size(), block_size, SolidAngleSums(),
                    [&](std::size_t begin, std::size_t end) {
                      SolidAngleSums part;
                      for (std::size_t f = begin; f < end; ++f) {
                        const Triangle& t = mesh.triangles[f];
                        part.add(solid_angle(directions[index(t[0])], directions[index(t[1])],
                                             directions[index(t[2])]));
                      }
                      return part;
                    })
      .folded_share();
}

}  // namespace wscvt
