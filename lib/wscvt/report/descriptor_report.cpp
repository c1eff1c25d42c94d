// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/descriptor_report.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>

#include "wscvt/base/numbers.h"
#include "wscvt/base/text_format.h"
#include "wscvt/report/html_document.h"
#include "wscvt/report/json.h"
#include "wscvt/report/page_figures.h"

namespace wscvt {

namespace {

std::vector<NamedMass> masses(const GrainMeasures& measures) {
  std::vector<NamedMass> bodies;
  if (measures.reference) {
    bodies.push_back(
        {measures.reference->name, mass_properties(measures.reference->descriptors.basic)});
  }
  bodies.push_back({measures.grain.name, mass_properties(measures.grain.descriptors.basic)});
  return bodies;
}

Json report_of(const GrainMeasures& measures, const ReportOrigin& origin) {
  Json report = {{"format", "wscvt-descriptors"},
                 {"version", 2},
                 {"made_by", made_by()},
                 {"date", told(origin.date)},
                 {"grain", measures.grain.name}};
  const std::vector<DescriptorValue> values = list_descriptors(measures.grain.descriptors);
  if (measures.reference) {
    report["reference"] = measures.reference->name;
    report["descriptors"] = json_of(compare_descriptors(measures), {"reference", "value"});
    Json& distances = report["distances"] = Json::object();
    for (const DistanceRow& row : list_distances(measures)) distances[row.key] = row.value;
  } else {
    report["descriptors"] = json_of(values);
  }
  report["descriptor_names"] = json_names_of(values);
  if (measures.resolution) {
    Json& resolved = report["resolution"] = {{"voxel_size", measures.resolution->voxel_size},
                                             {"voxels_across", measures.resolution->voxels_across}};
    for (const ResolvedValue& row : measures.resolution->rows) {
      resolved[row.key] = {{"corrected", row.corrected}, {"low", row.low}, {"high", row.high}};
    }
  }
  const std::vector<NamedMass> bodies = masses(measures);
  report["mass"] = json_of(bodies.back().mass);
  if (measures.reference) {
    report["mass"] = {{"reference", json_of(bodies.front().mass)},
                      {"value", json_of(bodies.back().mass)}};
  }
  report["warnings"] = remarks(measures);
  return report;
}

/// Returns the rows of a log, all or those that a person reads first. The whole log and the files
/// have all.
template <class Row>
std::vector<Row> shown_rows(std::vector<Row> rows, bool all) {
  const auto is_left_out = [](const Row& row) {
    return row.key != "volume" && row.key != "area" && !is_read_first(row.key);
  };
  if (!all) rows.erase(std::remove_if(rows.begin(), rows.end(), is_left_out), rows.end());
  return rows;
}

/// Returns the lines of the grains and of the table.
std::vector<std::string> table_of(const GrainMeasures& measures, bool all) {
  std::vector<std::string> lines = {"Grain       " + grain_line(measures.grain)};
  if (measures.reference) {
    lines.push_back("Reference   " + grain_line(*measures.reference));
    append_lines(
        lines, table_lines(shown_rows(compare_descriptors(measures), all), {"reference", "grain"}));
    return lines;
  }
  const std::vector<DescriptorValue> values =
      shown_rows(list_descriptors(measures.grain.descriptors), all);
  if (!measures.resolution) {
    append_lines(lines, table_lines(values));
    return lines;
  }
  lines.push_back("Resolution  " + resolution_sentence(*measures.resolution));
  Resolution shown = *measures.resolution;
  shown.rows = shown_rows(std::move(shown.rows), all);
  append_lines(lines, table_lines(values, shown));
  return lines;
}

}  // namespace

void append_lines(std::vector<std::string>& lines, std::vector<std::string> more) {
  for (std::string& line : more) lines.push_back(std::move(line));
}

std::vector<DistanceRow> list_distances(const GrainMeasures& measures) {
  if (!measures.distances) return {};
  const OneSidedDistance& to = measures.distances->to_reference;
  const OneSidedDistance& from = measures.distances->from_reference;
  return {
      {"largest_distance", "largest, two-sided", measures.distances->largest},
      {"largest_to_reference", "largest, to the reference", to.maximum},
      {"largest_from_reference", "largest, from the reference", from.maximum},
      {"rms_distance", "root mean square, two-sided", measures.distances->root_mean_square},
      {"rms_to_reference", "root mean square, to the reference", to.root_mean_square},
      {"rms_from_reference", "root mean square, from the reference", from.root_mean_square},
      {"mean_to_reference", "mean, to the reference", to.mean},
      {"mean_from_reference", "mean, from the reference", from.mean},
  };
}

std::string grain_line(const MeasuredGrain& grain) {
  return grain.name + ": " + std::to_string(grain.checked.report.vertices) + " vertices, " +
         std::to_string(grain.checked.report.faces) + " faces, genus " +
         std::to_string(grain.checked.report.genus);
}

std::vector<std::string> distance_lines(const GrainMeasures& measures) {
  if (!measures.distances) return {};
  const double radius = measures.reference->checked.report.equivalent_radius;
  std::vector<std::vector<std::string>> cells = {{"Distance", "length", "% of equivalent radius"}};
  for (const DistanceRow& row : list_distances(measures)) {
    cells.push_back({"  " + row.label, format_number(row.value, 4),
                     format_number(100.0 * row.value / radius, 4)});
  }
  return aligned_lines(cells);
}

std::vector<std::string> descriptor_lines(const GrainMeasures& measures) {
  std::vector<std::string> lines = table_of(measures, true);
  append_lines(lines, distance_lines(measures));
  append_lines(lines, aligned_lines(mass_rows(masses(measures))));
  return lines;
}

std::vector<std::string> summary_lines(const GrainMeasures& measures) {
  std::vector<std::string> lines = table_of(measures, false);
  if (!measures.distances) return lines;
  const double radius = measures.reference->checked.report.equivalent_radius;
  const auto percent = [&](double length) { return format_number(100.0 * length / radius, 3); };
  lines.push_back("Distance    rms " + percent(measures.distances->root_mean_square) +
                  " %, largest " + percent(measures.distances->largest) +
                  " % of the equivalent radius " + format_number(radius));
  return lines;
}

std::string descriptor_json(const GrainMeasures& measures, const ReportOrigin& origin) {
  return json_document(report_of(measures, origin));
}

std::string descriptor_csv(const GrainMeasures& measures, const ReportOrigin& origin) {
  return csv_of(report_of(measures, origin));
}

std::string descriptor_html(const GrainMeasures& measures, const ReportOrigin& origin,
                            const Execution& execution) {
  const MeasuredGrain& grain = measures.grain;
  std::optional<ShownMesh> reference;
  if (measures.reference) {
    reference.emplace(ShownMesh{measures.reference->checked.mesh, measures.reference->name});
  }
  const PageFigures figures = page_figures(reference, {grain.checked.mesh, grain.name}, execution);

  HtmlDocument page("Shape of " + grain.name);
  page.add_paragraph(origin_sentence({"", origin.date}));
  page.add_paragraph(grain_line(grain));
  if (measures.reference) page.add_paragraph("Compared with " + grain_line(*measures.reference));
  for (const std::string& remark : remarks(measures)) page.add_warning(remark);
  page.add_figures(figures.pictures);
  page.add_heading("Descriptors");
  if (measures.reference) {
    page.add_table(compare_descriptors(measures), {measures.reference->name, grain.name});
    page.add_heading("Distances");
    page.add_lines(distance_lines(measures));
  } else if (measures.resolution) {
    page.add_paragraph(resolution_sentence(*measures.resolution));
    page.add_rows(resolution_rows(list_descriptors(grain.descriptors), *measures.resolution));
  } else {
    page.add_table(list_descriptors(grain.descriptors));
  }
  page.add_heading("Mass properties");
  page.add_rows(mass_rows(masses(measures)));
  page.add_heading("Distributions");
  page.add_figures(figures.distributions);
  page.add_html(figures.views);
  return page.text();
}

namespace {

/// Returns the numbers, which have one scale.
std::string numbers_text(std::initializer_list<double> numbers, double scale) {
  std::string text;
  for (const double number : numbers) {
    text += (text.empty() ? "" : ", ") + format_number(without_rounding(number, scale));
  }
  return text;
}

}  // namespace

std::vector<std::vector<std::string>> mass_rows(const std::vector<NamedMass>& bodies) {
  std::vector<std::vector<std::string>> rows = {{"Mass at unit density"},
                                                {"  centroid x, y, z, length"},
                                                {"  inertia about it xx, yy, zz, length^5"},
                                                {"  inertia about it xy, xz, yz, length^5"},
                                                {"  principal moments, length^5"},
                                                {"  principal axes, quaternion w, x, y, z"}};
  for (const NamedMass& body : bodies) {
    const MassProperties& mass = body.mass;
    const Eigen::Matrix3d& tensor = mass.inertia_tensor;
    const Vector3& moments = mass.principal_moments;
    const Eigen::Quaterniond& axes = mass.principal_axes;
    rows[0].push_back(body.name);
    const double radius = equivalent_radius(mass.volume);
    const auto coordinate = [radius](double value) {
      return format_coordinate(without_rounding(value, radius), radius);
    };
    rows[1].push_back(coordinate(mass.centroid.x()) + ", " + coordinate(mass.centroid.y()) + ", " +
                      coordinate(mass.centroid.z()));
    rows[2].push_back(numbers_text({tensor(0, 0), tensor(1, 1), tensor(2, 2)}, moments[2]));
    rows[3].push_back(numbers_text({tensor(0, 1), tensor(0, 2), tensor(1, 2)}, moments[2]));
    rows[4].push_back(numbers_text({moments[0], moments[1], moments[2]}, moments[2]));
    rows[5].push_back(numbers_text({axes.w(), axes.x(), axes.y(), axes.z()}, 1.0));
  }
  return rows;
}

}  // namespace wscvt
