// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/surface_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

constexpr double told_excess = 0.05;
constexpr double told_noise = 0.025;      // of a surface that is bent both ways
constexpr double cosine_of_near = 0.978;  // 12 degrees

/// Faces of a mesh, their neighbours, and the means of their area vectors.
class Faces {
 public:
  explicit Faces(const IndexedMesh& mesh)
      : mesh_(mesh), opposite_(link_half_edges(mesh.triangles, mesh.points.size()).opposite) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      normals_.push_back(doubled_area_normal(mesh, t));
      area_ += normals_.back().norm();
    }
    means_ = normals_;
  }

  std::size_t count() const { return normals_.size(); }
  double area() const { return area_; }  ///< twice the mesh's
  const std::vector<Vector3>& normals() const { return normals_; }
  const std::vector<Vector3>& means() const { return means_; }

  /// Averages the area vectors with those of the neighbours. Their sum stays.
  void average(int passes) {
    std::vector<Vector3> shares(means_.size());
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t face = 0; face < means_.size(); ++face) {
        shares[face] = means_[face] / (1.0 + static_cast<double>(neighbours(face)));
      }
      for (std::size_t face = 0; face < means_.size(); ++face) {
        means_[face] = shares[face];
        for (std::size_t k = 0; k < 3; ++k) {
          const std::int32_t other = opposite_[3 * face + k];
          if (other >= 0) means_[face] += shares[face_of(other)];
        }
      }
    }
  }

  /// Returns the fraction by which the area exceeds what it has along the means.
  double excess() const {
    double along = 0.0;
    for (std::size_t face = 0; face < means_.size(); ++face) {
      const double length = means_[face].norm();
      if (length > 0.0) along += normals_[face].dot(means_[face]) / length;
    }
    constexpr double least = 1e-3;  // a surface that is folded everywhere
    return area_ / std::max(along, least * area_) - 1.0;
  }

  /// Returns the share of concave edges in the sum of all angles between faces, each times the
  /// edge's length, and the mean length of the edges.
  std::array<double, 2> concave_share_and_edge() const {
    double all = 0.0;
    double concave = 0.0;
    double lengths = 0.0;
    std::size_t edges = 0;
    for (std::size_t h = 0; h < opposite_.size(); ++h) {
      const auto here = static_cast<std::int32_t>(h);
      const std::int32_t there = opposite_[h];
      if (there < here) continue;
      const Vector3& a = mesh_.points[index(origin_of(mesh_.triangles, here))];
      const Vector3 along = mesh_.points[index(target_of(mesh_.triangles, here))] - a;
      const Vector3& apex =
          mesh_.points[index(origin_of(mesh_.triangles, previous_half_edge(there)))];
      const Vector3& one = normals_[face_of(here)];
      const Vector3& other = normals_[face_of(there)];
      const double angle = portable::atan2(one.cross(other).norm(), one.dot(other)) * along.norm();
      all += angle;
      if (one.dot(apex - a) > 0.0) concave += angle;
      lengths += along.norm();
      ++edges;
    }
    if (all == 0.0) return {0.0, 0.0};
    return {concave / all, lengths / static_cast<double>(edges)};
  }

 private:
  std::size_t neighbours(std::size_t face) const {
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) found += opposite_[3 * face + k] >= 0 ? 1 : 0;
    return found;
  }

  const IndexedMesh& mesh_;
  std::vector<std::int32_t> opposite_;
  std::vector<Vector3> normals_;  ///< of length twice the area
  std::vector<Vector3> means_;
  double area_ = 0.0;
};

/// Every so many faces are enough for a share.
std::size_t stride_of(std::size_t count, std::size_t most) {
  return std::max<std::size_t>(1, count / most);
}

/// Returns the share of the area whose `vectors` are near the axes, in either sense.
double share_along(const Eigen::Matrix3d& axes, const std::vector<Vector3>& vectors,
                   const std::vector<Vector3>& normals) {
  double all = 0.0;
  double near = 0.0;
  constexpr std::size_t most = 100000;
  for (std::size_t face = 0; face < vectors.size(); face += stride_of(vectors.size(), most)) {
    const double area = normals[face].norm();
    const double length = vectors[face].norm();
    all += area;
    const double largest = (axes.transpose() * vectors[face]).cwiseAbs().maxCoeff();
    if (length > 0.0 && largest > cosine_of_near * length) near += area;
  }
  return near / all;
}

/// Returns three orthogonal directions along which normals gather most: the best of some normals,
/// and the best of those across it.
Eigen::Matrix3d axes_of(const std::vector<Vector3>& normals) {
  constexpr std::size_t candidates = 200;
  constexpr std::size_t most = 20000;
  std::vector<Vector3> directions;
  std::vector<double> areas;
  for (std::size_t face = 0; face < normals.size(); face += stride_of(normals.size(), candidates)) {
    const double length = normals[face].norm();
    if (length == 0.0) continue;
    const Vector3 direction = normals[face] / length;
    double area = 0.0;
    for (std::size_t k = 0; k < normals.size(); k += stride_of(normals.size(), most)) {
      const double other = normals[k].norm();
      if (std::abs(direction.dot(normals[k])) > cosine_of_near * other) area += other;
    }
    directions.push_back(direction);
    areas.push_back(area);
  }
  const auto best = [&](const auto& may) {
    std::size_t found = directions.size();
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (may(k) && (found == directions.size() || areas[k] > areas[found])) found = k;
    }
    return found;
  };
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const std::size_t first = best([](std::size_t) { return true; });
  if (first == directions.size()) return axes;
  const Vector3& x = directions[first];
  constexpr double across = 0.2;
  const std::size_t second =
      best([&](std::size_t k) { return std::abs(directions[k].dot(x)) < across; });
  const Vector3 y =
      second == directions.size()
          ? Vector3(x.unitOrthogonal())
          : Vector3((directions[second] - directions[second].dot(x) * x).normalized());
  axes << x, y, x.cross(y);
  return axes;
}

/// Returns the share of the area whose normals have one of the 26 most frequent directions: all of
/// marching cubes on a mask.
double share_of_few_directions(const std::vector<Vector3>& normals) {
  constexpr double steps = 40.0;
  constexpr std::size_t few = 26;
  std::vector<std::pair<std::array<int, 3>, double>> found;
  double all = 0.0;
  for (const Vector3& normal : normals) {
    const double area = normal.norm();
    if (area == 0.0) continue;
    std::array<int, 3> key{};
    for (std::size_t k = 0; k < 3; ++k) {
      key[k] = static_cast<int>(std::lround(steps * normal[static_cast<Eigen::Index>(k)] / area));
    }
    found.emplace_back(key, area);
    all += area;
  }
  std::sort(found.begin(), found.end());
  std::vector<double> areas;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (k == 0 || found[k].first != found[k - 1].first) areas.push_back(0.0);
    areas.back() += found[k].second;
  }
  std::sort(areas.rbegin(), areas.rend());
  double sum = 0.0;
  for (std::size_t k = 0; k < std::min(few, areas.size()); ++k) sum += areas[k];
  return sum / all;
}

/// Whether a body is so large against its edges that texture can be told from its shape.
bool is_fine(const IndexedMesh& mesh, double edge) {
  constexpr std::size_t fewest = 500;
  constexpr double longest = 0.3;
  const double volume = volume_of(mesh, Execution(1));
  return mesh.triangles.size() >= fewest && volume > 0.0 &&
         edge < longest * equivalent_radius(volume);
}

}  // namespace

SurfaceTexture surface_texture(const IndexedMesh& mesh) {
  Faces faces(mesh);
  SurfaceTexture texture;
  if (!(faces.area() > 0.0)) return texture;
  faces.average(4);
  const double early = faces.excess();
  faces.average(4);
  texture.excess = faces.excess();
  if (!(texture.excess > told_noise)) return texture;
  const auto [concave, edge] = faces.concave_share_and_edge();
  if (!is_fine(mesh, edge)) return texture;
  // Bodies for these limits: tests/measures/surface_texture_test.cpp.
  constexpr double rough = 0.32;
  const Eigen::Matrix3d axes = axes_of(faces.normals());
  const double gathered = share_along(axes, faces.normals(), faces.normals());
  const double without = share_along(axes, faces.means(), faces.normals());
  const bool is_along_axes = gathered > 0.22 && gathered > 1.5 * without;
  const bool is_much = texture.excess > told_excess;
  const bool is_of_faces = concave > rough && early > 0.78 * texture.excess;
  if (is_much && is_along_axes &&
      (concave > rough || (concave > 0.15 && share_of_few_directions(faces.normals()) > 0.8))) {
    texture.kind = Texture::Steps;
  } else if (is_much ? is_of_faces || (concave > 0.46 && early > 0.6 * texture.excess)
                     : is_of_faces && concave > 0.39 && !is_along_axes) {
    texture.kind = Texture::Noise;
  }
  return texture;
}

std::string texture_sentence(const SurfaceTexture& texture, const std::string& name) {
  if (texture.kind == Texture::None) return "";
  const bool has_steps = texture.kind == Texture::Steps;
  return "The surface of " + name +
         (has_steps ? " has the steps of voxels, hardly smoothed." : " is noisy, face by face.") +
         " This makes its area at least " + format_percent(texture.excess) +
         " too large. Area, sphericity, convexity, roundness, roughness and Sdq are those of the " +
         (has_steps ? "steps, not of the grain. Volume, axes and orientation are hardly changed. "
                      "Make the mesh from the volume by wscvt extract, which smooths the steps, or "
                      "smooth it first, e.g. by Taubin's filter in MeshLab."
                    : "noise, not of the grain. Volume and axes are hardly changed. Smooth the "
                      "grey values before the surface is made, or smooth the mesh, e.g. by "
                      "Taubin's filter in MeshLab.");
}

}  // namespace wscvt
