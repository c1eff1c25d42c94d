// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/sample_files.h"

#include <algorithm>
#include <filesystem>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Refuses files that are easily mistaken for the table of a sample.
void refuse_other_files(const std::string& path) {
  const fs::path name = fs::path(path).filename();
  std::error_code error;
  if (name == "grains.csv" && fs::exists(fs::path(path).parent_path() / "shape.csv", error)) {
    refuse("\"" + path +
           "\" is the table of a batch's errors. Give shape.csv from its folder, or the folder.");
  }
  if (ending_of(path) != ".csv" && is_mesh_file(path)) {
    refuse("\"" + path +
           "\" is a mesh. Measure the meshes of a folder first, by wscvt batch, and give "
           "the folder that it wrote.");
  }
}

}  // namespace

std::vector<std::string> sample_files(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    refuse_other_files(path);
    return {path};
  }
  const std::string whole = (fs::path(path) / "shape.csv").string();
  if (fs::exists(whole, error)) return {whole};
  std::vector<std::string> tables;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const fs::path table = entry.path() / "shape.csv";
    if (entry.path().filename().string().front() == 'n' && fs::exists(table, error)) {
      tables.push_back(table.string());
    }
  }
  std::sort(tables.begin(), tables.end());
  if (!tables.empty()) return tables;
  bool has_meshes = false;
  bool is_of_batch = false;  // all of it, or parts: call.json, call-1-of-2.json
  for (const auto& entry : fs::directory_iterator(path, error)) {
    has_meshes = has_meshes || is_mesh_file(entry.path().string());
    is_of_batch = is_of_batch || entry.path().filename().string().rfind("call", 0) == 0;
  }
  if (has_meshes && !is_of_batch) {
    refuse("The folder \"" + path +
           "\" has meshes but no shape.csv. Measure them first: wscvt batch " + path +
           " -o FOLDER. Then give that folder.");
  }
  refuse("The folder \"" + path +
         "\" has no shape.csv. Give a folder that wscvt batch wrote without " +
         mention("describe", "none") + ". The call of its parts, without " + mention("shard") +
         ", joins their tables.");
}

SampleTables read_sample(const std::string& path, const Execution& execution) {
  SampleTables sample;
  sample.files = sample_files(path);
  for (const std::string& file : sample.files) {
    execution.report(0.0, "Reading \"" + file + "\"");
    sample.tables.push_back(read_grain_table(file));
  }
  return sample;
}

std::size_t finest_table(const std::vector<GrainTable>& tables) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const auto nodes = tables[k].find("nodes");
    if (!nodes) continue;
    const double count = tables[k].values(0, *nodes);
    if (!(count > most)) continue;
    most = count;
    best = k;
  }
  return best;
}

}  // namespace wscvt
