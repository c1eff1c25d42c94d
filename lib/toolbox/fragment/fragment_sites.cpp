// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "toolbox/fragment/cell_complex.h"
#include "toolbox/sample/given_sizes.h"
#include "toolbox/sample/random_stream.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

void check_options(const FragmentOptions& options) {
  require_in_range(options.count, fragment_count_option);
  const auto count = static_cast<std::size_t>(options.count);
  if (!options.volumes.empty() && options.volumes.size() != count) {
    refuse("There are " + std::to_string(options.volumes.size()) + " volumes for " +
           std::to_string(count) + " fragments. Give one for each fragment.");
  }
  for (const double volume : options.volumes) {
    if (volume > 0.0 && std::isfinite(volume)) continue;
    refuse("A fragment's volume is " + format_typed(volume) + ". Give volumes above 0.");
  }
  for (const Vector3& point : options.near) {
    if (!point.allFinite()) refuse("A point near which fragments are smaller is not a number.");
  }
  if (!options.volumes.empty() && !options.near.empty()) {
    refuse(
        "There are volumes of the fragments and points near which they are smaller. Give one of "
        "them.");
  }
}

std::vector<double> fragment_volumes(const GivenSizes& sizes, int count) {
  std::vector<double> volumes;
  for (int k = 0; k < count; ++k) {
    const double diameter = sizes.diameter((k + 0.5) / count);
    volumes.push_back(diameter * diameter * diameter);
  }
  return volumes;
}

namespace {

/// Whether the place lies in the triangle seen along z. Triangles with a common edge agree on it.
bool covers(const IndexedMesh& mesh, const Triangle& t, double x, double y) {
  bool inside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [i, j] = std::minmax(t[k], t[(k + 1) % 3]);
    const Vector3& a = mesh.points[i];
    const Vector3& b = mesh.points[j];
    if ((a.y() > y) == (b.y() > y)) continue;
    if (x < a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double height_at(const IndexedMesh& mesh, const Triangle& t, double x, double y) {
  const auto [a, b, c] = corners_of(mesh, t);
  const Vector3 normal = doubled_area_normal(a, b, c);
  const double height = a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
  const auto [low, high] = std::minmax({a.z(), b.z(), c.z()});
  // Of a triangle along z the height is only rounding.
  return std::isfinite(height) ? std::clamp(height, low, high) : 0.5 * (low + high);
}

}  // namespace

std::vector<Vector3> points_in(const IndexedMesh& mesh, double volume, std::size_t count) {
  const double spacing = portable::cbrt(volume / static_cast<double>(count));
  const Eigen::AlignedBox3d box = box_of(mesh.points);
  const Vector3 low = box.min();
  const auto lines = [&](int axis) {
    return static_cast<std::size_t>(std::ceil(box.sizes()[axis] / spacing)) + 1;
  };
  const std::size_t rows = lines(0);
  const std::size_t columns = lines(1);
  std::vector<std::vector<double>> heights(rows * columns);
  for (const Triangle& t : mesh.triangles) {
    Eigen::AlignedBox3d about;
    for (const std::int32_t v : t) about.extend(mesh.points[v]);
    const auto first = [&](int axis) {
      return static_cast<std::size_t>(std::floor((about.min() - low)[axis] / spacing));
    };
    for (std::size_t i = first(0); i < rows; ++i) {
      const double x = low.x() + spacing * static_cast<double>(i);
      if (x > about.max().x()) break;
      for (std::size_t j = first(1); j < columns; ++j) {
        const double y = low.y() + spacing * static_cast<double>(j);
        if (y > about.max().y()) break;
        if (covers(mesh, t, x, y)) heights[i * columns + j].push_back(height_at(mesh, t, x, y));
      }
    }
  }
  std::vector<Vector3> points;
  for (std::size_t line = 0; line < heights.size(); ++line) {
    std::vector<double>& ends = heights[line];
    std::sort(ends.begin(), ends.end());
    const double shift = plastic_point(line).x();  // points of neighbours are not in planes
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
      for (double n = std::ceil((ends[k] - low.z()) / spacing - shift);; ++n) {
        const double z = low.z() + spacing * (n + shift);
        if (!(z < ends[k + 1])) break;
        const std::size_t row = line / columns;
        points.emplace_back(low.x() + spacing * static_cast<double>(row),
                            low.y() + spacing * static_cast<double>(line % columns), z);
      }
    }
  }
  return points;
}

namespace {

/// The sites and the points whose cells they are moved by. Lengths over the equivalent radius, in
/// the principal frame.
class SiteFit {
 public:
  SiteFit(std::vector<Vector3> points, const FragmentOptions& options,
          const std::vector<Vector3>& near, const Execution& execution)
      : points_(std::move(points)),
        options_(options),
        execution_(execution),
        loads_(points_.size(), 1.0),
        owners_(points_.size(), 0) {
    for (std::size_t p = 0; p < points_.size() && !near.empty(); ++p) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3& q : near) nearest = std::min(nearest, (points_[p] - q).norm());
      loads_[p] = portable::pow(nearest + 0.2, -5.0);
    }
    start();
  }

  std::vector<CellSite> run() {
    // Sites come to rest in some ten steps; weights that follow their volumes take more.
    const int steps = options_.volumes.empty() ? 40 : 120;
    for (int step = 0; step < steps; ++step) {
      execution_.report(static_cast<double>(step) / steps, "Placing fragments");
      assign();
      move();
    }
    return sites_;
  }

 private:
  /// Draws the sites from the points, more where cells are to be small: the points with the
  /// largest u^(1 / w) of w, their load to the power 3/5 (Efraimidis and Spirakis 2006).
  void start() {
    const auto count = static_cast<std::size_t>(options_.count);
    if (points_.size() < count) {
      throw Error(ErrorCode::NumericalFailure,
                  "The grain is too thin for " + std::to_string(count) +
                      " fragments. Give a smaller number of fragments.");
    }
    RandomStream random(options_.seed, 0);
    std::vector<double> keys;
    for (const double load : loads_) {
      keys.push_back(portable::log(1.0 - random.uniform()) / portable::pow(load, 0.6));
    }
    std::vector<std::size_t> order(points_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return keys[a] > keys[b]; });
    const double sum = std::accumulate(options_.volumes.begin(), options_.volumes.end(), 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      sites_.push_back({points_[order[k]], 0.0});
      if (options_.volumes.empty()) continue;
      shares_.push_back(options_.volumes[k] / sum);
      radii_.push_back(portable::cbrt(shares_[k]));
      sites_[k].weight = radii_[k] * radii_[k];  // cells meet where balls of their size touch
    }
  }

  void assign() {
    execution_.parallel_for_each(points_.size(), 256, [&](std::size_t p) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < sites_.size(); ++k) {
        const double distance = (points_[p] - sites_[k].point).squaredNorm() - sites_[k].weight;
        if (!(distance < least)) continue;
        least = distance;
        owners_[p] = k;
      }
    });
  }

  void move() {
    std::vector<Vector3> moments(sites_.size(), Vector3::Zero());
    std::vector<double> sums(sites_.size(), 0.0);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      moments[owners_[p]] += loads_[p] * points_[p];
      sums[owners_[p]] += loads_[p];
    }
    for (std::size_t k = 0; k < sites_.size(); ++k) {
      if (sums[k] > 0.0) sites_[k].point = moments[k] / sums[k];
      if (shares_.empty()) continue;
      // The volume grows with the weight by the walls' area over twice the sites' distance: for
      // balls, volume 4/3 pi r^3, by pi r.
      const double volume = sums[k] / static_cast<double>(points_.size());
      sites_[k].weight += 0.4 * (4.0 / 3.0) * (shares_[k] - volume) / radii_[k];
    }
  }

  std::vector<Vector3> points_;
  const FragmentOptions& options_;
  const Execution& execution_;
  std::vector<double> loads_;
  std::vector<std::size_t> owners_;  ///< site of each point
  std::vector<double> shares_;       ///< of the volume; empty: about equal
  std::vector<double> radii_;
  std::vector<CellSite> sites_;
};

}  // namespace

std::vector<CellSite> fragment_sites(const IndexedMesh& mesh, const ShapeDescriptors& shape,
                                     const FragmentOptions& options, const Execution& execution) {
  constexpr std::size_t least_points = 20000;
  constexpr std::size_t points_per_fragment = 60;
  const double radius = equivalent_radius(shape.volume);
  const Eigen::Quaterniond to_frame = shape.principal_axes.conjugate();
  const auto placed = [&](const Vector3& p) {
    return Vector3(to_frame * (p - shape.centroid) / radius);
  };
  IndexedMesh unit = mesh;
  for (Vector3& p : unit.points) p = placed(p);
  std::vector<Vector3> near;
  for (const Vector3& p : options.near) near.push_back(placed(p));
  const std::size_t count =
      std::max(least_points, points_per_fragment * static_cast<std::size_t>(options.count));
  std::vector<CellSite> sites =
      SiteFit(points_in(unit, 4.0 / 3.0 * pi, count), options, near, execution).run();
  for (CellSite& site : sites) {
    site.point = shape.centroid + radius * (shape.principal_axes * site.point);
    site.weight *= radius * radius;
  }
  return sites;
}

}  // namespace wscvt
