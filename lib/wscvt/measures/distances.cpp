// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/distances.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "wscvt/base/box_grid.h"
#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t distance_block = 256;

constexpr const char* distance_stage = "Measuring distances";

}  // namespace

void check_densities(const IndexedMesh& mesh, const std::vector<double>& densities) {
  if (densities.empty() || densities.size() == mesh.points.size()) return;
  refuse("There are " + std::to_string(densities.size()) + " densities for a mesh of " +
         std::to_string(mesh.points.size()) + " vertices. Give one per vertex, or none.");
}

std::vector<MeshPlace> area_uniform_places(const IndexedMesh& mesh, std::size_t count,
                                           const std::vector<double>& densities) {
  check_densities(mesh, densities);
  std::vector<double> accumulated;
  accumulated.reserve(mesh.triangles.size());
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const double density =
        densities.empty() ? 1.0 : (densities[t[0]] + densities[t[1]] + densities[t[2]]) / 3.0;
    area += density * triangle_area(mesh, t);
    accumulated.push_back(area);
  }
  if (!(area > 0.0)) {
    refuse(
        "The mesh has no area, so no points can be spread over it. Give a triangle mesh with "
        "area.");
  }

  std::vector<MeshPlace> places;
  places.reserve(count);
  std::size_t face = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<double>(i);
    const double place = (index + 0.5) / static_cast<double>(count) * area;
    while (face + 1 < accumulated.size() && accumulated[face] < place) ++face;
    Eigen::Vector2d at = plastic_point(i);
    if (at.sum() > 1.0) at = Eigen::Vector2d::Ones() - at;
    places.push_back({static_cast<std::int32_t>(face), {1.0 - at.x() - at.y(), at.x(), at.y()}});
  }
  return places;
}

std::vector<Vector3> area_uniform_samples(const IndexedMesh& mesh, std::size_t count) {
  std::vector<Vector3> samples;
  samples.reserve(count);
  for (const MeshPlace& place : area_uniform_places(mesh, count)) {
    samples.push_back(point_at(mesh, place));
  }
  return samples;
}

namespace {

/// Squares of distances, of which the smallest of several parts are wanted.
struct SmallestSquares {
  std::vector<double> values;

  SmallestSquares& operator+=(const SmallestSquares& other) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::min(values[i], other.values[i]);
    }
    return *this;
  }
};

/// Faces near which points are looked for, per point.
constexpr std::size_t first_faces_a_point = 4;

/// Returns the distances from points to a mesh of many more faces, as a tree of all faces would
/// give them: such a tree takes six times the memory of the mesh. A tree of a few faces, spread
/// evenly by area, gives each point a ball in which its nearest face lies; then all faces are
/// looked through once. Returns nothing if the balls are too large for that.
std::vector<double> distances_to_many(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                                      const Execution& execution) {
  IndexedMesh few;
  std::int32_t last = -1;
  for (const MeshPlace& place : area_uniform_places(mesh, first_faces_a_point * points.size())) {
    if (place.triangle == std::exchange(last, place.triangle)) continue;
    const auto corner = static_cast<std::int32_t>(few.points.size());
    for (const std::int32_t v : mesh.triangles[place.triangle])
      few.points.push_back(mesh.points[v]);
    few.triangles.push_back({corner, corner + 1, corner + 2});
  }
  if (!has_area(few)) return {};
  const MeshDistance tree(few, execution, distance_stage);
  SmallestSquares bounds;
  std::vector<BoxGrid::Box> balls;
  for (const double radius : tree.distances(points, execution)) {
    const Vector3& centre = points[balls.size()];
    balls.emplace_back(centre.array() - radius, centre.array() + radius);
    bounds.values.push_back(radius * radius);
  }
  constexpr int cells_a_side = 64;  // half or twice as many take as long
  const BoxGrid grid(std::move(balls), cells_a_side);
  if (grid.is_crowded()) return {};
  // Each part has all squares, so there are few parts.
  const std::size_t faces_a_part = std::max<std::size_t>(1 << 14, mesh.triangles.size() / 16 + 1);
  bounds = execution.parallel_sum_of(
      mesh.triangles.size(), faces_a_part, bounds, [&](std::size_t f, SmallestSquares& part) {
        const std::array<Vector3, 3> corners = corners_of(mesh, f);
        const BoxGrid::Box box = box_of(corners);
        grid.visit(box, [&](std::int32_t ball) {
          const Vector3& point = points[ball];
          double& smallest = part.values[ball];
          if (box.squaredExteriorDistance(point) >= smallest ||
              !(triangle_area(corners[0], corners[1], corners[2]) > 0.0)) {
            return;
          }
          smallest = std::min(smallest, squared_distance_to_face(corners, point));
        });
      });
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const double square : bounds.values) distances.push_back(std::sqrt(square));
  return distances;
}

/// Whether a mesh has so many faces that a tree of them costs more than a search for each point.
bool has_many_faces(const IndexedMesh& mesh, std::size_t points) {
  return mesh.triangles.size() > 2 * first_faces_a_point * points;
}

/// Returns the distances from points to a mesh. The way is chosen for few points and one use.
std::vector<double> distances_to(const IndexedMesh& mesh, const std::vector<Vector3>& points,
                                 const Execution& execution) {
  execution.report(0.0, distance_stage);
  if (has_many_faces(mesh, points.size())) {
    std::vector<double> distances = distances_to_many(mesh, points, execution);
    if (!distances.empty()) return distances;
  }
  return MeshDistance(mesh, execution).distances(points, execution);
}

struct DistanceSums {
  double sum = 0.0;
  double squares = 0.0;
  double maximum = 0.0;

  DistanceSums& operator+=(const DistanceSums& other) {
    sum += other.sum;
    squares += other.squares;
    maximum = std::max(maximum, other.maximum);
    return *this;
  }
};

OneSidedDistance of_samples(const std::vector<double>& distances, const Execution& execution) {
  const DistanceSums sums = execution.parallel_sum_of(
      distances.size(), distance_block, DistanceSums(), [&](std::size_t i, DistanceSums& part) {
        const double d = distances[i];
        part.sum += d;
        part.squares += d * d;
        part.maximum = std::max(part.maximum, d);
      });
  const auto count = static_cast<double>(distances.size());
  return {sums.maximum, std::sqrt(sums.squares / count), sums.sum / count};
}

/// Returns the vertices that faces have.
std::vector<Vector3> vertices_of(const IndexedMesh& mesh) {
  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) used[v] = 1;
  }
  std::vector<Vector3> vertices;
  vertices.reserve(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (used[i] != 0) vertices.push_back(mesh.points[i]);
  }
  return vertices;
}

/// The larger of two distances, as a sum of parts.
struct Largest {
  double value = 0.0;

  Largest& operator+=(const Largest& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

using Piece = std::array<Vector3, 3>;

std::array<Piece, 4> quarters_of(const Piece& piece) {
  const auto& [a, b, c] = piece;
  const Vector3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  return {Piece{a, ab, ca}, Piece{ab, b, bc}, Piece{ca, bc, c}, Piece{ab, bc, ca}};
}

/// Finds the largest distance of points of faces by branch and bound: what may have a larger
/// distance than found so far is quartered. A piece has none if its middle is near enough, or if
/// all corners are near one face of the other mesh, because the distance from a convex set is
/// convex (M. Tang, M. Lee, Y. Kim: Interactive Hausdorff distance computation, ACM Trans. Graph.
/// 28 (2009)).
class LargestDistance {
 public:
  /// `least`: smaller differences do not matter; length.
  LargestDistance(const MeshDistance& to, double found, double least)
      : to_(to), found_(found), least_(least) {}

  double found() const { return found_; }

  /// Quarters at most `most` pieces.
  void search(const Piece& face, std::size_t most) {
    open_.assign(1, face);
    while (!open_.empty()) {
      const Piece piece = open_.back();
      open_.pop_back();
      if (!may_be_farther(piece) || most == 0) continue;
      --most;
      for (const Piece& quarter : quarters_of(piece)) open_.push_back(quarter);
    }
  }

 private:
  /// What is at most this far is not looked for.
  double limit() const { return found_ + std::max(0.01 * found_, least_); }

  bool may_be_farther(const Piece& piece) {
    const Vector3 middle = (piece[0] + piece[1] + piece[2]) / 3.0;
    double reach = 0.0;
    for (const Vector3& corner : piece) reach = std::max(reach, (corner - middle).norm());
    // Any near face may do; the nearest takes a longer search.
    const double enough = std::max(limit() - reach, 0.5 * limit());
    if (to_.squared_distance(middle, near_, enough * enough) <= enough * enough) {
      if (enough + reach <= limit() || is_near(piece)) return false;
    }
    found_ = std::max(found_, std::sqrt(to_.squared_distance(middle, near_, 0.0)));
    return !is_near(piece);
  }

  /// Whether all points of the piece are near the face found last.
  bool is_near(const Piece& piece) const {
    return std::all_of(piece.begin(), piece.end(), [&](const Vector3& corner) {
      return (to_.nearest_point_of(near_, corner) - corner).norm() <= limit();
    });
  }

  const MeshDistance& to_;
  double found_;
  double least_;
  std::size_t near_ = 0;
  std::vector<Piece> open_;
};

/// Parallel walls far apart would need more; what is found is a distance anyway.
constexpr std::size_t most_quartered = 256;

/// Returns the diagonal of the box around points; length.
double size_of(const std::vector<Vector3>& points) { return box_of(points).diagonal().norm(); }

/// Returns the largest distance from the vertices of a mesh to another, at least `found`. They cost
/// little: a search ends at any face as near as the largest distance so far.
double farthest_vertex(const std::vector<Vector3>& vertices, const MeshDistance& to, double found,
                       const Execution& execution) {
  return execution
      .parallel_sum(vertices.size(), distance_block, Largest{found},
                    [&](std::size_t begin, std::size_t end) {
                      double square = found * found;
                      std::size_t near = 0;
                      for (std::size_t i = begin; i < end; ++i) {
                        square = std::max(square, to.squared_distance(vertices[i], near, square));
                      }
                      return Largest{std::sqrt(square)};
                    })
      .value;
}

/// Returns the largest distance from the points of a mesh to another, at least `found`.
double largest_distance(const IndexedMesh& from, const MeshDistance& to, double found,
                        const Execution& execution) {
  const std::vector<Vector3> vertices = vertices_of(from);
  const Largest of_vertices{farthest_vertex(vertices, to, found, execution)};
  const double least = 1e-5 * size_of(vertices);
  return execution
      .parallel_sum(from.triangles.size(), distance_block, of_vertices,
                    [&](std::size_t begin, std::size_t end) {
                      LargestDistance search(to, of_vertices.value, least);
                      for (std::size_t f = begin; f < end; ++f) {
                        search.search(corners_of(from, f), most_quartered);
                      }
                      return Largest{search.found()};
                    })
      .value;
}

/// Returns a grid of points on the faces that are known to be farthest; `known`: by face, the
/// largest distance of some points of it.
std::vector<Vector3> points_of_the_farthest(const IndexedMesh& mesh,
                                            const std::vector<double>& known) {
  constexpr std::size_t most_faces = 128;
  constexpr int steps = 10;
  const std::size_t count = std::min(mesh.triangles.size(), most_faces);
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return known[a] != known[b] ? known[a] > known[b] : a < b;
                    });
  std::vector<Vector3> points;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [a, b, c] = mesh.triangles[order[k]];
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        points.push_back(
            (i * mesh.points[a] + j * mesh.points[b] + (steps - i - j) * mesh.points[c]) / steps);
      }
    }
  }
  return points;
}

OneSidedDistance one_sided(const IndexedMesh& from, const MeshDistance& to, std::size_t samples,
                           const Execution& execution) {
  OneSidedDistance result =
      of_samples(to.distances(area_uniform_samples(from, samples), execution), execution);
  result.maximum = largest_distance(from, to, result.maximum, execution);
  return result;
}

/// As one_sided, but the maximum is searched on the farthest faces only, and a reference of many
/// faces gets no tree. All vertices of `mesh` have faces.
OneSidedDistance one_sided_to_scan(const IndexedMesh& mesh, const IndexedMesh& scan,
                                   std::size_t samples, const Execution& execution) {
  std::optional<MeshDistance> tree;
  if (!has_many_faces(scan, samples + mesh.points.size())) tree.emplace(scan, execution);
  const auto distances_of = [&](const std::vector<Vector3>& points) {
    return tree ? tree->distances(points, execution) : distances_to(scan, points, execution);
  };
  std::vector<Vector3> points;
  const std::vector<MeshPlace> places = area_uniform_places(mesh, samples);
  for (const MeshPlace& place : places) points.push_back(point_at(mesh, place));
  points.insert(points.end(), mesh.points.begin(), mesh.points.end());
  std::vector<double> distances = distances_of(points);
  std::vector<double> of_faces(mesh.triangles.size(), 0.0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    double& of_face = of_faces[places[i].triangle];
    of_face = std::max(of_face, distances[i]);
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::int32_t v : mesh.triangles[f]) {
      of_faces[f] = std::max(of_faces[f], distances[samples + static_cast<std::size_t>(v)]);
    }
  }
  const std::vector<double> of_farthest = distances_of(points_of_the_farthest(mesh, of_faces));
  const double largest = std::max(*std::max_element(distances.begin(), distances.end()),
                                  *std::max_element(of_farthest.begin(), of_farthest.end()));
  distances.resize(samples);
  OneSidedDistance result = of_samples(distances, execution);
  result.maximum = largest;
  return result;
}

MeshDistances both_of(const OneSidedDistance& to, const OneSidedDistance& from) {
  return {to, from, std::max(to.maximum, from.maximum),
          std::max(to.root_mean_square, from.root_mean_square)};
}

void check_samples(std::size_t samples) {
  constexpr std::size_t most = 100'000'000;
  if (samples == 0 || samples > most) {
    refuse("The number of distance samples is " + std::to_string(samples) +
           ", but has to be between 1 and " + std::to_string(most) + ".");
  }
}

}  // namespace

MeshDistances measure_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                std::size_t samples, const Execution& execution) {
  check_samples(samples);
  execution.report(0.0, distance_stage);
  return measure_distances(mesh, reference, MeshDistance(reference, execution), samples, execution);
}

MeshDistances measure_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                const MeshDistance& to_reference, std::size_t samples,
                                const Execution& execution) {
  check_samples(samples);
  execution.report(0.0, distance_stage);
  const OneSidedDistance to = one_sided(mesh, to_reference, samples, execution);
  execution.report(0.5, distance_stage);
  const OneSidedDistance from =
      one_sided(reference, MeshDistance(mesh, execution), samples, execution);
  execution.report(1.0, distance_stage);
  return both_of(to, from);
}

MeshDistances sampled_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                std::size_t samples, const Execution& execution) {
  check_samples(samples);
  constexpr std::size_t denser = 4;
  if (reference.triangles.size() <= denser * mesh.triangles.size()) {
    return measure_distances(mesh, reference, samples, execution);
  }
  const OneSidedDistance to = one_sided_to_scan(mesh, reference, samples, execution);
  // The mesh is nearly flat beside a face of the dense reference, so a corner is the farthest.
  const MeshDistance to_mesh(mesh, execution);
  OneSidedDistance from =
      of_samples(to_mesh.distances(area_uniform_samples(reference, samples), execution), execution);
  from.maximum = farthest_vertex(vertices_of(reference), to_mesh, from.maximum, execution);
  return both_of(to, from);
}

double rms_distance(const IndexedMesh& from, const IndexedMesh& to, std::size_t samples,
                    const Execution& execution) {
  check_samples(samples);
  return of_samples(distances_to(to, area_uniform_samples(from, samples), execution), execution)
      .root_mean_square;
}

void scale(MeshDistances& distances, double unit) {
  for (OneSidedDistance* side : {&distances.to_reference, &distances.from_reference}) {
    side->maximum *= unit;
    side->root_mean_square *= unit;
    side->mean *= unit;
  }
  distances.largest *= unit;
  distances.root_mean_square *= unit;
}

}  // namespace wscvt
