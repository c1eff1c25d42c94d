// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/repair/overhangs.h"

#include <cstddef>
#include <vector>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/triangle_geometry.h"
#include "wscvt/sphere/solid_angle.h"

namespace wscvt {

double overhang_solid_angle(const IndexedMesh& mesh, const Vector3& centre,
                            const Execution& execution) {
  std::vector<Vector3> directions(mesh.points.size());
  execution.parallel_for_each(directions.size(), usual_block, [&](std::size_t i) {
    directions[i] = (mesh.points[i] - centre).normalized();
  });
  return execution
      .parallel_sum_of(mesh.triangles.size(), usual_block, SolidAngleSums(),
                       [&](std::size_t f, SolidAngleSums& part) {
                         const Triangle& t = mesh.triangles[f];
                         part.add(solid_angle(directions[index(t[0])], directions[index(t[1])],
                                              directions[index(t[2])]));
                       })
      .overhang_fraction();
}

double steep_area_fraction(const IndexedMesh& mesh, const Vector3& centre,
                           const Execution& execution) {
  constexpr std::size_t block_size = 8192;
  constexpr double degree = pi / 180.0;
  const double smallest_cosine = portable::cos(steep_angle * degree);
  struct Areas {
    double steep = 0.0;
    double all = 0.0;
    Areas& operator+=(const Areas& other) {
      steep += other.steep;
      all += other.all;
      return *this;
    }
  };
  const Areas areas = execution.parallel_sum_of(
      mesh.triangles.size(), block_size, Areas(), [&](std::size_t t, Areas& part) {
        const Vector3 a = mesh.points[mesh.triangles[t][0]] - centre;
        const Vector3 b = mesh.points[mesh.triangles[t][1]] - centre;
        const Vector3 c = mesh.points[mesh.triangles[t][2]] - centre;
        const Vector3 normal = doubled_area_normal(a, b, c);
        const double area = normal.norm();
        const Vector3 middle = a + b + c;
        part.all += area;
        if (normal.dot(middle) < smallest_cosine * area * middle.norm()) part.steep += area;
      });
  return areas.all > 0.0 ? areas.steep / areas.all : 0.0;
}

}  // namespace wscvt
