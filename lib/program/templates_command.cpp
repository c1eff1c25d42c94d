// SPDX-License-Identifier: GPL-3.0-or-later
#include "templates_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <utility>

#include "command.h"
#include "common_arguments.h"
#include "described_sample.h"
#include "exit_code.h"
#include "job_on_terminal.h"
#include "output_paths.h"
#include "signals.h"
#include "toolbox/clump/clump_fit.h"
#include "toolbox/exchange/template_files.h"
#include "toolbox/job/grain_files.h"
#include "toolbox/sample/grain_grower.h"
#include "work.h"
#include "wrong_call.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"

namespace wscvt::program {

namespace {

namespace fs = std::filesystem;

constexpr NumberOption<int> template_nodes_option = {"nodes", "number of nodes", 12,
                                                     1000000, Ends::Both,        "of each mesh"};

constexpr int spheres_of_template = 12;  ///< of a template's clump

std::string name_of(const TemplatesArguments& arguments, std::size_t k) {
  const std::size_t digits =
      std::max<std::size_t>(2, std::to_string(arguments.options.count).size());
  const std::string number = std::to_string(k + 1);
  return "template-" + std::string(digits - number.size(), '0') + number;
}

std::string in_folder(const TemplatesArguments& arguments, const std::string& file) {
  return (fs::path(arguments.folder) / file).string();
}

/// Returns the mesh with an equivalent radius of 1, about its centroid in its principal frame.
IndexedMesh unit_mesh(IndexedMesh mesh, const Execution& execution) {
  const ShapeDescriptors shape = describe_shape(mesh, execution);
  const double radius = portable::cbrt(3.0 / (4.0 * pi) * shape.volume);
  const Eigen::Matrix3d turn = shape.principal_axes.toRotationMatrix().transpose();
  for (Vector3& point : mesh.points) point = turn * (point - shape.centroid) / radius;
  return mesh;
}

/// Returns a clump for the template, with an equivalent diameter of 1.
std::vector<Sphere> clump_of(const IndexedMesh& unit, const Execution& execution) {
  ClumpOptions options;
  options.sphere_count = spheres_of_template;
  std::vector<Sphere> spheres = fit_spheres(unit, options, execution).spheres;
  for (Sphere& sphere : spheres) sphere = {0.5 * sphere.centre, 0.5 * sphere.radius};
  return spheres;
}

std::vector<double> masses_of(const DescribedSample& sample) {
  std::vector<double> masses;
  for (const double d : sample.diameters) masses.push_back(d * d * d);
  return masses;
}

std::string template_table(const TemplatesArguments& arguments, const DescribedSample& sample,
                           const SampleTemplates& templates) {
  std::vector<std::string> heading = {"grain",
                                      "file",
                                      "source",
                                      "weight_by_number",
                                      "weight_by_mass",
                                      "equivalent_diameter [length]",
                                      "smallest_diameter [length]",
                                      "largest_diameter [length]"};
  heading.insert(heading.end(), arguments.descriptors.begin(), arguments.descriptors.end());
  std::string table = csv_record(heading);
  for (std::size_t k = 0; k < templates.grains.size(); ++k) {
    const std::size_t grain = templates.grains[k];
    double smallest = sample.diameters[grain], largest = smallest;
    for (std::size_t i = 0; i < sample.files.size(); ++i) {
      if (templates.stands_for[i] != k) continue;
      smallest = std::min(smallest, sample.diameters[i]);
      largest = std::max(largest, sample.diameters[i]);
    }
    std::vector<std::string> row = {name_of(arguments, k),
                                    name_of(arguments, k) + "." + arguments.format,
                                    fs::path(sample.files[grain]).filename().string(),
                                    format_exact(templates.by_number[k]),
                                    format_exact(templates.by_mass[k]),
                                    format_exact(sample.diameters[grain]),
                                    format_exact(smallest),
                                    format_exact(largest)};
    for (Eigen::Index j = 0; j < sample.descriptors.cols(); ++j) {
      row.push_back(format_exact(sample.descriptors(static_cast<Eigen::Index>(grain), j)));
    }
    table += csv_record(row);
  }
  return table;
}

double mean_distance(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<std::vector<std::string>> distance_rows(const TemplatesArguments& arguments,
                                                    const SampleTemplates& templates,
                                                    std::string (*number)(double)) {
  std::vector<std::vector<std::string>> rows = {
      {"descriptor", "by number", "random", "by mass", "random"}};
  const TemplateDistances& a = templates.reached;
  const TemplateDistances& b = templates.random;
  for (std::size_t j = 0; j < arguments.descriptors.size(); ++j) {
    rows.push_back({arguments.descriptors[j], number(a.by_number[j]), number(b.by_number[j]),
                    number(a.by_mass[j]), number(b.by_mass[j])});
  }
  rows.push_back({"mean", number(mean_distance(a.by_number)), number(mean_distance(b.by_number)),
                  number(mean_distance(a.by_mass)), number(mean_distance(b.by_mass))});
  return rows;
}

std::vector<std::string> summary_lines(const TemplatesArguments& arguments,
                                       const DescribedSample& sample,
                                       const SampleTemplates& templates) {
  std::vector<std::string> lines = {
      std::to_string(templates.grains.size()) + " templates of " +
          std::to_string(sample.files.size()) + " grains (" + std::to_string(sample.left_out) +
          " left out), seed " + std::to_string(arguments.options.seed) + ".",
      "Wasserstein distance to the sample, in standard deviations of the sample:"};
  const std::vector<std::string> table = aligned_lines(
      distance_rows(arguments, templates, [](double value) { return format_number(value, 3); }));
  for (const std::string& line : table) lines.push_back("  " + line);
  return lines;
}

std::string distance_table(const TemplatesArguments& arguments, const SampleTemplates& templates) {
  std::vector<std::vector<std::string>> rows =
      distance_rows(arguments, templates, [](double value) { return format_exact(value); });
  rows.front() = {"descriptor", "by_number", "random_by_number", "by_mass", "random_by_mass"};
  std::string table;
  for (const std::vector<std::string>& row : rows) table += csv_record(row);
  return table;
}

/// Writes the meshes and their spheres. Returns false if cancelled. Throws wscvt::Error for the
/// first grain that fails.
bool write_meshes(const TemplatesArguments& arguments, const DescribedSample& sample,
                  const SampleTemplates& templates, std::vector<ClumpTemplate>& clumps) {
  clumps.resize(templates.grains.size());
  GrainRun all;
  all.count = templates.grains.size();
  all.when_stopped = "No table was written.";
  all.name = [&](std::size_t k) { return sample.files[templates.grains[k]]; };
  all.work = [&](std::size_t k, const Execution& execution) -> GrainRow {
    RemeshOptions options;
    options.node_count = arguments.nodes;
    const IndexedMesh scan = grain_mesh(sample.files[templates.grains[k]], execution);
    IndexedMesh mesh = remesh(scan, options, execution).mesh;
    mesh = unit_mesh(std::move(mesh), execution);
    const std::vector<Sphere> spheres = clump_of(mesh, execution);
    for (Vector3& point : mesh.points) point *= 0.5;
    write_mesh(mesh, in_folder(arguments, name_of(arguments, k) + "." + arguments.format));
    clumps[k] = {name_of(arguments, k) + ".spheres", spheres.size(), templates.by_mass[k]};
    write_file(in_folder(arguments, clumps[k].file), sphere_rows(spheres));
    return {};
  };
  return !run_grains(all, arguments.threads, arguments.quiet).was_cancelled();
}

void write_tables(const TemplatesArguments& arguments, const DescribedSample& sample,
                  const SampleTemplates& templates) {
  write_file(in_folder(arguments, "templates.csv"), template_table(arguments, sample, templates));
  write_file(in_folder(arguments, "distances.csv"), distance_table(arguments, templates));
  write_file(in_folder(arguments, "sizes.csv"), size_curve_csv(sample.diameters));
  write_file(in_folder(arguments, "mercury_psd.csv"), mercury_psd_csv(sample.diameters));
}

}  // namespace

CLI::App& add_command(CLI::App& program, TemplatesArguments& arguments) {
  CLI::App& app = add_command(
      program, {"templates",
                "Choose K grains with weights that represent a sample",
                {"scans -k 20 -n 500 -o out", "shape.csv -k 50 -o out --format stl",
                 "scans -k 10 -o out --descriptors sphericity_wadell,convexity,roundness_wadell"},
                "OUT gets a mesh per template (volume of a sphere of diameter 1, principal "
                "frame),\ntemplates.csv (weights and sizes), sizes.csv (the size curve), "
                "distances.csv, and files\nfor Yade, LIGGGHTS and MercuryDPM.",
                false,
                true});
  app.add_option("sample", arguments.inputs,
                 "Grains: closed meshes or SH coefficients (.dat, .sh, .json); files, folders, "
                 "patterns in quotes, or @FILE with one of these per line; or the folder of a "
                 "batch; or one table of shapes (.csv) with the columns \"volume\" and \"file\"")
      ->type_name("SAMPLE")
      ->required();
  add_folder_argument(app, arguments.folder);
  add_number(app, "-k,--count", arguments.options.count, template_count_option);
  add_number(app, "-n,--nodes", arguments.nodes, template_nodes_option);
  app.add_option("--descriptors", arguments.descriptors,
                 "Descriptors for the choice, with commas between: names as in the files of wscvt "
                 "describe. Default: sphericity_wadell, zingg_elongation_inertia, "
                 "zingg_flatness_inertia, convexity")
      ->type_name("NAMES")
      ->delimiter(',');
  add_format_argument(app, arguments.format);
  add_number(app, "--seed", arguments.options.seed, sample_seed_option);
  add_threads_argument(app, arguments.threads);
  add_quiet_argument(app, arguments.quiet);
  return app;
}

int run(const TemplatesArguments& given) {
  TemplatesArguments arguments = given;
  if (arguments.descriptors.empty()) arguments.descriptors = usual_template_descriptors();
  checked([&] { check_format(arguments.format); });
  if (!arguments.quiet) check_writable("/dev/stdout");
  const MadeFolder folder(arguments.folder);
  check_writable(in_folder(arguments, "templates.csv"));
  const DescribedSample sample =
      described_sample(arguments.inputs, arguments.descriptors, arguments.threads, arguments.quiet);
  const SampleTemplates templates = choose_templates(
      sample.descriptors, masses_of(sample), arguments.options, Execution(arguments.threads));
  std::vector<ClumpTemplate> clumps;
  if (!write_meshes(arguments, sample, templates, clumps)) return 128 + noted_signal();
  write_tables(arguments, sample, templates);
  write_file(in_folder(arguments, "yade_packing.py"), yade_packing_script());
  std::vector<double> diameters;  // each represents a third of the mass
  for (const double sixths : {1.0, 3.0, 5.0}) {
    diameters.push_back(diameter_by_mass(sample.diameters, sixths / 6.0));
  }
  write_file(in_folder(arguments, "liggghts.in"), liggghts_template_input(clumps, diameters));
  print(summary_lines(arguments, sample, templates), arguments.quiet);
  return sample.left_out == 0 ? Done : SomeFailed;
}

}  // namespace wscvt::program
