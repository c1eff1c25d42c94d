// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolbox/job/grain_files.h"
#include "toolbox/job/grain_run.h"
#include "toolbox/job/grain_source.h"
#include "wscvt/base/execution.h"

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

/// A grain of a job, at work.
struct GrainAtWork {
  const std::string& name;
  GrainScan scan;
  const std::vector<JobFolder>& folders;  ///< one per level
  const Execution& execution;             ///< of one thread
};

/// A table with a row per grain, see sample_table.h.
struct JobTable {
  std::string name;    ///< of the file, without ending
  std::string header;  ///< the first record
};

/// Work on each grain of a source: files for each grain, and tables with a row for each grain. The
/// bytes of the files do not depend on the number of threads. A job that was interrupted continues
/// after the last grain of its tables, or before the first grain whose file is missing, or older
/// than its scan: a scan that was replaced is worked on again. The job of a whole sample takes over
/// the rows of its parts, if they are in its folder, and makes only the other grains.
struct GrainJob {
  std::string folder;
  Shard shard;         ///< of which the source has the grains
  std::string ending;  ///< of the files of grains, without the point
  std::vector<JobFiles> more_files;
  /// Folders in the folder, such as n100, each with all files and tables. Empty: no such folders.
  std::vector<std::string> levels;
  std::string call;              ///< options that must be equal when the job is started again; JSON
  std::vector<JobTable> tables;  ///< of each level; the first is "grains"
  bool has_census = false;       ///< writes GrainSource::census to labels.csv
  bool reads_pictures = false;   ///< see GrainSource::read
  bool takes_refused = false;    ///< makes also what is refused, see GrainScan
  /// A job that is done stays done, and its folder takes no other options. False: when it is done,
  /// only its results stay, so that a call makes them anew.
  bool is_kept = true;
  bool long_names = false;  ///< see JobFolder; for several GrainSource::volumes

  /// Writes the files of a grain and returns its records: of each level, each table. Called on
  /// several threads at once. What it throws is the failure of the grain, see row_or_failure.
  std::function<std::vector<std::string>(GrainAtWork& grain)> make;
  /// Returns the records of a grain that failed, for one level.
  std::function<std::vector<std::string>(const std::string& grain, const std::string& error)>
      failed;
};

/// Returns the folders of the levels; if there are no levels, the folder of the job.
std::vector<JobFolder> folders_of(const GrainJob& job);

/// Throws Error(InvalidInput) if a job keeps its results in this folder. For commands that write
/// other files there.
void require_no_job(const std::string& folder);

/// Creates the folders and runs the job. Before the work, throws Error(InvalidInput) if files would
/// replace each other or a scan, or if the folder is of a kept job with other options or grains.
/// Throws MachineRefused if another process works on the same tables. Then throws as run_grains.
JobEnd run_job(const GrainJob& job, GrainSource& grains, const JobHost& host);

}  // namespace wscvt
