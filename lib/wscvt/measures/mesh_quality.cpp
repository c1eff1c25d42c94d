// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/mesh_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

namespace {

constexpr std::size_t edge_block = 16384;
constexpr double degrees_per_radian = 180.0 / pi;

/// Running mean, sum of squared deviations and extremes; two of them merge by Chan, Golub and
/// LeVeque (1983), which is accurate for a small spread of large values.
class Moments {
 public:
  void add(double value) {
    ++count_;
    const double deviation = value - mean_;
    mean_ += deviation / static_cast<double>(count_);
    squares_ += deviation * (value - mean_);
    minimum_ = std::min(minimum_, value);
    maximum_ = std::max(maximum_, value);
  }

  Moments& operator+=(const Moments& other) {
    if (other.count_ == 0) return *this;
    const auto mine = static_cast<double>(count_);
    const auto theirs = static_cast<double>(other.count_);
    const double shift = other.mean_ - mean_;
    count_ += other.count_;
    mean_ += shift * theirs / (mine + theirs);
    squares_ += other.squares_ + shift * shift * mine * theirs / (mine + theirs);
    minimum_ = std::min(minimum_, other.minimum_);
    maximum_ = std::max(maximum_, other.maximum_);
    return *this;
  }

  Statistics statistics() const {
    return {mean_, std::sqrt(squares_ / static_cast<double>(count_)), minimum_, maximum_};
  }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
  double minimum_ = std::numeric_limits<double>::infinity();
  double maximum_ = -std::numeric_limits<double>::infinity();
};

struct TriangleMoments {
  Moments edge_length;
  Moments edge_ratio;
  Moments smallest_angle;

  TriangleMoments& operator+=(const TriangleMoments& other) {
    edge_length += other.edge_length;
    edge_ratio += other.edge_ratio;
    smallest_angle += other.smallest_angle;
    return *this;
  }
};

/// Edge k runs from corner k to corner k + 1.
struct TriangleEdges {
  std::array<Vector3, 3> vectors;
  std::array<double, 3> lengths;
  std::size_t shortest;
  double ratio;  ///< longest / shortest
};

TriangleEdges triangle_edges(const IndexedMesh& mesh, const Triangle& t) {
  TriangleEdges edges{};
  for (std::size_t k = 0; k < 3; ++k) {
    edges.vectors[k] = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
    edges.lengths[k] = edges.vectors[k].norm();
  }
  const auto [shortest, longest] = std::minmax_element(edges.lengths.begin(), edges.lengths.end());
  edges.shortest = static_cast<std::size_t>(shortest - edges.lengths.begin());
  edges.ratio = *longest / *shortest;
  return edges;
}

/// Returns the angle opposite to edge k in degrees, by its tangent, which is accurate near 0.
double angle_opposite(const TriangleEdges& edges, std::size_t k) {
  const Vector3& a = edges.vectors[(k + 1) % 3];
  const Vector3& b = edges.vectors[(k + 2) % 3];
  return portable::atan2(a.cross(b).norm(), -a.dot(b)) * degrees_per_radian;
}

/// Selects each edge once: in a closed oriented mesh every edge occurs once in each direction.
bool names_edge(const Triangle& t, std::size_t k) { return t[k] < t[(k + 1) % 3]; }

void require_faces(const IndexedMesh& mesh) {
  if (mesh.triangles.empty()) {
    refuse(
        "The mesh has no faces, so its quality cannot be measured. Give a closed triangle mesh.");
  }
}

void count(Histogram& histogram, double value) {
  const auto bins = static_cast<double>(histogram.counts.size());
  const double place = (value - histogram.lower) / (histogram.upper - histogram.lower) * bins;
  // NaN counts in the first bin.
  const double bin = place > 0.0 ? std::min(std::floor(place), bins - 1.0) : 0.0;
  ++histogram.counts[static_cast<std::size_t>(bin)];
}

}  // namespace

MeshQuality measure_quality(const IndexedMesh& mesh, const Execution& execution) {
  require_faces(mesh);
  const TriangleMoments moments =
      execution.parallel_sum_of(mesh.triangles.size(), edge_block, TriangleMoments(),
                                [&](std::size_t f, TriangleMoments& part) {
                                  const Triangle& t = mesh.triangles[f];
                                  const TriangleEdges edges = triangle_edges(mesh, t);
                                  for (std::size_t k = 0; k < 3; ++k) {
                                    if (names_edge(t, k)) part.edge_length.add(edges.lengths[k]);
                                  }
                                  part.edge_ratio.add(edges.ratio);
                                  part.smallest_angle.add(angle_opposite(edges, edges.shortest));
                                });

  std::vector<std::int32_t> valence(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) ++valence[v];
  }
  const auto six = std::count(valence.begin(), valence.end(), 6);

  MeshQuality quality;
  quality.edge_length = moments.edge_length.statistics();
  quality.edge_variation = quality.edge_length.standard_deviation / quality.edge_length.mean;
  quality.edge_ratio = moments.edge_ratio.statistics();
  const Statistics angles = moments.smallest_angle.statistics();
  quality.smallest_angle = angles.minimum;
  quality.mean_smallest_angle = angles.mean;
  quality.valence_six_fraction = static_cast<double>(six) / static_cast<double>(valence.size());
  return quality;
}

QualityHistograms quality_histograms(const IndexedMesh& mesh, std::size_t bins) {
  require_faces(mesh);
  if (bins == 0) refuse("A histogram needs at least one bin, not 0.");
  Moments lengths;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (names_edge(t, k)) lengths.add((mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]).norm());
    }
  }
  const double mean = lengths.statistics().mean;

  QualityHistograms histograms;
  histograms.relative_edge_length = {0.0, 3.0, std::vector<std::size_t>(bins, 0)};
  histograms.edge_ratio = {1.0, 3.0, std::vector<std::size_t>(bins, 0)};
  histograms.angle = {0.0, 180.0, std::vector<std::size_t>(bins, 0)};
  for (const Triangle& t : mesh.triangles) {
    const TriangleEdges edges = triangle_edges(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      if (names_edge(t, k)) count(histograms.relative_edge_length, edges.lengths[k] / mean);
      count(histograms.angle, angle_opposite(edges, k));
    }
    count(histograms.edge_ratio, edges.ratio);
  }
  return histograms;
}

void scale(MeshQuality& quality, double unit) {
  quality.edge_length.mean *= unit;
  quality.edge_length.standard_deviation *= unit;
  quality.edge_length.minimum *= unit;
  quality.edge_length.maximum *= unit;
}

}  // namespace wscvt
