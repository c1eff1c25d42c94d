// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "toolbox/job/grain_job.h"
#include "toolbox/sample/templates.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"

namespace wscvt {

/// Grains of a sample with the descriptors for the choice of templates.
struct DescribedSample {
  std::vector<std::string> files;  ///< of the grains: meshes or SH coefficients
  std::vector<double> diameters;   ///< of the spheres of equal volume, length
  Eigen::MatrixXd descriptors;     ///< grains x names
  std::size_t left_out = 0;
  /// Files that another call has measured; of these, templates have the volume of the diameter.
  std::set<std::string> measured_before = {};
};

/// K grains that represent a sample, as files in a folder.
struct TemplateJob {
  std::string folder;
  Shard shard;
  std::string format = "ply";  ///< ending of the meshes
  int nodes = 500;             ///< of each mesh
  std::vector<std::string> descriptors = {"sphericity_wadell", "zingg_elongation_inertia",
                                          "zingg_flatness_inertia", "convexity"};
  TemplateOptions options;
};

/// Returns the size curve of grains as a table: equivalent diameter and percentage finer by mass,
/// from 0 at the smallest grain to 100 at the largest, in steps of 2 %: Distribution::quantile by
/// mass, made ascending by parts of 1e-8. read_given_sizes reads it.
/// Diameters above 0, length; throws Error(InvalidInput) if there are none.
std::string size_curve_csv(const std::vector<double>& diameters);

/// Returns the same curve for MercuryDPM, PSD::setPSDFromCSV with CUMULATIVE_VOLUME_DISTRIBUTION:
/// radius and fraction finer by volume, without a heading.
std::string mercury_psd_csv(const std::vector<double>& diameters);

/// Throws Error(InvalidInput) if a template's file would replace one of the sample's files.
void require_scans_kept(const TemplateJob& job, const std::vector<std::string>& sample);

/// Chooses the templates and writes a mesh of each, templates.csv, sizes.csv and distances.csv, and
/// mercury_psd.csv for MercuryDPM. `read` returns the closed mesh of a file of the sample, on
/// several threads at once. Throws as run_job and choose_templates, and for the first template that
/// cannot be made, also because its file is not the one that was measured before.
MadeSample make_templates(
    const TemplateJob& options, const DescribedSample& sample,
    const std::function<IndexedMesh(const std::string& file, const Execution& execution)>& read,
    const JobHost& host);

}  // namespace wscvt
