// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/measures/descriptors.h"
#include "wscvt/report/descriptor_report.h"
#include "wscvt/report/report.h"

namespace wscvt {

namespace {

constexpr std::size_t topic_width = 12;

std::string line(const std::string& topic, const std::string& text) {
  std::string result = topic;
  result.resize(std::max(topic_width, result.size() + 1), ' ');
  return result + text;
}

std::vector<std::string> repairs(const MeshCheckReport& input) {
  std::vector<std::string> parts;
  const auto add = [&parts](std::size_t count, const char* one, const char* many,
                            const std::string& what) {
    if (count > 0) parts.push_back(format_count(count, one, many) + " " + what);
  };
  const auto with_area = [](const char* what, double share) {
    return std::string(what) + " (" + format_percent(share) + " of the area)";
  };
  add(input.lost_faces, "face", "faces", "without a finite position removed");
  add(input.welded_vertices, "equal vertex", "equal vertices",
      "merged (within " + format_number(input.weld_tolerance, 3) + ")");
  add(input.unreferenced_vertices, "unused vertex", "unused vertices", "removed");
  add(input.degenerate_faces, "degenerate face", "degenerate faces", "removed");
  add(input.duplicate_faces, "duplicate face", "duplicate faces",
      with_area("removed", input.duplicate_area_fraction));
  add(input.back_to_back_faces, "back-to-back face", "back-to-back faces",
      with_area("removed", input.back_to_back_area_fraction));
  add(input.non_manifold_edges, "non-manifold edge", "non-manifold edges", "separated");
  add(input.flap_faces, "face", "faces",
      with_area("of flaps and internal walls removed there", input.flap_area_fraction));
  add(input.filled_holes, "hole", "holes", "filled");
  add(input.filling_faces, "face", "faces", with_area("put into them", input.filled_area_fraction));
  add(input.reoriented_faces, "face", "faces", "turned outward");
  add(input.split_vertices, "vertex", "vertices", "duplicated where the surface touches itself");
  add(input.sliver_faces, "face", "faces", "of no area kept");
  if (input.input_faces == 0) parts.emplace_back("points triangulated");
  const std::size_t inner = input.inner_components;
  const std::size_t outer = input.components > inner ? input.components - inner - 1 : 0;
  add(inner, "inner surface", "inner surfaces",
      "removed (" + format_percent(input.inner_volume_fraction) + " of the volume)");
  add(outer, "smaller body", "smaller bodies",
      "removed (" + format_percent(input.dropped_volume_fraction) + " of the volume)");
  if (inner + outer > 0) {
    parts.push_back(format_count(input.dropped_faces, "face") + " removed with them");
  }
  return parts;
}

void append_input(const RemeshResult& result, std::vector<std::string>& lines) {
  const MeshCheckReport& input = result.input;
  if (input.input_vertices == 0) {
    lines.push_back(line("Scan", "surface from a formula or coefficients, equivalent radius " +
                                     format_number(input.equivalent_radius, 6)));
    return;
  }
  lines.push_back(line("Scan", format_count(input.input_vertices, "vertex", "vertices") + ", " +
                                   format_count(input.input_faces, "face") +
                                   "; lengths are in its unit"));
  const std::vector<std::string> done = repairs(input);
  lines.push_back(line("Repairs", done.empty() ? "none needed" : listed(done)));
  lines.push_back(line("Repaired", format_count(input.vertices, "vertex", "vertices") + ", " +
                                       format_count(input.faces, "face") + ", closed, genus " +
                                       std::to_string(input.genus) + ", equivalent radius " +
                                       format_number(input.equivalent_radius)));
}

std::string point_text(const Vector3& point) {
  return "(" + format_number(point.x(), 3) + ", " + format_number(point.y(), 3) + ", " +
         format_number(point.z(), 3) + ")";
}

void append_handles(const HandleReport& handles, std::vector<std::string>& lines) {
  // A noisy scan may have a hundred handles. JSON lists all of them.
  constexpr std::size_t most_told = 5;
  const std::vector<CutHandle>& cut = handles.cut;
  if (cut.empty() && handles.kept == 0) return;
  std::string text = format_count(cut.size(), "handle") + " cut and closed";
  for (std::size_t i = 0; i < std::min(cut.size(), most_told); ++i) {
    text += std::string(i == 0 ? ": " : "; ") + "loop of " + format_number(cut[i].length, 3) +
            " at " + point_text(cut[i].place);
  }
  if (cut.size() > most_told) text += "; ...";
  if (handles.kept > 0) {
    text += ", " + std::to_string(handles.kept) + " kept";
    if (handles.next.edges > 0) {
      text += " (the next has a loop of " + format_number(handles.next.length, 3) + " at " +
              point_text(handles.next.place) + ")";
    }
  }
  lines.push_back(line("Handles", text));
}

void append_fit(const AsPublishedReport& report, double radius, std::vector<std::string>& lines) {
  const HarmonicFitReport& fit = report.fit;
  if (fit.rays == 0) return;
  lines.push_back(line("Overhang", format_percent(report.overhang_fraction) +
                                       " of the solid angle behind the outermost surface"));
  std::string text = "SH series of degree " + std::to_string(fit.degree);
  if (fit.degree < fit.requested_degree) {
    text +=
        " (lowered from " + std::to_string(fit.requested_degree) + ": " + label_of(fit.limit) + ")";
  }
  text += ", residual " + format_number(fit.residual, 3);
  if (radius > 0.0) {
    text += " (" + format_number(100.0 * fit.residual / radius, 3) + " % of the equivalent radius)";
  }
  lines.push_back(line("Fit", text));
}

/// Label of the weighting, with alpha for the curvature weighting.
template <class Options>
std::string weighting_text(const Options& options, bool is_curvature) {
  std::string text = label_of(options.weighting);
  if (is_curvature) text += ", alpha " + format_number(options.curvature_alpha, 3);
  return text;
}

void append_method(const OnScanReport& report, const RemeshResult& result,
                   std::vector<std::string>& lines) {
  const auto& options = std::get<OnScanOptions>(result.options.method);
  append_handles(report.handles, lines);
  lines.push_back(
      line("Method",
           "on the scan: centroidal Voronoi cells on the grain's own surface (the paper: on "
           "the sphere)"));
  lines.push_back(
      line("Weighting", weighting_text(options, options.weighting == CellWeighting::Curvature)));
  const ScanNodesReport& nodes = report.nodes;
  lines.push_back(
      line("Nodes", "coarsened on " + format_count(nodes.proxy_vertices, "vertex", "vertices") +
                        ", edge lengths equalized in " +
                        format_count(static_cast<std::size_t>(nodes.equalization_steps), "step")));
  if (nodes.fit_rounds > 0) {
    lines.push_back(line(
        "Fit", format_count(static_cast<std::size_t>(nodes.fit_rounds), "round") + ", " +
                   format_count(static_cast<std::size_t>(nodes.fit_flips), "edge") + " flipped, " +
                   format_count(static_cast<std::size_t>(nodes.relocations), "node") +
                   " relocated; volume corrected by an offset of " +
                   format_number(nodes.volume_offset, 2)));
  }
  lines.push_back(line("Edge ratio", "mean " + format_number(nodes.mean_edge_ratio, 4) +
                                         " (wanted " + format_typed(options.edge_ratio) + ")"));
  lines.push_back(line("Intersections",
                       format_count(nodes.self_intersections, "pair") + " of " +
                           format_count(result.mesh.triangles.size(), "triangle") +
                           (nodes.repaired_intersections > 0
                                ? ", " + std::to_string(nodes.repaired_intersections) + " removed"
                                : std::string())));
}

void append_method(const AsPublishedReport& report, const RemeshResult& result,
                   std::vector<std::string>& lines) {
  const auto& options = std::get<AsPublishedOptions>(result.options.method);
  lines.push_back(line("Method", "as published: Wu, Huang and Lai 2022, cells on the unit sphere"));
  append_fit(report, result.input.equivalent_radius, lines);
  if (options.sampling != Sampling::Weighted) {
    lines.push_back(line("Sampling", label_of(options.sampling) + ", not relaxed"));
    return;
  }
  lines.push_back(
      line("Weighting", weighting_text(options, options.weighting == Weighting::Curvature)));
  const RelaxationReport& relaxation = report.relaxation;
  const auto iterations = static_cast<std::size_t>(std::max(relaxation.iterations, 0));
  std::string text = label_of(relaxation.outcome) + " " + format_count(iterations, "iteration");
  for (auto level = relaxation.coarser_levels.rbegin(); level != relaxation.coarser_levels.rend();
       ++level) {
    text += (level == relaxation.coarser_levels.rbegin() ? " (after " : ", ") +
            std::to_string(level->iterations) + " with " + std::to_string(level->seeds) + " seeds";
  }
  if (!relaxation.coarser_levels.empty()) text += ")";
  if (!relaxation.history.empty()) {
    const RelaxationStep& last = relaxation.history.back();
    text += ", displacement " + format_number(last.displacement, 2) + " h, CV of the cell areas " +
            format_number(last.area_spread, 2);
  }
  lines.push_back(line("Relaxation", text));
}

/// The label of the node placement of either method.
std::string placement_label(const RemeshOptions& options) {
  return std::visit([](const auto& of_method) { return label_of(of_method.placement); },
                    options.method);
}

void append_search(const RemeshResult& result, std::vector<std::string>& lines) {
  if (!result.search) return;
  const ErrorTarget& target = result.options.target;
  std::string text =
      label_of(target.measure) + " error of at most " + format_number(target.percent, 3) + " %: ";
  text += result.search->met ? "met by " : "not met, not even by ";
  text += std::to_string(result.search->node_count) + " nodes. Tried";
  for (const NodeCountTrial& trial : result.search->trials) {
    text += (&trial == &result.search->trials.front() ? " " : ", ") +
            std::to_string(trial.node_count) + ": " +
            (std::isfinite(trial.error) ? format_number(trial.error, 3) + " %" : "not possible");
  }
  lines.push_back(line("Node count", text));
}

void append_distances(const RemeshResult& result, std::vector<std::string>& lines) {
  if (!result.distances) return;
  const auto row = [&](const char* label, double to, double from, double both) {
    return std::vector<std::string>{
        label, format_number(to, 4), format_number(from, 4), format_number(both, 4),
        format_number(100.0 * both / result.input.equivalent_radius, 4)};
  };
  const OneSidedDistance& to = result.distances->to_reference;
  const OneSidedDistance& from = result.distances->from_reference;
  const std::vector<std::vector<std::string>> rows = {
      {"Distance, length", "from remesh", "from scan", "two-sided", "% of equivalent radius"},
      row("  largest", to.maximum, from.maximum, result.distances->largest),
      row("  root mean square", to.root_mean_square, from.root_mean_square,
          result.distances->root_mean_square),
      row("  mean", to.mean, from.mean, std::max(to.mean, from.mean)),
  };
  append_lines(lines, aligned_lines(rows));
}

void append_quality(const RemeshResult& result, std::vector<std::string>& lines) {
  const MeshQuality& a = result.scan_quality;
  const MeshQuality& b = result.quality;
  const auto row = [](const char* label, double before, double after) {
    return std::vector<std::string>{label, format_number(before, 4), format_number(after, 4)};
  };
  const std::vector<std::vector<std::string>> rows = {
      {"Quality", "scan", "remesh"},
      row("  edge length, mean, length", a.edge_length.mean, b.edge_length.mean),
      row("  edge length, deviation, length", a.edge_length.standard_deviation,
          b.edge_length.standard_deviation),
      row("  edge length, CV (deviation / mean)", a.edge_variation, b.edge_variation),
      row("  edge ratio of the triangles, mean", a.edge_ratio.mean, b.edge_ratio.mean),
      row("  edge ratio of the triangles, deviation", a.edge_ratio.standard_deviation,
          b.edge_ratio.standard_deviation),
      row("  edge ratio of the triangles, largest", a.edge_ratio.maximum, b.edge_ratio.maximum),
      row("  smallest angle, degrees", a.smallest_angle, b.smallest_angle),
      row("  smallest angle of the triangles, mean, degrees", a.mean_smallest_angle,
          b.mean_smallest_angle),
      row("  vertices with six neighbours, %", 100.0 * a.valence_six_fraction,
          100.0 * b.valence_six_fraction),
  };
  append_lines(lines, aligned_lines(rows));
}

std::vector<DescriptorComparison> comparison(const RemeshResult& result) {
  return compare_descriptors(list_descriptors(result.scan), list_descriptors(result.remesh));
}

/// The errors of the paper's descriptors, in its order.
std::vector<std::string> descriptor_errors(const RemeshResult& result) {
  constexpr std::array<std::pair<const char*, const char*>, 5> shown = {
      {{"volume", "volume"},
       {"area", "area"},
       {"aspect_ratio_inertia", "aspect ratio"},
       {"sphericity_wadell", "sphericity"},
       {"sdq_invariant", "Sdq"}}};
  const std::vector<DescriptorComparison> rows = comparison(result);
  std::vector<std::string> errors;
  for (const auto& [key, label] : shown) {
    for (const DescriptorComparison& row : rows) {
      if (row.key != key) continue;
      const bool is_reliable =
          row.key != "sdq_invariant" || sdq_clip_sentence("", result.scan).empty();
      errors.push_back(std::string(label) + " " +
                       (is_reliable ? error_text(row.error_percent) : "not reliable"));
    }
  }
  return errors;
}

std::string percent_of_radius(const RemeshResult& result, double length) {
  return format_number(100.0 * length / result.input.equivalent_radius, 3) + " %";
}

}  // namespace

std::vector<Sentence> report_warnings(const RemeshResult& result) {
  std::vector<Sentence> warnings = result.warnings;
  const std::string clipped = sdq_clip_sentence("the scan", result.scan);
  if (!clipped.empty()) warnings.emplace_back(clipped);
  return warnings;
}

std::vector<std::string> result_lines(const RemeshResult& result) {
  std::vector<std::string> lines;
  append_input(result, lines);
  std::visit([&](const auto& report) { append_method(report, result, lines); }, result.method);
  append_search(result, lines);
  lines.push_back(line("Result", format_count(result.mesh.points.size(), "node") + ", " +
                                     format_count(result.mesh.triangles.size(), "face") +
                                     ", placement: " + placement_label(result.options)));
  lines.push_back(line("Distance", "rms " + format_number(result.rms_distance, 3) + " (" +
                                       percent_of_radius(result, result.rms_distance) +
                                       " of the equivalent radius), largest " +
                                       format_number(result.largest_distance, 3) + " (" +
                                       percent_of_radius(result, result.largest_distance) +
                                       "), two-sided"));
  append_distances(result, lines);
  append_quality(result, lines);
  append_lines(lines, table_lines(comparison(result), ComparisonNames()));
  append_lines(lines, aligned_lines(mass_rows({{"scan", mass_properties(result.scan)},
                                               {"remesh", mass_properties(result.remesh)}})));
  return lines;
}

std::vector<std::string> report_lines(const RemeshResult& result) {
  std::vector<std::string> lines = result_lines(result);
  for (const std::string& warning : report_warnings(result))
    lines.push_back(line("Warning", warning));
  return lines;
}

std::string named_warnings(const std::vector<Sentence>& warnings) {
  const std::string& first = warnings.front().text();
  std::size_t end = first.size();
  for (const char* mark : {", ", ": ", ". "}) end = std::min(end, first.find(mark));
  std::string name = first.substr(0, end);
  if (name.back() == '.') name.pop_back();
  if (warnings.size() == 1) return name;
  return name + " and " + std::to_string(warnings.size() - 1) + " more";
}

std::string verdict_line(const RemeshResult& result) {
  const std::vector<std::string> errors = descriptor_errors(result);
  const std::string measured = std::to_string(result.mesh.points.size()) + " nodes, " + errors[0] +
                               ", " + errors[1] + ", rms " +
                               percent_of_radius(result, result.rms_distance) + " of the radius: ";
  return measured +
         (result.warnings.empty() ? "good" : "look at: " + named_warnings(result.warnings));
}

std::vector<std::string> summary_lines(const RemeshResult& result) {
  std::vector<std::string> lines;
  // Of the whole report, what was read, repaired and searched.
  for (const std::string& told : report_lines(result)) {
    const bool is_shown = told.rfind("Scan ", 0) == 0 || told.rfind("Repairs ", 0) == 0 ||
                          told.rfind("Handles ", 0) == 0 || told.rfind("Node count ", 0) == 0;
    if (!is_shown || told.find("none needed") != std::string::npos) continue;
    const std::size_t gap = told.find_first_of(' ', told.rfind("Node", 0) == 0 ? 5 : 0);
    const std::size_t text = told.find_first_not_of(' ', gap);
    lines.push_back(line(told.substr(0, gap), told.substr(text)));
  }
  lines.push_back(
      line("Remesh", std::to_string(result.mesh.points.size()) + " nodes, " +
                         std::to_string(result.mesh.triangles.size()) + " faces, edge ratio " +
                         format_number(result.quality.edge_ratio.mean, 4) + ", smallest angle " +
                         format_number(result.quality.smallest_angle, 3) + " degrees"));
  lines.push_back(line("Errors", listed(descriptor_errors(result))));
  lines.push_back(line("Distance", "rms " + percent_of_radius(result, result.rms_distance) +
                                       ", largest " +
                                       percent_of_radius(result, result.largest_distance) +
                                       " of the equivalent radius " +
                                       format_number(result.input.equivalent_radius)));
  return lines;
}

}  // namespace wscvt
