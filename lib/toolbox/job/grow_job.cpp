// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grow_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <utility>

#include "toolbox/exchange/template_files.h"
#include "toolbox/job/grain_files.h"
#include "toolbox/sample/grain_grower.h"
#include "toolbox/sample/grown_mesh.h"
#include "toolbox/sample/nearest_grain.h"
#include "toolbox/sample/sample_comparison.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/repair/overhangs.h"

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

/// Descriptors of the grains, for the summary.
struct GrownNumbers {
  std::vector<double> sphericity, elongation, flatness, convexity;

  explicit GrownNumbers(std::size_t count)
      : sphericity(count), elongation(count), flatness(count), convexity(count) {}
  void set(std::size_t k, const QuickShape& shape) {
    sphericity[k] = shape.shape.sphericity;
    elongation[k] = shape.form.zingg_elongation;
    flatness[k] = shape.form.zingg_flatness;
    convexity[k] = shape.convexity;
  }
};

/// All data to make and measure a grain.
struct Growing {
  const GrowJob& job;
  std::vector<std::string> files;  ///< of the real grains
  GrainGrower grower;
  GrainSearch search;
  GrownMeshes meshes;
  GrownNumbers numbers;
  std::vector<double> distances;  ///< to the nearest real grain
  std::vector<double> collages;
  std::vector<int> redraws;
  std::vector<double> overhangs;
};

std::string name_of(const GrowJob& job, std::size_t k) {
  const std::size_t digits = std::max<std::size_t>(5, std::to_string(job.grains).size());
  const std::string number = std::to_string(k + 1);
  return "grown-" + std::string(digits - number.size(), '0') + number;
}

std::string file_of(const GrowJob& job, std::size_t k) {
  return name_of(job, k) + "." + (job.coefficients ? "json" : job.format);
}

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

GrainRow grown_row(Growing& growing, std::size_t k, const Execution& execution) {
  const GrowJob& job = growing.job;
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
  const std::string path = (fs::path(job.folder) / file_of(job, k)).string();
  if (job.coefficients) {
    write_coefficients(path, grain);
  } else {
    write_mesh(body.mesh, path);
  }
  growing.overhangs[k] = overhang;
  growing.numbers.set(k, shape);
  growing.distances[k] = nearest.distance;
  growing.collages[k] = grain.collage;
  growing.redraws[k] = grain.redraws;
  std::string donors;
  for (const std::size_t donor : grain.donors) {
    donors += (donors.empty() ? "" : ";") + short_name(growing.files[donor]);
  }
  const double cube = grain.radius * grain.radius * grain.radius;
  return {{csv_record(
      {name_of(job, k), file_of(job, k), format_exact(2.0 * grain.radius),
       format_exact(4.0 * pi / 3.0 * cube), format_exact(shape.shape.sphericity),
       format_exact(shape.form.zingg_elongation), format_exact(shape.form.zingg_flatness),
       format_exact(shape.convexity), format_exact(100.0 * overhang), donors,
       short_name(growing.files[nearest.grain]), format_exact(100.0 * nearest.distance),
       format_exact(100.0 * grain.collage), std::to_string(grain.redraws)})}};
}

GrownNumbers numbers_of_sample(const Growing& growing, std::vector<double>& overhangs,
                               const Execution& execution) {
  const std::vector<SampleGrain>& sample = growing.grower.sample();
  GrownNumbers numbers(sample.size());
  overhangs.resize(sample.size());
  execution.parallel_for(sample.size(), 8, [&](std::size_t begin, std::size_t end) {
    const Execution one_thread(1);
    for (std::size_t k = begin; k < end; ++k) {
      const IndexedMesh mesh = growing.meshes.mesh(sample[k].radial, 1.0, sample[k].radial_offset);
      const QuickShape shape = quick_shape(mesh, one_thread);
      numbers.set(k, shape);
      overhangs[k] = overhang_of(sample[k].radial_offset, mesh, shape, one_thread);
    }
  });
  return numbers;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string percent(double fraction) { return format_number(100.0 * fraction, 3) + " %"; }

std::vector<std::string> lines_of(const Growing& growing, std::size_t left_out,
                                  const Execution& execution) {
  const std::size_t real = growing.grower.sample().size();
  const std::size_t grown = growing.distances.size();
  std::vector<double> overhangs;
  const GrownNumbers sample = numbers_of_sample(growing, overhangs, execution);
  const GrownNumbers& made = growing.numbers;
  const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
    return format_number(distance_between(Distribution(a), Distribution(b)).kolmogorov, 2);
  };
  std::vector<double> nearest = growing.distances;
  std::sort(nearest.begin(), nearest.end());
  const auto redrawn =
      growing.redraws.size() -
      static_cast<std::size_t>(std::count(growing.redraws.begin(), growing.redraws.end(), 0));
  // Two samples of one population have a larger distance once in twenty times.
  const double by_chance =
      1.36 * std::sqrt(1.0 / static_cast<double>(real) + 1.0 / static_cast<double>(grown));
  std::vector<std::string> lines = {
      std::to_string(grown) + (grown == 1 ? " virtual grain of " : " virtual grains of ") +
          std::to_string(real) + " real ones (" + std::to_string(left_out) + " left out), " +
          std::to_string(growing.job.options.donors) + " donors each, degree " +
          std::to_string(growing.job.degree) + ", seed " +
          std::to_string(growing.job.options.seed) + ".",
      "Drawn again, because the grain was not star-shaped or intersected itself: " +
          std::to_string(redrawn) + ".",
      "Kolmogorov-Smirnov distance to the sample (" + format_number(by_chance, 2) +
          " by chance in 1 of 20 samples):"};
  for (const std::string& line :
       aligned_lines({{"  sphericity", distance(made.sphericity, sample.sphericity)},
                      {"  I/L of inertia", distance(made.elongation, sample.elongation)},
                      {"  S/I of inertia", distance(made.flatness, sample.flatness)},
                      {"  convexity", distance(made.convexity, sample.convexity)}})) {
    lines.push_back(line);
  }
  lines.push_back("Distance to the nearest real grain, rms of the radius: median " +
                  percent(nearest[grown / 2]) + ", smallest " + percent(nearest.front()) + ".");
  lines.push_back("Usual distance between real grains: " +
                  percent(growing.search.usual_distance(execution)) + ".");
  if (mean(overhangs) > 0.0) {
    lines.push_back("Overhang fraction, mean: " + percent(mean(growing.overhangs)) +
                    ", in the sample " + percent(mean(overhangs)) + ".");
  }
  lines.push_back("Collage, caps of 40 degrees that follow one donor: " +
                  percent(mean(growing.collages)) + ".");
  return lines;
}

}  // namespace

void check_job(const GrowJob& job) {
  require_in_range(job.degree, sample_degree_option);
  if (!job.coefficients) check_format(job.format);
}

GrownSample grow_grains(const GrowJob& job, RealGrains real, const SampleGrids& grids,
                        const JobHost& host) {
  const Execution execution(host.threads);
  const auto count = static_cast<std::size_t>(job.grains);
  GrainSearch search(real.grains);
  Growing growing{job,
                  std::move(real.files),
                  GrainGrower(std::move(real.grains), grids, job.options),
                  std::move(search),
                  GrownMeshes(job.nodes, execution),
                  GrownNumbers(count),
                  std::vector<double>(count),
                  std::vector<double>(count),
                  std::vector<int>(count),
                  std::vector<double>(count)};
  std::string rows = csv_record({std::begin(table_heading), std::end(table_heading)});
  GrainRun all;
  all.count = count;
  all.when_stopped = "No table was written. The grains that were made are in the folder.";
  all.name = [&](std::size_t k) { return name_of(job, k); };
  all.work = [&](std::size_t k, const Execution& one) { return grown_row(growing, k, one); };
  all.take = [&](std::size_t, const GrainRow& row) { rows += row.records.front(); };
  GrownSample grown;
  grown.end = run_grains(all, host);
  if (grown.end.was_cancelled()) return grown;
  write_file((fs::path(job.folder) / "grown.csv").string(), rows);
  if (!job.coefficients && job.format == "ply") {
    write_file((fs::path(job.folder) / "yade_packing.py").string(), yade_packing_script());
  }
  grown.lines = lines_of(growing, real.left_out, execution);
  return grown;
}

}  // namespace wscvt
