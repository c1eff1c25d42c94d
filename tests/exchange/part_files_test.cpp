// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/exchange/part_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/expect_error.h"
#include "support/file_folder.h"
#include "support/holds.h"
#include "support/test_shapes.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {
namespace {

using test::holds;

/// The numbers of the first attribute of this name.
std::vector<double> attribute_numbers(const std::string& text, const std::string& attribute) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex("[ <]" + attribute + "=\"([^\"]*)\""))) return {};
  std::istringstream words(found[1].str());
  return {std::istream_iterator<double>(words), {}};
}

double attribute_number(const std::string& text, const std::string& attribute) {
  const std::vector<double> numbers = attribute_numbers(text, attribute);
  return numbers.size() == 1 ? numbers[0] : -1e300;
}

class PartFiles : public test::FileFolder {
 protected:
  PartFiles() {
    const Vector3 squares(1.5 * 1.5, 2.5 * 2.5, 4.0 * 4.0);
    // A box a x b x c: V (b^2 + c^2) / 12 about the axis along a.
    const Vector3 moments = volume / 12.0 * (Vector3::Constant(squares.sum()) - squares);
    inertia = turn * moments.asDiagonal() * turn.transpose();
    mass = mass_properties(describe_shape(box, Execution(1)));
  }
  std::string written(const std::string& name) {
    write_parts(path(name), {box, other}, mass, density);
    return content(name);
  }

  const double volume = 1.5 * 2.5 * 4.0;
  const double density = 2650.0;
  const Vector3 middle = Vector3(7.0, -3.0, 11.0);
  const Eigen::Matrix3d turn = test::random_rotation(8);
  const IndexedMesh box = test::transformed(test::box(1.5, 2.5, 4.0), turn, middle);
  const IndexedMesh other = test::moved(test::lumpy(1), 1.0, middle);
  Eigen::Matrix3d inertia;
  MassProperties mass;
};

TEST_F(PartFiles, OfUrdfHaveTheMassAndInertiaOfATurnedBox) {
  const std::string text = written("grain.urdf");
  const double rounding = 1e-9 * density * inertia.norm();
  EXPECT_NEAR(attribute_numbers(text, "mass value").at(0), density * volume,
              1e-9 * density * volume);
  const std::vector<double> at = attribute_numbers(text, "xyz");
  ASSERT_EQ(at.size(), 3U);
  EXPECT_LT((Vector3(at[0], at[1], at[2]) - middle).norm(), 1e-9);
  EXPECT_NEAR(attribute_number(text, "ixx"), density * inertia(0, 0), rounding);
  EXPECT_NEAR(attribute_number(text, "ixy"), density * inertia(0, 1), rounding);
  EXPECT_NEAR(attribute_number(text, "ixz"), density * inertia(0, 2), rounding);
  EXPECT_NEAR(attribute_number(text, "iyy"), density * inertia(1, 1), rounding);
  EXPECT_NEAR(attribute_number(text, "iyz"), density * inertia(1, 2), rounding);
  EXPECT_NEAR(attribute_number(text, "izz"), density * inertia(2, 2), rounding);
  const std::string obj = content("grain_2.obj");
  EXPECT_EQ(obj.rfind("g part_2\nv ", 0), 0U);
  EXPECT_TRUE(holds(obj, "\nf 1 ")) << "each file numbers its own vertices";
}

TEST_F(PartFiles, OfMujocoHaveTheMassAndInertiaOfATurnedBox) {
  const std::string text = written("grain.xml");
  const double rounding = 1e-9 * density * inertia.norm();
  EXPECT_NEAR(attribute_number(text, "mass"), density * volume, 1e-9 * density * volume);
  const std::vector<double> at = attribute_numbers(text, "pos");
  ASSERT_EQ(at.size(), 3U);
  EXPECT_LT((Vector3(at[0], at[1], at[2]) - middle).norm(), 1e-9);
  // MuJoCo's order: xx, yy, zz, xy, xz, yz.
  const std::vector<double> full = attribute_numbers(text, "fullinertia");
  ASSERT_EQ(full.size(), 6U);
  const std::vector<double> by_hand = {inertia(0, 0), inertia(1, 1), inertia(2, 2),
                                       inertia(0, 1), inertia(0, 2), inertia(1, 2)};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(full[k], density * by_hand[k], rounding) << k;
  EXPECT_EQ(attribute_numbers(text, "vertex").size(), 3 * box.points.size());
}

TEST_F(PartFiles, OfObjHaveAGroupPerPart) {
  const std::string text = written("grain.obj");
  const std::size_t second = text.find("g part_2\n");
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(text.find("g part_1\n"), second);
  EXPECT_EQ(read_mesh(path("grain.obj")).triangles, joined({box, other}).triangles)
      << "vertices count on";
  EXPECT_FALSE(holds(text, "g part_3"));
}

TEST_F(PartFiles, KeepSignsOfMarkupInNamesOutOfTheMarkup) {
  const std::string urdf = written("a & \"b\" <c> 'd'.urdf");
  EXPECT_TRUE(holds(urdf, "<mesh filename=\"a &amp; &quot;b&quot; &lt;c&gt; 'd'_2.obj\"/>"));
  EXPECT_TRUE(holds(written("a & \"b\".xml"), "model=\"a &amp; &quot;b&quot;\""));
}

// MuJoCo refuses moments below 1e-14. Moments grow with the square of the unit, and the density
// falls with its cube.
TEST_F(PartFiles, OfASmallGrainWarnOfMujocosLimit) {
  mass.principal_moments = Vector3(1e-18, 2e-18, 3e-18);
  EXPECT_TRUE(inertia_warning("grain.xml", mass, 1.1e4, "the unit").empty());
  EXPECT_TRUE(inertia_warning("grain.urdf", mass, 2000.0, "the unit").empty());
  const std::string told = inertia_warning("grain.xml", mass, 2000.0, "the unit").text();
  EXPECT_TRUE(holds(told, "moment of inertia is 2e-15"));
  EXPECT_TRUE(holds(told, "multiply the unit by 1000, "));
  EXPECT_TRUE(holds(told, "2e-06"));
  // 2e-19 times the square of 1000 is enough.
  mass.principal_moments *= 1e-4;
  const std::string less = inertia_warning("grain.xml", mass, 2000.0, "the unit").text();
  EXPECT_TRUE(holds(less, "multiply the unit by 1000, ")) << less;
}

TEST_F(PartFiles, RefuseOtherEndings) {
  EXPECT_ERROR(check_part_file("parts.stl"), InvalidInput);
  EXPECT_ERROR(write_parts(path("parts.ply"), {box}, mass, density), InvalidInput);
}

}  // namespace
}  // namespace wscvt
