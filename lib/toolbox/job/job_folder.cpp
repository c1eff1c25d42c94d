// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/job_folder.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "toolbox/exchange/part_files.h"
#include "toolbox/sample/csv_reader.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/json.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Returns the name of a file without folders and endings.
std::string stem_of(const std::string& file) {
  fs::path name = fs::path(file).filename();
  if (ending_of(file) == ".gz") name = name.stem();
  return name.stem().string();
}

/// Returns the ending of the files of grains, without the point, from a call.json; empty: unknown.
std::string ending_in_call(const std::string& text) {
  const Json call = Json::parse(text, nullptr, false);
  if (!call.is_object()) return "";
  for (const char* key : {"meshes", "clumps", "parts"}) {
    const auto found = call.find(key);
    if (found != call.end() && found->is_string()) return found->get<std::string>();
  }
  return "";
}

}  // namespace

std::string format_of_call(const std::string& text) {
  const Json call = Json::parse(text, nullptr, false);
  return call.is_object() ? call.value("format", "") : "";
}

JobFolder::JobFolder(fs::path folder, const std::string& ending, const Shard& shard,
                     bool long_names)
    : folder_(std::move(folder)), ending_("." + ending), long_names_(long_names) {
  if (shard.count > 1) {
    part_ = "-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
  }
}

std::string JobFolder::word_of(const std::string& grain) const {
  const fs::path name(grain);
  // Only a label or a body has no ending.
  const bool is_long = long_names_ && !name.filename().has_extension() && name.has_parent_path();
  return (is_long ? stem_of(name.parent_path().string()) + "-" : "") + stem_of(grain);
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

void refuse_folder(const std::string& folder, const std::string& other) {
  refuse("The folder \"" + folder + "\" has the results of another command (" + other +
         "), which would be replaced. Give another folder with " + mention("output") + ".");
}

void require_no_job(const std::string& folder) {
  const std::string format =
      format_of_call(file_content((fs::path(folder) / "call.json").string()));
  if (!format.empty()) refuse_folder(folder, format);
}

std::string kept_call(const std::string& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name == "call.json" || (name.rfind("call-", 0) == 0 && name.find("-of-") != name.npos)) {
      return file_content(entry.path().string());
    }
  }
  return {};
}

bool is_kept_by_job(const std::string& file) {
  std::error_code ignored;
  fs::path folder = fs::absolute(file, ignored).parent_path();
  const std::string name = fs::path(file).filename().string();
  const bool is_beside = folder.filename() == "node-table" || folder.filename() == "sdf";
  if (is_beside) folder = folder.parent_path();
  std::string call = kept_call(folder.string());
  // A level has its call in the folder above.
  if (call.empty()) call = kept_call(folder.parent_path().string());
  if (call.empty()) return false;
  const std::string stem = fs::path(file).stem().string();
  const std::string kind = stem.substr(0, stem.find('-'));
  for (const char* own : {"grains", "shape", "call", "summary", "labels", "mass"}) {
    if (!is_beside && kind == own) return true;
  }
  const std::string ending = is_beside ? "" : ending_in_call(call);
  if (ending.empty() && !is_beside) return false;
  const JobFolder folders[] = {{folder, ending, {}, false}, {folder, ending, {}, true}};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& table = entry.path();
    if (table.filename().string().rfind("grains", 0) != 0 || table.extension() != ".csv") continue;
    InputFile rows(table.string());
    CsvReader reader(rows);
    std::vector<std::string> fields;
    while (reader.next(fields)) {
      for (const JobFolder& one : folders) {
        const std::string made = one.name_of(std::string(text_of_field(fields.front())));
        if (is_beside ? name.rfind(made, 0) == 0 : name == made) return true;
      }
    }
  }
  return false;
}

void require_no_other_results(const std::string& folder, const std::string& own,
                              const std::set<std::string>& made) {
  for (const std::string table : {"labels", "bodies", "fragments", "grown", "templates"}) {
    if (table == own) continue;
    InputFile file((fs::path(folder) / (table + ".csv")).string(), MissingFile::IsEmpty);
    if (!file) continue;
    const std::vector<std::string> files = column_of(file, "file");
    const bool is_replaced = made.count(table + ".csv") > 0 ||
                             std::any_of(files.begin(), files.end(), [&](const std::string& name) {
                               return made.count(name) > 0;
                             });
    if (is_replaced) refuse_folder(folder, table + ".csv");
  }
}

void require_own_table(const std::string& folder, const std::string& table,
                       const std::string& header) {
  InputFile file((fs::path(folder) / table).string(), MissingFile::IsEmpty);
  std::string line;
  if (!std::getline(file, line) || line + "\n" == header) return;
  refuse("The folder \"" + folder + "\" has a " + table +
         " of another command, which would be replaced. Give another folder with " +
         mention("output") + ".");
}

OlderFiles::OlderFiles(std::string folder, const std::vector<std::string>& tables)
    : folder_(std::move(folder)) {
  for (const std::string& table : tables) {
    InputFile file((folder_ / table).string(), MissingFile::IsEmpty);
    for (std::string& name : column_of(file, "file")) {
      // A path elsewhere is not of these tables.
      if (!name.empty() && fs::path(name).filename() == name) files_.push_back(std::move(name));
    }
  }
}

std::vector<std::string> OlderFiles::remove_but(const std::vector<std::string>& kept,
                                                const std::string& input, bool formats) const {
  const auto kept_as = [&](const fs::path& path) {
    return formats ? path.stem() : path.filename();
  };
  std::set<fs::path> names;
  for (const std::string& name : kept) names.insert(kept_as(name));
  std::size_t removed = 0;
  for (const std::string& name : files_) {
    const fs::path path = folder_ / name;
    if (names.count(kept_as(path)) > 0) continue;
    std::vector<std::string> old = parts_beside(path.string(), 1);
    old.push_back(path.string());
    for (const std::string& file : old) {
      std::error_code ignored;
      if (!same_file(file, input) && fs::remove(file, ignored)) ++removed;
    }
  }
  if (removed == 0) return {};
  return {format_count(removed, "file") + " of the earlier call removed"};
}

}  // namespace wscvt
