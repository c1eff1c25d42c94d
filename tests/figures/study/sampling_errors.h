// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "figures/study/table.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/remesh.h"

namespace wscvt::study {

struct Scan {
  std::string name;
  IndexedMesh mesh;
};

/// A sampling as the paper names it.
struct Method {
  std::string name;
  Sampling sampling;
  Weighting weighting;
};
inline const Method wscvt_d = {"WSCVT-D", Sampling::Weighted, Weighting::RadialDistance};
inline const Method wscvt_c = {"WSCVT-C", Sampling::Weighted, Weighting::Curvature};
inline const Method constant = {"constant", Sampling::Weighted, Weighting::Constant};
inline const Method fibonacci = {"Fibonacci", Sampling::Fibonacci, Weighting::Constant};

/// The paper's method with its own choices: series of degree 20, nodes on it.
RemeshOptions paper_options(const Method& method, int node_count);

/// Errors of the remeshes of each scan in several poses (the first as it lies, the others turned at
/// random), by sampling and number of nodes.
struct SamplingErrors {
  /// Figures 8 and 10: one row a scan, sampling, N and measure. Errors are means over the poses of
  /// the absolute error in %, against the scan and against the fitted surface; the last column is
  /// the largest against the scan. `paper_percent` is what the paper prints (WSCVT-D, on grains of
  /// its own).
  Table errors;
  /// Sdq of each scan and of its fitted surface, and the range over the poses of the form printed
  /// in the paper (eq. 17), which should not depend on the pose.
  Table roughness;
  /// Share of the nodes (N = 2000, as the scan lies) and of the scan's area farther than 1.25 R
  /// from the centre, R the equivalent radius, in %: where the samplings send their nodes.
  Table far_nodes;
};
SamplingErrors sampling_errors(const std::vector<Scan>& scans, int poses,
                               const Execution& execution);

}  // namespace wscvt::study
