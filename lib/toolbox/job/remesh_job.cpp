// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/remesh_job.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "toolbox/clump/first_contact.h"
#include "toolbox/exchange/simulation_files.h"
#include "toolbox/job/extract_job.h"
#include "toolbox/report/sample_report.h"
#include "toolbox/report/sample_table.h"
#include "toolbox/report/shape_table.h"
#include "wscvt/base/error.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/measures/carried_attributes.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

/// Whether files are for a simulation. Then a table has the grains' masses.
bool is_for_simulation(const RemeshJob& job) {
  const FrameOptions& frame = job.simulation.frame;
  return frame.frame != Frame::Input || frame.scale != 1.0 || frame.size > 0.0 ||
         !job.node_tables.empty() || !job.grids.empty();
}

std::string call_text(const RemeshJob& job) {
  Json call = {{"format", "wscvt-batch"},
               {"made_by", made_by()},
               {"meshes", job.format},
               {"levels", job.levels},
               {"describe", key_of(job.shapes.described)},
               {"contacts", job.shapes.contacts},
               {"resolution", job.shapes.resolution},
               {"volume", json_of(job.volume)},
               {"options", json_of(job.remesh)}};
  if (is_for_simulation(job)) {
    const SimulationOptions& simulation = job.simulation;
    call["simulation"] = {{"frame", key_of(simulation.frame.frame)},
                          {"scale", simulation.frame.scale},
                          {"size", simulation.frame.size},
                          {"node-table", job.node_tables},
                          {"sdf", job.grids},
                          {"sdf-spacing", simulation.grid.spacing}};
  }
  return json_document(call);
}

/// Returns the header and the row of a table of masses, without its first columns.
std::string mass_csv(const std::string& file, const MassProperties& mass) {
  Json row = {{"file", told(file)}};
  row.update(json_of(mass));
  return csv_of(row);
}

/// Measures of a grain's scan, made with its first level.
struct MeasuredScan {
  std::optional<DetailedDescriptors> shape;
  std::optional<ScanContacts> contacts;
  std::optional<Resolution> resolution;
};

/// Returns the measures of a level. A failed measurement becomes a warning of the remesh, and its
/// message is written to `error`.
GrainShape measure_level(const RemeshJob& job, double voxel_size, RemeshResult& result,
                         MeasuredScan& scan, std::string& error, const Execution& execution) {
  const ShapeMeasures& measures = job.shapes;
  const Described what = measures.described;
  const bool needs_scan = describes_scan(what) && !scan.shape;
  const Described now = needs_scan               ? what
                        : describes_remesh(what) ? Described::Remesh
                                                 : Described::None;
  GrainShape shape;
  try {
    shape = describe_result(result, now, execution);
    if (needs_scan) scan.shape = std::move(shape.scan);
    shape.scan = scan.shape;
    if (measures.resolution && scan.shape) {
      if (!scan.resolution) {
        scan.resolution =
            resolution_of(job.volume, voxel_size, result.repaired_scan, *scan.shape, execution);
      }
      shape.resolution = scan.resolution;
    }
    if (measures.contacts) {
      if (!scan.contacts) scan.contacts.emplace(result.repaired_scan, result.scan, execution);
      shape.contacts = scan.contacts->errors_of(result.mesh, execution);
    }
  } catch (const Error& failure) {
    if (failure.code() == ErrorCode::Cancelled) throw;
    error = failure.what();
    result.warnings.push_back("The descriptors could not be measured: " + error);
  }
  return shape;
}

/// Remeshes a grain.
class GrainRemesh {
 public:
  GrainRemesh(const RemeshJob& job, GrainAtWork& grain) : job_(job), grain_(grain) {}

  /// Writes the files of the grain and returns its records.
  std::vector<std::string> records() {
    std::vector<std::string> records;
    std::vector<RemeshResult> results = remeshes();
    for (std::size_t level = 0; level < results.size(); ++level) {
      RemeshResult& result = results[level];
      const JobFolder& folder = grain_.folders[level];
      result.warnings.insert(result.warnings.begin(), grain_.scan.warnings.begin(),
                             grain_.scan.warnings.end());
      std::string error;
      GrainShape shape;
      const bool describes = job_.shapes.described != Described::None;
      if (describes) {
        shape =
            measure_level(job_, grain_.scan.voxel_size, result, measured_, error, grain_.execution);
      }
      // Only the first result has it.
      if (level > 0) result.repaired_scan = std::move(results[level - 1].repaired_scan);
      write_files(result, folder);
      records.push_back(sample_row(grain_.name, result));
      const std::string file = folder.name_of(grain_.name);
      if (describes) {
        records.push_back(error.empty() ? shape_row(grain_.name, file, result, shape)
                                        : failed_shape_row(grain_.name, error, job_.shapes));
      }
      if (is_for_simulation(job_)) {
        const MassProperties mass = in_frame(mass_properties(result.scan),
                                             simulation_frame(result.scan, job_.simulation.frame));
        records.push_back(sample_row(grain_.name, mass_csv(file, mass)));
      }
    }
    return records;
  }

 private:
  /// Returns one remesh per level. The scan is read_ then, if its colours and labels are carried.
  std::vector<RemeshResult> remeshes() {
    const std::string first = grain_.folders.front().file_of(grain_.name);
    RemeshOptions options = job_.remesh;
    options.measures.repaired_scan =
        describes_scan(job_.shapes.described) || job_.shapes.contacts || !job_.grids.empty();
    options.measures.written = [&](const RemeshResult& made) {
      return as_written(in_frame(made.mesh, simulation_frame(made.scan, job_.simulation.frame)),
                        first);
    };
    IndexedMesh& scan = grain_.scan.mesh;
    if (!job_.grids.empty()) check_grid_of(scan, options, job_.simulation, grain_.execution);
    carries_ = holds_attributes(first) && !grain_.scan.attributes.empty();
    if (carries_) read_ = scan;
    if (!job_.levels.empty()) {
      return remesh_levels(std::move(scan), options, job_.levels, grain_.execution);
    }
    std::vector<RemeshResult> results;
    results.push_back(remesh(std::move(scan), options, grain_.execution));
    return results;
  }

  void write_files(const RemeshResult& result, const JobFolder& folder) const {
    const SimulationOptions& simulation = job_.simulation;
    const MeshAttributes attributes =
        carries_ ? carried_attributes(read_, grain_.scan.attributes, result.mesh, grain_.execution)
                 : MeshAttributes();
    write_mesh(in_frame(result.mesh, simulation_frame(result.scan, simulation.frame)), attributes,
               folder.file_of(grain_.name));
    for (const std::string& ending : job_.node_tables) {
      write_nodes(folder.file_of(grain_.name, {"node-table", ending}), result, simulation);
    }
    for (const std::string& ending : job_.grids) {
      write_distance_grid(folder.file_of(grain_.name, {"sdf", ending}), result, simulation,
                          {grain_.name, ""}, grain_.execution);
    }
  }

  const RemeshJob& job_;
  GrainAtWork& grain_;
  IndexedMesh read_;
  bool carries_ = false;
  MeasuredScan measured_;
};

/// Returns the states of the labels of a job's volumes; empty if it has none.
CensusStates label_states(const GrainJob& job) {
  const std::string table =
      file_content((std::filesystem::path(job.folder) / "labels.csv").string());
  if (table.rfind(label_header(), 0) != 0) return {};
  CensusStates states = census_states(table);
  // A batch of meshes may stand beside the table of extract.
  return states.count("written") > 0 ? CensusStates() : states;
}

/// Returns the shapes of the grains of a folder; no table if none was described.
SampleTables shapes_of(const JobFolder& folder) {
  SampleTables shapes;
  try {
    shapes.tables.push_back(read_grain_table(folder.file("shape", ".csv")));
    shapes.files.push_back(folder.file("shape", ".csv"));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InvalidInput) throw;  // a table in which all grains failed
  }
  return shapes;
}

/// Returns the batch of a folder, with the statistics of its scans, or else its remeshes, if at
/// least two were described.
SampleReport report_of(const JobFolder& folder, const SampleTables& shapes,
                       const Execution& execution) {
  SampleReport report;
  if (!shapes.tables.empty()) {
    try {
      add_sample(report, "", shapes, {}, mark_option.minimum, execution);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::InvalidInput) throw;  // fewer than two grains
    }
  }
  if (report.samples.empty()) report.samples.emplace_back();
  ReportedSample& one = report.samples.front();
  if (!one.batch) one.batch = summarise_table(folder.table());
  return report;
}

}  // namespace

void check_job(const RemeshJob& job) {
  check_options(job.remesh);
  const std::set<int> levels(job.levels.begin(), job.levels.end());
  if (levels.size() < job.levels.size()) {
    refuse("The list of numbers of nodes has a number twice. Give it once.");
  }
  if (!job.levels.empty() && job.remesh.target.percent > 0.0) {
    refuse(mention("max-error") + " needs a single number of nodes. Leave it out.");
  }
  check_format(job.format);
  check_simulation_options(job.simulation);
  for (const std::string& ending : job.node_tables) {
    check_nodes_path("nodes." + ending, job.simulation);
  }
  for (const std::string& ending : job.grids) check_grid_path("grid." + ending);
}

GrainJob make_job(const RemeshJob& options, const std::string& folder, const Shard& shard) {
  const auto shared = std::make_shared<const RemeshJob>(options);
  const bool describes = options.shapes.described != Described::None;
  const bool has_masses = is_for_simulation(options);
  GrainJob job{folder, shard, options.format};
  for (const std::string& ending : options.node_tables) {
    job.more_files.push_back({"node-table", ending});
  }
  for (const std::string& ending : options.grids) {
    job.more_files.push_back({"sdf", ending});
    if (!grid_description_path("grid." + ending).empty()) {
      job.more_files.push_back({"sdf", ending + ".json"});
    }
  }
  for (const int nodes : options.levels) job.levels.push_back("n" + std::to_string(nodes));
  job.call = call_text(options);
  job.tables = {{"grains", sample_header()}};
  if (describes) job.tables.push_back({"shape", shape_header(options.shapes)});
  const std::string no_mass = mass_csv("", {});
  if (has_masses) job.tables.push_back({"mass", sample_header(no_mass)});
  job.has_census = true;
  job.reads_pictures = holds_attributes("mesh." + options.format);
  job.make = [shared](GrainAtWork& grain) { return GrainRemesh(*shared, grain).records(); };
  job.failed = [=](const std::string& grain, const std::string& error) {
    std::vector<std::string> records = {failed_row(grain, error)};
    if (describes) records.push_back(failed_shape_row(grain, error, shared->shapes));
    if (has_masses) records.push_back(failed_row(grain, error, no_mass));
    return records;
  };
  return job;
}

std::vector<std::string> write_summaries(const GrainJob& job, const Execution& execution) {
  std::vector<std::string> lines;
  if (job.shard.count > 1) return lines;
  const CensusStates labels = label_states(job);
  const auto described = std::find_if(job.tables.begin(), job.tables.end(),
                                      [](const JobTable& one) { return one.name == "shape"; });
  SampleTables shapes;
  for (const JobFolder& folder : folders_of(job)) {
    shapes = described == job.tables.end() ? SampleTables() : shapes_of(folder);
    SampleReport report = report_of(folder, shapes, execution);
    SampleSummary& summary = *report.samples.front().batch;
    summary.labels = labels;
    for (GrainDistance& one : summary.farthest) one.file = folder.file_of(one.grain);
    write_file(folder.file("summary", ".json"), summary_json(summary));
    write_sample_report(folder.file("summary", ".html"), report, execution);
    std::vector<std::string> told = summary_lines(summary);
    if (!job.levels.empty()) {
      const std::string level = std::filesystem::path(folder.path()).filename().string();
      told = {level + ": " + told.front()};
    }
    lines.insert(lines.end(), told.begin(), told.end());
  }
  // With the most nodes.
  if (!shapes.tables.empty() && described->header.find("resolution.") != std::string::npos) {
    const std::vector<std::string> of_voxels = voxel_lines(shapes.tables.front());
    lines.insert(lines.end(), of_voxels.begin(), of_voxels.end());
  }
  return lines;
}

}  // namespace wscvt
