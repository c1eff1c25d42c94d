// SPDX-License-Identifier: GPL-3.0-or-later
// The report as a page: its document, its plots and its pictures.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "support/cancelled_runs.h"
#include "support/expect_error.h"
#include "support/test_shapes.h"
#include "wscvt/base/error.h"
#include "wscvt/base/version.h"
#include "wscvt/remesh.h"
#include "wscvt/report/csv_table.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/mesh_view.h"
#include "wscvt/report/page_figures.h"
#include "wscvt/report/report.h"
#include "wscvt/report/report_file.h"

namespace wscvt {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(HtmlDocument, WritesSignsOut) {
  HtmlDocument page("a < b & \"c\"");
  page.add_paragraph("<script>");
  page.add_rows({{"<th>"}, {"<td>"}});
  page.add_lines({"<pre>"});
  page.add_figures({{"<svg></svg>", "<caption>"}});
  const std::string text = page.text();
  EXPECT_NE(text.find("<title>a &lt; b &amp; &quot;c&quot;</title>"), std::string::npos);
  for (const char* raw : {"<script>", "<caption>"}) {
    EXPECT_EQ(text.find(raw), std::string::npos) << raw;
  }
  EXPECT_EQ(count_of(text, "<svg>"), 1U);
  EXPECT_EQ(count_of(text, "<div"), count_of(text, "</div>"));
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
  EXPECT_NE(svg.find("&lt;one&gt;"), std::string::npos);
  EXPECT_NE(svg.find(">two<"), std::string::npos);
  EXPECT_NE(svg.find("share of the edges, %"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  // Nothing counted is nothing drawn, not a division by it.
  EXPECT_EQ(histogram_figure("x", "y", {{"none", "#111111", {0.0, 1.0, {0, 0}}}}).find("nan"),
            std::string::npos);
}

TEST(Figures, CurvesLeaveOutWhatHasNoLogarithm) {
  const std::string svg =
      logarithmic_figure("N", "error", {{200, 1.0}, {100, 2.0}, {50, INFINITY}, {400, 0.0}}, 1.5);
  EXPECT_EQ(count_of(svg, "<circle"), 2U);
  EXPECT_NE(svg.find("target 1.5"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
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

/// Values of an attribute of all elements of one kind.
std::vector<double> attributes(const std::string& svg, const std::string& element,
                               const std::string& name) {
  std::vector<double> values;
  for (std::size_t at = svg.find("<" + element); at != std::string::npos;
       at = svg.find("<" + element, at + 1)) {
    values.push_back(numbers_after(svg.substr(at), " " + name + "=\"", "").front());
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
        page_figures(ShownMesh{reference, "original"}, {shown, "remesh"}, Execution(1));
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

TEST(Figures, PicturesShowBothMeshesWhole) {
  const IndexedMesh ball = test::sphere(2);
  IndexedMesh larger = ball;
  for (Vector3& p : larger.points) p *= 1.5;
  const auto first_picture = [&](const IndexedMesh& shown) {
    return page_figures(ShownMesh{ball, "original"}, {shown, "remesh"}, Execution(1))
        .pictures.front()
        .content;
  };
  EXPECT_EQ(first_picture(ball), first_picture(ball));
  EXPECT_NE(first_picture(ball), first_picture(larger)) << "the larger one is cut off";
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

TEST(Figures, StopWhenAskedTo) {
  // Before each picture and histogram, and while the tree of 20,480 faces is made.
  const auto run = [](const IndexedMesh& original) {
    return [&original](const Execution& execution) {
      page_figures(ShownMesh{original, "original"}, {test::sphere(1), "remesh"}, execution);
    };
  };
  const IndexedMesh small = test::sphere(2);
  test::expect_to_be_stopped(run(small), "Drawing the page", 5);
  const IndexedMesh large = test::sphere(5);
  test::expect_to_be_stopped(run(large), "Measuring distances", 3);
}

TEST(Picture, PngReadsBackToItsPixels) {
  Picture picture{3, 2, {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}}};
  const std::string file = png_of(picture);
  ASSERT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::string data;
  for (std::size_t at = 8; at < file.size();) {
    const std::uint32_t size = number_at(file, at);
    const std::string type = file.substr(at + 4, 4);
    const std::string checked = file.substr(at + 4, 4 + size);
    EXPECT_EQ(
        number_at(file, at + 8 + size),
        crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size())))
        << type;
    if (type == "IHDR") {
      EXPECT_EQ(number_at(file, at + 8), 3U);
      EXPECT_EQ(number_at(file, at + 12), 2U);
    }
    if (type == "IDAT") data = file.substr(at + 8, size);
    at += 12 + size;
  }
  std::string rows(2 * (1 + 3 * 3), '\0');
  uLongf size = rows.size();
  ASSERT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                       reinterpret_cast<const Bytef*>(data.data()), data.size()),
            Z_OK);
  ASSERT_EQ(size, rows.size());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(static_cast<std::uint8_t>(rows[i / 3 * 10 + 1 + i % 3 * 3 + c]),
                picture.pixels[i][c]);
    }
  }
  EXPECT_EQ(halved({2, 2, {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {12, 1, 1}}}).pixels[0],
            (Colour{6, 0, 0}));
}

TEST(MeshView, SeesTheNearSideOfASphereAndNothingElse) {
  const IndexedMesh sphere = test::sphere(4);
  const MeshView view = view_of({&sphere}, 200);
  const SeenMesh seen = look_at(sphere, view);
  const Vector3 towards = view.right.cross(view.up);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] < 0) continue;
    ++covered;
    EXPECT_GT(seen.points[i].dot(towards), -0.05);
    EXPECT_NEAR(seen.points[i].norm(), 1.0, 0.005);
    const double y = (100.0 - (static_cast<double>(i / 200) + 0.5)) * view.half_size / 100.0;
    EXPECT_NEAR(seen.points[i].dot(view.up), y, 1e-9);
  }
  // A disc of radius 1 in a square of 2 half_size; the facets cut its rim by less than 0.5 %.
  const double share = static_cast<double>(covered) / (200.0 * 200.0);
  EXPECT_NEAR(share, test::pi / (4.0 * view.half_size * view.half_size), 0.01);
}

TEST(MeshView, HoldsMeshesWholeWithAMargin) {
  const IndexedMesh near = test::transformed(test::box(1, 2, 3), test::random_rotation(4));
  const IndexedMesh far = test::transformed(near, Eigen::Matrix3d::Identity(), {5, -7, 4});
  for (const auto& meshes :
       {std::vector<const IndexedMesh*>{&near}, std::vector<const IndexedMesh*>{&far, &near},
        std::vector<const IndexedMesh*>{&near, &far}}) {
    const MeshView view = view_of(meshes, 100);
    EXPECT_NEAR(view.right.norm(), 1.0, 1e-15);
    EXPECT_NEAR(view.up.norm(), 1.0, 1e-15);
    EXPECT_NEAR(view.right.dot(view.up), 0.0, 1e-15);
    EXPECT_EQ(view.right.z(), 0.0);  // z is up
    EXPECT_GT(view.up.z(), 0.5);
    EXPECT_GT(view.right.cross(view.up).z(), 0.0);  // from somewhat above
    double largest = 0.0;
    for (const IndexedMesh* const mesh : meshes) {
      for (const Vector3& p : mesh->points) {
        largest = std::max({largest, std::abs((p - view.centre).dot(view.right)),
                            std::abs((p - view.centre).dot(view.up))});
      }
    }
    EXPECT_NEAR(view.half_size, 1.04 * largest, 1e-12);
  }
}

TEST(MeshView, SeesWhatALineToTheViewerLeavesLast) {
  // Every pixel against every triangle: a ring before, behind and through balls, drawn in either
  // order.
  const auto ball_at = [](const Vector3& place) {
    return test::transformed(test::sphere(1), 0.4 * Eigen::Matrix3d::Identity(), place);
  };
  IndexedMesh mesh = test::transformed(
      test::joined(
          ball_at({1.0, 0.5, -1.0}),
          test::joined(test::torus(1.0, 0.4, 12),
                       test::joined(ball_at({-1.0, 0.5, 1.0}), ball_at({0.2, -1.0, 0.1})))),
      test::random_rotation(7));
  const int pixels = 60;
  const MeshView view = view_of({&mesh}, pixels);
  const Vector3 towards = view.right.cross(view.up);
  const double pixel = 2.0 * view.half_size / pixels;
  for (int order = 0; order < 2; ++order) {
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    const SeenMesh seen = look_at(mesh, view);
    std::size_t hidden = 0;
    for (int row = 0; row < pixels; ++row) {
      for (int column = 0; column < pixels; ++column) {
        const Vector3 line = view.centre + (column + 0.5 - 0.5 * pixels) * pixel * view.right +
                             (0.5 * pixels - row - 0.5) * pixel * view.up;
        std::int32_t face = -1;
        double depth = -1e9;
        double edge = 0.0;
        Vector3 point = Vector3::Zero();
        int sheets = 0;
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
          // The triangle without its depth, and how far inside each of its sides the line is.
          std::array<Vector3, 3> corners;
          std::array<Vector3, 3> flat;
          for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = mesh.points[mesh.triangles[f][k]];
            flat[k] = corners[k] - line;
            flat[k] -= flat[k].dot(towards) * towards;
          }
          double distance = 1e9;
          for (std::size_t k = 0; k < 3; ++k) {
            const Vector3 side = flat[(k + 1) % 3] - flat[k];
            distance = std::min(distance, flat[k].cross(side).dot(towards) / side.norm());
          }
          if (distance < 0.0) continue;  // beside it, or seen from behind
          ++sheets;
          const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
          const Vector3 at = line + normal.dot(corners[0] - line) / normal.dot(towards) * towards;
          if (at.dot(towards) <= depth) continue;
          depth = at.dot(towards);
          face = static_cast<std::int32_t>(f);
          edge = distance / pixel;
          point = at;
        }
        hidden += sheets > 1 ? 1 : 0;
        const std::size_t i = static_cast<std::size_t>(row) * pixels + column;
        ASSERT_EQ(seen.faces[i], face) << row << " " << column;
        EXPECT_LT((seen.points[i] - point).norm(), 1e-12);
        EXPECT_NEAR(seen.edges[i], edge, 1e-10);
      }
    }
    EXPECT_GT(hidden, 50U);
  }
}

TEST(MeshView, IsLitFromAboveTheViewerAndEdgesAreDark) {
  const IndexedMesh sphere = test::sphere(3);
  const MeshView view = view_of({&sphere}, 120);
  const SeenMesh seen = look_at(sphere, view);
  const Picture plain = draw(sphere, seen, view, false, {});
  const Picture edged = draw(sphere, seen, view, true, {});
  const Vector3 light = (view.right.cross(view.up) + 0.6 * view.up - 0.4 * view.right).normalized();
  std::size_t dark = 0;
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] < 0) {
      EXPECT_EQ(plain.pixels[i], (Colour{255, 255, 255}));
      EXPECT_EQ(edged.pixels[i], (Colour{255, 255, 255}));
      continue;
    }
    // 35 % of the grey of 200 all round, the rest from the light; the facets are 0.1 wide.
    const double lit = std::max(0.0, seen.points[i].dot(light));
    EXPECT_NEAR(plain.pixels[i][0], 70.0 + 130.0 * lit, 12.0);
    EXPECT_EQ(plain.pixels[i][0], plain.pixels[i][2]);
    const bool at_edge = seen.edges[i] < 1.1;
    dark += at_edge ? 1 : 0;
    EXPECT_NEAR(edged.pixels[i][1], (at_edge ? 0.35 : 1.0) * plain.pixels[i][1], 1.0);
  }
  EXPECT_GT(dark, 1000U);
}

TEST(MeshView, ColoursComeFromThePointsSeen) {
  const IndexedMesh box = test::box(1, 1, 1);
  const MeshView view = view_of({&box}, 100);
  const SeenMesh seen = look_at(box, view);
  const auto by_height = [](const std::vector<Vector3>& points) {
    std::vector<Colour> colours;
    for (const Vector3& p : points) {
      colours.push_back(p.z() > 0.49999 ? Colour{255, 0, 0} : Colour{0, 0, 255});
    }
    return colours;
  };
  const Picture picture = draw(box, seen, view, false, by_height);
  std::size_t red = 0;
  std::size_t blue = 0;
  for (std::size_t i = 0; i < seen.faces.size(); ++i) {
    if (seen.faces[i] < 0) {
      EXPECT_EQ(picture.pixels[i], (Colour{255, 255, 255}));
      continue;
    }
    // Colours are those of squares of four pixels: away from the rim of the top each is its own.
    if (std::abs(seen.points[i].head<2>().cwiseAbs().maxCoeff() - 0.5) < 0.05 &&
        std::abs(seen.points[i].z() - 0.5) < 0.05) {
      continue;
    }
    (seen.points[i].z() > 0.49999 ? red : blue) += 1;
    EXPECT_EQ(picture.pixels[i][seen.points[i].z() > 0.49999 ? 2 : 0], 0);
  }
  EXPECT_GT(red, 100U);
  EXPECT_GT(blue, red);
  EXPECT_EQ(diverging_colour(0.0)[0], diverging_colour(0.0)[2]);
  EXPECT_GT(diverging_colour(1.0)[0], diverging_colour(1.0)[2]);
  EXPECT_LT(diverging_colour(-2.0)[0], diverging_colour(-2.0)[2]);
}

TEST(Page, OfARemeshHasPicturesHistogramsOptionsAndTheSearch) {
  const IndexedMesh scan = test::transformed(test::sphere(4), Vector3(1.0, 0.8, 0.7).asDiagonal());
  RemeshOptions options;
  options.node_count = 100;
  options.surface.degree = 6;
  options.measures.used_scan = true;
  const RemeshResult shown = remesh(scan, options, Execution(1));
  const std::string page = report_html(shown, {"<sand>.ply", "2026-11-21"}, Execution(1));
  EXPECT_NE(page.find("<title>Remesh of &lt;sand&gt;.ply with 100 nodes"), std::string::npos);
  EXPECT_NE(page.find("Made from &lt;sand&gt;.ply by " + made_by() + " on 2026-11-21."),
            std::string::npos);
  EXPECT_EQ(count_of(page, "<img"), 3U);
  EXPECT_EQ(count_of(page, "<svg"), 5U);  // four histograms and the scale of the colours
  EXPECT_EQ(count_of(page, "</figure>"), 7U);
  // One file: nothing is fetched, and no two parts have one name.
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(count_of(page, " id="), 1U);
  EXPECT_EQ(page.find(">nan"), std::string::npos);
  EXPECT_EQ(page.find("\"nan"), std::string::npos);
  EXPECT_EQ(page.find(">-0<"), std::string::npos);
  EXPECT_NE(page.find("<td>--weighting=radial-distance</td>"), std::string::npos);
  EXPECT_NE(page.find("principal moments"), std::string::npos);
  EXPECT_EQ(page, report_html(shown, {"<sand>.ply", "2026-11-21"}, Execution(2)));

  // Points alone are triangulated; of a formula there is nothing to compare with.
  RemeshOptions points = options;
  points.points = true;
  const RemeshResult cloud = remesh({scan.points, {}}, points, Execution(1));
  EXPECT_EQ(count_of(report_html(cloud, {}, Execution(1)), "<img"), 3U);
  RemeshResult without = shown;
  without.used_scan = {};
  const std::string alone = report_html(without, {}, Execution(1));
  EXPECT_EQ(count_of(alone, "<img"), 1U);
  EXPECT_EQ(count_of(alone, "<svg"), 3U);

  options.method = Method::AsPublished;  // least squares has no error of the volume
  options.target.percent = 3.0;
  options.target.measure = ErrorMeasure::Volume;
  const RemeshResult searched = remesh(scan, options, Execution(1));
  const std::string with_curve = report_html(searched, {}, Execution(1));
  EXPECT_EQ(count_of(with_curve, "<svg"), 6U);
  EXPECT_EQ(count_of(with_curve, "<circle"), searched.search->trials.size());
}

TEST(Page, OfDescriptorsNamesTheGrains) {
  const CheckedMesh checked = check_mesh(test::sphere(3), MeshCheckOptions(), Execution(1));
  GrainMeasures measures;
  measures.grain = {"remesh.ply", checked, DetailedDescriptors()};
  const std::string alone = descriptor_html(measures, {"", "2026-11-21"}, Execution(1));
  EXPECT_EQ(count_of(alone, "<img"), 1U);
  EXPECT_EQ(count_of(alone, "<svg"), 3U);
  EXPECT_NE(alone.find("<title>Shape of remesh.ply<"), std::string::npos);
  EXPECT_NE(alone.find("by " + made_by() + " on 2026-11-21."), std::string::npos);
  measures.reference = {"<b>scan</b>", checked, DetailedDescriptors()};
  measures.distances.emplace();
  const std::string compared = descriptor_html(measures, {}, Execution(1));
  EXPECT_EQ(count_of(compared, "<img"), 3U);
  EXPECT_EQ(count_of(compared, "<svg"), 5U);
  EXPECT_NE(compared.find(">&lt;b&gt;scan&lt;/b&gt;</text>"), std::string::npos);
  EXPECT_EQ(compared.find("<b>"), std::string::npos);
}

TEST(Reports, SayWhatTheyAreOfAndWhenTheyWereMade) {
  const ReportOrigin origin = {"scan.ply", "2026-11-21"};
  RemeshResult result;
  const auto json = nlohmann::json::parse(report_json(result, origin));
  EXPECT_EQ(json.at("source"), "scan.ply");
  EXPECT_EQ(json.at("date"), "2026-11-21");
  EXPECT_EQ(json.at("made_by"), std::string("wscvt ") + version());
  EXPECT_TRUE(nlohmann::json::parse(report_json(result)).at("date").is_null());
  EXPECT_EQ(nlohmann::json::parse(descriptor_json(GrainMeasures(), origin)).at("date"),
            "2026-11-21");
  EXPECT_EQ(origin_sentence(origin), "Made from scan.ply by " + made_by() + " on 2026-11-21.");
  EXPECT_EQ(origin_sentence({}), "Made by " + made_by() + ".");
}

class ReportFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "wscvt_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name = "table.csv") const {
    return (folder_ / name).string();
  }
  std::string content(const std::string& name = "table.csv") const {
    std::ostringstream text;
    text << std::ifstream(path(name), std::ios::binary).rdbuf();
    return text.str();
  }
  void write(const std::string& text) const { std::ofstream(path(), std::ios::binary) << text; }

 private:
  std::filesystem::path folder_;
};

TEST_F(ReportFiles, TableGrowsByARowUnderItsHeader) {
  append_to_table(path(), "a,b\r\n1,2\r\n");
  append_to_table(path(), "a,b\r\n3,\"x\r\ny\"\r\n");
  append_to_table(path(), "a,b\r\n5,6\r\n");
  EXPECT_EQ(content(), "a,b\r\n1,2\r\n3,\"x\r\ny\"\r\n5,6\r\n");
  write("");
  append_to_table(path(), "a,b\r\n1,2\r\n");
  EXPECT_EQ(content(), "a,b\r\n1,2\r\n");
}

TEST_F(ReportFiles, TableSaysWhyItCannotBeWritten) {
  std::filesystem::create_directory(path("folder.csv"));
  std::filesystem::create_symlink(path("one.csv"), path("other.csv"));
  std::filesystem::create_symlink(path("other.csv"), path("one.csv"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"folder.csv", "folder.csv\" is a folder"},
      {"not there/table.csv", "check that the folder is there"},
      {"one.csv", "one.csv\" is a link that leads nowhere"}};
  for (const auto& [name, sentence] : cases) {
    for (const auto& call : {check_table, append_to_table}) {
      try {
        call(path(name), "a,b\r\n3,4\r\n");
        ADD_FAILURE() << "not refused";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InputOutput);
        EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
      }
    }
  }
}

TEST_F(ReportFiles, TableRefusesAnotherHeaderAndLeavesTheFile) {
  for (const std::string other : {"a,c\r\n1,2\r\n", "a,b", "a,b\r\n1,2", "notes\n", "\n"}) {
    write(other);
    for (const auto& call : {check_table, append_to_table}) {
      try {
        call(path(), "a,b\r\n3,4\r\n");
        ADD_FAILURE() << "not refused: " << other;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::InvalidInput);
        EXPECT_NE(std::string(error.what()).find("new file"), std::string::npos);
      }
      EXPECT_EQ(content(), other);
    }
  }
  append_to_table(path("new.csv"), "a,b\r\n3,4\r\n");  // the advice
  EXPECT_EQ(content("new.csv"), "a,b\r\n3,4\r\n");
}

TEST_F(ReportFiles, ManyMayAppendToOneTable) {
  constexpr int writers = 8;
  constexpr int rows = 20;
  std::vector<std::thread> threads;
  for (int k = 0; k < writers; ++k) {
    threads.emplace_back([&] {
      for (int row = 0; row < rows; ++row) append_to_table(path(), "a,b\r\n3,4\r\n");
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(count_of(content(), "a,b\r\n"), 1U);
  EXPECT_EQ(count_of(content(), "3,4\r\n"), static_cast<std::size_t>(writers * rows));
  EXPECT_EQ(content().size(), 5U * (writers * rows + 1));
}

TEST_F(ReportFiles, FollowTheirEndings) {
  const IndexedMesh scan = test::sphere(3);
  RemeshOptions options;
  options.node_count = 50;
  options.surface.degree = 2;
  options.measures.used_scan = true;
  const RemeshResult result = remesh(scan, options, Execution(1));
  const ReportOrigin origin = {"scan.ply", "2026-11-21"};
  for (const std::string name : {"r.html", "r.JSON", "r.csv"}) {
    EXPECT_EQ(shows_scan(path(name)), name == "r.html");
    check_remesh_report(path(name));
    write_report(path(name), result, origin, Execution(1));
  }
  EXPECT_EQ(content("r.html"), report_html(result, origin, Execution(1)));
  for (int time = 1; time <= 2; ++time) {
    if (time == 2) write_report(path("r.csv"), result, origin, Execution(1));
    EXPECT_EQ(content("r.JSON"), report_json(result, origin));
    EXPECT_EQ(count_of(content("r.csv"), "\r\n"), 1U + static_cast<std::size_t>(time));
  }
  // The rows of remeshes of any options stand in one table; those of descriptors in two others.
  EXPECT_ERROR(check_descriptor_report(path("r.csv"), false), InvalidInput);
  const CheckedMesh checked = check_mesh(scan, MeshCheckOptions(), Execution(1));
  GrainMeasures measures;
  measures.grain = {"a", checked, DetailedDescriptors()};
  for (const bool compared : {false, true}) {
    if (compared) {
      measures.reference = {"b", checked, DetailedDescriptors()};
      measures.distances.emplace();
    }
    const std::string name = compared ? "compared.csv" : "alone.csv";
    write_report(path(name), measures, origin, Execution(1));
    check_descriptor_report(path(name), compared);
    EXPECT_ERROR(check_descriptor_report(path(name), !compared), InvalidInput);
  }
  for (const std::string name : {"r.txt", "html", "r", ""}) {
    SCOPED_TRACE(name);
    EXPECT_ERROR(check_remesh_report(path(name)), InvalidInput);
  }
}

}  // namespace
}  // namespace wscvt
