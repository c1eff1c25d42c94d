// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "support/volume_folder.h"
#include "toolbox/fabric/fabric.h"
#include "wscvt/base/numbers.h"

namespace wscvt {
namespace {

using test::MadeVolume;

class FabricByHand : public test::VolumeFolder {
 protected:
  std::unique_ptr<LabelVolume> opened(const MadeVolume& made, const std::string& name,
                                      const std::string& spacings) const {
    write(name,
          test::nrrd(made, "spacings: " + spacings + "\nspace units: \"mm\" \"mm\" \"mm\"\n"));
    return open_volume(path(name));
  }
  Fabric fabric_of(const MadeVolume& made) const {
    return measure_fabric(*opened(made, "labels.nrrd", "1 1 1"), FabricOptions(), Execution(1));
  }
};

bool is_within(const Vector3& p, const Vector3& low, const Vector3& high) {
  return (p - low).minCoeff() > 0.0 && (high - p).minCoeff() > 0.0;
}

// Boxes, because a ball's rows beside its tip end a voxel before it.
TEST_F(FabricByHand, OnlyGrainsInTheOutermostVoxelsAreAtTheBorder) {
  const Vector3 size(40, 36, 32);
  const Vector3 half = Vector3::Constant(3.0);
  for (const double away : {0.0, 1.0}) {
    MadeVolume made({40, 36, 32});
    const auto fill = [&](Label label, const Vector3& c) {
      made.fill(label, [&](const Vector3& p) { return is_within(p, c - half, c + half); });
    };
    for (Eigen::Index side = 0; side < 6; ++side) {
      Vector3 c = 0.5 * size;
      c[side / 2] = side % 2 == 0 ? 3.0 + away : size[side / 2] - 3.0 - away;
      fill(static_cast<Label>(side + 1), c);
    }
    fill(7, 0.5 * size);
    const Fabric fabric = fabric_of(made);
    ASSERT_EQ(fabric.grains.size(), 7U);
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_EQ(fabric.grains[k].at_border, away == 0.0) << k << " " << away;
    }
    EXPECT_FALSE(fabric.grains[6].at_border);
    EXPECT_EQ(fabric.whole_grains, away == 0.0 ? 1U : 7U);
  }
}

// Each normal has the trace 1. A wall that closes on itself has none.
TEST_F(FabricByHand, TensorsAreMeansOverContactsThatHaveANormal) {
  MadeVolume made({76, 46, 44});
  const Vector3 middle(24.3, 23.1, 22.4);
  made.fill_ball(3, middle + Vector3(25.0, 0.5, -0.5), 9.0);
  made.fill_ball(1, middle, 18.0);
  made.fill_ball(2, middle, 9.0);
  const Fabric fabric = fabric_of(made);
  ASSERT_EQ(fabric.closed_count, 1U);
  ASSERT_EQ(fabric.contact_count, 2U);
  EXPECT_NEAR(fabric.tensor.trace(), 1.0, 1e-12);
  EXPECT_NEAR(fabric.branch_tensor.trace(), 1.0, 1e-12);
}

// The plane of exact labels goes through faces and gaps of one voxel; wider gaps show a step.
TEST_F(FabricByHand, AStepOfTwoVoxelsBesideAContactDoesNotTurnItsNormal) {
  MadeVolume made({32, 32, 32});
  made.fill(1, [](const Vector3& p) { return is_within(p, {6, 6, 6}, {16, 26, 26}); });
  made.fill(2, [](const Vector3& p) {
    return is_within(p, {16, 6, 6}, {26, 26, 26}) && (p.y() < 16.0 || p.x() > 18.0);
  });
  const Fabric fabric = fabric_of(made);
  ASSERT_EQ(fabric.contacts.size(), 1U);
  EXPECT_EQ(fabric.contacts[0].faces, 200U);
  EXPECT_LT((fabric.contacts[0].normal - Vector3::UnitX()).norm(), 1e-12);
}

// All faces of a wall along the diagonal have their middles in one plane. What they do not tell is
// where it is within a voxel: a twelfth of the square of an axis' share of the normal, as lines
// along one axis meet the wall at the same place.
TEST_F(FabricByHand, ADiagonalWallHasTheUncertaintiesOfTheMiddlesOfItsFaces) {
  constexpr int side = 34;
  MadeVolume made({side, side, side});
  const Vector3 centre(17.2, 16.8, 17.1);
  made.fill_ball(1, centre, 12.0);
  made.fill(2, [&](const Vector3& p) { return (p - centre).norm() < 12.0 && p.sum() > 51.0; });
  std::vector<Vector3> middles;
  Vector3 across = Vector3::Zero();
  const std::array<std::size_t, 3> steps = {1, side, side * side};
  for (std::size_t k = 0; k + steps[2] < made.labels.size(); ++k) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const std::size_t next = k + steps[static_cast<std::size_t>(axis)];
      if (made.labels[k] != 1 || made.labels[next] != 2) continue;
      const auto at = [&](std::size_t step) { return static_cast<double>(k / step % side) + 0.5; };
      middles.push_back(Vector3(at(1), at(side), at(side * side)) + 0.5 * Vector3::Unit(axis));
      across[axis] += 1.0;
    }
  }
  const auto count = static_cast<double>(middles.size());
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : middles) mean += p / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vector3& p : middles) covariance += (p - mean) * (p - mean).transpose() / count;
  ASSERT_NEAR(Vector3::Ones().dot(covariance * Vector3::Ones()), 0.0, 1e-9);
  // Middles across an axis are spread over a voxel along it.
  covariance -= Eigen::Matrix3d((across / (12.0 * count)).asDiagonal());
  const Vector3 in_plane =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().cwiseMax(0.0);
  constexpr double unseen = 1.0 / 3.0 / 12.0;
  const double turn = unseen / count * (1.0 / in_plane[1] + 1.0 / in_plane[2]);

  const Fabric fabric = fabric_of(made);
  ASSERT_EQ(fabric.contacts.size(), 1U);
  const FabricContact& contact = fabric.contacts[0];
  EXPECT_EQ(contact.faces, middles.size());
  // The file's origin is the middle of the first voxel.
  EXPECT_LT((contact.centre + Vector3::Constant(0.5) - mean).norm(), 1e-9);
  // The three counts differ a little, and the normal by as much.
  EXPECT_NEAR(contact.normal_uncertainty * pi / 180.0 / std::sqrt(turn), 1.0, 0.01);
  const double spread = unseen + in_plane[1] + in_plane[2] + 1.0 / 12.0;
  EXPECT_NEAR(contact.centre_uncertainty / std::sqrt(spread / count), 1.0, 1e-4);
}

/// Two labels side by side below the middle of y, void above. `scan`: their blurred grey values.
MadeVolume half_space(bool is_scan, bool is_mirrored) {
  MadeVolume made({16, 40, 8});
  for (std::size_t k = 0; k < made.labels.size(); ++k) {
    const std::size_t row = k / 16 % 40;
    const double above = (is_mirrored ? 39.5 - static_cast<double>(row) : row + 0.5) - 20.0;
    constexpr double blur = 2.0;
    const double share = 0.5 * std::erfc(above / blur / std::sqrt(2.0));
    const Label label = above > 0.0 ? 0 : k % 16 < 8 ? 1 : 2;
    made.labels[k] = is_scan ? static_cast<Label>(std::lround(100.0 + 1000.0 * share)) : label;
  }
  return made;
}

TEST_F(FabricByHand, TheBlurOfAnEdgeIsALengthAndTheSameFromBothSides) {
  const auto blur = [&](bool is_mirrored, const std::string& spacings) {
    const auto labels = opened(half_space(false, is_mirrored), "labels.nrrd", spacings);
    const auto scan = opened(half_space(true, is_mirrored), "scan.nrrd", spacings);
    FabricOptions options;
    options.scan = scan.get();
    return measure_fabric(*labels, options, Execution(1)).blur.value_or(0.0);
  };
  const double cubes = blur(false, "1 1 1");
  EXPECT_GT(cubes, 1.0);
  EXPECT_DOUBLE_EQ(blur(true, "1 1 1"), cubes);
  // All edges are crossed along y.
  EXPECT_NEAR(blur(false, "1 3 1"), 3.0 * cubes, 1e-6);
  EXPECT_NEAR(blur(false, "3 1 3"), cubes, 1e-6);
}

}  // namespace
}  // namespace wscvt
