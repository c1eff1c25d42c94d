// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/ball_curvature.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr std::size_t ball_block = 64;

/// Added to the diagonal of the fit, as a fraction of its trace. If the patches lie in one line,
/// the curvature across it is unknown; this makes it 0.
constexpr double ridge = 1e-9;

/// Four numbers, so that the processor handles two at a time.
using Row = Eigen::Vector4d;

/// Sums over the patches of a ball about a point: of weights, positions, normals and their
/// products, in units of the ball against underflow. They are projected to the tangent plane at the
/// end, because the normal is known only then.
struct BallSums {
  /// For each coordinate of the positions, then of the normals: the weighted sums of its product
  /// with the position and of itself.
  std::array<Row, 6> products;
  double weights = 0.0;
  std::size_t counted = 0;

  BallSums() { products.fill(Row::Zero()); }

  void add(const SurfacePatch& patch, const Vector3& from_centre, double square, double inverse) {
    const double inside = 1.0 - square * inverse * inverse;
    if (!(inside > 0.0)) return;
    const double weight = patch.area * inverse * inverse * inside * inside;
    const Vector3 d = from_centre * inverse;
    Row weighted;
    weighted << weight * d, weight;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      products[k] += d[axis] * weighted;
      products[k + 3] += patch.normal[axis] * weighted;
    }
    weights += weight;
    ++counted;
  }
};

/// Finds the connected patches in a ball. Use one per thread, because it keeps marks.
class BallSearch {
 public:
  explicit BallSearch(const SurfacePatches& patches)
      : patches_(patches),
        seen_in_(patches.patches.size(), 0),
        found_(new Found[patches.patches.size() + 1]),
        beyond_(new Found[patches.patches.size() + 1]) {}

  /// Sums over the patches that can be reached inside each ball from the first patch, which always
  /// counts. `radii` ascend.
  void sum(const BallCentre& centre, const std::vector<double>& radii,
           std::vector<BallSums>& sums) {
    ++ball_;
    std::size_t count = 1;
    found_[0] = found(centre.patch, centre.point);
    seen_in_[index(centre.patch)] = ball_;
    std::size_t next = 0;
    std::size_t left = 0;  // neighbours of found patches outside the ball
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const double square = radii[k] * radii[k];
      const double inverse = 1.0 / radii[k];
      // Patches that the smaller ball left out and this ball contains are new starts.
      const std::size_t before = left;
      left = 0;
      for (std::size_t i = 0; i < before; ++i) {
        const Found one = beyond_[i];
        if (one.square < square) {
          found_[count++] = one;
        } else {
          beyond_[left++] = one;
        }
      }
      for (; next < count; ++next) {
        const std::size_t patch = index(found_[next].patch);
        const std::int32_t* const end = patches_.neighbours.end(patch);
        for (const std::int32_t* n = patches_.neighbours.begin(patch); n != end; ++n) {
          if (seen_in_[index(*n)] == ball_) continue;
          seen_in_[index(*n)] = ball_;
          // Write to both lists and advance only one, because a processor cannot predict the
          // branch.
          const Found one = found(*n, centre.point);
          const bool inside = one.square < square;
          found_[count] = one;
          beyond_[left] = one;
          count += inside ? 1 : 0;
          left += inside ? 0 : 1;
        }
      }
      BallSums ball;  // not in place, so that it stays in registers
      for (std::size_t i = 0; i < count; ++i) {
        const Found& one = found_[i];
        ball.add(patches_.patches[index(one.patch)], one.from_centre, one.square, inverse);
      }
      sums[k] = ball;
    }
  }

 private:
  struct Found {
    Vector3 from_centre;
    double square;
    std::int32_t patch;
  };

  Found found(std::int32_t patch, const Vector3& centre) const {
    const Vector3 d = patches_.patches[index(patch)].centre - centre;
    return {d, d.squaredNorm(), patch};
  }

  const SurfacePatches& patches_;
  std::vector<std::uint32_t> seen_in_;
  std::uint32_t ball_ = 0;
  // Not vectors, because vectors would be filled again for each block.
  std::unique_ptr<Found[]> found_;
  std::unique_ptr<Found[]> beyond_;
};

PrincipalCurvatures fit_normals(const BallSums& sums, double radius) {
  const double weights = sums.weights;
  const std::size_t counted = sums.counted;
  Vector3 positions;
  Vector3 normals;
  Eigen::Matrix3d squares;   // of positions
  Eigen::Matrix3d products;  // position times normal
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Row& position = sums.products[static_cast<std::size_t>(k)];
    const Row& normal = sums.products[static_cast<std::size_t>(k) + 3];
    squares.col(k) = position.head<3>();
    positions[k] = position[3];
    products.col(k) = normal.head<3>();
    normals[k] = normal[3];
  }
  if (counted < 3 || !(weights > 0.0) || !(normals.norm() > 0.0)) return {};
  const Vector3 n = normals.normalized();
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) = n.unitOrthogonal();
  tangents.col(1) = n.cross(tangents.col(0));
  const Eigen::Matrix2d s =
      tangents.transpose() * (squares - positions * positions.transpose() / weights) * tangents;
  // The mean of the normals is along n, so it need not be subtracted.
  const Eigen::Matrix2d p = tangents.transpose() * products * tangents;
  // Least squares for the symmetric matrix (a b; b c) that maps positions to normals.
  const double trace = s.trace();
  Eigen::Matrix3d equations;
  equations << s(0, 0), s(0, 1), 0.0, s(0, 1), trace, s(0, 1), 0.0, s(0, 1), s(1, 1);
  equations.diagonal().array() += ridge * trace;
  const Vector3 right(p(0, 0), p(1, 0) + p(0, 1), p(1, 1));
  if (!(trace > 0.0)) return {};
  const Vector3 fitted = equations.ldlt().solve(right);
  const double mean = 0.5 * (fitted[0] + fitted[2]) / radius;
  const double deviation = portable::hypot(0.5 * (fitted[0] - fitted[2]), fitted[1]) / radius;
  return {mean + deviation, mean - deviation};
}

/// Finds the neighbours of each patch across edges.
void link_patches(const HalfEdges& edges, SurfacePatches& patches) {
  const std::size_t count = patches.patches.size();
  const auto beyond = [&](std::size_t half_edge) {
    const std::int32_t opposite = edges.opposite[half_edge];
    return opposite < 0 ? -1 : patches.of_faces[face_of(opposite)];
  };
  Groups& neighbours = patches.neighbours;
  neighbours =
      counting_sort(edges.opposite.size(), count, [&](std::size_t half_edge, const auto& visit) {
        const std::int32_t from = patches.of_faces[half_edge / 3];
        const std::int32_t to = beyond(half_edge);
        if (to >= 0 && to != from) visit(index(from));
      });
  for (std::int32_t& item : neighbours.items) item = beyond(index(item));
  // Keep each neighbour once.
  std::size_t kept = 0;
  std::size_t begin = 0;
  for (std::size_t patch = 0; patch < count; ++patch) {
    const auto first = neighbours.items.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::size_t end = neighbours.starts[patch + 1];
    const auto last = neighbours.items.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(first, last);
    const auto unique = std::unique(first, last);
    std::copy(first, unique, neighbours.items.begin() + static_cast<std::ptrdiff_t>(kept));
    neighbours.starts[patch] = kept;
    kept += static_cast<std::size_t>(unique - first);
    begin = end;
  }
  neighbours.starts[count] = kept;
  neighbours.items.resize(kept);
}

/// The faces by their distance from the mean of their centres, so that neither the order of the
/// faces in a file nor a rotation decides where a patch starts.
std::vector<std::int32_t> from_the_farthest(const std::vector<Vector3>& centres) {
  Vector3 middle = Vector3::Zero();
  for (const Vector3& centre : centres) middle += centre;
  middle /= static_cast<double>(std::max<std::size_t>(centres.size(), 1));
  std::vector<std::pair<double, std::int32_t>> order;
  order.reserve(centres.size());
  for (const Vector3& centre : centres) {
    order.emplace_back(-(centre - middle).squaredNorm(), static_cast<std::int32_t>(order.size()));
  }
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> faces;
  faces.reserve(order.size());
  for (const auto& [distance, face] : order) faces.push_back(face);
  return faces;
}

}  // namespace

SurfacePatches surface_patches(const IndexedMesh& mesh, double radius) {
  const std::size_t faces = mesh.triangles.size();
  const HalfEdges edges = link_half_edges(mesh.triangles, mesh.points.size());
  std::vector<Vector3> centres(faces);
  std::vector<Vector3> vector_areas(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const auto [a, b, c] = corners_of(mesh, f);
    centres[f] = (a + b + c) / 3.0;
    vector_areas[f] = 0.5 * doubled_area_normal(a, b, c);
  }

  SurfacePatches patches;
  patches.of_faces.assign(faces, -1);
  std::vector<std::int32_t> grown;
  for (const std::int32_t start : from_the_farthest(centres)) {
    const std::size_t first = index(start);
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

  link_patches(edges, patches);
  return patches;
}

std::vector<std::vector<PrincipalCurvatures>> ball_curvatures(
    const SurfacePatches& patches, const std::vector<BallCentre>& centres,
    const std::vector<double>& radii, const Execution& execution) {
  for (const double radius : radii) {
    if (radius > 0.0) continue;
    refuse("The radius of the balls for curvature is " + format_number(radius) +
           ". Give a positive radius.");
  }
  std::vector<std::vector<PrincipalCurvatures>> result(
      radii.size(), std::vector<PrincipalCurvatures>(centres.size()));
  // Large blocks, so that the marks of a search serve many balls.
  const std::size_t block = std::max(ball_block, centres.size() / 64 + 1);
  execution.parallel_for(centres.size(), block, [&](std::size_t begin, std::size_t end) {
    BallSearch search(patches);
    std::vector<BallSums> sums(radii.size());
    for (std::size_t i = begin; i < end; ++i) {
      search.sum(centres[i], radii, sums);
      for (std::size_t k = 0; k < radii.size(); ++k) {
        result[k][i] = fit_normals(sums[k], radii[k]);
      }
    }
  });
  return result;
}

}  // namespace wscvt
