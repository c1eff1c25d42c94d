// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "figures/study/paper_study.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt::study {

namespace {

// Exact for the volume up to degree 66, three times the area's series.
constexpr int polar_nodes = 200;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

Table reference_particle_errors(const std::string& folder, const Execution& execution) {
  namespace fs = std::filesystem;
  const std::string ending = "-geom.csv";
  std::vector<fs::path> tables;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
      tables.push_back(entry.path());
    }
  }
  std::sort(tables.begin(), tables.end());
  Table result = {{"particle", "degree", "table_volume", "volume", "volume_error_percent",
                   "table_area", "area", "area_error_percent"}};
  double worst_volume = 0.0;
  double worst_area = 0.0;
  for (const fs::path& table : tables) {
    std::ifstream file(table);
    for (std::string line; std::getline(file, line);) {
      const std::vector<std::string> fields = split(line);
      if (fields.empty() || !fs::exists(fs::path(folder) / fields[0])) continue;
      if (fields.size() < 13) {
        throw std::runtime_error(table.string() + ": the row of " + fields[0] + " is too short");
      }
      const double volume = std::stod(fields[7]);
      const double area = std::stod(fields[8]);
      const HarmonicSurface surface =
          read_complex_harmonics((fs::path(folder) / fields[0]).string(), std::stoi(fields[12]));
      const SurfaceIntegrals integrals = integrate(surface, polar_nodes, execution);
      const double volume_error = relative_error_percent(integrals.volume, volume);
      const double area_error = relative_error_percent(integrals.area, area);
      worst_volume = std::max(worst_volume, std::abs(volume_error));
      worst_area = std::max(worst_area, std::abs(area_error));
      result.push_back({fields[0], fields[12], format_exact(volume),
                        format_number(integrals.volume), format_error(volume_error),
                        format_exact(area), format_number(integrals.area),
                        format_error(area_error)});
    }
  }
  if (result.size() == 1) {
    throw std::runtime_error("no particle of a *-geom.csv table is in " + folder);
  }
  result.push_back(
      {"worst", "", "", "", format_error(worst_volume), "", "", format_error(worst_area)});
  return result;
}

}  // namespace wscvt::study
