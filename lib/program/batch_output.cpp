// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch_output.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/file_name.h"
#include "wscvt/base/machine_refused.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path folder, const std::string& format, const Shard& shard)
    : folder_(std::move(folder)), ending_("." + format) {
  if (shard.count > 1) {
    part_ = "-" + std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
  }
}

std::string OutputFolder::mesh_name(const std::string& grain) const {
  fs::path name = fs::path(grain).filename();
  if (ending_of(grain) == ".gz") name = name.stem();
  return name.stem().string() + ending_;
}

std::string OutputFolder::mesh(const std::string& grain) const {
  return (folder_ / mesh_name(grain)).string();
}

std::string OutputFolder::file(const std::string& name, const std::string& ending) const {
  return (folder_ / (name + part_ + ending)).string();
}

BatchOutput::BatchOutput(const std::string& folder, const std::string& format, const Shard& shard,
                         const std::vector<int>& levels)
    : whole_(folder, format, shard) {
  for (const int nodes : levels) {
    levels_.emplace_back(fs::path(folder) / ("n" + std::to_string(nodes)), format, shard);
  }
  if (levels_.empty()) levels_.push_back(whole_);
}

void BatchOutput::check_meshes(const std::vector<std::string>& grains) const {
  for (const OutputFolder& folder : levels_) {
    std::map<std::string, const std::string*> made;
    for (const std::string& grain : grains) {
      const auto [other, is_new] = made.emplace(folder.mesh(grain), &grain);
      if (!is_new) {
        refuse("\"" + *other->second + "\" and \"" + grain + "\" would both be remeshed to \"" +
               other->first + "\". Use two batches, or rename one of them.");
      }
      if (same_file(other->first, grain)) {
        refuse("The remesh of \"" + grain +
               "\" would replace the scan. Give another folder with -o, or another --format.");
      }
    }
  }
}

std::size_t BatchOutput::open_tables(const std::vector<std::string>& grains,
                                     const std::vector<std::string>& headers) {
  std::size_t rows = grains.size();
  const auto open = [&](const std::string& path, const std::string& header) {
    tables_.push_back(std::make_unique<SampleTable>(path, header, grains));
    rows = std::min(rows, tables_.back()->rows());
  };
  for (const OutputFolder& level : levels_) {
    open(level.table(), headers.front());
    if (headers.size() > 1) open(level.shapes(), headers.back());
  }
  for (const auto& table : tables_) table->keep(rows);
  return rows;
}

bool BatchOutput::is_begun() const {
  std::error_code ignored;
  const fs::path table = whole_.table();
  if (fs::exists(table, ignored)) return true;
  for (const fs::directory_entry& entry : fs::directory_iterator(whole_.path(), ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_level = name.size() > 1 && name.front() == 'n' &&
                          name.find_first_not_of("0123456789", 1) == std::string::npos;
    if (is_level && fs::exists(entry.path() / table.filename(), ignored)) return true;
  }
  return false;
}

void BatchOutput::append(const GrainRow& row) {
  // The first table is written last, because its row marks the grain as done.
  for (std::size_t k = tables_.size() - 1; k > 0; --k) tables_[k]->append(row.others[k - 1]);
  tables_.front()->append(row.record);
}

void BatchOutput::remove_parts(const std::vector<std::string>& grains, std::size_t first) const {
  remove_partial_file(whole_.call());
  for (const OutputFolder& level : levels_) {
    for (std::size_t k = first; k < grains.size(); ++k) remove_partial_file(level.mesh(grains[k]));
    for (const char* ending : {".json", ".html"}) remove_partial_file(level.summary(ending));
  }
}

void check_call(const std::string& path, const std::string& call, bool is_begun) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno != ENOENT && errno != ENOTDIR) refuse_to_read(path);
  const std::string before((std::istreambuf_iterator<char>(file)), {});
  if (before == call) return;
  if (is_begun) {
    throw Error(ErrorCode::InvalidInput,
                "The folder contains a batch with other options or of another version: see \"" +
                    path + "\". Use the options of that file, or give another folder with -o.");
  }
  write_file(path, call);
}

}  // namespace wscvt::program
