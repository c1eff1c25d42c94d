// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/area_elements.h"

#include <cstddef>

namespace wscvt {

AreaElements area_elements(const RadialSurface& surface, const std::vector<Vector3>& directions,
                           const Execution& execution) {
  constexpr std::size_t block_size = 1024;
  AreaElements result;
  result.radii.resize(directions.size());
  result.elements.resize(directions.size());
  execution.parallel_for(directions.size(), block_size, [&](std::size_t begin, std::size_t end) {
    std::vector<RadialJet> jets(end - begin);
    surface.evaluate(directions.data() + begin, end - begin, Derivatives::First, jets.data());
    for (std::size_t i = begin; i < end; ++i) {
      result.radii[i] = jets[i - begin].radius;
      result.elements[i] = area_element(jets[i - begin]);
    }
  });
  return result;
}

}  // namespace wscvt
