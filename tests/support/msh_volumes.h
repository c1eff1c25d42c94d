// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"

namespace wscvt::test {

/// The volume of an entity of Gmsh's, in two ways.
struct MshVolume {
  double bounded = 0.0;  ///< by its surfaces, with their signs
  double filled = 0.0;   ///< by its tetrahedra
};

/// Reads the volumes of a text in Gmsh 4.1 without points and curves, as Gmsh's manual has it.
inline std::vector<MshVolume> msh_volumes(const std::string& msh) {
  std::istringstream text(msh.substr(msh.find("$Entities") + 9));
  std::size_t none = 0, surfaces = 0, volumes = 0;
  text >> none >> none >> surfaces >> volumes;
  const auto skip = [&](int words) {
    std::string word;
    for (int k = 0; k < words; ++k) text >> word;
  };
  for (std::size_t k = 0; k < surfaces; ++k) skip(10);
  std::vector<std::vector<int>> bounds(volumes);
  for (std::vector<int>& of_volume : bounds) {
    skip(9);  // tag, box, one group
    std::size_t count = 0;
    text >> count;
    of_volume.resize(count);
    for (int& bound : of_volume) text >> bound;
  }
  skip(2);  // $EndEntities $Nodes
  std::size_t count = 0;
  text >> none >> count;
  skip(6);
  for (std::size_t k = 0; k < count; ++k) skip(1);
  std::vector<Vector3> points(count);
  for (Vector3& p : points) text >> p[0] >> p[1] >> p[2];
  skip(2);  // $EndNodes $Elements
  std::size_t blocks = 0;
  text >> blocks;
  skip(3);
  std::map<int, double> under;  // of a surface with the origin
  std::vector<MshVolume> result(volumes);
  for (std::size_t block = 0; block < blocks; ++block) {
    int dimension = 0, tag = 0;
    text >> dimension >> tag >> none >> count;
    for (std::size_t k = 0; k < count; ++k) {
      std::array<Vector3, 4> x;
      x[3].setZero();
      text >> none;
      for (int corner = 0; corner <= dimension; ++corner) {
        std::size_t number = 0;
        text >> number;
        x[static_cast<std::size_t>(corner)] = points.at(number - 1);
      }
      const double volume = (x[0] - x[3]).dot((x[1] - x[3]).cross(x[2] - x[3])) / 6.0;
      if (dimension == 2) under[tag] += volume;
      if (dimension == 3) result.at(static_cast<std::size_t>(tag - 1)).filled += std::abs(volume);
    }
  }
  for (std::size_t k = 0; k < volumes; ++k) {
    for (const int bound : bounds[k]) {
      result[k].bounded += (bound < 0 ? -1.0 : 1.0) * under.at(std::abs(bound));
    }
  }
  return result;
}

}  // namespace wscvt::test
