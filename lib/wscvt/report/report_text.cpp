// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>

#include "wscvt/base/text_format.h"
#include "wscvt/measures/descriptor_table.h"
#include "wscvt/nodes/triangle_mending.h"
#include "wscvt/report/mass_table.h"
#include "wscvt/report/report.h"
#include "wscvt/tessellation/space_weights.h"

namespace wscvt {

namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

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
    if (count > 0) parts.push_back(counted(count, one, many) + " " + what);
  };
  const auto with_area = [](const char* what, double share) {
    return std::string(what) + " (" + format_percent(share) + " of the area)";
  };
  add(input.lost_faces, "face", "faces", "without a finite position dropped");
  add(input.welded_vertices, "equal vertex", "equal vertices",
      "merged (within " + format_number(input.weld_tolerance, 3) + ")");
  add(input.unreferenced_vertices, "unused vertex", "unused vertices", "dropped");
  add(input.degenerate_faces, "degenerate face", "degenerate faces", "dropped");
  add(input.duplicate_faces, "duplicate face", "duplicate faces",
      with_area("dropped", input.duplicate_area_share));
  add(input.folded_faces, "folded face", "folded faces",
      with_area("dropped", input.folded_area_share));
  add(input.non_manifold_edges, "non-manifold edge", "non-manifold edges", "taken apart");
  add(input.flap_faces, "face", "faces",
      with_area("of flaps and walls dropped there", input.flap_area_share));
  add(input.filled_holes, "hole", "holes", "filled");
  add(input.filling_faces, "face", "faces", with_area("put into them", input.filled_area_share));
  add(input.reoriented_faces, "face", "faces", "turned outward");
  add(input.split_vertices, "vertex", "vertices", "added where the surface touched itself");
  add(input.sliver_faces, "face", "faces", "of no area kept");
  if (input.input_faces == 0) parts.emplace_back("points triangulated");
  const std::size_t inner = input.inner_components;
  const std::size_t outer = input.components > inner ? input.components - inner - 1 : 0;
  add(inner, "inner surface", "inner surfaces",
      "dropped (" + format_percent(input.inner_volume_share) + " of the volume)");
  add(outer, "smaller body", "smaller bodies",
      "dropped (" + format_percent(input.dropped_volume_share) + " of the volume)");
  if (inner + outer > 0) {
    parts.push_back(counted(input.dropped_faces, "face", "faces") + " dropped with them");
  }
  return parts;
}

void append_input(const RemeshResult& result, std::vector<std::string>& lines) {
  const MeshCheckReport& input = result.input;
  if (input.input_vertices == 0) {
    lines.push_back(line("Input", "surface from a formula or coefficients, equivalent radius " +
                                      format_number(input.equivalent_radius, 6)));
    return;
  }
  lines.push_back(line("Input", counted(input.input_vertices, "vertex", "vertices") + ", " +
                                    counted(input.input_faces, "face", "faces")));
  const std::vector<std::string> done = repairs(input);
  lines.push_back(line("Repairs", done.empty() ? "none needed" : joined(done)));
  lines.push_back(line("Used", counted(input.vertices, "vertex", "vertices") + ", " +
                                   counted(input.faces, "face", "faces") + ", closed, genus " +
                                   std::to_string(input.genus) + ", equivalent radius " +
                                   format_number(input.equivalent_radius)));
  const bool spherical = result.parametrization == Parametrization::Spherical;
  const std::string limit =
      spherical ? "" : " (limit " + format_typed(result.options.surface.fold_limit_percent) + " %)";
  lines.push_back(line("Fold", format_percent(result.folded_share) +
                                   " of the solid angle in sheets beyond the first" + limit));
  lines.push_back(
      line("Map", label_of(result.parametrization) + "; " + format_percent(result.steep_share) +
                      " of the area steeper than " + format_number(steep_flank_angle, 3) +
                      " degrees (limit " + format_percent(steep_share_limit) + ")"));
}

void append_handles(const RemeshResult& result, std::vector<std::string>& lines) {
  // A noisy scan may have a hundred, which JSON lists.
  constexpr std::size_t most_told = 5;
  const std::vector<CutHandle>& cut = result.handles.cut;
  if (cut.empty()) return;
  std::string text = counted(cut.size(), "handle", "handles") + " cut and closed";
  for (std::size_t i = 0; i < std::min(cut.size(), most_told); ++i) {
    const Vector3& place = cut[i].place;
    text += (i == 0 ? ": " : "; ") + format_number(cut[i].length, 3) + " long at (" +
            format_number(place.x(), 3) + ", " + format_number(place.y(), 3) + ", " +
            format_number(place.z(), 3) + ")";
  }
  if (cut.size() > most_told) text += "; ...";
  lines.push_back(line("Handles", text));
}

void append_fit(const RemeshResult& result, std::vector<std::string>& lines) {
  if (result.fit.rays == 0) return;
  const HarmonicFitReport& fit = result.fit;
  std::string text = "spherical harmonics of degree " + std::to_string(fit.degree);
  if (fit.degree < fit.requested_degree) {
    text +=
        " (lowered from " + std::to_string(fit.requested_degree) + ": " + label_of(fit.limit) + ")";
  }
  text += ", residual " + format_number(fit.residual, 3);
  const double radius = result.input.equivalent_radius;
  if (radius > 0.0) {
    text += " (" + format_number(100.0 * fit.residual / radius, 3) + " % of the equivalent radius";
    if (fit.requested_degree == automatic_degree) {
      // Why this degree.
      text += fit.limit == DegreeLimit::None ? "; the lowest degree below the"
                                             : "; " + label_of(fit.limit) + ", but not below the";
      text += " chords' " + format_number(100.0 * fit.chord_error / radius, 3) + " %";
    }
    text += ")";
  }
  lines.push_back(line("Fit", text));
}

void append_meeting(const RemeshResult& result, std::vector<std::string>& lines) {
  if (result.parametrization != Parametrization::Spherical) return;
  const SpaceNodesReport& space = result.space;
  std::string text = counted(space.self_intersections, "pair", "pairs") +
                     " of triangles meet, of " +
                     counted(result.mesh.triangles.size(), "triangle", "triangles");
  if (space.repairs > 0) {
    text += "; repaired by " +
            counted(static_cast<std::size_t>(space.repairs), "relaxation", "relaxations") +
            " with more nodes there";
  }
  if (space.angle_weight > 0.0) {
    text += "; the nodes jammed on the map and stand on one that keeps angles better (weight " +
            format_number(space.angle_weight, 3) + ")";
  }
  if (space.relocated_seeds > 0) {
    text += "; " +
            counted(static_cast<std::size_t>(space.relocated_seeds), "seed was", "seeds were") +
            " taken from where they had crowded";
  }
  lines.push_back(line("Meeting", text));
  if (result.options.placement.kind == NodePlacement::Series) {
    lines.push_back(line("Placement", "on the scan; a spherical map has no fitted series"));
  }
}

void append_mending(const RemeshResult& result, std::vector<std::string>& lines) {
  const SpaceNodesReport& space = result.space;
  const TriangleMendingReport& mending = space.mending;
  const RefinementOptions& refinement = result.options.placement.refinement;
  if (mending.flips + mending.moves + mending.relocations > 0) {
    lines.push_back(line(
        "Mended",
        "triangles with angles below " +
            format_number(refinement.rounds > 0 ? refinement.smallest_angle
                                                : TriangleMendingOptions().smallest_angle) +
            " degrees, by " + counted(static_cast<std::size_t>(mending.flips), "flip", "flips") +
            ", " + counted(static_cast<std::size_t>(mending.moves), "move", "moves") + " and " +
            counted(static_cast<std::size_t>(mending.relocations), "relocation", "relocations") +
            " of nodes; " + std::to_string(mending.left) + " left"));
  }
  if (space.fit.samples > 0) {
    lines.push_back(line(
        "Placement",
        "along the normals to " + counted(space.fit.samples, "sample", "samples") + "; " +
            counted(static_cast<std::size_t>(space.fit.held_back), "node", "nodes") +
            " held back by guards; offset for the volume " + format_number(space.fit.offset, 3)));
  }
  if (space.evening.deviation_before > 0.0) {
    lines.push_back(line("Evened", "edges, whose lengths deviate from the wanted ones by " +
                                       format_number(100.0 * space.evening.deviation_after, 3) +
                                       " % instead of " +
                                       format_number(100.0 * space.evening.deviation_before, 3)));
  }
}

void append_relaxation(const RemeshResult& result, std::vector<std::string>& lines) {
  const SeedingOptions& seeding = result.options.seeding;
  if (seeding.sampling != Sampling::Weighted) {
    lines.push_back(line("Sampling", label_of(seeding.sampling) + ", not relaxed"));
    return;
  }
  std::string seeds = label_of(seeding.start);
  if (seeding.start == SeedStart::Random) {
    seeds += " start, seed " + std::to_string(seeding.random_seed);
  }
  const WeightingOptions& weighting = result.options.weighting;
  std::string weights = label_of(weighting.kind);
  if (weighting.kind == Weighting::Curvature) {
    weights += ", alpha " + format_number(weighting.curvature_alpha, 3) + ", curvature from " +
               label_of(weighting.curvature_source);
    if (result.map_degree > 0 && weighting.curvature_source == CurvatureSource::Series) {
      weights += " of degree " + std::to_string(result.map_degree);
    }
  }
  if (weighting.kind == Weighting::ErrorAdaptive) {
    weights += ", curvature exponent " + format_number(weighting.adaptive_exponent, 3);
  }
  if (result.parametrization == Parametrization::Spherical) {
    const Weighting taken = weighting_in_space(weighting.kind);
    if (taken != weighting.kind) {
      weights = label_of(taken) + " (asked for: " + weights +
                ", which a spherical map cannot tell from it)";
    }
  }
  lines.push_back(line("Weighting", weights + "; seeds: " + seeds));

  const RelaxationReport& relaxation = result.relaxation;
  const RelaxationOptions& asked = result.options.relaxation;
  const auto iterations = static_cast<std::size_t>(std::max(relaxation.iterations, 0));
  std::string text =
      label_of(relaxation.outcome) + " " + counted(iterations, "iteration", "iterations");
  for (auto level = relaxation.coarser_levels.rbegin(); level != relaxation.coarser_levels.rend();
       ++level) {
    text += (level == relaxation.coarser_levels.rbegin() ? " (after " : ", ") +
            std::to_string(level->iterations) + " with " + std::to_string(level->seeds) + " seeds";
  }
  if (!relaxation.coarser_levels.empty()) text += ")";
  if (!relaxation.history.empty()) {
    const RelaxationStep& last = relaxation.history.back();
    text += ", displacement " + format_number(last.displacement, 2) + " h (tolerance " +
            format_number(asked.displacement_tolerance, 2) + "), cell area spread " +
            format_number(last.area_spread, 2) + " (tolerance " +
            format_number(asked.area_tolerance, 2) + ")";
  }
  lines.push_back(line("Relaxation", text));
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
  lines.push_back(line("Target", text));
}

void append_refinement(const RemeshResult& result, std::vector<std::string>& lines) {
  const RefinementReport& refinement = result.refinement;
  if (refinement.history.empty()) return;
  int flips = 0;
  int relocations = 0;
  for (const RefinementStep& step : refinement.history) {
    flips += step.flips;
    relocations += step.relocations;
  }
  std::string text =
      (refinement.converged ? "converged after " : "not converged: stopped at the limit of ") +
      counted(refinement.history.size(), "round", "rounds") + ", rms distance from " +
      format_number(refinement.start_distance, 3) + " to " +
      format_number(refinement.history.back().distance, 3) + ", " +
      counted(static_cast<std::size_t>(flips), "edge", "edges") + " flipped, " +
      counted(static_cast<std::size_t>(relocations), "node", "nodes") + " taken elsewhere";
  lines.push_back(line("Refinement", text));
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
      {"Distance", "from remesh", "from original", "two-sided", "% of equivalent radius"},
      row("  largest sampled", to.maximum, from.maximum, result.distances->largest),
      row("  root mean square", to.root_mean_square, from.root_mean_square,
          result.distances->root_mean_square),
      row("  mean", to.mean, from.mean, std::max(to.mean, from.mean)),
  };
  for (std::string& text : aligned_lines(rows)) lines.push_back(std::move(text));
}

void append_quality(const RemeshResult& result, std::vector<std::string>& lines) {
  const MeshQuality& a = result.original_quality;
  const MeshQuality& b = result.quality;
  const auto row = [](const char* label, double before, double after) {
    return std::vector<std::string>{label, format_number(before, 4), format_number(after, 4)};
  };
  const std::vector<std::vector<std::string>> rows = {
      {"Quality", "original", "remesh"},
      row("  edge length, mean", a.edge_length.mean, b.edge_length.mean),
      row("  edge length, deviation", a.edge_length.standard_deviation,
          b.edge_length.standard_deviation),
      row("  edge length, deviation / mean", a.edge_variation, b.edge_variation),
      row("  edge ratio of the triangles, mean", a.edge_ratio.mean, b.edge_ratio.mean),
      row("  edge ratio of the triangles, deviation", a.edge_ratio.standard_deviation,
          b.edge_ratio.standard_deviation),
      row("  edge ratio of the triangles, largest", a.edge_ratio.maximum, b.edge_ratio.maximum),
      row("  smallest angle, degrees", a.smallest_angle, b.smallest_angle),
      row("  smallest angle of the triangles, mean", a.mean_smallest_angle, b.mean_smallest_angle),
      row("  vertices with six neighbours, %", 100.0 * a.valence_six_share,
          100.0 * b.valence_six_share),
  };
  for (std::string& text : aligned_lines(rows)) lines.push_back(std::move(text));
}

std::vector<DescriptorComparison> comparison(const RemeshResult& result) {
  return compare_descriptors(list_descriptors(result.original), list_descriptors(result.remesh));
}

}  // namespace

std::vector<std::string> report_lines(const RemeshResult& result) {
  std::vector<std::string> lines;
  append_input(result, lines);
  append_handles(result, lines);
  append_fit(result, lines);
  append_meeting(result, lines);
  append_mending(result, lines);
  append_search(result, lines);
  append_relaxation(result, lines);
  append_refinement(result, lines);
  lines.push_back(line("Result", counted(result.mesh.points.size(), "node", "nodes") + ", " +
                                     counted(result.mesh.triangles.size(), "face", "faces") +
                                     ", placement: " + label_of(result.options.placement.kind)));
  lines.push_back(line(
      "Closeness", "rms distance from the scan " + format_number(result.misfit, 3) + " (" +
                       format_number(100.0 * result.misfit / result.input.equivalent_radius, 3) +
                       " % of the equivalent radius)"));
  append_distances(result, lines);
  append_quality(result, lines);
  for (std::string& text : table_lines(comparison(result), ComparisonNames())) {
    lines.push_back(std::move(text));
  }
  for (std::string& text : aligned_lines(mass_rows({{"original", mass_properties(result.original)},
                                                    {"remesh", mass_properties(result.remesh)}}))) {
    lines.push_back(std::move(text));
  }
  for (const std::string& warning : result.warnings) lines.push_back(line("Warning", warning));
  return lines;
}

}  // namespace wscvt
