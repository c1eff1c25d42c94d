// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/repair/repair_steps.h"

namespace wscvt {

namespace {

/// Returns the corners of a component's faces at each of the vertices, which are ascending.
std::vector<std::vector<std::int32_t>> corners_at(const std::vector<std::int32_t>& touching,
                                                  const std::vector<Triangle>& triangles,
                                                  const std::vector<std::int32_t>& of_face,
                                                  std::int32_t component) {
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
  return corners;
}

}  // namespace

std::size_t split_touching_vertices(IndexedMesh& mesh, const std::vector<std::int32_t>& rings,
                                    const std::vector<std::int32_t>& of_face,
                                    std::int32_t component, const Execution& execution) {
  const std::size_t vertices = mesh.points.size();
  const std::vector<Triangle>& triangles = mesh.triangles;
  // A vertex has one fan if a walk around it, from edge to edge, visits all its corners.
  // `first_corner` is the start of this walk for every vertex, `valence` the number of corners. The
  // half-edge that starts at a corner identifies the corner.
  std::vector<std::int32_t> first_corner(vertices, -1);
  std::vector<std::int32_t> valence(vertices, 0);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    if (of_face[f] != component) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = index(triangles[f][k]);
      if (valence[v]++ == 0) first_corner[v] = static_cast<std::int32_t>(3 * f + k);
    }
  }
  // Calls visit(corner) for the corners of one fan, for any orientation of its faces.
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
  // One list per block, joined in order, so the result does not depend on the number of threads.
  std::vector<std::vector<std::int32_t>> found((vertices + usual_block - 1) / usual_block);
  execution.parallel_for(vertices, usual_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (valence[v] == 0) continue;
      std::int32_t visited = 0;
      walk_fan(first_corner[v], [&](std::int32_t) { ++visited; });
      if (visited != valence[v]) found[begin / usual_block].push_back(static_cast<std::int32_t>(v));
    }
  });

  std::vector<std::int32_t> touching;
  for (const auto& part : found) touching.insert(touching.end(), part.begin(), part.end());
  if (touching.empty()) return 0;
  std::size_t added = 0;
  const std::vector<std::vector<std::int32_t>> corners =
      corners_at(touching, triangles, of_face, component);
  for (std::size_t i = 0; i < touching.size(); ++i) {
    std::vector<char> visited(corners[i].size(), 0);
    std::vector<std::pair<std::int32_t, std::int32_t>> renamed;  // corner, new vertex
    for (std::size_t j = 0; j < corners[i].size(); ++j) {
      if (visited[j]) continue;
      std::int32_t name = touching[i];
      if (j > 0) {
        name = static_cast<std::int32_t>(mesh.points.size());
        // Copy first, because the vector may move its points when it grows.
        mesh.points.push_back(Vector3(mesh.points[index(touching[i])]));
        ++added;
      }
      walk_fan(corners[i][j], [&](std::int32_t corner) {
        const auto at = std::lower_bound(corners[i].begin(), corners[i].end(), corner);
        visited[static_cast<std::size_t>(at - corners[i].begin())] = 1;
        renamed.emplace_back(corner, name);
      });
    }
    // Only after all fans are walked, because the walk reads the indices.
    for (const auto& [corner, name] : renamed)
      mesh.triangles[face_of(corner)][corner_of(corner)] = name;
  }
  return added;
}

}  // namespace wscvt
