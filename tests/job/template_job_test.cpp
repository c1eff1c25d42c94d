// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/template_job.h"

#include <gtest/gtest.h>

#include <sstream>

#include "support/expect_error.h"

namespace wscvt {
namespace {

std::vector<std::pair<double, double>> points_of(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "equivalent_diameter [length],finer_by_mass [%]\r");
  std::vector<std::pair<double, double>> points;
  char comma = 0;
  for (double d = 0.0, p = 0.0; lines >> d >> comma >> p;) points.emplace_back(d, p);
  return points;
}

// A grain of half the mass of all lies between 50 % and its upper end.
TEST(TemplateFiles, HoldTheSizeCurveByMass) {
  const auto points = points_of(size_curve_csv({2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0}));
  ASSERT_EQ(points.size(), 51U);
  EXPECT_EQ(points.front().second, 0.0);
  EXPECT_EQ(points.back().second, 100.0);
  EXPECT_DOUBLE_EQ(points.front().first, 1.0);
  EXPECT_DOUBLE_EQ(points.back().first, 2.0);
  EXPECT_LT(points[22].first, 1.00001);  // 44 %; the small grains but the first have 7/15
  EXPECT_GT(points[24].first, 1.01);     // 48 %
  for (std::size_t k = 1; k < points.size(); ++k) EXPECT_GT(points[k].first, points[k - 1].first);
  EXPECT_EQ(points_of(size_curve_csv({3.0})).size(), 51U);
  EXPECT_ERROR(size_curve_csv({}), InvalidInput);
}

TEST(TemplateFiles, GiveMercuryTheSameCurveByRadius) {
  const std::string psd = mercury_psd_csv({2.0, 1.0});
  EXPECT_EQ(psd.substr(0, 6), "0.5,0\n");
  EXPECT_NE(psd.find("\n1,1\n"), std::string::npos) << psd;
}

}  // namespace
}  // namespace wscvt
