// SPDX-License-Identifier: GPL-3.0-or-later
#include "grain_job.h"

#include <filesystem>
#include <system_error>

#include "wrong_call.h"
#include "wscvt/base/output_file.h"

namespace wscvt::program {

namespace fs = std::filesystem;

GrainRunEnd run_job(const GrainJob& job, BatchGrains& inputs, BatchOutput& output) {
  const std::vector<std::string>& grains = inputs.names();
  checked([&] { output.check_meshes(grains); });
  std::error_code error;
  fs::create_directories(output.whole().path(), error);
  checked([&] { check_call(output.whole().call(), job.call, output.is_begun()); });
  for (const OutputFolder& level : output.levels()) fs::create_directories(level.path(), error);
  const std::size_t first = checked([&] { return output.open_tables(grains, job.headers); });
  output.remove_parts(grains, first);
  if (job.writes_labels) {
    const std::string labels = inputs.label_table(
        [&](const std::string& grain) { return output.levels().front().mesh_name(grain); });
    if (!labels.empty()) write_file(output.whole().labels(), labels);
  }
  inputs.begin(first);
  GrainRun all;
  all.first = first;
  all.failed = output.failed_rows();
  all.count = grains.size();
  all.threads = job.threads;
  all.quiet = job.quiet;
  all.when_stopped = "The same call continues from there.";
  all.name = [&](std::size_t k) { return grains[k]; };
  all.work = job.work;
  all.take = [&](std::size_t, const GrainRow& row) { output.append(row); };
  return run_grains(all);
}

}  // namespace wscvt::program
