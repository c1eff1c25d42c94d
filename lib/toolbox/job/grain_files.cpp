// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_files.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>

#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/option.h"
#include "wscvt/base/system_files.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

using IsVolume = std::function<bool(const std::string& path)>;

void add_folder(const std::string& folder, const IsVolume& is_volume,
                std::vector<std::string>& files) {
  const std::size_t before = files.size();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().generic_string();
    if (is_mesh_file(file) && !entry.is_directory() && !is_volume(file)) files.push_back(file);
  }
  if (files.size() == before) {
    refuse("The folder \"" + folder +
           "\" contains no mesh, such as .ply or .stl, and no .tif or .png slices. Check its name. "
           "Tables, points and volumes must be named.");
  }
  std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
}

void add_matches(const std::string& pattern, std::vector<std::string>& files) {
  const std::vector<std::string> found = system_files::matching_files(pattern);
  if (found.empty()) refuse("No file matches \"" + pattern + "\". Check the pattern.");
  files.insert(files.end(), found.begin(), found.end());
}

void add_input(const std::string& input, const IsVolume& is_volume,
               std::vector<std::string>& files);

[[noreturn]] void refuse_list_in(const std::string& list, const std::string& named) {
  refuse("The list \"" + list + "\" contains the list \"" + named +
         "\". Give this list in the call.");
}

void add_list(const std::string& list, const IsVolume& is_volume, std::vector<std::string>& files) {
  InputFile lines(list);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    // A list of lists could contain itself.
    if (!line.empty() && line.front() == '@') refuse_list_in(list, line);
    if (line.find('\0') != std::string::npos) {
      refuse("The list \"" + list +
             "\" contains a NUL character, which no file name has. Correct it.");
    }
    if (!line.empty()) add_input(line, is_volume, files);
  }
}

bool is_list(const std::string& input) { return !input.empty() && input.front() == '@'; }

bool is_pattern(const std::string& input) {
  std::error_code ignored;
  return input.find_first_of("*?[") != std::string::npos && !fs::exists(input, ignored);
}

void add_input(const std::string& input, const IsVolume& is_volume,
               std::vector<std::string>& files) {
  std::error_code ignored;
  if (fs::is_directory(input, ignored) && !is_volume(input))
    return add_folder(input, is_volume, files);
  if (is_pattern(input)) return add_matches(input, files);
  if (!fs::exists(input, ignored) && !is_mesh_file(input) && !is_volume(input)) {
    refuse("There is no file and no folder \"" + input + "\". Check its name.");
  }
  files.push_back(input);
}

/// Returns the 64-bit FNV-1a hash, which is equal on every machine.
std::uint64_t stable_hash(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 1099511628211ULL;
  }
  return hash;
}

}  // namespace

bool names_files(const std::string& input) {
  std::error_code ignored;
  return is_list(input) || is_pattern(input) || fs::is_directory(input, ignored);
}

std::vector<std::string> grain_files(const std::vector<std::string>& inputs,
                                     const IsVolume& is_volume) {
  const IsVolume known = is_volume ? is_volume : [](const std::string&) { return false; };
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    if (is_list(input)) {
      add_list(input.substr(1), known, files);
    } else {
      add_input(input, known, files);
    }
  }
  return files;
}

void check_format(const std::string& ending) {
  // With a point before it, names would have two.
  const bool has_point = !ending.empty() && ending.front() == '.';
  if (!has_point && is_mesh_format("mesh." + ending, MeshUse::Write)) return;
  refuse("The format of the meshes is \"" + ending + "\". Give " + mention("format") + " one of " +
         mesh_extensions(MeshUse::Write) + ", without the point.");
}

Shard shard_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    refuse("The part is \"" + std::string(text) + "\". Give it as I/N: part I of N.");
  }
  constexpr int most = std::numeric_limits<int>::max();
  const NumberOption<int> count = {"shard", "number of parts", 1, most};
  Shard shard;
  shard.count = from_typed(text.substr(slash + 1), count);
  const NumberOption<int> index = {"shard", "number of the part", 1, shard.count};
  shard.index = from_typed(text.substr(0, slash), index);
  return shard;
}

bool is_of(const Shard& shard, const std::string& grain) {
  const auto count = static_cast<std::uint64_t>(shard.count);
  return stable_hash(fs::path(grain).filename().string()) % count ==
         static_cast<std::uint64_t>(shard.index - 1);
}

}  // namespace wscvt
