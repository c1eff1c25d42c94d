// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_job.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <system_error>
#include <utility>

#include "toolbox/report/sample_table.h"
#include "wscvt/base/error.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Returns the name of a grain without folders and endings.
std::string word_of(const std::string& grain) {
  fs::path name = fs::path(grain).filename();
  if (ending_of(grain) == ".gz") name = name.stem();
  return name.stem().string();
}

/// Refuses grains whose files would replace each other, or a scan.
void check_files(const JobFolder& folder, const std::vector<JobFiles>& more,
                 const std::vector<std::string>& grains) {
  std::map<std::string, const std::string*> made;
  for (const std::string& grain : grains) {
    const auto [other, is_new] = made.emplace(folder.file_of(grain), &grain);
    if (!is_new) {
      refuse("\"" + *other->second + "\" and \"" + grain + "\" would both be written to \"" +
             other->first + "\". Use two batches, or rename one of them.");
    }
    bool replaces_scan = same_file(other->first, grain);
    for (const JobFiles& files : more) {
      replaces_scan = replaces_scan || same_file(folder.file_of(grain, files), grain);
    }
    if (replaces_scan) {
      refuse("The files of \"" + grain + "\" would replace the scan. Give another folder with " +
             mention("output") + ", or another " + mention("format") + ".");
    }
  }
}

/// Whether the folder has tables of this part, with or without levels.
bool is_begun(const JobFolder& folder) {
  std::error_code ignored;
  const fs::path table = folder.table();
  if (fs::exists(table, ignored)) return true;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path(), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_level = name.size() > 1 && name.front() == 'n' &&
                          name.find_first_not_of("0123456789", 1) == std::string::npos;
    if (is_level && fs::exists(entry.path() / table.filename(), ignored)) return true;
  }
  return false;
}

/// Writes the options of a job. Throws Error if the job is begun with other options.
void check_call(const JobFolder& folder, const std::string& call) {
  const std::string path = folder.file("call", ".json");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno != ENOENT && errno != ENOTDIR) refuse_to_read(path);
  const std::string before((std::istreambuf_iterator<char>(file)), {});
  if (before == call) return;
  if (is_begun(folder)) {
    refuse("The folder contains a batch with other options or of another version: see \"" + path +
           "\". Use the options of that file, or give another folder with " + mention("output") +
           ".");
  }
  write_file(path, call);
}

/// The tables of all levels.
class JobTables {
 public:
  /// Opens or creates the tables and cuts all to the length of the shortest, because a killed job
  /// may have added a row to only some of them.
  JobTables(const std::vector<JobFolder>& folders, const std::vector<JobTable>& tables,
            const std::vector<std::string>& grains)
      : rows_(grains.size()) {
    for (const JobFolder& folder : folders) {
      for (const JobTable& table : tables) {
        tables_.push_back(
            std::make_unique<SampleTable>(folder.file(table.name, ".csv"), table.header, grains));
        rows_ = std::min(rows_, tables_.back()->rows());
      }
    }
    for (const auto& table : tables_) table->keep(rows_);
  }

  /// Number of rows found.
  std::size_t rows() const { return rows_; }
  std::size_t failed_rows() const { return tables_.front()->failed_rows(); }

  void append(const std::vector<std::string>& records) {
    // The first table is written last, because its row marks the grain as done.
    for (std::size_t k = tables_.size(); k-- > 0;) tables_[k]->append(records.at(k));
  }

 private:
  std::size_t rows_;
  std::vector<std::unique_ptr<SampleTable>> tables_;
};

/// Removes half-written files of a killed job, for the grains from `first` on.
void remove_parts(const GrainJob& job, const std::vector<JobFolder>& folders,
                  const std::vector<std::string>& grains, std::size_t first) {
  for (const JobFolder& folder : folders) {
    for (std::size_t k = first; k < grains.size(); ++k) {
      remove_partial_file(folder.file_of(grains[k]));
      for (const JobFiles& files : job.more_files) {
        remove_partial_file(folder.file_of(grains[k], files));
      }
    }
    for (const char* ending : {".json", ".html"}) {
      remove_partial_file(folder.file("summary", ending));
    }
  }
}

GrainRow row_of(const GrainJob& job, const std::vector<JobFolder>& folders, GrainSource& grains,
                std::size_t k, const Execution& execution) {
  const Clock::time_point begin = Clock::now();
  const std::string name = grains.name(k);
  return row_or_failure(
      [&]() -> GrainRow {
        GrainAtWork grain{name, grains.read(k, job.reads_pictures, execution), folders, execution,
                          begin};
        return {job.make(grain)};
      },
      [&](const std::string& error) {
        GrainRow row{{}, error};
        const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
        for (std::size_t level = 0; level < folders.size(); ++level) {
          for (std::string& record : job.failed(name, error, seconds)) {
            row.records.push_back(std::move(record));
          }
        }
        return row;
      });
}

}  // namespace

JobFolder::JobFolder(fs::path folder, const std::string& ending, const Shard& shard)
    : folder_(std::move(folder)), ending_("." + ending) {
  if (shard.count > 1) {
    part_ = "-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
  }
}

std::string JobFolder::name_of(const std::string& grain) const { return word_of(grain) + ending_; }

std::string JobFolder::file_of(const std::string& grain, const JobFiles& files) const {
  return (folder_ / files.folder / (word_of(grain) + "." + files.ending)).string();
}

std::string JobFolder::file_of(const std::string& grain) const {
  return (folder_ / name_of(grain)).string();
}

std::string JobFolder::file(const std::string& name, const std::string& ending) const {
  return (folder_ / (name + part_ + ending)).string();
}

double GrainAtWork::seconds() const {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<JobFolder> folders_of(const GrainJob& job) {
  std::vector<JobFolder> folders;
  for (const std::string& level : job.levels) {
    folders.emplace_back(fs::path(job.folder) / level, job.ending, job.shard);
  }
  if (folders.empty()) folders.emplace_back(job.folder, job.ending, job.shard);
  return folders;
}

JobEnd run_job(const GrainJob& job, GrainSource& grains, const JobHost& host) {
  const JobFolder whole(job.folder, job.ending, job.shard);
  const std::vector<JobFolder> folders = folders_of(job);
  std::vector<std::string> names(grains.size());
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = grains.name(k);
  for (const JobFolder& folder : folders) check_files(folder, job.more_files, names);
  std::error_code ignored;  // the first write into the folder reports it
  fs::create_directories(whole.path(), ignored);
  check_call(whole, job.call);
  for (const JobFolder& folder : folders) {
    fs::create_directories(folder.path(), ignored);
    for (const JobFiles& files : job.more_files) {
      fs::create_directories(fs::path(folder.path()) / files.folder, ignored);
    }
  }
  JobTables tables(folders, job.tables, names);
  remove_partial_file(whole.file("call", ".json"));
  remove_parts(job, folders, names, tables.rows());
  if (job.has_census) {
    const std::string census =
        grains.census([&](const std::string& grain) { return folders.front().name_of(grain); });
    // Equal for every part of the sample.
    if (!census.empty()) write_file((fs::path(job.folder) / "labels.csv").string(), census);
  }
  std::vector<std::size_t> wanted(names.size() - tables.rows());
  std::iota(wanted.begin(), wanted.end(), tables.rows());
  grains.want(wanted);
  GrainRun run;
  run.first = tables.rows();
  run.failed = tables.failed_rows();
  run.count = names.size();
  run.when_stopped = "The same call continues from there.";
  run.name = [&](std::size_t k) { return names[k]; };
  run.work = [&](std::size_t k, const Execution& execution) {
    return row_of(job, folders, grains, k, execution);
  };
  run.take = [&](std::size_t, const GrainRow& row) { tables.append(row.records); };
  return run_grains(run, host);
}

}  // namespace wscvt
