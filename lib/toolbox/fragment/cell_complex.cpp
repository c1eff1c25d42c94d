// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fragment/cell_complex.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

CellComplex::CellComplex(const IndexedMesh& solid, const std::vector<CellSite>& sites,
                         const Execution& execution)
    : points_(solid.points) {
  require_closed(solid.triangles);
  Eigen::AlignedBox3d box;
  for (const Triangle& t : solid.triangles) {
    Face face;
    face.normal = doubled_area_normal(points_[t[0]], points_[t[1]], points_[t[2]]).normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      face.edges.push_back({t[k], t[(k + 1) % 3]});
      box.extend(points_[t[k]]);
    }
    faces_.push_back(std::move(face));
  }
  on_plane_ = 1e-12 * box.sizes().squaredNorm();
  for (std::size_t k = 0; k < sites.size(); ++k) {
    execution.report(static_cast<double>(k) / static_cast<double>(sites.size()),
                     "Cutting into fragments");
    insert(sites[k]);
  }
}

struct CellComplex::Insertion {
  std::int32_t cell;
  CellSite site;
  FaceCutter cutter;
  FaceParts parts;
  std::vector<FaceEdges> walls;  ///< edges of the new cell's walls to each old cell
  std::vector<char> visited;     ///< of the faces
};

void CellComplex::list_face(std::size_t f) {
  cells_[faces_[f].front].faces.push_back(f);
  if (faces_[f].is_wall()) cells_[faces_[f].back].faces.push_back(f);
}

void CellComplex::add_face(Face face) {
  faces_.push_back(std::move(face));
  list_face(faces_.size() - 1);
}

void CellComplex::renew_faces(std::int32_t number) {
  Cell& cell = cells_[number];
  std::vector<std::size_t> kept;
  double farthest = 0.0;
  for (const std::size_t f : cell.faces) {
    const Face& face = faces_[f];
    if (face.edges.empty() || (face.front != number && face.back != number)) continue;
    kept.push_back(f);
    for (const auto& edge : face.edges) {
      farthest = std::max(farthest, (points_[edge[0]] - cell.site.point).squaredNorm());
    }
  }
  cell.faces = std::move(kept);
  cell.radius = std::sqrt(farthest);
}

void CellComplex::insert(const CellSite& site) {
  const auto number = static_cast<std::int32_t>(cells_.size());
  const auto old_points = static_cast<std::int32_t>(points_.size());
  std::vector<std::int32_t> near;
  for (std::int32_t i = 0; i < number; ++i) {
    const Cell& cell = cells_[i];
    const double apart = (site.point - cell.site.point).norm();
    if (!(apart > 0.0)) refuse("Two fragments start at the same point. Give different points.");
    // The margin keeps rounding from passing over a cell that shares a point above the plane.
    const double to_plane = (apart * apart + cell.site.weight - site.weight) / (2.0 * apart);
    if (to_plane <= (1.0 + 1e-6) * cell.radius) near.push_back(i);
  }
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> heights(points_.size());
  for (std::int32_t v = 0; v < old_points; ++v) {
    heights[v] = number == 0 ? infinite : distances_[v] - distance(site, v);
  }
  cells_.push_back({site, {}, 0.0});
  Insertion insertion{number, site, FaceCutter(points_, heights, on_plane_),
                      {},     {},   std::vector<char>(faces_.size(), 0)};
  insertion.walls.resize(static_cast<std::size_t>(number));
  if (number == 0) {
    for (std::size_t f = 0; f < faces_.size(); ++f) cells_[0].faces.push_back(f);
  }
  for (const std::int32_t i : near) {
    const std::vector<std::size_t> faces = cells_[i].faces;
    for (const std::size_t f : faces) cut_face(f, insertion);
  }
  for (const std::int32_t i : near) {
    const FaceEdges& edges = insertion.walls[i];
    if (edges.empty()) continue;
    const Vector3 normal = (site.point - cells_[i].site.point).normalized();
    for (FaceEdges& wall : faces_of(points_, edges, normal)) {
      add_face({std::move(wall), normal, i, number});
    }
  }
  distances_.resize(points_.size());
  for (std::size_t v = 0; v < points_.size(); ++v) {
    const auto point = static_cast<std::int32_t>(v);
    if (point >= old_points || heights[v] > on_plane_) distances_[v] = distance(site, point);
  }
  near.push_back(number);
  for (const std::int32_t i : near) renew_faces(i);
}

void CellComplex::cut_face(std::size_t f, Insertion& insertion) {
  if (f >= insertion.visited.size() || insertion.visited[f] != 0) return;
  insertion.visited[f] = 1;
  Face& face = faces_[f];
  const auto is_above = [&](const FaceEdge& e) { return insertion.cutter.is_above(e[0]); };
  if (std::none_of(face.edges.begin(), face.edges.end(), is_above)) return;
  if (std::all_of(face.edges.begin(), face.edges.end(), is_above)) {
    if (face.is_wall()) {
      face.edges.clear();
    } else {
      face.front = insertion.cell;
      cells_.back().faces.push_back(f);
    }
    return;
  }
  FaceParts& parts = insertion.parts;
  const Vector3 to_site = insertion.site.point - cells_[face.front].site.point;
  insertion.cutter.divide(face.edges.data(), face.edges.data() + face.edges.size(),
                          face.normal.cross(to_site), parts);
  for (std::size_t k = 0; k < parts.down.size(); ++k) {
    insertion.walls[face.front].push_back({parts.down[k], parts.up[k]});
    if (!face.is_wall()) continue;
    insertion.walls[face.back].push_back({parts.up[k], parts.down[k]});
  }
  std::vector<FaceEdges> below = faces_of(points_, parts.below, face.normal);
  face.edges = std::move(below.front());
  // Added faces move those that are there.
  const auto [normal, front, back] = std::tuple(face.normal, face.front, face.back);
  for (std::size_t k = 1; k < below.size(); ++k) {
    add_face({std::move(below[k]), normal, front, back});
  }
  if (back >= 0) return;
  for (FaceEdges& above : faces_of(points_, parts.above, normal)) {
    add_face({std::move(above), normal, insertion.cell, -1});
  }
}

namespace {

/// Returns the sixth part of a face's tetrahedra with the origin, its volume for a closed solid.
double volume_share(const std::vector<Vector3>& points, const FaceEdges& edges,
                    const Vector3& origin) {
  return (points[edges.front()[0]] - origin).dot(doubled_area(points, edges)) / 6.0;
}

/// The connected pieces of all cells.
struct Pieces {
  std::vector<std::array<std::int32_t, 2>> of_face;  ///< in front and behind; -1: none
  std::vector<std::int32_t> cell;
  std::vector<double> volume;
};

/// Adds the pieces of a cell: faces that share a point are connected.
void add_pieces(const CellComplex& complex, const std::vector<std::size_t>& faces,
                std::int32_t cell, std::vector<std::int32_t>& parent, Pieces& pieces) {
  const auto root = [&](std::int32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const std::size_t f : faces) {
    for (const auto& [a, b] : complex.faces()[f].edges) parent[a] = a;
  }
  for (const std::size_t f : faces) {
    const FaceEdges& edges = complex.faces()[f].edges;
    for (const auto& [a, b] : edges) parent[root(a)] = root(edges.front()[0]);
  }
  std::unordered_map<std::int32_t, std::int32_t> piece_of;
  for (const std::size_t f : faces) {
    const CellComplex::Face& face = complex.faces()[f];
    const auto [found, is_new] = piece_of.try_emplace(
        root(face.edges.front()[0]), static_cast<std::int32_t>(pieces.cell.size()));
    if (is_new) {
      pieces.cell.push_back(cell);
      pieces.volume.push_back(0.0);
    }
    const bool is_front = face.front == cell;
    pieces.of_face[f][is_front ? 0 : 1] = found->second;
    const double share = volume_share(complex.points(), face.edges, complex.points().front());
    pieces.volume[found->second] += is_front ? share : -share;
  }
}

/// Returns the areas of the walls between pieces.
std::map<std::array<std::int32_t, 2>, double> wall_areas(const CellComplex& complex,
                                                         const Pieces& pieces) {
  std::map<std::array<std::int32_t, 2>, double> areas;
  for (std::size_t f = 0; f < complex.faces().size(); ++f) {
    const CellComplex::Face& face = complex.faces()[f];
    if (face.edges.empty() || !face.is_wall()) continue;
    const auto& [front, back] = pieces.of_face[f];
    const double area = 0.5 * doubled_area(complex.points(), face.edges).norm();
    areas[{front, back}] += area;
    areas[{back, front}] += area;
  }
  return areas;
}

/// Returns the cell that each piece belongs to: the largest of a cell its own, the others the
/// neighbour's behind their largest wall. A piece without a neighbour stays.
std::vector<std::int32_t> owners_of(const Pieces& pieces, std::size_t cells,
                                    const std::map<std::array<std::int32_t, 2>, double>& areas) {
  std::vector<std::int32_t> largest(cells, -1);
  for (std::size_t p = 0; p < pieces.cell.size(); ++p) {
    std::int32_t& best = largest[pieces.cell[p]];
    if (best < 0 || pieces.volume[p] > pieces.volume[best]) {
      best = static_cast<std::int32_t>(p);
    }
  }
  std::vector<std::int32_t> owner(pieces.cell.size(), -1);
  for (std::size_t c = 0; c < cells; ++c) {
    if (largest[c] >= 0) owner[largest[c]] = static_cast<std::int32_t>(c);
  }
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    std::vector<std::int32_t> next = owner;
    std::vector<double> most(owner.size(), 0.0);
    for (const auto& [pair, area] : areas) {
      const auto piece = static_cast<std::size_t>(pair[0]);
      const std::int32_t neighbour = owner[pair[1]];
      if (owner[piece] >= 0 || neighbour < 0 || !(area > most[piece])) continue;
      most[piece] = area;
      next[piece] = neighbour;
      is_changed = true;
    }
    owner = std::move(next);
  }
  for (std::size_t p = 0; p < owner.size(); ++p) {
    if (owner[p] < 0) owner[p] = pieces.cell[p];
  }
  return owner;
}

}  // namespace

std::vector<double> CellComplex::volumes() const {
  std::vector<double> volumes(cells_.size(), 0.0);
  for (const Face& face : faces_) {
    if (face.edges.empty()) continue;
    const double share = volume_share(points_, face.edges, points_.front());
    volumes[face.front] += share;
    if (face.is_wall()) volumes[face.back] -= share;
  }
  return volumes;
}

CellComplex::Moved CellComplex::join_pieces() {
  Pieces pieces;
  pieces.of_face.assign(faces_.size(), {-1, -1});
  std::vector<std::int32_t> parent(points_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    add_pieces(*this, cells_[c].faces, static_cast<std::int32_t>(c), parent, pieces);
  }
  const std::vector<std::int32_t> owner =
      owners_of(pieces, cells_.size(), wall_areas(*this, pieces));
  Moved moved;
  for (std::size_t p = 0; p < owner.size(); ++p) {
    if (owner[p] == pieces.cell[p]) continue;
    ++moved.pieces;
    moved.volume += pieces.volume[p];
  }
  if (moved.pieces == 0) return moved;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    Face& face = faces_[f];
    if (face.edges.empty()) continue;
    face.front = owner[pieces.of_face[f][0]];
    if (!face.is_wall()) continue;
    face.back = owner[pieces.of_face[f][1]];
    if (face.front == face.back) face.edges.clear();
  }
  for (Cell& cell : cells_) cell.faces.clear();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!faces_[f].edges.empty()) list_face(f);
  }
  return moved;
}

}  // namespace wscvt
