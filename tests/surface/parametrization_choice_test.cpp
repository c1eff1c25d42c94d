// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/parametrization_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "grains/bent_grain.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

TEST(Parametrization, GentleFlanksAreNotSteep) {
  EXPECT_EQ(steep_share(test::sphere(3), Vector3::Zero(), Execution(1)), 0.0);
  EXPECT_EQ(steep_share(test::box(1.0, 1.0, 1.0), Vector3::Zero(), Execution(1)), 0.0);
  // The steepest flank of an ellipsoid has the tangent (a^2 - b^2) / (2 a b): 67 degrees at 5 : 1,
  // 79 degrees at 10 : 1.
  EXPECT_EQ(
      steep_share(test::scaled(test::sphere(5), Vector3(5, 1, 1)), Vector3::Zero(), Execution(1)),
      0.0);
  EXPECT_GT(
      steep_share(test::scaled(test::sphere(5), Vector3(10, 1, 1)), Vector3::Zero(), Execution(1)),
      steep_share_limit);
}

TEST(Parametrization, FacesThatLookBackAreSteep) {
  for (const test::BentGrain& grain : test::bent_grains()) {
    EXPECT_GT(steep_share(test::bent_grain_mesh(grain, 6000), Vector3::Zero(), Execution(1)),
              steep_share_limit)
        << grain.name;
  }
}

TEST(Parametrization, TheShareIsThatOfTheArea) {
  // A long square prism about its middle: of each face, what lies beyond tan(75 degrees) times its
  // distance from the axis is steep. Cut fine enough for the middles of faces to tell.
  const double length = 20.0;
  const IndexedMesh prism = test::subdivided(test::box(1.0, 1.0, length), 6);
  const double steep_angle = steep_flank_angle * test::pi / 180.0;
  // On the line along the middle of a face; across it the limit grows by at most a factor sqrt(2).
  const double nearest = 2.0 * 0.5 * std::tan(steep_angle);
  const double upper = 4.0 * (length - nearest) / (4.0 * length + 2.0);
  const double lower = 4.0 * (length - std::sqrt(2.0) * nearest) / (4.0 * length + 2.0);
  const double share = steep_share(prism, Vector3::Zero(), Execution(1));
  EXPECT_LT(share, upper + 0.01);
  EXPECT_GT(share, lower - 0.01);
}

TEST(Parametrization, SameBitsOnAnyNumberOfThreads) {
  const IndexedMesh mesh = test::scaled(test::lumpy(5), Vector3(8, 1, 1));
  EXPECT_EQ(steep_share(mesh, Vector3::Zero(), Execution(1)),
            steep_share(mesh, Vector3::Zero(), Execution(3)));
}

TEST(Parametrization, AutoFollowsTheFlanksAndTheSeriesTheFolds) {
  // Steep flanks, hardly a fold: an ellipsoid of 10 : 1 is steep, and folds nowhere.
  const IndexedMesh needle = test::scaled(test::sphere(5), Vector3(10, 1, 1));
  const SurfaceOptions automatic;
  const auto taken = [](const IndexedMesh& mesh, const SurfaceOptions& options, bool needs_series) {
    return choose_parametrization(mesh, Vector3::Zero(), options, needs_series, Execution(1)).taken;
  };
  EXPECT_EQ(taken(needle, automatic, false), Parametrization::Spherical);
  EXPECT_EQ(taken(needle, automatic, true), Parametrization::Radial);
  EXPECT_EQ(taken(test::sphere(4), automatic, false), Parametrization::Radial);
  SurfaceOptions given;
  given.parametrization = Parametrization::Spherical;
  EXPECT_EQ(taken(needle, given, true), Parametrization::Spherical);
  given.parametrization = Parametrization::Radial;
  EXPECT_EQ(taken(needle, given, false), Parametrization::Radial);
  // A dent that hides a little of itself behind its edge, with hardly any flank steep.
  IndexedMesh dented = test::sphere(5);
  for (Vector3& p : dented.points) {
    const double off = (p - Vector3::UnitX()).norm();
    if (off < 0.06) p += (1.0 - off / 0.06) * Vector3(0.0, 0.1, 0.0);
  }
  const ParametrizationChoice fold =
      choose_parametrization(dented, Vector3::Zero(), automatic, false, Execution(1));
  EXPECT_GT(fold.folded_share, 0.0);
  EXPECT_LT(fold.steep_share, steep_share_limit);
  EXPECT_EQ(fold.taken, Parametrization::Spherical);
  const IndexedMesh bent = test::bent_grain_mesh(test::bent_grains().front(), 6000);
  EXPECT_EQ(taken(bent, automatic, true), Parametrization::Spherical);
}

TEST(Parametrization, SeenFromTheCentreGiven) {
  const IndexedMesh mesh = test::scaled(test::lumpy(4), Vector3(8, 1, 1));
  const Vector3 shift(0.5, -3.0, 2.0);
  IndexedMesh moved = mesh;
  for (Vector3& p : moved.points) p += shift;
  EXPECT_NEAR(steep_share(moved, shift, Execution(1)),
              steep_share(mesh, Vector3::Zero(), Execution(1)), 1e-3);  // faces at the limit
}

}  // namespace
}  // namespace wscvt
