// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/fabric/fabric.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/test_shapes.h"
#include "support/volume_folder.h"
#include "toolbox/fabric/fabric_files.h"
#include "toolbox/volume/segmentation.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

using test::holds;
using test::MadeVolume;

double angle_between(const Vector3& a, const Vector3& b) {
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) * 180.0 / pi;
}

/// Two balls that overlap: each voxel is in the ball whose surface it is deeper below, so the
/// border is the plane of the disc.
struct TwoBalls {
  Vector3 a, b;
  double radius_a, radius_b;

  Vector3 normal() const { return (b - a).normalized(); }
  /// From `a` to the plane of the disc.
  double to_plane() const {
    const double d = (b - a).norm();
    return (d * d + radius_a * radius_a - radius_b * radius_b) / (2.0 * d);
  }
  Vector3 centre() const { return a + to_plane() * normal(); }
  double area() const { return pi * (radius_a * radius_a - to_plane() * to_plane()); }

  MadeVolume voxels(const std::array<int, 3>& counts, const Vector3& spacing) const {
    MadeVolume made(counts);
    const auto power = [&](const Vector3& p, const Vector3& centre, double radius) {
      return (p.cwiseProduct(spacing) - centre).squaredNorm() - radius * radius;
    };
    made.fill(1, [&](const Vector3& p) {
      const double to_a = power(p, a, radius_a);
      return to_a < 0.0 && to_a <= power(p, b, radius_b);
    });
    made.fill(2, [&](const Vector3& p) {
      const double to_b = power(p, b, radius_b);
      return to_b < 0.0 && to_b < power(p, a, radius_a);
    });
    return made;
  }
};

class FabricOfAFile : public test::VolumeFolder {
 protected:
  void write_labels(const MadeVolume& made, const std::string& name = "labels.nrrd",
                    const std::string& spacings = "1 1 1") const {
    write(name,
          test::nrrd(made, "spacings: " + spacings + "\nspace units: \"mm\" \"mm\" \"mm\"\n"));
  }
  Fabric measured(const std::string& labels, const std::string& scan = "", double background = 0.0,
                  int threads = 1) const {
    const auto volume = open_volume(path(labels));
    FabricOptions options;
    options.background = background;
    std::unique_ptr<LabelVolume> greys;
    if (!scan.empty()) greys = open_volume(path(scan));
    options.scan = greys.get();
    return measure_fabric(*volume, options, Execution(threads));
  }
  Fabric measured(const MadeVolume& made, const std::string& spacings = "1 1 1") const {
    write_labels(made, "labels.nrrd", spacings);
    return measured("labels.nrrd");
  }
  /// Balls in a row, with labels that are not in the order of their places, and one at the border.
  static MadeVolume chain() {
    MadeVolume made({64, 30, 30});
    made.fill_ball(7, {2, 15, 15}, 9.0);
    made.fill_ball(3, {18.6, 15.4, 15}, 9.0);
    made.fill_ball(12, {36.1, 14, 15.7}, 9.6);
    made.fill_ball(5, {51, 16, 14}, 8.0);
    return made;
  }
};

TEST_F(FabricOfAFile, GivesTheDiscOfTwoBallsInObliqueDirections) {
  std::mt19937 random(20);
  std::normal_distribution<double> normal;
  std::vector<double> ratios;
  std::vector<double> errors;
  const Vector3 half = Vector3::Constant(0.5);  // the file's origin is the middle of a voxel
  double of_normals = 0.0;                      // squares of errors over uncertainties
  double of_centres = 0.0;
  for (int k = 0; k < 24; ++k) {
    const Vector3 n = Vector3(normal(random), normal(random), normal(random)).normalized();
    const Vector3 middle(32.3, 31.8, 32.1);
    const TwoBalls balls{middle - 14.0 * n, middle + 13.0 * n, 15.5, 14.0};
    const Fabric fabric = measured(balls.voxels({64, 64, 64}, Vector3::Ones()));
    ASSERT_EQ(fabric.contacts.size(), 1U);
    const FabricContact& contact = fabric.contacts[0];
    EXPECT_TRUE(contact.is_contact);
    EXPECT_EQ(fabric.grains[contact.first].label, 1U);
    ratios.push_back(contact.area / balls.area());
    errors.push_back(angle_between(contact.normal, balls.normal()));
    const double off = (contact.centre + half - balls.centre()).norm();
    EXPECT_LT(off, 3.0 * contact.centre_uncertainty);
    of_normals += std::pow(errors.back() / contact.normal_uncertainty, 2) / 24.0;
    of_centres += std::pow(off / contact.centre_uncertainty, 2) / 24.0;
    EXPECT_GT(contact.raw_area, balls.area());
    // Balls of 1 % discretization.
    EXPECT_LT((contact.branch - (balls.b - balls.a)).norm(), 0.7);
  }
  std::sort(ratios.begin(), ratios.end());
  std::sort(errors.begin(), errors.end());
  // As in the study: single areas within 15 %, their median within 3; normals by the median 1.5.
  EXPECT_NEAR(ratios[12], 1.0, 0.03);
  EXPECT_GT(ratios.front(), 0.85);
  EXPECT_LT(ratios.back(), 1.15);
  EXPECT_LT(errors[12], 1.5);
  // Standard uncertainties: the means are of the order of 1. Those of ten times 24 directions are
  // 0.7 to 2.7 and 0.09 to 0.2.
  EXPECT_NEAR(std::log10(of_normals), 0.0, 0.5);
  EXPECT_NEAR(std::log10(of_centres), 0.0, 1.2);
}

// A grain inside another, and inside a cup: no projection of their wall tells its area.
TEST_F(FabricOfAFile, TakesAWallThatClosesOnItselfForAContact) {
  constexpr double radius = 9.0;
  for (const double rim : {48.0, 31.0}) {
    MadeVolume made({48, 46, 44});
    const Vector3 middle(24.3, 23.1, 22.4);
    made.fill(1, [&](const Vector3& p) { return (p - middle).norm() < 18.0 && p.z() < rim; });
    made.fill_ball(2, middle, radius);
    write_labels(made);
    const Fabric fabric = measured("labels.nrrd");
    ASSERT_EQ(fabric.contacts.size(), 1U);
    EXPECT_TRUE(fabric.contacts[0].is_contact) << rim;
    EXPECT_TRUE(fabric.contacts[0].is_closed) << rim;
    EXPECT_EQ(fabric.closed_count, 1U);
    const double covered = std::min(2.0 * radius, rim - middle.z() + radius);
    // Steps of voxels over a ball: within a tenth, as its uncertainty says.
    EXPECT_NEAR(fabric.contacts[0].area / (2.0 * pi * radius * covered), 1.0, 0.1) << rim;
    // A closed wall has no rim, whose width the labels may have changed.
    EXPECT_EQ(fabric.contact_area, fabric.contacts[0].area);
    EXPECT_NEAR(fabric.contact_area_uncertainty, fabric.contacts[0].area_uncertainty,
                1e-12 * fabric.contact_area);
    EXPECT_EQ(fabric.tensor.norm(), 0.0) << "it has no normal";
    bool is_told = false;
    for (const std::string& line : fabric_lines(fabric)) {
      is_told = is_told || line.find("closes on itself") != std::string::npos;
    }
    EXPECT_TRUE(is_told);
  }
}

TEST_F(FabricOfAFile, RefusesGreyValues) {
  std::mt19937 random(22);
  MadeVolume scan = chain();
  for (Label& voxel : scan.labels) voxel = 60 + 5 * voxel + random() % 4;
  write_labels(scan);
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { measured("labels.nrrd"); });
  EXPECT_TRUE(holds(sentence, "look like grey values"));
  EXPECT_TRUE(holds(sentence, "wscvt segment"));
}

TEST_F(FabricOfAFile, HasNoContactAcrossAGapThatLabelsClose) {
  std::mt19937 random(21);
  std::normal_distribution<double> normal;
  int touching = 0;
  for (int k = 0; k < 30; ++k) {
    const Vector3 n = Vector3(normal(random), normal(random), normal(random)).normalized();
    const Vector3 middle(32.3, 31.8, 32.1);
    MadeVolume made({64, 64, 64});
    made.fill_ball(1, middle - 14.2 * n, 14.0);
    made.fill_ball(2, middle + 14.2 * n, 14.0);
    const Fabric fabric = measured(made);
    for (const FabricContact& contact : fabric.contacts) {
      ++touching;
      EXPECT_GT(contact.raw_area, 0.0);
      EXPECT_FALSE(contact.is_contact) << n.transpose();
      EXPECT_LT(contact.area, 0.0);
      EXPECT_EQ(fabric.grains[contact.first].touching, 1U);
      EXPECT_EQ(fabric.grains[contact.first].contacts, 0U);
    }
    EXPECT_EQ(fabric.contact_count, 0U);
    EXPECT_EQ(fabric.whole_grains, 2U);
    EXPECT_EQ(fabric.coordination, 0.0);
    EXPECT_EQ(fabric.contact_area, 0.0);
    EXPECT_EQ(fabric.contact_area_uncertainty, 0.0);
  }
  EXPECT_GT(touching, 5);
}

TEST_F(FabricOfAFile, MeasuresFlatWallsExactly) {
  // Two half spaces, the wall across each axis, voxels of three lengths.
  for (int axis = 0; axis < 3; ++axis) {
    MadeVolume made({20, 22, 24});
    made.fill(4, [&](const Vector3& p) { return p[axis] < 9.0; });
    made.fill(9, [&](const Vector3& p) { return p[axis] > 9.0; });
    const Vector3 spacing(0.5, 1.0, 2.0);
    const Fabric fabric = measured(made, "0.5 1 2");
    ASSERT_EQ(fabric.contacts.size(), 1U);
    const FabricContact& contact = fabric.contacts[0];
    double area = 1.0;
    for (int k = 0; k < 3; ++k) {
      if (k != axis) area *= spacing[k] * made.counts[static_cast<std::size_t>(k)];
    }
    EXPECT_NEAR(contact.raw_area, area, 1e-9 * area);
    EXPECT_NEAR(contact.area, area, 1e-9 * area);
    EXPECT_NEAR(contact.normal[axis], 1.0, 1e-12);
    EXPECT_TRUE(contact.at_border);
    EXPECT_EQ(fabric.whole_grains, 0U);
    EXPECT_EQ(fabric.geometry.unit, "mm");
    // F has one direction: 15/2 (1 - 1/3, -1/3, -1/3), whose norm is 15/2 sqrt(2/3).
    EXPECT_NEAR(anisotropy_of(fabric.tensor), 7.5, 1e-9);
  }
}

TEST_F(FabricOfAFile, TakesVoxelsThatAreNoCubes) {
  const Vector3 spacing(0.4, 0.5, 0.7);
  std::vector<double> ratios;
  for (const Vector3& direction : {Vector3(1.0, 2.0, 2.0), Vector3(-2.0, 1.0, 0.5),
                                   Vector3(0.3, -1.0, 1.4), Vector3(1.0, 1.0, -0.2)}) {
    const Vector3 n = direction.normalized();
    const Vector3 middle(16.1, 16.2, 16.3);
    const TwoBalls balls{middle - 7.0 * n, middle + 6.5 * n, 7.8, 7.1};
    const Fabric fabric = measured(balls.voxels({80, 64, 46}, spacing), "0.4 0.5 0.7");
    ASSERT_EQ(fabric.contacts.size(), 1U);
    ratios.push_back(fabric.contacts[0].area / balls.area());
    EXPECT_LT(angle_between(fabric.contacts[0].normal, balls.normal()), 3.0);
    EXPECT_NEAR(fabric.grains[0].volume, 4.0 / 3.0 * pi * std::pow(7.8, 3), 40.0);
    EXPECT_LT((fabric.contacts[0].centre - balls.centre() + 0.0 * spacing).norm(), 0.5);
  }
  for (const double ratio : ratios) EXPECT_NEAR(ratio, 1.0, 0.15);
}

// The plane through the middles of all faces is none of these walls.
TEST_F(FabricOfAFile, HasTheNormalOfGrainsThatTouchAtSeveralPlaces) {
  // Two flat places on different heights, and a wide gap between them.
  MadeVolume made({30, 14, 40});
  const auto is_place = [](const Vector3& p) { return p.x() < 10.0 || p.x() > 20.0; };
  const auto height = [](const Vector3& p) { return p.x() < 15.0 ? 14.0 : 26.0; };
  made.fill(1, [&](const Vector3& p) { return p.z() < height(p) - (is_place(p) ? 0.0 : 6.0); });
  made.fill(2, [&](const Vector3& p) { return p.z() > height(p) + (is_place(p) ? 0.0 : 6.0); });
  const Fabric places = measured(made);
  ASSERT_EQ(places.contacts.size(), 1U);
  EXPECT_NEAR(places.contacts[0].normal.z(), 1.0, 1e-9);
  EXPECT_NEAR(places.contacts[0].area, 20.0 * 14.0, 1e-9);
  EXPECT_EQ(places.contacts[0].faces, 280U);
  EXPECT_GT(places.contacts[0].normal_uncertainty, 0.5);

  // Thin layers of three labels, again and again.
  MadeVolume layers({12, 7, 3});
  for (Label k = 0; k < 3; ++k) {
    layers.fill(k + 1, [&](const Vector3& p) { return static_cast<Label>(p.x()) % 3 == k; });
  }
  const Fabric fabric = measured(layers);
  ASSERT_EQ(fabric.contacts.size(), 3U);
  for (const FabricContact& contact : fabric.contacts) {
    EXPECT_TRUE(contact.is_contact);
    EXPECT_NEAR(std::abs(contact.normal.x()), 1.0, 1e-9);
    EXPECT_NEAR(contact.area, 21.0 * (contact.second - contact.first == 1 ? 4.0 : 3.0), 1e-9);
  }
}

// All lines through such a wall meet it at the same place within a voxel: it may be tilted unseen.
TEST_F(FabricOfAFile, KnowsTheNormalOfAFlatWallToAStepOfAVoxel) {
  for (const int height : {2, 8}) {
    MadeVolume made({8, height, 11});
    made.fill(1, [&](const Vector3& p) { return p.x() < 4.0; });
    made.fill(2, [&](const Vector3& p) { return p.x() > 4.0; });
    write("labels.nrrd", test::nrrd(made,
                                    "space dimension: 3\nspace directions: (.6,.8,0) (-.8,.6,0) "
                                    "(0,0,1)\nspace origin: (1e5,-3e5,7)\n"));
    const Fabric fabric = measured("labels.nrrd");
    ASSERT_EQ(fabric.contacts.size(), 1U);
    EXPECT_LT((fabric.contacts[0].normal - Vector3(0.6, 0.8, 0.0)).norm(), 1e-9);
    // Between two rows of faces no tilt shows. Between eight a step of a voxel, 7 degrees, would.
    EXPECT_GT(fabric.contacts[0].normal_uncertainty, 0.5);
    EXPECT_LT(fabric.contacts[0].normal_uncertainty, 8.0);
  }
}

// Along an axis or a diagonal of the lattice all lines around a contact are cut at the same gap.
TEST_F(FabricOfAFile, TellsTheUncertaintyOfLinesInStep) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> shift(-0.5, 0.5);
  for (const Vector3& n : {Vector3::UnitX().eval(), Vector3(1.0, 1.0, 0.0).normalized()}) {
    double squares = 0.0;
    constexpr int runs = 16;
    for (int k = 0; k < runs; ++k) {
      const Vector3 middle =
          Vector3(28.0, 28.0, 28.0) + Vector3(shift(random), shift(random), shift(random));
      const TwoBalls balls{middle - 11.0 * n, middle + 10.0 * n, 11.9, 11.0};
      const Fabric fabric = measured(balls.voxels({56, 56, 56}, Vector3::Ones()));
      ASSERT_EQ(fabric.contacts.size(), 1U);
      const double error = fabric.contacts[0].area - balls.area();
      squares += std::pow(error / fabric.contacts[0].area_uncertainty, 2);
    }
    // A standard uncertainty: the mean is 1. Without the lines' step it is 5 to 9.
    EXPECT_LT(squares / runs, 2.0) << n.transpose();
    EXPECT_GT(squares / runs, 0.3) << n.transpose();
  }
}

TEST_F(FabricOfAFile, HasNormalsOfLongVoxels) {
  const Vector3 spacing(1.0, 1.0, 2.5);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> errors;
  for (int k = 0; k < 15; ++k) {
    Vector3 n = Vector3(normal(random), normal(random), 0.0).normalized();
    n = (n + Vector3::UnitZ()).normalized();  // where the voxels turn the plane of the middles most
    const Vector3 middle(32.2, 31.8, 32.5);
    const TwoBalls balls{middle - 12.0 * n, middle + 12.0 * n, 13.2, 13.0};
    const Fabric fabric = measured(balls.voxels({64, 64, 26}, spacing), "1 1 2.5");
    ASSERT_EQ(fabric.contacts.size(), 1U);
    errors.push_back(angle_between(fabric.contacts[0].normal, balls.normal()));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[7], 2.0);
}

TEST_F(FabricOfAFile, CountsContactsOfAChain) {
  const Fabric fabric = measured(chain());
  ASSERT_EQ(fabric.grains.size(), 4U);
  const std::vector<Label> labels = {3, 5, 7, 12};
  const std::vector<std::size_t> contacts = {2, 1, 1, 2};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(fabric.grains[k].label, labels[k]);
    EXPECT_EQ(fabric.grains[k].contacts, contacts[k]) << labels[k];
    EXPECT_EQ(fabric.grains[k].at_border, labels[k] == 7);
  }
  EXPECT_EQ(fabric.whole_grains, 3U);
  EXPECT_NEAR(fabric.coordination, 5.0 / 3.0, 1e-12);
  EXPECT_EQ(fabric.contact_count, 3U);
  EXPECT_NEAR(fabric.tensor.trace(), 1.0, 1e-12);
  EXPECT_GT(fabric.tensor(0, 0), 0.9);
  for (const FabricContact& contact : fabric.contacts) {
    EXPECT_GT(contact.normal.dot(contact.branch), 0.0);
    EXPECT_EQ(contact.at_border, fabric.grains[contact.second].label == 7);
  }
  // Directions spread evenly have no anisotropy.
  EXPECT_NEAR(anisotropy_of(Eigen::Matrix3d::Identity() / 3.0), 0.0, 1e-12);
}

TEST_F(FabricOfAFile, ChangesNothingWithOtherNumbersOrAxes) {
  const MadeVolume made = chain();
  const Fabric fabric = measured(made);
  // Other numbers in another order.
  const std::map<std::uint32_t, std::uint32_t> numbers = {
      {0, 0}, {7, 1}, {3, 900}, {12, 4}, {5, 2}};
  MadeVolume renumbered = made;
  for (std::uint32_t& label : renumbered.labels) label = numbers.at(label);
  const Fabric other = measured(renumbered);
  // Axes in another order, one mirrored.
  MadeVolume turned({made.counts[1], made.counts[2], made.counts[0]});
  for (int z = 0; z < made.counts[2]; ++z) {
    for (int y = 0; y < made.counts[1]; ++y) {
      for (int x = 0; x < made.counts[0]; ++x) {
        turned.at(made.counts[1] - 1 - y, z, x) = MadeVolume(made).at(x, y, z);
      }
    }
  }
  const Fabric swapped = measured(turned);
  ASSERT_EQ(other.contacts.size(), fabric.contacts.size());
  ASSERT_EQ(swapped.contacts.size(), fabric.contacts.size());
  for (std::size_t k = 0; k < fabric.contacts.size(); ++k) {
    const FabricContact& one = fabric.contacts[k];
    const Label a = fabric.grains[one.first].label;
    const Label b = fabric.grains[one.second].label;
    const auto same = std::find_if(other.contacts.begin(), other.contacts.end(),
                                   [&](const FabricContact& contact) {
                                     const Label first = other.grains[contact.first].label;
                                     const Label second = other.grains[contact.second].label;
                                     return (first == numbers.at(a) && second == numbers.at(b)) ||
                                            (first == numbers.at(b) && second == numbers.at(a));
                                   });
    ASSERT_NE(same, other.contacts.end());
    const double side = other.grains[same->first].label == numbers.at(a) ? 1.0 : -1.0;
    EXPECT_EQ(same->raw_area, one.raw_area);
    EXPECT_NEAR(same->area, one.area, 1e-9 * one.area);
    EXPECT_LT((side * same->normal - one.normal).norm(), 1e-9);
    const FabricContact& turn = swapped.contacts[k];
    EXPECT_NEAR(turn.area, one.area, 1e-9 * one.area);
    EXPECT_NEAR(turn.area_uncertainty, one.area_uncertainty, 1e-9 * one.area);
    EXPECT_NEAR(turn.normal_uncertainty, one.normal_uncertainty, 1e-6);
    const Vector3 back(turn.normal[2], -turn.normal[0], turn.normal[1]);
    EXPECT_LT((back - one.normal).norm(), 1e-9);
    const Vector3 place(turn.centre[2], made.counts[1] - 1 - turn.centre[0], turn.centre[1]);
    EXPECT_LT((place - one.centre).norm(), 1e-9);
  }
}

/// Blurs along each axis by a Gaussian.
std::vector<double> blurred(const MadeVolume& made, double deviation) {
  std::vector<double> values(made.labels.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = made.labels[k] == 0 ? 0.0 : 1.0;
  const std::array<int, 3> strides = {1, made.counts[0], made.counts[0] * made.counts[1]};
  const int reach = static_cast<int>(4.0 * deviation) + 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> before = values;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const int place = static_cast<int>(k) / strides[axis] % made.counts[axis];
      double sum = 0.0;
      double weights = 0.0;
      for (int step = -reach; step <= reach; ++step) {
        const int there = std::clamp(place + step, 0, made.counts[axis] - 1);
        const double weight = std::exp(-0.5 * step * step / (deviation * deviation));
        sum += weight * before[k + static_cast<std::size_t>((there - place) * strides[axis])];
        weights += weight;
      }
      values[k] = sum / weights;
    }
  }
  return values;
}

TEST_F(FabricOfAFile, MeasuresTheBlurOfTheScanItself) {
  const TwoBalls balls{{22, 24, 24}, {44.5, 25, 25}, 12.0, 12.0};
  const MadeVolume made = balls.voxels({68, 48, 48}, Vector3::Ones());
  write_labels(made, "labels.nrrd", "2 2 2");
  std::mt19937 random(22);
  std::normal_distribution<double> noise(0.0, 3.0);
  for (const double deviation : {0.8, 1.4}) {
    for (const bool is_dark : {false, true}) {
      MadeVolume grey = made;
      const std::vector<double> values = blurred(made, deviation);
      for (std::size_t k = 0; k < values.size(); ++k) {
        const double value = 60.0 + 100.0 * (is_dark ? 1.0 - values[k] : values[k]);
        grey.labels[k] = static_cast<std::uint32_t>(std::lround(value + noise(random)));
      }
      write_labels(grey, "scan.nrrd", "2 2 2");
      const Fabric fabric = measured("labels.nrrd", "scan.nrrd");
      ASSERT_TRUE(fabric.blur);
      // Balls are set at the middles of voxels, which are no part of this blur.
      EXPECT_NEAR(*fabric.blur, 2.0 * deviation, 0.2 * deviation) << is_dark;
      const Fabric exact = measured("labels.nrrd");
      EXPECT_FALSE(exact.blur);
      EXPECT_LT(fabric.contacts[0].area, exact.contacts[0].area);
    }
  }
}

/// Two equal ellipsoids of revolution about the line through their centres, in grey values. Their
/// contact is a disc.
struct TwoEllipsoids {
  double along;   ///< semi-axis
  double across;  ///< semi-axis
  double overlap = 2.0;

  double area() const {
    const double to_disc = 1.0 - 0.5 * overlap / along;
    return pi * across * across * (1.0 - to_disc * to_disc);
  }
  MadeVolume scan(double deviation, std::mt19937& random) const {
    const Vector3 n = Vector3(5.0, 2.0, 1.0).normalized();
    MadeVolume made({84, 60, 52});
    const Vector3 middle(41.7, 29.6, 25.8);
    for (const double side : {-1.0, 1.0}) {
      const Vector3 centre = middle + side * (along - 0.5 * overlap) * n;
      made.fill(1, [&](const Vector3& p) {
        const double t = (p - centre).dot(n);
        const double rest = (p - centre).squaredNorm() - t * t;
        return t * t / (along * along) + rest / (across * across) < 1.0;
      });
    }
    const std::vector<double> values = blurred(made, deviation);
    std::normal_distribution<double> noise(0.0, 4.0);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double grey = std::clamp(60.0 + 120.0 * values[k] + noise(random), 0.0, 255.0);
      made.labels[k] = static_cast<std::uint32_t>(std::lround(grey));
    }
    return made;
  }
};

// Tips have a small ring, flat sides a wide one, at the same volume.
TEST_F(FabricOfAFile, MeasuresTipsAndFlatSidesInASegmentedScan) {
  std::mt19937 random(41);
  for (const TwoEllipsoids& grains :
       {TwoEllipsoids{18.0, 13.0}, TwoEllipsoids{15.0, 15.0}, TwoEllipsoids{12.0, 17.0}}) {
    write_labels(grains.scan(0.8, random), "scan.nrrd");
    const auto scan = open_volume(path("scan.nrrd"));
    const Segmentation found = segment(*scan, {}, Execution(2));
    FabricOptions options;
    options.scan = scan.get();
    const Fabric fabric = measure_fabric(*found.labels, options, Execution(1));
    ASSERT_EQ(fabric.contacts.size(), 1U) << grains.along;
    const FabricContact& contact = fabric.contacts[0];
    EXPECT_NEAR(contact.area / grains.area(), 1.0, 0.15) << grains.along;
    EXPECT_EQ(fabric.contact_area, contact.area);
    EXPECT_GT(fabric.contact_area_uncertainty, contact.area_uncertainty);
  }
}

TEST_F(FabricOfAFile, RefusesWhatHasNoContacts) {
  const auto refused = [&](const std::string& labels, const std::string& scan = "") {
    return test::refusal(ErrorCode::InvalidInput, [&] { measured(labels, scan); });
  };
  write_labels(MadeVolume({5, 5, 5}), "none.nrrd");
  EXPECT_TRUE(holds(refused("none.nrrd"), "no label except the background, 0"));
  MadeVolume one({5, 5, 5});
  one.fill_ball(8, {2, 2, 2}, 1.5);
  write_labels(one, "one.nrrd");
  EXPECT_TRUE(holds(refused("one.nrrd"), "one label, 8"));
  write_labels(chain(), "chain.nrrd");
  write_labels(MadeVolume({64, 30, 29}), "other.nrrd");
  EXPECT_TRUE(holds(refused("chain.nrrd", "other.nrrd"), "64 x 30 x 29"));
  write_labels(chain(), "wide.nrrd", "1 1 1.01");
  EXPECT_TRUE(holds(refused("chain.nrrd", "wide.nrrd"), "those of the scan 1 x 1 x 1.01 mm. "));
  write_labels(MadeVolume({64, 30, 30}), "flat.nrrd");
  EXPECT_TRUE(holds(refused("chain.nrrd", "flat.nrrd"), "do not differ"));
  one.fill_ball(9, {2, 2, 4}, 1.2);
  write_labels(one, "small.nrrd");
  EXPECT_TRUE(holds(refused("small.nrrd", "small.nrrd"), "Leave the scan out"));
  write("floats.nrrd",
        "NRRD0004\ntype: float\ndimension: 3\nencoding: ascii\nsizes: 2 1 1\n\n1.5 2\n");
  EXPECT_ERROR(measured("floats.nrrd"), InputOutput);
}

TEST_F(FabricOfAFile, CountsWithAnotherBackgroundAndCanBeStopped) {
  MadeVolume made = chain();
  const Fabric before = measured(made);
  for (std::uint32_t& label : made.labels) label = label == 0 ? 50 : label;
  write_labels(made);
  const Fabric fabric = measured("labels.nrrd", "", 50.0);
  EXPECT_EQ(contacts_csv(fabric), contacts_csv(before));
  EXPECT_EQ(contacts_csv(measured("labels.nrrd", "", 50.0, 3)), contacts_csv(before));
  const auto volume = open_volume(path("labels.nrrd"));
  test::expect_to_be_stopped(
      [&](const Execution& execution) {
        measure_fabric(*volume, {50.0, nullptr}, execution);
      },
      "Finding contacts", 20);
}

TEST_F(FabricOfAFile, WritesWhatItMeasured) {
  const Fabric fabric = measured(chain());
  const auto contacts = test::csv_rows(contacts_csv(fabric));
  const auto grains = test::csv_rows(fabric_grains_csv(fabric));
  ASSERT_EQ(contacts.size(), fabric.contacts.size());
  ASSERT_EQ(grains.size(), 4U);
  // The table alone gives the tensor, the coordination and the sums.
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  std::map<std::string, double> count;
  std::map<std::string, double> sum;
  double all = 0.0;
  double raw = 0.0;
  double faces = 0.0;
  for (const auto& row : contacts) {
    const auto number = [&](const char* name) { return std::stod(row.at(name)); };
    EXPECT_EQ(row.at("unit"), "mm");
    EXPECT_EQ(row.at("contact"), number("area") > 0.0 ? "1" : "0");
    faces += number("faces");
    raw += number("raw_area");
    if (row.at("contact") != "1") continue;
    const Vector3 n(number("normal_x"), number("normal_y"), number("normal_z"));
    EXPECT_NEAR(n.norm(), 1.0, 1e-12);
    tensor += n * n.transpose();
    all += number("area");
    for (const char* end : {"first", "second"}) {
      count[row.at(end)] += 1.0;
      sum[row.at(end)] += number("area");
    }
  }
  tensor /= static_cast<double>(fabric.contact_count);
  EXPECT_LT((tensor - fabric.tensor).norm(), 1e-12);
  // Every face between two labels, counted plainly.
  MadeVolume made = chain();
  double plain = 0.0;
  std::map<std::uint32_t, double> voxels;
  for (int z = 0; z < 30; ++z) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 64; ++x) {
        const std::uint32_t here = made.at(x, y, z);
        ++voxels[here];
        for (const auto& [u, v, w] : {std::array{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
          if (x + u > 63 || y + v > 29 || z + w > 29) continue;
          const std::uint32_t there = made.at(x + u, y + v, z + w);
          if (here != 0 && there != 0 && here != there) ++plain;
        }
      }
    }
  }
  EXPECT_EQ(faces, plain);
  for (const auto& row : grains) {
    EXPECT_EQ(std::stod(row.at("contacts")), count[row.at("label")]);
    EXPECT_NEAR(std::stod(row.at("contact_area")), sum[row.at("label")], 1e-9);
    EXPECT_EQ(std::stod(row.at("voxels")),
              voxels[static_cast<std::uint32_t>(std::stoul(row.at("label")))]);
    EXPECT_EQ(row.at("at_border"), row.at("label") == "7" ? "1" : "0");
  }
  // The page's numbers.
  const std::string page = fabric_html(fabric, {"labels.nrrd", ""});
  const test::Rows coordination = test::table_named(page, "contacts of a grain");
  ASSERT_EQ(coordination.size(), 2U);
  EXPECT_EQ(coordination[1], (std::vector<std::string>{"grains", "0", "1", "2"}));
  const test::Rows tensors = test::table_named(page, "fabric tensor of the normals");
  ASSERT_EQ(tensors.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_EQ(tensors[static_cast<std::size_t>(i) + 1][static_cast<std::size_t>(j) + 1],
                format_number(without_rounding(tensor(i, j), 1.0), 4));
    }
  }
  Fabric flat = fabric;
  flat.tensor = Eigen::Vector3d(1.0, 1.7e-18, -2e-17).asDiagonal();
  const test::Rows round =
      test::table_named(fabric_html(flat, {"", ""}), "fabric tensor of the normals");
  EXPECT_EQ(round[2][2], "0");
  for (const std::size_t row : {2U, 3U}) EXPECT_EQ(round[row][4], "0") << "principal value";
  const test::Rows areas = test::table_named(page, "projected area of the contacts");
  ASSERT_EQ(areas.size(), 3U);
  EXPECT_EQ(areas[1].back(), format_number(all, 4));
  EXPECT_EQ(areas[2].back(), format_number(raw, 4));
  EXPECT_NEAR(fabric.contact_area, all, 1e-9 * all);
  EXPECT_TRUE(holds(page, "Projected area of the contacts " + format_number(all, 4) +
                              " mm^2, standard uncertainty " +
                              format_number(fabric.contact_area_uncertainty, 4) +
                              " mm^2; of all pairs"));
  // All three normals lie within ten degrees of x, so the first or the last sector has them.
  EXPECT_TRUE(holds(page, "outer circle: "));
}

TEST_F(FabricOfAFile, SumsUpItsContacts) {
  const Fabric fabric = measured(chain());
  Eigen::Matrix3d branches = Eigen::Matrix3d::Zero();
  double squares = 0.0;
  double rings = 0.0;
  std::size_t contacts = 0;
  std::vector<std::size_t> touching(fabric.grains.size(), 0);
  for (const FabricContact& contact : fabric.contacts) {
    ++touching[contact.first];
    ++touching[contact.second];
    if (!contact.is_contact) continue;
    ++contacts;
    const Vector3 along = contact.branch / contact.branch.norm();
    branches += along * along.transpose();
    squares += contact.area_uncertainty * contact.area_uncertainty;
    rings += contact.raw_area - contact.area;
  }
  ASSERT_GT(contacts, 1U);
  EXPECT_LT((fabric.branch_tensor - branches / static_cast<double>(contacts)).norm(), 1e-12);
  // Six hundredths of all rings err together.
  EXPECT_NEAR(fabric.contact_area_uncertainty, std::sqrt(squares + 0.0036 * rings * rings), 1e-9);
  for (std::size_t k = 0; k < touching.size(); ++k) {
    EXPECT_EQ(fabric.grains[k].touching, touching[k]) << k;
  }
}

/// Three grains, two contacts and a pair with a gap, whose numbers are all different.
Fabric numbered_fabric() {
  Fabric fabric;
  fabric.geometry.axes *= 0.5;
  fabric.geometry.unit = "mm";
  fabric.names = {{8, "quartz"}};
  for (int k = 0; k < 3; ++k) {
    FabricGrain grain;
    const double number = 100.0 * (k + 1);
    grain.label = static_cast<Label>(3 + 5 * k);
    grain.voxels = static_cast<std::uint64_t>(number) + 1;
    grain.volume = number + 2.0;
    grain.centre = Vector3(number + 3.0, number + 4.0, number + 5.0);
    grain.touching = static_cast<std::size_t>(number) + 6;
    grain.contacts = static_cast<std::size_t>(k) + 1;
    grain.contact_area = number + 8.0;
    grain.at_border = k == 2;
    fabric.grains.push_back(grain);
  }
  for (int k = 0; k < 3; ++k) {
    FabricContact contact;
    const double number = 10.0 * (k + 1);
    contact.first = k == 1 ? 1 : 0;
    contact.second = k == 0 ? 1 : 2;
    contact.is_contact = k < 2;
    contact.faces = static_cast<std::size_t>(number) + 1;
    contact.raw_area = number + 0.2;
    contact.area = k < 2 ? number + 0.3 : -0.3;
    contact.area_uncertainty = number + 0.4;
    contact.centre = Vector3(number + 0.5, number + 0.6, number + 0.7);
    contact.centre_uncertainty = number + 0.8;
    contact.normal = Vector3(0.9962, 0.0872, 0.0);  // 5 degrees from x
    contact.normal_uncertainty = number + 0.9;
    contact.branch = number * Vector3(-0.05, 1.0, 0.0);  // 93 degrees
    contact.at_border = k == 1;
    fabric.contacts.push_back(contact);
  }
  fabric.contact_count = 2;
  fabric.whole_grains = 2;
  fabric.coordination = 1.5;
  fabric.contact_area = 30.6;
  fabric.contact_area_uncertainty = 2.25;
  fabric.blur = 0.4;
  const Eigen::Matrix3d turn = test::random_rotation(3);
  fabric.tensor = turn * Vector3(0.3, 0.6, 0.1).asDiagonal() * turn.transpose();
  fabric.branch_tensor = turn * Vector3(0.2, 0.1, 0.7).asDiagonal() * turn.transpose();
  return fabric;
}

TEST(FabricNumbers, StandUnderTheirNamesInTheTables) {
  const Fabric fabric = numbered_fabric();
  const auto expect = [](const test::CsvRow& row, const std::map<std::string, double>& numbers) {
    for (const auto& [name, number] : numbers) {
      EXPECT_EQ(std::stod(row.at(name)), number) << name;
    }
  };
  const auto contacts = test::csv_rows(contacts_csv(fabric));
  ASSERT_EQ(contacts.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const FabricContact& c = fabric.contacts[k];
    EXPECT_EQ(contacts[k].size(), 20U);
    expect(contacts[k], {{"first", k == 1 ? 8 : 3},
                         {"second", k == 0 ? 8 : 13},
                         {"contact", k < 2 ? 1 : 0},
                         {"faces", static_cast<double>(c.faces)},
                         {"raw_area", c.raw_area},
                         {"area", c.area},
                         {"area_uncertainty", c.area_uncertainty},
                         {"x", c.centre.x()},
                         {"y", c.centre.y()},
                         {"z", c.centre.z()},
                         {"centre_uncertainty", c.centre_uncertainty},
                         {"normal_x", c.normal.x()},
                         {"normal_y", c.normal.y()},
                         {"normal_z", c.normal.z()},
                         {"normal_uncertainty", c.normal_uncertainty},
                         {"branch_x", c.branch.x()},
                         {"branch_y", c.branch.y()},
                         {"branch_z", c.branch.z()},
                         {"at_border", k == 1 ? 1 : 0}});
    EXPECT_EQ(contacts[k].at("unit"), "mm");
  }
  const auto grains = test::csv_rows(fabric_grains_csv(fabric));
  ASSERT_EQ(grains.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const FabricGrain& g = fabric.grains[k];
    EXPECT_EQ(grains[k].size(), 12U);
    EXPECT_EQ(grains[k].at("name"), k == 1 ? "quartz" : "");
    expect(grains[k], {{"label", g.label},
                       {"voxels", static_cast<double>(g.voxels)},
                       {"volume", g.volume},
                       {"x", g.centre.x()},
                       {"y", g.centre.y()},
                       {"z", g.centre.z()},
                       {"touching", static_cast<double>(g.touching)},
                       {"contacts", static_cast<double>(g.contacts)},
                       {"contact_area", g.contact_area},
                       {"at_border", k == 2 ? 1 : 0}});
  }
}

TEST(FabricNumbers, StandUnderTheirNamesInTheDiscs) {
  const Fabric fabric = numbered_fabric();
  const std::string text = contacts_vtp(fabric);
  const auto numbers_of = [&](const std::string& name) {
    const std::string array = test::between(text, "Name=\"" + name + "\"", "</DataArray>").at(0);
    std::istringstream stream(array.substr(array.find('>') + 1));
    std::vector<double> numbers;
    for (double number = 0.0; stream >> number;) numbers.push_back(number);
    return numbers;
  };
  // The disc of 16 corners and its middle, for each of the two contacts.
  for (std::size_t k = 0; k < 2; ++k) {
    const FabricContact& c = fabric.contacts[k];
    const std::pair<const char*, double> expected[] = {{"area", c.area},
                                                       {"area_uncertainty", c.area_uncertainty},
                                                       {"first", k == 1 ? 8 : 3},
                                                       {"second", k == 0 ? 8 : 13}};
    for (const auto& [name, number] : expected) {
      ASSERT_EQ(numbers_of(name).size(), 34U) << name;
      EXPECT_EQ(numbers_of(name)[17 * k + 5], number) << name;
    }
    for (const auto& [name, vector] : {std::pair("normal", c.normal), {"branch", c.branch}}) {
      const std::vector<double> numbers = numbers_of(name);
      ASSERT_EQ(numbers.size(), 3U * 34U) << name;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(numbers[3 * (17 * k + 5) + i], vector[static_cast<Eigen::Index>(i)]) << name;
      }
    }
  }
}

TEST(FabricNumbers, StandUnderTheirNamesInThePageAndTheLog) {
  const Fabric fabric = numbered_fabric();
  const std::vector<std::string> lines = fabric_lines(fabric);
  EXPECT_EQ(lines[0], "3 grains, 1 of them at the border");
  EXPECT_EQ(lines[1], "3 pairs of labels touch: 2 in contact, 1 with a narrow gap");
  EXPECT_EQ(
      lines[2],
      "Projected area of the contacts 30.6 mm^2, standard uncertainty 2.25 mm^2; of all pairs "
      "as the labels have it 60.6 mm^2");
  EXPECT_EQ(lines[3], "Mean coordination of the grains not at the border: 1.5");
  EXPECT_EQ(lines.back(), "Blur of the scan: a standard deviation of 0.4 mm, 0.8 voxels");
  const std::string page = fabric_html(fabric, {"labels.nrrd", ""});
  // Principal values, the largest first, with their directions.
  const Eigen::Matrix3d turn = test::random_rotation(3);
  const std::tuple<std::string, std::array<std::string, 3>, std::array<int, 3>> tensors[] = {
      {"fabric tensor of the normals", {"0.6", "0.3", "0.1"}, {1, 0, 2}},
      {"of the branch vectors", {"0.7", "0.2", "0.1"}, {2, 0, 1}}};
  for (const auto& [name, values, axes] : tensors) {
    const test::Rows rows = test::table_named(page, name);
    ASSERT_EQ(rows.size(), 4U) << name;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(rows[k + 1][4], values[k]) << name;
      std::string text = rows[k + 1][5];
      std::replace(text.begin(), text.end(), ',', ' ');
      std::istringstream stream(text);
      Vector3 direction;
      for (double& component : direction) stream >> component;
      // Three digits are shown.
      EXPECT_NEAR(std::abs(direction.dot(turn.col(axes[k]))), 1.0, 3e-3) << name;
    }
  }
  // Normals are in the first sector of the planes of x and y and of x and z, branch vectors in that
  // behind y, and beside x; along the third axis of a plane a direction is at 0.
  EXPECT_EQ(test::count_of(page, "L 270 150 A 120 120 "), 5U);
  EXPECT_EQ(test::count_of(page, "L 150 30 A 120 120 "), 1U);
  const test::Rows areas = test::table_named(page, "projected area of the contacts");
  EXPECT_EQ(areas[1], (std::vector<std::string>{"corrected", "10.3", "10.3", "15.3", "20.3", "20.3",
                                                "30.6"}));
  EXPECT_EQ(areas[2], (std::vector<std::string>{"as the labels have it", "10.2", "10.2", "15.2",
                                                "20.2", "20.2", "30.4"}));
}

TEST_F(FabricOfAFile, DrawsADiscForEachContact) {
  const Fabric fabric = measured(chain());
  write("contacts.vtp", contacts_vtp(fabric));
  const IndexedMesh discs = read_mesh(path("contacts.vtp"));
  double area = 0.0;
  for (const FabricContact& contact : fabric.contacts) area += contact.area;
  ASSERT_EQ(discs.triangles.size(), 16U * fabric.contact_count);
  double drawn = 0.0;
  for (std::size_t t = 0; t < discs.triangles.size(); ++t) {
    const auto& corners = discs.triangles[t];
    const auto point = [&](std::size_t k) {
      return discs.points[static_cast<std::size_t>(corners[k])];
    };
    const Vector3 across = 0.5 * (point(1) - point(0)).cross(point(2) - point(0));
    drawn += across.norm();
    EXPECT_GT(across.normalized().dot(fabric.contacts[t / 16].normal), 1.0 - 1e-9);
  }
  EXPECT_NEAR(drawn, area, 1e-9 * area);
  EXPECT_EQ(test::between(contacts_vtp(fabric), "Name=\"", "\"").size(), 9U);
}

}  // namespace
}  // namespace wscvt
