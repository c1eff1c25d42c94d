// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/sample/given_sizes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"

namespace wscvt {
namespace {

// Grains drawn by number must come to the curve by mass, in each of its parts.
TEST(GivenSizes, GiveTheCurveByMass) {
  const std::vector<double> diameters = {0.1, 0.2, 0.5, 0.6};
  const std::vector<double> finer = {0, 20, 90, 100};
  const GivenSizes sizes(diameters, finer);
  constexpr int count = 20000;
  std::vector<double> mass(4, 0.0);
  double middle = 0.0;  // below 0.1414, half way to 0.2 over the logarithm
  for (int k = 0; k < count; ++k) {
    const double d = sizes.diameter((k + 0.5) / count);
    EXPECT_GE(d, 0.1);
    EXPECT_LE(d, 0.6);
    for (std::size_t i = 0; i < 4; ++i) {
      if (d < diameters[i]) mass[i] += d * d * d;
    }
    if (d < std::sqrt(0.02)) middle += d * d * d;
  }
  double all = 0.0;
  for (int k = 0; k < count; ++k) all += std::pow(sizes.diameter((k + 0.5) / count), 3.0);
  EXPECT_NEAR(100 * mass[1] / all, 20.0, 0.1);
  EXPECT_NEAR(100 * mass[2] / all, 90.0, 0.3);
  EXPECT_NEAR(100 * middle / all, 10.0, 0.1);
  EXPECT_DOUBLE_EQ(sizes.diameter(0.0), 0.1);
  EXPECT_DOUBLE_EQ(sizes.diameter(1.0), 0.6);
}

TEST(GivenSizes, RefuseOtherCurves) {
  EXPECT_ERROR(GivenSizes({1.0}, {100.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({1.0, 2.0}, {0.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({0.0, 2.0}, {0.0, 100.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({2.0, 1.0}, {0.0, 100.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({1.0, 2.0, 3.0}, {0.0, 120.0, 100.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({1.0, 2.0, 3.0}, {0.0, 60.0, 50.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({1.0, 2.0}, {5.0, 100.0}), InvalidInput);
  EXPECT_ERROR(GivenSizes({1.0, 2.0}, {0.0, 95.0}), InvalidInput);
}

TEST(GivenSizes, AreReadFromATable) {
  const std::string path = ::testing::TempDir() + "/wscvt_given_sizes.csv";
  std::ofstream(path) << "diameter,finer\r\n0.5, 0\r\n\n1,40\n2\t100\n";
  const GivenSizes sizes = read_given_sizes(path);
  EXPECT_DOUBLE_EQ(sizes.diameter(0.0), 0.5);
  EXPECT_DOUBLE_EQ(sizes.diameter(1.0), 2.0);
  std::ofstream(path) << "0.5,0\n1,x\n2,100\n";
  const std::string sentence =
      test::refusal(ErrorCode::InvalidInput, [&] { read_given_sizes(path); });
  EXPECT_TRUE(test::holds(sentence, "Line 2"));
  EXPECT_ERROR(read_given_sizes(path + ".none"), InputOutput);
  std::remove(path.c_str());
}

TEST(GivenSizes, UnderstandOrRefuseHeadingsAndUnits) {
  const std::string path = ::testing::TempDir() + "/wscvt_given_sizes.csv";
  for (const char* text :
       {"sep=;\nsize [mm];finer [%]\n0,5;0\n1;40\n2;100\n",
        "\xEF\xBB\xBFsep=,\r\n0.5,0\r\n2,100\r\n", "d,finer by mass\n[mm],%\n0.5,0\n2,100\n",
        "Sieve (mm)\tPassing (%)\n.5\t0\n2\t100\n"}) {
    std::ofstream(path) << text;
    const GivenSizes sizes = read_given_sizes(path);
    EXPECT_DOUBLE_EQ(sizes.diameter(0.0), 0.5) << text;
    EXPECT_DOUBLE_EQ(sizes.diameter(1.0), 2.0) << text;
  }
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"size,finer\n63 um,0\n2 mm,100\n", "Line 2"},
           {"63 um,0\n0.1,0\n2,100\n", "Line 1"},
           {"0,5;0\n63 um;40\n2;100\n", "Line 2"},
           {"finer [%],size [mm]\n0,0.5\n100,2\n", "percentages first"},
           {"size [mm],retained [%]\n0.5,0\n2,100\n", "retained"},
           {"size [phi],finer [%]\n0.5,0\n2,100\n", "phi"},
           {"size [mm],aperture [um]\n0.5,0\n2,100\n", "length in the second"}}) {
    std::ofstream(path) << text;
    const std::string sentence =
        test::refusal(ErrorCode::InvalidInput, [&] { read_given_sizes(path); });
    EXPECT_TRUE(test::holds(sentence, word)) << text;
  }
  std::remove(path.c_str());
}

}  // namespace
}  // namespace wscvt
