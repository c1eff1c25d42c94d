// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "toolbox/fabric/fabric_files.h"
#include "toolbox/sample/distribution.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"

namespace wscvt {

namespace {

constexpr std::size_t half_sectors = 18;  ///< of ten degrees, in half a turn
constexpr const char* axis_names = "xyz";

/// Returns how many directions lie in each sector of a plane. Opposite directions are one.
std::array<std::size_t, half_sectors> sectors_of(const std::vector<Vector3>& directions,
                                                 Eigen::Index right, Eigen::Index up) {
  std::array<std::size_t, half_sectors> counts = {};
  for (const Vector3& direction : directions) {
    double angle = portable::atan2(direction[up], direction[right]) / pi;  // of half a turn
    if (angle < 0.0) angle += 1.0;
    const auto sector = static_cast<std::size_t>(angle * half_sectors);
    ++counts[sector % half_sectors];
  }
  return counts;
}

/// Draws sectors whose radius is their count; each is drawn on both sides.
std::string rose_figure(const std::vector<Vector3>& directions, Eigen::Index right,
                        Eigen::Index up) {
  const std::array<std::size_t, half_sectors> counts = sectors_of(directions, right, up);
  const std::size_t most =
      std::max<std::size_t>(1, *std::max_element(counts.begin(), counts.end()));
  constexpr double middle = 150.0;
  constexpr double longest = 120.0;
  const auto number = [](double value) { return format_number(value, 5); };
  const auto point = [&](double radius, double turns) {
    return number(middle + radius * portable::cos(2.0 * pi * turns)) + " " +
           number(middle - radius * portable::sin(2.0 * pi * turns));
  };
  std::string svg =
      "<svg viewBox=\"0 0 300 300\" role=\"img\" font-family=\"sans-serif\" font-size=\"14\">\n";
  for (const double share : {0.5, 1.0}) {
    svg += "<circle cx=\"150\" cy=\"150\" r=\"" + number(share * longest) +
           "\" fill=\"none\" stroke=\"#ccc\"/>\n";
  }
  for (std::size_t k = 0; k < 2 * half_sectors; ++k) {
    const double radius =
        longest * static_cast<double>(counts[k % half_sectors]) / static_cast<double>(most);
    const std::string reach = number(radius);
    const double turn = static_cast<double>(k) / (2.0 * half_sectors);
    svg += "<path d=\"M 150 150 L ";
    svg += point(radius, turn) + " A " + reach + " " + reach + " 0 0 0 ";
    svg += point(radius, turn + 0.5 / half_sectors) +
           " Z\" fill=\"#0a58b4\" stroke=\"#fff\" stroke-width=\"0.5\"/>\n";
  }
  svg += std::string("<text x=\"290\" y=\"155\" text-anchor=\"end\">") + axis_names[right] +
         "</text>\n<text x=\"150\" y=\"20\" text-anchor=\"middle\">" + axis_names[up] +
         "</text>\n<text x=\"150\" y=\"295\" text-anchor=\"middle\">outer circle: " +
         std::to_string(most) + "</text>\n</svg>\n";
  return svg;
}

std::vector<Figure> roses(const std::vector<Vector3>& directions, const std::string& what) {
  std::vector<Figure> figures;
  for (const auto& [right, up] : {std::pair<Eigen::Index, Eigen::Index>{0, 1}, {0, 2}, {1, 2}}) {
    figures.push_back({rose_figure(directions, right, up),
                       what + " seen in the plane of " + axis_names[right] + " and " +
                           axis_names[up] + ", number in sectors of 10 degrees"});
  }
  return figures;
}

std::vector<std::vector<std::string>> tensor_rows(const Eigen::Matrix3d& tensor,
                                                  const std::string& name) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  std::vector<std::vector<std::string>> rows = {
      {name, "x", "y", "z", "principal value", "its direction"}};
  const auto number = [](double value, double scale, int digits) {
    return format_number(without_rounding(value, scale), digits);
  };
  const double largest = tensor.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<std::string> row = {std::string(1, axis_names[k])};
    for (Eigen::Index j = 0; j < 3; ++j) row.push_back(number(tensor(k, j), largest, 4));
    row.push_back(number(solver.eigenvalues()[2 - k], largest, 4));
    const Vector3 direction = solver.eigenvectors().col(2 - k);
    row.push_back(number(direction.x(), 1.0, 3) + ", " + number(direction.y(), 1.0, 3) + ", " +
                  number(direction.z(), 1.0, 3));
    rows.push_back(row);
  }
  return rows;
}

void add_coordination(const Fabric& fabric, HtmlDocument& page) {
  std::vector<std::size_t> counts;
  for (const FabricGrain& grain : fabric.grains) {
    if (grain.at_border) continue;
    if (grain.contacts >= counts.size()) counts.resize(grain.contacts + 1);
    ++counts[grain.contacts];
  }
  page.add_heading("Coordination");
  if (counts.empty()) {
    page.add_paragraph("All grains are at the border of the volume.");
    return;
  }
  std::vector<std::vector<std::string>> rows = {{"contacts of a grain"}, {"grains"}};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    rows[0].push_back(std::to_string(k));
    rows[1].push_back(std::to_string(counts[k]));
  }
  page.add_rows(rows);
  page.add_paragraph("Grains at the border are not counted: some of their contacts are outside.");
}

void add_areas(const Fabric& fabric, HtmlDocument& page) {
  std::vector<double> raw;
  std::vector<double> areas;
  for (const FabricContact& contact : fabric.contacts) {
    if (!contact.is_contact || contact.is_closed) continue;
    raw.push_back(contact.raw_area);
    areas.push_back(contact.area);
  }
  page.add_heading("Areas");
  const std::string& unit = fabric.geometry.unit;
  const std::string square =
      unit.empty() ? "voxel faces or the square of the file's unit" : unit + "^2";
  std::vector<std::vector<std::string>> rows = {
      {"projected area of the contacts", "smallest", "10 %", "50 %", "90 %", "largest", "sum"}};
  for (auto& [name, values] : {std::pair<std::string, std::vector<double>*>{"corrected", &areas},
                               {"as the labels have it", &raw}}) {
    std::sort(values->begin(), values->end());
    std::vector<std::string> row = {name};
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      row.push_back(format_number(quantile(*values, share), 4));
    }
    row.push_back(format_number(std::accumulate(values->begin(), values->end(), 0.0), 4));
    rows.push_back(row);
  }
  page.add_rows(rows);
  page.add_paragraph(
      "In " + square +
      ". Labels touch where grains do not yet: in a ring around each contact the gap is narrower "
      "than a voxel, or than the blur of the scan. The corrected areas are without this ring.");
}

}  // namespace

std::string fabric_html(const Fabric& fabric, const ReportOrigin& origin) {
  HtmlDocument page("Contacts of " + std::to_string(fabric.grains.size()) + " grains");
  page.add_paragraph(origin_sentence(origin));
  page.add_lines(fabric_lines(fabric));
  add_coordination(fabric, page);
  if (fabric.contact_count == fabric.closed_count) return page.text();
  std::vector<Vector3> normals;
  std::vector<Vector3> branches;
  for (const FabricContact& contact : fabric.contacts) {
    if (!contact.is_contact || contact.is_closed) continue;
    normals.push_back(contact.normal);
    branches.push_back(contact.branch);
  }
  page.add_heading("Directions");
  page.add_figures(roses(normals, "Normals"));
  page.add_figures(roses(branches, "Branch vectors"));
  page.add_rows(tensor_rows(fabric.tensor, "fabric tensor of the normals"));
  page.add_rows(tensor_rows(fabric.branch_tensor, "of the branch vectors"));
  page.add_paragraph("Anisotropy: " + format_number(anisotropy_of(fabric.tensor), 4) +
                     " of the normals, " + format_number(anisotropy_of(fabric.branch_tensor), 4) +
                     " of the branch vectors; 0 if all directions are equally frequent.");
  add_areas(fabric, page);
  return page.text();
}

}  // namespace wscvt
