// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wscvt {

/// The types of numbers in a PLY file.
enum class ScalarType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Whether a type holds fractions.
inline bool holds_fractions(ScalarType type) {
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

/// A number at each vertex, or at each face, under the name that PLY files know it by: "red",
/// "green", "blue", "alpha", "quality", "label".
struct MeshAttribute {
  std::string name;
  ScalarType type = ScalarType::Float32;  ///< as which it was read, and is written
  std::vector<double> values;
};

/// The numbers that a mesh carries beside its shape.
struct MeshAttributes {
  std::vector<MeshAttribute> of_vertices;
  std::vector<MeshAttribute> of_faces;

  bool empty() const { return of_vertices.empty() && of_faces.empty(); }
};

/// Returns the attribute of that name, or null if there is none.
inline const MeshAttribute* attribute_named(const std::vector<MeshAttribute>& attributes,
                                            std::string_view name) {
  for (const MeshAttribute& attribute : attributes) {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

}  // namespace wscvt
