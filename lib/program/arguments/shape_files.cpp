// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/arguments/shape_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <variant>

#include "program/arguments/common_arguments.h"
#include "program/terminal/work.h"
#include "toolbox/sample/grain_table.h"
#include "toolbox/sample/sample_grain.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/quadric_surface.h"

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
    const HarmonicShape shape = read_coefficients(file);
    const auto* radial = std::get_if<HarmonicSurface>(&shape);
    if (radial != nullptr) return sample_grain(*radial, grids, execution);
    const auto& map = std::get<HarmonicMap>(shape);
    return sample_grain(mesh_of_surface(map, map_frequency, execution), grids, execution);
  }
  MeshFile read = read_mesh_file(file, execution);
  const CheckedMesh checked = check_mesh(std::move(read.mesh), MeshCheckOptions(), execution);
  return sample_grain(checked.mesh, grids, execution);
}

}  // namespace

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
    if (!is_coefficient_file(file)) check_mesh_input(file);
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

namespace {

namespace fs = std::filesystem;

/// Frequency of a mesh of SH coefficients: 2,562 points.
constexpr int frequency = 16;

double diameter_of(double volume) { return portable::cbrt(6.0 / pi * volume); }

/// Returns the descriptors that are quick to measure. Any other descriptor needs all descriptors.
std::vector<DescriptorValue> quick_descriptors(const IndexedMesh& mesh,
                                               const Execution& execution) {
  const QuickShape quick = quick_shape(mesh, execution);
  std::vector<DescriptorValue> rows = list_descriptors(quick.shape);
  rows.push_back({"zingg_elongation_inertia", "", "", quick.form.zingg_elongation});
  rows.push_back({"zingg_flatness_inertia", "", "", quick.form.zingg_flatness});
  rows.push_back({"convexity", "", "", quick.convexity});
  return rows;
}

const DescriptorValue* find(const std::vector<DescriptorValue>& rows, const std::string& key) {
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [&](const DescriptorValue& r) { return r.key == key; });
  return row == rows.end() ? nullptr : &*row;
}

bool hold_all(const std::vector<DescriptorValue>& rows, const std::vector<std::string>& keys) {
  return std::all_of(keys.begin(), keys.end(),
                     [&](const std::string& key) { return find(rows, key) != nullptr; });
}

/// Returns whether all descriptors are quick. Throws for an unknown descriptor, before grains are
/// read.
bool are_quick(const std::vector<std::string>& keys) {
  const Execution one_thread(1);
  const IndexedMesh sphere = mesh_of_surface(Ellipsoid(Vector3::Ones()), 2, one_thread);
  if (hold_all(quick_descriptors(sphere, one_thread), keys)) return true;
  const std::vector<DescriptorValue> rows =
      list_descriptors(describe_shape_in_detail(sphere, DetailedOptions(), one_thread));
  for (const std::string& key : keys) {
    if (find(rows, key) != nullptr) continue;
    std::vector<std::string> names;
    for (const DescriptorValue& known : rows) names.emplace_back(known.key);
    refuse("There is no descriptor \"" + key + "\". Choose from: " + listed(names) + ".");
  }
  return false;
}

/// Returns the diameter of a grain, then its descriptors.
std::vector<double> measured(const std::string& file, const std::vector<std::string>& keys,
                             bool quick, const Execution& execution) {
  const IndexedMesh mesh = grain_mesh(file, execution);
  const std::vector<DescriptorValue> rows =
      quick ? quick_descriptors(mesh, execution)
            : list_descriptors(describe_shape_in_detail(mesh, DetailedOptions(), execution));
  std::vector<double> values = {diameter_of(find(rows, "volume")->value)};
  for (const std::string& key : keys) {
    const DescriptorValue* row = find(rows, key);
    if (!std::isfinite(row->value)) {
      refuse("The grain has no " + key + ". Leave out the descriptor or the grain.");
    }
    values.push_back(row->value);
  }
  return values;
}

void add(DescribedSample& sample, const std::string& file, const std::vector<double>& values,
         std::vector<std::vector<double>>& rows) {
  sample.files.push_back(file);
  sample.diameters.push_back(values.front());
  rows.emplace_back(values.begin() + 1, values.end());
}

void fill(DescribedSample& sample, const std::vector<std::vector<double>>& rows,
          std::size_t columns) {
  sample.descriptors.resize(rows.size(), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      sample.descriptors(i, j) = rows[i][j];
    }
  }
}

/// Throws for a descriptor that is equal for all grains, such as the convexity of ellipsoids.
void check_choice(const DescribedSample& sample, const std::vector<std::string>& keys) {
  for (std::size_t j = 0; j < keys.size() && sample.descriptors.rows() > 1; ++j) {
    const auto column = sample.descriptors.col(j);
    const double largest = column.cwiseAbs().maxCoeff();
    if (column.maxCoeff() - column.minCoeff() > 1e-11 * largest) continue;
    refuse("The descriptor \"" + keys[j] +
           "\" is equal for all grains, so it cannot choose templates. Give others with "
           "--templates=NAMES.");
  }
}

/// Returns the column with the prefix "scan.", or else without it.
std::size_t column_of(const GrainTable& table, const std::string& key) {
  const auto found = table.find("scan." + key);
  return found ? *found : table.index_of(key);
}

/// Returns the scan of a grain, if the grain's name is a path, because the descriptors are the
/// scan's; else empty.
fs::path scan_of(const GrainTable& table, std::size_t grain, const fs::path& folder) {
  std::error_code ignored;
  const std::string_view name = text_of_field(table.grains[grain]);
  for (const fs::path& scan : {fs::path(name), folder / name}) {
    if (fs::is_regular_file(scan, ignored)) return scan;
  }
  return {};
}

/// Returns the table of shapes: the only input, or shape.csv in the only folder; else empty.
std::string table_among(const std::vector<std::string>& inputs) {
  if (inputs.size() != 1) return "";
  if (ending_of(inputs.front()) == ".csv") return inputs.front();
  const fs::path table = fs::path(inputs.front()) / "shape.csv";
  std::error_code ignored;
  return fs::is_regular_file(table, ignored) ? table.string() : "";
}

DescribedSample sample_of_table(const std::string& path, const std::vector<std::string>& keys) {
  const GrainTable table = read_grain_table(path);
  std::vector<std::size_t> columns = {column_of(table, "volume")};
  for (const std::string& key : keys) columns.push_back(column_of(table, key));
  const fs::path folder = fs::path(path).parent_path();
  DescribedSample sample;
  sample.left_out = table.failed;
  std::vector<std::vector<double>> rows;
  for (std::size_t grain = 0; grain < table.grains.size(); ++grain) {
    std::vector<double> values;
    values.reserve(columns.size());
    for (const std::size_t column : columns) {
      values.push_back(table.values(grain, column));
    }
    values.front() = diameter_of(values.front());
    const bool is_whole = std::all_of(values.begin(), values.end(),
                                      [](double value) { return std::isfinite(value); });
    if (!is_whole || !(values.front() > 0.0)) {
      ++sample.left_out;
      continue;
    }
    fs::path file = scan_of(table, grain, folder);
    if (file.empty()) {
      file = folder / (table.files.empty() ? table.grains[grain] : table.files[grain]);
    } else if (table.find("scan.volume")) {
      sample.measured_before.insert(file.string());
    }
    add(sample, file.string(), values, rows);
  }
  fill(sample, rows, keys.size());
  check_choice(sample, keys);
  return sample;
}

}  // namespace

IndexedMesh grain_mesh(const std::string& file, const Execution& execution) {
  if (is_coefficient_file(file)) {
    return std::visit(
        [&](const auto& shape) { return mesh_of_surface(shape, frequency, execution); },
        read_coefficients(file));
  }
  MeshFile read = read_mesh_file(file, execution);
  return check_mesh(std::move(read.mesh), MeshCheckOptions(), execution).mesh;
}

DescribedSample described_sample(const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& keys, int threads, bool quiet) {
  const std::string table = table_among(inputs);
  if (!table.empty()) return sample_of_table(table, keys);
  const bool quick = are_quick(keys);
  const std::vector<std::string> files = shape_files(inputs);
  std::vector<std::vector<double>> measures(files.size());
  DescribedSample sample;
  sample.left_out = read_each(files, threads, quiet, [&](std::size_t k, const Execution& one) {
    measures[k] = measured(files[k], keys, quick, one);
  });
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (!measures[k].empty()) add(sample, files[k], measures[k], rows);
  }
  fill(sample, rows, keys.size());
  check_choice(sample, keys);
  return sample;
}

}  // namespace wscvt::program
