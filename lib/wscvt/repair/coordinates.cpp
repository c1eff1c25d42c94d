// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/coordinates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

std::size_t collapsed_faces(const IndexedMesh& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        const auto [a, b, c] = corners_of(mesh, t);
        return a == b || b == c || c == a;
      }));
}

/// Asks the corners of the faces, because other vertices may lie anywhere.
template <class Fits>
bool all_coordinates(const IndexedMesh& mesh, const Fits& fits) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) {
      const Vector3& p = mesh.points[v];
      return fits(p.x()) && fits(p.y()) && fits(p.z());
    });
  });
}

/// Whether a number has at most this many decimals.
bool has_decimals(double value, double power_of_ten) {
  const double scaled = value * power_of_ten;
  if (scaled == 0.0) return value == 0.0;  // not if the product is too small for a number
  // Reading and the product each have an error of half an ulp.
  return std::abs(scaled - std::round(scaled)) <=
         4.0 * std::numeric_limits<double>::epsilon() * std::abs(scaled);
}

}  // namespace

void check_scan_size(const std::vector<Vector3>& points) {
  if (points.empty()) return;
  Eigen::AlignedBox3d box;
  for (const Vector3& p : points) {
    if (!p.allFinite()) return;
    box.extend(p);
  }
  check_scan_size(box.sizes());
}

void check_scan_size(const Vector3& extents) {
  const double size = extents.maxCoeff();
  if (size == 0.0 || (size >= smallest_scan_size && size <= largest_scan_size)) return;
  refuse(
      "The scan is " + format_number(size) +
      " units across, which is too small or too large for the computation. Scale it to between " +
      format_number(smallest_scan_size) + " and " + format_number(largest_scan_size) + " units.");
}

namespace {

/// Whether all corners are valid indices and finite, and the mean edge is above 0.
bool is_measurable(const IndexedMesh& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.points.size());
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) {
      if (v < 0 || v >= count || !mesh.points[v].allFinite()) return false;
    }
  }
  return sampled_mean_edge(mesh) > 0.0;
}

std::string lost(std::size_t faces) {
  return faces == 0 ? ""
                    : ", and " + std::to_string(faces) + " faces have two corners at one point";
}

}  // namespace

std::string single_precision_warning(const IndexedMesh& mesh, const std::string& name) {
  if (!is_measurable(mesh)) return "";
  const double step = single_precision_step(mesh);
  if (step > coarse_step && all_coordinates(mesh, [](double value) {
        return static_cast<double>(static_cast<float>(value)) == value;
      })) {
    return name +
           " is so far from the origin that its coordinates, in single precision, have steps of " +
           format_percent(step) + " of the mean edge" + lost(collapsed_faces(mesh)) +
           ". Move it to the origin before it is saved in single precision, or save it in double.";
  }
  return "";
}

std::string precision_warning(const IndexedMesh& mesh) {
  std::string far = single_precision_warning(mesh, "The scan");
  if (!far.empty() || !is_measurable(mesh)) return far;
  const double edge = sampled_mean_edge(mesh);
  // Scans of voxels also have coarse steps, but lose no faces.
  double power_of_ten = portable::pow(10.0, std::floor(-portable::log10(coarse_step * edge)));
  const auto has_steps = [&](double power) {
    return all_coordinates(mesh, [&](double value) { return has_decimals(value, power); });
  };
  if (!std::isfinite(power_of_ten) || !has_steps(power_of_ten)) return "";
  const std::size_t collapsed = collapsed_faces(mesh);
  if (collapsed == 0) return "";
  // It ends, because some coordinate is not 0.
  while (has_steps(power_of_ten / 10.0)) power_of_ten /= 10.0;
  return "The scan's coordinates have steps of " + format_number(1.0 / power_of_ten) +
         ", but its mean edge is " + format_number(edge, 3) + lost(collapsed) +
         ". Save it with more digits.";
}

namespace {

void refuse_unusable(const IndexedMesh& mesh) {
  const std::size_t vertices = mesh.points.size();
  const std::size_t faces = mesh.triangles.size();
  if (vertices == 0) refuse("The mesh is empty: it has no vertices. Load the scan of a grain.");
  if (faces == 0) {
    refuse("The mesh has " + format_count(vertices, "vertex", "vertices") +
           " but no faces, so it encloses no volume. Remesh it as a point cloud first, to make a "
           "closed surface of the points.");
  }
  constexpr auto limit = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 3;
  if (faces > limit || vertices > limit) {
    refuse("The mesh has " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
           " faces, more than the " + std::to_string(limit) +
           " that can be numbered. Reduce the scan first.");
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = mesh.triangles[f];
    const auto is_wrong = [&](std::int32_t v) { return v < 0 || index(v) >= vertices; };
    if (std::none_of(t.begin(), t.end(), is_wrong)) continue;
    refuse("Face " + std::to_string(f) + " names the vertices " + std::to_string(t[0]) + ", " +
           std::to_string(t[1]) + " and " + std::to_string(t[2]) + ", but the mesh has " +
           std::to_string(vertices) + ". The file or the program that made it is wrong.");
  }
}

/// Drops the faces with a corner that is not finite.
std::size_t drop_lost_faces(IndexedMesh& mesh) {
  const auto first = std::find_if(mesh.points.begin(), mesh.points.end(),
                                  [](const Vector3& p) { return !p.allFinite(); });
  if (first == mesh.points.end()) return 0;
  const auto lost = [&](const Triangle& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::int32_t v) { return !mesh.points[index(v)].allFinite(); });
  };
  const std::size_t faces = mesh.triangles.size();
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), lost),
                       mesh.triangles.end());
  if (mesh.triangles.empty()) {
    const Vector3& p = *first;
    const auto coordinate = [](double value) {
      return std::isnan(value) ? "nan" : format_number(value);
    };
    refuse("All faces of the mesh have a corner that is not at a finite position, e.g. vertex " +
           std::to_string(first - mesh.points.begin()) + " at (" + coordinate(p.x()) + ", " +
           coordinate(p.y()) + ", " + coordinate(p.z()) +
           "). The file or the program that made it is wrong.");
  }
  return faces - mesh.triangles.size();
}

}  // namespace

std::size_t keep_usable_faces(IndexedMesh& mesh) {
  refuse_unusable(mesh);
  return drop_lost_faces(mesh);
}

std::vector<Vector3> different_points(std::vector<Vector3> points, const Execution& execution) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      refuse("Point " + std::to_string(i) +
             " has a coordinate that is not a finite number. Remove it from the scan.");
    }
  }
  const auto less = [](const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(points.begin(), points.end(), less);
  execution.report(0.0, "Sorting the points");  // sorting a million points takes tenths of a second
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 4) {
    refuse("The scan has " + std::to_string(points.size()) +
           " different points and no faces. A body needs at least 4.");
  }
  check_scan_size(points);
  return points;
}

}  // namespace wscvt
