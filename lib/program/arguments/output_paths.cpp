// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/output_paths.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "toolbox/job/job_folder.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"

namespace wscvt::program {

namespace fs = std::filesystem;

namespace {

/// Whether a file is a table that tells of the other files of a command's folder. Its user's own
/// tables of points, spheres and reports begin with other columns.
bool is_table_of_folder(const std::string& path) {
  if (ending_of(path) != ".csv") return false;
  std::ifstream file(path, std::ios::binary);
  std::string first;
  std::getline(file, first);
  constexpr const char* beginnings[] = {"grain,",
                                        "label,name,",
                                        "body,state,",
                                        "fragment,file,",
                                        "first,second,",
                                        "descriptor,by_number,",
                                        "equivalent_diameter [length],"};
  return std::any_of(std::begin(beginnings), std::end(beginnings),
                     [&](const char* beginning) { return first.rfind(beginning, 0) == 0; });
}

}  // namespace

void check_output_paths(const std::vector<NamedFile>& inputs,
                        const std::vector<NamedFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (output.path.empty()) continue;
    for (std::size_t k = 0; k < i; ++k) {
      if (!same_file(output.path, outputs[k].path)) continue;
      refuse("\"" + output.path + "\" is given for " + outputs[k].meaning + " and for " +
             output.meaning + ". Give two names.");
    }
    for (const NamedFile& input : inputs) {
      if (!same_file(output.path, input.path)) continue;
      refuse("\"" + output.path + "\", given for " + output.meaning + ", is " + input.meaning +
             " itself. Give another name.");
    }
    std::error_code ignored;
    if (fs::is_regular_file(output.path, ignored)) {
      const bool is_kept = is_kept_by_job(output.path);
      if (is_kept || is_table_of_folder(output.path)) {
        refuse("\"" + output.path + "\", given for " + output.meaning + ", is a " +
               (is_kept ? "file of a batch, which needs it" : "table of another command") +
               ". Give another name.");
      }
    }
    check_writable(output.path);
  }
}

MadeFolder::MadeFolder(const std::string& path) {
  std::error_code ignored;
  for (fs::path folder = path; !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path()) {
    made_.push_back(folder);
  }
  fs::create_directories(path, ignored);
}

MadeFolder::~MadeFolder() {
  std::error_code ignored;  // for example, it is not empty
  for (const fs::path& folder : made_) fs::remove(folder, ignored);
}

std::vector<NamedFile> named_reports(const std::vector<std::string>& reports) {
  std::vector<NamedFile> files;
  files.reserve(reports.size());
  for (const std::string& report : reports) files.push_back({"a report", report});
  return files;
}

}  // namespace wscvt::program
