// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "batch_inputs.h"
#include "grain_queue.h"
#include "toolbox/report/sample_table.h"

namespace wscvt::program {

/// Names of the files of a batch with one number of nodes.
class OutputFolder {
 public:
  /// `format`: ending of the meshes, without the point.
  OutputFolder(std::filesystem::path folder, const std::string& format, const Shard& shard);

  std::string path() const { return folder_.string(); }
  std::string mesh(const std::string& grain) const;
  std::string mesh_name(const std::string& grain) const;  ///< without the folder
  std::string table() const { return file("grains", ".csv"); }
  std::string shapes() const { return file("shape", ".csv"); }
  /// Table of the labels of the volumes; equal for every part.
  std::string labels() const { return (folder_ / "labels.csv").string(); }
  std::string call() const { return file("call", ".json"); }
  std::string summary(const std::string& ending) const { return file("summary", ending); }

 private:
  std::string file(const std::string& name, const std::string& ending) const;

  std::filesystem::path folder_;
  std::string ending_;
  std::string part_;
};

/// Meshes and tables of a batch. With several numbers of nodes, each number has a folder, such as
/// n100, which is a sample of its own.
class BatchOutput {
 public:
  /// `levels`: several numbers of nodes; empty for one.
  BatchOutput(const std::string& folder, const std::string& format, const Shard& shard,
              const std::vector<int>& levels);

  const OutputFolder& whole() const { return whole_; }
  const std::vector<OutputFolder>& levels() const { return levels_; }

  /// Refuses grains whose meshes would replace each other, or a scan. Throws Error(InvalidInput).
  void check_meshes(const std::vector<std::string>& grains) const;

  /// Opens or creates the tables and cuts all to the length of the shortest, because a killed batch
  /// may have added a row to only some of them. Returns the number of rows. Throws as SampleTable.
  /// `headers`: of grains.csv and, if shapes are described, shape.csv.
  std::size_t open_tables(const std::vector<std::string>& grains,
                          const std::vector<std::string>& headers);

  /// Whether the folder has tables of this shard, with one or several numbers of nodes.
  bool is_begun() const;

  std::size_t failed_rows() const { return tables_.front()->failed_rows(); }

  /// Adds the records of the next grain to the tables of each level: grains.csv and, if shapes are
  /// described, shape.csv.
  void append(const GrainRow& row);

  /// Removes half-written files of a killed batch, for the grains from `first` on.
  void remove_parts(const std::vector<std::string>& grains, std::size_t first) const;

 private:
  OutputFolder whole_;
  std::vector<OutputFolder> levels_;
  std::vector<std::unique_ptr<SampleTable>> tables_;
};

/// Writes the options of a batch to the file `path`. Throws Error if the batch is begun and the
/// file has other options.
void check_call(const std::string& path, const std::string& call, bool is_begun);

}  // namespace wscvt::program
