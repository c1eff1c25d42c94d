// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/face_boxes.h"

#include <algorithm>
#include <cmath>

#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

double squared_distance(const std::array<Vector3, 3>& corners, const Vector3& point) {
  const auto& [a, b, c] = corners;
  const Vector3 weights = nearest_weights(a, b, c, point);
  // About the point, so that far from the origin no digits are lost.
  return (weights[0] * (a - point) + weights[1] * (b - point) + weights[2] * (c - point))
      .squaredNorm();
}

}  // namespace

FaceBoxes::FaceBoxes(const IndexedMesh& mesh, const Execution& execution,
                     const std::string& stage) {
  faces_.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Corners corners = {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
    // Its neighbours cover what a face without area covers.
    if (triangle_area(corners[0], corners[1], corners[2]) > 0.0) faces_.push_back(corners);
  }
  if (faces_.empty()) return;
  nodes_.reserve(2 * faces_.size() - 1);
  build(0, faces_.size(), execution, stage);
}

void FaceBoxes::build(std::size_t begin, std::size_t end, const Execution& execution,
                      const std::string& stage) {
  constexpr std::size_t faces_a_report = 8192;  // some hundredths of a second
  if (end - begin > faces_a_report) execution.report(0.0, stage);
  Node node{faces_[begin][0], faces_[begin][0], 0, -1};
  for (std::size_t f = begin; f < end; ++f) {
    for (const Vector3& corner : faces_[f]) {
      node.low = node.low.cwiseMin(corner);
      node.high = node.high.cwiseMax(corner);
    }
  }
  const std::size_t place = nodes_.size();
  nodes_.push_back(node);
  if (end - begin == 1) {
    nodes_[place].face = static_cast<std::int32_t>(begin);
  } else {
    int axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const auto centre = [axis](const Corners& corners) {
      return corners[0][axis] + corners[1][axis] + corners[2][axis];
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [this](std::size_t f) {
      return faces_.begin() + static_cast<std::ptrdiff_t>(f);
    };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](const Corners& a, const Corners& b) { return centre(a) < centre(b); });
    build(begin, middle, execution, stage);
    build(middle, end, execution, stage);
  }
  nodes_[place].beyond = static_cast<std::int32_t>(nodes_.size());
}

std::size_t FaceBoxes::nearby_face(const Vector3& point) const {
  std::size_t i = 0;
  while (nodes_[i].face < 0) {
    const std::size_t first = i + 1;
    const auto second = static_cast<std::size_t>(nodes_[first].beyond);
    i = nodes_[first].squared_distance(point) <= nodes_[second].squared_distance(point) ? first
                                                                                        : second;
  }
  return static_cast<std::size_t>(nodes_[i].face);
}

double FaceBoxes::distance(const Vector3& point, std::size_t& face) const {
  double nearest = squared_distance(faces_[face], point);
  // A start as far as the face is large is no better than what a walk down the tree comes to.
  if (nearest > (faces_[face][1] - faces_[face][0]).squaredNorm()) {
    face = nearby_face(point);
    nearest = squared_distance(faces_[face], point);
  }
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (node.squared_distance(point) >= nearest) {
      i = static_cast<std::size_t>(node.beyond);
      continue;
    }
    ++i;
    if (node.face < 0) continue;
    const double distance = squared_distance(faces_[static_cast<std::size_t>(node.face)], point);
    if (distance < nearest) {
      nearest = distance;
      face = static_cast<std::size_t>(node.face);
    }
  }
  return std::sqrt(nearest);
}

std::vector<double> FaceBoxes::distances(const std::vector<Vector3>& points,
                                         const Execution& execution) const {
  constexpr std::size_t block_size = 256;
  std::vector<double> result(points.size());
  execution.parallel_for(points.size(), block_size, [&](std::size_t begin, std::size_t end) {
    std::size_t face = 0;
    for (std::size_t i = begin; i < end; ++i) result[i] = distance(points[i], face);
  });
  return result;
}

}  // namespace wscvt
