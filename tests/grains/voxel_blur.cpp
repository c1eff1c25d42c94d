// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxel_blur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace wscvt::test {

void blur(VoxelGrid& grid, double deviation) {
  const int reach = static_cast<int>(std::ceil(4.0 * deviation));
  std::vector<double> kernel;
  for (int i = -reach; i <= reach; ++i) {
    kernel.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
  }
  const double total = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& k : kernel) k /= total;
  const double* const middle = kernel.data() + reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> source = grid.values;
    for (int z = 0; z < grid.size[2]; ++z) {
      for (int y = 0; y < grid.size[1]; ++y) {
        for (int x = 0; x < grid.size[0]; ++x) {
          double sum = 0.0;
          for (int i = -reach; i <= reach; ++i) {
            std::array<int, 3> at{x, y, z};
            at[axis] = std::clamp(at[axis] + i, 0, grid.size[axis] - 1);
            sum += middle[i] * source[grid.index(at[0], at[1], at[2])];
          }
          grid.values[grid.index(x, y, z)] = sum;
        }
      }
    }
  }
}

}  // namespace wscvt::test
