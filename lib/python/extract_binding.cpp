// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "conversion.h"
#include "toolbox/conforming/conforming_files.h"
#include "toolbox/volume/label_grains.h"
#include "work.h"
#include "wscvt/base/error.h"

namespace wscvt::python {

namespace py = pybind11;

namespace {

/// Result for a label of an array.
struct ExtractedGrain {
  LabelGrain grain;  ///< its mesh is empty if its largest piece is too small
  Sentence failure;  ///< why there is no mesh
};

struct Extracted {
  std::map<std::uint64_t, ExtractedGrain> grains;  ///< by the array's numbers
  std::vector<Sentence> warnings;
};

Extracted grains_of(const VolumeOfArray& array, const VolumeOptions& options, int threads,
                    const Execution& execution) {
  LabelGrains labels([&] { return array.open(); }, array.name, options, execution.part(0.0, 0.3));
  const std::vector<std::size_t>& taken = labels.taken();
  std::vector<std::size_t> all(taken.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  labels.want(all);
  std::vector<ExtractedGrain> made(taken.size());
  GrainRun run;
  run.count = taken.size();
  run.name = [&](std::size_t k) { return std::to_string(labels.labels()[taken[k]].label); };
  run.work = [&](std::size_t k, const Execution& one) -> GrainRow {
    try {
      made[k].grain = labels.read(k, one);
      made[k].failure = refusal_of(made[k].grain);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::Cancelled) throw;
      made[k].failure = error.sentence();
    }
    return {};
  };
  const Execution working = execution.part(0.3, 1.0);
  check_end(run_grains(run, host_of(threads, working)));
  Extracted extracted;
  extracted.warnings = labels.warnings();
  for (std::size_t k = 0; k < taken.size(); ++k) {
    const Label label = labels.labels()[taken[k]].label;
    const std::string name = labels.name_of(label);  // the number of a label that was renumbered
    extracted.grains.emplace(name.empty() ? label : std::stoull(name), std::move(made[k]));
  }
  return extracted;
}

/// All grains at once, with common walls. No grain has a failure of its own.
Extracted conforming_of(const VolumeOfArray& array, const VolumeOptions& options,
                        ConformingOptions walls, const Execution& execution) {
  LabelGrains labels([&] { return array.open(); }, array.name, options, execution.part(0.0, 0.1));
  const std::vector<Label> taken = taken_labels(labels);
  walls.smoothing = options.smoothing;
  const ConformingGrains result =
      conform_labels(labels.voxels(), taken, walls, execution.part(0.1, 1.0));
  std::vector<IndexedMesh> meshes = body_meshes(result, result.grains.size());
  Extracted extracted;
  extracted.warnings = labels.warnings();
  for (Sentence& warning : conforming_warnings(result, taken)) {
    extracted.warnings.push_back(std::move(warning));
  }
  for (std::size_t g = 0; g < taken.size(); ++g) {
    const std::string name = labels.name_of(taken[g]);
    ExtractedGrain& grain = extracted.grains[name.empty() ? taken[g] : std::stoull(name)];
    grain.grain.mesh = std::move(meshes[g]);
    grain.grain.pieces = result.grains[g].pieces;
  }
  return extracted;
}

py::dict extract(const py::object& labels, const std::array<double, 3>& voxel_size,
                 double background, std::int64_t smallest, bool at_border, int smoothing,
                 bool conforming, double edge_length, int nodes, int threads,
                 const py::object& progress) {
  VolumeOptions options;
  options.background = background;
  options.smallest = smallest;
  options.at_border = at_border;
  options.smoothing = smoothing;
  ConformingOptions walls;
  walls.edge_length = edge_length;
  walls.nodes = nodes;
  check_conforming_options(walls);
  if (!conforming && (edge_length > 0.0 || nodes > 0)) {
    refuse("edge_length and nodes are only for conforming=True.");
  }
  const VolumeOfArray array = volume_of(labels, "labels", voxel_size);
  const Extracted extracted = work_on(threads, progress, [&](const Execution& execution) {
    return of_array([&] {
      return conforming ? conforming_of(array, options, walls, execution)
                        : grains_of(array, options, threads, execution);
    });
  });
  for (const Sentence& warning : extracted.warnings) warn(warning);
  py::dict dict;
  for (const auto& [label, made] : extracted.grains) {
    if (!made.failure.empty()) warn("The label " + std::to_string(label) + ": " + made.failure);
    const LabelGrain& grain = made.grain;
    if (grain.mesh.points.empty()) continue;
    if (grain.pieces > 1) {
      warn("The label " + std::to_string(label) + " is in " + std::to_string(grain.pieces) +
           " pieces. The largest was used.");
    }
    dict[py::int_(label)] =
        py::make_tuple(array_of(grain.mesh.points), array_of(grain.mesh.triangles));
  }
  return dict;
}

}  // namespace

void bind_extract(py::module_& module) {
  const VolumeOptions defaults;
  module.def("extract", &extract, py::arg("labels"), py::arg("voxel_size"), py::kw_only(),
             py::arg("background") = defaults.background, py::arg("smallest") = defaults.smallest,
             py::arg("at_border") = defaults.at_border, py::arg("smoothing") = defaults.smoothing,
             py::arg("conforming") = false, py::arg("edge_length") = 0.0, py::arg("nodes") = 0,
             py::arg("threads") = 0, py::arg("progress") = py::none());
}

}  // namespace wscvt::python
