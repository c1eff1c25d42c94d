// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/measures/printed_sdq.h"

#include <cmath>
#include <string>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"

namespace wscvt {

double printed_sdq(const RadialSurface& surface, int rings, const Execution& execution) {
  if (rings < 1) {
    throw Error(ErrorCode::InvalidInput,
                "The number of parallels is " + std::to_string(rings) + ". Give 1 or more.");
  }
  struct Sums {
    double slope = 0.0;
    double area = 0.0;
    Sums& operator+=(const Sums& other) {
      slope += other.slope;
      area += other.area;
      return *this;
    }
  };
  const auto count = static_cast<std::size_t>(rings);
  const double step = pi / rings;
  std::vector<double> cosines(2 * count);
  std::vector<double> sines(2 * count);
  for (std::size_t k = 0; k < 2 * count; ++k) {
    const double phi = (static_cast<double>(k) + 0.5) * step;
    cosines[k] = portable::cos(phi);
    sines[k] = portable::sin(phi);
  }
  const Sums sums =
      execution.parallel_sum(count, 4, Sums(), [&](std::size_t begin, std::size_t end) {
        Sums part;
        std::vector<Vector3> directions(2 * count);
        std::vector<RadialJet> jets(2 * count);
        for (std::size_t ring = begin; ring < end; ++ring) {
          const double theta = (static_cast<double>(ring) + 0.5) * step;
          const double sine = portable::sin(theta);
          const double cosine = portable::cos(theta);
          for (std::size_t k = 0; k < 2 * count; ++k) {
            directions[k] = {sine * cosines[k], sine * sines[k], cosine};
          }
          surface.evaluate(directions.data(), directions.size(), Derivatives::First, jets.data());
          for (std::size_t k = 0; k < 2 * count; ++k) {
            const Vector3 south(cosine * cosines[k], cosine * sines[k], -sine);
            const Vector3 east(-sines[k], cosines[k], 0.0);
            const double r_theta = jets[k].gradient.dot(south);
            const double r_phi = sine * jets[k].gradient.dot(east);
            part.slope += r_theta * r_theta + r_phi * r_phi;
            part.area += sine * area_element(jets[k]);
          }
        }
        return part;
      });
  return std::sqrt(sums.slope / sums.area);
}

}  // namespace wscvt
