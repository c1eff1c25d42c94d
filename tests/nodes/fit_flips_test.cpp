// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>

#include "nodes/fit_bodies.h"
#include "wscvt/nodes/fit_steps.h"
#include "wscvt/surface/self_intersections.h"

namespace wscvt {
namespace {

/// Flips edges at random where that makes no triangle sharper than 15 degrees.
void shuffle_edges(EditMesh& mesh, int wanted) {
  std::mt19937 random(4);
  for (int flips = 0; flips < wanted;) {
    const auto h = static_cast<std::int32_t>(random() % mesh.opposite.size());
    const std::int32_t a = mesh.origin(h);
    const std::int32_t b = mesh.target(h);
    const std::int32_t c = mesh.apex(h);
    const std::int32_t d = mesh.apex(mesh.opposite[h]);
    if (mesh.degrees[a] <= 4 || mesh.degrees[b] <= 4 || mesh.joined(c, d)) continue;
    const auto sharp = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
      return largest_corner_cosine(mesh.points[i], mesh.points[j], mesh.points[k]) > 0.966;
    };
    if (sharp(c, a, d) || sharp(c, d, b)) continue;
    mesh.flip(h);
    ++flips;
  }
}

int flip_to_rest(FitState& state) {
  int all = 0;
  for (int pass = 0; pass < 10; ++pass) {
    const int flips = flip_for_fit(state);
    all += flips;
    if (flips == 0) break;
  }
  return all;
}

TEST(FitFlips, MakeGoodWhatWasFlippedAtRandom) {
  const IndexedMesh body = test::scaled(test::lumpy(4), Vector3(1.2, 1.0, 0.7));
  const EditMesh nodes = test::clusters(body, 250);
  const double sound = test::mean_square(test::fit_state(body, nodes));
  EditMesh shuffled = nodes;
  shuffle_edges(shuffled, 60);
  FitState state = test::fit_state(body, shuffled);
  const double before = test::mean_square(state);
  ASSERT_GT(before, 1.2 * sound);
  EXPECT_GT(flip_to_rest(state), 40);
  test::expect_in_step(state);
  EXPECT_LT(test::mean_square(state) - sound, 0.5 * (before - sound));
  EXPECT_LT(mean_edge_ratio(state.mesh), mean_edge_ratio(shuffled));
}

TEST(FitFlips, TurnEdgesAlongARidge) {
  // Two squares meet at a right angle along the middle; the mesh's edge goes across it.
  const IndexedMesh box = test::transformed(test::subdivided(test::box(1.0, 1.1, 1.2), 3),
                                            test::random_rotation(2), Vector3::Zero());
  FitState state = test::fit_state(box, test::clusters(box, 150));
  state.round.evenness = 0.02;
  const double before = test::mean_square(state);
  EXPECT_GT(flip_to_rest(state), 0);
  EXPECT_LT(test::mean_square(state), 0.95 * before);
  test::expect_in_step(state);
}

TEST(FitFlips, KeepTheAngleOfTheLateRounds) {
  // Edges along the ridges of a box want triangles that are as sharp as one lets them be.
  const IndexedMesh box = test::transformed(test::subdivided(test::box(1.0, 1.1, 1.2), 3),
                                            test::random_rotation(2), Vector3::Zero());
  const auto sharp_after_flips = [&](bool late) {
    FitState state = test::fit_state(box, test::clusters(box, 150));
    state.round.evenness = 0.001;
    const double limit = std::cos(30.0 * pi / 180.0);
    std::vector<double> before;
    for (std::size_t t = 0; t < state.mesh.triangles.size(); ++t) {
      before.push_back(state.mesh.sharpness(t));
    }
    state.round.late = late;
    if (late) state.round.sharpness_limit = limit;
    flip_to_rest(state);
    int sharp = 0;
    for (std::size_t t = 0; t < before.size(); ++t) {
      if (state.mesh.sharpness(t) > limit) ++sharp;
      if (before[t] > limit) --sharp;
    }
    return sharp;
  };
  EXPECT_GT(sharp_after_flips(false), 3);
  EXPECT_LE(sharp_after_flips(true), 0);
}

TEST(FitFlips, GiveNodesSixNeighboursWhereNothingElseIsToGain) {
  // On a ball errors change little: what counts is lengths and degrees.
  const IndexedMesh ball = test::sphere(4);
  EditMesh nodes = test::editable(test::sphere(2));
  shuffle_edges(nodes, 20);
  FitState state = test::fit_state(ball, nodes);
  flip_to_rest(state);
  EXPECT_EQ(std::count(state.mesh.degrees.begin(), state.mesh.degrees.end(), 6), 150);
  EXPECT_EQ(std::count(state.mesh.degrees.begin(), state.mesh.degrees.end(), 5), 12);
}

TEST(FitFlips, LeaveWhatIsEven) {
  const IndexedMesh ball = test::sphere(3);
  FitState state = test::fit_state(ball, test::editable(test::sphere(2)));
  EXPECT_EQ(flip_for_fit(state), 0);
}

}  // namespace
}  // namespace wscvt
