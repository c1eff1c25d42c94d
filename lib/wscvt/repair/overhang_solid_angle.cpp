// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/overhang_solid_angle.h"

#include <cstddef>
#include <vector>

#include "wscvt/base/half_edges.h"
#include "wscvt/sphere/solid_angle.h"

namespace wscvt {

namespace {

/// Large enough that the start of a block costs little.
constexpr std::size_t fold_block = 16384;

}  // namespace

double overhang_solid_angle(const IndexedMesh& mesh, const Vector3& centre,
                            const Execution& execution) {
  std::vector<Vector3> directions(mesh.points.size());
  execution.parallel_for(directions.size(), fold_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      directions[i] = (mesh.points[i] - centre).normalized();
  });
  return execution
      .parallel_sum(mesh.triangles.size(), fold_block, SolidAngleSums(),
                    [&](std::size_t begin, std::size_t end) {
                      SolidAngleSums part;
                      for (std::size_t f = begin; f < end; ++f) {
                        const Triangle& t = mesh.triangles[f];
                        part.add(solid_angle(directions[index(t[0])], directions[index(t[1])],
                                             directions[index(t[2])]));
                      }
                      return part;
                    })
      .overhang_fraction();
}

}  // namespace wscvt
