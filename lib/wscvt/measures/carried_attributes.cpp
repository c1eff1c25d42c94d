// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/carried_attributes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/measures/face_boxes.h"

namespace wscvt {

namespace {

constexpr const char* stage = "Carrying colours and labels";

/// Whether a value between those of two vertices means something.
bool is_interpolated(const MeshAttribute& attribute) {
  constexpr std::array<std::string_view, 4> colours{"red", "green", "blue", "alpha"};
  return holds_fractions(attribute.type) ||
         std::find(colours.begin(), colours.end(), attribute.name) != colours.end();
}

void check_sizes(const std::vector<MeshAttribute>& attributes, std::size_t count,
                 const std::string& what) {
  for (const MeshAttribute& attribute : attributes) {
    if (attribute.values.size() == count) continue;
    refuse("The attribute \"" + attribute.name + "\" has " +
           std::to_string(attribute.values.size()) + " values, but the scan has " +
           std::to_string(count) + " " + what + "; give one each.");
  }
}

/// Copies the values of `attribute` at the places that index(i) gives.
template <class Index>
MeshAttribute picked(const MeshAttribute& attribute, std::size_t count, const Index& index) {
  MeshAttribute result{attribute.name, attribute.type, {}};
  result.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) result.values.push_back(attribute.values[index(i)]);
  return result;
}

MeshAttribute at_places(const IndexedMesh& scan, const MeshAttribute& attribute,
                        const std::vector<MeshPlace>& places) {
  if (!is_interpolated(attribute)) {
    return picked(attribute, places.size(), [&](std::size_t i) {
      int corner = 0;
      places[i].weights.maxCoeff(&corner);
      return scan.triangles[places[i].triangle][corner];
    });
  }
  MeshAttribute result{attribute.name, attribute.type, {}};
  result.values.reserve(places.size());
  for (const MeshPlace& place : places) {
    const Triangle& t = scan.triangles[place.triangle];
    double value = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = place.weights[static_cast<Eigen::Index>(k)];
      // A corner without a value (NaN) takes it from those points only that lie towards it.
      if (weight > 0.0) value += weight * attribute.values[t[k]];
    }
    result.values.push_back(value);
  }
  return result;
}

/// Vertices of the mesh by the points of a scan without faces, each a triangle of no area that the
/// tree of faces would leave out: searched plainly, in blocks.
std::vector<std::size_t> nearest_points(const std::vector<Vector3>& scan,
                                        const std::vector<Vector3>& points,
                                        const Execution& execution) {
  constexpr std::size_t block = 16;
  std::vector<std::size_t> nearest(points.size(), 0);
  execution.parallel_for(points.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < scan.size(); ++k) {
        const double square = (scan[k] - points[i]).squaredNorm();
        if (!(square < least)) continue;
        least = square;
        nearest[i] = k;
      }
    }
  });
  return nearest;
}

}  // namespace

MeshAttributes carried_attributes(const IndexedMesh& scan, const MeshAttributes& attributes,
                                  const IndexedMesh& mesh, const Execution& execution) {
  check_sizes(attributes.of_vertices, scan.points.size(), "vertices");
  check_sizes(attributes.of_faces, scan.triangles.size(), "faces");
  MeshAttributes result;
  if (attributes.empty() || scan.points.empty()) return result;
  execution.report(0.0, stage);
  if (scan.triangles.empty()) {
    const std::vector<std::size_t> nearest = nearest_points(scan.points, mesh.points, execution);
    for (const MeshAttribute& attribute : attributes.of_vertices) {
      result.of_vertices.push_back(
          picked(attribute, nearest.size(), [&](std::size_t i) { return nearest[i]; }));
    }
    return result;
  }
  const FaceBoxes boxes(scan, execution, stage);
  if (boxes.empty()) return result;
  if (!attributes.of_vertices.empty()) {
    const std::vector<MeshPlace> places = boxes.nearest_places(mesh.points, execution);
    for (const MeshAttribute& attribute : attributes.of_vertices) {
      result.of_vertices.push_back(at_places(scan, attribute, places));
    }
  }
  if (!attributes.of_faces.empty()) {
    std::vector<Vector3> middles;
    middles.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      middles.emplace_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0);
    }
    const std::vector<MeshPlace> places = boxes.nearest_places(middles, execution);
    for (const MeshAttribute& attribute : attributes.of_faces) {
      result.of_faces.push_back(
          picked(attribute, places.size(), [&](std::size_t i) { return places[i].triangle; }));
    }
  }
  return result;
}

}  // namespace wscvt
