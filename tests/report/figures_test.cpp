// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/expect_error.h"
#include "support/holds.h"
#include "support/page_tables.h"
#include "support/test_shapes.h"
#include "wscvt/report/mesh_view.h"
#include "wscvt/report/page_figures.h"

namespace wscvt {
namespace {

using test::count_of;
using test::holds;

/// The numbers in a text from a place on, as many as there are before another sign.
std::vector<double> numbers_after(const std::string& text, const std::string& before,
                                  const std::string& ignored) {
  std::string rest = text.substr(text.find(before) + before.size());
  for (char& c : rest) {
    if (ignored.find(c) != std::string::npos) c = ' ';
  }
  std::istringstream stream(rest);
  stream.imbue(std::locale::classic());
  return {std::istream_iterator<double>(stream), {}};
}

/// Values of an attribute of all elements of one kind; not a number where one lacks it.
std::vector<double> attributes(const std::string& svg, const std::string& element,
                               const std::string& name) {
  std::vector<double> values;
  for (std::size_t at = svg.find("<" + element); at != std::string::npos;
       at = svg.find("<" + element, at + 1)) {
    const std::string one = svg.substr(at, svg.find('>', at) - at);
    const std::string opening = " " + name + "=\"";
    values.push_back(one.find(opening) == std::string::npos
                         ? std::nan("")
                         : numbers_after(one, opening, "").front());
  }
  return values;
}

/// The places of the text's beginnings in a drawing, along its axes.
struct TextPlace {
  double x = std::nan("");
  double y = std::nan("");
};
TextPlace place_of(const std::string& svg, const std::string& text) {
  const std::size_t end = svg.find(">" + text + "</text>");
  if (end == std::string::npos) return {};
  const std::string element = svg.substr(svg.rfind("<text", end));
  return {numbers_after(element, " x=\"", "").front(), numbers_after(element, " y=\"", "").front()};
}

Vector3 mean_of(const std::vector<Vector3>& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

TEST(Figures, TicksAreRoundAndWithin) {
  EXPECT_EQ(round_ticks(0.0, 3.0, 8), (std::vector<double>{0, 0.5, 1, 1.5, 2, 2.5, 3}));
  EXPECT_EQ(round_ticks(1.0, 3.0, 8).size(), 5U);  // 1, 1.5, ...
  EXPECT_EQ(round_ticks(0.0, 180.0, 8), (std::vector<double>{0, 50, 100, 150}));
  EXPECT_TRUE(round_ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(round_ticks(1.0, 1.0 + 4e-16, 5).empty());
  for (const double size : {1e-7, 0.03, 4.7, 123.0, 1e9}) {
    const std::vector<double> ticks = round_ticks(-size, size, 6);
    EXPECT_GE(ticks.size(), 2U) << size;
    EXPECT_LE(ticks.size(), 6U) << size;
    for (const double tick : ticks) EXPECT_LE(std::abs(tick), size * (1 + 1e-8));
  }
}

TEST(Figures, HistogramsShowEverySeriesByItsName) {
  const Histogram histogram{0.0, 3.0, {1, 2, 1}};
  const std::string svg = histogram_figure(
      "length", "edges", {{"<one>", "#111111", histogram}, {"two", "#222222", histogram}});
  EXPECT_EQ(count_of(svg, "<path"), 2U);
  EXPECT_TRUE(holds(svg, "&lt;one&gt;"));
  EXPECT_TRUE(holds(svg, ">two<"));
  EXPECT_TRUE(holds(svg, "fraction of the edges, %"));
  EXPECT_FALSE(holds(svg, "nan"));
  // Each name has a patch of its colour beside it, which without a width would not be seen.
  for (const char* side : {"width", "height"}) {
    const std::vector<double> sides = attributes(svg, "rect", side);
    EXPECT_EQ(sides.size(), 2U);
    for (const double length : sides) EXPECT_GT(length, 0.0) << side;
  }
  // Nothing counted is nothing drawn, not a division by it.
  EXPECT_FALSE(holds(histogram_figure("x", "y", {{"none", "#111111", {0.0, 1.0, {0, 0}}}}), "nan"));
}

TEST(Figures, CurvesLeaveOutWhatHasNoLogarithm) {
  const std::string svg =
      logarithmic_figure("N", "error", {{200, 1.0}, {100, 2.0}, {50, INFINITY}, {400, 0.0}}, 1.5);
  EXPECT_EQ(count_of(svg, "<circle"), 2U);
  EXPECT_TRUE(holds(svg, "target 1.5"));
  EXPECT_FALSE(holds(svg, "nan"));
  EXPECT_FALSE(holds(svg, "inf"));
  EXPECT_EQ(count_of(logarithmic_figure("N", "error", {{100, 2.0}}, 2.0), "<circle"), 1U);
  EXPECT_EQ(count_of(logarithmic_figure("N", "error", {}, 2.0), "<circle"), 0U);
}

TEST(Figures, CurvesOverManyDecadesHaveFewTicks) {
  for (const double smallest : {0.1, 1e-3, 1e-6, 1e-15, 1e-200}) {
    const std::string svg = logarithmic_figure("N", "error", {{100, 1.0}, {1000, smallest}}, 0.0);
    // Two titles, at most twelve numbers an axis, and enough to read it by.
    EXPECT_LE(count_of(svg, "<text"), 2U + 2U * 12U) << smallest;
    EXPECT_GE(count_of(svg, "text-anchor=\"end\""), 3U) << smallest;
  }
}

TEST(Figures, BarsAreSharesOfWhatEachCounted) {
  const Histogram few{-1.0, 3.0, {1, 2, 5, 0}};
  const Histogram many{-1.0, 3.0, {100, 200, 500, 0}};
  const std::string svg =
      histogram_figure("x", "y", {{"few", "#111111", few}, {"many", "#222222", many}});
  const std::vector<double> path = numbers_after(svg, " d=\"M", "LMZ");
  ASSERT_EQ(path.size(), 2U * (1 + 2 * 4 + 1));
  EXPECT_EQ(numbers_after(svg.substr(svg.rfind("<path")), " d=\"M", "LMZ"), path);
  // Each bar two points: as wide as the others, as high as its share; the numbers have six digits.
  const double bottom = path[1];
  const double width = path[4] - path[2];
  const double height = bottom - path[3];  // of one in the eight
  EXPECT_GT(width, 50.0);
  EXPECT_GT(height, 0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const double* const bar = path.data() + 2 + 4 * k;
    EXPECT_NEAR(bar[0], path[0] + width * static_cast<double>(k), 2e-3);
    EXPECT_NEAR(bar[2], path[0] + width * static_cast<double>(k + 1), 2e-3);
    EXPECT_NEAR(bottom - bar[1], height * static_cast<double>(few.counts[k]), 5e-3);
    EXPECT_EQ(bar[1], bar[3]);
  }
  // The numbers of the axes stand where the bars have these values: 62.5 % is the largest.
  EXPECT_NEAR(place_of(svg, "0").x, path[0] + width, 2e-3);
  EXPECT_NEAR(place_of(svg, "2").x, path[0] + 3 * width, 2e-3);
  EXPECT_NEAR(place_of(svg, "20").y - place_of(svg, "60").y, height * 8 * 0.4, 5e-3);
  // The bars fill the frame from side to side.
  const std::vector<double> sides = attributes(svg, "line", "x2");
  EXPECT_NEAR(path[0], *std::min_element(sides.begin(), sides.end()), 2e-3);
  EXPECT_NEAR(path[path.size() - 2], *std::max_element(sides.begin(), sides.end()), 2e-3);
  const double highest = *std::min_element(path.begin() + 2, path.end());
  EXPECT_GT(highest, 34.0);  // below the names, and the frame is used
  EXPECT_LT(highest, 34.0 + 0.1 * (bottom - highest));
}

TEST(Figures, CurvesAreStraightWhereTheyArePowers) {
  const std::string svg =
      logarithmic_figure("N", "error", {{10000, 0.01}, {100, 1.0}, {1000, 0.1}, {10, 10.0}}, 0.1);
  const std::vector<double> x = attributes(svg, "circle", "cx");
  const std::vector<double> y = attributes(svg, "circle", "cy");
  ASSERT_EQ(x.size(), 4U);
  EXPECT_GT(x[1] - x[0], 50.0);
  EXPECT_GT(y[1] - y[0], 30.0);  // down the page
  for (std::size_t k = 2; k < 4; ++k) {
    EXPECT_NEAR(x[k] - x[k - 1], x[1] - x[0], 5e-3);  // numbers of six digits
    EXPECT_NEAR(y[k] - y[k - 1], y[1] - y[0], 5e-3);
  }
  EXPECT_NEAR(attributes(svg, "line", "y1").back(), y[2], 1e-9);  // the target's line
  EXPECT_NEAR(attributes(svg, "line", "y2").back(), y[2], 1e-9);
  EXPECT_NEAR(place_of(svg, "1000").x, x[2], 5e-3);
  const std::vector<double> path = numbers_after(svg, " d=\"M", "LMZ");
  ASSERT_EQ(path.size(), 8U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(path[2 * k], x[k]);
    EXPECT_EQ(path[2 * k + 1], y[k]);
  }
  // Over two decades there is a number at 1, 2 and 5 times each power of ten.
  const std::string two = logarithmic_figure("N", "error", {{10, 4.0}, {1000, 3.0}}, 0.0);
  const double tenth = 0.5 * (place_of(two, "1000").x - place_of(two, "10").x);
  for (const double value : {20.0, 50.0, 100.0, 200.0, 500.0}) {
    const std::string text = std::to_string(static_cast<int>(value));
    EXPECT_NEAR(place_of(two, text).x, place_of(two, "10").x + tenth * std::log10(value / 10.0),
                5e-3)
        << value;
  }
  // A target that no point comes near to is in the drawing as well: 300 high, its numbers below.
  for (const double level : {1e-5, 1e4}) {
    const std::string far = logarithmic_figure("N", "error", {{10, 1.0}, {100, 0.5}}, level);
    const double line = attributes(far, "line", "y1").back();
    EXPECT_GT(line, 34.0);
    EXPECT_LT(line, 248.0);
    for (const double point : attributes(far, "circle", "cy")) {
      EXPECT_GT(point, 34.0);
      EXPECT_LT(point, 248.0);
    }
  }
}

TEST(Figures, ScaleOfColoursGoesFromBlueInsideToRedOutside) {
  const std::string svg = colour_scale(0.25);
  EXPECT_LT(place_of(svg, "-0.25").x, place_of(svg, "0").x);
  EXPECT_NEAR(place_of(svg, "-0.25").x + place_of(svg, "0.25").x, 2 * place_of(svg, "0").x, 1e-9);
  EXPECT_NEAR(place_of(svg, "-0.25").x, attributes(svg, "rect", "x").front(), 1e-9);
  EXPECT_NEAR(place_of(svg, "0.25").x - place_of(svg, "-0.25").x,
              attributes(svg, "rect", "width").front(), 1e-9);
  EXPECT_EQ(attributes(svg, "stop", "offset"), (std::vector<double>{0.0, 0.5, 1.0}));
  std::size_t at = 0;
  for (const double value : {-1.0, 0.0, 1.0}) {
    const Colour colour = diverging_colour(value);
    const std::string text = "rgb(" + std::to_string(colour[0]) + "," + std::to_string(colour[1]) +
                             "," + std::to_string(colour[2]) + ")";
    at = svg.find(text, at);
    EXPECT_NE(at, std::string::npos) << text;
  }
}

TEST(Figures, DistancesArePositiveOutsideAndAsLargeAsTheyAre) {
  // Facets of a sphere and of a larger one about them: between 0.9 and 1 of what the radii differ.
  const IndexedMesh ball = test::sphere(3);
  const IndexedMesh larger = test::transformed(ball, 1.25 * Eigen::Matrix3d::Identity());
  const auto check = [](const IndexedMesh& shown, const IndexedMesh& reference, double sign) {
    const PageFigures figures =
        page_figures(ShownMesh{reference, "scan"}, {shown, "remesh"}, Execution(1));
    // Beside the scale of the colours, which ends at the usual distance.
    const std::string& scale = figures.pictures.back().content;
    const std::size_t end = scale.rfind("</text>");
    const double usual = std::stod(scale.substr(scale.rfind('>', end) + 1));
    EXPECT_GT(usual, 0.245);
    EXPECT_LT(usual, 0.2501);
    // The histogram ends at 1.5 of it: most stand at two thirds of a side, on their side.
    const std::string& svg = figures.distributions.back().content;
    const std::vector<double> path = numbers_after(svg, " d=\"M", "LMZ");
    const double middle = 0.5 * (path[0] + path[path.size() - 2]);
    const double half = middle - path[0];
    std::size_t highest = 2;
    for (std::size_t k = 2; k + 2 < path.size(); k += 4) {
      if (path[k + 1] < path[highest + 1]) highest = k;
      if (path[k + 1] == path[1]) continue;  // an empty bin
      EXPECT_GT(sign * (path[k] - middle) / half, -0.05);
    }
    EXPECT_GT(sign * (path[highest] - middle) / half, 0.6);
    EXPECT_LT(sign * (path[highest] - middle) / half, 0.7);
  };
  check(larger, ball, 1.0);
  check(ball, larger, -1.0);
  // Where distances differ the scale ends near the largest of them, but for a spike of less than
  // 2 % of the surface.
  IndexedMesh spiked = larger;
  for (Vector3& p : spiked.points) {
    if (p.z() > 0.0) p.z() *= 0.8;
  }
  spiked.points[100] *= 1.4;
  check(spiked, ball, 1.0);
}

TEST(Figures, PartsHaveTheirOwnColours) {
  const IndexedMesh ball = test::sphere(2);
  const auto picture_of = [&](std::vector<std::uint8_t> parts) {
    return page_figures({}, {ball, "parts", std::move(parts)}, Execution(1)).pictures[0].content;
  };
  const std::size_t faces = ball.triangles.size();
  const std::string one = picture_of(std::vector<std::uint8_t>(faces, 3));
  EXPECT_NE(one, picture_of({}));
  EXPECT_NE(one, picture_of(std::vector<std::uint8_t>(faces, 4)));
  for (int k = 0; k < 256; ++k) {
    const Colour colour = part_colour(static_cast<std::uint8_t>(k));
    const Colour next = part_colour(static_cast<std::uint8_t>(k + 1));
    int difference = 0;
    for (std::size_t c = 0; c < 3; ++c) difference += std::abs(colour[c] - next[c]);
    EXPECT_GT(difference, 100) << k;
  }
}

TEST(Figures, ScaleOfDistancesLeavesOutTwoSamplesOfAHundred) {
  const IndexedMesh box = test::box(1.0, 1.0, 1.0);
  const Vector3 middle = mean_of(box.points);
  for (const double side : {1.0, -1.0}) {
    // From 0.004 to 0.4 off the middle of a face, in another order.
    std::vector<Vector3> samples;
    for (int k = 0; k < 100; ++k) {
      const double distance = 0.004 * (k * 37 % 100 + 1);
      samples.push_back(middle + Vector3(0.0, 0.0, 0.5 + side * distance));
    }
    const PageFigures figures =
        page_figures(ShownMesh{box, "scan"}, {box, "remesh"}, Execution(1), samples);
    EXPECT_FALSE(std::isnan(place_of(figures.pictures.back().content, "0.396").x));
    EXPECT_FALSE(std::isnan(place_of(figures.pictures.back().content, "-0.396").x));
  }
}

TEST(Figures, HistogramsOfTrianglesAreThoseOfTheirTitles) {
  // Edges of a sphere of facets are near their mean, a third of the axis from 0 to 3. Ratios are
  // near 1, where the axis from 1 to 3 begins, and angles near 60 degrees of 180.
  const std::vector<Figure> figures =
      page_figures({}, {test::sphere(3), "ball"}, Execution(1)).distributions;
  ASSERT_EQ(figures.size(), 3U);
  const std::vector<std::pair<std::string, double>> expected = {
      {">edge length / mean edge length<", 1.0 / 3.0},
      {">longest / shortest edge of a triangle<", 0.05},
      {">angle, degrees<", 1.0 / 3.0}};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_TRUE(holds(figures[k].content, expected[k].first));
    const std::vector<double> path = numbers_after(figures[k].content, " d=\"M", "LMZ");
    double sum = 0.0;
    double heights = 0.0;
    for (std::size_t at = 2; at + 3 < path.size(); at += 4) {
      const double height = path[1] - path[at + 1];
      sum += height * (0.5 * (path[at] + path[at + 2]) - path[0]);
      heights += height;
    }
    EXPECT_NEAR(sum / heights / (path[path.size() - 2] - path[0]), expected[k].second, 0.05);
  }
}

TEST(Figures, PicturesShowBothMeshesWhole) {
  const IndexedMesh ball = test::sphere(2);
  IndexedMesh larger = ball;
  for (Vector3& p : larger.points) p *= 1.5;
  const auto first_picture = [&](const IndexedMesh& shown) {
    return page_figures(ShownMesh{ball, "scan"}, {shown, "remesh"}, Execution(1))
        .pictures.front()
        .content;
  };
  EXPECT_EQ(first_picture(ball), first_picture(ball));
  EXPECT_NE(first_picture(ball), first_picture(larger)) << "the larger one is cut off";
}

TEST(Figures, StopWhenAskedTo) {
  // Before each picture and histogram, and while the tree of 20,480 faces is made.
  const auto run = [](const IndexedMesh& original) {
    return [&original](const Execution& execution) {
      page_figures(ShownMesh{original, "scan"}, {test::sphere(1), "remesh"}, execution);
    };
  };
  const IndexedMesh small = test::sphere(2);
  test::expect_to_be_stopped(run(small), "Drawing the page", 5);
  const IndexedMesh large = test::sphere(5);
  test::expect_to_be_stopped(run(large), "Measuring distances", 3);
}

}  // namespace
}  // namespace wscvt
