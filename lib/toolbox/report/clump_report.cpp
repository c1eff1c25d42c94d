// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/report/clump_report.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>

#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/figures.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/page_figures.h"

namespace wscvt {

namespace {

double percent_of_radius(const ClumpResult& clump, double length) {
  return 100.0 * length / clump.equivalent_radius;
}

Json json_of(const ContactError& error) {
  return {{"mean_percent", error.mean}, {"scatter_percent", error.scatter}};
}

Json json_of(const SphereMass& mass) {
  return {{"mass", json_of(mass.mass)},
          {"volume_error_percent", mass.error.volume_percent},
          {"centroid_error_percent", mass.error.centroid_percent},
          {"inertia_error_percent", mass.error.inertia_percent}};
}

Json report_of(const ClumpResult& clump, const ReportOrigin& origin) {
  Json stages = Json::array();
  for (const ClumpStage& stage : clump.stages) {
    stages.push_back({{"spheres", stage.spheres},
                      {"rms_percent", percent_of_radius(clump, stage.rms_distance)}});
  }
  Json spheres = Json::array();
  double smallest = std::numeric_limits<double>::infinity();
  for (const Sphere& sphere : clump.spheres) {
    smallest = std::min(smallest, sphere.radius);
    spheres.push_back({sphere.centre.x(), sphere.centre.y(), sphere.centre.z(), sphere.radius});
  }
  return {{"format", "wscvt-clump"},
          {"version", 1},
          {"made_by", made_by()},
          {"source", told(origin.source)},
          {"date", told(origin.date)},
          {"options", wscvt::json_of(clump.options)},
          {"input",
           {{"vertices", clump.input.vertices},
            {"faces", clump.input.faces},
            {"genus", clump.input.genus},
            {"equivalent_radius", clump.equivalent_radius}}},
          {"sphere_count", clump.spheres.size()},
          {"smallest_radius", smallest},
          {"rms_distance", clump.rms_distance},
          {"rms_percent", percent_of_radius(clump, clump.rms_distance)},
          {"largest_distance", clump.largest_distance},
          {"largest_percent", percent_of_radius(clump, clump.largest_distance)},
          {"intersection_over_union", clump.intersection_over_union},
          {"first_contact", json_of(clump.contact)},
          {"grain", wscvt::json_of(mass_properties(clump.scan))},
          {"union", json_of(clump.united)},
          {"sum", json_of(clump.summed)},
          {"stages", std::move(stages)},
          {"spheres", std::move(spheres)},
          {"warnings", clump.warnings}};
}

using Row = std::vector<std::string>;
using Rows = std::vector<Row>;

std::string counted_spheres(const ClumpResult& clump) {
  return format_count(clump.spheres.size(), "sphere");
}

Rows error_rows(const ClumpResult& clump) {
  const auto distance = [&](const std::string& label, double length) {
    return Row{label, format_number(length, 4), format_number(percent_of_radius(clump, length), 3)};
  };
  return {{"error of the clump", "length", "% of equivalent radius"},
          distance("rms distance from scan to clump", clump.rms_distance),
          distance("largest distance from scan to clump", clump.largest_distance)};
}

Rows contact_rows(const ClumpResult& clump) {
  return {{"first contact, % of equivalent radius", "mean error", "scatter"},
          {"clump of " + counted_spheres(clump), format_number(clump.contact.mean, 3),
           format_number(clump.contact.scatter, 3)}};
}

Rows mass_error_rows(const ClumpResult& clump) {
  const auto row = [](const std::string& name, const MassError& error) {
    return Row{name, format_number(error.volume_percent, 3),
               format_number(error.centroid_percent, 3), format_number(error.inertia_percent, 3)};
  };
  return {{"error if taken for the grain's", "volume %", "centroid, % of radius", "inertia %"},
          row("union of the spheres", clump.united.error),
          row("sum over the spheres", clump.summed.error)};
}

/// The number of the sphere on whose surface each face of the clump lies, modulo 256.
std::vector<std::uint8_t> spheres_of_faces(const ClumpResult& clump) {
  std::vector<std::uint8_t> numbers;
  for (const Triangle& t : clump.surface.triangles) {
    const IndexedMesh& mesh = clump.surface;
    const Vector3 middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
    const auto height = [&](const Sphere& sphere) {
      return (middle - sphere.centre).norm() - sphere.radius;
    };
    const auto nearest =
        std::min_element(clump.spheres.begin(), clump.spheres.end(),
                         [&](const Sphere& a, const Sphere& b) { return height(a) < height(b); });
    numbers.push_back(static_cast<std::uint8_t>(nearest - clump.spheres.begin()));
  }
  return numbers;
}

}  // namespace

Json json_of(const ClumpOptions& options) {
  OptionsJson json;
  for_each_clump_option(options, json);
  return json.take();
}

std::vector<std::string> clump_lines(const ClumpResult& clump) {
  std::vector<std::string> lines = {
      "Scan        " + std::to_string(clump.input.vertices) + " vertices, " +
          std::to_string(clump.input.faces) + " faces, equivalent radius " +
          format_number(clump.equivalent_radius),
      "Clump       " + counted_spheres(clump) + ", intersection over union " +
          format_number(clump.intersection_over_union, 4)};
  for (const Rows& rows : {error_rows(clump), contact_rows(clump), mass_error_rows(clump)}) {
    for (std::string& line : aligned_lines(rows)) lines.push_back(std::move(line));
  }
  return lines;
}

std::string clump_json(const ClumpResult& clump, const ReportOrigin& origin) {
  return json_document(report_of(clump, origin));
}

std::string clump_csv(const ClumpResult& clump, const ReportOrigin& origin) {
  return csv_of(report_of(clump, origin));
}

std::string clump_html(const ClumpResult& clump, const ReportOrigin& origin,
                       const Execution& execution) {
  const PageFigures figures =
      page_figures(ShownMesh{clump.repaired_scan, "scan"},
                   {clump.surface, "clump", spheres_of_faces(clump)}, execution);
  const std::string name = std::filesystem::path(origin.source).filename().string();
  HtmlDocument page("Clump" + (name.empty() ? "" : " of " + name) + " with " +
                    counted_spheres(clump));
  page.add_paragraph(origin_sentence(origin));
  for (const std::string& warning : clump.warnings) page.add_warning(warning);
  page.add_figures(figures.pictures);
  page.add_heading("Distances");
  page.add_rows(error_rows(clump));
  page.add_paragraph("Intersection over union of the volumes: " +
                     format_number(clump.intersection_over_union, 4) + ".");
  page.add_heading("First contact");
  page.add_paragraph(
      "Two equal bodies near each other along the line through their centroids, in " +
      std::to_string(ContactHeights::poses * (ContactHeights::poses - 1)) +
      " pairs of poses. The error is the distance of the centroids at first contact, minus the "
      "distance for two scans. If the error is negative, the bodies get too close.");
  page.add_rows(contact_rows(clump));
  page.add_heading("Mass properties");
  page.add_rows(mass_rows({{"grain", mass_properties(clump.scan)},
                           {"union of the spheres", clump.united.mass},
                           {"sum over the spheres", clump.summed.mass}}));
  page.add_rows(mass_error_rows(clump));
  std::vector<CurvePoint> points;
  for (const ClumpStage& stage : clump.stages) {
    points.push_back(
        {static_cast<double>(stage.spheres), percent_of_radius(clump, stage.rms_distance)});
  }
  std::vector<Figure> curves = {figures.distributions.back()};
  if (points.size() > 1) {
    curves.push_back({logarithmic_figure("number of spheres", "rms distance, %", std::move(points),
                                         clump.options.error_measure == ClumpError::Distance
                                             ? clump.options.max_error_percent
                                             : 0.0),
                      "Rms distance from scan to clump, in % of the equivalent radius, for fewer "
                      "spheres."});
  }
  page.add_heading("Distributions");
  page.add_figures(curves);
  page.add_heading("Log");
  page.add_lines(clump_lines(clump));
  page.add_html(figures.views);
  return page.text();
}

void check_clump_report(const std::string& path) {
  check_forms(path, [] { return clump_csv(ClumpResult()); });
}

void write_report(const std::string& path, const ClumpResult& clump, const ReportOrigin& origin,
                  const Execution& execution) {
  write_forms(
      path, {[&] { return clump_html(clump, origin, execution); },
             [&] { return clump_json(clump, origin); }, [&] { return clump_csv(clump, origin); }});
}

}  // namespace wscvt
