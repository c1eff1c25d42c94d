// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// The types of numbers in a PLY file.
enum class ScalarType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Whether a type can store fractions.
inline bool holds_fractions(ScalarType type) {
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

/// One number per vertex or per face, with its name in PLY files: "red", "green", "blue", "alpha",
/// "quality", "label".
struct MeshAttribute {
  std::string name;
  ScalarType type = ScalarType::Float32;  ///< in the file, read or written
  std::vector<double> values;
};

/// A picture: red, green and blue of each pixel, rows from the top, each from the left.
struct TexturePicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> colours;  ///< 3 width height

  bool empty() const { return colours.empty(); }
};

/// Pictures on the faces of a mesh.
struct MeshTexture {
  /// Position of a corner in its picture, from the left and from the bottom. The picture extends
  /// from 0 to 1 and repeats beyond. Not finite: the corner has no position.
  using Place = Eigen::Vector2f;
  static Place no_place() { return Place::Constant(std::numeric_limits<float>::quiet_NaN()); }

  std::vector<std::string> names;             ///< of the pictures, or of their materials
  std::vector<TexturePicture> pictures;       ///< an empty one could not be read
  std::vector<std::int32_t> picture_of_face;  ///< index; -1: none
  std::vector<std::array<Place, 3>> corners;  ///< of each face

  bool empty() const { return corners.empty(); }
};

/// Numbers at the vertices and faces of a mesh, and its texture.
struct MeshAttributes {
  std::vector<MeshAttribute> of_vertices;
  std::vector<MeshAttribute> of_faces;
  MeshTexture texture = {};

  bool empty() const { return of_vertices.empty() && of_faces.empty() && texture.empty(); }
};

/// The names that a file gives to sets of its faces: objects and groups of OBJ, solids of STL.
struct NamedFaces {
  std::vector<std::string> names;  ///< several solids may have one name
  /// Index of the name of each triangle, -1: none. Or, twice as many, of the bodies on its two
  /// sides, which have the triangle in common; -1: void.
  std::vector<std::int32_t> of_face;
};

/// Returns the attribute with this name, or null.
inline const MeshAttribute* attribute_named(const std::vector<MeshAttribute>& attributes,
                                            std::string_view name) {
  for (const MeshAttribute& attribute : attributes) {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

}  // namespace wscvt
