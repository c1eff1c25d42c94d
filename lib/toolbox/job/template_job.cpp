// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/template_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>

#include "toolbox/sample/distribution.h"
#include "toolbox/sample/given_sizes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/report/json.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

namespace fs = std::filesystem;

/// Returns the mesh with an equivalent diameter of 1, about its centroid in its principal frame.
IndexedMesh template_mesh(IndexedMesh mesh, const Execution& execution) {
  const ShapeDescriptors shape = describe_shape(mesh, execution);
  const double radius = equivalent_radius(shape.volume);
  const Eigen::Matrix3d turn = shape.principal_axes.toRotationMatrix().transpose();
  for (Vector3& point : mesh.points) point = 0.5 * (turn * (point - shape.centroid) / radius);
  return mesh;
}

std::vector<double> masses_of(const DescribedSample& sample) {
  std::vector<double> masses;
  for (const double d : sample.diameters) masses.push_back(d * d * d);
  return masses;
}

std::string template_header(const TemplateJob& job) {
  std::vector<std::string> heading = {"grain",
                                      "file",
                                      "source",
                                      "weight_by_number",
                                      "weight_by_mass",
                                      "equivalent_diameter [length]",
                                      "smallest_diameter [length]",
                                      "largest_diameter [length]"};
  heading.insert(heading.end(), job.descriptors.begin(), job.descriptors.end());
  return csv_record(heading);
}

std::string template_row(const DescribedSample& sample, const SampleTemplates& templates,
                         std::size_t k, const std::string& name, const std::string& file) {
  const std::size_t grain = templates.grains[k];
  double smallest = sample.diameters[grain], largest = smallest;
  for (std::size_t i = 0; i < sample.files.size(); ++i) {
    if (templates.stands_for[i] != k) continue;
    smallest = std::min(smallest, sample.diameters[i]);
    largest = std::max(largest, sample.diameters[i]);
  }
  std::vector<std::string> row = {name,
                                  file,
                                  fs::path(sample.files[grain]).filename().string(),
                                  format_exact(templates.by_number[k]),
                                  format_exact(templates.by_mass[k]),
                                  format_exact(sample.diameters[grain]),
                                  format_exact(smallest),
                                  format_exact(largest)};
  for (Eigen::Index j = 0; j < sample.descriptors.cols(); ++j) {
    row.push_back(format_exact(sample.descriptors(grain, j)));
  }
  return csv_record(row);
}

double mean_distance(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<std::vector<std::string>> distance_rows(const TemplateJob& job,
                                                    const SampleTemplates& templates,
                                                    std::string (*number)(double)) {
  std::vector<std::vector<std::string>> rows = {
      {"descriptor", "by number", "random", "by mass", "random"}};
  const TemplateDistances& a = templates.reached;
  const TemplateDistances& b = templates.random;
  for (std::size_t j = 0; j < job.descriptors.size(); ++j) {
    rows.push_back({job.descriptors[j], number(a.by_number[j]), number(b.by_number[j]),
                    number(a.by_mass[j]), number(b.by_mass[j])});
  }
  rows.push_back({"mean", number(mean_distance(a.by_number)), number(mean_distance(b.by_number)),
                  number(mean_distance(a.by_mass)), number(mean_distance(b.by_mass))});
  return rows;
}

std::vector<std::string> summary_lines(const TemplateJob& job, const DescribedSample& sample,
                                       const SampleTemplates& templates) {
  std::vector<std::string> lines = {
      std::to_string(templates.grains.size()) + " templates of " +
          std::to_string(sample.files.size()) + " grains (" + std::to_string(sample.left_out) +
          " left out), seed " + std::to_string(job.options.seed) + ".",
      "Wasserstein distance to the sample, in standard deviations of the sample:"};
  const std::vector<std::string> table = aligned_lines(
      distance_rows(job, templates, [](double value) { return format_number(value, 3); }));
  for (const std::string& line : table) lines.push_back("  " + line);
  return lines;
}

std::string distance_header() {
  return csv_record({"descriptor", "by_number", "random_by_number", "by_mass", "random_by_mass"});
}

std::string distance_table(const TemplateJob& job, const SampleTemplates& templates) {
  std::vector<std::vector<std::string>> rows =
      distance_rows(job, templates, [](double value) { return format_exact(value); });
  rows.erase(rows.begin());
  std::string table = distance_header();
  for (const std::vector<std::string>& row : rows) table += csv_record(row);
  return table;
}

std::unique_ptr<NamedGrains> grains_of(std::size_t count, NamedGrains::Read read) {
  return std::make_unique<NamedGrains>("template-", count, 2, std::move(read));
}

/// Throws if the scan of a template is not the one that the table has measured.
void check_scan(const DescribedSample& sample, std::size_t grain, double volume) {
  const std::string& file = sample.files[grain];
  if (sample.measured_before.count(file) == 0) return;
  const double diameter = sample.diameters[grain];
  const double measured = pi / 6.0 * diameter * diameter * diameter;
  constexpr double rounding = 1e-6;
  if (std::abs(volume - measured) <= rounding * measured) return;
  refuse("\"" + file + "\" has the volume " + format_number(volume, 6) + ", and the table " +
         format_number(measured, 6) +
         ": it is another scan, or was remeshed with other options. Give the scans, or the meshes "
         "of the batch, in place of its table.");
}

GrainJob job_of(const TemplateJob& options, const DescribedSample& sample,
                const SampleTemplates& templates) {
  GrainJob job{options.folder, options.shard, options.format};
  // Of a sample that is measured anew, with the same names, other grains may be chosen.
  Json rows = Json::array();
  for (std::size_t k = 0; k < templates.grains.size(); ++k) {
    rows.push_back(template_row(sample, templates, k, "", ""));
  }
  job.call = json_document({{"format", "wscvt-templates"},
                            {"made_by", made_by()},
                            {"meshes", options.format},
                            {"count", options.options.count},
                            {"nodes", options.nodes},
                            {"descriptors", options.descriptors},
                            {"seed", options.options.seed},
                            {"sample", sample.files},
                            {"rows", rows}});
  job.tables = {{"templates", template_header(options)}};
  job.is_kept = false;
  job.make = [&](GrainAtWork& grain) -> std::vector<std::string> {
    const JobFolder& folder = grain.folders.front();
    RemeshOptions remeshed;
    remeshed.node_count = options.nodes;
    const RemeshResult made = remesh(std::move(grain.scan.mesh), remeshed, grain.execution);
    check_scan(sample, templates.grains[grain.scan.place], made.scan.volume);
    write_mesh(template_mesh(made.mesh, grain.execution), folder.file_of(grain.name));
    return {
        template_row(sample, templates, grain.scan.place, grain.name, folder.name_of(grain.name))};
  };
  return job;
}

constexpr int percent_step = 2;

/// Returns the diameters that 0 to 100 % of the mass are finer than, in steps.
std::vector<double> finer_by_mass(const std::vector<double>& diameters) {
  if (diameters.empty()) refuse("There are no grains for a size curve. Give at least one.");
  const Eigen::Map<const Eigen::VectorXd> sizes(diameters.data(), diameters.size());
  const Distribution by_mass(sizes, sizes.array().cube());
  std::vector<double> curve;
  for (int percent = 0; percent <= 100; percent += percent_step) {
    const double fraction = 0.01 * percent;
    // Below half of the smallest grain's mass all are equal, but a curve ascends.
    curve.push_back(by_mass.quantile(fraction) * (1.0 - 1e-8 * (1.0 - fraction)));
  }
  return curve;
}

/// Writes what all templates together have.
void write_sample_files(const TemplateJob& job, const DescribedSample& sample,
                        const SampleTemplates& templates) {
  const auto write = [&](const char* file, const std::string& text) {
    write_file((fs::path(job.folder) / file).string(), text);
  };
  write("distances.csv", distance_table(job, templates));
  write("sizes.csv", size_curve_csv(sample.diameters));
  write("mercury_psd.csv", mercury_psd_csv(sample.diameters));
}

}  // namespace

std::string size_curve_csv(const std::vector<double>& diameters) {
  std::vector<double> percentages;
  for (int percent = 0; percent <= 100; percent += percent_step) percentages.push_back(percent);
  return GivenSizes(finer_by_mass(diameters), percentages).table(1.0);
}

std::string mercury_psd_csv(const std::vector<double>& diameters) {
  std::string table;
  int percent = 0;
  for (const double diameter : finer_by_mass(diameters)) {
    table += format_exact(0.5 * diameter) + "," + format_exact(0.01 * percent) + "\n";
    percent += percent_step;
  }
  return table;
}

void require_scans_kept(const TemplateJob& job, const std::vector<std::string>& sample) {
  const auto count = static_cast<std::size_t>(job.options.count);
  require_scans_kept(GrainJob{job.folder, job.shard, job.format}, *grains_of(count, {}), sample);
}

MadeSample make_templates(
    const TemplateJob& options, const DescribedSample& sample,
    const std::function<IndexedMesh(const std::string& file, const Execution& execution)>& read,
    const JobHost& host) {
  require_own_table(options.folder, "sizes.csv", GivenSizes::heading());
  require_own_table(options.folder, "distances.csv", distance_header());
  const SampleTemplates templates = choose_templates(sample.descriptors, masses_of(sample),
                                                     options.options, Execution(host.threads));
  const NamedGrains::Read read_chosen = [&](std::size_t k, const Execution& execution) {
    return read(sample.files[templates.grains[k]], execution);
  };
  JoinedGrains grains(options.shard);
  grains.add(grains_of(templates.grains.size(), read_chosen));
  const GrainJob job = job_of(options, sample, templates);
  MadeSample made;
  made.end = run_job(job, grains, host);
  if (made.end.was_cancelled() || options.shard.count > 1) return made;
  write_sample_files(options, sample, templates);
  made.lines = summary_lines(options, sample, templates);
  return made;
}

}  // namespace wscvt
