// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "batch_inputs.h"
#include "toolbox/volume/label_grains.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt::program {

/// Scan of a grain.
struct GrainScan {
  IndexedMesh mesh;
  MeshAttributes attributes;          ///< of a file; empty for its bodies
  std::vector<std::string> warnings;  ///< about reading it
};

/// Grains of the inputs of a batch: mesh files, and labels of volumes.
class BatchGrains {
 public:
  /// `files` are the result of grain_files. Counts the labels of volumes. With options.parts, reads
  /// the meshes and stores the bodies of meshes with several bodies. Shows a line on a terminal
  /// unless quiet. Throws as LabelGrains. A mesh that cannot be read fails later, in its row.
  BatchGrains(const std::vector<std::string>& files, const VolumeOptions& options,
              const Shard& shard, bool quiet);

  /// Returns the names of the grains in this part of the sample, in the order of the inputs. A file
  /// has its path, a label VOLUME/LABEL, a body MESH/NUMBER from 1.
  const std::vector<std::string>& names() const { return names_; }

  /// Returns a table of the labels of all volumes with their outcomes; empty if there is no volume.
  /// `file_of` returns the output file of a grain.
  std::string label_table(const std::function<std::string(const std::string&)>& file_of) const;

  /// Returns whether so much of a volume is left out that the exit code is SomeFailed.
  bool is_much_left_out() const;

  /// Declares that grains before `first` will not be read.
  void begin(std::size_t first);

  /// Reads a grain. Each grain may be read once, on several threads at once. `with_pictures`: also
  /// reads the pictures of a file's texture.
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution);

 private:
  /// Grain of a name.
  struct Place {
    enum Kind { File, Label, Body, Refused } kind;
    std::size_t volume;  ///< of a label, of volumes_
    std::size_t grain;   ///< index in LabelGrains::taken, bodies_ or errors_
  };

  void add_volume(const std::string& path, const VolumeOptions& options, const Shard& shard,
                  bool quiet);
  void add_mesh(const std::string& path, const VolumeOptions& options, const Shard& shard,
                bool quiet);

  std::vector<std::string> names_;
  std::vector<Place> places_;
  std::vector<std::string> paths_;  ///< of the volumes
  std::vector<std::unique_ptr<LabelGrains>> volumes_;
  std::vector<IndexedMesh> bodies_;
  std::vector<std::string> errors_;  ///< of meshes that could not be split
};

}  // namespace wscvt::program
