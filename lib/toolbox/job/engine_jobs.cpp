// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/engine_jobs.h"

#include <utility>
#include <vector>

#include "toolbox/clump/clump.h"
#include "toolbox/convex/convex_parts.h"
#include "toolbox/exchange/clump_files.h"
#include "toolbox/exchange/part_files.h"
#include "toolbox/report/clump_report.h"
#include "toolbox/report/parts_report.h"
#include "toolbox/report/sample_table.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

/// Returns the options of a job that must be equal when it is started again.
template <class Job>
std::string call_text(const char* format, const char* files, const Job& job, const Json& options) {
  Json call = {{"format", format},       {"made_by", made_by()},
               {files, job.format},      {"frame", key_of(job.frame.frame)},
               {"size", job.frame.size}, {"scale", job.frame.scale},
               {"density", job.density}};
  call.update(options);
  return json_document(call);
}

/// Returns the job with a table that has the columns of a report, given as CSV.
GrainJob reported_job(GrainJob job, const std::string& report) {
  job.tables = {{"grains", sample_header(report)}};
  job.failed = [report](const std::string& grain,
                        const std::string& error) -> std::vector<std::string> {
    return {failed_row(grain, error, report)};
  };
  return job;
}

template <class Result>
void add_warnings(const GrainScan& scan, Result& result) {
  result.warnings.insert(result.warnings.begin(), scan.warnings.begin(), scan.warnings.end());
}

}  // namespace

void check_job(const ClumpJob& options) {
  check_clump_options(options.clump);
  check_frame_options(options.frame);
  require_in_range(options.density, clump_density_option);
  check_clump_path("clump." + options.format);
}

void check_job(const ConvexJob& options) {
  check_options(options.remesh);
  check_options(options.convex);
  require_in_range(options.density, parts_density_option);
  check_frame_options(options.frame);
  check_part_file("parts." + options.format);
}

GrainJob make_job(const ClumpJob& options, const std::string& folder, const Shard& shard) {
  GrainJob job = reported_job({folder, shard, options.format}, clump_csv(ClumpResult()));
  job.call = call_text("wscvt-clumps", "clumps", options, {{"options", json_of(options.clump)}});
  job.make = [options](GrainAtWork& grain) -> std::vector<std::string> {
    ClumpResult clump = make_clump(std::move(grain.scan.mesh), options.clump, grain.execution);
    add_warnings(grain.scan, clump);
    write_clump(grain.folders.front().file_of(grain.name), clump, options.frame, options.density);
    return {sample_row(grain.name, clump_csv(clump, {grain.name, ""}))};
  };
  return job;
}

GrainJob make_job(const ConvexJob& options, const std::string& folder, const Shard& shard) {
  GrainJob job = reported_job({folder, shard, options.format}, parts_csv(PartsResult()));
  job.beside = [count = options.convex.parts](const std::string& file) {
    return parts_beside(file, count);
  };
  job.call = call_text("wscvt-convex", "parts", options,
                       {{"convex",
                         {{"count", options.convex.parts},
                          {"faces", options.convex.faces},
                          {"max-error", options.convex.tolerance}}},
                        {"options", json_of(options.remesh)}});
  job.make = [options](GrainAtWork& grain) -> std::vector<std::string> {
    PartsResult parts =
        make_parts(std::move(grain.scan.mesh), options.remesh, options.convex, grain.execution);
    add_warnings(grain.scan, parts);
    const Sentence warning = write_parts(grain.folders.front().file_of(grain.name), parts,
                                         options.frame, options.density)
                                 .warning;
    if (!warning.empty()) parts.warnings.push_back(warning);
    return {sample_row(grain.name, parts_csv(parts, {grain.name, ""}))};
  };
  return job;
}

}  // namespace wscvt
