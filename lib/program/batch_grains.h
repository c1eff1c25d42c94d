// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "batch_inputs.h"
#include "volume/label_grains.h"
#include "wscvt/base/execution.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/base/mesh_attributes.h"

namespace wscvt::program {

/// A grain as it was scanned.
struct GrainScan {
  IndexedMesh mesh;
  MeshAttributes attributes;          ///< of a file; of its bodies none
  std::vector<std::string> warnings;  ///< about how it came to be
};

/// The grains that the inputs of a batch name: files of meshes, and the labels of volumes.
class BatchGrains {
 public:
  /// Of what grain_files gives. Counts the labels of volumes and, with options.parts, reads the
  /// meshes and holds the bodies of those that have several; with a line on a terminal unless
  /// quiet. Throws as LabelGrains does; a mesh that cannot be read fails later, in its row.
  BatchGrains(const std::vector<std::string>& files, const VolumeOptions& options,
              const Shard& shard, bool quiet);

  /// Of the part of the sample, in the order of the inputs. A file's is its path, a label's that of
  /// its volume, a slash and the label, a body's that of its mesh, a slash and its number, from 1.
  const std::vector<std::string>& names() const { return names_; }

  /// The labels of all volumes, and what becomes of each, as a table; empty where there is no
  /// volume. `file_of` names the file that a grain is written to.
  std::string label_table(const std::function<std::string(const std::string&)>& file_of) const;

  /// Whether so much of a volume is left out that the exit code says so.
  bool is_much_left_out() const;

  /// Says that grains before the `first` are not going to be read.
  void begin(std::size_t first);

  /// Reads a grain; each once. On several threads at once.
  /// `with_pictures`: of a file's texture too.
  GrainScan read(std::size_t grain, bool with_pictures, const Execution& execution);

 private:
  /// What a name stands for.
  struct Place {
    enum Kind { File, Label, Body } kind;
    std::size_t volume;  ///< of a label, of volumes_
    std::size_t grain;   ///< of what LabelGrains takes, or of bodies_
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
};

}  // namespace wscvt::program
