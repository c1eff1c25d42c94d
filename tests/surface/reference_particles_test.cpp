// SPDX-License-Identifier: GPL-3.0-or-later
// Measured particles whose volume and area others have tabulated. Their data are not ours to copy:
// name a folder with NIST/VCCTL sets in the environment variable WSCVT_PARTICLES_DIR to have them
// tested.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "wscvt/measures/descriptors.h"
#include "wscvt/surface/harmonic_surface.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

TEST(ReferenceParticles, VolumeAndAreaOfReferenceParticle) {
  const char* folder = std::getenv("WSCVT_PARTICLES_DIR");
  if (folder == nullptr) GTEST_SKIP() << "WSCVT_PARTICLES_DIR names no folder";
  int particles = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.find("-geom.csv") == std::string::npos) continue;
    std::ifstream table(entry.path());
    for (std::string line; std::getline(table, line);) {
      const std::vector<std::string> fields = split(line);
      if (fields.size() < 13 || !fs::exists(fs::path(folder) / fields[0])) continue;
      SCOPED_TRACE(fields[0]);
      ++particles;
      // Columns 8, 9 and 13: volume, area and the degree at which the table cuts the series.
      const HarmonicSurface surface =
          read_complex_harmonics((fs::path(folder) / fields[0]).string(), std::stoi(fields[12]));
      const SurfaceIntegrals integrals = integrate(surface, 200, Execution(1));
      // tests/figures/study measured at most 4e-6 %, the tables' four decimals, and 0.002 %.
      EXPECT_LT(std::abs(relative_error_percent(integrals.volume, std::stod(fields[7]))), 1e-5);
      EXPECT_LT(std::abs(relative_error_percent(integrals.area, std::stod(fields[8]))), 0.003);
    }
  }
  EXPECT_GT(particles, 0) << "no particle of a *-geom.csv table is in " << folder;
}

}  // namespace
}  // namespace wscvt
