// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of grains and the statistics of samples. The package makes NumPy's structured arrays of
// the parts that are given here.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "work.h"
#include "wscvt/base/error.h"
#include "wscvt/report/sample_report.h"
#include "wscvt/sample/sample_files.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Grains, files, columns as pairs of name and unit, a matrix with a row per grain, and the number
/// of grains that failed.
using TableParts =
    std::tuple<std::vector<std::string>, std::vector<std::string>,
               std::vector<std::pair<std::string, std::string>>, Eigen::MatrixXd, std::size_t>;

/// A name, and the table or the path of a table or of a batch's folder.
using NamedSample = std::tuple<std::string, std::string, std::optional<TableParts>>;

TableParts read_table(const std::filesystem::path& path) {
  GrainTable table = read_grain_table(path.string());
  std::vector<std::pair<std::string, std::string>> columns;
  for (GrainColumn& column : table.columns) {
    columns.emplace_back(std::move(column.name), std::move(column.unit));
  }
  return {std::move(table.grains), std::move(table.files), std::move(columns),
          std::move(table.values), table.failed};
}

GrainTable table_of(TableParts parts) {
  GrainTable table;
  table.grains = std::move(std::get<0>(parts));
  table.files = std::move(std::get<1>(parts));
  for (auto& [name, unit] : std::get<2>(parts)) {
    table.columns.push_back({std::move(name), std::move(unit)});
  }
  table.values = std::move(std::get<3>(parts));
  table.failed = std::get<4>(parts);
  return table;
}

/// A density for all samples, one per sample, or none.
using Densities = std::vector<double>;

/// The tables of a sample: one, or one per number of nodes.
struct ReadTables {
  std::vector<GrainTable> tables;
  std::vector<std::string> files;  ///< of the tables; empty if those are the caller's
};

ReadTables tables_of(NamedSample& sample) {
  auto& [name, path, parts] = sample;
  ReadTables read;
  if (parts) {
    read.tables.push_back(table_of(std::move(*parts)));
    return read;
  }
  read.files = sample_files(path);
  for (const std::string& file : read.files) read.tables.push_back(read_grain_table(file));
  return read;
}

py::object sample(std::vector<NamedSample> samples, const std::vector<std::string>& reports,
                  const std::string& size, const std::string& of, const Densities& density,
                  double mark, std::uint64_t seed, int repetitions, int threads,
                  const py::object& progress) {
  SampleReport report;
  report.options.size = value_of_name<SizeMeasure>(size);
  report.options.of = value_of_name<SampledMesh>(of);
  report.options.seed = seed;
  report.options.repetitions = repetitions;
  const std::string json = work_on(threads, progress, [&](const Execution& execution) {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const ReadTables read = tables_of(samples[k]);
      SampleOptions options = report.options;
      if (!density.empty()) options.density = density[std::min(k, density.size() - 1)];
      const std::size_t shown = finest_table(read.tables);
      ReportedSample one;
      one.name = std::get<0>(samples[k]);
      if (!read.files.empty()) {
        one.folder = std::filesystem::path(read.files[shown]).parent_path().string();
      }
      one.sample = sample_of(read.tables[shown], options);
      one.statistics = measure_sample(one.sample, options, execution);
      report.samples.push_back(std::move(one));
      if (k > 0 || read.tables.size() == 1) continue;
      DetailLevels levels = measure_levels(read.tables, mark);
      if (!levels.rows.empty()) report.levels = std::move(levels);
    }
    if (report.samples.size() > 1) {
      report.comparison = compare_samples(report.samples[0].sample, report.samples[1].sample,
                                          report.options, execution);
    }
    for (const std::string& path : reports) write_sample_report(path, report, execution);
    return sample_json(report);
  });
  return parsed(json);
}

}  // namespace

void bind_sample(py::module_& module) {
  const SampleOptions defaults;
  module.def("read_table", &read_table, py::arg("path"));
  module.def("sample_files", &sample_files, py::arg("path"));
  module.def("sample", &sample, py::arg("samples"), py::arg("reports"), py::kw_only(),
             py::arg("size") = key_of(defaults.size), py::arg("of") = key_of(defaults.of),
             py::arg("density") = Densities(), py::arg("mark") = 1.0,
             py::arg("seed") = defaults.seed, py::arg("repetitions") = defaults.repetitions,
             py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
