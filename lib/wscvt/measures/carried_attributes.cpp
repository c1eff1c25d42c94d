// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/carried_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/mesh_distance.h"

namespace wscvt {

namespace {

constexpr const char* stage = "Transferring colours and labels";

/// Whether a value between two vertices' values is meaningful.
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
           std::to_string(count) + " " + what + ". Give one each.");
  }
}

/// Copies the values of `attribute` at the indices index(i).
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
      // A corner without a value (NaN) must not affect points where its weight is 0.
      if (weight > 0.0) value += weight * attribute.values[t[k]];
    }
    result.values.push_back(value);
  }
  return result;
}

void check_texture(const MeshTexture& texture, std::size_t faces) {
  if (texture.empty()) return;
  if (texture.corners.size() != faces || texture.picture_of_face.size() != faces) {
    refuse("The texture has " + std::to_string(texture.corners.size()) +
           " faces, but the scan has " + std::to_string(faces) + ". Give each face its corners.");
  }
  for (const TexturePicture& picture : texture.pictures) {
    const bool is_whole =
        picture.empty() ||
        (picture.width > 0 && picture.height > 0 &&
         picture.colours.size() == std::size_t{3} * static_cast<std::size_t>(picture.width) *
                                       static_cast<std::size_t>(picture.height));
    if (is_whole) continue;
    refuse("A picture of the texture has " + std::to_string(picture.colours.size()) +
           " numbers, but is " + std::to_string(picture.width) + " x " +
           std::to_string(picture.height) + ". Give 3 for each pixel.");
  }
}

/// Whether the vertices' colours come from a picture.
bool shows_picture(const MeshAttributes& attributes) {
  const std::vector<TexturePicture>& pictures = attributes.texture.pictures;
  return attribute_named(attributes.of_vertices, "red") == nullptr && !attributes.texture.empty() &&
         std::any_of(pictures.begin(), pictures.end(),
                     [](const TexturePicture& p) { return !p.empty(); });
}

using Colour = std::array<double, 3>;
constexpr Colour white = {255.0, 255.0, 255.0};

/// The pixels about a position from 0 to 1 along a side: the two with their middles on both sides,
/// or the last pixel twice, and the weight of the second.
struct PixelPair {
  std::size_t first;
  std::size_t second;
  double weight;
  PixelPair(double place, int pixels) {
    const double at = std::clamp(place * pixels - 0.5, 0.0, pixels - 1.0);
    first = static_cast<std::size_t>(at);
    second = std::min(first + 1, static_cast<std::size_t>(pixels) - 1);
    weight = at - static_cast<double>(first);
  }
};

Colour colour_at(const TexturePicture& picture, const Eigen::Vector2d& place) {
  // 1 is the right or upper end of the picture, not the beginning of the next. Positions have
  // single precision.
  const auto within = [](double x) {
    constexpr double rounding = 1e-5;
    return x >= -rounding && x <= 1.0 + rounding ? std::clamp(x, 0.0, 1.0) : x - std::floor(x);
  };
  const PixelPair columns(within(place.x()), picture.width);
  const PixelPair rows(1.0 - within(place.y()), picture.height);
  Colour colour{};
  for (std::size_t part = 0; part < colour.size(); ++part) {
    const auto pixel = [&](std::size_t row, std::size_t column) {
      const std::size_t at = row * static_cast<std::size_t>(picture.width) + column;
      return static_cast<double>(picture.colours[3 * at + part]);
    };
    const auto along = [&](std::size_t row) {
      return (1.0 - columns.weight) * pixel(row, columns.first) +
             columns.weight * pixel(row, columns.second);
    };
    colour[part] = (1.0 - rows.weight) * along(rows.first) + rows.weight * along(rows.second);
  }
  return colour;
}

Colour colour_at(const MeshTexture& texture, const MeshPlace& place) {
  const std::int32_t shown = texture.picture_of_face[place.triangle];
  if (shown < 0 || static_cast<std::size_t>(shown) >= texture.pictures.size()) return white;
  const TexturePicture& picture = texture.pictures[static_cast<std::size_t>(shown)];
  if (picture.empty()) return white;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = place.weights[static_cast<Eigen::Index>(k)];
    if (weight > 0.0) at += weight * texture.corners[place.triangle][k].cast<double>();
  }
  // A picture of one pixel is the colour of a material and needs no position.
  if (picture.colours.size() == 3) at.setZero();
  return at.allFinite() ? colour_at(picture, at) : white;
}

void append_colours(const MeshTexture& texture, const std::vector<MeshPlace>& places,
                    std::vector<MeshAttribute>& attributes) {
  std::array<MeshAttribute, 3> parts{{{"red", ScalarType::Uint8, {}},
                                      {"green", ScalarType::Uint8, {}},
                                      {"blue", ScalarType::Uint8, {}}}};
  for (const MeshPlace& place : places) {
    const Colour colour = colour_at(texture, place);
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k].values.push_back(colour[k]);
  }
  for (MeshAttribute& part : parts) attributes.push_back(std::move(part));
}

/// Returns the nearest scan point of each mesh vertex, for a scan without faces. Searches all
/// points, in blocks, because the tree of faces leaves out triangles without area.
std::vector<std::size_t> nearest_points(const std::vector<Vector3>& scan,
                                        const std::vector<Vector3>& points,
                                        const Execution& execution) {
  constexpr std::size_t block = 16;
  std::vector<std::size_t> nearest(points.size(), 0);
  execution.parallel_for_each(points.size(), block, [&](std::size_t i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < scan.size(); ++k) {
      const double square = (scan[k] - points[i]).squaredNorm();
      if (!(square < least)) continue;
      least = square;
      nearest[i] = k;
    }
  });
  return nearest;
}

}  // namespace

MeshAttributes carried_attributes(const IndexedMesh& scan, const MeshAttributes& attributes,
                                  const IndexedMesh& mesh, const Execution& execution) {
  check_sizes(attributes.of_vertices, scan.points.size(), "vertices");
  check_sizes(attributes.of_faces, scan.triangles.size(), "faces");
  check_texture(attributes.texture, scan.triangles.size());
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
  if (!has_area(scan)) return result;
  const MeshDistance boxes(scan, execution, stage);
  const bool shows = shows_picture(attributes);
  if (!attributes.of_vertices.empty() || shows) {
    const std::vector<MeshPlace> places = boxes.nearest_places(mesh.points, execution);
    for (const MeshAttribute& attribute : attributes.of_vertices) {
      result.of_vertices.push_back(at_places(scan, attribute, places));
    }
    if (shows) append_colours(attributes.texture, places, result.of_vertices);
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
