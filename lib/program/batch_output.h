// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "batch_command.h"
#include "grain_queue.h"
#include "wscvt/report/sample_table.h"

namespace wscvt::program {

/// The names of the files of a batch with one number of nodes.
class OutputFolder {
 public:
  OutputFolder(std::filesystem::path folder, const BatchArguments& arguments);

  std::string path() const { return folder_.string(); }
  std::string mesh(const std::string& grain) const;
  std::string mesh_name(const std::string& grain) const;  ///< without the folder
  std::string table() const { return file("grains", ".csv"); }
  std::string shapes() const { return file("shape", ".csv"); }
  /// The same for every part: what a volume holds.
  std::string labels() const { return (folder_ / "labels.csv").string(); }
  std::string call() const { return file("call", ".json"); }
  std::string summary(const std::string& ending) const { return file("summary", ending); }

 private:
  std::string file(const std::string& name, const std::string& ending) const;

  std::filesystem::path folder_;
  std::string ending_;
  std::string part_;
};

/// Where a batch puts its meshes and tables. With several numbers of nodes each has a folder, such
/// as n100, and each folder is a sample of its own.
class BatchOutput {
 public:
  explicit BatchOutput(const BatchArguments& arguments);

  const OutputFolder& whole() const { return whole_; }
  const std::vector<OutputFolder>& levels() const { return levels_; }

  /// Refuses grains whose meshes would replace each other, or a scan. Throws Error(InvalidInput).
  void check_meshes(const std::vector<std::string>& grains) const;

  /// Opens or begins the tables. All are cut to as many rows as the shortest has: a killed batch
  /// may have added a row to some of them only. Returns this number. Throws as SampleTable does.
  std::size_t open_tables(const std::vector<std::string>& grains, const BatchArguments& arguments);

  std::size_t failed_rows() const { return tables_.front()->failed_rows(); }

  /// Adds the records of the next grain to the tables: of each level the row of its table and, if
  /// shapes are described, the row of its shapes.
  void append(const GrainRow& row);

  /// Removes half-written files that a killed batch left, of the grains from `first` on.
  void remove_parts(const std::vector<std::string>& grains, std::size_t first) const;

 private:
  OutputFolder whole_;
  std::vector<OutputFolder> levels_;
  std::vector<std::unique_ptr<SampleTable>> tables_;
};

/// Notes in the file `path` what a batch was called with, or refuses a batch that is begun and was
/// called otherwise. Throws Error.
void check_call(const std::string& path, const std::string& call, bool is_begun);

}  // namespace wscvt::program
