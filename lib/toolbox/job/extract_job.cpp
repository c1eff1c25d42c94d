// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/extract_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "toolbox/job/label_source.h"
#include "toolbox/report/sample_table.h"
#include "toolbox/report/shape_table.h"
#include "toolbox/resolution/resolution.h"
#include "toolbox/sample/csv_reader.h"
#include "toolbox/sample/grain_table.h"
#include "toolbox/volume/segmentation.h"
#include "wscvt/base/input_file.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/mesh_check.h"
#include "wscvt/repair/scan_advice.h"
#include "wscvt/repair/stray_vertex.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

std::string body_header() {
  return csv_record({"body", "state", "volume", "pores", "pore_volume", "boundary_edges", "x_min",
                     "y_min", "z_min", "x_max", "y_max", "z_max", "vertices", "faces", "file",
                     "name"});
}

/// Returns a record with the grain's name before it.
std::string named(const std::string& grain, const std::string& record) {
  const std::string name = csv_record({grain});
  return name.substr(0, name.size() - 2) + "," + record;
}

ShapeMeasures measures_of(const ExtractJob& job) {
  ShapeMeasures measures;
  measures.described = Described::Scan;
  measures.resolution = job.table == "labels";
  return measures;
}

/// Returns the record of a grain in the table of shapes. There is no remesh: it has no nodes.
std::string shape_record(const ExtractJob& job, const GrainAtWork& grain) {
  const ShapeMeasures measures = measures_of(job);
  if (!grain.scan.refused.empty()) {
    return failed_shape_row(grain.name, grain.scan.refused, measures);
  }
  try {
    CheckedMesh checked = check_mesh(grain.scan.mesh, MeshCheckOptions(), grain.execution);
    RemeshResult result;
    result.scan_quality = measure_quality(checked.mesh, grain.execution);
    result.repaired_scan = std::move(checked.mesh);
    result.input = std::move(checked.report);
    GrainShape shape = describe_result(result, measures.described, grain.execution);
    if (measures.resolution) {
      shape.resolution = resolution_of(job.volume, grain.scan.voxel_size, result.repaired_scan,
                                       *shape.scan, grain.execution);
    }
    return shape_row(grain.name, grain.folders.front().name_of(grain.name), result, shape);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    return failed_shape_row(grain.name, error.what(), measures);
  }
}

}  // namespace

CensusStates census_states(const std::string& census) {
  CensusStates states;
  std::istringstream stream(census);
  CsvReader reader(stream);
  std::vector<std::string> heading;
  std::vector<std::string> fields;
  reader.next(heading);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(heading.begin(), heading.end(), name) -
                                    heading.begin());
  };
  const std::size_t state = column("state");
  const std::size_t pore = column("pores");
  while (reader.next(fields)) {
    ++states["all"];
    const bool in_pieces = fields.at(state).rfind("in ", 0) == 0;
    ++states[in_pieces ? "pieces" : fields[state]];
    if (in_pieces) ++states["written"];
    if (pore < fields.size()) states["pores"] += std::stoul(fields[pore]);
  }
  return states;
}

Json json_of(const VolumeOptions& options) {
  Json json = Json::object();
  const auto put = [&](std::string_view key, const Json& value) { json[std::string(key)] = value; };
  put(smallest_option.key, options.smallest);
  put(smoothing_option.key, options.smoothing);
  const VolumeChoice& choice = options.choice;
  put(voxel_size_option.key, choice.voxel_size ? json_of(*choice.voxel_size) : Json());
  put("unit", choice.unit);
  put(parts_option.key, options.parts);
  put(separate_option.key, options.separate ? Json(*options.separate) : Json());
  put(channel_option.key, choice.channel ? Json(*choice.channel) : Json());
  put(frame_option.key, choice.frame ? Json(*choice.frame) : Json());
  put("array", choice.array);
  const bool is_nan = std::isnan(options.background);
  put(background_option.key, is_nan ? Json("nan") : Json(options.background));
  put(at_border_option.key, options.at_border);
  return json;
}

Resolution resolution_of(const VolumeOptions& volume, double voxel_size, const IndexedMesh& scan,
                         const DetailedDescriptors& descriptors, const Execution& execution) {
  const std::optional<Vector3>& given = volume.choice.voxel_size;
  if (voxel_size == 0.0 && given && given->minCoeff() == given->maxCoeff()) {
    voxel_size = (*given)[0];
  }
  ResolutionOptions options;
  if (voxel_size == 0.0 || volume.smoothing != options.smoothing) return {};
  options.voxel_size = voxel_size;
  return measure_resolution(scan, descriptors, options, execution);
}

void append_voxel_lines(const JobFolder& folder, std::vector<std::string>& lines) {
  try {
    const auto more = voxel_lines(read_grain_table(folder.file("shape", ".csv")));
    lines.insert(lines.end(), more.begin(), more.end());
  } catch (const Error& error) {
    if (error.code() != ErrorCode::InvalidInput) throw;  // a table in which all grains failed
  }
}

BodyGrains::BodyGrains(std::string path, double smallest, const Execution& execution)
    : path_(std::move(path)) {
  MeshFile file = read_mesh_file(path_, execution.part(0.0, 0.5));
  MeshBodies split =
      split_bodies(std::move(file.mesh), std::move(file.named_faces), execution.part(0.5, 1.0));
  bodies_ = std::move(split.list);
  warnings_ = std::move(file.warnings);
  warnings_.insert(warnings_.end(), split.warnings.begin(), split.warnings.end());
  double largest = 0.0;
  double open = 0.0;
  double closed = 0.0;
  for (const MeshBody& body : bodies_) largest = std::max(largest, body.volume);
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const MeshBody& body = bodies_[k];
    if (body.is_closed() && body.volume >= 0.01 * smallest * largest) taken_.push_back(k);
    (body.is_closed() ? closed : open) += static_cast<double>(body.mesh.triangles.size());
  }
  const std::string stray = stray_vertices();
  if (!stray.empty()) warnings_.push_back(stray);
  if (open == 0.0) return;
  left_out_ = open / (open + closed);
  warnings_.push_back(
      "Open surfaces have " + format_percent(left_out_) +
      " of the faces. They are only listed, not written. If their open edges lie on each other, "
      "merge the corners, in MeshLab by Filters > Cleaning and Repairing > Merge Close Vertices. "
      "wscvt batch --parts fills small holes.");
}

std::string BodyGrains::stray_vertices() const {
  std::string text;
  std::size_t others = 0;
  for (const std::size_t k : taken_) {
    const StrayVertex stray = find_stray_vertex(bodies_[k].mesh);
    if (stray.count == 0) continue;
    if (!text.empty()) {
      ++others;
      continue;
    }
    // The body has its own numbers of vertices.
    text = stray_vertex_sentence("A vertex of body " + std::to_string(k + 1), stray.place,
                                 stray.distance) +
           " Check that it belongs to the body.";
  }
  if (others == 0) return text;
  return text + " " +
         format_count(others, "other body has such a vertex.", "other bodies have such vertices.");
}

std::string BodyGrains::name(std::size_t grain) const { return name_of(taken_[grain]); }

GrainScan BodyGrains::read(std::size_t grain, bool /*with_pictures*/,
                           const Execution& /*execution*/) {
  GrainScan scan{bodies_[taken_[grain]].mesh};
  scan.record = [this, body = taken_[grain]](const std::string& file) {
    return named(name_of(body), row_of(body, file));
  };
  return scan;
}

std::string BodyGrains::row_of(std::size_t number, const std::string& file) const {
  const MeshBody& body = bodies_[number];
  std::vector<std::string> fields = {
      std::to_string(number + 1),
      !body.is_closed() ? "open" : file.empty() ? "too small" : "written",
      format_exact(body.volume),
      std::to_string(body.pores),
      format_exact(body.pore_volume),
      std::to_string(body.boundary_edges)};
  const Eigen::AlignedBox3d box = box_of(body.mesh.points);
  for (const Vector3& corner : {box.min(), box.max()}) {
    for (const double coordinate : corner) fields.push_back(format_exact(coordinate));
  }
  fields.push_back(std::to_string(body.mesh.points.size()));
  fields.push_back(std::to_string(body.mesh.triangles.size()));
  fields.push_back(file);
  fields.push_back(body.name);
  return csv_record(fields);
}

std::string BodyGrains::census(const MadeOf& made_of) const {
  std::string table = body_header();
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const bool is_taken = std::binary_search(taken_.begin(), taken_.end(), k);
    table += row_of(k, is_taken ? made_of(name_of(k)).file : "");
  }
  return table;
}

GrainJob make_job(const ExtractJob& options, const std::string& folder, const Shard& shard) {
  const bool of_labels = options.table == "labels";
  const std::string header = of_labels ? label_header() : named("grain", body_header());
  Json call = {{"format", "wscvt-extract"}, {"made_by", made_by()}, {"meshes", options.format}};
  if (of_labels) call["volume"] = json_of(options.volume);
  if (!of_labels) call["smallest"] = options.smallest_body;
  GrainJob job{folder, shard, options.format};
  job.call = json_document(call);
  job.tables = {{"grains", header}};
  if (options.describe) job.tables.push_back({"shape", shape_header(measures_of(options))});
  job.last_table = {options.table, of_labels ? header : body_header()};
  job.takes_refused = true;
  job.is_kept = false;
  job.make = [options](GrainAtWork& grain) {
    const JobFolder& place = grain.folders.front();
    const bool is_made = grain.scan.refused.empty();
    if (is_made) write_mesh(grain.scan.mesh, place.file_of(grain.name));
    std::vector<std::string> records = {
        grain.scan.record(is_made ? place.name_of(grain.name) : "")};
    if (options.describe) records.push_back(shape_record(options, grain));
    return records;
  };
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  job.failed = [columns, options](const std::string& grain, const std::string& error) {
    std::vector<std::string> fields = {grain, "", "", "failed", error};
    fields.resize(columns);
    std::vector<std::string> records = {csv_record(fields)};
    if (options.describe) records.push_back(failed_shape_row(grain, error, measures_of(options)));
    return records;
  };
  return job;
}

std::vector<std::string> write_census(const ExtractJob& options, const GrainJob& job,
                                      const GrainSource& grains) {
  if (job.shard.count > 1) return {};
  const JobFolder folder = folders_of(job).front();
  std::map<std::string, std::string> records;
  {
    InputFile rows(folder.table(), MissingFile::IsEmpty);
    CsvReader reader(rows);
    std::vector<std::string> fields;
    while (reader.next(fields)) records[fields.front()] = reader.text();
  }
  const std::string census = grains.census([&](const std::string& grain) -> MadeGrain {
    const std::string record = records[csv_field(grain)];
    const std::string error = failure_in(record);
    if (!error.empty()) return {"", "", error};
    return {folder.name_of(grain), record};
  });
  const OlderFiles older(folder.path(), {options.table + ".csv"});
  write_file(folder.file(options.table, ".csv"), census);
  std::error_code ignored;
  std::filesystem::remove(folder.table(), ignored);
  std::vector<std::string> lines = {census_line(census_states(census), options.table)};
  std::istringstream made(census);
  for (std::string& line :
       older.remove_but(column_of(made, "file"), grains.size() > 0 ? grains.file(0) : "")) {
    lines.push_back(std::move(line));
  }
  if (options.describe) append_voxel_lines(folder, lines);
  return lines;
}

}  // namespace wscvt
