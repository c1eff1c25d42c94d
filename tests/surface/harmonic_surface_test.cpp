// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/surface/harmonic_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/random_harmonics.h"
#include "support/seeds.h"
#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/sphere/sphere_sampling.h"
#include "wscvt/surface/radial_surface.h"

namespace wscvt {
namespace {

using test::holds;

TEST(HarmonicSurface, RefusesBadCoefficients) {
  EXPECT_THROW(HarmonicSurface({}), Error);
  EXPECT_THROW(HarmonicSurface({1.0, 2.0, 3.0}), Error);
  EXPECT_THROW(HarmonicSurface({std::numeric_limits<double>::infinity()}), Error);
  EXPECT_EQ(HarmonicSurface({1.0, 0.0, 0.0, 0.0}).degree(), 1);
}

TEST(HarmonicSurface, GradientEnergyFromCoefficients) {
  // Integral of |grad r|^2 = sum l (l + 1) a_lm^2 (Green), exact under the quadrature.
  const std::vector<double> a = test::random_harmonics(14, 8);
  double expected = 0.0;
  for (int l = 0; l <= 14; ++l) {
    for (int m = -l; m <= l; ++m) expected += l * (l + 1.0) * std::pow(a[harmonic_index(l, m)], 2);
  }
  const SurfaceIntegrals integrals = integrate(HarmonicSurface(a), 45, Execution(1));
  EXPECT_NEAR(integrals.gradient_square, expected, 1e-12 * expected);
}

TEST(HarmonicSurface, JetsAgreeWithRadii) {
  const HarmonicSurface surface(test::random_harmonics(10, 4));
  const std::vector<Vector3> u = random_directions(100, test::announced(12));
  const std::vector<double> radii = surface.radii(u, Execution(2));
  const std::vector<RadialJet> jets = surface.jets(u, Derivatives::Second, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(radii[i], jets[i].radius);
}

TEST(HarmonicMap, PositionsOfAnAffineImageOfTheSphere) {
  const Vector3 axes(2.0, 1.5, 1.0);
  const Vector3 shift(0.3, -0.2, 0.1);
  const HarmonicMap ellipsoid = test::affine_map(axes, shift);
  const std::vector<Vector3> u = random_directions(3000, test::announced(14));
  const std::vector<Vector3> points = ellipsoid.positions(u, Execution(2));
  for (std::size_t i = 0; i < u.size(); ++i) {
    // A few dozen operations on numbers of size 1.
    EXPECT_LT((points[i] - shift - axes.cwiseProduct(u[i])).norm(), 1e-13);
  }
  EXPECT_EQ(points, ellipsoid.positions(u, Execution(1)));
  EXPECT_EQ(points[17], ellipsoid.positions({u[17]}, Execution(1)).front());
}

/// A file of the test's own, gone after it.
class HarmonicIo : public testing::Test {
 protected:
  HarmonicIo()
      : path_(testing::TempDir() + "wscvt_harmonic_io_" +
              testing::UnitTest::GetInstance()->current_test_info()->name()) {}
  ~HarmonicIo() override { std::remove(path_.c_str()); }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  /// The sentence of the refusal of reading `text`; empty if it is read or fails otherwise.
  std::string refusal(const std::string& text, bool json) const {
    write(text);
    try {
      if (json) {
        read_harmonics(path_);
      } else {
        read_complex_harmonics(path_);
      }
    } catch (const Error& error) {
      std::string what = error.what();
      if (error.code() == ErrorCode::InvalidInput && what.find(path_) != std::string::npos) {
        return what;
      }
    }
    return "";
  }

  std::string path_;
};

TEST_F(HarmonicIo, ComplexCoefficientsGiveTheSumOfComplexHarmonics) {
  write(
      "  0   0  10.0  0.0\n  1 1  -0.1 -1.5\n1 0 -0.4 0\n1 -1 0.1 -1.5\n\n"
      "2 2 0.3 0.7\n2 1 -0.2 0.25\n2 0 0.6 0.0\n2 -1 0.2 0.25\n2 -2 0.3 -0.7\n");
  const HarmonicSurface surface = read_complex_harmonics(path_);
  EXPECT_EQ(surface.degree(), 2);
  using Complex = std::complex<double>;
  for (const Vector3& u : random_directions(50, test::announced(3))) {
    const double x = u.x();
    const double y = u.y();
    const double z = u.z();
    const Complex xy(x, y);
    // Closed forms of Y_l^m for m > 0; a real field takes twice the real part of those terms.
    const Complex y11 = -std::sqrt(3.0 / (8.0 * pi)) * xy;
    const Complex y21 = -std::sqrt(15.0 / (8.0 * pi)) * z * xy;
    const Complex y22 = std::sqrt(15.0 / (32.0 * pi)) * xy * xy;
    const double expected =
        10.0 * std::sqrt(1.0 / (4.0 * pi)) - 0.4 * std::sqrt(3.0 / (4.0 * pi)) * z +
        0.6 * std::sqrt(5.0 / (16.0 * pi)) * (3.0 * z * z - 1.0) +
        2.0 * (Complex(-0.1, -1.5) * y11 + Complex(-0.2, 0.25) * y21 + Complex(0.3, 0.7) * y22)
                  .real();
    EXPECT_NEAR(surface.radius(u), expected, 1e-14);
  }
}

TEST_F(HarmonicIo, SomeNegativeOrdersMayBeLeftOutAndTheSeriesCut) {
  write("0 0 10 0\n1 0 1 0\n1 1 0.5 0.25\n2 0 1 0\n2 1 0 0\n2 2 0 0\n2 -1 0 0\n");
  EXPECT_EQ(read_complex_harmonics(path_).degree(), 2);
  EXPECT_EQ(read_complex_harmonics(path_, 5).degree(), 2);
  const HarmonicSurface cut = read_complex_harmonics(path_, 1);
  EXPECT_EQ(cut.coefficients(),
            (std::vector<double>{10.0, -0.25 * std::sqrt(2.0), 1.0, 0.5 * std::sqrt(2.0)}));
  EXPECT_ERROR(read_complex_harmonics(path_, -2), InvalidInput);
}

// The same four numbers, of which SHTOOLS's are no complex ones: a body of volume 34.9 became one
// of 0.81.
TEST_F(HarmonicIo, RowsWithoutNegativeOrdersAreOfTwoConventionsAndRefused) {
  const std::string sentence = refusal("0 0 2 0\n1 0 0.3 0\n1 1 0.1 0.2\n", false);
  EXPECT_TRUE(holds(sentence, "SHTOOLS"));
  EXPECT_TRUE(holds(sentence, ".sh"));
  // A comma is of SHTOOLS alone.
  EXPECT_NE(refusal("0, 0, 2, 0\n", false), "");
}

TEST_F(HarmonicIo, RowsOfShtoolsGiveTheSumOfItsHarmonics) {
  for (const char* comma : {",", ""}) {
    const std::string c(comma);
    write("0" + c + " 0" + c + " 2.0" + c + " 0.0\n1" + c + " 0" + c + " 0.3" + c + " 0\n1" + c +
          " 1" + c + " 0.1" + c + " -0.2\n2" + c + " 0" + c + " 0.05" + c + " 0\n2" + c + " 1" + c +
          " 0.07" + c + " 0.02\n2" + c + " 2" + c + " -0.03" + c + " 0.04\n");
    const HarmonicSurface surface = read_shtools(path_);
    EXPECT_EQ(surface.degree(), 2);
    for (const Vector3& u : random_directions(50, test::announced(5))) {
      const double x = u.x();
      const double y = u.y();
      const double z = u.z();
      // Closed forms of its harmonics: the mean of each one's square is 1, and P_11 = sin theta.
      const double expected =
          2.0 + 0.3 * std::sqrt(3.0) * z + std::sqrt(3.0) * (0.1 * x - 0.2 * y) +
          0.05 * std::sqrt(5.0) * 0.5 * (3.0 * z * z - 1.0) +
          std::sqrt(15.0) * z * (0.07 * x + 0.02 * y) +
          0.5 * std::sqrt(15.0) * (-0.03 * (x * x - y * y) + 0.04 * 2.0 * x * y);
      EXPECT_NEAR(surface.radius(u), expected, 1e-14);
    }
    EXPECT_EQ(read_shtools(path_, 0).coefficients().size(), 1U);
    // Written and read again; the digits are those of a product with sqrt(4 pi).
    write_shtools(path_, surface);
    const HarmonicSurface again = read_shtools(path_);
    for (std::size_t k = 0; k < 9; ++k) {
      EXPECT_NEAR(again.coefficients()[k], surface.coefficients()[k], 1e-15) << k;
    }
  }
  for (const auto& [text, word] : std::vector<std::pair<std::string, std::string>>{
           {"0, 0, 1, 0\n1, -1, 0, 0\n", "negative order"},
           {"0, 0, 1, 0\n1, 0, 0, 0\n", "missing"},
           {"0, 0, 1, 0.5\n", "sine"},
           {"0, 0, 1\n", "l, m, C, S"},
           {"0, 0, -1, 0\n", "positive"}}) {
    write(text);
    const std::string sentence =
        test::refusal(ErrorCode::InvalidInput, [&] { read_shtools(path_); });
    EXPECT_TRUE(holds(sentence, word));
  }
}

TEST_F(HarmonicIo, MalformedTextIsRefusedWithItsLine) {
  EXPECT_TRUE(holds(refusal("0 0 10 0\n1 0 x 0\n", false), "line 2"));
  EXPECT_TRUE(holds(refusal("0 0 10\n", false), "line 1"));
  EXPECT_TRUE(holds(refusal("0 0 10 0 7\n", false), "line 1"));
  EXPECT_TRUE(holds(refusal("0 0 10 0\n\n1 2 0 0\n", false), "line 3"));
  EXPECT_TRUE(holds(refusal("0 0 10 0\n-1 0 0 0\n", false), "line 2"));
  // The one number whose absolute value is none.
  EXPECT_TRUE(holds(refusal("5 -2147483648 0 0\n", false), "line 1"));
  EXPECT_TRUE(holds(refusal("100000 0 10 0\n", false), "line 1"));
  EXPECT_TRUE(holds(refusal("0 0 10 0\n0 0 10 0\n", false), "line 2"));
  EXPECT_TRUE(holds(refusal("0 0 nan 0\n", false), "line 1"));
  EXPECT_TRUE(holds(refusal("0 0 10 1\n", false), "complex"));
  EXPECT_TRUE(holds(refusal("0 0 10 0\n1 0 0 0\n1 1 1 2\n1 -1 1 2\n", false), "line 4"));
  EXPECT_TRUE(holds(refusal("0 0 10 0\n1 1 0 0\n1 -1 0 0\n", false), "missing"));
  EXPECT_TRUE(holds(refusal("0 0 -10 0\n", false), "positive"));
  EXPECT_NE(refusal("", false), "");
}

TEST_F(HarmonicIo, JsonGivesTheSameBitsBack) {
  std::vector<double> coefficients = {3.5};
  for (const Vector3& u : random_directions(35, test::announced(4)))
    coefficients.push_back(0.05 * u.x());
  const HarmonicSurface surface(coefficients);
  write_harmonics(path_, surface);
  EXPECT_EQ(std::get<HarmonicSurface>(read_harmonics(path_)).coefficients(), coefficients);
}

TEST_F(HarmonicIo, MalformedJsonIsRefused) {
  const std::string head = R"({"format": "wscvt-harmonics-1",)";
  EXPECT_TRUE(holds(refusal(head + "\n\"degree\": 0 \"coefficients\": [1]}", true), "line 2"));
  EXPECT_TRUE(holds(refusal(R"({"degree": 0, "coefficients": [1]})", true), "format"));
  EXPECT_NE(refusal(R"({"format": "other", "degree": 0, "coefficients": [1]})", true), "");
  EXPECT_NE(refusal(head + R"("degree": 1, "coefficients": [1, 0, 0]})", true), "");
  EXPECT_NE(refusal(head + R"("degree": -1, "coefficients": []})", true), "");
  EXPECT_NE(refusal(head + R"("degree": 0, "coefficients": ["a"]})", true), "");
  EXPECT_NE(refusal(head + R"("degree": 0, "coefficients": [-1]})", true), "");
  for (const std::string degree : {"0.7", "1e30", "true", "\"0\"", "null", "99999999999"}) {
    EXPECT_NE(refusal(head + "\"degree\": " + degree + ", \"coefficients\": [1]}", true), "");
  }
  for (const std::string list : {"[true]", "1", "{\"a\": 1}", "[[1]]", "[null]"}) {
    EXPECT_NE(refusal(head + "\"degree\": 0, \"coefficients\": " + list + "}", true), "");
  }
  EXPECT_NE(refusal("[]", true), "");
  EXPECT_NE(refusal("", true), "");
}

TEST_F(HarmonicIo, MapsComeBackWithTheSameBits) {
  std::array<std::vector<double>, 3> coefficients;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Vector3& u : random_directions(9, test::announced(6 + k))) {
      coefficients[k].push_back(0.05 * u.x());
    }
  }
  coefficients[0][harmonic_index(1, 1)] = -1.0;
  coefficients[1][harmonic_index(1, -1)] = -1.0;
  coefficients[2][harmonic_index(1, 0)] = 1.0;
  write_harmonic_map(path_, HarmonicMap(coefficients));
  EXPECT_EQ(std::get<HarmonicMap>(read_harmonics(path_)).coefficients(), coefficients);
}

TEST_F(HarmonicIo, AFileIsReadByItsEnding) {
  const std::string dat = path_ + ".DAT";
  std::ofstream(dat) << "0 0 10 0\n1 0 0.5 0\n1 1 0 0\n1 -1 0 0\n";
  EXPECT_EQ(std::get<HarmonicSurface>(read_coefficients(dat)).degree(), 1);
  EXPECT_EQ(std::get<HarmonicSurface>(read_coefficients(dat, 0)).degree(), 0);
  std::remove(dat.c_str());
  const std::string sh = path_ + ".sh";
  write_shtools(sh, HarmonicSurface({3.5, 0.0, 0.5, 0.0}));
  EXPECT_EQ(std::get<HarmonicSurface>(read_coefficients(sh)).degree(), 1);
  std::remove(sh.c_str());
  write_harmonics(path_, HarmonicSurface({3.5}));
  EXPECT_EQ(std::get<HarmonicSurface>(read_coefficients(path_)).degree(), 0);
}

TEST_F(HarmonicIo, MalformedMapsAreRefused) {
  const auto refused = [&](const std::string& text, const std::string& reason) {
    std::ofstream(path_) << text;
    try {
      read_harmonics(path_);
    } catch (const Error& error) {
      return error.code() == ErrorCode::InvalidInput &&
             std::string(error.what()).find(reason) != std::string::npos;
    }
    return false;
  };
  const std::string head = R"({"format": "wscvt-harmonics-1", "kind": "map",)";
  EXPECT_TRUE(refused(head + R"("degree": 0, "coefficients": [1]})", "cannot use"));
  EXPECT_TRUE(refused(head + R"("degree": 0, "coefficients": {"x": [1], "y": [1]}})", "z"));
  EXPECT_TRUE(
      refused(head + R"("degree": 1, "coefficients": {"x": [1], "y": [1], "z": [1]}})", "degree"));
  // A point, and a sphere inside out.
  EXPECT_TRUE(refused(head + R"("degree": 0, "coefficients": {"x": [1], "y": [1], "z": [1]}})",
                      "no volume"));
  EXPECT_TRUE(refused(head + R"("degree": 1, "coefficients":
      {"x": [0, 0, 0, 1], "y": [0, -1, 0, 0], "z": [0, 0, 1, 0]}})",
                      "inside out"));
  std::ofstream(path_) << R"({"format": "wscvt-harmonics-1", "kind": "other", "degree": 0})";
  EXPECT_THROW(read_harmonics(path_), Error);
}

TEST_F(HarmonicIo, FilesThatCannotBeOpened) {
  const std::string nowhere = path_ + "/nowhere/file";
  const auto is_io_error = [](const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      return error.code() == ErrorCode::InputOutput;
    }
    return false;
  };
  EXPECT_TRUE(is_io_error([&] { read_harmonics(nowhere); }));
  EXPECT_TRUE(is_io_error([&] { read_complex_harmonics(nowhere); }));
  EXPECT_TRUE(is_io_error([&] { write_harmonics(nowhere, HarmonicSurface({1.0})); }));
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line);
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

// Measured particles whose volume and area others have tabulated. Their data are not ours to copy:
// name a folder with NIST/VCCTL sets in the environment variable WSCVT_PARTICLES_DIR to have them
// tested.
TEST(ReferenceParticles, VolumeAndAreaOfReferenceParticle) {
  const char* folder = std::getenv("WSCVT_PARTICLES_DIR");
  if (folder == nullptr) GTEST_SKIP() << "WSCVT_PARTICLES_DIR names no folder";
  int particles = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.find("-geom.csv") == std::string::npos) continue;
    std::ifstream table(entry.path());
    for (std::string line; std::getline(table, line);) {
      const std::vector<std::string> fields = split(line);
      if (fields.size() < 13 || !std::filesystem::exists(std::filesystem::path(folder) / fields[0]))
        continue;
      SCOPED_TRACE(fields[0]);
      ++particles;
      // Columns 8, 9 and 13: volume, area and the degree at which the table cuts the series.
      const HarmonicSurface surface = read_complex_harmonics(
          (std::filesystem::path(folder) / fields[0]).string(), std::stoi(fields[12]));
      const SurfaceIntegrals integrals = integrate(surface, 200, Execution(1));
      // tests/figures/study measured at most 4e-6 %, the tables' four decimals, and 0.002 %.
      EXPECT_LT(std::abs(relative_error_percent(integrals.volume, std::stod(fields[7]))), 1e-5);
      EXPECT_LT(std::abs(relative_error_percent(integrals.area, std::stod(fields[8]))), 0.003);
    }
  }
  EXPECT_GT(particles, 0) << "no particle of a *-geom.csv table is in " << folder;
}

}  // namespace

}  // namespace wscvt
