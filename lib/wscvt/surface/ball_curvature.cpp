// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/ball_curvature.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t ball_block = 64;

/// Added to the diagonal of the fit, as a share of its trace: where the patches lie in one line,
/// nothing is known of the curvature across it, and it comes out as 0.
constexpr double ridge = 1e-9;

/// Finds what hangs together in a ball; one of these per thread, because its marks are kept.
class BallSearch {
 public:
  explicit BallSearch(const SurfacePatches& patches)
      : patches_(patches), seen_in_(patches.patches.size(), 0) {}

  /// The patches in the ball that can be reached from the first inside it; the first is always one.
  const std::vector<std::int32_t>& find(const BallCentre& centre, double radius) {
    ++ball_;
    found_.assign(1, centre.patch);
    seen_in_[index(centre.patch)] = ball_;
    for (std::size_t next = 0; next < found_.size(); ++next) {
      const std::size_t patch = index(found_[next]);
      for (const std::int32_t* n = patches_.neighbours.begin(patch);
           n != patches_.neighbours.end(patch); ++n) {
        if (seen_in_[index(*n)] == ball_) continue;
        seen_in_[index(*n)] = ball_;
        const Vector3 d = patches_.patches[index(*n)].centre - centre.point;
        if (d.squaredNorm() < radius * radius) found_.push_back(*n);
      }
    }
    return found_;
  }

 private:
  const SurfacePatches& patches_;
  std::vector<std::uint32_t> seen_in_;
  std::uint32_t ball_ = 0;
  std::vector<std::int32_t> found_;
};

PrincipalCurvatures fit_normals(const SurfacePatches& patches, const std::vector<std::int32_t>& in,
                                const Vector3& point, double radius) {
  // Sums of weights, positions, normals and their products, in units of the ball, so that nothing
  // underflows; turned to the tangent plane at the end, when the normal is known.
  double weights = 0.0;
  Vector3 positions = Vector3::Zero();
  Vector3 normals = Vector3::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();   // of positions
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  // position times normal
  std::size_t counted = 0;
  for (const std::int32_t i : in) {
    const SurfacePatch& patch = patches.patches[index(i)];
    const Vector3 d = (patch.centre - point) / radius;
    const double inside = 1.0 - d.squaredNorm();
    if (!(inside > 0.0)) continue;
    const double weight = patch.area / (radius * radius) * inside * inside;
    const Vector3 weighted = weight * d;
    weights += weight;
    positions += weighted;
    normals += weight * patch.normal;
    squares.noalias() += weighted * d.transpose();
    products.noalias() += weighted * patch.normal.transpose();
    ++counted;
  }
  if (counted < 3 || !(weights > 0.0) || !(normals.norm() > 0.0)) return {};
  const Vector3 n = normals.normalized();
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) = n.unitOrthogonal();
  tangents.col(1) = n.cross(tangents.col(0));
  const Eigen::Matrix2d s =
      tangents.transpose() * (squares - positions * positions.transpose() / weights) * tangents;
  // The mean of the normals is along n, and needs no taking off.
  const Eigen::Matrix2d p = tangents.transpose() * products * tangents;
  // Least squares for the symmetric matrix (a b; b c) that takes positions to normals.
  const double trace = s.trace();
  Eigen::Matrix3d equations;
  equations << s(0, 0), s(0, 1), 0.0, s(0, 1), trace, s(0, 1), 0.0, s(0, 1), s(1, 1);
  equations.diagonal().array() += ridge * trace;
  const Vector3 right(p(0, 0), p(1, 0) + p(0, 1), p(1, 1));
  if (!(trace > 0.0)) return {};
  const Vector3 fitted = equations.ldlt().solve(right);
  const double mean = 0.5 * (fitted[0] + fitted[2]) / radius;
  const double deviation = std::hypot(0.5 * (fitted[0] - fitted[2]), fitted[1]) / radius;
  return {mean + deviation, mean - deviation};
}

}  // namespace

SurfacePatches surface_patches(const IndexedMesh& mesh, double radius) {
  const std::size_t faces = mesh.triangles.size();
  const HalfEdges edges = link_half_edges(mesh.triangles, mesh.points.size());
  std::vector<Vector3> centres(faces);
  std::vector<Vector3> vector_areas(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = mesh.triangles[f];
    const Vector3& a = mesh.points[index(t[0])];
    const Vector3& b = mesh.points[index(t[1])];
    const Vector3& c = mesh.points[index(t[2])];
    centres[f] = (a + b + c) / 3.0;
    vector_areas[f] = 0.5 * doubled_area_normal(a, b, c);
  }

  SurfacePatches patches;
  patches.of_faces.assign(faces, -1);
  std::vector<std::int32_t> grown;
  for (std::size_t first = 0; first < faces; ++first) {
    if (patches.of_faces[first] >= 0) continue;
    const auto patch = static_cast<std::int32_t>(patches.patches.size());
    grown.assign(1, static_cast<std::int32_t>(first));
    patches.of_faces[first] = patch;
    double area = 0.0;
    Vector3 moment = Vector3::Zero();
    Vector3 vector_area = Vector3::Zero();
    for (std::size_t next = 0; next < grown.size(); ++next) {
      const std::size_t face = index(grown[next]);
      const double of_face = vector_areas[face].norm();
      area += of_face;
      moment += of_face * (centres[face] - centres[first]);
      vector_area += vector_areas[face];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t opposite = edges.opposite[3 * face + k];
        if (opposite < 0) continue;
        const std::size_t other = face_of(opposite);
        if (patches.of_faces[other] >= 0) continue;
        if (!((centres[other] - centres[first]).squaredNorm() < radius * radius)) continue;
        patches.of_faces[other] = patch;
        grown.push_back(static_cast<std::int32_t>(other));
      }
    }
    SurfacePatch& made = patches.patches.emplace_back();
    made.area = area;
    made.centre = centres[first];
    if (!(area > 0.0)) continue;
    made.centre += moment / area;
    made.normal = vector_area / area;
  }

  // Pairs of patches that share an edge, each pair once in either order.
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t half_edge = 0; half_edge < 3 * faces; ++half_edge) {
    const std::int32_t opposite = edges.opposite[half_edge];
    if (opposite < 0) continue;
    const std::int32_t from = patches.of_faces[half_edge / 3];
    const std::int32_t to = patches.of_faces[face_of(opposite)];
    if (from != to) pairs.emplace_back(from, to);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  patches.neighbours =
      counting_sort(pairs.size(), patches.patches.size(),
                    [&](std::size_t i, const auto& visit) { visit(index(pairs[i].first)); });
  for (std::int32_t& item : patches.neighbours.items) item = pairs[index(item)].second;
  return patches;
}

std::vector<PrincipalCurvatures> ball_curvatures(const SurfacePatches& patches,
                                                 const std::vector<BallCentre>& centres,
                                                 double radius, const Execution& execution) {
  if (!(radius > 0.0)) {
    throw Error(ErrorCode::InvalidInput, "The radius of the balls that curvature is read in is " +
                                             format_number(radius) + "; give a positive radius.");
  }
  std::vector<PrincipalCurvatures> result(centres.size());
  // Blocks of blocks, so that the marks of a search are not made anew for a few balls.
  const std::size_t block = std::max(ball_block, centres.size() / 64 + 1);
  execution.parallel_for(centres.size(), block, [&](std::size_t begin, std::size_t end) {
    BallSearch search(patches);
    for (std::size_t i = begin; i < end; ++i) {
      const std::vector<std::int32_t>& in = search.find(centres[i], radius);
      result[i] = fit_normals(patches, in, centres[i].point, radius);
    }
  });
  return result;
}

}  // namespace wscvt
