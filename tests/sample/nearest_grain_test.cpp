// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/nearest_grain.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/random_sample.h"

namespace wscvt {
namespace {

TEST(GrainSearch, FindsMirroredCopies) {
  const SampleGrids grids(6);
  const std::vector<SampleGrain> sample = test::random_sample(9, grids, 3);
  const GrainSearch search(sample);
  for (const std::size_t k : {std::size_t{0}, std::size_t{4}, std::size_t{8}}) {
    for (const Vector3& signs : {Vector3(1, 1, 1), Vector3(-1, 1, 1), Vector3(1, -1, 1),
                                 Vector3(1, 1, -1), Vector3(-1, 1, -1), Vector3(-1, -1, -1)}) {
      const NearestGrain nearest = search.nearest(mirrored(sample[k].radial, signs));
      EXPECT_EQ(nearest.grain, k);
      EXPECT_NEAR(nearest.distance, 0.0, 1e-7);  // the root of rounding
    }
    EXPECT_NE(search.nearest(sample[k].radial, k).grain, k);
    EXPECT_GT(search.nearest(sample[k].radial, k).distance, 0.01);
  }
}

// A coefficient changes the square of the radius by its own square over the sphere.
TEST(GrainSearch, MeasuresTheRootMeanSquareOfRadii) {
  const SampleGrids grids(6);
  std::vector<SampleGrain> sample = test::random_sample(2, grids, 4);
  const GrainSearch search(sample);
  std::vector<double> radial = mirrored(sample[1].radial, {-1, 1, -1});
  radial[harmonic_index(3, -2)] += 0.03;
  radial[harmonic_index(5, 4)] -= 0.04;
  const NearestGrain nearest = search.nearest(radial);
  EXPECT_EQ(nearest.grain, 1U);
  EXPECT_NEAR(nearest.distance, 0.05 / std::sqrt(4.0 * pi), 1e-9);
}

// Whatever it leaves out of the comparison.
TEST(GrainSearch, FindsTheNearestOfAll) {
  const SampleGrids grids(6);
  const std::vector<SampleGrain> sample = test::random_sample(40, grids, 6);
  const GrainSearch search(sample);
  for (const SampleGrain& grain : test::random_sample(10, grids, 7)) {
    double least = 1e9;
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < sample.size(); ++k) {
      const double distance = GrainSearch({sample[k]}).nearest(grain.radial).distance;
      if (distance < least) {
        least = distance;
        nearest = k;
      }
    }
    EXPECT_EQ(search.nearest(grain.radial).grain, nearest);
    EXPECT_NEAR(search.nearest(grain.radial).distance, least, 1e-12);
  }
}

// The first has the amplitudes of the grain that is looked for, but lies across it.
TEST(GrainSearch, IsNotDeceivedByAmplitudes) {
  std::vector<SampleGrain> sample(2);
  std::vector<double> radial(harmonic_count(4), 0.0);
  radial[0] = std::sqrt(4.0 * pi);
  sample[0].radial = sample[1].radial = radial;
  radial[harmonic_index(3, 0)] = 0.3;
  sample[0].radial[harmonic_index(3, 2)] = 0.3;
  sample[1].radial[harmonic_index(3, 0)] = 0.05;
  const NearestGrain nearest = GrainSearch(sample).nearest(radial);
  EXPECT_EQ(nearest.grain, 1U);
  EXPECT_NEAR(nearest.distance, 0.25 / std::sqrt(4.0 * pi), 1e-9);
}

TEST(GrainSearch, KnowsWhatIsUsual) {
  const SampleGrids grids(6);
  std::vector<SampleGrain> sample = test::random_sample(1, grids, 5);
  EXPECT_EQ(GrainSearch(sample).usual_distance(Execution(1)), 0.0);
  // Three grains in a row, 0.1 and 0.3 apart: 0.1, 0.1 and 0.3 to the nearest.
  const double unit = std::sqrt(4.0 * pi);
  sample.resize(3, sample.front());
  sample[1].radial[0] += 0.1 * unit;
  sample[2].radial[0] += 0.4 * unit;
  const GrainSearch search(sample);
  EXPECT_NEAR(search.usual_distance(Execution(1)), 0.1, 1e-9);
  EXPECT_EQ(search.usual_distance(Execution(1)), search.usual_distance(Execution(2)));
  // Of many grains 400 are asked, of all parts of the sample: here most are 1 apart.
  sample.resize(801, sample.front());
  for (std::size_t k = 0; k < 801; ++k) {
    const auto place = static_cast<double>(k);
    sample[k].radial[0] = unit * (k < 300 ? 0.1 * place : place);
  }
  EXPECT_NEAR(GrainSearch(sample).usual_distance(Execution(1)), 1.0, 1e-6);
  EXPECT_ERROR(search.nearest({1.0, 2.0, 3.0, 4.0}), InvalidInput);
  EXPECT_ERROR(GrainSearch({}), InvalidInput);
}

}  // namespace
}  // namespace wscvt
