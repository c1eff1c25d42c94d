// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/mesh_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::int32_t nothing = -1;

struct PixelPlace {
  double x;
  double y;
  double depth;  ///< towards the viewer
};

double doubled_area(const PixelPlace& a, const PixelPlace& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

MeshView view_of(const std::vector<const IndexedMesh*>& meshes, int pixels) {
  Eigen::AlignedBox3d box;
  for (const IndexedMesh* const mesh : meshes) {
    for (const Vector3& p : mesh->points) box.extend(p);
  }
  MeshView view;
  const Vector3 towards = Vector3(0.5, -1.0, 0.45).normalized();
  view.right = Vector3::UnitZ().cross(towards).normalized();
  view.up = towards.cross(view.right);
  view.centre = box.center();
  view.pixels = pixels;
  view.half_size = 0.0;
  for (const IndexedMesh* const mesh : meshes) {
    for (const Vector3& p : mesh->points) {
      const Vector3 from = p - view.centre;
      view.half_size =
          std::max({view.half_size, std::abs(from.dot(view.right)), std::abs(from.dot(view.up))});
    }
  }
  view.half_size *= 1.04;  // a margin
  return view;
}

SeenMesh look_at(const IndexedMesh& mesh, const MeshView& view) {
  const Vector3 towards = view.right.cross(view.up);
  const double scale = 0.5 * view.pixels / view.half_size;
  const auto count = static_cast<std::size_t>(view.pixels) * static_cast<std::size_t>(view.pixels);
  SeenMesh seen;
  seen.faces.assign(count, nothing);
  seen.points.assign(count, Vector3::Zero());
  seen.edges.assign(count, 0.0);
  std::vector<double> depths(count, -std::numeric_limits<double>::infinity());

  std::vector<PixelPlace> places;
  places.reserve(mesh.points.size());
  for (const Vector3& p : mesh.points) {
    const Vector3 from = p - view.centre;
    places.push_back({0.5 * view.pixels + scale * from.dot(view.right),
                      0.5 * view.pixels + scale * from.dot(view.up), from.dot(towards)});
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const Triangle& t = mesh.triangles[f];
    const std::array<PixelPlace, 3> at = {places[t[0]], places[t[1]], places[t[2]]};
    const double area = doubled_area(at[0], at[1], at[2].x, at[2].y);
    if (!(area > 0.0)) continue;
    const auto bound = [&](double value) {
      return std::clamp(static_cast<int>(std::floor(value)), 0, view.pixels - 1);
    };
    const int first_x = bound(std::min({at[0].x, at[1].x, at[2].x}));
    const int last_x = bound(std::max({at[0].x, at[1].x, at[2].x}));
    const int first_y = bound(std::min({at[0].y, at[1].y, at[2].y}));
    const int last_y = bound(std::max({at[0].y, at[1].y, at[2].y}));
    for (int y = first_y; y <= last_y; ++y) {
      for (int x = first_x; x <= last_x; ++x) {
        // Barycentric coordinates of the pixel's middle, and its distance to the nearest edge.
        std::array<double, 3> share{};
        double edge = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
          const PixelPlace& a = at[(k + 1) % 3];
          const PixelPlace& b = at[(k + 2) % 3];
          const double doubled = doubled_area(a, b, x + 0.5, y + 0.5);
          share[k] = doubled / area;
          edge = std::min(edge, doubled / portable::hypot(b.x - a.x, b.y - a.y));
        }
        if (!(share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0)) continue;
        const double depth =
            share[0] * at[0].depth + share[1] * at[1].depth + share[2] * at[2].depth;
        const std::size_t pixel = static_cast<std::size_t>(view.pixels - 1 - y) * view.pixels +
                                  static_cast<std::size_t>(x);
        if (!(depth > depths[pixel])) continue;
        depths[pixel] = depth;
        seen.faces[pixel] = static_cast<std::int32_t>(f);
        seen.edges[pixel] = edge;
        seen.points[pixel] = share[0] * mesh.points[t[0]] + share[1] * mesh.points[t[1]] +
                             share[2] * mesh.points[t[2]];
      }
    }
  }
  return seen;
}

Picture draw(const IndexedMesh& mesh, const SeenMesh& seen, const MeshView& view, bool with_edges,
             const std::function<std::vector<Colour>(const std::vector<Vector3>&)>& colour_of,
             const std::vector<std::uint8_t>& parts) {
  const auto colour_of_face = [&](std::int32_t face) {
    return parts.empty() ? Colour{200, 200, 200} : part_colour(parts[face]);
  };
  constexpr double edge_pixels = 1.1;
  const Vector3 light = (view.right.cross(view.up) + 0.6 * view.up - 0.4 * view.right).normalized();
  // The colour of a square of four pixels is taken at its first covered pixel.
  const int squares = (view.pixels + 1) / 2;
  std::vector<std::size_t> asked(static_cast<std::size_t>(squares) * squares, seen.faces.size());
  const auto square_of = [&](std::size_t pixel) {
    const std::size_t y = pixel / static_cast<std::size_t>(view.pixels);
    const std::size_t x = pixel % static_cast<std::size_t>(view.pixels);
    return y / 2 * static_cast<std::size_t>(squares) + x / 2;
  };
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < seen.faces.size() && colour_of; ++i) {
    if (seen.faces[i] == nothing || asked[square_of(i)] != seen.faces.size()) continue;
    asked[square_of(i)] = points.size();
    points.push_back(seen.points[i]);
  }
  const std::vector<Colour> colours = colour_of ? colour_of(points) : std::vector<Colour>();
  Picture picture{view.pixels, view.pixels,
                  std::vector<Colour>(seen.faces.size(), Colour{255, 255, 255})};
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] == nothing) continue;
    const Vector3 normal = doubled_area_normal(mesh, seen.faces[i]).normalized();
    double brightness = 0.35 + 0.65 * std::max(0.0, normal.dot(light));
    if (with_edges && seen.edges[i] < edge_pixels) brightness *= 0.35;
    const Colour colour = colour_of ? colours[asked[square_of(i)]] : colour_of_face(seen.faces[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      picture.pixels[i][k] = static_cast<std::uint8_t>(std::lround(brightness * colour[k]));
    }
  }
  return picture;
}

Picture thumbnail_of(const IndexedMesh& mesh, int pixels) {
  // Drawn at twice the size, to smooth the edges.
  const MeshView view = view_of({&mesh}, 2 * pixels);
  return halved(draw(mesh, look_at(mesh, view), view, false, {}));
}

}  // namespace wscvt
