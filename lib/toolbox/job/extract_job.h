// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "toolbox/job/bodies.h"
#include "toolbox/job/grain_job.h"
#include "toolbox/report/sample_summary.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/base/option.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/voxel_resolution.h"
#include "wscvt/report/json.h"

namespace wscvt {

inline constexpr NumberOption<double> smallest_body_option = {
    "smallest", "volume of the smallest body in % of the largest one's", 0.0, 100.0};

inline constexpr FlagOption describe_option = {
    "describe", "describe each grain",
    "in shape.csv, with the values without the error of the voxels"};

/// Counts the rows of a table of labels or bodies.
CensusStates census_states(const std::string& census);

/// Returns every option of a volume under the name that users type.
Json json_of(const VolumeOptions& options);

/// Returns what the voxels did to a scan; without rows if their size is not known, or if the biases
/// of the descriptors were measured with another smoothing. `voxel_size` of the scan, length; 0: a
/// cube of the options, if they have it.
Resolution resolution_of(const VolumeOptions& volume, double voxel_size, const IndexedMesh& scan,
                         const DetailedDescriptors& descriptors, const Execution& execution);

/// Appends what the voxels did to the sample of the table of shapes in a folder, see voxel_lines.
void append_voxel_lines(const JobFolder& folder, std::vector<std::string>& lines);

/// The closed bodies of a mesh, with the names PATH/1, PATH/2, ... in the order of the file. Its
/// census is a table of all bodies: CSV with a row per body, see lib/doc/program.md.
class BodyGrains : public GrainSource {
 public:
  /// `smallest`: volume of the smallest body that is a grain, % of the largest body's. Throws as
  /// read_mesh_file and split_bodies.
  BodyGrains(std::string path, double smallest, const Execution& execution);

  std::size_t size() const override { return taken_.size(); }
  std::string name(std::size_t grain) const override;
  std::string file(std::size_t /*grain*/) const override { return path_; }
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution) override;
  std::string census(const MadeOf& made_of) const override;
  std::size_t volumes() const override { return 1; }
  double left_out() const override { return left_out_; }  ///< share of faces in open bodies

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::string name_of(std::size_t body) const { return path_ + "/" + std::to_string(body + 1); }
  std::string row_of(std::size_t number, const std::string& file) const;
  /// Returns a warning on spikes of the bodies that are taken; empty: there are none.
  std::string stray_vertices() const;

  std::string path_;
  std::vector<MeshBody> bodies_;
  std::vector<std::size_t> taken_;
  std::vector<std::string> warnings_;
  double left_out_ = 0.0;
};

/// The mesh of each label of a volume, or each body of a mesh, as it is.
struct ExtractJob {
  std::string format = "ply";    ///< ending of the meshes
  VolumeOptions volume;          ///< of a volume
  double smallest_body = 0.0;    ///< of a mesh, see BodyGrains
  std::string table = "labels";  ///< name of the census: "labels" or "bodies"
  bool describe = false;         ///< also makes shape.csv, see shape_table.h, of scans only
};

/// Returns the job. Its table, grains.csv, has the rows of the census for the grains that are made,
/// until write_census.
GrainJob make_job(const ExtractJob& options, const std::string& folder, const Shard& shard = {});

/// Writes the census of a job that is done. Returns lines for a log. Does nothing for a part of a
/// sample.
std::vector<std::string> write_census(const ExtractJob& options, const GrainJob& job,
                                      const GrainSource& grains);

}  // namespace wscvt
