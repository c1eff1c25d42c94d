// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/clump/sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "wscvt/base/error.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

using Corner = std::array<std::int64_t, 3>;

/// A grid about spheres, with the distance to their union at its points.
class UnionGrid {
 public:
  explicit UnionGrid(const std::vector<Sphere>& spheres) : spheres_(spheres) {
    Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
    Vector3 high = -low;
    double smallest = std::numeric_limits<double>::infinity();
    for (const Sphere& sphere : spheres) {
      low = low.cwiseMin((sphere.centre.array() - sphere.radius).matrix());
      high = high.cwiseMax((sphere.centre.array() + sphere.radius).matrix());
      smallest = std::min(smallest, sphere.radius);
    }
    const Vector3 size = high - low;
    spacing_ = std::max(std::min(size.maxCoeff() / 60.0, smallest / 3.0),
                        portable::cbrt(size.prod() / most_points));
    origin_ = low - 1.5 * Vector3::Constant(spacing_);
    for (int axis = 0; axis < 3; ++axis) {
      counts_[axis] = static_cast<std::int64_t>(std::ceil(size[axis] / spacing_)) + 4;
    }
    fill();
  }

  const Corner& counts() const { return counts_; }
  std::int64_t index(const Corner& c) const {
    return (c[0] * counts_[1] + c[1]) * counts_[2] + c[2];
  }
  bool is_inside(const Corner& c) const { return values_[index(c)] < 0.0; }
  Vector3 point(const Corner& c) const {
    return origin_ + spacing_ * Vector3(static_cast<double>(c[0]), static_cast<double>(c[1]),
                                        static_cast<double>(c[2]));
  }

  /// Returns the point at which the way from a point in the union to one outside first leaves it.
  /// Never at an end, so that no two vertices of the mesh coincide.
  Vector3 exit(const Vector3& from, const Vector3& to) const {
    constexpr double margin = 1e-3;
    const Vector3 way = to - from;
    double come = 0.0;
    for (bool moved = true; moved;) {
      moved = false;
      for (const Sphere& sphere : spheres_) {
        const Vector3 at = from + come * way - sphere.centre;
        // Within rounding, the point lies on this sphere.
        if (at.squaredNorm() >= sphere.radius * sphere.radius * (1.0 - 1e-12)) continue;
        const double half = at.dot(way) / way.squaredNorm();
        const double rest = (at.squaredNorm() - sphere.radius * sphere.radius) / way.squaredNorm();
        come += -half + std::sqrt(half * half - rest);
        moved = true;
      }
    }
    return from + std::clamp(come, margin, 1.0 - margin) * way;
  }

 private:
  static constexpr double most_points = 2e6;

  void fill() {
    values_.assign(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]),
                   std::numeric_limits<double>::infinity());
    for (const Sphere& sphere : spheres_) {
      Corner first;
      Corner last;
      for (int a = 0; a < 3; ++a) {
        const double from = (sphere.centre[a] - sphere.radius - origin_[a]) / spacing_;
        const double to = (sphere.centre[a] + sphere.radius - origin_[a]) / spacing_;
        first[a] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(from)));
        last[a] = std::min(counts_[a] - 1, static_cast<std::int64_t>(std::ceil(to)));
      }
      for (std::int64_t i = first[0]; i <= last[0]; ++i) {
        for (std::int64_t j = first[1]; j <= last[1]; ++j) {
          for (std::int64_t k = first[2]; k <= last[2]; ++k) {
            double& value = values_[index({i, j, k})];
            value = std::min(value, sphere.distance(point({i, j, k})));
          }
        }
      }
    }
  }

  const std::vector<Sphere>& spheres_;
  Vector3 origin_ = Vector3::Zero();
  double spacing_ = 0.0;
  Corner counts_{};
  std::vector<double> values_;
};

/// The surface between the grid points inside the union and outside. Each cell is cut into six
/// tetrahedra about its diagonal (Kuhn), whose faces match their neighbours'. A tetrahedron
/// contains no, one or two triangles.
class Tetrahedra {
 public:
  explicit Tetrahedra(const UnionGrid& grid) : grid_(grid) {}

  void add(const Corner& cell) {
    static constexpr std::array<std::array<int, 3>, 6> axes = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::size_t path = 0; path < axes.size(); ++path) {
      std::array<Corner, 4> corners;
      corners.fill(cell);
      for (std::size_t step = 0; step < 3; ++step) {
        for (std::size_t c = step + 1; c < 4; ++c) {
          ++corners[c][axes[path][step]];
        }
      }
      // Odd paths turn the tetrahedron over.
      if (path >= 3) std::swap(corners[1], corners[2]);
      cut(corners);
    }
  }

  IndexedMesh mesh;

 private:
  void cut(const std::array<Corner, 4>& corners) {
    std::array<std::size_t, 4> order{};
    std::size_t inside = 0;
    std::size_t outside = 4;
    for (std::size_t c = 0; c < 4; ++c) {
      order[grid_.is_inside(corners[c]) ? inside++ : --outside] = c;
    }
    if (inside == 0 || inside == 4) return;
    // An odd order of the corners turns the tetrahedron over.
    bool is_odd = false;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) is_odd ^= order[a] > order[b];
    }
    const auto vertex = [&](std::size_t in, std::size_t out) {
      return vertex_between(corners[order[in]], corners[order[out]]);
    };
    const auto add_triangle = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      if (is_odd) std::swap(b, c);
      mesh.triangles.push_back({a, b, c});
    };
    if (inside == 1) {
      add_triangle(vertex(0, 1), vertex(0, 2), vertex(0, 3));
    } else if (inside == 3) {
      add_triangle(vertex(0, 3), vertex(1, 3), vertex(2, 3));
    } else {
      const std::int32_t a = vertex(0, 2);
      const std::int32_t b = vertex(0, 3);
      const std::int32_t c = vertex(1, 3);
      const std::int32_t d = vertex(1, 2);
      add_triangle(a, b, c);
      add_triangle(a, c, d);
    }
  }

  std::int32_t vertex_between(const Corner& in, const Corner& out) {
    const std::int64_t a = grid_.index(in);
    const std::int64_t b = grid_.index(out);
    const std::int64_t points = grid_.counts()[0] * grid_.counts()[1] * grid_.counts()[2];
    const auto [place, is_new] = vertices_.emplace(std::min(a, b) * points + std::max(a, b),
                                                   static_cast<std::int32_t>(mesh.points.size()));
    if (is_new) mesh.points.push_back(grid_.exit(grid_.point(in), grid_.point(out)));
    return place->second;
  }

  const UnionGrid& grid_;
  std::unordered_map<std::int64_t, std::int32_t> vertices_;
};

}  // namespace

IndexedMesh sphere_union_mesh(const std::vector<Sphere>& spheres, const Execution& execution) {
  if (spheres.empty()) refuse("The clump has no spheres. Give one or more.");
  for (const Sphere& sphere : spheres) {
    if (!sphere.centre.allFinite() || !(sphere.radius > 0.0) || !std::isfinite(sphere.radius)) {
      refuse("A sphere of the clump has no finite centre or no radius above 0.");
    }
  }
  execution.report(0.0, "Making the surface of the spheres");
  const UnionGrid grid(spheres);
  Tetrahedra tetrahedra(grid);
  const Corner& counts = grid.counts();
  for (std::int64_t i = 0; i + 1 < counts[0]; ++i) {
    for (std::int64_t j = 0; j + 1 < counts[1]; ++j) {
      for (std::int64_t k = 0; k + 1 < counts[2]; ++k) tetrahedra.add({i, j, k});
    }
  }
  return std::move(tetrahedra.mesh);
}

}  // namespace wscvt
