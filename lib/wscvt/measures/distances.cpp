// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/distances.h"

// CGAL 6 calls two of these headers *_3.h, which CGAL 5 does not have.
#define CGAL_NO_DEPRECATION_WARNINGS
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/reporting_split.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/face_boxes.h"
#include "wscvt/surface/mapped_surface.h"

namespace wscvt {

namespace {

constexpr std::size_t block_size = 256;

constexpr const char* stage = "Measuring distances";

// Decides exactly what a ray meets.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Faces = std::vector<Kernel::Triangle_3>;
using Face = Faces::const_iterator;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Face>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
using AabbTree = CGAL::AABB_tree<Traits>;
using PointOnFace = AabbTree::Point_and_primitive_id;

/// Points from which the search for the nearest face starts. A few of them bring the start within
/// some edges of the surface, which is near enough; all would take as long as the tree itself.
std::vector<PointOnFace> search_starts(const Faces& faces) {
  constexpr std::size_t most = 100000;
  const std::size_t stride = 1 + faces.size() / most;
  std::vector<PointOnFace> starts;
  for (std::size_t f = 0; f < faces.size(); f += stride) {
    starts.emplace_back(faces[f].vertex(0), faces.cbegin() + static_cast<std::ptrdiff_t>(f));
  }
  return starts;
}

void require_faces(const IndexedMesh& mesh) {
  if (!mesh.triangles.empty()) return;
  throw Error(ErrorCode::InvalidInput,
              "The mesh has no faces, so no distance to it can be measured; give a triangle mesh.");
}

void require_area(bool has_area) {
  if (has_area) return;
  throw Error(ErrorCode::InvalidInput,
              "All faces of the mesh are degenerate, so no distance to it can be measured; give a "
              "mesh with area.");
}

}  // namespace

struct MeshDistance::Tree {
  Vector3 origin = Vector3::Zero();  ///< of the tree's coordinates: differences stay exact far away
  Faces faces;
  AabbTree tree;

  Kernel::Point_3 local(const Vector3& p) const {
    return {p.x() - origin.x(), p.y() - origin.y(), p.z() - origin.z()};
  }

  /// `face` is where the search starts, and becomes the nearest one.
  double distance(const Vector3& point, Face& face) const {
    const Kernel::Point_3 p = local(point);
    const Kernel::Point_3 start = Kernel().construct_projected_point_3_object()(*face, p);
    // A start as far as a face is large is no better than one of those that the tree has.
    const bool is_near =
        CGAL::squared_distance(p, start) < CGAL::squared_distance(face->vertex(0), face->vertex(1));
    const PointOnFace nearest = is_near ? tree.closest_point_and_primitive(p, {start, face})
                                        : tree.closest_point_and_primitive(p);
    face = nearest.second;
    return std::sqrt(CGAL::squared_distance(p, nearest.first));
  }
};

MeshDistance::MeshDistance(const IndexedMesh& mesh, const Execution& execution)
    : tree_(std::make_unique<Tree>()) {
  require_faces(mesh);
  tree_->origin = mesh.points[mesh.triangles.front()[0]];
  tree_->faces.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Kernel::Triangle_3 face(tree_->local(mesh.points[t[0]]), tree_->local(mesh.points[t[1]]),
                                  tree_->local(mesh.points[t[2]]));
    // Its neighbours cover what a face without area covers, and the tree cannot project on it.
    if (!face.is_degenerate()) tree_->faces.push_back(face);
  }
  require_area(!tree_->faces.empty());
  tree_->tree.insert(tree_->faces.cbegin(), tree_->faces.cend());
  // Now, not at the first query, which may come from several threads.
  const Traits& traits = tree_->tree.traits();
  tree_->tree.custom_build(traits.compute_bbox_object(),
                           ReportingSplit<Traits>(traits, execution, stage));
  const std::vector<PointOnFace> starts = search_starts(tree_->faces);
  tree_->tree.accelerate_distance_queries(starts.begin(), starts.end());
}

MeshDistance::~MeshDistance() = default;
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;

double MeshDistance::distance(const Vector3& point) const {
  return std::sqrt(tree_->tree.squared_distance(tree_->local(point)));
}

Vector3 MeshDistance::nearest_point(const Vector3& point) const {
  const Kernel::Point_3 p = tree_->tree.closest_point(tree_->local(point));
  return tree_->origin + Vector3(p.x(), p.y(), p.z());
}

bool MeshDistance::contains(const Vector3& point) const {
  // Whether a ray meets a triangle is decided exactly; a direction without pattern keeps it off
  // edges and vertices.
  const Kernel::Vector_3 direction(0.5377102934, 0.3142870195, 0.7823519467);
  const Kernel::Ray_3 ray(tree_->local(point), direction);
  return tree_->tree.number_of_intersected_primitives(ray) % 2 == 1;
}

std::vector<double> MeshDistance::distances(const std::vector<Vector3>& points,
                                            const Execution& execution) const {
  std::vector<double> result(points.size());
  execution.parallel_for(points.size(), block_size, [&](std::size_t begin, std::size_t end) {
    // Where points follow each other along a surface the nearest face is mostly the one of the
    // point before, and half the time is saved.
    Face face = tree_->faces.cbegin();
    for (std::size_t i = begin; i < end; ++i) result[i] = tree_->distance(points[i], face);
  });
  return result;
}

void check_densities(const IndexedMesh& mesh, const std::vector<double>& densities) {
  if (densities.empty() || densities.size() == mesh.points.size()) return;
  throw Error(ErrorCode::InvalidInput,
              "There are " + std::to_string(densities.size()) + " densities for a mesh of " +
                  std::to_string(mesh.points.size()) + " vertices; give one each, or none.");
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
    area += density * triangle_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    accumulated.push_back(area);
  }
  if (!(area > 0.0)) {
    throw Error(ErrorCode::InvalidInput,
                "The mesh has no area, so no points can be spread over it; give a triangle mesh "
                "with area.");
  }

  // Steps of the additive recurrence with the plastic number (Roberts 2018), 1/p and 1/p^2.
  constexpr double first_step = 0.75487766624669276;
  constexpr double second_step = 0.56984029099805327;
  std::vector<MeshPlace> places;
  places.reserve(count);
  std::size_t face = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<double>(i);
    const double place = (index + 0.5) / static_cast<double>(count) * area;
    while (face + 1 < accumulated.size() && accumulated[face] < place) ++face;
    double u = 0.5 + index * first_step;
    double v = 0.5 + index * second_step;
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    places.push_back({static_cast<std::int32_t>(face), {1.0 - u - v, u, v}});
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

DistanceSums sums_of(const std::vector<double>& distances, const Execution& execution) {
  return execution.parallel_sum(distances.size(), block_size, DistanceSums(),
                                [&](std::size_t begin, std::size_t end) {
                                  DistanceSums part;
                                  for (std::size_t i = begin; i < end; ++i) {
                                    const double d = distances[i];
                                    part.sum += d;
                                    part.squares += d * d;
                                    part.maximum = std::max(part.maximum, d);
                                  }
                                  return part;
                                });
}

OneSidedDistance one_sided(const IndexedMesh& from, const MeshDistance& to, std::size_t samples,
                           const Execution& execution) {
  const DistanceSums spread =
      sums_of(to.distances(area_uniform_samples(from, samples), execution), execution);
  std::vector<char> used(from.points.size(), 0);
  for (const Triangle& t : from.triangles) {
    for (const std::int32_t v : t) used[v] = 1;
  }
  std::vector<Vector3> vertices;
  vertices.reserve(from.points.size());
  for (std::size_t i = 0; i < from.points.size(); ++i) {
    if (used[i] != 0) vertices.push_back(from.points[i]);
  }
  const DistanceSums corners = sums_of(to.distances(vertices, execution), execution);
  const auto count = static_cast<double>(samples);
  OneSidedDistance result;
  result.maximum = std::max(spread.maximum, corners.maximum);
  result.root_mean_square = std::sqrt(spread.squares / count);
  result.mean = spread.sum / count;
  return result;
}

}  // namespace

void check_distance_options(const DistanceOptions& options) {
  require_in_range(options.samples, distance_samples_option);
}

MeshDistances measure_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                const DistanceOptions& options, const Execution& execution) {
  check_distance_options(options);
  execution.report(0.0, stage);
  return measure_distances(mesh, reference, MeshDistance(reference, execution), options, execution);
}

MeshDistances measure_distances(const IndexedMesh& mesh, const IndexedMesh& reference,
                                const MeshDistance& to_reference, const DistanceOptions& options,
                                const Execution& execution) {
  check_distance_options(options);
  MeshDistances result;
  execution.report(0.0, stage);
  result.to_reference = one_sided(mesh, to_reference, options.samples, execution);
  execution.report(0.5, stage);
  result.from_reference =
      one_sided(reference, MeshDistance(mesh, execution), options.samples, execution);
  execution.report(1.0, stage);
  result.largest = std::max(result.to_reference.maximum, result.from_reference.maximum);
  result.root_mean_square =
      std::max(result.to_reference.root_mean_square, result.from_reference.root_mean_square);
  return result;
}

double rms_distance(const IndexedMesh& from, const IndexedMesh& to, std::size_t samples,
                    const Execution& execution) {
  check_distance_options({samples});
  require_faces(to);
  const FaceBoxes boxes(to, execution, stage);
  require_area(!boxes.empty());
  const std::vector<double> distances =
      boxes.distances(area_uniform_samples(from, samples), execution);
  return std::sqrt(sums_of(distances, execution).squares / static_cast<double>(samples));
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
