// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vcg/complex/allocate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt::filter {

/// Copies a VCG triangle mesh without its deleted vertices and faces, in order. Throws
/// Error(InvalidInput) if a face refers to a missing or deleted vertex, or if there are too many
/// vertices for 32-bit indices.
template <class VcgMesh>
IndexedMesh to_indexed_mesh(const VcgMesh& mesh) {
  constexpr std::int32_t deleted = -1;
  if (mesh.vert.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    refuse("The mesh has more than 2147483647 vertices. Simplify it first.");
  }
  IndexedMesh result;
  result.points.reserve(static_cast<std::size_t>(mesh.vn));
  result.triangles.reserve(static_cast<std::size_t>(mesh.fn));
  std::vector<std::int32_t> new_index(mesh.vert.size(), deleted);
  for (std::size_t v = 0; v < mesh.vert.size(); ++v) {
    if (mesh.vert[v].IsD()) continue;
    new_index[v] = static_cast<std::int32_t>(result.points.size());
    const auto& p = mesh.vert[v].cP();
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (std::size_t f = 0; f < mesh.face.size(); ++f) {
    if (mesh.face[f].IsD()) continue;
    Triangle triangle{};
    for (int k = 0; k < 3; ++k) {
      const auto* vertex = mesh.face[f].cV(k);
      const auto v = vertex == nullptr ? -1 : vertex - mesh.vert.data();
      if (v < 0 || static_cast<std::size_t>(v) >= new_index.size() || new_index[v] == deleted) {
        refuse("Face " + std::to_string(f) +
               " refers to a missing vertex. Remove unreferenced and degenerate elements first.");
      }
      triangle[k] = new_index[v];
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

/// Replaces the content of a VCG mesh. Vertices and faces keep their order. `qualities` has one
/// value per vertex.
template <class VcgMesh>
void assign(VcgMesh& target, const IndexedMesh& source, const std::vector<double>& qualities) {
  using Scalar = typename VcgMesh::ScalarType;
  target.Clear();
  vcg::tri::Allocator<VcgMesh>::AddVertices(target, source.points.size());
  for (std::size_t v = 0; v < source.points.size(); ++v) {
    const Vector3& p = source.points[v];
    target.vert[v].P() = typename VcgMesh::CoordType(
        static_cast<Scalar>(p.x()), static_cast<Scalar>(p.y()), static_cast<Scalar>(p.z()));
    target.vert[v].Q() = static_cast<typename VcgMesh::VertexType::QualityType>(qualities[v]);
  }
  vcg::tri::Allocator<VcgMesh>::AddFaces(target, source.triangles.size());
  for (std::size_t f = 0; f < source.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(source.triangles[f][k]);
      target.face[f].V(k) = &target.vert[v];
    }
  }
}

/// The channels of a colour, in VCG's order.
constexpr std::array<const char*, 4> colour_names{"red", "green", "blue", "alpha"};

/// Reads colour and quality of vertices or faces, if present, without deleted elements.
template <class Elements>
std::vector<MeshAttribute> attributes_of(const Elements& elements, bool has_colour,
                                         bool has_quality) {
  std::vector<MeshAttribute> attributes;
  const auto add = [&](const char* name, ScalarType type, const auto& value_of) {
    MeshAttribute attribute{name, type, {}};
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (!elements[i].IsD())
        attribute.values.push_back(static_cast<double>(value_of(elements[i])));
    }
    attributes.push_back(std::move(attribute));
  };
  for (int k = 0; has_colour && k < 4; ++k) {
    add(colour_names[k], ScalarType::Uint8, [k](const auto& element) { return element.cC()[k]; });
  }
  if (has_quality) {
    add("quality", ScalarType::Float64, [](const auto& element) { return element.cQ(); });
  }
  return attributes;
}

/// Returns the texture coordinates of the faces' corners, or of their vertices, without deleted
/// faces. The mesh must have them.
template <class VcgMesh>
MeshTexture texture_of(const VcgMesh& mesh, bool of_corners) {
  MeshTexture texture;
  texture.names = mesh.textures;
  for (const auto& face : mesh.face) {
    if (face.IsD()) continue;
    std::array<MeshTexture::Place, 3> corners;
    int picture = 0;
    for (int k = 0; k < 3; ++k) {
      const auto& place = of_corners ? face.cWT(k) : face.cV(k)->cT();
      corners[k] = {static_cast<float>(place.U()), static_cast<float>(place.V())};
      if (k == 0) picture = place.N();
    }
    texture.corners.push_back(corners);
    texture.picture_of_face.push_back(picture);
  }
  return texture;
}

/// Sets the colours of vertices or faces from attributes with one value each. Colours must be
/// enabled. Channels without an attribute stay unchanged.
template <class Elements>
void set_colours(Elements& elements, const std::vector<MeshAttribute>& attributes) {
  for (int k = 0; k < 4; ++k) {
    const MeshAttribute* part = attribute_named(attributes, colour_names[k]);
    for (std::size_t i = 0; part != nullptr && i < elements.size(); ++i) {
      const double value = std::clamp(part->values[i], 0.0, 255.0);
      elements[i].C()[k] = static_cast<unsigned char>(std::lround(value));
    }
  }
}

/// Swaps the vertices, edges and faces of two VCG meshes with optional components in their
/// containers. The attributes of the vertices, edges and faces of `kept` are deleted with them.
template <class VcgMesh>
void exchange_elements(VcgMesh& kept, VcgMesh& other) {
  std::swap(kept.vert, other.vert);
  std::swap(kept.edge, other.edge);
  std::swap(kept.face, other.face);
  std::swap(kept.vn, other.vn);
  std::swap(kept.en, other.en);
  std::swap(kept.fn, other.fn);
  std::swap(kept.imark, other.imark);
  // Each element points to its container.
  for (VcgMesh* mesh : {&kept, &other}) {
    mesh->vert._updateOVP(mesh->vert.begin(), mesh->vert.end());
    mesh->face._updateOVP(mesh->face.begin(), mesh->face.end());
  }
  for (auto* attributes : {&kept.vert_attr, &kept.edge_attr, &kept.face_attr}) {
    for (const auto& attribute : *attributes) delete attribute._handle;
    attributes->clear();
  }
}

}  // namespace wscvt::filter
