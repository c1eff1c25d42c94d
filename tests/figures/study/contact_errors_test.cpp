// SPDX-License-Identifier: GPL-3.0-or-later
// The contact study in small, with what its page claims: one grain, 200 nodes, 400 contacts.
#include "figures/study/contact_errors.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::study {
namespace {

/// A sphere knows its contacts: two of radius 1 touch at a distance of 2, and nodes on it that are
/// a cap's middle away hide the gaps of the two curvatures.
TEST(ContactErrors, OfASphereAreThoseOfItsCaps) {
  const Execution execution(2);
  const ContactGrain grain(unit_scan(test::sphere(5), execution), 200, execution);
  const ContactErrors dense = grain.errors(node_table(test::sphere(6)), execution);
  EXPECT_NEAR(dense.grain.mean, 0.0, 0.05);
  EXPECT_NEAR(dense.plane.mean, 0.0, 0.05);
  EXPECT_NEAR(dense.deepest_force.mean, 1.0, 0.05);
  EXPECT_NEAR(dense.area_force.mean, 1.0, 0.05);
  EXPECT_EQ(dense.missed, 0.0);

  const ContactErrors coarse = grain.errors(node_table(test::sphere(2)), execution);
  // The squared distance to the nearest of N nodes is A / 2 pi in the mean over a round cell of the
  // area A = 4 pi / N, and a node so far off lies half of it times the sum of curvatures deeper.
  const double square = 2.0 / 162.0;
  EXPECT_NEAR(coarse.grain.mean, -100.0 * square, 0.1 * 100.0 * square);
  EXPECT_NEAR(coarse.plane.mean, -50.0 * square, 0.1 * 50.0 * square);
  // As deep as that overlap is, half the contacts at 1 % are not seen.
  EXPECT_GT(coarse.missed, 20.0);
  // Nodes shifted outward by a tenth touch so much earlier.
  const ContactErrors larger = grain.errors(
      node_table(test::transformed(test::sphere(6), 1.1 * Eigen::Matrix3d::Identity())), execution);
  // Distances that are linear in cells of 0.04 grow by 1 % less than the way outside a sphere.
  EXPECT_NEAR(larger.grain.mean, 10.0, 0.15);
  EXPECT_NEAR(larger.both.mean, 10.0, 0.15);
  EXPECT_NEAR(larger.plane.mean, 10.0, 0.1);
}

TEST(ContactErrors, ComeOutAsThePageSays) {
  const Execution execution;
  const IndexedMesh scan =
      unit_scan(read_mesh(std::string(WSCVT_MESHES_DIR) + "/sand_7228.ply"), execution);
  const ContactGrain grain(scan, 400, execution);
  std::map<std::string, ContactErrors> errors;
  for (const ContactSampling& sampling : contact_samplings()) {
    RemeshOptions options = sampling.options;
    options.node_count = 200;
    errors[sampling.name] =
        grain.errors(node_table(remesh(scan, options, execution).mesh), execution);
  }
  const ContactErrors& published = errors.at("WSCVT-D");
  EXPECT_NEAR(published.grain.mean, -3.2, 0.4);
  EXPECT_GT(errors.at("fitted").grain.mean, 0.5 * published.grain.mean);
  // A law of the deepest node: hardly a force on the surface, most of it by fitted nodes.
  EXPECT_LT(published.deepest_force.mean, 0.1);
  EXPECT_NEAR(errors.at("fitted").deepest_force.mean, 0.7, 0.2);
  // A sum by area: about right on the surface, far too much off it.
  EXPECT_NEAR(published.area_force.mean, 1.0, 0.4);
  EXPECT_GT(errors.at("fitted").area_force.mean, 3.0);
  // Contact placements: each without bias for what it is fitted to; 0.2 % is three standard errors.
  // Against the other grain's surface some is left, which the page says.
  EXPECT_NEAR(errors.at("contact 0.4").grain.mean, -0.17, 0.2);
  EXPECT_NEAR(errors.at("contact 1.3").both.mean, 0.0, 0.2);
  EXPECT_NEAR(errors.at("contact 5").plane.mean, 0.0, 0.2);
  EXPECT_LT(errors.at("contact 5").plane.scatter, 0.5 * published.plane.scatter);
  EXPECT_LT(errors.at("contact 1.3").both.scatter, 0.5 * published.grain.scatter);
}

}  // namespace
}  // namespace wscvt::study
