// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/output_paths.h"

#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

namespace fs = std::filesystem;

namespace {

/// Whether a path names a table, a page or the call of the output folder of a batch, which the
/// batch needs to continue, or which other commands read.
bool is_kept_by_batch(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::string kind = stem.substr(0, stem.find('-'));
  std::error_code ignored;
  if ((kind != "grains" && kind != "shape" && kind != "call" && kind != "summary" &&
       kind != "labels" && kind != "mass") ||
      !fs::exists(path, ignored)) {
    return false;
  }
  // A level of a batch has its call in the folder above.
  const fs::path folder = fs::absolute(path, ignored).parent_path();
  for (const fs::path& place : {folder, folder.parent_path()}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(place, ignored)) {
      const std::string name = entry.path().filename().string();
      if (name == "call.json" || (name.rfind("call-", 0) == 0 && name.find("-of-") != name.npos)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

void check_output_paths(const std::vector<NamedFile>& inputs,
                        const std::vector<NamedFile>& outputs) {
  const auto refuse = [](const std::string& sentence) {
    throw wscvt::Error(wscvt::ErrorCode::InvalidInput, sentence);
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    if (output.path.empty()) continue;
    for (std::size_t k = 0; k < i; ++k) {
      if (!wscvt::same_file(output.path, outputs[k].path)) continue;
      refuse("\"" + output.path + "\" is given for " + outputs[k].meaning + " and for " +
             output.meaning + ". Give two names.");
    }
    for (const NamedFile& input : inputs) {
      if (!wscvt::same_file(output.path, input.path)) continue;
      refuse("\"" + output.path + "\", given for " + output.meaning + ", is " + input.meaning +
             " itself. Give another name.");
    }
    if (is_kept_by_batch(output.path)) {
      refuse("\"" + output.path + "\", given for " + output.meaning +
             ", is a file of a batch, which needs it. Give another name.");
    }
    wscvt::check_writable(output.path);
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
