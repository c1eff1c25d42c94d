// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/coordinates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/single_precision.h"

namespace wscvt {

namespace {

std::size_t collapsed_faces(const IndexedMesh& mesh) {
  return static_cast<std::size_t>(
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        const Vector3& a = mesh.points[t[0]];
        const Vector3& b = mesh.points[t[1]];
        const Vector3& c = mesh.points[t[2]];
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
  // Reading and the product each have an error of half an ulp.
  return std::abs(scaled - std::round(scaled)) <=
         4.0 * std::numeric_limits<double>::epsilon() * std::abs(scaled);
}

}  // namespace

void check_scan_size(const std::vector<Vector3>& points) {
  if (points.empty()) return;
  Vector3 low = points.front();
  Vector3 high = points.front();
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    if (!p.allFinite()) return;
  }
  check_scan_size(high - low);
}

void check_scan_size(const Vector3& extents) {
  const double size = extents.maxCoeff();
  if (size == 0.0 || (size >= smallest_scan_size && size <= largest_scan_size)) return;
  throw Error(ErrorCode::InvalidInput, "The scan is " + format_number(size) +
                                           " units across, which is too small or too large for the "
                                           "computation. Scale it to between " +
                                           format_number(smallest_scan_size) + " and " +
                                           format_number(largest_scan_size) + " units.");
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

std::string single_precision_warning(const IndexedMesh& mesh) {
  if (!is_measurable(mesh)) return "";
  const double step = single_precision_step(mesh);
  if (step > coarse_step && all_coordinates(mesh, [](double value) {
        return static_cast<double>(static_cast<float>(value)) == value;
      })) {
    return "The scan is so far from the origin that its coordinates, in single precision, have "
           "steps of " +
           format_percent(step) + " of the mean edge" + lost(collapsed_faces(mesh)) +
           ". Move the scan to the origin before it is saved in single precision, or save it in "
           "double.";
  }
  return "";
}

std::string precision_warning(const IndexedMesh& mesh) {
  const std::string far = single_precision_warning(mesh);
  if (!far.empty() || !is_measurable(mesh)) return far;
  const double edge = sampled_mean_edge(mesh);
  // Scans of voxels also have coarse steps, but lose no faces.
  const double power_of_ten = portable::pow(10.0, std::floor(-portable::log10(coarse_step * edge)));
  if (!std::isfinite(power_of_ten) ||
      !all_coordinates(mesh, [&](double value) { return has_decimals(value, power_of_ten); })) {
    return "";
  }
  const std::size_t collapsed = collapsed_faces(mesh);
  if (collapsed == 0) return "";
  return "The scan's coordinates have steps of " + format_number(1.0 / power_of_ten) +
         " or more, but its mean edge is " + format_number(edge, 3) + lost(collapsed) +
         ". Save it with more digits.";
}

}  // namespace wscvt
