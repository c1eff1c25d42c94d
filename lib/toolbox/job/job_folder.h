// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "toolbox/job/grain_files.h"

namespace wscvt {

/// A file of each grain in a folder of its kind.
struct JobFiles {
  std::string folder;  ///< inside the folder of the job or the level
  std::string ending;  ///< without the point
};

/// Names of the files of a job in one folder: a file per grain, and tables. The names of the tables
/// of a part of a sample end in "-I-of-N".
class JobFolder {
 public:
  /// `ending` of the files of grains, without the point. With `long_names`, the file of a label or
  /// a body is named after its volume or mesh too: "sample-12".
  JobFolder(std::filesystem::path folder, const std::string& ending, const Shard& shard,
            bool long_names = false);

  std::string path() const { return folder_.string(); }
  /// Path of the file of a grain.
  std::string file_of(const std::string& grain) const;
  std::string file_of(const std::string& grain, const JobFiles& files) const;
  /// Name of the file of a grain, without the folder.
  std::string name_of(const std::string& grain) const;
  /// Path of a table or a summary: "grains", ".csv".
  std::string file(const std::string& name, const std::string& ending) const;
  std::string table() const { return file("grains", ".csv"); }

 private:
  std::string word_of(const std::string& grain) const;

  std::filesystem::path folder_;
  std::string ending_;  ///< with the point
  std::string part_;
  bool long_names_;
};

/// Returns the format of a call.json, such as "wscvt-batch"; empty if the text is none.
std::string format_of_call(const std::string& text);

/// Throws Error(InvalidInput) if a job keeps its results in this folder. For commands that write
/// other files there.
void require_no_job(const std::string& folder);

/// Returns the options that a job, or a part of one, keeps in this folder; empty: none.
std::string kept_call(const std::string& folder);

/// Whether a job that keeps its call needs the file to continue, or other commands read it: a
/// table, a page, the call, or the file of a grain in its table (a mesh, a clump, parts, nodes, a
/// grid).
bool is_kept_by_job(const std::string& file);

/// Throws Error(InvalidInput) if one of the files `made` is a table of results of another command
/// in the folder, such as "labels.csv", or is named in one. For commands that keep no call. `own`:
/// such a table of the command itself, without ending.
void require_no_other_results(const std::string& folder, const std::string& own,
                              const std::set<std::string>& made);

/// Throws Error(InvalidInput) if the folder has a table of this name, such as "grains.csv", with
/// another first record than `header`: it is of another command, or the user's.
void require_own_table(const std::string& folder, const std::string& table,
                       const std::string& header);

/// Throws Error(InvalidInput): the folder has the results of `other`, which would be replaced.
[[noreturn]] void refuse_folder(const std::string& folder, const std::string& other);

/// The files of an earlier call, which would be taken for grains of the next one.
class OlderFiles {
 public:
  /// `tables` in the folder, in whose columns "file" they stand.
  OlderFiles(std::string folder, const std::vector<std::string>& tables);

  /// Removes all but these and the input of the call, with the hull beside a .urdf; with `formats`
  /// also but the same in another format. Returns how many, as a line for a log; nothing if there
  /// were none.
  std::vector<std::string> remove_but(const std::vector<std::string>& kept,
                                      const std::string& input, bool formats = true) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> files_;
};

}  // namespace wscvt
