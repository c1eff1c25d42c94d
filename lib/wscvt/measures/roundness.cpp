// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/roundness.h"

#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/sphere/sphere_sampling.h"

namespace wscvt {

Roundness wadell_roundness(const SphereSurface& surface, double inscribed_radius, int polar_nodes,
                           const Execution& execution) {
  if (!(inscribed_radius > 0.0)) {
    throw Error(
        ErrorCode::InvalidInput,
        "The radius of the inscribed sphere is not positive, so corners cannot be told from "
        "the rest; give the largest inscribed sphere of the same body.");
  }
  constexpr std::size_t block_size = 1024;
  const SphereQuadrature quadrature = gauss_legendre_sphere(polar_nodes);
  const std::vector<Vector3>& u = quadrature.directions;
  // Total area, area of the corners, integral of 1/k over them.
  const Vector3 sums = execution.parallel_sum(
      u.size(), block_size, Vector3(Vector3::Zero()), [&](std::size_t begin, std::size_t end) {
        std::vector<LocalShape> shapes(end - begin);
        surface.evaluate_shapes(u.data() + begin, shapes.size(), Derivatives::Second,
                                shapes.data());
        Vector3 part = Vector3::Zero();
        for (std::size_t i = begin; i < end; ++i) {
          const double area = quadrature.weights[i] * shapes[i - begin].area_element;
          const double curvature = shapes[i - begin].curvatures.maximum;
          part[0] += area;
          if (curvature * inscribed_radius > 1.0) {
            part[1] += area;
            part[2] += area / curvature;
          }
        }
        return part;
      });
  Roundness result;
  result.corner_area_share = sums[1] / sums[0];
  if (sums[1] > 0.0) result.roundness = sums[2] / (sums[1] * inscribed_radius);
  return result;
}

}  // namespace wscvt
