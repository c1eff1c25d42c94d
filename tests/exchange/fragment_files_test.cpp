// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/fragment_files.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "support/file_folder.h"
#include "support/flat_json.h"
#include "support/holds.h"
#include "support/test_shapes.h"

namespace wscvt {
namespace {

/// Four fragments of a grain with volume 20 and area 50, whose numbers are all different.
Fragments numbered_fragments() {
  Fragments all;
  all.grain.volume = 20.0;
  all.grain.area = 50.0;
  const double volumes[] = {2.0, 4.0, 5.0, 9.0};
  for (int k = 0; k < 4; ++k) {
    Fragment one;
    one.mass.volume = volumes[k];
    one.mass.centroid = Vector3(1.5 + k, -0.25 * k, 7.0 - k);
    one.mass.principal_axes = Eigen::AngleAxisd(0.3 + k, Vector3(1.0, 2.0, -2.0) / 3.0);
    one.surface_area = 11.0 + k;
    one.wall_area = 3.0 + 0.5 * k;
    one.hull_excess_percent = 1.0 + k * k;
    all.list.push_back(one);
  }
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>(0, 1), {0, 2}, {0, 3}, {2, 3}}) {
    CommonWall contact;
    contact.first = a;
    contact.second = b;
    contact.area = 0.5 + static_cast<double>(a + b);
    contact.centre = Vector3(0.125, 2.0, -3.0);
    contact.normal = Vector3(0.0, 0.6, -0.8);
    all.contacts.push_back(contact);
  }
  all.moved_pieces = 3;
  all.moved_percent = 0.25;
  return all;
}

std::vector<double> numbers_from(const std::vector<std::string>& fields, std::size_t first) {
  std::vector<double> numbers;
  for (std::size_t k = first; k < fields.size(); ++k) numbers.push_back(std::stod(fields[k]));
  return numbers;
}

TEST(FragmentTables, HaveEachNumberUnderItsName) {
  const Fragments all = numbered_fragments();
  const auto rows = test::csv_records(fragments_csv(all, {"a.ply", "b.ply", "c.ply", "d.ply"}));
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"fragment", "file", "volume", "x", "y", "z", "qw",
                                               "qx", "qy", "qz", "surface_area", "wall_area",
                                               "hull_excess_percent", "contacts"}));
  const double contacts[] = {3.0, 1.0, 2.0, 2.0};
  for (std::size_t k = 0; k < 4; ++k) {
    const Fragment& one = all.list[k];
    const Vector3& c = one.mass.centroid;
    const Eigen::Quaterniond& q = one.mass.principal_axes;
    EXPECT_EQ(rows[k + 1][0], std::to_string(k + 1));
    EXPECT_EQ(rows[k + 1][1], std::string(1, static_cast<char>('a' + k)) + ".ply");
    EXPECT_EQ(numbers_from(rows[k + 1], 2),
              (std::vector<double>{one.mass.volume, c.x(), c.y(), c.z(), q.w(), q.x(), q.y(), q.z(),
                                   one.surface_area, one.wall_area, one.hull_excess_percent,
                                   contacts[k]}));
  }
  const auto walls = test::csv_records(fragment_contacts_csv(all));
  ASSERT_EQ(walls.size(), 5U);
  EXPECT_EQ(walls[0],
            (std::vector<std::string>{"first", "second", "area", "x", "y", "z", "nx", "ny", "nz"}));
  EXPECT_EQ(numbers_from(walls[2], 0),
            (std::vector<double>{1, 3, 2.5, 0.125, 2, -3, 0, 0.6, -0.8}));
}

TEST(FragmentLines, AreTheSumsOfTheFragments) {
  const Fragments all = numbered_fragments();
  const std::vector<std::string> lines = {
      // Squares from the mean 5: 9, 1, 0, 16.
      "Fragments: 4, volumes 0.4 to 1.8 of their mean (coefficient of variation 0.51), sum 100 % "
      "of "
      "the grain's",
      // Each wall belongs to two: half of 3 + 3.5 + 4 + 4.5.
      "Walls: 4 contacts, area 7.5 (15 % of the grain's surface)",
      // By volume: (1 * 2 + 2 * 4 + 5 * 5 + 10 * 9) / 20.
      "Convex hulls of the fragments: 6.25 % more volume, at most 10 % of a fragment",
      "Cells in several pieces: 3 pieces joined a neighbour, 0.25 % of the grain's volume"};
  EXPECT_EQ(fragment_lines(all), lines);
  Fragments whole = all;
  whole.moved_pieces = 0;
  EXPECT_EQ(fragment_lines(whole).size(), 3U);
}

class FragmentFile : public test::FileFolder {};

// A box a x b x c has (b^2 + c^2) / 12 times its mass about the axis along a.
TEST_F(FragmentFile, HasTheMassOfATurnedBox) {
  const IndexedMesh box = test::transformed(test::box(1.5, 2.5, 4.0), test::random_rotation(8),
                                            Vector3(7.0, -3.0, 11.0));
  const MassProperties mass = mass_properties(describe_shape(box, Execution(1)));
  for (const char* name : {"box.shp", "box.urdf"}) write_fragment(path(name), box, mass, 2650.0);
  const auto after = [&](const char* name, const std::string& word) {
    const std::string text = content(name);
    EXPECT_TRUE(test::holds(text, word));
    std::istringstream numbers(text.substr(text.find(word) + word.size()));
    return std::vector<double>{std::istream_iterator<double>(numbers), {}};
  };
  EXPECT_NEAR(after("box.urdf", "<mass value=\"").at(0), 2650.0 * 15.0, 1e-8);
  EXPECT_NEAR(after("box.shp", "\nvolume ").at(0), 15.0, 1e-12);
  const std::vector<double> moments = after("box.shp", "\nI/m ");
  ASSERT_EQ(moments.size(), 3U);
  EXPECT_NEAR(moments[0], (1.5 * 1.5 + 2.5 * 2.5) / 12.0, 1e-9);
  EXPECT_NEAR(moments[1], (1.5 * 1.5 + 4.0 * 4.0) / 12.0, 1e-9);
  EXPECT_NEAR(moments[2], (2.5 * 2.5 + 4.0 * 4.0) / 12.0, 1e-9);
}

}  // namespace
}  // namespace wscvt
