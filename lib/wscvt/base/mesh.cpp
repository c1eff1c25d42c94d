// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"

namespace wscvt {

namespace {

constexpr std::array<const char*, 3> colour_names{"red", "green", "blue"};

/// What differs between the vertices and the faces of OpenMesh.
struct Vertices {
  using Handle = Mesh::VertexHandle;
  template <class Number>
  using Property = OpenMesh::VPropHandleT<Number>;
  static void request_colours(Mesh& mesh) { mesh.request_vertex_colors(); }
  static bool has_colours(const Mesh& mesh) { return mesh.has_vertex_colors(); }
  static auto kept(const Mesh& mesh) { return mesh.vertices(); }
  static auto begin(const Mesh& mesh) { return mesh.vprops_begin(); }
  static auto end(const Mesh& mesh) { return mesh.vprops_end(); }
};
struct Faces {
  using Handle = Mesh::FaceHandle;
  template <class Number>
  using Property = OpenMesh::FPropHandleT<Number>;
  static void request_colours(Mesh& mesh) { mesh.request_face_colors(); }
  static bool has_colours(const Mesh& mesh) { return mesh.has_face_colors(); }
  static auto kept(const Mesh& mesh) { return mesh.faces(); }
  static auto begin(const Mesh& mesh) { return mesh.fprops_begin(); }
  static auto end(const Mesh& mesh) { return mesh.fprops_end(); }
};

template <class Element, class Number>
void add_property(const MeshAttribute& attribute, Mesh& mesh) {
  typename Element::template Property<Number> property;
  mesh.add_property(property, attribute.name);
  int k = 0;
  for (const double value : attribute.values) {
    // Colours are interpolated, so 200 may be 199.99999.
    mesh.property(property, typename Element::Handle(k++)) =
        static_cast<Number>(std::is_integral_v<Number> ? std::round(value) : value);
  }
}

template <class Element>
void add_attributes(const std::vector<MeshAttribute>& attributes, std::size_t count, Mesh& mesh) {
  const bool has_colours =
      std::all_of(colour_names.begin(), colour_names.end(), [&](const char* name) {
        const MeshAttribute* colour = attribute_named(attributes, name);
        return colour != nullptr && !holds_fractions(colour->type);
      });
  if (has_colours) Element::request_colours(mesh);
  for (const MeshAttribute& attribute : attributes) {
    if (attribute.values.size() != count) {
      refuse("The attribute \"" + attribute.name + "\" has " +
             std::to_string(attribute.values.size()) + " values, not " + std::to_string(count) +
             ". Give one for each vertex or face.");
    }
    const auto* const colour = std::find(colour_names.begin(), colour_names.end(), attribute.name);
    if (has_colours && colour != colour_names.end()) {
      int k = 0;
      for (const double value : attribute.values) {
        const typename Element::Handle element(k++);
        Mesh::Color sum = mesh.color(element);
        sum[static_cast<std::size_t>(colour - colour_names.begin())] =
            static_cast<unsigned char>(std::clamp(std::round(value), 0.0, 255.0));
        mesh.set_color(element, sum);
      }
    } else if (attribute.type == ScalarType::Float64) {
      add_property<Element, double>(attribute, mesh);
    } else if (attribute.type == ScalarType::Float32) {
      add_property<Element, float>(attribute, mesh);
    } else {
      add_property<Element, int>(attribute, mesh);
    }
  }
}

template <class Element, class Number>
bool read_property(const Mesh& mesh, const OpenMesh::BaseProperty& property, ScalarType type,
                   std::vector<MeshAttribute>& attributes) {
  const auto* const numbers = dynamic_cast<const OpenMesh::PropertyT<Number>*>(&property);
  if (numbers == nullptr) return false;
  MeshAttribute attribute{property.name(), type, {}};
  for (const auto element : Element::kept(mesh)) {
    attribute.values.push_back(
        static_cast<double>(numbers->data_vector()[static_cast<std::size_t>(element.idx())]));
  }
  attributes.push_back(std::move(attribute));
  return true;
}

template <class Element>
std::vector<MeshAttribute> attributes_of_elements(const Mesh& mesh) {
  std::vector<MeshAttribute> attributes;
  if (Element::has_colours(mesh)) {
    for (std::size_t k = 0; k < colour_names.size(); ++k) {
      attributes.push_back({colour_names[k], ScalarType::Uint8, {}});
      for (const auto element : Element::kept(mesh)) {
        attributes.back().values.push_back(mesh.color(element)[k]);
      }
    }
  }
  for (auto property = Element::begin(mesh); property != Element::end(mesh); ++property) {
    if (*property == nullptr) continue;
    if (read_property<Element, double>(mesh, **property, ScalarType::Float64, attributes)) continue;
    if (read_property<Element, float>(mesh, **property, ScalarType::Float32, attributes)) continue;
    read_property<Element, int>(mesh, **property, ScalarType::Int32, attributes);
  }
  return attributes;
}

}  // namespace

Mesh to_mesh(const IndexedMesh& mesh, const MeshAttributes& attributes) {
  Mesh result;
  const std::size_t vertices = mesh.points.size();
  const std::size_t faces = mesh.triangles.size();
  result.reserve(vertices, 3 * faces / 2 + 1, faces);
  for (const Vector3& p : mesh.points) result.new_vertex(Mesh::Point(p.x(), p.y(), p.z()));
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = mesh.triangles[f];
    for (const std::int32_t v : t) {
      if (v < 0 || static_cast<std::size_t>(v) >= vertices) {
        refuse("Triangle " + std::to_string(f) + " names vertex " + std::to_string(v) +
               ", but the mesh has " + std::to_string(vertices) + " vertices.");
      }
    }
    const auto face = result.add_face(Mesh::VertexHandle(t[0]), Mesh::VertexHandle(t[1]),
                                      Mesh::VertexHandle(t[2]));
    if (!face.is_valid()) {
      refuse("Triangle " + std::to_string(f) +
             " does not fit an oriented 2-manifold. Check and repair the mesh first.");
    }
  }
  add_attributes<Vertices>(attributes.of_vertices, vertices, result);
  add_attributes<Faces>(attributes.of_faces, faces, result);
  return result;
}

IndexedMesh to_indexed(const Mesh& mesh) {
  IndexedMesh result;
  result.points.reserve(mesh.n_vertices());
  result.triangles.reserve(mesh.n_faces());
  std::vector<std::int32_t> indices(mesh.n_vertices(), -1);
  for (const auto vertex : mesh.vertices()) {
    indices[static_cast<std::size_t>(vertex.idx())] =
        static_cast<std::int32_t>(result.points.size());
    const Mesh::Point& p = mesh.point(vertex);
    result.points.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : mesh.faces()) {
    Triangle t{};
    std::size_t k = 0;
    for (const auto vertex : mesh.fv_range(face)) {
      t[k++] = indices[static_cast<std::size_t>(vertex.idx())];
    }
    result.triangles.push_back(t);
  }
  return result;
}

MeshAttributes attributes_of(const Mesh& mesh) {
  return {attributes_of_elements<Vertices>(mesh), attributes_of_elements<Faces>(mesh)};
}

}  // namespace wscvt
