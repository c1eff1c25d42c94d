// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/convex/body_cut.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <unordered_map>
#include <utility>

#include "toolbox/convex/face_cut.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

/// One side of a plane, with numbers of the old points, then of the crossings.
struct CutSolid::Side {
  std::vector<Edge> edges;
  std::vector<Face> faces;
  std::vector<Edge> cap;  ///< edges of the new face in the plane

  /// Adds a face of one loop, or of an outer loop and holes.
  void add_face(const std::vector<Edge>& of_face, const Vector3& normal, bool is_cap) {
    const std::size_t first = edges.size();
    edges.insert(edges.end(), of_face.begin(), of_face.end());
    faces.push_back({normal, first, edges.size(), is_cap});
  }

  /// Adds a plane's faces from their edges.
  void add_caps(const std::vector<Vector3>& points, const std::vector<Edge>& of_caps,
                const Vector3& normal) {
    for (const FaceEdges& face : faces_of(points, of_caps, normal)) add_face(face, normal, true);
  }
};

CutSolid::CutSolid(const IndexedMesh& mesh) : points_(mesh.points) {
  require_closed(mesh.triangles);
  for (const Triangle& t : mesh.triangles) {
    const Vector3 normal =
        doubled_area_normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    const std::size_t first = edges_.size();
    for (std::size_t k = 0; k < 3; ++k) edges_.push_back({t[k], t[(k + 1) % 3]});
    faces_.push_back({normal.normalized(), first, edges_.size(), false});
  }
  volume_ = volume_of(mesh, Execution(1));
}

void CutSolid::append_pieces(const std::vector<Vector3>& points, const Side& side,
                             double least_volume, std::vector<CutSolid>& pieces) {
  boost::disjoint_sets_with_storage<> linked(points.size());
  for (const Face& face : side.faces) {
    const std::int32_t start = side.edges[face.first][0];
    for (std::size_t e = face.first; e < face.last; ++e) {
      // A face with holes connects the parts around it.
      linked.union_set(side.edges[e][0], face.is_cap ? start : side.edges[e][1]);
    }
  }
  std::vector<std::int32_t> piece_of(points.size(), -1);
  std::vector<std::int32_t> number(points.size(), -1);
  std::vector<CutSolid> found;
  for (const Face& face : side.faces) {
    std::int32_t& piece = piece_of[linked.find_set(side.edges[face.first][0])];
    if (piece < 0) {
      piece = static_cast<std::int32_t>(found.size());
      found.push_back(CutSolid());
    }
    CutSolid& solid = found[piece];
    const std::size_t first = solid.edges_.size();
    for (std::size_t e = face.first; e < face.last; ++e) {
      Edge edge = side.edges[e];
      for (std::int32_t& v : edge) {
        if (number[v] < 0) {
          number[v] = static_cast<std::int32_t>(solid.points_.size());
          solid.points_.push_back(points[v]);
        }
        v = number[v];
      }
      solid.edges_.push_back(edge);
    }
    solid.faces_.push_back({face.normal, first, solid.edges_.size(), face.is_cap});
  }
  for (CutSolid& solid : found) {
    const Vector3 origin = solid.points_.front();
    for (const Face& face : solid.faces_) {
      const Edge* edges = solid.edges_.data();
      solid.volume_ +=
          (solid.points_[edges[face.first][0]] - origin)
              .dot(doubled_area(solid.points_, edges + face.first, edges + face.last)) /
          6.0;
    }
    if (solid.volume_ > least_volume) pieces.push_back(std::move(solid));
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const CutSolid& a, const CutSolid& b) { return a.volume_ > b.volume_; });
}

SolidCut CutSolid::cut(const CutPlane& plane, double on_plane) const {
  std::vector<Vector3> points = points_;
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const Vector3& p : points) heights.push_back(plane.normal.dot(p) - plane.offset);
  FaceCutter cutter(points, heights, on_plane);
  Side above;
  Side below;
  FaceParts parts;
  for (const Face& face : faces_) {
    cutter.divide(edges_.data() + face.first, edges_.data() + face.last,
                  face.normal.cross(plane.normal), parts);
    for (std::size_t k = 0; k < parts.down.size(); ++k) {
      above.cap.push_back({parts.up[k], parts.down[k]});
      below.cap.push_back({parts.down[k], parts.up[k]});
    }
    for (auto& [side, edges] : {std::pair(&above, &parts.above), std::pair(&below, &parts.below)}) {
      if (edges->empty()) continue;
      if (face.is_cap && !parts.down.empty()) {
        side->add_caps(points, *edges, face.normal);
      } else {
        side->add_face(*edges, face.normal, face.is_cap);
      }
    }
  }
  SolidCut result;
  if (above.faces.empty() || below.faces.empty()) return result;
  above.add_caps(points, above.cap, -plane.normal);
  below.add_caps(points, below.cap, plane.normal);
  const double least_volume = 1e-12 * volume_;
  append_pieces(points, above, least_volume, result.above);
  append_pieces(points, below, least_volume, result.below);
  return result;
}

std::vector<CutSolid::ReflexEdge> CutSolid::reflex_edges() const {
  std::unordered_map<std::uint64_t, std::size_t> face_of;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (std::size_t e = faces_[f].first; e < faces_[f].last; ++e) {
      face_of[edge_key(edges_[e][0], edges_[e][1])] = f;
    }
  }
  std::vector<ReflexEdge> reflexes;
  for (const Face& face : faces_) {
    for (std::size_t e = face.first; e < face.last; ++e) {
      const auto& [a, b] = edges_[e];
      if (a > b) continue;
      const Vector3& other = faces_[face_of.at(edge_key(b, a))].normal;
      if (face.normal.cross(other).dot(points_[b] - points_[a]) < 0.0) {
        reflexes.push_back({edges_[e], face.normal, other});
      }
    }
  }
  return reflexes;
}

}  // namespace wscvt
