// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/remesh.h"

/// What the study measures, as rows of cells; the first row holds the names of the columns.
namespace wscvt::study {

using Table = std::vector<std::vector<std::string>>;

inline void write_csv(const std::string& path, const Table& table) {
  std::string text;
  for (const auto& row : table) text += csv_record(row);
  write_file(path, text);
}

/// The table with a heading, for study.txt.
inline std::string as_text(const std::string& heading, const Table& table) {
  std::string text = heading + "\n\n";
  for (const std::string& line : aligned_lines(table)) text += "  " + line + "\n";
  return text + "\n";
}

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

// Each of these writes the data a figure is drawn from into `folder` and returns its summary.

/// Figure 1: the samplings of the sphere as triangles, of about 500 points.
Table write_samplings(const std::string& folder, const Scan& scan, const Execution& execution);

/// Figures 6 and 9: the scan and its remeshes, WSCVT-D with the radius and WSCVT-C with the largest
/// absolute curvature at each corner, both by the equivalent radius R (r / R and k R).
Table write_pictures(const std::string& folder, const Scan& scan, const Execution& execution);

/// Figure 7: the shares of edges by length / mean and of triangles by longest / shortest edge, for
/// each scan and its WSCVT-D remesh with as many nodes.
Table write_distributions(const std::string& folder, const std::vector<Scan>& scans,
                          const Execution& execution);

/// Each detailed descriptor on bodies whose value is known by formula (sphere, ellipsoid, box, and
/// a unit sphere with waves of one harmonic), measured on meshes of them turned at random.
struct ClosedFormErrors {
  Table all;  ///< one row a body and descriptor
  /// One row a descriptor: the largest error over the bodies, in % of the value, and where the
  /// value is 0 the largest measured (lengths in units of the sphere's radius).
  Table worst;
};
ClosedFormErrors closed_form_errors(const Execution& execution);

/// Volume and area of the NIST/VCCTL particles in a folder, integrated over their harmonics, beside
/// the values in the tables that come with the sets: every row of a *-geom.csv whose particle file
/// is there. Columns of those tables: 1 the file, 8 volume, 9 area, 13 the degree at which the
/// series is cut. Throws std::runtime_error when there is none, or a row cannot be read.
Table reference_particle_errors(const std::string& folder, const Execution& execution);

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
