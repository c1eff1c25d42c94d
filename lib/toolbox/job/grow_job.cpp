// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grow_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numeric>
#include <utility>

#include "toolbox/sample/grain_grower.h"
#include "toolbox/sample/grain_table.h"
#include "toolbox/sample/grown_mesh.h"
#include "toolbox/sample/nearest_grain.h"
#include "toolbox/sample/sample_comparison.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

constexpr const char* table_heading[] = {"grain",
                                         "file",
                                         "equivalent_diameter [length]",
                                         "volume [length^3]",
                                         "sphericity",
                                         "inertia_elongation",
                                         "inertia_flatness",
                                         "convexity",
                                         "overhang [%]",
                                         "donors",
                                         "nearest_grain",
                                         "nearest_distance [%]",
                                         "collage [%]",
                                         "redraws"};

/// Key of the random order of sizes, above every grain's number.
constexpr std::uint64_t size_key = std::uint64_t{1} << 61;

/// Descriptors of the real grains, for the summary.
struct RealNumbers {
  std::vector<double> sphericity, elongation, flatness, convexity, overhangs;

  explicit RealNumbers(std::size_t count)
      : sphericity(count), elongation(count), flatness(count), convexity(count), overhangs(count) {}
};

/// All data to make and measure a grain.
struct Growing {
  const GrowJob& job;
  std::vector<std::string> files;  ///< of the real grains
  GrainGrower grower;
  GrainSearch search;
  GrownMeshes meshes;
};

bool writes_coefficients(const GrowJob& job) { return job.format == "json"; }

std::string short_name(const std::string& file) { return fs::path(file).filename().string(); }

/// Returns the overhang fraction; 0 for a star-shaped grain.
double overhang_of(const OffsetSeries& offset, const IndexedMesh& mesh, const QuickShape& quick,
                   const Execution& execution) {
  return has_offset(offset) ? overhang_solid_angle(mesh, quick.shape.centroid, execution) : 0.0;
}

void write_coefficients(const std::string& path, const GrownGrain& grain) {
  if (has_offset(grain.offset)) {
    write_harmonic_map(path, harmonic_map_of(grain.radial, grain.offset, grain.radius));
    return;
  }
  std::vector<double> coefficients = grain.radial;
  for (double& coefficient : coefficients) coefficient *= grain.radius;
  write_harmonics(path, HarmonicSurface(std::move(coefficients)));
}

/// Writes the file of a grain and returns its record.
std::string grown_record(const Growing& growing, const GrainAtWork& at_work) {
  const GrowJob& job = growing.job;
  const Execution& execution = at_work.execution;
  const JobFolder& folder = at_work.folders.front();
  const std::size_t k = at_work.scan.place;
  GrownBody body = grow_body(growing.grower, growing.meshes, k);
  GrownGrain& grain = body.grain;
  if (job.sizes) {
    // The curve is divided into as many parts as there are grains, and each part gives one size.
    const auto count = static_cast<std::size_t>(job.grains);
    const std::size_t part = drawn_place(k, count, job.options.seed, size_key);
    const double fraction = (static_cast<double>(part) + 0.5) / static_cast<double>(count);
    const double radius = 0.5 * job.sizes->diameter(fraction);
    for (Vector3& point : body.mesh.points) point *= radius / grain.radius;
    grain.radius = radius;
  }
  const QuickShape shape = quick_shape(body.mesh, execution);
  const double overhang = overhang_of(grain.offset, body.mesh, shape, execution);
  const NearestGrain nearest = growing.search.nearest(grain.radial);
  const std::string path = folder.file_of(at_work.name);
  if (writes_coefficients(job)) {
    write_coefficients(path, grain);
  } else {
    write_mesh(body.mesh, path);
  }
  std::string donors;
  for (const std::size_t donor : grain.donors) {
    donors += (donors.empty() ? "" : ";") + short_name(growing.files[donor]);
  }
  const double cube = grain.radius * grain.radius * grain.radius;
  return csv_record(
      {at_work.name, folder.name_of(at_work.name), format_exact(2.0 * grain.radius),
       format_exact(4.0 * pi / 3.0 * cube), format_exact(shape.shape.sphericity),
       format_exact(shape.form.zingg_elongation), format_exact(shape.form.zingg_flatness),
       format_exact(shape.convexity), format_exact(100.0 * overhang), donors,
       short_name(growing.files[nearest.grain]), format_exact(100.0 * nearest.distance),
       format_exact(100.0 * grain.collage), std::to_string(grain.redraws)});
}

RealNumbers numbers_of_sample(const Growing& growing, const Execution& execution) {
  const std::vector<SampleGrain>& sample = growing.grower.sample();
  RealNumbers numbers(sample.size());
  execution.parallel_for(sample.size(), 8, [&](std::size_t begin, std::size_t end) {
    const Execution one_thread(1);
    for (std::size_t k = begin; k < end; ++k) {
      const IndexedMesh mesh = growing.meshes.mesh(sample[k].radial, 1.0, sample[k].radial_offset);
      const QuickShape shape = quick_shape(mesh, one_thread);
      numbers.sphericity[k] = shape.shape.sphericity;
      numbers.elongation[k] = shape.form.zingg_elongation;
      numbers.flatness[k] = shape.form.zingg_flatness;
      numbers.convexity[k] = shape.convexity;
      numbers.overhangs[k] = overhang_of(sample[k].radial_offset, mesh, shape, one_thread);
    }
  });
  return numbers;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string percent(double value) { return format_number(value, 3) + " %"; }

/// Returns the lines of a log, from the table of the grown grains.
std::vector<std::string> lines_of(const Growing& growing, const GrainTable& table,
                                  std::size_t left_out, const Execution& execution) {
  const std::size_t real = growing.grower.sample().size();
  const std::size_t grown = table.grains.size();
  const RealNumbers sample = numbers_of_sample(growing, execution);
  const auto column = [&](const char* name) {
    const auto values = table.values.col(table.index_of(name));
    return std::vector<double>(values.begin(), values.end());
  };
  const auto distance = [&](const char* name, const std::vector<double>& of_sample) {
    return format_number(
        distance_between(Distribution(column(name)), Distribution(of_sample)).kolmogorov, 2);
  };
  std::vector<double> nearest = column("nearest_distance");
  std::sort(nearest.begin(), nearest.end());
  const std::vector<double> redraws = column("redraws");
  const auto redrawn =
      redraws.size() - static_cast<std::size_t>(std::count(redraws.begin(), redraws.end(), 0.0));
  // Two samples of one population have a larger distance once in twenty times.
  const double by_chance =
      1.36 * std::sqrt(1.0 / static_cast<double>(real) + 1.0 / static_cast<double>(grown));
  std::vector<std::string> lines = {
      format_count(grown, "virtual grain") + " of " + std::to_string(real) + " real ones (" +
          std::to_string(left_out) + " left out), " + std::to_string(growing.job.options.donors) +
          " donors each, degree " + std::to_string(growing.job.degree) + ", seed " +
          std::to_string(growing.job.options.seed) + ".",
      "Drawn again, because the grain was not star-shaped or intersected itself: " +
          std::to_string(redrawn) + ".",
      "Kolmogorov-Smirnov distance to the sample (" + format_number(by_chance, 2) +
          " by chance in 1 of 20 samples):"};
  for (const std::string& line :
       aligned_lines({{"  sphericity", distance("sphericity", sample.sphericity)},
                      {"  I/L of inertia", distance("inertia_elongation", sample.elongation)},
                      {"  S/I of inertia", distance("inertia_flatness", sample.flatness)},
                      {"  convexity", distance("convexity", sample.convexity)}})) {
    lines.push_back(line);
  }
  lines.push_back("Distance to the nearest real grain, rms of the radius: median " +
                  percent(nearest[grown / 2]) + ", smallest " + percent(nearest.front()) + ".");
  lines.push_back("Usual distance between real grains: " +
                  percent(100.0 * growing.search.usual_distance(execution)) + ".");
  if (mean(sample.overhangs) > 0.0) {
    lines.push_back("Overhang fraction, mean: " + percent(mean(column("overhang"))) +
                    ", in the sample " + percent(100.0 * mean(sample.overhangs)) + ".");
  }
  lines.push_back("Collage, caps of 40 degrees that follow one donor: " +
                  percent(mean(column("collage"))) + ".");
  return lines;
}

std::unique_ptr<NamedGrains> grains_of(const GrowJob& job) {
  return std::make_unique<NamedGrains>("grown-", static_cast<std::size_t>(job.grains), 5);
}

GrainJob job_of(const GrowJob& options, const Growing& growing) {
  Json call = {{"format", "wscvt-grow"},       {"made_by", made_by()},   {"meshes", options.format},
               {"count", options.grains},      {"nodes", options.nodes}, {"degree", options.degree},
               {"seed", options.options.seed}, {"sample", growing.files}};
  // Scans may be replaced by others of the same names.
  for (const SampleGrain& real : growing.grower.sample()) call["radii"].push_back(real.radius);
  for (int k = 0; options.sizes && k <= 10; ++k) {
    call["sizes"].push_back(options.sizes->diameter(0.1 * k));
  }
  GrainJob job{options.folder, options.shard, options.format};
  job.call = json_document(call);
  job.tables = {{"grown", csv_record({std::begin(table_heading), std::end(table_heading)})}};
  job.is_kept = false;
  job.make = [&growing](GrainAtWork& grain) -> std::vector<std::string> {
    return {grown_record(growing, grain)};
  };
  return job;
}

}  // namespace

void check_job(const GrowJob& job) {
  require_in_range(job.degree, sample_degree_option);
  if (!writes_coefficients(job)) check_format(job.format);
}

void require_scans_kept(const GrowJob& job, const std::vector<std::string>& real) {
  require_scans_kept(GrainJob{job.folder, job.shard, job.format}, *grains_of(job), real);
}

MadeSample grow_grains(const GrowJob& options, RealGrains real, const SampleGrids& grids,
                       const JobHost& host) {
  const Execution execution(host.threads);
  GrainSearch search(real.grains);
  const Growing growing{options, std::move(real.files),
                        GrainGrower(std::move(real.grains), grids, options.options),
                        std::move(search), GrownMeshes(options.nodes, execution)};
  JoinedGrains grains(options.shard);
  grains.add(grains_of(options));
  const GrainJob job = job_of(options, growing);
  MadeSample grown;
  grown.end = run_job(job, grains, host);
  if (grown.end.was_cancelled()) return grown;
  const JobFolder folder = folders_of(job).front();
  if (options.shard.count > 1) return grown;
  grown.lines =
      lines_of(growing, read_grain_table(folder.file("grown", ".csv")), real.left_out, execution);
  return grown;
}

}  // namespace wscvt
