// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "toolbox/job/grain_run.h"
#include "toolbox/job/grain_source.h"
#include "toolbox/job/job_folder.h"
#include "wscvt/base/execution.h"

namespace wscvt {

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
/// after the last grain of its tables, or before the first grain one of whose files is missing,
/// empty, cut, or older than its scan: a scan that was replaced is worked on again. The job of a
/// whole sample takes over the rows of its parts, if they are in its folder with the files of the
/// grains, and makes only the other grains.
struct GrainJob {
  std::string folder;
  Shard shard;         ///< of which the source has the grains
  std::string ending;  ///< of the files of grains, without the point
  std::vector<JobFiles> more_files = {};
  /// Returns the files that are made beside the file of a grain, as many as there may be; none: {}.
  std::function<std::vector<std::string>(const std::string& file)> beside = {};
  /// Folders in the folder, such as n100, each with all files and tables. Empty: no such folders.
  std::vector<std::string> levels = {};
  std::string call = {};  ///< options that must be equal when the job is started again; JSON
  /// Of each level; the first is "grains". Headings in "[length^2]" get GrainSource::unit,
  /// "[um^2]", if it is known.
  std::vector<JobTable> tables = {};
  JobTable last_table = {};     ///< that the caller makes of the first; without a name: none
  bool has_census = false;      ///< writes GrainSource::census to labels.csv
  bool reads_pictures = false;  ///< see GrainSource::read
  bool takes_refused = false;   ///< makes also what is refused, see GrainScan
  /// A job that is done stays done, and its folder takes no other options. False: when it is done,
  /// only its results stay, so that a call makes them anew.
  bool is_kept = true;
  bool long_names = false;  ///< see JobFolder; for several GrainSource::volumes

  /// Writes the files of a grain and returns its records: of each level, each table. Called on
  /// several threads at once. What it throws is the failure of the grain, see row_or_failure.
  std::function<std::vector<std::string>(GrainAtWork& grain)> make = {};
  /// Returns the records of a grain that failed, for one level. Empty: the first failure ends the
  /// run.
  std::function<std::vector<std::string>(const std::string& grain, const std::string& error)>
      failed = {};
};

/// Returns the folders of the levels; if there are no levels, the folder of the job.
std::vector<JobFolder> folders_of(const GrainJob& job);

/// Throws Error(InvalidInput) if a file of a grain of the job would replace one of `scans`, of
/// which the grains are made. For a source whose grains have no files of their own.
void require_scans_kept(const GrainJob& job, const GrainSource& grains,
                        const std::vector<std::string>& scans);

/// Result of a job that makes grains of a sample.
struct MadeSample {
  JobEnd end;
  std::vector<std::string> lines;  ///< for a log; empty if cancelled, or for a part of the grains
};

/// Creates the folders and runs the job. Before the work, throws Error(InvalidInput) if files would
/// replace each other or a scan, or if the folder is of a kept job with other options or grains.
/// Throws MachineRefused if another process works on the same tables. Then throws as run_grains.
JobEnd run_job(GrainJob job, GrainSource& grains, const JobHost& host);

/// Returns the number of grains with warnings in the first table that a job has written.
std::size_t grains_with_warnings(const GrainJob& job);

}  // namespace wscvt
