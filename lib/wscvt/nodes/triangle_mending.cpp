// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/nodes/triangle_mending.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/mesh.h"
#include "wscvt/base/pi.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/nodes/self_intersections.h"

namespace wscvt {

namespace {

/// Cosines and dot products that differ by less count as equal, so that rounding makes no changes.
constexpr double least_gain = 1e-6;

/// Angles below 8 degrees, and turns above 130.
const double sliver_cosine = std::cos(8.0 * pi / 180.0);
const double folded_cosine = std::cos(130.0 * pi / 180.0);
/// Of triangles with angles below 3 degrees: moves no longer open them, so that a node is not taken
/// out at that price.
const double flat_cosine = std::cos(3.0 * pi / 180.0);

/// Rings about a small angle in which nodes may move and edges flip.
constexpr int active_rings = 2;

/// Of the steps towards the middle of its triangles that a spared node is moved by, the shortest
/// that mends its angles, or widens the smallest by so much of a cosine, since one that is too
/// short would be followed by many; the whole way is gone for any gain.
constexpr double spared_shares[] = {0.0625, 0.125, 0.25, 0.5, 1.0};
constexpr double least_spared_gain = 1e-3;

/// A node whose triangles turn by more than 30 degrees stands on a ridge of the scan, which the
/// middle of its triangles lies below.
const double ridge_cosine = std::cos(30.0 * pi / 180.0);

/// Of a node of a closed mesh; the angles decide whether so few are wanted.
constexpr unsigned fewest_neighbours = 3;

/// The worst of some triangles: of their angles the smallest, of their edges the one that turns
/// most, as cosines.
struct Worst {
  double angle = -1.0;  ///< largest cosine
  double turn = 1.0;    ///< smallest cosine
  int small = 0;        ///< triangles with an angle below the limit
};

/// A handle without the mesh that OpenMesh's smart ones bring along.
OpenMesh::VertexHandle plain(const OpenMesh::VertexHandle& vertex) {
  return OpenMesh::VertexHandle(vertex.idx());
}
OpenMesh::HalfedgeHandle plain(const OpenMesh::HalfedgeHandle& half_edge) {
  return OpenMesh::HalfedgeHandle(half_edge.idx());
}
OpenMesh::FaceHandle plain(const OpenMesh::FaceHandle& face) {
  return OpenMesh::FaceHandle(face.idx());
}

class Mender {
 public:
  Mender(const IndexedMesh& nodes, const std::vector<MeshPlace>& places,
         const MappedSurface& surface, const TriangleMendingOptions& options,
         const Execution& execution)
      : surface_(surface),
        execution_(execution),
        mesh_(to_mesh(nodes)),
        points_(nodes.points),
        places_(places),
        origin_(nodes.points.size()),
        angle_limit_(std::cos(options.smallest_angle * pi / 180.0)),
        turn_limit_(std::cos(options.largest_turn * pi / 180.0)),
        moves_(options.sparing ? Moves::Spared : Moves::All) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_face_status();
    mesh_.request_halfedge_status();
    for (std::size_t i = 0; i < origin_.size(); ++i) origin_[i] = static_cast<std::int32_t>(i);
  }

  /// Once, before any of the following.
  void build_boxes() {
    report_progress();
    boxes_.clear();
    for (const auto face : mesh_.faces()) boxes_.push_back({box_of(corners_of(face)), face.idx()});
    tree_ = Tree(boxes_);
  }

  /// Of all triangles; their edges are not looked at.
  Worst worst() const {
    Worst worst;
    for (const auto face : mesh_.faces()) count_angle(face, worst);
    return worst;
  }

  /// From here on other moves than sparing ones are tried as well; false where they are already.
  bool try_more_moves() {
    if (moves_ != Moves::Spared) return false;
    moves_ = Moves::OffRidges;
    return true;
  }

  /// Flips and moves about the small angles; returns how many.
  int improve(TriangleMendingReport& report) {
    report_progress();
    mark_active();
    const int before = report.flips + report.moves;
    for (const auto edge : mesh_.edges()) report.flips += try_flip(edge) ? 1 : 0;
    report_progress();
    for (const auto vertex : mesh_.vertices()) {
      if (active_[vertex.idx()] != 0) report.moves += try_move(vertex) ? 1 : 0;
    }
    return report.flips + report.moves - before;
  }

  /// Takes a node out of every triangle with a small angle where that helps, and puts it into the
  /// edge that is longest beside its neighbours; returns how many.
  int relocate(TriangleMendingReport& report) {
    int count = 0;
    const auto faces = static_cast<int>(mesh_.n_faces());
    for (int f = 0; f < faces; ++f) {
      const OpenMesh::FaceHandle face(f);
      if (mesh_.status(face).deleted() || !(angle_of(face) > angle_limit_)) continue;
      OpenMesh::HalfedgeHandle shortest;
      double length = std::numeric_limits<double>::infinity();
      for (const auto h : mesh_.fh_range(face)) {
        if (const double l = length_of(h); l < length) {
          length = l;
          shortest = h;
        }
      }
      const OpenMesh::HalfedgeHandle back = mesh_.opposite_halfedge_handle(shortest);
      for (const OpenMesh::HalfedgeHandle h : {shortest, back}) {
        const std::int32_t removed = mesh_.from_vertex_handle(h).idx();
        if (!try_collapse(h)) continue;
        insert(origin_[removed]);
        ++count;
        break;
      }
    }
    if (count > 0) compact();
    report.relocations += count;
    return count;
  }

  /// Pairs of triangles that meet, the lower number first, ascending.
  std::vector<TrianglePair> meeting_pairs() const {
    constexpr int faces_a_report = 16384;  // some hundredths of a second
    std::vector<TrianglePair> pairs;
    for (const auto face : mesh_.faces()) {
      if (face.idx() % faces_a_report == 0) report_progress();
      const Triangle corners = corners_of(face);
      const auto look_at = [&](const BoxedFace& other) {
        if (other.second <= face.idx()) return;
        if (triangles_meet(points_, corners, corners_of(OpenMesh::FaceHandle(other.second)))) {
          pairs.emplace_back(face.idx(), other.second);
        }
      };
      tree_.query(boost::geometry::index::intersects(box_of(corners_of(face))),
                  boost::make_function_output_iterator(look_at));
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// Takes a node out of every pair of triangles that meet, where fewer do so without it, whatever
  /// becomes of the angles, and puts it in elsewhere as relocate does; returns how many.
  int separate(TriangleMendingReport& report) {
    int count = 0;
    for (const auto& [first, second] : meeting_pairs()) {
      OpenMesh::HalfedgeHandle best;
      int most = 0;
      double smallest_cosine = 1.0;
      for (const int f : {first, second}) {
        const OpenMesh::FaceHandle face(f);
        if (mesh_.status(face).deleted()) continue;
        for (const auto side : mesh_.fh_range(face)) {
          const OpenMesh::HalfedgeHandle back = plain(mesh_.opposite_halfedge_handle(side));
          for (const OpenMesh::HalfedgeHandle h : {plain(side), back}) {
            if (!may_collapse(h)) continue;
            const auto [then, now] = meetings_before_and_after(h);
            const double angle = worst_without(h).angle;
            if (now >= then || angle > flat_cosine) continue;
            // The most pairs parted, and of those the widest angles.
            if (std::pair(now - then, angle) >= std::pair(-most, smallest_cosine)) continue;
            best = h;
            most = then - now;
            smallest_cosine = angle;
          }
        }
      }
      if (!best.is_valid()) continue;
      const std::int32_t removed = mesh_.from_vertex_handle(best).idx();
      collapse(best);
      insert(origin_[removed]);
      ++count;
    }
    if (count > 0) compact();
    report.relocations += count;
    return count;
  }

  MendedTriangles result() const {
    MendedTriangles made;
    auto& [mesh, places, relocated, report] = made;
    mesh.points.resize(points_.size());
    places.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const std::int32_t node = number_of(static_cast<std::int32_t>(i));
      mesh.points[node] = points_[i];
      places[node] = places_[i];
      if (origin_[i] < 0) relocated.push_back(node);
    }
    std::sort(relocated.begin(), relocated.end());
    for (const auto face : mesh_.faces()) {
      Triangle t;
      std::size_t k = 0;
      for (const auto v : mesh_.fv_range(face)) t[k++] = number_of(v.idx());
      mesh.triangles.push_back(t);
    }
    return made;
  }

 private:
  void report_progress() const { execution_.report(0.0, "Mending triangles"); }

  /// Of which nodes in the rings about a small angle.
  enum class Moves {
    All,
    Spared,     ///< those at small angles, by short steps
    OffRidges,  ///< all, but for those on ridges whose own angles are large enough
  };

  using Faces = std::vector<OpenMesh::FaceHandle>;
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Corner>;
  using BoxedFace = std::pair<Box, int>;
  using Tree = boost::geometry::index::rtree<BoxedFace, boost::geometry::index::rstar<16>>;

  /// The node that a vertex stands for: its own, or, of one that was put in, that of the one taken
  /// out for it.
  std::int32_t number_of(std::int32_t vertex) const {
    return origin_[vertex] >= 0 ? origin_[vertex] : -1 - origin_[vertex];
  }

  double length_of(OpenMesh::HalfedgeHandle h) const {
    return (points_[mesh_.from_vertex_handle(h).idx()] - points_[mesh_.to_vertex_handle(h).idx()])
        .norm();
  }

  Triangle corners_of(OpenMesh::FaceHandle face) const {
    const OpenMesh::HalfedgeHandle h = mesh_.halfedge_handle(face);
    const OpenMesh::HalfedgeHandle next = mesh_.next_halfedge_handle(h);
    return {mesh_.from_vertex_handle(h).idx(), mesh_.from_vertex_handle(next).idx(),
            mesh_.to_vertex_handle(next).idx()};
  }

  double angle_of(OpenMesh::FaceHandle face) const {
    const Triangle t = corners_of(face);
    return largest_corner_cosine(points_[t[0]], points_[t[1]], points_[t[2]]);
  }

  Vector3 normal_of(OpenMesh::FaceHandle face) const {
    const Triangle t = corners_of(face);
    return doubled_area_normal(points_[t[0]], points_[t[1]], points_[t[2]]).normalized();
  }

  void count_angle(OpenMesh::FaceHandle face, Worst& worst) const {
    const double angle = angle_of(face);
    worst.angle = std::max(worst.angle, angle);
    worst.small += angle > angle_limit_ ? 1 : 0;
  }

  /// Of the triangles around a vertex, their edges and the edges around them.
  Worst worst_around(OpenMesh::VertexHandle vertex) const {
    Worst worst;
    for (const auto h : mesh_.voh_range(vertex)) {
      const OpenMesh::FaceHandle face = plain(mesh_.face_handle(h));
      count_angle(face, worst);
      const Vector3 normal = normal_of(face);
      for (const OpenMesh::HalfedgeHandle edge : {plain(h), plain(mesh_.next_halfedge_handle(h))}) {
        worst.turn =
            std::min(worst.turn, normal.dot(normal_of(plain(mesh_.opposite_face_handle(edge)))));
      }
    }
    return worst;
  }

  /// Of the two triangles at an edge, it and the four edges around them.
  Worst worst_at(OpenMesh::HalfedgeHandle h) const {
    Worst worst;
    for (const OpenMesh::HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
      const OpenMesh::FaceHandle face = mesh_.face_handle(side);
      worst.angle = std::max(worst.angle, angle_of(face));
      const Vector3 normal = normal_of(face);
      for (const auto edge : mesh_.fh_range(face)) {
        worst.turn =
            std::min(worst.turn, normal.dot(normal_of(plain(mesh_.opposite_face_handle(edge)))));
      }
    }
    return worst;
  }

  /// The normal of a sliver says nothing about the surface, so the way out of one is free up to
  /// where triangles would lie back on each other.
  bool turns_less(const Worst& after, const Worst& before) const {
    const bool sliver = before.angle > sliver_cosine;
    return after.turn >= std::min(sliver ? folded_cosine : turn_limit_, before.turn - least_gain);
  }

  Box box_of(const Triangle& t) const {
    const Vector3 low = points_[t[0]].cwiseMin(points_[t[1]]).cwiseMin(points_[t[2]]);
    const Vector3 high = points_[t[0]].cwiseMax(points_[t[1]]).cwiseMax(points_[t[2]]);
    return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
  }

  /// After faces changed, vanished or came.
  void update_boxes(const Faces& faces) {
    for (const OpenMesh::FaceHandle face : faces) {
      const auto f = static_cast<std::size_t>(face.idx());
      if (f < boxes_.size()) {
        tree_.remove(boxes_[f]);
      } else {
        boxes_.resize(f + 1);
      }
      if (mesh_.status(face).deleted()) continue;
      boxes_[f] = {box_of(corners_of(face)), face.idx()};
      tree_.insert(boxes_[f]);
    }
  }

  /// Pairs of triangles that meet, one of them or both among some faces, whose boxes need not be up
  /// to date.
  int meetings(const Faces& faces) const {
    std::vector<Triangle> triangles;
    for (const OpenMesh::FaceHandle face : faces) triangles.push_back(corners_of(face));
    return meetings(triangles, faces);
  }

  /// Pairs of triangles that meet, one of them or both among some that stand for `replaced` faces.
  int meetings(const std::vector<Triangle>& triangles, const Faces& replaced) const {
    int count = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto look_at = [&](const BoxedFace& other) {
        const OpenMesh::FaceHandle face(other.second);
        if (std::find(replaced.begin(), replaced.end(), face) != replaced.end()) return;
        count += triangles_meet(points_, triangles[k], corners_of(face)) ? 1 : 0;
      };
      tree_.query(boost::geometry::index::intersects(box_of(triangles[k])),
                  boost::make_function_output_iterator(look_at));
      for (std::size_t j = 0; j < k; ++j) {
        count += triangles_meet(points_, triangles[k], triangles[j]) ? 1 : 0;
      }
    }
    return count;
  }

  Faces faces_around(OpenMesh::VertexHandle vertex) const {
    Faces faces;
    for (const auto face : mesh_.vf_range(vertex)) faces.push_back(face);
    return faces;
  }

  void mark_active() {
    active_.assign(points_.size(), 0);
    for (const auto face : mesh_.faces()) {
      if (!(angle_of(face) > angle_limit_)) continue;
      for (const std::int32_t v : corners_of(face)) active_[v] = 1;
    }
    for (int ring = 1; ring <= active_rings; ++ring) {
      std::vector<char> grown = active_;
      for (const auto h : mesh_.halfedges()) {
        if (active_[h.from().idx()] != 0) grown[h.to().idx()] = 1;
      }
      active_ = std::move(grown);
    }
  }

  bool try_flip(OpenMesh::EdgeHandle edge) {
    const OpenMesh::HalfedgeHandle h = mesh_.halfedge_handle(edge, 0);
    if (active_[mesh_.from_vertex_handle(h).idx()] == 0 ||
        active_[mesh_.to_vertex_handle(h).idx()] == 0 || !mesh_.is_flip_ok(edge)) {
      return false;
    }
    if (mesh_.valence(mesh_.from_vertex_handle(h)) <= fewest_neighbours ||
        mesh_.valence(mesh_.to_vertex_handle(h)) <= fewest_neighbours) {
      return false;
    }
    const Worst before = worst_at(h);
    const Faces both = {mesh_.face_handle(h), mesh_.face_handle(mesh_.opposite_halfedge_handle(h))};
    mesh_.flip(edge);
    const Worst after = worst_at(h);
    if (after.angle < before.angle - least_gain && turns_less(after, before)) {
      const int meeting = meetings(both);
      if (meeting == 0) {
        update_boxes(both);
        return true;
      }
      mesh_.flip(edge);
      if (meeting > meetings(both)) return false;
      mesh_.flip(edge);
      update_boxes(both);
      return true;
    }
    mesh_.flip(edge);
    return false;
  }

  /// Middle of the triangles around a vertex, by area.
  Vector3 ring_centroid(OpenMesh::VertexHandle vertex) const {
    Vector3 sum = Vector3::Zero();
    double area = 0.0;
    for (const auto face : mesh_.vf_range(vertex)) {
      const Triangle t = corners_of(face);
      const double part = triangle_area(points_[t[0]], points_[t[1]], points_[t[2]]);
      sum += part / 3.0 * (points_[t[0]] + points_[t[1]] + points_[t[2]]);
      area += part;
    }
    return area > 0.0 ? Vector3(sum / area) : points_[vertex.idx()];
  }

  bool try_move(OpenMesh::VertexHandle vertex) {
    const std::int32_t v = vertex.idx();
    const Vector3 start = points_[v];
    const Worst before = worst_around(vertex);
    const bool has_small = before.angle > angle_limit_;
    if (moves_ == Moves::Spared) return has_small && try_short_move(vertex, before);
    if (moves_ == Moves::OffRidges && !has_small && before.turn < ridge_cosine) return false;
    const Vector3 target = ring_centroid(vertex);
    for (const double share : {1.0, 0.5, 0.25}) {
      const MeshPlace place = surface_.nearest(start + share * (target - start), places_[v]);
      points_[v] = surface_.position(place);
      const Worst after = worst_around(vertex);
      const bool better =
          has_small ? after.angle < before.angle - least_gain : after.angle < angle_limit_;
      // Steps of a thousandth of the way would go on for ever.
      const bool moves = (points_[v] - start).norm() > 1e-3 * shortest_about(vertex);
      if (better && moves && turns_less(after, before) && !meets_more(vertex, start)) {
        places_[v] = place;
        update_boxes(faces_around(vertex));
        return true;
      }
    }
    points_[v] = start;
    return false;
  }

  /// Moves a spared node, whose triangles are `before`, as far from the surface as it was.
  bool try_short_move(OpenMesh::VertexHandle vertex, const Worst& before) {
    const std::int32_t v = vertex.idx();
    const Vector3 start = points_[v];
    const Vector3 foot = surface_.position(places_[v]);
    const Vector3 way = ring_centroid(vertex) - start;
    for (const double share : spared_shares) {
      const MeshPlace place = surface_.nearest(foot + share * way, places_[v]);
      points_[v] = surface_.position(place) + (start - foot);
      const Worst after = worst_around(vertex);
      const double least = share < 1.0 ? least_spared_gain : least_gain;
      const bool better = after.angle <= angle_limit_ || after.angle < before.angle - least;
      if (better && turns_less(after, before) && !meets_more(vertex, start)) {
        places_[v] = place;
        update_boxes(faces_around(vertex));
        return true;
      }
    }
    points_[v] = start;
    return false;
  }

  /// Whether the triangles around a vertex meet more others than they did with it at `before`.
  bool meets_more(OpenMesh::VertexHandle vertex, const Vector3& before) {
    const Faces faces = faces_around(vertex);
    const int now = meetings(faces);
    if (now == 0) return false;
    const Vector3 here = points_[vertex.idx()];
    points_[vertex.idx()] = before;
    const int then = meetings(faces);
    points_[vertex.idx()] = here;
    return now > then;
  }

  double shortest_about(OpenMesh::VertexHandle vertex) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto h : mesh_.voh_range(vertex)) shortest = std::min(shortest, length_of(h));
    return shortest;
  }

  /// Whether the mesh stays closed, with valences that triangles of some angle can have.
  bool may_collapse(OpenMesh::HalfedgeHandle h) {
    const OpenMesh::VertexHandle from = mesh_.from_vertex_handle(h);
    const OpenMesh::VertexHandle to = mesh_.to_vertex_handle(h);
    if (!mesh_.is_collapse_ok(h) ||
        mesh_.valence(from) + mesh_.valence(to) < fewest_neighbours + 4) {
      return false;
    }
    for (const OpenMesh::HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
      if (mesh_.valence(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(side))) <=
          fewest_neighbours) {
        return false;
      }
    }
    return true;
  }

  /// Whether the vertex that the half-edge starts at goes into the one it ends at, which stays.
  bool try_collapse(OpenMesh::HalfedgeHandle h) {
    if (!may_collapse(h)) return false;
    const OpenMesh::VertexHandle from = mesh_.from_vertex_handle(h);
    const OpenMesh::VertexHandle to = mesh_.to_vertex_handle(h);
    const Worst at_from = worst_around(from);
    Worst before = worst_around(to);
    before.angle = std::max(before.angle, at_from.angle);
    before.turn = std::min(before.turn, at_from.turn);
    before.small += at_from.small;
    // Those at the edge were counted at both its ends.
    Worst twice;
    for (const OpenMesh::HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
      count_angle(mesh_.face_handle(side), twice);
    }
    before.small -= twice.small;
    const Worst after = worst_without(h);
    // In a crowd one small angle is as bad as the next; there the fewer of them the better.
    const bool better = after.angle < before.angle - least_gain ||
                        (after.angle <= before.angle && after.small < before.small);
    if (!better || !turns_less(after, before)) return false;
    const auto [then, now] = meetings_before_and_after(h);
    if (now > then) return false;
    collapse(h);
    return true;
  }

  void collapse(OpenMesh::HalfedgeHandle h) {
    const Faces faces = faces_around(mesh_.from_vertex_handle(h));
    mesh_.collapse(h);
    update_boxes(faces);
  }

  /// Meetings of the triangles around the vertex that the half-edge starts at, as they are and as
  /// they would be if it went into the one it ends at.
  std::pair<int, int> meetings_before_and_after(OpenMesh::HalfedgeHandle h) {
    const OpenMesh::VertexHandle from = mesh_.from_vertex_handle(h);
    const OpenMesh::VertexHandle to = mesh_.to_vertex_handle(h);
    const Faces faces = faces_around(from);
    std::vector<Triangle> left;
    for (const OpenMesh::FaceHandle face : faces) {
      if (goes(face, from, to)) continue;
      left.push_back(corners_of(face));
      std::replace(left.back().begin(), left.back().end(), from.idx(), to.idx());
    }
    return {meetings(faces), meetings(left, faces)};
  }

  /// What worst_around `to` would be after the collapse.
  Worst worst_without(OpenMesh::HalfedgeHandle h) {
    const OpenMesh::VertexHandle from = mesh_.from_vertex_handle(h);
    const OpenMesh::VertexHandle to = mesh_.to_vertex_handle(h);
    const Vector3 place = points_[from.idx()];
    points_[from.idx()] = points_[to.idx()];
    Worst worst;
    const auto look_at = [&](OpenMesh::VertexHandle vertex) {
      for (const auto out : mesh_.voh_range(vertex)) {
        const OpenMesh::FaceHandle face = plain(mesh_.face_handle(out));
        if (goes(face, from, to)) continue;
        count_angle(face, worst);
        const Vector3 normal = normal_of(face);
        for (const auto edge : mesh_.fh_range(face)) {
          OpenMesh::FaceHandle other = plain(mesh_.opposite_face_handle(edge));
          // Across a triangle that vanishes lies the one beyond it.
          if (goes(other, from, to)) {
            const OpenMesh::HalfedgeHandle inner = plain(mesh_.opposite_halfedge_handle(edge));
            const OpenMesh::HalfedgeHandle next = mesh_.next_halfedge_handle(inner);
            const OpenMesh::HalfedgeHandle last = mesh_.next_halfedge_handle(next);
            const auto joins = [&](OpenMesh::HalfedgeHandle e) {
              const auto a = mesh_.from_vertex_handle(e);
              const auto b = mesh_.to_vertex_handle(e);
              return (a == from && b == to) || (a == to && b == from);
            };
            other = plain(mesh_.opposite_face_handle(joins(next) ? last : next));
            if (goes(other, from, to)) continue;
          }
          worst.turn = std::min(worst.turn, normal.dot(normal_of(other)));
        }
      }
    };
    look_at(from);
    look_at(to);
    points_[from.idx()] = place;
    return worst;
  }

  bool goes(OpenMesh::FaceHandle face, OpenMesh::VertexHandle a, OpenMesh::VertexHandle b) const {
    const Triangle t = corners_of(face);
    return std::count(t.begin(), t.end(), a.idx()) + std::count(t.begin(), t.end(), b.idx()) == 2;
  }

  /// Puts the node that was taken out into the middle of the edge that is longest beside the other
  /// edges of its two triangles.
  void insert(std::int32_t node) {
    OpenMesh::EdgeHandle longest;
    double largest = 0.0;
    for (const auto edge : mesh_.edges()) {
      const OpenMesh::HalfedgeHandle h = plain(mesh_.halfedge_handle(edge, 0));
      double others = 0.0;
      for (const OpenMesh::HalfedgeHandle side : {h, mesh_.opposite_halfedge_handle(h)}) {
        const OpenMesh::HalfedgeHandle next = mesh_.next_halfedge_handle(side);
        others += length_of(next) + length_of(mesh_.next_halfedge_handle(next));
      }
      const double ratio = length_of(h) / others;
      if (ratio > largest) {
        largest = ratio;
        longest = edge;
      }
    }
    const OpenMesh::HalfedgeHandle h = mesh_.halfedge_handle(longest, 0);
    const std::int32_t a = mesh_.from_vertex_handle(h).idx();
    const std::int32_t b = mesh_.to_vertex_handle(h).idx();
    const MeshPlace place = surface_.nearest(0.5 * (points_[a] + points_[b]), places_[a]);
    const OpenMesh::VertexHandle added = plain(mesh_.add_vertex(Mesh::Point(0.0, 0.0, 0.0)));
    points_.push_back(surface_.position(place));
    places_.push_back(place);
    origin_.push_back(-1 - (node >= 0 ? node : -1 - node));
    mesh_.split(longest, added);
    update_boxes(faces_around(added));
  }

  /// Closes the gaps in the arrays that collapses left.
  void compact() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (mesh_.status(OpenMesh::VertexHandle(static_cast<int>(i))).deleted()) continue;
      mesh_.set_point(OpenMesh::VertexHandle(static_cast<int>(i)),
                      Mesh::Point(static_cast<double>(i), 0.0, 0.0));
      ++kept;
    }
    mesh_.garbage_collection();
    std::vector<Vector3> points(kept);
    std::vector<MeshPlace> places(kept);
    std::vector<std::int32_t> origin(kept);
    for (std::size_t i = 0; i < kept; ++i) {
      // Garbage collection moves vertices about; their old numbers went with them as coordinates.
      const auto old =
          static_cast<std::size_t>(mesh_.point(OpenMesh::VertexHandle(static_cast<int>(i)))[0]);
      points[i] = points_[old];
      places[i] = places_[old];
      origin[i] = origin_[old];
    }
    points_ = std::move(points);
    places_ = std::move(places);
    origin_ = std::move(origin);
    build_boxes();
  }

  const MappedSurface& surface_;
  const Execution& execution_;
  Mesh mesh_;  ///< only how the triangles hang together; the positions are in points_
  std::vector<Vector3> points_;
  std::vector<MeshPlace> places_;
  std::vector<std::int32_t> origin_;  ///< node of each vertex; -1 - node of one that was put in
  std::vector<char> active_;
  std::vector<BoxedFace> boxes_;  ///< of each face, as they stand in the tree
  Tree tree_;
  double angle_limit_;
  double turn_limit_;
  Moves moves_;
};

void check_options(const TriangleMendingOptions& options) {
  require_in_range(options.smallest_angle, mending_angle_option);
  require_in_range(options.largest_turn, mending_turn_option);
  require_in_range(options.rounds, mending_rounds_option);
}

}  // namespace

MendedTriangles mend_triangles(const IndexedMesh& nodes, const std::vector<MeshPlace>& places,
                               const MappedSurface& surface, const TriangleMendingOptions& options,
                               const Execution& execution,
                               std::optional<std::size_t> known_meeting) {
  check_options(options);
  if (places.size() != nodes.points.size()) {
    throw Error(ErrorCode::InvalidInput, "There are " + std::to_string(nodes.points.size()) +
                                             " nodes, but " + std::to_string(places.size()) +
                                             " places; give one each.");
  }
  MendedTriangles unchanged;
  unchanged.mesh = nodes;
  unchanged.places = places;
  Mender mender(nodes, places, surface, options, execution);
  const Worst before = mender.worst();
  unchanged.report.left = before.small;
  std::size_t meeting =
      known_meeting ? *known_meeting : self_intersections(nodes, execution).size();
  if (unchanged.report.left == 0 && meeting == 0) return unchanged;
  // On a body flat as paper there is nothing to part, or nodes that are put in elsewhere make
  // thousands of pairs meet, more from round to round: each step then asks hundreds of nearly
  // coplanar triangles of each other, exactly, which takes minutes and leads nowhere.
  const auto is_lost = [&] { return meeting > nodes.points.size(); };
  if (is_lost()) return unchanged;
  mender.build_boxes();

  // Relocations may leave more small angles for a while, so the best of all rounds is taken: the
  // one in which the fewest triangles meet, of those the one with the fewest small angles, and of
  // those the one whose smallest angle is largest.
  MendedTriangles best = unchanged;
  std::size_t fewest_meeting = meeting;
  double best_angle = before.angle;
  TriangleMendingReport report = unchanged.report;
  for (int round = 0; round < options.rounds && (report.left > 0 || meeting > 0) && !is_lost();
       ++round) {
    const int relocations = report.relocations;
    int changes = mender.improve(report);
    // Moves come first: most angles need no more.
    constexpr int rounds_a_relocation = 4;
    if (changes == 0 || round % rounds_a_relocation == rounds_a_relocation - 1) {
      if (meeting > 0) changes += mender.separate(report);
      changes += mender.relocate(report);
    }
    // Sparing moves may go on for long, each a little.
    const bool is_stuck = changes == 0 || round == options.rounds / 2;
    if (is_stuck && !mender.try_more_moves() && changes == 0) break;
    const Worst now = mender.worst();
    report.left = now.small;
    // Nothing else makes any meet, and looking through all takes as long as the rest of a round.
    if (meeting > 0 || report.relocations > relocations) meeting = mender.meeting_pairs().size();
    // Fewer small angles are no gain where one of them is smaller than any was: a node that was
    // relocated may lie all but on another.
    const bool is_better =
        meeting < fewest_meeting ||
        (meeting == fewest_meeting && now.angle <= before.angle &&
         std::pair(report.left, now.angle) < std::pair(best.report.left, best_angle - least_gain));
    if (!is_better) continue;
    fewest_meeting = meeting;
    best_angle = now.angle;
    best = mender.result();
    best.report = report;
  }
  return best;
}

}  // namespace wscvt
