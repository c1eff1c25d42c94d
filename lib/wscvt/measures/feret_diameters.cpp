// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "wscvt/base/convex_hull.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/descriptor_steps.h"
#include "wscvt/measures/direction_search.h"

namespace wscvt {

namespace {

constexpr const char* diameter_stage = "Measuring diameters";

/// Up to this many points every pair is tested.
constexpr std::size_t most_pairs_of = 4000;

constexpr std::size_t planes = 128;
constexpr std::size_t lines = 128;

struct Pair {
  Vector3 from = Vector3::Zero();
  Vector3 to = Vector3::Zero();
  double square = -1.0;
};

Pair farthest_of_all(const std::vector<Vector3>& points) {
  Pair best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double square = (points[i] - points[k]).squaredNorm();
      if (square > best.square) best = {points[k], points[i], square};
    }
  }
  return best;
}

/// Replaces an end by the point farthest from the other end, while the distance grows.
Pair moved_apart(Pair pair, const std::vector<Vector3>& points) {
  for (bool farther = true; farther;) {
    farther = false;
    std::swap(pair.from, pair.to);
    for (const Vector3& p : points) {
      const double square = (p - pair.from).squaredNorm();
      if (!(square > pair.square)) continue;
      pair.to = p;
      pair.square = square;
      farther = true;
    }
  }
  return pair;
}

double width_along(const std::vector<Vector3>& points, const Vector3& direction) {
  return range_along(points, direction).width();
}

/// Sections of the mesh by planes perpendicular to a direction.
class Sections {
 public:
  Sections(const IndexedMesh& mesh, const Vector3& normal)
      : mesh_(mesh), x_(normal.unitOrthogonal()), y_(normal.cross(x_)) {
    heights_.reserve(mesh.points.size());
    for (const Vector3& p : mesh.points) heights_.push_back(normal.dot(p));
    // Uses the faces' corners, because points without a face do not count.
    lowest_ = highest_ = heights_[index(mesh.triangles.front()[0])];
    for (const Triangle& t : mesh.triangles) {
      for (const std::int32_t v : t) {
        lowest_ = std::min(lowest_, heights_[index(v)]);
        highest_ = std::max(highest_, heights_[index(v)]);
      }
    }
  }

  double spacing() const { return (highest_ - lowest_) / static_cast<double>(planes); }
  double height(std::size_t plane) const {
    return lowest_ + (static_cast<double>(plane) + 0.5) * spacing();
  }
  Vector2 in_plane(const Vector3& v) const { return {x_.dot(v), y_.dot(v)}; }

  /// Returns the ends, in pairs, of the segments in which the plane cuts faces.
  std::vector<Vector2> cut(double height) const {
    std::vector<Vector2> ends;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) add(f, height, ends);
    return ends;
  }

  /// Cuts by all planes at once.
  std::vector<std::vector<Vector2>> cut_all() const {
    std::vector<std::vector<Vector2>> result(planes);
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f) {
      const Triangle& t = mesh_.triangles[f];
      const auto [low, high] =
          std::minmax({heights_[index(t[0])], heights_[index(t[1])], heights_[index(t[2])]});
      const double first = std::ceil((low - lowest_) / spacing() - 0.5);
      for (auto plane = static_cast<std::size_t>(std::max(first, 0.0));
           plane < planes && height(plane) <= high; ++plane) {
        add(f, height(plane), result[plane]);
      }
    }
    return result;
  }

 private:
  void add(std::size_t face, double height, std::vector<Vector2>& ends) const {
    const Triangle& t = mesh_.triangles[face];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = index(t[k]);
      const std::size_t b = index(t[following(k)]);
      // Half-open test: two or no edges of a face cross the plane.
      if ((heights_[a] < height) == (heights_[b] < height)) continue;
      const double part = (height - heights_[a]) / (heights_[b] - heights_[a]);
      ends.push_back(in_plane(mesh_.points[a] + part * (mesh_.points[b] - mesh_.points[a])));
    }
  }

  const IndexedMesh& mesh_;
  Vector3 x_;
  Vector3 y_;
  std::vector<double> heights_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
};

FarthestPair diameter_of(std::vector<Vector2> ends) { return farthest_pair(planar_hull(ends)); }

/// Returns the longest chord of a section parallel to `along`, on a set of lines.
double longest_chord(const std::vector<Vector2>& ends, const Vector2& along) {
  const Vector2 across(along.y(), -along.x());
  if (ends.empty()) return 0.0;
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const Vector2& p : ends) {
    first = std::min(first, across.dot(p));
    last = std::max(last, across.dot(p));
  }
  const double spacing = (last - first) / static_cast<double>(lines);
  if (!(spacing > 0.0)) return 0.0;
  std::vector<double> low(lines, std::numeric_limits<double>::infinity());
  std::vector<double> high(lines, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    double from = across.dot(ends[i]);
    double to = across.dot(ends[i + 1]);
    double from_height = along.dot(ends[i]);
    double to_height = along.dot(ends[i + 1]);
    if (from > to) {
      std::swap(from, to);
      std::swap(from_height, to_height);
    }
    const double start = std::ceil((from - first) / spacing - 0.5);
    for (auto line = static_cast<std::size_t>(std::max(start, 0.0)); line < lines; ++line) {
      const double place = first + (static_cast<double>(line) + 0.5) * spacing;
      if (!(place <= to) || !(to > from)) break;
      const double height = from_height + (place - from) / (to - from) * (to_height - from_height);
      low[line] = std::min(low[line], height);
      high[line] = std::max(high[line], height);
    }
  }
  double longest = 0.0;
  for (std::size_t line = 0; line < lines; ++line) {
    if (high[line] > low[line]) longest = std::max(longest, high[line] - low[line]);
  }
  return longest;
}

/// Returns the directions across the hull's three faces with the smallest widths. The valleys
/// between the many edges of a dense hull are narrower than the lattice of a search.
std::vector<DirectionMinimum> narrowest_faces(const IndexedMesh& hull,
                                              const std::vector<Vector3>& extremes,
                                              const Execution& execution) {
  std::vector<DirectionMinimum> faces;
  for (const Triangle& t : hull.triangles) {
    execution.report(0.7, diameter_stage);
    const auto [a, b, c] = corners_of(hull, t);
    const Vector3 normal = doubled_area_normal(a, b, c);
    if (!(normal.norm() > 0.0)) continue;
    faces.push_back({normal.normalized(), width_along(extremes, normal.normalized())});
  }
  const std::size_t kept = std::min<std::size_t>(3, faces.size());
  std::partial_sort(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(kept), faces.end(),
                    [](const DirectionMinimum& one, const DirectionMinimum& other) {
                      return one.value < other.value;
                    });
  faces.resize(kept);
  return faces;
}

}  // namespace

FeretDiameters feret_diameters(const IndexedMesh& mesh, const IndexedMesh& hull_mesh,
                               const Execution& execution) {
  const std::vector<Vector3>& hull = hull_mesh.points;
  if (hull.size() < 4 || mesh.triangles.empty()) {
    refuse("A body of " + std::to_string(hull.size()) +
           " points has no diameters. Give a closed mesh and the points of its hull.");
  }
  // Relative to a point of the mesh, against cancellation far from the origin.
  const Eigen::Matrix3d frame = frame_of(hull);
  const std::vector<Vector3> points = in_frame(hull, hull.front(), frame);
  const IndexedMesh local = {in_frame(mesh.points, hull.front(), frame), mesh.triangles};
  const std::vector<Vector3> extremes =
      extreme_points(points, thinning_directions, diameter_stage, execution);
  FeretDiameters result;
  execution.report(0.1, diameter_stage);
  const Pair ends =
      moved_apart(farthest_of_all(points.size() <= most_pairs_of ? points : extremes), points);
  result.largest = std::sqrt(ends.square);
  const auto width_of = [](const std::vector<Vector3>& some) {
    return [&some](const Vector3& direction) { return width_along(some, direction); };
  };
  DirectionMinimum narrowest = smallest_over_directions(
      width_of(extremes), width_of(extremes), width_of(points), diameter_stage, execution);
  for (const DirectionMinimum& face :
       narrowest_faces({points, hull_mesh.triangles}, extremes, execution)) {
    const DirectionMinimum found = descend(
        width_of(points), {face.direction, width_along(points, face.direction)}, 0.01, 1e-6);
    if (found.value < narrowest.value) narrowest = found;
  }
  result.smallest = width_along(points, narrowest.direction);

  const Sections sections(local, (ends.to - ends.from).normalized());
  const std::vector<std::vector<Vector2>> cuts = sections.cut_all();
  FarthestPair widest;
  double at = sections.height(0);
  for (std::size_t plane = 0; plane < planes; ++plane) {
    execution.report(0.8, diameter_stage);
    const FarthestPair tried = diameter_of(cuts[plane]);
    if (!(tried.distance > widest.distance)) continue;
    widest = tried;
    at = sections.height(plane);
  }
  for (double step = 0.5 * sections.spacing(); step > 1e-3 * sections.spacing(); step *= 0.5) {
    execution.report(0.9, diameter_stage);
    for (const double height : {at - step, at + step}) {
      const FarthestPair tried = diameter_of(sections.cut(height));
      if (!(tried.distance > widest.distance)) continue;
      widest = tried;
      at = height;
    }
  }
  result.width_across = widest.distance;
  if (!(widest.distance > 0.0)) return result;
  const Vector2 chord = (widest.to - widest.from) / widest.distance;
  const Vector2 along(-chord.y(), chord.x());
  for (const std::vector<Vector2>& cut : cuts) {
    result.thickness_across = std::max(result.thickness_across, longest_chord(cut, along));
  }
  return result;
}

double mean_curvature_integral(const IndexedMesh& mesh, const Execution& execution) {
  const HalfEdges edges = link_half_edges(mesh.triangles, mesh.points.size(), execution);
  const auto normal_of = [&mesh](std::size_t face) {
    return Vector3(doubled_area_normal(mesh, face).stableNormalized());
  };
  constexpr std::size_t block = 4096;
  return execution.parallel_sum_of(
      mesh.triangles.size(), block, 0.0, [&](std::size_t f, double& part) {
        const Vector3 normal = normal_of(f);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int32_t opposite = edges.opposite[3 * f + k];
          if (opposite < 0) continue;
          const Vector3 other = normal_of(face_of(opposite));
          const Triangle& t = mesh.triangles[f];
          const Vector3 edge = mesh.points[index(t[following(k)])] - mesh.points[index(t[k])];
          const double length = edge.norm();
          if (!(length > 0.0)) continue;
          const double sine = normal.cross(other).dot(edge) / length;
          // Each edge is visited twice, once from either side.
          part += 0.25 * length * portable::atan2(sine, normal.dot(other));
        }
      });
}

}  // namespace wscvt
