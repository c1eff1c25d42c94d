// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Mean, standard deviation (population) and extremes, in the unit of the measured quantity.
struct Statistics {
  double mean = 0.0;
  double standard_deviation = 0.0;
  double minimum = 0.0;
  double maximum = 0.0;
};

/// Equal-width histogram of `counts.size()` bins over [lower, upper]. Values outside count in the
/// end bins.
struct Histogram {
  double lower = 0.0;
  double upper = 0.0;
  std::vector<std::size_t> counts;
};

/// Quality of the triangles of a mesh.
struct MeshQuality {
  Statistics edge_length;             ///< over the edges, each once; length
  double edge_variation = 0.0;        ///< standard deviation / mean of the edge length (ECV)
  Statistics edge_ratio;              ///< longest / shortest edge over the triangles; >= 1
  double smallest_angle = 0.0;        ///< degrees
  double mean_smallest_angle = 0.0;   ///< mean over the triangles of their smallest angle, degrees
  double valence_six_fraction = 0.0;  ///< fraction of the vertices with six neighbours, 0 to 1
};

/// Measures a closed, consistently oriented mesh without edges of zero length, as check_mesh
/// returns it. Throws Error(InvalidInput) if it has no faces.
MeshQuality measure_quality(const IndexedMesh& mesh, const Execution& execution = Execution(1));

/// Distributions of edge length / mean edge length over [0, 3], of the edge ratio over [1, 3], and
/// of the triangles' angles, three per triangle, over [0, 180] degrees.
struct QualityHistograms {
  Histogram relative_edge_length;
  Histogram edge_ratio;
  Histogram angle;
};

/// Computes histograms of `bins` >= 1 bins for a mesh that measure_quality accepts. Throws
/// Error(InvalidInput) if the mesh has no faces or `bins` is 0.
QualityHistograms quality_histograms(const IndexedMesh& mesh, std::size_t bins);

/// Converts quality that was measured in units of length `unit` to plain lengths.
void scale(MeshQuality& quality, double unit);

}  // namespace wscvt
