// SPDX-License-Identifier: GPL-3.0-or-later

// How first contacts and forces come out by nodes instead of the surface, against the number of
// nodes: a table (contacts.csv) of every grain and of their means.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "figures/study/contact_errors.h"
#include "figures/study/paper_study.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace {

using namespace wscvt::study;
using wscvt::format_number;

std::vector<double> numbers_of(const ContactErrors& e) {
  return {e.grain.mean,
          e.grain.scatter,
          e.both.mean,
          e.both.scatter,
          e.plane.mean,
          e.plane.scatter,
          e.deepest_force.mean,
          e.deepest_force.scatter,
          e.area_force.mean,
          e.area_force.scatter,
          e.missed};
}

std::vector<std::string> row_of(const std::string& grain, const std::string& sampling, int nodes,
                                const std::vector<double>& numbers) {
  std::vector<std::string> row = {grain, sampling, std::to_string(nodes)};
  for (const double number : numbers) row.push_back(format_number(number, 4));
  return row;
}

/// Nodes fitted to 6,000 contacts themselves, what they make of these and of others.
void add_fitted(const std::string& name, const wscvt::IndexedMesh& scan, const ContactGrain& grain,
                int nodes, Table& table, const wscvt::Execution& execution) {
  wscvt::RemeshOptions options;
  options.node_count = nodes;
  wscvt::IndexedMesh mesh = wscvt::remesh(scan, options, execution).mesh;
  const ContactGrain seen(scan, 6000, execution, 1);
  mesh.points = seen.fitted_to_contacts(std::move(mesh.points), execution);
  const wscvt::NodeTable table_of_nodes = wscvt::node_table(std::move(mesh));
  table.push_back(row_of(name, "fitted to these contacts", nodes,
                         numbers_of(seen.errors(table_of_nodes, execution))));
  table.push_back(row_of(name, "fitted to other contacts", nodes,
                         numbers_of(grain.errors(table_of_nodes, execution))));
}

/// Those of these names; all where none is named.
std::vector<ContactSampling> samplings_of(const std::vector<std::string>& names) {
  std::vector<ContactSampling> all = contact_samplings();
  if (names.empty()) return all;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const ContactSampling& one) {
                             return std::find(names.begin(), names.end(), one.name) == names.end();
                           }),
            all.end());
  return all;
}

void run(const std::string& folder, const std::vector<std::string>& scans,
         const std::vector<int>& node_counts, std::size_t contacts, int fitted_nodes,
         const std::vector<ContactSampling>& samplings) {
  const wscvt::Execution execution;
  std::filesystem::create_directories(folder);
  Table table = {{"grain", "sampling", "nodes", "grain_bias", "grain_scatter", "both_bias",
                  "both_scatter", "plane_bias", "plane_scatter", "deepest_force",
                  "deepest_force_scatter", "area_force", "area_force_scatter", "missed_percent"}};
  std::map<std::pair<std::string, int>, std::vector<double>> means;
  for (const std::string& path : scans) {
    const std::string name = std::filesystem::path(path).stem().string();
    const wscvt::IndexedMesh scan = unit_scan(wscvt::read_mesh(path), execution);
    const ContactGrain grain(scan, contacts, execution);
    if (fitted_nodes > 0) add_fitted(name, scan, grain, fitted_nodes, table, execution);
    for (const ContactSampling& sampling : samplings) {
      for (const int nodes : node_counts) {
        wscvt::RemeshOptions options = sampling.options;
        options.node_count = nodes;
        const std::vector<double> numbers = numbers_of(grain.errors(
            wscvt::node_table(wscvt::remesh(scan, options, execution).mesh), execution));
        table.push_back(row_of(name, sampling.name, nodes, numbers));
        std::vector<double>& mean = means[{sampling.name, nodes}];
        mean.resize(numbers.size());
        for (std::size_t k = 0; k < numbers.size(); ++k) {
          mean[k] += numbers[k] / static_cast<double>(scans.size());
        }
        std::cout << wscvt::csv_record(table.back()) << std::flush;
      }
    }
  }
  for (const ContactSampling& sampling : samplings) {
    for (const int nodes : node_counts) {
      table.push_back(row_of("mean", sampling.name, nodes, means.at({sampling.name, nodes})));
    }
  }
  write_csv(folder + "/contacts.csv", table);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measure contacts by nodes against those of the surface."};
  std::string folder;
  std::vector<std::string> scans;
  std::vector<int> node_counts = {100, 200, 500, 1000, 2000, 7228};
  std::size_t contacts = 1000;
  int fitted_nodes = 200;
  std::vector<std::string> samplings;
  for (const char* name : {"sand_7228", "sand_5658", "angular_6000", "elongated_rough_8000"}) {
    scans.push_back(std::string(WSCVT_MESHES_DIR) + "/" + name + ".ply");
  }
  app.add_option("folder", folder, "Where the table goes")->required();
  app.add_option("scans", scans, "Star-shaped scans; without them the four samples");
  app.add_option("--nodes", node_counts, "Numbers of nodes");
  app.add_option("--contacts", contacts, "Contacts that errors are means over");
  app.add_option("--samplings", samplings, "Samplings by their names; without them all");
  app.add_option("--fitted", fitted_nodes,
                 "Nodes of the row that is fitted to the contacts themselves; 0: no such row");
  CLI11_PARSE(app, argc, argv);
  try {
    run(folder, scans, node_counts, contacts, fitted_nodes, samplings_of(samplings));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
