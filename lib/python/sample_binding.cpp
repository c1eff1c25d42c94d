// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of grains and statistics of samples. The Python package combines these parts into NumPy's
// structured arrays.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

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
#include "toolbox/report/sample_report.h"
#include "toolbox/sample/sample_files.h"
#include "toolbox/volume/open_volume.h"
#include "work.h"
#include "wscvt/base/error.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Grains, files, columns as pairs of name and unit, a matrix with a row per grain, and the number
/// of grains that failed.
using TableParts =
    std::tuple<std::vector<std::string>, std::vector<std::string>,
               std::vector<std::pair<std::string, std::string>>, Eigen::MatrixXd, std::size_t>;

/// A name, and a table or the path of a table or of a batch's folder.
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
  const auto rows = static_cast<std::size_t>(table.values.rows());
  for (const auto& [name, texts] :
       {std::pair("grain", &table.grains), std::pair("file", &table.files)}) {
    if (texts->size() == rows || (texts == &table.files && texts->empty())) continue;
    refuse("The column \"" + std::string(name) + "\" has " + std::to_string(texts->size()) +
           " rows, and the numbers have " + std::to_string(rows) + ". Give one for each grain.");
  }
  return table;
}

SampleTables tables_of(NamedSample& sample, const Execution& execution) {
  auto& [name, path, parts] = sample;
  if (!parts) {
    refuse_volume_input(path, ways_of_volumes);
    return read_sample(path, execution);
  }
  SampleTables tables;
  tables.tables.push_back(table_of(std::move(*parts)));
  return tables;
}

py::object sample(std::vector<NamedSample> samples, const std::vector<std::string>& reports,
                  const std::string& diameter, const std::string& describe,
                  const std::vector<double>& density, double max_error, std::uint64_t seed,
                  int repetitions, int threads, const py::object& progress) {
  SampleReport report;
  report.options.size = value_of_name<SizeMeasure>(diameter);
  report.options.of = value_of_name<SampledMesh>(describe);
  report.options.seed = seed;
  report.options.repetitions = repetitions;
  const std::string json = work_on(threads, progress, [&](const Execution& execution) {
    for (NamedSample& one : samples) {
      add_sample(report, std::get<0>(one), tables_of(one, execution), density, max_error,
                 execution);
    }
    compare_samples(report, execution);
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
             py::arg("diameter") = key_of(defaults.size), py::arg("describe") = key_of(defaults.of),
             py::arg("density") = std::vector<double>(), py::arg("max_error") = usual_mark_percent,
             py::arg("seed") = defaults.seed, py::arg("repetitions") = defaults.repetitions,
             py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
