// SPDX-License-Identifier: GPL-3.0-or-later

// The paper's study, repeated on the samples: tables and the data its figures are drawn from.

#include "figures/study/paper_study.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/execution.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace {

using namespace wscvt::study;

/// Rows of one scan and measure, N down and samplings across: "error (from the fitted surface)".
Table errors_by_nodes(const Table& errors, const std::string& scan, const std::string& measure) {
  Table table = {{"N"}};
  bool printed = false;
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const auto& row = errors[i];
    if (row[0] != scan || row[3] != measure) continue;
    if (table[0].back() != row[1]) table[0].push_back(row[1]);
    if (table[0].size() == 2) table.push_back({row[2]});
    for (auto& line : table) {
      if (line[0] == row[2]) line.push_back(row[7] + " (" + row[8] + ")");
    }
    printed = printed || !row[9].empty();
  }
  if (!printed) return table;
  table[0].emplace_back("paper's WSCVT-D");
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const auto& row = errors[i];
    if (row[0] != scan || row[3] != measure || row[1] != wscvt_d.name) continue;
    for (auto& line : table) {
      if (line[0] == row[2]) line.push_back(row[9].empty() ? "-" : row[9]);
    }
  }
  return table;
}

/// Appends the scans of a folder, by name, to the samples' errors. One that cannot be read or
/// described by a series is told and left out.
void add_scans_of(const std::string& scans_folder, int poses, SamplingErrors& errors,
                  std::vector<std::string>& names, const wscvt::Execution& execution) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(scans_folder)) {
    if (wscvt::is_mesh_file(entry.path().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  const auto append = [](Table& all, const Table& table) {
    all.insert(all.end(), table.begin() + 1, table.end());
  };
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    try {
      const SamplingErrors of_scan =
          sampling_errors({{name, wscvt::read_mesh(file.string())}}, poses, execution);
      append(errors.errors, of_scan.errors);
      append(errors.roughness, of_scan.roughness);
      append(errors.far_nodes, of_scan.far_nodes);
      names.push_back(name);
    } catch (const wscvt::Error& error) {
      std::cout << name << " is left out: " << error.what() << std::endl;
    }
  }
}

void run(const std::string& folder, const std::string& particles, const std::string& scans_folder,
         int poses) {
  const wscvt::Execution execution;
  std::filesystem::create_directories(folder);
  std::vector<Scan> scans;
  for (const char* name : {"sand_7228", "sand_5658", "angular_6000", "elongated_rough_8000"}) {
    scans.push_back({name, wscvt::read_mesh(std::string(WSCVT_MESHES_DIR) + "/" + name + ".ply")});
  }
  const Scan& sand = scans[0];
  std::string text;
  const auto tell = [&](const std::string& heading, const Table& table) {
    text += as_text(heading, table);
    std::cout << heading << std::endl;
  };

  const Table samplings = write_samplings(folder, sand, execution);
  write_csv(folder + "/figure1_quality.csv", samplings);
  tell("Figure 1: samplings of the sphere (WSCVT-D of " + sand.name + ")", samplings);
  Table pictures;
  for (const Scan& scan : {scans[0], scans[2]}) {
    const Table table = write_pictures(folder, scan, execution);
    pictures.insert(pictures.end(), table.begin() + (pictures.empty() ? 0 : 1), table.end());
    tell("Figures 6 and 9: remeshes of " + scan.name, table);
  }
  write_csv(folder + "/figure6_9_quality.csv", pictures);
  const Table distributions = write_distributions(folder, {scans[0], scans[1]}, execution);
  write_csv(folder + "/figure7_quality.csv", distributions);
  tell("Figure 7: scans and WSCVT-D remeshes with as many nodes", distributions);

  SamplingErrors sampled = sampling_errors(scans, poses, execution);
  std::vector<std::string> names;
  for (const Scan& scan : scans) names.push_back(scan.name);
  if (!scans_folder.empty()) add_scans_of(scans_folder, poses, sampled, names, execution);
  write_csv(folder + "/errors.csv", sampled.errors);
  write_csv(folder + "/roughness.csv", sampled.roughness);
  write_csv(folder + "/far_nodes.csv", sampled.far_nodes);
  for (const std::string& name : names) {
    for (const char* measure : {"volume", "area", "aspect_ratio", "sphericity", "sdq"}) {
      const std::string figure = measure == std::string("sdq") ? "Figure 10" : "Figure 8";
      tell(figure + ": " + measure + " of " + name + ", mean over " + std::to_string(poses) +
               " poses of |error| in % against the scan (against the fitted surface)",
           errors_by_nodes(sampled.errors, name, measure));
    }
  }
  tell("Sdq of the scans, and its printed form (eq. 17) of the fitted surface over the poses",
       sampled.roughness);
  tell("Share of the nodes (N = 2000) and of the scan's area beyond 1.25 R, in %",
       sampled.far_nodes);

  const ClosedFormErrors closed = closed_form_errors(execution);
  write_csv(folder + "/closed_forms.csv", closed.all);
  write_csv(folder + "/closed_forms_worst.csv", closed.worst);
  tell("Descriptors on closed forms (lengths where the value is 0: of a unit sphere)",
       closed.worst);
  if (!particles.empty()) {
    const Table table = reference_particle_errors(particles, execution);
    write_csv(folder + "/reference_particles.csv", table);
    tell("Reference particles: integrals of their harmonics against their table", table);
  }
  wscvt::write_file(folder + "/study.txt", text);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Repeat the paper's study on the sample grains."};
  std::string folder;
  std::string particles;
  std::string scans;
  int poses = 4;
  app.add_option("folder", folder, "Where tables and figure data go")->required();
  app.add_option("--particles", particles,
                 "Folder with NIST/VCCTL particles (*.dat) and their *-geom.csv tables")
      ->check(CLI::ExistingDirectory);
  app.add_option("--scans", scans,
                 "Folder with scans whose errors are measured as the samples' are")
      ->check(CLI::ExistingDirectory);
  app.add_option("--poses", poses, "Poses that the errors are means over")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    run(folder, particles, scans, poses);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
