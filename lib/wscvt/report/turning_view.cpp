// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/turning_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/report/html_document.h"

namespace wscvt {

extern const char* const view_script;
extern const char* const turning_view_script;

namespace {

/// 60,000 points are 1 MB of text in the page, and more are not told apart on a screen.
constexpr std::size_t most_points = 60000;

/// Joins the points in each cube of a grid: for the eye only. Returns about `most_points`.
IndexedMesh coarse(const IndexedMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += triangle_area(mesh, t);
  // A surface meets about 1.5 cubes where it has the area of a side.
  const double side = std::sqrt(1.5 * area / static_cast<double>(most_points));
  std::map<std::array<std::int64_t, 3>, std::int32_t> numbers;
  std::vector<std::int32_t> number_of(mesh.points.size());
  std::vector<double> counts;
  IndexedMesh result;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vector3 cell = mesh.points[v] / side;
    const std::array<std::int64_t, 3> key = {std::llround(cell.x()), std::llround(cell.y()),
                                             std::llround(cell.z())};
    const auto [at, is_new] = numbers.emplace(key, static_cast<std::int32_t>(result.points.size()));
    if (is_new) {
      result.points.push_back(Vector3::Zero());
      counts.push_back(0.0);
    }
    number_of[v] = at->second;
    result.points[at->second] += mesh.points[v];
    counts[at->second] += 1.0;
  }
  for (std::size_t v = 0; v < counts.size(); ++v) result.points[v] /= counts[v];
  for (const Triangle& t : mesh.triangles) {
    const Triangle joined = {number_of[t[0]], number_of[t[1]], number_of[t[2]]};
    if (joined[0] == joined[1] || joined[1] == joined[2] || joined[2] == joined[0]) continue;
    result.triangles.push_back(joined);
  }
  return result;
}

/// The points of faces that are cut into parts * parts, in the order of turning_view.js.
std::vector<Vector3> divided_points(const IndexedMesh& mesh, int parts) {
  std::vector<Vector3> points;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.points[t[0]];
    const Vector3 along = (mesh.points[t[1]] - a) / parts;
    const Vector3 across = (mesh.points[t[2]] - a) / parts;
    for (int i = 0; i <= parts; ++i) {
      for (int j = 0; j <= parts - i; ++j) points.push_back(a + j * along + i * across);
    }
  }
  return points;
}

/// The number of parts of a side: as many as keep to the number of points.
int parts_of(std::size_t faces) {
  int parts = 1;
  while (parts < 4 && faces * (parts + 2) * (parts + 3) / 2 <= most_points) ++parts;
  return parts;
}

/// The bytes of whole numbers as base64, the lowest byte first, as browsers have them.
template <class Whole>
std::string text_of(const std::vector<Whole>& values) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(Whole));
  for (const Whole value : values) {
    for (std::size_t k = 0; k < sizeof(Whole); ++k) {
      bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * k) & 255U);
    }
  }
  return "\"" + base64(bytes) + "\"";
}

/// `radius`: the length that becomes 1 in the page.
std::string mesh_json(const IndexedMesh& mesh, const Vector3& centre, double radius) {
  std::vector<std::int16_t> positions;
  for (const Vector3& p : mesh.points) {
    const Vector3 scaled = 32767.0 / radius * (p - centre);
    for (int k = 0; k < 3; ++k) {
      positions.push_back(static_cast<std::int16_t>(std::lround(scaled[k])));
    }
  }
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) corners.push_back(static_cast<std::uint32_t>(v));
  }
  return "{\"points\":" + text_of(positions) + ",\"faces\":" + text_of(corners) + "}";
}

/// `mesh`: that of `shown`, or a coarser one.
std::string view_json(const TurningMesh& shown, const IndexedMesh& mesh) {
  std::string json;
  if (&mesh == &shown.mesh) {
    if (shown.with_edges) json += ",\"edges\":true";
    if (!shown.parts.empty()) json += ",\"colours\":" + text_of(shown.parts);
  }
  if (shown.distances) {
    const int parts = parts_of(mesh.triangles.size());
    std::vector<std::int8_t> steps;
    for (const double distance : shown.distances(divided_points(mesh, parts))) {
      const double share = std::clamp(distance / shown.limit, -1.0, 1.0);
      steps.push_back(static_cast<std::int8_t>(std::lround(127.0 * share)));
    }
    json += ",\"parts\":" + std::to_string(parts) + ",\"limit\":" + format_number(shown.limit) +
            ",\"distances\":" + text_of(steps);
  }
  return json;
}

}  // namespace

std::string turning_picture(const std::string& image, std::size_t k) {
  return "<div data-view=\"" + std::to_string(k) + "\">" + image + "</div>";
}

std::string turning_views(const std::vector<TurningMesh>& meshes, const MeshView& view) {
  const Vector3 towards = view.right.cross(view.up);
  std::string json = "{\"turn\":[";
  for (int k = 0; k < 3; ++k) {
    json += (k > 0 ? "," : "") + format_number(view.right[k], 6) + "," +
            format_number(view.up[k], 6) + "," + format_number(towards[k], 6);
  }
  // Turned, a mesh reaches as far as its farthest point.
  double radius = 0.0;
  for (const TurningMesh& shown : meshes) {
    for (const Vector3& p : shown.mesh.points) radius = std::max(radius, (p - view.centre).norm());
  }
  json += "],\"meshes\":[";
  // A mesh with two views is in the page once.
  std::string views;
  std::vector<const IndexedMesh*> written;
  std::vector<IndexedMesh> coarser(meshes.size());
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const IndexedMesh* const own = &meshes[k].mesh;
    const auto found = std::find(written.begin(), written.end(), own);
    const auto number = static_cast<std::size_t>(found - written.begin());
    const bool is_large = own->points.size() > most_points;
    if (found == written.end()) {
      written.push_back(own);
      if (is_large) coarser[number] = coarse(*own);
      json += (number > 0 ? "," : "") +
              mesh_json(is_large ? coarser[number] : *own, view.centre, radius);
    }
    views += (k > 0 ? ",{\"place\":" : "{\"place\":") + std::to_string(k) +
             ",\"mesh\":" + std::to_string(number) +
             view_json(meshes[k], is_large ? coarser[number] : *own) + "}";
  }
  json += "],\"views\":[" + views;
  return "<script type=\"application/json\" id=\"views\">" + json + "]}</script>\n<script>\n" +
         view_script + turning_view_script + "</script>\n";
}

}  // namespace wscvt
