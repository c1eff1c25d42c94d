// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure_arguments.h"

#include <utility>
#include <vector>

#include "command.h"
#include "output_paths.h"
#include "toolbox/clump/sphere.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/resolution/resolution.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/measures/grain_measures.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/report/report.h"

namespace wscvt::program {

void add_measure_arguments(CLI::App& app, MeasureArguments& arguments) {
  const auto add = [&](double& value, const NumberOption<double>& option) {
    add_number(app, "--" + std::string(option.key), value, option);
  };
  add(arguments.options.roundness_ball, roundness_ball_option);
  add(arguments.options.roughness_cutoff, roughness_cutoff_option);
  add_common_arguments(app, arguments.common, "-o,--report");  // their only output
}

void measure(const MeasureArguments& arguments, const std::optional<std::string>& reference) {
  const CommonArguments& common = arguments.common;
  checked([&] {
    if (!is_clump_file(arguments.grain)) check_mesh_input(arguments.grain);
    if (reference) check_mesh_input(*reference);
    check_output_paths({{"the grain", arguments.grain}, {"the reference", reference.value_or("")}},
                       named_reports(common.reports), common.overwrite);
    for (const std::string& report : common.reports) {
      check_descriptor_report(report, reference.has_value(), arguments.voxel_size.has_value());
    }
  });
  Work work(common);
  std::vector<Sentence> warnings;
  const auto read = [&](const std::string& path, double begin, double end) {
    if (is_clump_file(path)) {
      return NamedMesh{path, sphere_union_mesh(read_clump(path), work.execution())};
    }
    MeshFile file = read_mesh_file(path, work.execution().part(begin, end));
    warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
    return NamedMesh{path, std::move(file.mesh)};
  };
  NamedMesh grain = read(arguments.grain, 0.0, 0.5 * reading_share);
  std::optional<NamedMesh> compared;
  if (reference) compared = read(*reference, 0.5 * reading_share, reading_share);
  const double share = arguments.voxel_size ? 0.5 : 1.0;
  GrainMeasures measures = measure_grain(std::move(grain), std::move(compared), arguments.options,
                                         work.execution().part(reading_share, share));
  if (arguments.voxel_size) {
    ResolutionOptions options;
    options.voxel_size = *arguments.voxel_size;
    options.details = arguments.options;
    measures.resolution =
        measure_resolution(measures.grain.checked.mesh, measures.grain.descriptors, options,
                           work.execution().part(share, 1.0));
  }
  for (const std::string& report : common.reports) {
    work.write(report, [&](const std::string& path, const Execution& execution) {
      write_report(path, measures, origin_of(arguments.grain), execution);
    });
  }
  for (const Sentence& remark : remarks(measures)) warnings.push_back(remark);
  work.print(warnings, descriptor_lines(measures));
}

}  // namespace wscvt::program
