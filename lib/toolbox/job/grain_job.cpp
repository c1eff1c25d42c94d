// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_job.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "toolbox/report/sample_table.h"
#include "toolbox/sample/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/report/json.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Throws Error. `scan`: its name in quotes; empty: that of the grain.
[[noreturn]] void refuse_replacing(const std::string& grain, const std::string& scan) {
  refuse("The files of \"" + grain + "\" would replace the scan" + scan +
         ". Give another folder with " + mention("output") + ", or another " + mention("format") +
         ".");
}

/// Scans, to be found by a path that leads to one of them.
class Scans {
 public:
  explicit Scans(const std::vector<std::string>& scans) {
    std::error_code missing;
    for (const std::string& scan : scans) places_.insert(fs::weakly_canonical(scan, missing));
  }

  bool has(const std::string& file) const {
    std::error_code missing;
    return fs::exists(file, missing) && places_.count(fs::weakly_canonical(file, missing)) > 0;
  }

 private:
  std::set<fs::path> places_;
};

/// Returns the files of a grain in a folder of the job, its own first.
std::vector<std::string> files_of(const GrainJob& job, const JobFolder& folder,
                                  const std::string& grain) {
  std::vector<std::string> files = {folder.file_of(grain)};
  for (const JobFiles& more : job.more_files) files.push_back(folder.file_of(grain, more));
  return files;
}

/// Refuses grains whose files would replace each other, or a scan.
void check_files(const JobFolder& folder, const GrainJob& job,
                 const std::vector<std::string>& grains) {
  std::map<std::string, const std::string*> made;
  std::optional<Scans> scans;
  const auto is_scan = [&](const std::string& file) {
    if (!scans) scans.emplace(grains);
    return scans->has(file);
  };
  for (const std::string& grain : grains) {
    const auto [other, is_new] = made.emplace(folder.file_of(grain), &grain);
    if (!is_new) {
      refuse("\"" + *other->second + "\" and \"" + grain + "\" would both be written to \"" +
             other->first + "\". Use two batches, or rename one of them.");
    }
    for (const std::string& file : files_of(job, folder, grain)) {
      if (same_file(file, grain) || same_file(file, fs::path(grain).parent_path().string())) {
        refuse_replacing(grain, "");
      }
      // The scan of another grain has another name, so that only a link leads to it.
      std::error_code missing;
      if (fs::is_symlink(file, missing) && is_scan(file)) {
        refuse_replacing(grain, " \"" + file + "\"");
      }
    }
    if (!job.beside) continue;
    for (const std::string& file : job.beside(other->first)) {
      if (is_scan(file)) refuse_replacing(grain, " \"" + file + "\"");
    }
  }
}

/// Refuses a folder where results of another command, which keeps no call, would be replaced.
void check_results(const JobFolder& folder, const GrainJob& job, const GrainSource& source,
                   const std::vector<std::string>& grains) {
  const JobTable& last = job.last_table.name.empty() ? job.tables.front() : job.last_table;
  if (!job.last_table.name.empty()) require_own_table(job.folder, last.name + ".csv", last.header);
  if (!kept_call(job.folder).empty()) return;
  std::set<std::string> made;
  if (job.has_census && source.volumes() > 0) made.insert("labels.csv");
  if (job.levels.empty()) {
    for (const std::string& grain : grains) made.insert(folder.name_of(grain));
  }
  require_no_other_results(job.folder, last.name, made);
}

/// Whether the folder has tables of this part, with or without levels.
bool is_begun(const JobFolder& folder, const std::string& table_name) {
  std::error_code ignored;
  const fs::path table = folder.file(table_name, ".csv");
  if (fs::exists(table, ignored)) return true;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path(), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_level = name.size() > 1 && name.front() == 'n' &&
                          name.find_first_not_of("0123456789", 1) == std::string::npos;
    if (is_level && fs::exists(entry.path() / table.filename(), ignored)) return true;
  }
  return false;
}

/// Returns whether the folder has the options of a job. Throws Error if it is kept with others, or
/// has a table of another command.
bool has_call(const JobFolder& folder, const GrainJob& job) {
  const std::string path = folder.file("call", ".json");
  const std::string before = file_content(path);
  if (before == job.call) return true;
  const std::string other = format_of_call(before);
  if (!other.empty() && other != format_of_call(job.call)) refuse_folder(folder.path(), other);
  const JobTable& first = job.tables.front();
  if (before.empty() || !job.is_kept) {
    const std::string table = fs::path(folder.file(first.name, ".csv")).filename().string();
    require_own_table(folder.path(), table, first.header);
  }
  if (job.is_kept && is_begun(folder, first.name)) {
    if (before.empty()) refuse_folder(folder.path(), "its call.json is missing");
    refuse("The folder is of a call with other options or of another version: see \"" + path +
           "\". Use the options of that file, or give another folder with " + mention("output") +
           ".");
  }
  return false;
}

/// When a scan was last written; a folder, such as one of slices: when its newest file was.
fs::file_time_type time_of(const std::string& scan) {
  std::error_code missing;
  fs::file_time_type time = fs::last_write_time(scan, missing);
  if (missing) return fs::file_time_type::min();
  for (const fs::directory_entry& entry : fs::directory_iterator(scan, missing)) {
    std::error_code ignored;
    const fs::file_time_type other = entry.last_write_time(ignored);
    if (!ignored) time = std::max(time, other);
  }
  return time;
}

/// Whether a text is cut, as by a full disk: those that a job writes end with a line.
bool is_cut(const std::string& path) {
  constexpr std::string_view texts[] = {".csv", ".vtp", ".shp", ".json", ".vti", ".obj",
                                        ".off", ".vtk", ".vtu", ".msh",  ".inp"};
  if (std::find(std::begin(texts), std::end(texts), ending_of(path)) == std::end(texts)) {
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;  // the machine refuses it, which says nothing of its end
  file.seekg(-1, std::ios::end);
  return file.get() != '\n';
}

/// The grains of a source and when their scans were written.
class ScanTimes {
 public:
  explicit ScanTimes(const GrainSource& grains) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
      const std::string scan = grains.file(k);
      // The bodies and labels of a file stand together.
      if (k == 0 || scan != last_) {
        last_ = scan;
        last_time_ = scan.empty() ? fs::file_time_type::min() : time_of(scan);
      }
      times_.push_back(last_time_);
    }
  }

  /// Whether the file is missing, empty, or older than the scan of the grain.
  bool is_old(std::size_t grain, const std::string& file) const {
    std::error_code missing;
    const std::uintmax_t size = fs::file_size(file, missing);
    if (missing || size == 0) return true;
    const fs::file_time_type written = fs::last_write_time(file, missing);
    return missing || written < times_[grain];
  }

  /// Whether one of the files that the job has made of the grain is old or cut.
  bool has_lost(const GrainJob& job, const std::vector<JobFolder>& folders, std::size_t grain,
                const std::string& name) const {
    return std::any_of(folders.begin(), folders.end(), [&](const JobFolder& folder) {
      const std::vector<std::string> files = files_of(job, folder, name);
      return std::any_of(files.begin(), files.end(), [&](const std::string& file) {
        return is_old(grain, file) || is_cut(file);
      });
    });
  }

 private:
  std::vector<fs::file_time_type> times_;
  std::string last_;
  fs::file_time_type last_time_ = fs::file_time_type::min();
};

/// The rows that parts of a sample have left in the folder of the whole.
class PartRows {
 public:
  /// Throws Error if a part is of a job with other options.
  PartRows(const GrainJob& job, const std::vector<JobFolder>& folders)
      : tables_(folders.size() * job.tables.size()) {
    if (job.shard.count > 1) return;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(job.folder, ignored)) {
      Shard part;
      if (std::sscanf(entry.path().filename().string().c_str(), "call-%d-of-%d.json", &part.index,
                      &part.count) != 2 ||
          !has_call(JobFolder(job.folder, job.ending, part), job)) {
        continue;
      }
      calls_.push_back(entry.path());
      std::size_t column = 0;
      for (const JobFolder& level : folders) {
        const JobFolder folder(level.path(), job.ending, part);
        for (const JobTable& table : job.tables) {
          add(folder.file(table.name, ".csv"), table.header, column++);
        }
      }
    }
  }

  /// Removes the tables and calls of the parts.
  void remove() const {
    std::error_code ignored;
    for (const std::string& file : files_) fs::remove(file, ignored);
    for (const fs::path& call : calls_) fs::remove(call, ignored);
  }

  /// Whether a part has made the grain.
  bool has(const std::string& grain) const { return places_of(grain) != nullptr; }

  /// Returns the table with the row of a grain that a part has made.
  const std::string& table(const std::string& grain) const {
    return files_[places_of(grain)->front().file];
  }

  /// Returns the row of a grain that a part has made.
  GrainRow row(const std::string& grain) const {
    GrainRow row;
    for (const Place& place : *places_of(grain)) {
      InputFile file(files_[place.file]);
      std::string record(place.size, '\0');
      file.seekg(static_cast<std::streamoff>(place.offset));
      file.read(record.data(), static_cast<std::streamsize>(record.size()));
      row.records.push_back(std::move(record));
    }
    row.error = failure_in(row.records.front());
    return row;
  }

 private:
  /// Of a record in a file; not found if its size is 0.
  struct Place {
    std::size_t file;
    std::size_t offset;
    std::size_t size;
  };

  void add(const std::string& path, const std::string& header, std::size_t column) {
    InputFile file(path);
    CsvReader reader(file);
    std::vector<std::string> fields;
    if (!reader.next(fields) || reader.text() != header) return;
    files_.push_back(path);
    for (std::size_t offset = reader.size(); reader.next(fields); offset = reader.size()) {
      std::vector<Place>& places = places_[fields.front()];
      places.resize(tables_);
      places[column] = {files_.size() - 1, offset, reader.text().size()};
    }
  }

  const std::vector<Place>* places_of(const std::string& grain) const {
    const auto found = places_.find(csv_field(grain));
    if (found == places_.end()) return nullptr;
    const bool is_whole = std::all_of(found->second.begin(), found->second.end(),
                                      [](const Place& place) { return place.size > 0; });
    return is_whole ? &found->second : nullptr;
  }

  std::size_t tables_;
  std::vector<std::string> files_;
  std::vector<fs::path> calls_;
  std::map<std::string, std::vector<Place>> places_;
};

/// The tables of all levels.
class JobTables {
 public:
  /// Opens or creates the tables and cuts all to the length of the shortest, because a killed job
  /// may have added a row to only some of them. Also cuts them at the first grain one of whose
  /// files is missing, empty, cut or older than its scan, so that it is made again. A grain that
  /// failed has no file: its table tells the time.
  JobTables(const std::vector<JobFolder>& folders, const GrainJob& job,
            const std::vector<std::string>& grains, const ScanTimes& scans)
      : rows_(grains.size()) {
    const std::string first = folders.front().file(job.tables.front().name, ".csv");
    std::vector<bool> is_old_failure(grains.size(), false);  // opening a table may change its time
    for (std::size_t k = 0; k < grains.size(); ++k) is_old_failure[k] = scans.is_old(k, first);
    for (const JobFolder& folder : folders) {
      for (const JobTable& table : job.tables) {
        tables_.push_back(
            std::make_unique<SampleTable>(folder.file(table.name, ".csv"), table.header, grains));
        rows_ = std::min(rows_, tables_.back()->rows());
      }
    }
    for (std::size_t k = 0; k < rows_; ++k) {
      const bool is_lost = tables_.front()->is_failed(k)
                               ? is_old_failure[k]
                               : scans.has_lost(job, folders, k, grains[k]);
      if (is_lost) rows_ = k;
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
  remove_partial_file((fs::path(job.folder) / "labels.csv").string());
  for (const JobFolder& folder : folders) {
    for (std::size_t k = first; k < grains.size(); ++k) {
      for (const std::string& file : files_of(job, folder, grains[k])) remove_partial_file(file);
    }
    for (const char* ending : {".json", ".html"}) {
      remove_partial_file(folder.file("summary", ending));
    }
  }
}

/// Returns the first record of a table with a known unit in place of "length".
std::string with_unit(std::string header, const std::string& unit) {
  const std::string open = "[length";
  for (std::size_t at = header.find(open); !unit.empty() && at != std::string::npos;
       at = header.find(open, at + 1)) {
    header.replace(at + 1, open.size() - 1, unit);
  }
  return header;
}

GrainRow row_of(const GrainJob& job, const std::vector<JobFolder>& folders, GrainSource& grains,
                std::size_t k, const Execution& execution) {
  const std::string name = grains.name(k);
  return row_or_failure(
      [&]() -> GrainRow {
        GrainAtWork grain{name, grains.read(k, job.reads_pictures, execution), folders, execution};
        if (!grain.scan.refused.empty() && !job.takes_refused) refuse(grain.scan.refused);
        return {job.make(grain)};
      },
      [&](const std::string& error) {
        if (!job.failed) throw Error(ErrorCode::NumericalFailure, name + ": " + error);
        GrainRow row{{}, error};
        for (std::size_t level = 0; level < folders.size(); ++level) {
          for (std::string& record : job.failed(name, error)) {
            row.records.push_back(std::move(record));
          }
        }
        return row;
      });
}

}  // namespace

std::vector<JobFolder> folders_of(const GrainJob& job) {
  std::vector<JobFolder> folders;
  for (const std::string& level : job.levels) {
    folders.emplace_back(fs::path(job.folder) / level, job.ending, job.shard, job.long_names);
  }
  if (folders.empty()) {
    folders.emplace_back(job.folder, job.ending, job.shard, job.long_names);
  }
  return folders;
}

void require_scans_kept(const GrainJob& job, const GrainSource& grains,
                        const std::vector<std::string>& scans) {
  const Scans kept(scans);
  for (const JobFolder& folder : folders_of(job)) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
      const std::string grain = grains.name(k);
      for (const std::string& file : files_of(job, folder, grain)) {
        if (kept.has(file)) refuse_replacing(grain, " \"" + file + "\"");
      }
    }
  }
}

JobEnd run_job(GrainJob job, GrainSource& grains, const JobHost& host) {
  for (JobTable& table : job.tables) table.header = with_unit(table.header, grains.unit());
  const JobFolder whole(job.folder, job.ending, job.shard);
  const std::vector<JobFolder> folders = folders_of(job);
  std::vector<std::string> names(grains.size());
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = grains.name(k);
  for (const JobFolder& folder : folders) check_files(folder, job, names);
  check_results(folders.front(), job, grains, names);
  std::error_code ignored;  // the first write into the folder reports it
  fs::create_directories(whole.path(), ignored);
  const PartRows parts(job, folders);
  if (!has_call(whole, job)) {
    for (const JobTable& table : job.tables) {
      if (!job.is_kept) fs::remove(whole.file(table.name, ".csv"), ignored);
    }
    write_file(whole.file("call", ".json"), job.call);
  }
  for (const JobFolder& folder : folders) {
    fs::create_directories(folder.path(), ignored);
    for (const JobFiles& files : job.more_files) {
      fs::create_directories(fs::path(folder.path()) / files.folder, ignored);
    }
  }
  const ScanTimes scans(grains);
  JobTables tables(folders, job, names, scans);
  remove_partial_file(whole.file("call", ".json"));
  remove_parts(job, folders, names, tables.rows());
  if (job.has_census) {
    const std::string census = grains.census(
        [&](const std::string& grain) -> MadeGrain { return {folders.front().name_of(grain)}; });
    // Equal for every part of the sample.
    if (!census.empty()) write_file((fs::path(job.folder) / "labels.csv").string(), census);
  }
  std::vector<std::size_t> wanted;
  std::vector<bool> is_of_part(names.size(), false);
  for (std::size_t k = tables.rows(); k < names.size(); ++k) {
    if (parts.has(names[k])) {
      // A grain that failed has no file: the part's table tells the time.
      is_of_part[k] = parts.row(names[k]).error.empty() ? !scans.has_lost(job, folders, k, names[k])
                                                        : !scans.is_old(k, parts.table(names[k]));
    }
    if (!is_of_part[k]) wanted.push_back(k);
  }
  grains.want(wanted);
  GrainRun run;
  run.first = tables.rows();
  run.failed = tables.failed_rows();
  run.count = names.size();
  run.when_stopped = "The same call continues from there.";
  run.name = [&](std::size_t k) { return names[k]; };
  run.work = [&](std::size_t k, const Execution& execution) {
    return is_of_part[k] ? parts.row(names[k]) : row_of(job, folders, grains, k, execution);
  };
  run.take = [&](std::size_t, const GrainRow& row) { tables.append(row.records); };
  JobEnd end = run_grains(run, host);
  if (!job.is_kept && job.shard.count == 1 && !end.was_cancelled()) {
    parts.remove();
    fs::remove(whole.file("call", ".json"), ignored);
  }
  return end;
}

std::size_t grains_with_warnings(const GrainJob& job) {
  InputFile file(folders_of(job).front().file(job.tables.front().name, ".csv"));
  CsvReader reader(file);
  std::vector<std::string> fields;
  reader.next(fields);
  const auto column = std::find(fields.begin(), fields.end(), "warnings") - fields.begin();
  std::size_t count = 0;
  while (reader.next(fields)) {
    const bool is_there = column < std::distance(fields.begin(), fields.end());
    if (is_there && !fields[static_cast<std::size_t>(column)].empty()) ++count;
  }
  return count;
}

}  // namespace wscvt
