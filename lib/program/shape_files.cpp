// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_files.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "job_on_terminal.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/shtools_io.h"

namespace wscvt::program {

namespace {

namespace fs = std::filesystem;

constexpr int map_frequency = 24;  ///< frequency of the mesh of a harmonic map: 5,762 points

std::vector<std::string> files_ending(const std::string& folder,
                                      const std::vector<std::string>& endings) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().generic_string();
    if (entry.is_directory()) continue;
    if (std::find(endings.begin(), endings.end(), ending_of(file)) != endings.end()) {
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool holds_meshes(const std::string& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() && is_mesh_file(entry.path().string())) return true;
  }
  return false;
}

SampleGrain read_shape(const std::string& file, const SampleGrids& grids,
                       const Execution& execution) {
  if (is_coefficient_file(file)) {
    const std::unique_ptr<const SphereSurface> surface = read_coefficients(file);
    const auto* radial = dynamic_cast<const HarmonicSurface*>(surface.get());
    if (radial != nullptr) return sample_grain(*radial, grids, execution);
    return sample_grain(mesh_of_surface(*surface, map_frequency, execution), grids, execution);
  }
  MeshFile read = read_mesh_file(file, execution);
  const CheckedMesh checked = check_mesh(std::move(read.mesh), MeshCheckOptions(), execution);
  return sample_grain(checked.mesh, grids, execution);
}

}  // namespace

std::unique_ptr<const SphereSurface> read_coefficients(const std::string& path) {
  const auto radial = [](HarmonicSurface surface) {
    return std::make_unique<const HarmonicSurface>(std::move(surface));
  };
  if (ending_of(path) == ".dat") return radial(read_complex_harmonics(path));
  if (ending_of(path) == ".sh") return radial(read_shtools(path));
  if (read_harmonic_kind(path) == HarmonicKind::Radial) return radial(read_harmonics(path));
  return std::make_unique<const HarmonicMap>(read_harmonic_map(path));
}

bool is_coefficient_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".dat" || ending == ".sh" || ending == ".json";
}

std::vector<std::string> shape_files(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code ignored;
    std::vector<std::string> found;
    if (fs::is_directory(input, ignored) && !is_volume(input) && !holds_meshes(input)) {
      found = files_ending(input, {".dat", ".sh"});
      if (found.empty()) found = files_ending(input, {".json"});
    }
    if (found.empty()) found = grain_files({input}, is_volume);
    files.insert(files.end(), found.begin(), found.end());
  }
  for (const std::string& file : files) {
    if (!is_coefficient_file(file)) check_mesh_format(file, MeshUse::Read);
  }
  return files;
}

std::size_t read_each(const std::vector<std::string>& files, int threads, bool quiet,
                      const std::function<void(std::size_t file, const Execution&)>& read) {
  GrainRun all;
  all.count = files.size();
  all.when_stopped = "Nothing was written.";
  all.name = [&](std::size_t k) { return files[k]; };
  all.work = [&](std::size_t k, const Execution& execution) {
    return row_or_failure(
        [&]() -> GrainRow {
          read(k, execution);
          return {};
        },
        [](const std::string& sentence) -> GrainRow {
          return {{}, sentence};
        });
  };
  const JobEnd end = run_grains(all, threads, quiet);
  if (end.was_cancelled()) throw Error(ErrorCode::Cancelled, "Cancelled while reading the sample.");
  return end.failed;
}

RealGrains read_shapes(const std::vector<std::string>& files, const SampleGrids& grids, int threads,
                       bool quiet) {
  std::vector<std::optional<SampleGrain>> read(files.size());
  RealGrains shapes;
  shapes.left_out = read_each(files, threads, quiet, [&](std::size_t k, const Execution& one) {
    read[k] = read_shape(files[k], grids, one);
  });
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (!read[k]) continue;
    shapes.grains.push_back(std::move(*read[k]));
    shapes.files.push_back(files[k]);
  }
  return shapes;
}

}  // namespace wscvt::program
