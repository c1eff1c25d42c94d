// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/grain_grower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/expect_error.h"
#include "support/random_sample.h"
#include "toolbox/sample/distribution.h"
#include "toolbox/sample/grown_mesh.h"
#include "toolbox/sample/random_stream.h"
#include "toolbox/sample/sample_comparison.h"
#include "toolbox/sample/sample_grain.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/measures/mesh_quality.h"
#include "wscvt/repair/overhangs.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

constexpr int degree = 8;

GrowOptions grown_with(int donors, std::uint64_t seed) {
  GrowOptions options;
  options.donors = donors;
  options.seed = seed;
  return options;
}

TEST(GrainGrower, GivesAGrainTheSameWheneverItIsAsked) {
  const SampleGrids grids(degree);
  const GrainGrower grower(test::random_sample(12, grids, 1), grids, grown_with(3, 5));
  const GrainGrower again(test::random_sample(12, grids, 1), grids, grown_with(3, 5));
  const GrainGrower other(test::random_sample(12, grids, 1), grids, grown_with(3, 6));
  const GrownGrain late = again.grow(17);
  for (const std::size_t k : {std::size_t{0}, std::size_t{17}}) {
    const GrownGrain grain = grower.grow(k);
    EXPECT_EQ(grain.radial, again.grow(k).radial);
    EXPECT_EQ(grain.radius, again.grow(k).radius);
    EXPECT_NE(grain.radial, other.grow(k).radial);
  }
  EXPECT_EQ(late.radial, grower.grow(17).radial);
}

TEST(GrainGrower, TakesEachGrainAsBaseOncePerRound) {
  const SampleGrids grids(degree);
  const GrainGrower grower(test::random_sample(10, grids, 2), grids, grown_with(3, 1));
  for (std::size_t round = 0; round < 2; ++round) {
    std::set<std::size_t> bases;
    for (std::size_t k = 0; k < 10; ++k) {
      const GrownGrain grain = grower.grow(10 * round + k);
      ASSERT_EQ(grain.donors.size(), 3U);
      bases.insert(grain.donors.front());
      EXPECT_NE(grain.donors[1], grain.donors[0]);
      EXPECT_LT(grain.donors[1], 10U);
    }
    EXPECT_EQ(bases.size(), 10U);
  }
}

// Attempts are judged three at a time; those that are left at the end count as well.
TEST(GrainGrower, AsksForEachUsableAttempt) {
  const SampleGrids grids(4);
  const GrainGrower grower(test::random_sample(8, grids, 4), grids, grown_with(2, 1));
  int usable = 0;
  const auto never = [&](const GrownGrain&) {
    ++usable;
    return false;
  };
  EXPECT_ERROR(grower.grow(0, never), NumericalFailure);
  ASSERT_NE(usable % 3, 0);
  int asked = 0;
  const GrownGrain last = grower.grow(0, [&](const GrownGrain&) { return ++asked == usable; });
  EXPECT_EQ(last.redraws, 199);
}

// All grains of the sample are one grain and its mirror images, which share form and amplitudes: so
// must all that is grown of them. The form changes by what the amplitudes of the last step move.
TEST(GrainGrower, KeepsFormAndAmplitudesOfASampleThatHasOneOfEach) {
  const SampleGrids grids(degree);
  const SampleGrain one = test::random_sample(1, grids, 3).front();
  std::vector<SampleGrain> sample(8, one);
  for (std::size_t k = 0; k < 8; ++k) {
    const Vector3 signs((k & 1U) != 0 ? -1 : 1, (k & 2U) != 0 ? -1 : 1, (k & 4U) != 0 ? -1 : 1);
    sample[k].radial = mirrored(one.radial, signs);
    sample[k].white = mirrored(one.white, signs);
  }
  const GrainGrower grower(sample, grids, grown_with(3, 4));
  const std::vector<double> wanted = degree_amplitudes(one.radial);
  for (std::size_t k = 0; k < 8; ++k) {
    const GrownGrain grain = grower.grow(k);
    EXPECT_NEAR(grain.radius, one.radius, 1e-12);
    const std::vector<double> amplitudes = degree_amplitudes(grain.radial);
    for (std::size_t l = 7; l <= degree; ++l) EXPECT_NEAR(amplitudes[l], wanted[l], 1e-12);
    const HarmonicGrid& grid = grids.fine_radial();
    const RadialMoments moments = radial_moments(grid, grid.values(grain.radial));
    const Eigen::Matrix3d expected = one.deviations.cwiseAbs2().asDiagonal();
    EXPECT_LT((moments.covariance - expected).norm(), 0.01);
  }
}

// By .15 of the deviation of the sizes' logarithms about the base grain's size.
TEST(GrainGrower, SizesAreNearThoseOfTheBaseGrains) {
  const SampleGrids grids(4);
  std::vector<SampleGrain> sample = test::random_sample(8, grids, 5);
  for (std::size_t k = 0; k < 8; ++k) sample[k].radius = std::exp(0.25 * static_cast<double>(k));
  // Of 0 to 7 the variance is 63 / 12.
  const double expected = 0.15 * 0.25 * std::sqrt(63.0 / 12.0);
  const GrainGrower grower(sample, grids, grown_with(2, 4));
  double squares = 0.0;
  constexpr std::size_t count = 48;
  for (std::size_t k = 0; k < count; ++k) {
    const GrownGrain grain = grower.grow(k);
    const double moved = std::log(grain.radius / sample[grain.donors.front()].radius);
    squares += moved * moved / static_cast<double>(count);
  }
  // The deviation of 48 normal numbers errs by a tenth.
  EXPECT_NEAR(std::sqrt(squares) / expected, 1.0, 0.3);
}

// Whatever the sample says of its form.
TEST(GrainGrower, GrowsUnitVolumes) {
  const SampleGrids grids(degree);
  std::vector<SampleGrain> sample = test::random_sample(8, grids, 3);
  for (SampleGrain& grain : sample) grain.deviations *= 1.2;
  const GrainGrower grower(sample, grids, grown_with(3, 4));
  for (std::size_t k = 0; k < 3; ++k) {
    const HarmonicGrid& grid = grids.fine_radial();
    const double volume = radial_moments(grid, grid.values(grower.grow(k).radial)).volume;
    // The amplitudes of the last step change it by their squares.
    EXPECT_NEAR(volume / (4.0 * pi / 3.0), 1.0, 0.03);
  }
}

// Sphericities here are closer to each other than what the sample says of convexity.
TEST(GrainGrower, JudgesAttemptsInDeviationsOfTheSample) {
  const SampleGrids grids(4);
  std::vector<SampleGrain> sample = test::random_sample(8, grids, 4);
  std::vector<double> sphericities, convexities;
  for (std::size_t k = 0; k < 8; ++k) {
    sample[k].convexity = 0.5 + 0.05 * static_cast<double>(k);
    sphericities.push_back(sample[k].sphericity);
    convexities.push_back(sample[k].convexity);
  }
  const auto deviation = [](const std::vector<double>& values) {
    return Distribution(values).deviation();
  };
  std::vector<double> distances;
  const GrainGrower grower(sample, grids, grown_with(2, 1));
  const auto judge = [&](const GrownGrain& grain) {
    const QuickShape shape =
        quick_shape({surface_points(grain.radial, grain.offset, grids.sphere().points),
                     grids.sphere().triangles},
                    Execution(1));
    const SampleGrain& base = sample[grain.donors.front()];
    distances.push_back(
        std::hypot((shape.shape.sphericity - base.sphericity) / deviation(sphericities),
                   (shape.convexity - base.convexity) / deviation(convexities)));
    return distances.size() == 30;
  };
  grower.grow(0, judge);
  ASSERT_EQ(distances.size(), 30U);
  for (std::size_t k = 0; k < 30; k += 3) {
    EXPECT_LE(distances[k], distances[k + 1]) << k;
    EXPECT_LE(distances[k + 1], distances[k + 2]) << k;
  }
}

// Donors of one relief that is its own mirror image are followed everywhere, others hardly anywhere
// if there are six: a cap of 40 degrees is an eighth of the sphere. What is coarse does not count.
TEST(GrainGrower, TellsWhereItFollowsADonor) {
  const SampleGrids grids(degree);
  SampleGrain one = test::random_sample(1, grids, 3).front();
  std::fill(one.white.begin(), one.white.end(), 0.0);
  std::vector<SampleGrain> equal(8, one);
  std::vector<SampleGrain> others(8, one);
  RandomStream random(1, 0);
  for (std::size_t k = 0; k < 8; ++k) {
    others[k].white[harmonic_index(4, 4)] = 0.1;
    equal[k].white[harmonic_index(8, 0)] = 0.05;
    equal[k].white[harmonic_index(8, 2)] = 0.03;
    for (std::size_t i = 49; i < one.white.size(); ++i)
      others[k].white[i] = 0.002 * random.normal();
  }
  const auto collage = [&](const std::vector<SampleGrain>& sample) {
    const GrainGrower grower(sample, grids, grown_with(6, 1));
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += grower.grow(k).collage;
    return sum / 4.0;
  };
  EXPECT_GT(collage(equal), 0.9);
  EXPECT_LT(collage(others), 0.6);
}

TEST(GrainGrower, GrowsDifferentGrainsOfEqualOnes) {
  const SampleGrids grids(degree);
  const std::vector<SampleGrain> sample(8, test::random_sample(1, grids, 3).front());
  const GrainGrower grower(sample, grids, grown_with(3, 4));
  for (std::size_t k = 1; k < 4; ++k) EXPECT_NE(grower.grow(k).radial, grower.grow(0).radial);
}

// Poses of the inputs do not matter: each grain stands in its principal frame before it is used.
TEST(GrainGrower, GrowsTheSameOfTurnedInputs) {
  const SampleGrids grids(degree);
  std::vector<SampleGrain> straight, turned;
  std::uint64_t seed = 40;
  for (const HarmonicSurface& surface : test::random_surfaces(8, degree, 5)) {
    const IndexedMesh mesh = mesh_of_surface(surface, 16, Execution(1));
    straight.push_back(sample_grain(mesh, grids, Execution(1)));
    turned.push_back(
        sample_grain(test::transformed(mesh, test::random_rotation(++seed)), grids, Execution(1)));
  }
  const GrainGrower a(straight, grids, grown_with(3, 9)), b(turned, grids, grown_with(3, 9));
  for (std::size_t k = 0; k < 6; ++k) {
    const GrownGrain one = a.grow(k), other = b.grow(k);
    EXPECT_EQ(one.donors, other.donors);
    for (std::size_t i = 0; i < one.radial.size(); ++i) {
      EXPECT_NEAR(one.radial[i], other.radial[i], 1e-8);
    }
  }
}

// An engine takes the origin for the centre of mass and the axes for the principal ones.
TEST(GrainGrower, MeshesOfFewNodesStandInTheirOwnPrincipalFrame) {
  const SampleGrids grids(degree);
  const std::vector<SampleGrain> sample = test::random_sample(8, grids, 3);
  const GrainGrower grower(sample, grids, grown_with(3, 9));
  const GrownMeshes meshes(60, Execution(1));
  for (std::size_t k = 0; k < 5; ++k) {
    const GrownBody body = grow_body(grower, meshes, k);
    const ShapeDescriptors shape = describe_shape(body.mesh, Execution(1));
    EXPECT_LT(shape.centroid.norm(), 1e-12 * body.grain.radius);
    const Eigen::Matrix3d& tensor = shape.inertia_tensor;
    const Eigen::Vector3d moments = tensor.diagonal();
    EXPECT_LT((tensor - Eigen::Matrix3d(moments.asDiagonal())).norm(), 1e-10 * moments.norm());
    EXPECT_LE(moments[0], moments[1]);
    EXPECT_LE(moments[1], moments[2]);
  }
}

// The distance that two samples of 200 reach by chance in 1 of 1,000 is .195. Without the
// amplitudes that of convexity is above .5.
TEST(GrainGrower, KeepsTheDistributionsOfGrainsThatItHasNotSeen) {
  const SampleGrids grids(degree);
  std::vector<SampleGrain> all = test::random_sample(400, grids, 6);
  const std::vector<SampleGrain> unseen(all.begin() + 200, all.end());
  all.resize(200);
  const GrainGrower grower(all, grids, grown_with(3, 1));
  const GrownMeshes meshes(150, Execution(1));
  std::array<std::vector<double>, 4> real, grown;
  std::vector<double> real_sizes, grown_sizes;
  const auto add = [&](const std::vector<double>& radial, std::array<std::vector<double>, 4>& to) {
    const QuickShape shape = quick_shape(meshes.mesh(radial, 1.0), Execution(1));
    to[0].push_back(shape.shape.sphericity);
    to[1].push_back(shape.form.zingg_elongation);
    to[2].push_back(shape.form.zingg_flatness);
    to[3].push_back(shape.convexity);
  };
  for (const SampleGrain& grain : unseen) {
    add(grain.radial, real);
    real_sizes.push_back(grain.radius);
  }
  for (std::size_t k = 0; k < 200; ++k) {
    const GrownGrain grain = grower.grow(k);
    add(grain.radial, grown);
    grown_sizes.push_back(grain.radius);
    EXPECT_GE(grain.collage, 0.0);
    EXPECT_LE(grain.collage, 1.0);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT(distance_between(Distribution(real[k]), Distribution(grown[k])).kolmogorov, 0.195)
        << k;
  }
  EXPECT_LT(distance_between(Distribution(real_sizes), Distribution(grown_sizes)).kolmogorov,
            0.195);
}

TEST(GrainGrower, GrowsGrainsWithOverhangs) {
  const SampleGrids grids(12);
  const std::vector<SampleGrain> sample = test::bent_sample(grids);
  const GrainGrower grower(sample, grids, grown_with(3, 1));
  const GrownMeshes meshes(400, Execution(1));
  double real = 0.0, grown = 0.0;
  std::size_t with_overhangs = 0;
  const auto overhang = [](const IndexedMesh& mesh) {
    return overhang_solid_angle(mesh, describe_shape(mesh, Execution(1)).centroid, Execution(1));
  };
  for (std::size_t k = 0; k < sample.size(); ++k) {
    real += overhang(meshes.mesh(sample[k].radial, 1.0, sample[k].radial_offset));
    const GrownBody body = grow_body(grower, meshes, k);
    EXPECT_EQ(body.mesh.points.size(), 400U);
    EXPECT_EQ(test::bad_edges(body.mesh), 0U);
    EXPECT_TRUE(self_intersections(body.mesh).empty()) << k;
    EXPECT_LT(describe_shape(body.mesh, Execution(1)).centroid.norm(), 1e-9);
    EXPECT_NEAR(std::cbrt(describe_shape(body.mesh, Execution(1)).volume * 0.75 / pi),
                body.grain.radius, 1e-9);
    grown += overhang(body.mesh);
    if (overhang(body.mesh) > 0.05) ++with_overhangs;
  }
  EXPECT_GE(with_overhangs, 5U);
  EXPECT_GT(grown, 0.5 * real);
  EXPECT_LT(grown, 1.5 * real);
}

TEST(GrainGrower, RefusesWhatItCannotGrow) {
  const SampleGrids grids(degree);
  EXPECT_ERROR(GrainGrower(test::random_sample(7, grids, 1), grids, GrowOptions()), InvalidInput);
  EXPECT_ERROR(GrainGrower(test::random_sample(8, grids, 1), grids, grown_with(1, 1)),
               InvalidInput);
  EXPECT_ERROR(GrainGrower(test::random_sample(8, grids, 1), grids, grown_with(9, 1)),
               InvalidInput);
}

// White grains that fold the form over: no attempt is star-shaped.
TEST(GrainGrower, SaysThatNoAttemptIsStarShaped) {
  const SampleGrids grids(degree);
  std::vector<SampleGrain> sample = test::random_sample(8, grids, 7);
  for (SampleGrain& grain : sample) {
    for (std::size_t k = 49; k < grain.radial.size(); ++k) grain.radial[k] += 2.0;
  }
  const GrainGrower grower(sample, grids, grown_with(3, 1));
  EXPECT_ERROR(grower.grow(0), NumericalFailure);
}

}  // namespace

namespace {

TEST(GrownMeshes, HaveExactlyTheNodesAndTheVolume) {
  const SampleGrids grids(8);
  const GrownMeshes meshes(213, Execution(1));
  for (const SampleGrain& grain : test::random_sample(4, grids, 21)) {
    const IndexedMesh mesh = meshes.mesh(grain.radial, 1.7);
    EXPECT_EQ(mesh.points.size(), 213U);
    EXPECT_EQ(mesh.triangles.size(), 2U * 213U - 4U);
    EXPECT_EQ(test::bad_edges(mesh), 0U);
    EXPECT_NEAR(describe_shape(mesh, Execution(1)).volume, 4.0 * pi / 3.0 * 1.7 * 1.7 * 1.7, 1e-9);
    const HarmonicSurface surface(grain.radial);
    const double scale = mesh.points[0].norm() / surface.radius(mesh.points[0].normalized());
    for (const Vector3& point : mesh.points) {
      EXPECT_NEAR(point.norm(), scale * surface.radius(point.normalized()), 1e-9);
    }
  }
  EXPECT_ERROR(GrownMeshes(3, Execution(1)), InvalidInput);
}

// The lattice's own triangles on an ellipsoid 3 : 1 : 1 have angles down to 13 degrees.
TEST(GrownMeshes, HaveNoThinTrianglesOnLongGrains) {
  std::vector<double> radial(harmonic_count(4), 0.0);
  radial[0] = std::sqrt(4.0 * pi);
  radial[harmonic_index(2, 2)] = 0.9;
  radial[harmonic_index(2, 0)] = -0.5;
  const IndexedMesh mesh = GrownMeshes(300, Execution(1)).mesh(radial, 1.0);
  EXPECT_GT(measure_quality(mesh, Execution(1)).smallest_angle, 20.0);
}

TEST(GrownMeshes, AreMeasured) {
  std::vector<double> radial(harmonic_count(4), 0.0);
  radial[0] = std::sqrt(4.0 * pi);
  const QuickShape ball =
      quick_shape(GrownMeshes(2000, Execution(1)).mesh(radial, 3.0), Execution(1));
  EXPECT_NEAR(ball.shape.sphericity, 1.0, 0.01);
  EXPECT_NEAR(ball.form.zingg_elongation, 1.0, 0.01);
  EXPECT_NEAR(ball.form.zingg_flatness, 1.0, 0.01);
  EXPECT_NEAR(ball.convexity, 1.0, 1e-9);
  const QuickShape box = quick_shape(test::box(6.0, 3.0, 2.0), Execution(1));
  EXPECT_NEAR(box.form.zingg_elongation, 0.5, 1e-9);
  EXPECT_NEAR(box.form.zingg_flatness, 2.0 / 3.0, 1e-9);
}

}  // namespace
}  // namespace wscvt
