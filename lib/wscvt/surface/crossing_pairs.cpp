// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/crossing_pairs.h"

#include <algorithm>
#include <vector>

#include "wscvt/surface/self_intersections.h"

namespace wscvt {

CrossingPairs crossing_pairs(const IndexedMesh& mesh, const Execution& execution) {
  // Finds 5 of the faces of a dent that has a hundredth of them.
  constexpr std::size_t most_asked = 500;
  // Boxes of more would take more memory than the rest of a run.
  constexpr std::size_t most_faces = 2000000;
  const std::size_t faces = mesh.triangles.size();
  if (faces > most_faces) return {0, false};
  std::vector<std::int32_t> asked(std::min(faces, most_asked));
  for (std::size_t k = 0; k < asked.size(); ++k) {
    asked[k] = static_cast<std::int32_t>(k * faces / asked.size());
  }
  const std::vector<TrianglePair> pairs = self_intersections_of(asked, mesh, execution);
  // A triangle without area is no sheet.
  const auto count = std::count_if(pairs.begin(), pairs.end(), [](const TrianglePair& pair) {
    return pair.first != pair.second;
  });
  return {static_cast<std::size_t>(count), asked.size() == faces};
}

std::string crossing_sentence(const CrossingPairs& pairs, const std::string& whose) {
  if (pairs.count == 0) return "";
  return (pairs.is_all ? "" : "At least ") + std::to_string(pairs.count) +
         (pairs.count == 1 ? " pair" : " pairs") + " of triangles of " + whose +
         " intersect. Where one sheet passes through another, the surface is not that of a body, "
         "and its volume is counted twice or not at all. Repair it there first.";
}

}  // namespace wscvt
