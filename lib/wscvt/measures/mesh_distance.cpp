// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/mesh_distance.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t facet_block = 256;

Vector3 nearest_of(const std::array<Vector3, 3>& corners, const Vector3& point) {
  const auto& [a, b, c] = corners;
  const Vector3 weights = nearest_weights(a, b, c, point);
  // Relative to the point, so that no digits are lost far from the origin.
  return weights[0] * (a - point) + weights[1] * (b - point) + weights[2] * (c - point);
}

}  // namespace

double squared_distance_to_face(const std::array<Vector3, 3>& corners, const Vector3& point) {
  const double square = nearest_of(corners, point).squaredNorm();
  // Ignore a needle if its area is lost in rounding; its neighbours cover it.
  return square >= 0.0 ? square : std::numeric_limits<double>::infinity();
}

/// Distributes faces by their centroids, half to each child along the axis of largest spread. Every
/// node's index follows from the number of faces before it, so parts of the tree can be built in
/// any order.
class MeshDistance::Builder {
 public:
  Builder(const IndexedMesh& mesh, MeshDistance& boxes, const Execution& execution,
          const std::string& stage)
      : mesh_(mesh), boxes_(boxes) {
    constexpr std::size_t faces_a_report = 1 << 18;  // some hundredths of a second
    middles_.reserve(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      if (f % faces_a_report == 0) execution.report(0.0, stage);
      const Corners corners = corners_of(mesh, f);
      // The neighbours of a face without area cover it.
      if (!(triangle_area(corners[0], corners[1], corners[2]) > 0.0)) continue;
      middles_.push_back({corners[0] + corners[1] + corners[2], static_cast<std::int32_t>(f)});
    }
  }

  void run(const Execution& execution, const std::string& stage) {
    const std::size_t count = middles_.size();
    if (count == 0) return;
    boxes_.faces_.resize(count);
    boxes_.numbers_.resize(count);
    boxes_.nodes_.resize(2 * ((count + faces_a_leaf - 1) / faces_a_leaf) - 1);
    execution.report(0.0, stage);
    deal({0, count, 0}, execution, stage);
    execution.parallel_for_each(parts_.size(), 1, [&](std::size_t i) { build(parts_[i]); });
    // The nodes above the parts, from the leaves up.
    for (auto part = upper_.rbegin(); part != upper_.rend(); ++part) join(*part);
  }

 private:
  struct Middle {
    Vector3 sum;  ///< of the corners
    std::int32_t face;
  };
  /// A node and its faces, in leaf order.
  struct Part {
    std::size_t begin;
    std::size_t end;
    std::size_t node;

    bool is_leaf() const { return end - begin <= faces_a_leaf; }
    /// Number of leaves of the first child, all full. The child has twice as many nodes minus one.
    std::size_t first_leaves() const { return (end - begin + faces_a_leaf - 1) / faces_a_leaf / 2; }
    std::size_t middle() const { return begin + faces_a_leaf * first_leaves(); }
    Part first() const { return {begin, middle(), node + 1}; }
    Part second() const { return {middle(), end, node + 2 * first_leaves()}; }
  };

  void split(const Part& part) {
    Vector3 low = middles_[part.begin].sum;
    Vector3 high = low;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      low = low.cwiseMin(middles_[i].sum);
      high = high.cwiseMax(middles_[i].sum);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const auto at = [this](std::size_t i) {
      return middles_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(
        at(part.begin), at(part.middle()), at(part.end),
        [axis](const Middle& a, const Middle& b) { return a.sum[axis] < b.sum[axis]; });
  }

  /// Splits until each part takes a few hundredths of a second.
  void deal(const Part& part, const Execution& execution, const std::string& stage) {
    constexpr std::size_t faces_a_part = 8192;
    if (part.end - part.begin <= faces_a_part) {
      parts_.push_back(part);
      return;
    }
    execution.report(0.0, stage);
    split(part);
    upper_.push_back(part);
    deal(part.first(), execution, stage);
    deal(part.second(), execution, stage);
  }

  void build(const Part& part) {
    if (part.is_leaf()) {
      const Vector3 corner = corners_of(mesh_, middles_[part.begin].face)[0];
      Node leaf{corner, corner, static_cast<std::int32_t>(part.node + 1),
                static_cast<std::int32_t>(part.begin)};
      for (std::size_t i = part.begin; i < part.end; ++i) {
        const Corners corners = corners_of(mesh_, middles_[i].face);
        for (const Vector3& p : corners) {
          leaf.low = leaf.low.cwiseMin(p);
          leaf.high = leaf.high.cwiseMax(p);
        }
        boxes_.faces_[i] = corners;
        boxes_.numbers_[i] = middles_[i].face;
      }
      boxes_.nodes_[part.node] = leaf;
      return;
    }
    split(part);
    build(part.first());
    build(part.second());
    join(part);
  }

  /// Joins the boxes of a node's two children.
  void join(const Part& part) {
    const Node& first = boxes_.nodes_[part.first().node];
    const Node& second = boxes_.nodes_[part.second().node];
    boxes_.nodes_[part.node] = {first.low.cwiseMin(second.low), first.high.cwiseMax(second.high),
                                second.beyond, -1};
  }

  const IndexedMesh& mesh_;
  MeshDistance& boxes_;
  std::vector<Middle> middles_;  ///< of the faces with area
  std::vector<Part> parts_;
  std::vector<Part> upper_;
};

bool has_area(const IndexedMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Triangle& t) { return triangle_area(mesh, t) > 0.0; });
}

MeshDistance::MeshDistance(const IndexedMesh& mesh, const Execution& execution,
                           const std::string& stage) {
  if (mesh.triangles.empty()) {
    refuse("The mesh has no faces, so no distance to it can be measured. Give a triangle mesh.");
  }
  Builder(mesh, *this, execution, stage).run(execution, stage);
  if (faces_.empty()) {
    refuse(
        "All faces of the mesh are degenerate, so no distance to it can be measured. Give a "
        "mesh with area.");
  }
}

std::size_t MeshDistance::nearby_face(const Vector3& point) const {
  std::size_t i = 0;
  while (nodes_[i].faces < 0) {
    const std::size_t first = i + 1;
    const auto second = static_cast<std::size_t>(nodes_[first].beyond);
    i = nodes_[first].squared_distance(point) <= nodes_[second].squared_distance(point) ? first
                                                                                        : second;
  }
  return static_cast<std::size_t>(nodes_[i].faces);
}

double MeshDistance::squared_distance(const Vector3& point, std::size_t& face,
                                      double enough) const {
  double nearest = squared_distance_to_face(faces_[face], point);
  // Visits the nearer child first, because for a point far inside, many faces are nearly as far as
  // the nearest.
  struct Open {
    std::size_t node;
    double square;
  };
  std::array<Open, 64> open;  // each level of the tree adds one
  std::size_t count = 0;
  open[count++] = {0, nodes_[0].squared_distance(point)};
  while (count > 0 && nearest > enough) {
    const Open next = open[--count];
    if (next.square >= nearest) continue;
    const Node& node = nodes_[next.node];
    if (node.faces >= 0) {
      visit_faces(node, [&](std::size_t candidate) {
        const double square = squared_distance_to_face(faces_[candidate], point);
        if (!(square < nearest)) return;
        nearest = square;
        face = candidate;
      });
      continue;
    }
    const std::size_t first = next.node + 1;
    Open near = {first, nodes_[first].squared_distance(point)};
    const auto second = static_cast<std::size_t>(nodes_[first].beyond);
    Open far = {second, nodes_[second].squared_distance(point)};
    if (far.square < near.square) std::swap(near, far);
    if (far.square < nearest) open[count++] = far;
    if (near.square < nearest) open[count++] = near;
  }
  return nearest;
}

Vector3 MeshDistance::nearest_point_of(std::size_t face, const Vector3& point) const {
  return point + nearest_of(faces_[face], point);
}

std::vector<std::size_t> MeshDistance::faces_within(const Vector3& point, double distance) const {
  std::vector<std::size_t> faces;
  const double square = distance * distance;
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (node.squared_distance(point) > square) {
      i = static_cast<std::size_t>(node.beyond);
      continue;
    }
    ++i;
    if (node.faces < 0) continue;
    visit_faces(node, [&](std::size_t face) {
      if (squared_distance_to_face(faces_[face], point) <= square) faces.push_back(face);
    });
  }
  return faces;
}

double MeshDistance::distance(const Vector3& point) const {
  std::size_t face = nearby_face(point);
  return std::sqrt(squared_distance(point, face, 0.0));
}

std::vector<double> MeshDistance::distances(const std::vector<Vector3>& points,
                                            const Execution& execution) const {
  std::vector<double> result(points.size());
  execution.parallel_for(points.size(), facet_block, [&](std::size_t begin, std::size_t end) {
    std::size_t face = 0;
    for (std::size_t i = begin; i < end; ++i)
      result[i] = std::sqrt(squared_distance(points[i], face, 0.0));
  });
  return result;
}

std::vector<double> MeshDistance::signed_distances(const std::vector<Vector3>& points,
                                                   const Execution& execution) const {
  std::vector<double> values = distances(points, execution);
  execution.parallel_for_each(points.size(), facet_block, [&](std::size_t i) {
    if (contains(points[i])) values[i] = -values[i];
  });
  return values;
}

std::vector<MeshPlace> MeshDistance::nearest_places(const std::vector<Vector3>& points,
                                                    const Execution& execution) const {
  std::vector<MeshPlace> places(points.size());
  execution.parallel_for(points.size(), facet_block, [&](std::size_t begin, std::size_t end) {
    std::size_t face = 0;
    for (std::size_t i = begin; i < end; ++i) {
      squared_distance(points[i], face, 0.0);
      const auto& [a, b, c] = faces_[face];
      places[i] = {numbers_[face], nearest_weights(a, b, c, points[i])};
    }
  });
  return places;
}

std::size_t MeshDistance::faces_met(const Vector3& point) const {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto local = [&](const Vector3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  // An irregular direction avoids hits on edges and vertices. No component is 0.
  const Vector3 d(0.5377102934, 0.3142870195, 0.7823519467);
  const Kernel::Ray_3 ray(local(point), Kernel::Vector_3(d.x(), d.y(), d.z()));
  // Boxes that the ray grazes must not be lost by rounding (Ize, J. Comput. Graph. Tech. 2 (2013)
  // 12-27).
  constexpr double wider = 1.0 + 4.0 * std::numeric_limits<double>::epsilon();
  const Vector3 inverse = d.cwiseInverse();
  std::size_t met = 0;
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    const double enters = std::max(0.0, (node.low - point).cwiseProduct(inverse).maxCoeff());
    const double leaves = (node.high - point).cwiseProduct(inverse).minCoeff() * wider;
    if (!(enters <= leaves)) {
      i = static_cast<std::size_t>(node.beyond);
      continue;
    }
    ++i;
    if (node.faces < 0) continue;
    visit_faces(node, [&](std::size_t face) {
      const auto& [a, b, c] = faces_[face];
      met += CGAL::do_intersect(ray, Kernel::Triangle_3(local(a), local(b), local(c))) ? 1U : 0U;
    });
  }
  return met;
}

}  // namespace wscvt
